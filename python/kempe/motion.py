"""Motion at one time or many: positions, velocities and the quantities derived from them."""

from __future__ import annotations

from functools import cached_property
from typing import Any

import numpy as np

from kempe import _core
from kempe.arrays import Floats, fixed
from kempe.compiled import CompiledModel
from kempe.names import unknown
from kempe.views import BodyView, ConstraintView, ForceView


class Motion:
    """Positions and velocities; accelerations and multipliers are computed on first access.

    ``motion["rocker"]`` is a body, ``motion["C"]`` a joint or driver, ``motion["spring"]`` a force.
    All arrays are read-only and have time as first axis. At a single time there is no time axis.

    Attributes:
        model: the compiled model.
        t: (n_t,) or (), s.
        q: (n_t, n_q) or (n_q,): x, y, angle of each moving body in order, m and rad, then the
            internal coordinates of joints; see ``model.column_names()``.
        v: their rates, per s.
        z: (n_t, n_z) or (n_z,): first-order states of force elements, such as the current of a
            motor; see ``model.state_names()``. Empty for most models.
    """

    #: Whether accelerations are computed near singular positions too, as in runs that pass them.
    _passing = False

    def __init__(
        self, model: CompiledModel, t: Floats, q: Floats, v: Floats, z: Floats | None = None
    ) -> None:
        self.model = model
        self.t = fixed(t)
        self.q = fixed(q)
        self.v = fixed(v)
        self.z = fixed(np.zeros((*self.t.shape, model.n_z)) if z is None else z)

    @property
    def a(self) -> Floats:
        """Accelerations, same shape as ``q``, m/s² and rad/s²; with γ, without stabilization.

        Raises:
            SingularityError: the accelerations are not unique at one of the times.
            IntegrationError: an acceleration is not finite.
        """
        return self._dynamics[0]

    @property
    def lam(self) -> Floats:
        """Multipliers λ, (n_t, n_rows) or (n_rows,): M a + Φ_qᵀ λ = Q (Haug 6.3.18).

        Raises:
            SingularityError: the multipliers are not unique at one of the times.
            IntegrationError: a multiplier is not finite.
        """
        return self._dynamics[1]

    @cached_property
    def _dynamics(self) -> tuple[Floats, Floats]:
        rows = *self._rows(), np.atleast_2d(self.z)
        a, lam = _core.evaluate(self.model.core, *rows, self._passing)
        return self._as_given(a), self._as_given(lam)

    @cached_property
    def residuals(self) -> tuple[Floats, Floats]:
        """Φ and Φ_q q̇ + Φ_t, (n_t, n_rows) or (n_rows,), m or rad and per s."""
        position, velocity = _core.residual(self.model.core, *self._rows())
        return self._as_given(position), self._as_given(velocity)

    def reaction(self, joint: str, on: str, frame: str) -> Floats:
        """Force and torque of a joint on a body, (…, 3); see ``ConstraintView``."""
        t, q, _ = self._rows()
        lam = np.atleast_2d(self.lam)
        return self._as_given(_core.reaction(self.model.core, joint, on, frame, t, q, lam))

    def action(self, name: str, on: str, part: str | None, frame: str) -> Floats:
        """Force and torque of a force element on a body, (…, 3); see ``ForceView``."""
        rows = *self._rows(), np.atleast_2d(self.z)
        seen = self.model.forces[name].reaction is not None
        lam = np.atleast_2d(self.lam) if seen else None
        return self._as_given(_core.force(self.model.core, name, on, part, frame, *rows, lam))

    def _rows(self) -> tuple[Floats, Floats, Floats]:
        """t, q, v with a time axis, as required by the core."""
        return np.atleast_1d(self.t), np.atleast_2d(self.q), np.atleast_2d(self.v)

    def _as_given(self, values: Floats) -> Floats:
        return fixed(values[0] if self.t.ndim == 0 else values)

    def body(self, name: str) -> BodyView:
        """A body by name, including ground.

        Raises:
            ModelError: there is no such body; the error is also a ``KeyError``.
        """
        return BodyView(self, self.model.body(name))

    def constraint(self, name: str) -> ConstraintView:
        """A joint or driver by name.

        Raises:
            ModelError: there is no such joint or driver; the error is also a ``KeyError``.
        """
        if name not in self.model.constraints:
            raise unknown("joint or driver", name, self.model.constraints)
        return ConstraintView(self, self.model.constraints[name])

    def force(self, name: str) -> ForceView:
        """A force element by name.

        Raises:
            ModelError: there is no such force element; the error is also a ``KeyError``.
        """
        if name not in self.model.forces:
            raise unknown("force", name, self.model.forces)
        return ForceView(self, self.model.forces[name])

    # The type of the result depends on the name, which a type checker cannot follow. Checked code
    # uses the three methods above.
    def __getitem__(self, name: str) -> Any:
        """A body, joint, driver or force by name.

        Raises:
            ModelError: the name is unknown; the error is also a ``KeyError``.
        """
        if name in self.model.all_bodies:
            return self.body(name)
        if name in self.model.constraints:
            return self.constraint(name)
        if name in self.model.forces:
            return self.force(name)
        raise unknown("body, joint, driver or force", name, self.model.names())

    def __contains__(self, name: object) -> bool:
        return name in set(self.model.names())
