"""Positions and velocities of a model at one instant or at many, and what follows from them."""

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
    """Positions and velocities at instants; accelerations and multipliers follow when asked for.

    ``motion["rocker"]`` is a body, ``motion["C"]`` a joint or driver, ``motion["spring"]`` a force.
    All arrays are read-only and time-first; at a single instant the time axis is absent.

    Attributes:
        model: the model in numbers.
        t: (n_t,) or (), s.
        q: (n_t, n_q) or (n_q,): x, y, angle of each moving body in order, m and rad.
        v: their rates, m/s and rad/s.
    """

    def __init__(self, model: CompiledModel, t: Floats, q: Floats, v: Floats) -> None:
        self.model = model
        self.t = fixed(t)
        self.q = fixed(q)
        self.v = fixed(v)

    @property
    def a(self) -> Floats:
        """Accelerations, shaped as ``q``, m/s² and rad/s²: with γ, free of stabilization.

        Raises:
            SingularityError: they are not unique at one of the instants.
            IntegrationError: one of them is not finite.
        """
        return self._dynamics[0]

    @property
    def lam(self) -> Floats:
        """Multipliers λ, (n_t, n_rows) or (n_rows,): M a + Φ_qᵀ λ = Q (Haug 6.3.18).

        Raises:
            SingularityError: they are not unique at one of the instants.
            IntegrationError: one of them is not finite.
        """
        return self._dynamics[1]

    @cached_property
    def _dynamics(self) -> tuple[Floats, Floats]:
        a, lam = _core.evaluate(self.model.core, *self._rows())
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
        rows = self._rows()
        return self._as_given(_core.force(self.model.core, name, on, part, frame, *rows))

    def _rows(self) -> tuple[Floats, Floats, Floats]:
        """t, q, v with a time axis, as the core wants them."""
        return np.atleast_1d(self.t), np.atleast_2d(self.q), np.atleast_2d(self.v)

    def _as_given(self, values: Floats) -> Floats:
        return fixed(values[0] if self.t.ndim == 0 else values)

    def body(self, name: str) -> BodyView:
        """A body, ground among them.

        Raises:
            ModelError: there is no body of that name; it is a ``KeyError`` too.
        """
        return BodyView(self, self.model.body(name))

    def constraint(self, name: str) -> ConstraintView:
        """A joint or driver.

        Raises:
            ModelError: there is none of that name; it is a ``KeyError`` too.
        """
        if name not in self.model.constraints:
            raise unknown("joint or driver", name, self.model.constraints)
        return ConstraintView(self, self.model.constraints[name])

    def force(self, name: str) -> ForceView:
        """A force element.

        Raises:
            ModelError: there is none of that name; it is a ``KeyError`` too.
        """
        if name not in self.model.forces:
            raise unknown("force", name, self.model.forces)
        return ForceView(self, self.model.forces[name])

    # The name alone tells its kind, which a type checker cannot see: hence Any, and the three
    # methods above for code that is checked.
    def __getitem__(self, name: str) -> Any:
        """A body, joint, driver or force by name.

        Raises:
            ModelError: there is none of that name; it is a ``KeyError`` too.
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
