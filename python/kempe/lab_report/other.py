"""Results that are not motions, such as equilibria and modes; and a study."""

from __future__ import annotations

from collections.abc import Sequence

from kempe.lab_report.blocks import (
    Block,
    Cell,
    Listing,
    Number,
    Paragraph,
    Points,
    Section,
    Table,
)
from kempe.lab_report.figures import Figures, picture
from kempe.lab_report.printed import FEW, number
from kempe.plot.study_figures import drawn
from kempe.results.result import Result
from kempe.results.table import Column
from kempe.sweeps.studies import Study
from kempe.sweeps.studies.outcome import Outcome
from kempe.sweeps.studies.table import fate, header
from kempe.sweeps.studies.variants import GROUPS

#: A longer table is left to the CSV files of ``kempe run``.
_MOST_ROWS = 60
#: The groups of a study in the report; ``kempe study`` writes all.
_GROUPS = ("reference", "stabilization", "beta")
#: The figures of a study with their captions.
_CAPTIONS = {
    "residual": "Residuals over time",
    "error": "Differences from the most accurate run over time",
    "steps": "Steps of the integrator for gains β",
    "work_precision": "Error and cost of methods and tolerances",
    "gaps": "Openings of the joints, magnified",
}


def other(name: str, found: Result) -> Section:
    """The lines that ``kempe run`` prints, tables and figures."""
    tables = [_table(of, columns) for of, columns in found.tables().items()]
    listed = "\n".join(found.report())
    return Section(
        f"Results of {name}",
        [Listing(listed), *tables, *Figures(found, name).all()],
    )


def _table(name: str, columns: Sequence[Column]) -> Block:
    """A table with a quantity in each line; many values are replaced by their number."""
    count = max((len(column.values) for column in columns), default=0)
    if count == 1:
        rows = [(of.name, number(float(value)), of.unit) for of in columns for value in of.values]
        return Table(name.replace("_", " "), ("quantity", "value", "unit"), rows)
    if count > _MOST_ROWS or len(columns) > 8:
        told = f"{len(columns)} columns and {count} rows"
        return Paragraph(f"The table {name}.csv of kempe run has {told} and is omitted.")
    head = [of.label for of in columns]
    lines = [[number(float(of.values[k])) for of in columns] for k in range(count)]
    return Table(name.replace("_", " "), head, lines)


def of_study(found: Study | None) -> Section:
    """The variants in groups, the findings, and figures."""
    if found is None:
        return Section("Study", [])
    blocks: list[Block] = [
        Paragraph(
            f"The analysis {found.analysis} was computed with other stabilizations, methods and "
            "tolerances. Errors are the largest differences of any body from the most accurate "
            f"run ({found.reference.variant.name}) over all output times; the residual is the "
            "largest |Φ|. Findings and figures include variants that kempe study lists."
        )
    ]
    for group in _GROUPS:
        outcomes, title = found.group(group), GROUPS[group]
        good = [_cells(of) for of in outcomes if not of.diverged]
        blocks.append(Table(title[:1].upper() + title[1:], header()[:-1], good))
        blocks.append(Points([f"{of.variant.name} {fate(of)}" for of in outcomes if of.diverged]))
    pictures = [
        picture(drawn(found, name), caption, f"study-{name}") for name, caption in _CAPTIONS.items()
    ]
    parts = [Section("Findings", [Points(found.findings())]), Section("Figures", pictures)]
    return Section("Study of stabilization, method and tolerance", blocks, parts)


def _cells(of: Outcome) -> list[Cell]:
    """One row; its columns are those of ``kempe.sweeps.studies.table`` without the time."""
    errors = ((of.angle_error, "rad"), (of.position_error, "m"), (of.residual, "m"))
    measured = [number(value, unit, digits=FEW) for value, unit in errors]
    counts = [Number(float(count), str(count)) for count in (of.steps, of.evaluations)]
    return [of.variant.name, *measured, number(of.imbalance, digits=FEW), *counts]
