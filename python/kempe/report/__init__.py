"""Reports of a solution as text and numbers."""

from __future__ import annotations

from typing import Any

from kempe.base.arguments import explain_functions
from kempe.model.values import instance
from kempe.results import summary as _summary
from kempe.results.solution import Solution

__all__ = ["summary"]


def summary(solution: Solution) -> dict[str, Any]:
    """Mechanism, initial and final state, peak values, energy balance, events, settling times.

    Peaks and settling times are found on the interpolant, also between the outputs. The residual is
    the largest at the outputs and at the beginnings of steps, since elsewhere it includes the error
    of the interpolant. The result can be written as JSON. Units: m, rad, N, N·m, J, s.
    """
    instance(solution, Solution, "a solution")
    return _summary.summary(solution)


explain_functions(globals())
