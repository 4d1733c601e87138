"""The first rows of a run of the core, and a run with its results as in a file."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

from kempe.base.arrays import Floats
from kempe.errors import KempeError
from kempe.results.phases import Settings

if TYPE_CHECKING:
    from kempe import _core

    Run: TypeAlias = "_core.Run | StoredRun | PartialRun"


#: Values of ``status``, as in scipy's ``solve_ivp``: the end was reached, an event stopped the run,
#: or it failed.
REACHED, EVENT, STOPPED = 0, 1, -1
STATUS = {"reached": REACHED, "event": EVENT, "stopped": STOPPED}
#: Name of an event, its times, and rows of q, v and z there.
EventRows: TypeAlias = "tuple[str, Floats, Floats, Floats, Floats, Floats]"


@dataclass(frozen=True)
class StoredRun:
    """A run with the results that the core computed from it, as in a file.

    Attributes:
        t, q, v, z: times and states, a row for each time.
        accelerations: accelerations and multipliers, or the error of their computation.
        energy: energies and works, (n_t, 5), or the error of their computation.
        dense_t, dense_y, dense_c: the interpolant; None if it was not kept.
        status: "reached" or "stopped".
        message: reason for the end of the run.
        statistics: steps, evaluations and times, as JSON.
        projection: tolerance of the projection of the states; None without projection.
        settings: the first row of each phase, with its parameters and released drivers.
        events: name, times, rows of q, v and z, and of impulses, of each event.
    """

    t: Floats
    q: Floats
    v: Floats
    z: Floats
    accelerations: tuple[Floats, Floats] | KempeError
    energy: Floats | KempeError
    dense_t: Floats | None
    dense_y: Floats | None
    dense_c: Floats | None
    status: str
    message: str
    statistics: str
    projection: float | None
    settings: Settings = ((0, ([], [], [])),)
    events: Sequence[EventRows] = ()

    def responses(self, rows: int | None = None) -> tuple[Floats, Floats]:
        """Accelerations and multipliers, at all or the first times."""
        if isinstance(self.accelerations, KempeError):
            raise self.accelerations
        a, lam = self.accelerations
        return a[:rows], lam[:rows]

    def energies(self, rows: int | None = None) -> Floats:
        """Energies and works, at all or the first times."""
        if isinstance(self.energy, KempeError):
            raise self.energy
        return self.energy[:rows]


@dataclass(frozen=True)
class PartialRun:
    """The first rows of a run, up to a state at which a value cannot be computed.

    Attributes:
        run: the whole run.
        rows: the number of rows kept.
        message: the reason why later rows are left out.
    """

    run: Run
    rows: int
    message: str
    status: str = "stopped"
    dense_t: None = None
    dense_y: None = None
    dense_c: None = None

    @property
    def t(self) -> Floats:
        """Times, s."""
        return self.run.t[: self.rows]

    @property
    def q(self) -> Floats:
        """Coordinates, a row for each time."""
        return self.run.q[: self.rows]

    @property
    def v(self) -> Floats:
        """Their rates."""
        return self.run.v[: self.rows]

    @property
    def z(self) -> Floats:
        """First-order states."""
        return self.run.z[: self.rows]

    @property
    def projection(self) -> float | None:
        """Tolerance of the projection of its states."""
        return self.run.projection

    @property
    def settings(self) -> Settings:
        """The first row of each phase, with its parameters and released drivers."""
        return [entry for entry in self.run.settings if entry[0] < max(self.rows, 1)]

    @property
    def events(self) -> Sequence[EventRows]:
        """Name, times and rows of q, v, z and impulses of each event, up to the last row."""
        found = []
        for name, t, *rows in self.run.events:
            before = t <= self.run.t[self.rows - 1]
            q, v, z, impulses = (values[before] for values in rows)
            found.append((name, t[before], q, v, z, impulses))
        return found

    @property
    def statistics(self) -> str:
        """Steps, evaluations and times of the whole run, as JSON."""
        return self.run.statistics

    def responses(self, rows: int | None = None) -> tuple[Floats, Floats]:
        """Accelerations and multipliers, at all or the first times."""
        return self.run.responses(self.rows if rows is None else min(rows, self.rows))

    def energies(self, rows: int | None = None) -> Floats:
        """Energies and works, at all or the first times."""
        return self.run.energies(self.rows if rows is None else min(rows, self.rows))
