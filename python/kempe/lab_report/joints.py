"""Joints and drivers with their equations."""

from __future__ import annotations

from collections.abc import Iterator

from kempe.lab_report.blocks import Block, Formula, Formulas, Paragraph, Points, Section, Table
from kempe.lab_report.formula import formula, is_readable
from kempe.lab_report.subject import Subject
from kempe.model.catalogue import about
from kempe.results.matrices.equations import Equations, equations
from kempe.results.matrices.writing import named

#: Largest number of joints and drivers whose equations are printed; larger models repeat types.
_MOST = 40
_ABOUT = (
    "Φ = 0 are the equations of the joints and drivers; all partial derivatives that are not "
    "printed are zero, and γ is the right side of the acceleration equation Φ_q q̈ = γ "
    "(Haug 3.6.11). x′ and y′ are the coordinates of points in the frames of their bodies."
)


def joints(subject: Subject) -> Section:
    """A table of the joints and drivers, and the equations of each."""
    model, tree = subject.model, subject.tree
    rows = []
    for name, info in model.constraints.items():
        entry = tree.get(info.group, {}).get(name, {})
        ends = (str(entry.get(key, "")) for key in ("i", "j"))
        told = ", ".join(name for name, _ in info.equations)
        rows.append((name, info.type, *ends, told))
    header = ("name", "type", "i", "j", "equations")
    kinds = dict.fromkeys((info.group, info.type) for info in model.constraints.values())
    return Section(
        "Joints and their equations",
        [
            Table("Joints and drivers", header, rows),
            Points([f"{kind}: {about(group, kind)}" for group, kind in kinds]),
            *(_equations(subject) if len(rows) <= _MOST else _too_many(len(rows))),
        ],
    )


def _too_many(count: int) -> list[Block]:
    told = "`kempe show FILE --symbolic` prints them".replace("`", "")
    return [Paragraph(f"The equations of all {count} joints and drivers are omitted; {told}.")]


def _equations(subject: Subject) -> Iterator[Block]:
    if subject.model.constraints:
        yield Paragraph(_ABOUT)
    omitted = []
    for each in equations(subject.model):
        lines = list(_lines(each))
        yield Formulas(f"{each.name} ({each.type})", [line for line in lines if line])
        omitted += [each.name] if not all(lines) else []
    if omitted:
        yield Paragraph(
            f"Formulas of {', '.join(omitted)} that are long or have branches are omitted; kempe "
            "show FILE --symbolic prints them."
        )


def _lines(of: Equations) -> Iterator[list[Formula]]:
    """Definitions, Φ, derivatives and γ of a joint; an empty list if they are too long."""
    told = of.symbols
    for name, definition in told.definitions:
        yield _shown(f"{name} = {definition}")
    for k, row in enumerate(of.rows):
        symbol = f"_{{{named(row)}}}"
        yield _shown(rf"\Phi{symbol} = {told.residual[k]}")
        entries = zip(told.columns, told.jacobian[k], strict=True)
        slopes = [
            rf"\frac{{\partial \Phi{symbol}}}{{\partial {column}}} = {entry}"
            for column, entry in entries
            if entry != "0"
        ]
        line = [part for slope in slopes for part in _shown(slope)]
        yield line if len(line) == len(slopes) else []
        yield _shown(rf"\gamma{symbol} = {told.gamma[k]}")


def _shown(latex: str) -> list[Formula]:
    return [formula(latex)] if is_readable(latex) else []
