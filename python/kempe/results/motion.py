"""Motion at one or many times: positions, velocities and the quantities derived from them."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import cached_property
from types import MappingProxyType
from typing import Any

import numpy as np

from kempe import _core
from kempe.base.arrays import Floats, finite, fixed, scalar
from kempe.base.names import entry, unknown
from kempe.errors import KempeError, ModelError
from kempe.model.compiled import CompiledModel, ConstraintInfo
from kempe.model.model import Model, compiled_model
from kempe.results import friction_at_rest, quantities
from kempe.results.newton_euler import NewtonEuler, newton_euler
from kempe.results.phases import Phases
from kempe.results.redundant import redundant
from kempe.results.remarks import LEFT_OUT, MIDDLE, MINIMUM_NORM, ONE_SHARE, together
from kempe.results.shared import shared as shared_at_rest
from kempe.results.variable import TIME, Variable
from kempe.results.views.beam import BeamView
from kempe.results.views.body import BodyView
from kempe.results.views.constraint import ConstraintView
from kempe.results.views.force import ForceView


class Motion:
    """Positions and velocities; accelerations and multipliers are computed on first access.

    ``motion["rocker"]`` is a body, ``motion["C"]`` a joint or driver, ``motion["spring"]`` a force,
    and ``motion["rocker.angle"]`` a quantity, (n_t,). All arrays are read-only and have time as
    first axis. At a single time there is no time axis, and a single number is a float.

    Attributes:
        compiled: the compiled model at the time of the computation.
        t: (n_t,), s; values of ``variable`` in a motion over a driven quantity.
        variable: the quantity in ``t``: the time, or a driven quantity with its unit.
        q: (n_t, n_q) or (n_q,): x, y, angle of each moving body in order, m and rad, then the
            internal coordinates of joints; see ``model.column_names()``.
        v: their rates, per s.
        z: (n_t, n_z) or (n_z,): first-order states of force elements, such as the current of a
            motor; see ``model.state_names()``. Empty for most models.
    """

    #: The phases of its rows; None if all have the compiled model.
    _phases: Phases | None = None
    #: The quantity in ``t``.
    variable: Variable = TIME
    #: Whether accelerations are computed near singular positions too, as in runs that pass them.
    _passing = False
    #: The reaction that was computed last, with its joint, body and frame.
    _last_reaction: tuple[tuple[str, ...], Floats] = ((), np.empty(0))

    def __init__(
        self,
        model: Model | CompiledModel,
        t: float | Floats,
        q: Floats,
        v: Floats,
        z: Floats | None = None,
    ) -> None:
        self.compiled = compiled = compiled_model(model)
        if compiled is not model:  # arrays of a user
            shape = np.shape(t)
            t = finite("t", t, shape)
            q, v = (finite(*pair, (*shape, compiled.n_q)) for pair in (("q", q), ("v", v)))
            z = None if z is None else finite("z", z, (*shape, compiled.n_z))
        self.t = fixed(t)
        self.q = fixed(q)
        self.v = fixed(v)
        self.z = fixed(np.zeros((*self.t.shape, compiled.n_z)) if z is None else z)

    def __reduce__(self) -> tuple[Any, ...]:
        made = self.compiled, np.array(self.t), self.q, self.v, self.z
        return Motion, made, {"variable": self.variable}

    @property
    def model(self) -> Model:
        """The model of the user from which the motion was computed."""
        return self.compiled.model

    @property
    def a(self) -> Floats:
        """Accelerations, shaped as ``q``, m/s² and rad/s², from Φ_q a = γ without stabilization.

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

    @property
    def regularity(self) -> Floats:
        """Regularity, (n_t,): near a singular position, proportional to the distance from it."""
        solved = self._dynamics if len(self._dynamics) > 2 else self._evaluated()
        return np.atleast_2d(solved[2])[:, 0]

    @cached_property
    def _dynamics(self) -> tuple[Floats, ...]:
        """Accelerations and multipliers."""
        return self._evaluated()

    def _evaluated(self) -> tuple[Floats, ...]:
        """Accelerations, multipliers and regularity from the core."""
        if self._decided is None:
            friction_at_rest.phases(self)  # raises the error again
        found = self._asked(lambda states: states.evaluate(self._passing))
        return tuple(self._as_given(values) for values in found)

    @cached_property
    def residuals(self) -> tuple[Floats, Floats]:
        """Φ and Φ_q q̇ + Φ_t, (n_t, n_rows) or (n_rows,), m or rad and per s."""
        position, velocity = self._asked(lambda states: states.residual())
        if self.variable.static:  # at rest, with the driver at rest too
            velocity = np.zeros_like(velocity)
        return self._as_given(position), self._as_given(velocity)

    @cached_property
    def newton_euler(self) -> NewtonEuler:
        """Residuals of the Newton–Euler equations with the reported reactions; see ``NewtonEuler``.

        At a single time the arrays have one row.

        Raises:
            SingularityError: the reactions are not unique at one of the times.
        """
        (rows,) = self._asked(lambda states: [states.newton_euler()], a=self.a, lam=self.lam)
        own = [
            f"{name}.{coordinate}"
            for name, info in self.compiled.constraints.items()
            for coordinate, _ in info.coordinates
        ]
        return newton_euler(tuple(self.compiled.bodies), tuple(own), rows)

    def measured(self, name: str, k: int, order: int) -> Floats:
        """Position quantity ``k`` of an element, (n_t,), or its derivative of this order in time.

        Raises:
            SingularityError: the accelerations, for order 2, are not unique at one of the times.
        """
        if (name, order == 2) not in self._measured:
            a = self.a if order == 2 else None
            (values,) = self._asked(lambda states: [states.measured(name)], a=a)
            self._measured[name, order == 2] = values
        return self._as_given(self._measured[name, order == 2][:, 3 * k + order])

    @cached_property
    def _measured(self) -> dict[tuple[str, bool], Floats]:
        """Position quantities of elements that were computed, without and with accelerations."""
        return {}

    def reaction(self, joint: str, on: str, frame: str) -> Floats:
        """Force and torque of a joint on a body, (…, 3); see ``ConstraintView``."""
        kept, values = self._last_reaction
        if kept != (joint, on, frame):  # its components are often read one after the other
            values = self._answer(lambda states: states.reaction(joint, on, frame), self.lam)
            self._last_reaction = (joint, on, frame), values
        return values

    @property
    def not_unique(self) -> frozenset[str]:
        """Joints, drivers and forces without unique loads; see ``ConstraintView.unique``."""
        return frozenset(self.choices)

    @cached_property
    def choices(self) -> Mapping[str, str]:
        """Joints, drivers and forces without unique loads, and which of the possible ones is given.

        It is "minimum norm", "second-order load left out", "middle of friction at rest", "one way
        to share the load" or several of them; see ``ConstraintView.unique``.
        """
        shared, kept = redundant(self)
        own = {
            MINIMUM_NORM: shared,
            LEFT_OUT: kept,
            MIDDLE: friction_at_rest.joints(self),
            ONE_SHARE: shared_at_rest(self, self._decided),
        }
        found = frozenset().union(*own.values())
        names = (n for n in (*self.compiled.constraints, *self.compiled.forces) if n in found)
        return MappingProxyType(
            {name: together(one for one, of in own.items() if name in of) for name in names}
        )

    @cached_property
    def multiplier_range(self) -> tuple[Floats, Floats] | None:
        """The least and the largest multipliers, (n_t, m) each.

        They differ where drivers hold friction at rest. None if this never occurs.
        """
        return friction_at_rest.multiplier_range(self)

    @cached_property
    def _decided(self) -> Phases | None:
        """The phases of its rows, with the modes of friction that is at rest outside of a run.

        None if all rows have the compiled model, or if the equations have no solution.
        """
        try:
            return self._phases or friction_at_rest.phases(self)
        except KempeError:  # accelerations raise it; positions do not depend on it
            return None

    def place(self, joint: str, on: str) -> Floats:
        """The point at which the reaction of a joint on a body is given, (…, 2), global, m."""
        return self._answer(lambda states: states.place(joint, on))

    def results(self, joint: str) -> Floats:
        """Results of a joint beside its reaction, (…, n); see ``ConstraintInfo.results``."""
        return self._answer(lambda states: states.results(joint), self.lam)

    def action(self, name: str, on: str, part: str | None, frame: str) -> Floats:
        """Force and torque of a force element on a body, (…, 3); see ``ForceView``."""
        lam = self.lam if self.compiled.forces[name].reads_multipliers else None
        return self._answer(lambda states: states.force(name, on, part, frame), lam)

    def action_place(self, name: str, on: str) -> Floats:
        """The point at which a force element acts on a body, (…, 2), global, m.

        It is the origin of the frame of the body for an element without points.
        """
        return self._answer(lambda states: states.force_place(name, on))

    def force_results(self, name: str) -> Floats:
        """Results of a force element beside its wrenches, (…, n); see ``ForceInfo.results``.

        Of a driver with a limit: its effort and power in a run of ``dynamics`` and zero elsewhere,
        and the limit.
        """
        known = self.compiled.forces.get(name)
        reads = known is None or known.reads_multipliers
        lam = (
            self.lam
            if reads
            else np.zeros((len(np.atleast_1d(self.t)), self.compiled.n_multipliers))
        )
        return self._answer(lambda states: states.force_results(name), lam)

    def force_energy(self, name: str) -> Floats:
        """Energy that a force or the slip of a joint stores, power that it dissipates, J and W."""
        known = self.compiled.forces.get(name)
        lam = self.lam if known is None or known.reads_multipliers else None
        return self._answer(lambda states: states.force_energy(name), lam)

    def dissipated(self, name: str) -> Floats:
        """Energy that a force element or a joint that slips has dissipated; see ``ForceView``."""
        raise ModelError(
            "a state or a motion at some times has no dissipated energy",
            name=name,
            hint="it belongs to a solution",
        )

    def _answer(self, ask: Callable[[_core.States], Floats], lam: Floats | None = None) -> Floats:
        """One table of the core at its states, with the multipliers if they are needed."""
        (found,) = self._asked(lambda states: [ask(states)], lam=lam)
        return self._as_given(found)

    def _asked(
        self,
        ask: Callable[..., Sequence[Floats]],
        *more: Floats,
        a: Floats | None = None,
        lam: Floats | None = None,
    ) -> Sequence[Floats]:
        """Tables of the core at its states, which ``ask`` gets with its part of ``more`` rows."""
        solved = (None if rows is None else np.atleast_2d(rows) for rows in (a, lam))

        def evaluate(core: _core.Model, *rows: Floats) -> Sequence[Floats]:
            return ask(_core.States(core, *rows[:6]), *rows[6:])

        return self._by_phase(evaluate, *self._rows(), *solved, *map(np.atleast_2d, more))

    def _by_phase(
        self, evaluate: Callable[..., Sequence[Floats]], *rows: Floats | None
    ) -> Sequence[Floats]:
        """Values of the core at rows, each with the parameters and drivers of its phase."""
        if self._decided is None:
            return evaluate(self.compiled.core, *rows)
        return self._decided.evaluate(evaluate, *rows)

    def _rows(self) -> tuple[Floats, Floats, Floats, Floats]:
        """t, q, v and z with a time axis, as required by the core."""
        q, v, z = (np.atleast_2d(rows) for rows in (self.q, self.v, self.z))
        return np.atleast_1d(self.t), q, v, z

    def _as_given(self, values: Floats) -> Floats:
        return fixed(values[0] if self.q.ndim == 1 else values)

    def body(self, name: str) -> BodyView[Floats]:
        """A body by name, including ground.

        Raises:
            ModelError: there is no such body; the error is also a ``KeyError``.
        """
        return BodyView(self, self.compiled.body(name))

    def constraint(self, name: str) -> ConstraintView[Floats]:
        """A joint or driver by name.

        Raises:
            ModelError: there is no such joint or driver; the error is also a ``KeyError``.
        """
        return ConstraintView(self, self._named("joint or driver", name))

    def joint(self, name: str) -> ConstraintView[Floats]:
        """A joint by name.

        Raises:
            ModelError: there is no such joint; the error is also a ``KeyError``.
        """
        return ConstraintView(self, self._named("joint", name, "joints"))

    def driver(self, name: str) -> ConstraintView[Floats]:
        """A driver by name.

        Raises:
            ModelError: there is no such driver; the error is also a ``KeyError``.
        """
        return ConstraintView(self, self._named("driver", name, "drivers"))

    def _named(self, what: str, name: str, group: str = "") -> ConstraintInfo:
        known = self.compiled.constraints
        info = known.get(name) if isinstance(name, str) else None
        if info is not None and group in ("", info.group):
            return info
        raise unknown(what, name, [n for n, c in known.items() if group in ("", c.group)])

    def force(self, name: str) -> ForceView[Floats]:
        """A force element by name.

        Raises:
            ModelError: there is no such force element; the error is also a ``KeyError``.
        """
        return ForceView(self, entry("force", name, self.compiled.forces))

    def beam(self, name: str) -> BeamView:
        """A beam by name, with its shape, internal forces and stress along its arc length.

        Raises:
            ModelError: there is no such beam; the error is also a ``KeyError``.
        """
        beams = {k: body for k, body in self.compiled.bodies.items() if body.type == "beam"}
        return BeamView(self, entry("beam", name, beams))

    # The type of the result depends on the name, which a type checker cannot follow. Checked code
    # uses the methods above.
    def __getitem__(self, name: str) -> Any:
        """A body, joint, driver or force, a quantity such as ``rocker.angle``, or a measure.

        Quantities have the same names as in files and tables. A quantity or measure is an array
        (n_t,), or a float in a state, in SI units and rad.

        Raises:
            ModelError: the name is unknown; the error is also a ``KeyError``.
        """
        compiled = self.compiled
        if not isinstance(name, str):
            raise unknown("body, joint, driver or force", name, compiled.names())
        place = compiled.places.get(name)
        if place is not None:  # controllers read these many times
            return scalar(getattr(self, place[0])[..., place[1]])
        if name in compiled.measured:
            return scalar(self.measured(*compiled.measured[name]))
        if name in compiled.all_bodies:
            return self.body(name)
        if name in compiled.constraints:
            return self.constraint(name)
        if name in compiled.forces:
            return self.force(name)
        if "." in name or name in compiled.measures:
            return quantities.named(self, name).read()
        raise unknown("body, joint, driver or force", name, compiled.names())

    def __contains__(self, name: object) -> bool:
        names = (*self.compiled.names(), *quantities.names(self))
        return isinstance(name, str) and name in names

    def _ipython_key_completions_(self) -> list[str]:
        """Names for completion in ``motion["…"]``."""
        return [*self.compiled.names(), *quantities.names(self)]

    def __repr__(self) -> str:
        of = self.variable
        what = "times" if of.is_time else f"values of {of.name}"
        span = f"{len(self.t)} {what} from {self.t[0]:g} to {self.t[-1]:g} {of.unit}"
        return f"<Motion of {self.compiled.title!r}: {span if len(self.t) else f'no {what}'}>"
