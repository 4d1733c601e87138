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

    from kempe import _core

#: As scipy's ``solve_ivp`` counts.
REACHED, STOPPED = 0, -1


@dataclass(frozen=True)
class Drift:
    """How far the constraints are from being met.

    Attributes:
        position: largest |Φ| at each time, (n_t,), m or rad.
        velocity: largest |Φ_q q̇ + Φ_t| at each time, (n_t,), per s.
    """

    position: Floats
    velocity: Floats


class Solution(Motion):
    """The solution of a simulation: arrays with time first, read-only, SI units.

    ``sol["rocker"].angle``, ``sol["C"].force(on="coupler")``, ``sol["spring"].torque(on="rocker")``
    and ``sol(0.123)`` between the outputs. The names ``t``, ``nfev``, ``njev``, ``nlu``,
    ``status``, ``message`` and ``success`` mean what they mean in scipy.

    Attributes:
        model: the model in numbers.
        t: (n_t,), s.
        q, v: (n_t, n_q), m, rad and per s.
        status: 0 when the end was reached, -1 when it was not.
        message: why it ended.
    """

    def __init__(self, model: CompiledModel, run: _core.Run) -> None:
        super().__init__(model, run.t, run.q, run.v)
        self._run = run
        self.status = REACHED if run.status == "reached" else STOPPED
        self.message = run.message

    @cached_property
    def energy(self) -> Energy:
        """Where the energy went.

        Raises:
            IntegrationError: an energy is not finite.
        """
        with self._keeping_what_is_before():
            return Energy(self._run.energies())

    @cached_property
    def statistics(self) -> Mapping[str, Any]:
        """What it took.

        ``steps``, ``rejected``, ``evaluations``, ``jacobians``, ``iterations`` (of Newton),
        ``factorisations``, ``seconds``; with ``kp.Auto``, ``method`` and ``why``.
        """
        return MappingProxyType(json.loads(self._run.statistics))

    @cached_property
    def dense(self) -> DenseOutput | None:
        """The interpolant between the steps; None if it was not kept."""
        run = self._run
        if run.dense_t is None or run.dense_y is None or run.dense_c is None:
            return None
        if not len(self.t):  # it failed before the first output
            return None
        if not len(run.dense_y):
            return DenseOutput.of_an_instant(self.t[0], np.concatenate([self.q[0], self.v[0]]))
        return DenseOutput(fixed(run.dense_t), fixed(run.dense_y), fixed(run.dense_c))

    @cached_property
    def _dynamics(self) -> tuple[Floats, Floats]:
        with self._keeping_what_is_before():
            a, lam = self._run.responses()
        return fixed(a), fixed(lam)

    @contextmanager
    def _keeping_what_is_before(self) -> Iterator[None]:
        """An error of one of the states keeps the solution before it, as an error of a run does."""
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
        """Whether the end was reached."""
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
        """How far the constraints are from being met."""
        position, velocity = (np.abs(r).max(axis=1, initial=0.0) for r in self.residuals)
        return Drift(fixed(position), fixed(velocity))

    @property
    def initial(self) -> State:
        """The state at the first time."""
        return State(self.model, float(self.t[0]), self.q[0], self.v[0])

    @property
    def final(self) -> State:
        """The state at the last time."""
        return State(self.model, float(self.t[-1]), self.q[-1], self.v[-1])

    def __call__(self, t: float | Floats) -> Motion:
        """The motion at any time within the solution, by the integrator's own interpolant.

        Args:
            t: one time, which gives a ``State``, or an array (n,), which gives a ``Motion``, s.

        Raises:
            ModelError: outside of the solution, or the interpolant was not kept.
        """
        if self.dense is None:
            raise ModelError("the solution keeps no dense output", hint="use dense_output=True")
        at = np.asarray(t, dtype=np.float64)
        if at.ndim > 1:
            raise ModelError(f"t has {at.ndim} dimensions; must be one time or an array of times")
        n, y = self.model.n_q, self.dense(at)
        q, v = y[..., :n], y[..., n : 2 * n]
        if at.ndim == 0:
            return State(self.model, float(at), q, v)
        return Motion(self.model, at, q, v)

    def to_dataframe(self) -> pandas.DataFrame:
        """A pandas table with a column for each quantity, such as ``rocker.angle``.

        Units are in ``attrs["units"]``.

        Raises:
            ModelError: pandas is not installed.
        """
        from kempe.table import dataframe

        return dataframe(self)

    def to_csv(self, path: Path | str) -> None:
        """Write all quantities as text, one line for each time, with units in the header.

        Raises:
            FileError: the file cannot be written; an old one is then left as it was.
        """
        from kempe.table import write_csv

        write_csv(self, path)

    def save(self, path: Path | str) -> None:
        """Write the solution to a file of NumPy arrays (``.npz``), the case inside.

        Raises:
            FileError: the file cannot be written; an old one is then left as it was.
        """
        from kempe.archive import save

        save(self, path)

    def __repr__(self) -> str:
        span = f"t = {self.t[0]:g} … {self.t[-1]:g} s, {len(self.t)} outputs"
        steps = f"{self.statistics['steps']} steps"
        return f"<Solution of {self.model.title!r}: {span}, {steps}; {self.message}>"
