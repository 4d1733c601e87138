"""How a state was made, so that its derivatives can be computed."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Protocol

from kempe.base.arrays import Floats


@dataclass(frozen=True)
class Origin:
    """The recipe of a state: an assembly, and the analyses that lead from it to the state.

    Attributes:
        set: coordinates and rates that the assembly holds.
        guess: its guesses.
        analyses: the analyses in order, by names, as entries of a case.
    """

    set: Mapping[str, Any]
    guess: Mapping[str, Any]
    analyses: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)

    def then(self, entry: Mapping[str, Any]) -> Origin:
        """The recipe of the state at the end of one more analysis."""
        following = {f"run{len(self.analyses) + 1}": dict(entry)}
        return Origin(self.set, self.guess, {**self.analyses, **following})


class KeptSlopes(Protocol):
    """The slopes that a run keeps."""

    @property
    def origin(self) -> Origin:
        """The recipe of the end of the run."""

    @property
    def variables(self) -> Mapping[str, float]:
        """The variables and their values."""

    def read(self, quantity: str, variable: str, t: Floats) -> Floats:
        """The derivative of a quantity by a variable at the times of the run, (n_t,)."""
