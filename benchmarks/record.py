"""The result of one setting of one tool on one problem."""

from __future__ import annotations

from dataclasses import asdict, dataclass, field
from typing import Any


@dataclass
class Record:
    """Median CPU seconds, error (in the unit of the problem), largest gap of a joint (m).

    `failure` is the reason for missing numbers. `more` contains further measures by name. `took` is
    the time of the first run, even if it failed.
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
