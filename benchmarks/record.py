"""What one setting of one tool gave on one problem."""

from __future__ import annotations

from dataclasses import asdict, dataclass, field
from typing import Any


@dataclass
class Record:
    """Median CPU seconds, error (in the unit of the problem), largest gap of a joint (m).

    `failure` tells why there are no numbers; `more` has further measures by name; `took` is what
    the first run took, whatever became of it.
    """

    problem: str
    tool: str
    curve: str
    tolerance: float
    seconds: float | None = None
    runs: int = 0
    error: float | None = None
    gap: float | None = None
    failure: str | None = None
    took: float = 0.0
    more: dict[str, float] = field(default_factory=dict)

    @property
    def good(self) -> bool:
        """Whether it has numbers."""
        return self.failure is None

    def json(self) -> dict[str, Any]:
        """As plain data."""
        return asdict(self)
