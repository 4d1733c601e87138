"""The results at a glance."""

from __future__ import annotations

from collections.abc import Iterator

from kempe.base.display_units import display
from kempe.lab_report.blocks import Cell, Paragraph, Section, Table
from kempe.lab_report.motion import Told
from kempe.lab_report.printed import FEW, number
from kempe.lab_report.subject import Subject
from kempe.results.solution import Solution

_HEADER = ("analysis", "result", "value", "unit", "")


def at_a_glance(subject: Subject) -> Section:
    """The counts of the mechanism, and the main results of each analysis."""
    model, start = subject.model, subject.start
    free = start.matrices().degrees_of_freedom
    counts = (
        f"{_counted(len(model.shown_bodies), 'moving body', 'moving bodies')}, "
        f"{_counted(len(model.joints), 'joint')}, {_counted(len(model.drivers), 'driver')} and "
        f"{_counted(len(model.shown_forces), 'force element')}; {model.n_q} coordinates and "
        f"{_counted(model.n_rows, 'constraint equation')}, "
        f"{_counted(free, 'degree')} of freedom."
    )
    rows: list[tuple[Cell, ...]] = []
    for name, found in subject.results.items():
        for k, row in enumerate(_of_motion(found)) if isinstance(found, Solution) else ():
            rows.append((name if k == 0 else "", *row))
    others = [
        Paragraph(f"{name}: {found.report()[0]}.")
        for name, found in subject.results.items()
        if not isinstance(found, Solution)
    ]
    return Section("Summary", [Paragraph(counts), Table("Main results", _HEADER, rows), *others])


def _of_motion(solution: Solution) -> Iterator[tuple[Cell, ...]]:
    told = Told(solution)
    summary = told.summary
    peaks = summary["peaks"]
    for kind, key, word in (("reactions", "joint", "in"), ("forces", "name", "of")):
        for quantity, unit in (("force", "N"), ("torque", "N*m")):
            found = told.peaks(kind)
            largest = max((abs(of[quantity]) for of in found), default=0.0)
            if largest:
                worst = next(of for of in found if abs(of[quantity]) == largest)
                what = f"largest {'reaction ' if kind == 'reactions' else ''}{quantity}"
                value = number(worst[quantity], unit)
                at = told.place(worst[f"{quantity}_at"])
                yield what, value, display(unit).symbol, f"{word} {worst[key]} at {at}"
    if peaks["residual"] is not None:
        worst = peaks["residual"]
        value = number(worst["value"], worst["unit"], digits=FEW)
        where = f"in {worst['equation']} at {told.place(worst['at'])}"
        yield "largest residual", value, display(worst["unit"]).symbol, where
    energy = summary["energy"]
    balance = number(energy["largest_imbalance"], digits=FEW)
    yield "error of the energy balance", balance, "", "of the largest energy of the run"
    times = [of["time"] for of in summary["settling"] if of["moves"]]
    if times and None not in times and solution.variable.is_time:
        yield "all angles settled at", number(max(times), "s"), display("s").symbol, ""


def _counted(count: int, one: str, many: str = "") -> str:
    return f"{count} {one if count == 1 else many or f'{one}s'}"
