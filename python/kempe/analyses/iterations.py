"""The Newton–Raphson iteration of an assembly as a table."""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from typing import TYPE_CHECKING

from kempe.analyses.assembly import assemble
from kempe.analyses.record import AssemblyWarning
from kempe.results.matrices.writing import latex_number

if TYPE_CHECKING:
    from kempe.case import Case
    from kempe.results.assembly_report import Iteration

HEADER = ("iteration", "residual", "step", "damping")


@dataclass(frozen=True)
class Iterations:
    """The Newton–Raphson iterations that close a mechanism from a guess.

    Attributes:
        rows: residual, step and damping; the first is the start.
    """

    rows: tuple[Iteration, ...]

    def text(self) -> str:
        """A table with residual, step and damping of each iteration."""
        lines = [
            "Newton–Raphson from the unchanged guess (bodies placed by their joints, loops open)",
            "lengths relative to the size of the mechanism",
            f"{HEADER[0]:>9}  {HEADER[1]:>10}  {HEADER[2]:>10}  {HEADER[3]:>7}",
        ]
        for k, row in enumerate(self.rows):
            step, damping = (f"{row.step:.3e}", f"{row.damping:g}") if k else ("", "")
            lines.append(f"{k:>9}  {row.residual:>10.3e}  {step:>10}  {damping:>7}".rstrip())
        return "\n".join(lines)

    def csv(self) -> str:
        """A header and one line for each iteration."""
        lines = [
            f"{k},{row.residual!r},{row.step!r},{row.damping!r}" for k, row in enumerate(self.rows)
        ]
        return "\n".join([",".join(HEADER), *lines]) + "\n"

    def latex(self) -> str:
        """A ``tabular``."""
        lines = [
            f"{k} & ${latex_number(row.residual)}$ & "
            + (f"${latex_number(row.step)}$ & {row.damping:g}" if k else "& ")
            + r" \\"
            for k, row in enumerate(self.rows)
        ]
        head = " & ".join(HEADER) + r" \\ \hline"
        return "\n".join(["\\begin{tabular}{rrrr}", head, *lines, "\\end{tabular}"]) + "\n"


def iterations(case: Case) -> Iterations:
    """Assemble a case by Newton–Raphson from its guess.

    Args:
        case: the case to be assembled.

    Raises:
        AssemblyError: the iteration does not converge from this guess.
    """
    start = case._with_rest({}).get("start", {})
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", AssemblyWarning)
        state = assemble(case.model, start.get("set"), start.get("guess"), from_guess=True)
    return Iterations(state.report.iterations if state.report else ())
