"""The solution of a simulation."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from functools import cached_property
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np

from kempe._upwards import CALLS
from kempe.base.arguments import explain_methods
from kempe.base.arrays import Floats, fixed
from kempe.errors import IntegrationError, KempeError, ModelError, SingularityError
from kempe.model.compiled import CompiledModel
from kempe.model.model import compiled_model
from kempe.results.dense import WORKS, DenseOutput
from kempe.results.drift import Drift
from kempe.results.energy import Energy
from kempe.results.events import EventTimes, events
from kempe.results.measures import Measure
from kempe.results.motion import Motion
from kempe.results.origin import WithSlopes
from kempe.results.phases import Phases, phases
from kempe.results.runs import REACHED, STATUS, PartialRun, StoredRun
from kempe.results.saving import save
from kempe.results.state import State
from kempe.results.summary import summary
from kempe.results.tables import Tables
from kempe.results.variable import TIME, Variable

if TYPE_CHECKING:
    from kempe.model.model import Model
    from kempe.results.runs import Run

#: Rounding errors of the time at which a law jumps, relative to the times of a run.
_ROUNDING = 1e-12


@explain_methods
class Solution(WithSlopes, Tables, Motion):
    """The solution of a simulation: arrays with time first, read-only, SI units.

    Examples: ``sol["rocker"].angle``, ``sol["C"].force(on="coupler")``,
    ``sol["rocker.angle"]``, and ``sol(0.123)`` between the outputs. The names ``t``, ``nfev``,
    ``njev``, ``nlu``, ``status``, ``message`` and ``success`` have the meaning they have in scipy.

    Attributes:
        model: the model of the user.
        compiled: the compiled model at the time of the run.
        t: (n_t,), s; values of ``variable`` in a motion over a driven quantity.
        variable: the quantity in ``t``: the time, or a driven quantity with its unit.
        q, v: (n_t, n_q), m, rad and per s.
        z: (n_t, n_z): first-order states of force elements; empty for most models.
        status: 0 if the end was reached, 1 if an event stopped the run, -1 otherwise.
        message: reason for the end of the run.
    """

    def __init__(
        self,
        model: Model | CompiledModel,
        run: Run,
        method: str = "unknown",
        variable: Variable = TIME,
    ) -> None:
        base = compiled_model(model)
        settings = run.settings
        super().__init__(base.variant(settings[0][1]), run.t, run.q, run.v, run.z)
        self._base = base
        self._run = run
        if len(settings) > 1:
            self._phases = phases(base, settings, len(run.t))
        self._passing = run.projection is not None
        self._method = method
        self.variable = variable
        self.status = STATUS[run.status]
        self.message = run.message

    def __reduce__(self) -> tuple[Any, ...]:
        made = self._base, self.stored(), self._method, self.variable
        return Solution, made, {"_slopes": self._slopes}

    def stored(self) -> StoredRun:
        """The run with all its results, for a copy or a file."""
        run = self._run
        accelerations: tuple[Floats, Floats] | KempeError
        energy: Floats | KempeError
        try:
            accelerations = self.a, self.lam
        except KempeError as error:
            accelerations = error
        try:
            energy = self.energy.columns
        except KempeError as error:
            energy = error
        return StoredRun(
            **{name: getattr(self, name) for name in ("t", "q", "v", "z")},
            accelerations=accelerations,
            energy=energy,
            dense_t=run.dense_t,
            dense_y=run.dense_y,
            dense_c=run.dense_c,
            status=run.status,
            message=run.message,
            statistics=json.dumps(dict(self.statistics)),
            projection=run.projection,
            settings=tuple(run.settings),
            events=tuple(run.events),
        )

    @cached_property
    def energy(self) -> Energy:
        """Energies over time.

        Raises:
            IntegrationError: an energy is not finite.
        """
        with self._keeping_what_is_before():
            return Energy(self._run.energies())

    @cached_property
    def statistics(self) -> Mapping[str, Any]:
        """Cost of the run.

        ``steps``, ``rejected``, ``evaluations``, ``jacobians``, ``iterations`` (Newton),
        ``factorisations``, ``seconds`` and ``method``; with ``kp.Auto`` also ``why``.
        """
        return MappingProxyType({"method": self._method, **json.loads(self._run.statistics)})

    @cached_property
    def dense(self) -> DenseOutput | None:
        """The interpolant; None if it was not kept."""
        run = self._run
        if run.dense_t is None or run.dense_y is None or run.dense_c is None:
            return None
        if not len(self.t):  # the run failed before the first output
            return None
        if not len(run.dense_y):
            y = np.concatenate([self.q[0], self.v[0], self.z[0], np.zeros(WORKS)])
            return DenseOutput.of_an_instant(self.t[0], y)
        return DenseOutput(fixed(run.dense_t), fixed(run.dense_y), fixed(run.dense_c))

    @cached_property
    def _dynamics(self) -> tuple[Floats, ...]:
        with self._keeping_what_is_before():
            a, lam = self._run.responses()
        return fixed(a), fixed(lam)

    @contextmanager
    def _keeping_what_is_before(self) -> Iterator[None]:
        """Attach the solution before the failing state to an error, as in errors of a run."""
        try:
            yield
        except (IntegrationError, SingularityError) as error:
            if getattr(error, "solution", None) is not None:
                raise
            rows = int(np.count_nonzero(np.cumsum(self.t == error.t) == 0))
            if rows:
                kept = PartialRun(self._run, rows, str(error))
                error.solution = Solution(self._base, kept, self._method, self.variable)
            raise

    def dissipated(self, name: str) -> Floats:
        """Energy that a force element or a joint that slips has dissipated; see ``ForceView``."""
        from kempe.results.dissipation import dissipated  # loads polynomials of NumPy

        return dissipated(self, name)

    @property
    def success(self) -> bool:
        """True if the end was reached or an event stopped the run."""
        return self.status >= REACHED

    @property
    def nfev(self) -> int:
        """Number of evaluations of the accelerations."""
        return int(self.statistics["evaluations"])

    @property
    def njev(self) -> int:
        """Number of tangents of the equations of motion; 0 with explicit methods."""
        return int(self.statistics.get("jacobians", 0))

    @property
    def nlu(self) -> int:
        """Number of factorisations."""
        return int(self.statistics["factorisations"])

    @cached_property
    def drift(self) -> Drift:
        """Constraint violation over time, and the balance of the reactions."""
        position, velocity = (np.abs(r).max(axis=1, initial=0.0) for r in self.residuals)
        return Drift(fixed(position), fixed(velocity), self)

    @cached_property
    def events(self) -> Mapping[str, EventTimes]:
        """Events of the run by name, such as ``hit`` or ``cam.lift_off``; see ``EventTimes``.

        An event that did not occur has no times.
        """
        return events(self)

    @cached_property
    def summary(self) -> Mapping[str, Any]:
        """Peaks, energy balance, events, settling times and cost; see ``kempe.report.summary``."""
        return MappingProxyType(summary(self))

    def measure(self, name: str) -> Measure:
        """A measure with its statistics, such as ``sol.measure("pin").max``.

        Raises:
            ModelError: there is no such measure; the error is also a ``KeyError``.
        """
        return Measure(self, name)

    @property
    def initial(self) -> State:
        """The state at the first time."""
        return self._state_of(0)

    @property
    def final(self) -> State:
        """The state at the last time."""
        state = self._state_of(-1)
        state.origin = self._slopes.origin if self._slopes else None
        return state

    def _state_of(self, row: int) -> State:
        model = self.compiled
        if self._phases is not None:
            model = self._phases.models[self._phases.of_row[row]]
        return self._state(model, float(self.t[row]), self.q[row], self.v[row], self.z[row])

    def _state_before(self, t: float, q: Floats, v: Floats, z: Floats) -> State:
        """The state of an event, with the parameters and drivers before it."""
        model = self.compiled
        if self._phases is not None:
            firsts = self._phases.firsts
            before = max(int(np.searchsorted(self.t[firsts], t)) - 1, 0)
            # where a law jumps, the rows at this time belong to the next phase
            if t == self.t[firsts[min(before + 1, len(firsts) - 1)]]:
                before = int(self._phases.of_row[np.searchsorted(self.t, t)])
            model = self._phases.models[before]
        return self._state(model, t, q, v, z)

    def _state(self, model: CompiledModel, t: float, q: Floats, v: Floats, z: Floats) -> State:
        state = State(model, t, q, v, z=z)
        state._passing, state.variable = self._passing, self.variable
        return state

    def __call__(self, t: float | Floats) -> Motion:
        """The motion at any time within the solution, from the interpolant of the integrator.

        If the states of the solution are projected, these states are projected too. They equal the
        states of outputs at these times.

        Args:
            t: s; one time gives a ``State``, an array (n,) gives a ``Motion``.

        Raises:
            ModelError: the time is outside the solution, or the interpolant was not kept.
            IntegrationError, SingularityError: a state cannot be projected.
        """
        if self.dense is None:
            raise ModelError("the solution has no interpolant", hint="use dense_output=True")
        try:
            at = np.asarray(t, dtype=np.float64)
        except (TypeError, ValueError, OverflowError) as error:
            raise ModelError(f"t must be one time or an array of times: {error}") from error
        if at.ndim > 1:
            raise ModelError(f"t has {at.ndim} dimensions; must be one time or an array of times")
        times = np.atleast_1d(at)
        q, v, z = self.dense.parts(times, self.compiled.n_q, self.compiled.n_z)
        motion = Motion(self.compiled, times, q, v, z)
        motion.variable = self.variable
        motion._passing, motion._phases = self._passing, self._phases_at(times)
        if (tolerance := self._run.projection) is not None:
            # friction at rest does not change the states that close the joints
            motion.__dict__["_decided"] = motion._phases
            q, v = motion._asked(lambda states: states.project(tolerance))
            rates = np.zeros_like(v) if self.variable.static else v
            q, v = fixed(q), fixed(rates)
            motion.q, motion.v = q, v
            del motion.__dict__["_decided"]
        if at.ndim:
            return motion
        own = motion._phases
        model = self.compiled if own is None else own.models[own.of_row[0]]
        return self._state(model, float(at), q[0], v[0], z[0])

    def _phases_at(self, t: Floats) -> Phases | None:
        """The phases at times; at the time of a change, the phase after it."""
        if self._phases is None:
            return None
        firsts = self._phases.firsts
        begins = self.t[firsts]
        # where a law jumps, the rounding errors of this time belong to the phase after it
        jumps = (firsts > 0) & (self.t[firsts - 1] != begins)
        begins = begins - jumps * _ROUNDING * max(abs(self.t[0]), abs(self.t[-1] - self.t[0]))
        return self._phases.at(np.maximum(np.searchsorted(begins, t, side="right") - 1, 0))

    def energy_at(self, t: Floats) -> Energy:
        """Energies at any times within the solution, from the interpolant of the integrator.

        Args:
            t: (n,), s.

        Raises:
            ModelError: a time is outside the solution, or the interpolant was not kept.
            IntegrationError: an energy is not finite.
        """
        motion = self(t)
        assert self.dense is not None  # otherwise the line before raises the error
        works = self.dense(motion.t)[..., 2 * self.compiled.n_q + self.compiled.n_z :]
        (found,) = motion._asked(lambda states, works: [states.energies(works)], works)
        return Energy(found)

    def save(self, path: Path | str) -> None:
        """Write the solution and its case to a file of NumPy arrays (``.npz``).

        Raises:
            FileError: the file cannot be written; an existing file is not changed.
        """
        save(self, path)

    def _repr_html_(self) -> str:
        return str(CALLS["html"](self))

    def __repr__(self) -> str:
        count = len(self.t)
        of = self.variable
        ends = f"{self.t[0]:g} … {self.t[-1]:g} {of.unit}" if count else ""
        span = f"{of.name} = {ends}, {count} outputs" if count else "no outputs"
        steps = f"{self.statistics['steps']} steps of {self.statistics['method']}"
        return f"<Solution of {self.compiled.title!r}: {span}, {steps}; {self.message}>"
