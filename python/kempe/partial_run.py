"""The first rows of a run, up to a state at which a value cannot be computed."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from kempe.arrays import Floats

if TYPE_CHECKING:
    from kempe import _core


@dataclass(frozen=True)
class PartialRun:
    """The first rows of a ``_core.Run``, with the same attributes.

    Attributes:
        run: the whole run.
        rows: the number of rows kept.
        message: the reason why later rows are left out.
    """

    run: _core.Run
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
    def statistics(self) -> str:
        """Steps, evaluations and times of the whole run, as JSON."""
        return self.run.statistics

    def responses(self) -> tuple[Floats, Floats]:
        """Accelerations and multipliers."""
        return self.run.responses(self.rows)

    def energies(self) -> Floats:
        """Energies and works."""
        return self.run.energies(self.rows)
