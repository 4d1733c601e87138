"""Settings of the tools."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from importlib import import_module
from typing import Any

from problems.planar import Problem


@dataclass(frozen=True)
class Setting:
    """One setting of a tool. Settings of one `curve` differ only in `tolerance` (or step)."""

    curve: str
    tolerance: float
    options: Mapping[str, Any] = field(default_factory=dict)

    @property
    def label(self) -> str:
        """The setting as in the tables."""
        return f"{self.curve}, {self.tolerance:g}" if self.tolerance else self.curve


#: Product of bodies and steps above which the tools with fixed steps take minutes.
MOST_WORK = 2.5e6


def affordable(problem: Problem, quick: bool) -> tuple[float, ...]:
    """The fixed steps of a problem whose run takes about a minute at most."""
    work = [len(problem.bodies) * problem.t_end / step for step in problem.steps]
    steps = tuple(h for h, w in zip(problem.steps, work, strict=True) if w <= MOST_WORK)
    return steps[:1] if quick else steps


def not_installed(*modules: str) -> str | None:
    """The reason if a tool cannot be used, otherwise None."""
    for module in modules:
        try:
            import_module(module)
        except ImportError as error:
            return (
                f"{module} is not installed here ({error}); pip install 'kempe[bench]' installs it"
            )
    return None
