"""The solution of a simulation."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np

from kempe import _core
from kempe.arrays import Floats, fixed
from kempe.compiled import CompiledModel
from kempe.dense import DenseOutput
from kempe.energy import Energy
from kempe.errors import IntegrationError, ModelError, SingularityError
from kempe.motion import Motion
from kempe.partial_run import PartialRun
from kempe.state import State

if TYPE_CHECKING:
    import pandas

#: Values of ``status``, as in scipy's ``solve_ivp``.
REACHED, STOPPED = 0, -1


@dataclass(frozen=True)
class Drift:
    """Constraint violation over time.

    Attributes:
        position: largest |Φ| at each time, (n_t,), m or rad.
        velocity: largest |Φ_q q̇ + Φ_t| at each time, (n_t,), per s.
    """

    position: Floats
    velocity: Floats


class Solution(Motion):
    """The solution of a simulation: arrays with time first, read-only, SI units.

    Examples: ``sol["rocker"].angle``, ``sol["C"].force(on="coupler")``,
    ``sol["spring"].torque(on="rocker")``, and ``sol(0.123)`` between the outputs. The names ``t``,
    ``nfev``, ``njev``, ``nlu``, ``status``, ``message`` and ``success`` have the meaning they have
    in scipy.

    Attributes:
        model: the compiled model.
        t: (n_t,), s.
        q, v: (n_t, n_q), m, rad and per s.
        z: (n_t, n_z): first-order states of force elements; empty for most models.
        status: 0 if the end was reached, -1 otherwise.
        message: reason for the end of the run.
    """

    def __init__(self, model: CompiledModel, run: _core.Run) -> None:
        super().__init__(model, run.t, run.q, run.v, run.z)
        self._run = run
        self._passing = run.projection is not None and model.redundancy != "allow"
        self.status = REACHED if run.status == "reached" else STOPPED
        self.message = run.message

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
        ``factorisations``, ``seconds``; with ``kp.Auto`` also ``method`` and ``why``.
        """
        return MappingProxyType(json.loads(self._run.statistics))

    @cached_property
    def dense(self) -> DenseOutput | None:
        """The interpolant; None if it was not kept."""
        run = self._run
        if run.dense_t is None or run.dense_y is None or run.dense_c is None:
            return None
        if not len(self.t):  # the run failed before the first output
            return None
        if not len(run.dense_y):
            y = np.concatenate([self.q[0], self.v[0], self.z[0]])
            return DenseOutput.of_an_instant(self.t[0], y)
        return DenseOutput(fixed(run.dense_t), fixed(run.dense_y), fixed(run.dense_c))

    @cached_property
    def _dynamics(self) -> tuple[Floats, Floats]:
        with self._keeping_what_is_before():
            a, lam = self._run.responses()
        return fixed(a), fixed(lam)

    @contextmanager
    def _keeping_what_is_before(self) -> Iterator[None]:
        """Attach the solution before the failing state to an error, as for an error of a run."""
        try:
            yield
        except (IntegrationError, SingularityError) as error:
            rows = int(np.count_nonzero(np.cumsum(self.t == error.t) == 0))
            if rows:
                kept = PartialRun(self._run, rows, str(error))
                error.solution = Solution(self.model, kept)  # type: ignore[arg-type,union-attr]
            raise

    @property
    def success(self) -> bool:
        """True if the end was reached."""
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
        """Constraint violation over time."""
        position, velocity = (np.abs(r).max(axis=1, initial=0.0) for r in self.residuals)
        return Drift(fixed(position), fixed(velocity))

    @property
    def initial(self) -> State:
        """The state at the first time."""
        return self._state(float(self.t[0]), self.q[0], self.v[0], self.z[0])

    @property
    def final(self) -> State:
        """The state at the last time."""
        return self._state(float(self.t[-1]), self.q[-1], self.v[-1], self.z[-1])

    def _state(self, t: float, q: Floats, v: Floats, z: Floats) -> State:
        state = State(self.model, t, q, v, z=z)
        state._passing = self._passing
        return state

    def __call__(self, t: float | Floats) -> Motion:
        """The motion at any time within the solution, from the interpolant of the integrator.

        If the states of the solution are projected, so are these: they are the states that an
        output at these times reports.

        Args:
            t: s; one time gives a ``State``, an array (n,) gives a ``Motion``.

        Raises:
            ModelError: the time is outside the solution, or the interpolant was not kept.
            IntegrationError, SingularityError: a state cannot be projected.
        """
        if self.dense is None:
            raise ModelError("the solution has no interpolant", hint="use dense_output=True")
        at = np.asarray(t, dtype=np.float64)
        if at.ndim > 1:
            raise ModelError(f"t has {at.ndim} dimensions; must be one time or an array of times")
        times = np.atleast_1d(at)
        q, v, z = self.dense.parts(times, self.model.n_q, self.model.n_z)
        if (tolerance := self._run.projection) is not None:
            q, v = _core.project(self.model.core, tolerance, times, q, v, z)
        if at.ndim == 0:
            return self._state(float(at), q[0], v[0], z[0])
        motion = Motion(self.model, at, q, v, z)
        motion._passing = self._passing
        return motion

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
        works = self.dense(motion.t)[..., 2 * self.model.n_q + self.model.n_z :]
        rows = (np.atleast_2d(values) for values in (motion.q, motion.v, motion.z, works))
        return Energy(_core.energies(self.model.core, np.atleast_1d(motion.t), *rows))

    def to_dataframe(self) -> pandas.DataFrame:
        """A pandas data frame with a column for each quantity, such as ``rocker.angle``.

        Units are in ``attrs["units"]``.

        Raises:
            ModelError: pandas is not installed.
        """
        from kempe.table import dataframe

        return dataframe(self)

    def to_csv(self, path: Path | str) -> None:
        """Write all quantities as CSV, one line per time, with units in the header.

        Raises:
            FileError: the file cannot be written; an existing file is not changed.
        """
        from kempe.table import write_csv

        write_csv(self, path)

    def save(self, path: Path | str) -> None:
        """Write the solution and its case to a file of NumPy arrays (``.npz``).

        Raises:
            FileError: the file cannot be written; an existing file is not changed.
        """
        from kempe.archive import save

        save(self, path)

    def __repr__(self) -> str:
        span = f"t = {self.t[0]:g} … {self.t[-1]:g} s, {len(self.t)} outputs"
        steps = f"{self.statistics['steps']} steps"
        return f"<Solution of {self.model.title!r}: {span}, {steps}; {self.message}>"
