"""The beginning of a run: what is kept where something does not follow from a later state."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from kempe.arrays import Floats

if TYPE_CHECKING:
    from kempe import _core


@dataclass(frozen=True)
class Beginning:
    """What ``_core.Run`` holds, of its first rows.

    Attributes:
        run: the whole.
        rows: how many of them.
        message: why there are no more.
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
    def statistics(self) -> str:
        """What the whole run took, as JSON."""
        return self.run.statistics

    def responses(self) -> tuple[Floats, Floats]:
        """Accelerations and multipliers."""
        return self.run.responses(self.rows)

    def energies(self) -> Floats:
        """Energies and works."""
        return self.run.energies(self.rows)
