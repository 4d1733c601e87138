"""The initial configuration: coordinates, assembly, mass matrix, Jacobian, and loads."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import groupby

import numpy as np

from kempe.base.arrays import tidy
from kempe.base.display_units import display, heading, units
from kempe.errors import KempeError
from kempe.lab_report.blocks import Block, Cell, Matrix, Number, Paragraph, Points, Section, Table
from kempe.lab_report.data import initial_set
from kempe.lab_report.printed import FEW, number, quantity
from kempe.lab_report.subject import Subject
from kempe.results.matrices.labelled import Labelled
from kempe.results.matrices.labelled import show as labelled
from kempe.results.matrices.writing import number as entry
from kempe.results.state import State

#: Largest number of columns of a matrix in the report, and of a part that fits on a page.
_MOST_COLUMNS, _WIDTH = 45, 9
_SYMBOLS = {"angle": "φ"}
_ACCELERATIONS = (("ax", "m/s^2"), ("ay", "m/s^2"), ("alpha", "rad/s^2"))


def initial(subject: Subject) -> Section:
    """The request, the positions of the bodies, and the equations there."""
    start = subject.start
    return Section(
        f"Initial configuration, {_instant(start)}",
        [initial_set(subject), _coordinates(start), *_further(start), *_closure(start)],
        [
            Section("Assembly", list(_assembly(subject))),
            Section("Mass matrix", list(_mass(start))),
            Section("Jacobian", list(_jacobian(subject))),
            Section("Accelerations and multipliers", list(_loads(start))),
        ],
    )


def _instant(state: State) -> str:
    return f"{state.variable.name} = {quantity(float(state.t), state.variable.unit)}"


def _coordinates(state: State) -> Table:
    """Coordinates and velocities by body; angles also in degrees, unless a unit was chosen."""
    both = not units().chosen
    header = ["body", heading("x", "m"), heading("y", "m"), heading("φ", "rad")]
    header += ["φ / °"] if both else []
    header += [heading("ẋ", "m/s"), heading("ẏ", "m/s"), heading("φ̇", "rad/s")]
    rows, q, v = [], tidy(state.q), tidy(state.v)
    for name, info in state.compiled.named_bodies.items():
        x, y, *angle = q[info.columns]
        vx, vy, *omega = v[info.columns]
        row: list[Cell] = [name, number(x, "m"), number(y, "m")]
        row.append(number(angle[0], "rad") if angle else "–")
        if both:
            row.append(number(angle[0], "rad", "deg") if angle else "–")
        row += [number(vx, "m/s"), number(vy, "m/s")]
        row.append(number(omega[0], "rad/s") if omega else "–")
        rows.append(row)
    return Table("Coordinates q and velocities q̇ of the bodies", header, rows)


def _further(state: State) -> Iterator[Block]:
    """Internal coordinates of joints and first-order states of forces."""
    model = state.compiled
    bodies = sum(info.count for info in model.bodies.values())
    names = [*model.column_names()[bodies:], *model.state_names()]
    values = [*state.q[bodies:].tolist(), *state.z.tolist()]
    of = [*model.column_units()[bodies:], *model.state_units()]
    rows = [
        (name, number(value, unit), display(unit).symbol)
        for name, value, unit in zip(names, values, of, strict=True)
    ]
    yield Table("Further coordinates and states", ("quantity", "value", "unit"), rows)


def _closure(state: State) -> Iterator[Block]:
    """The residuals of the constraints and of their rates."""
    if not state.compiled.n_rows:
        return
    rows: list[tuple[Cell, ...]] = []
    names, given = state.compiled.row_names(), state.compiled.row_units()
    for told, values, suffix in zip(("Φ", "Φ̇"), state.residuals, ("", "/s"), strict=True):
        k = int(np.abs(values).argmax())
        unit = f"{given[k]}{suffix}"
        value = number(abs(float(values[k])), unit, digits=FEW)
        rows.append((told, names[k], value, display(unit).symbol))
    yield Table("Largest residuals", ("residual", "equation", "value", "unit"), rows)


def _assembly(subject: Subject) -> Iterator[Block]:
    """Iterations, the assembly mode, and warnings."""
    report = subject.start.report
    if report is None:
        return
    yield Paragraph(
        "Bodies are placed along their joints, loops are closed dyad by dyad, and Newton's method "
        "solves Φ = 0 from there."
    )
    warned = [f"warning: {text}" for text in report.warnings]
    yield Points([line for line in str(report).splitlines() if line not in warned])
    yield from (Paragraph(text, warning=True) for text in report.warnings)
    rows: list[tuple[Cell, ...]] = []
    for k, of in enumerate(subject.newton):
        moved = (of.step, of.damping) if k else ()
        cells = [number(value, digits=FEW) for value in (of.residual, *moved)]
        rows.append((str(k), *cells, *[""] * (3 - len(cells))))
    caption = (
        "Newton–Raphson iterations from the unchanged guess, loops open; norms with lengths "
        "relative to the size of the mechanism"
    )
    header = ("iteration", "residual", "step", "damping")
    yield Table(caption, header, rows if len(rows) > 1 else [])


def _mass(state: State) -> Iterator[Block]:
    """The mass matrix; for many bodies, only its diagonal, by body."""
    shown = labelled(state.compiled, state, "M")
    full, model = shown.values, state.compiled
    if not model.bodies:
        return
    is_diagonal = not np.count_nonzero(full - np.diag(np.diag(full)))
    if is_diagonal:
        yield Paragraph("M is diagonal: the origins of all frames are mass centres (Haug 6.2.8).")
    if is_diagonal and len(full) > _WIDTH:
        rows = []
        for name, info in model.bodies.items():
            values = np.diag(full)[info.columns].tolist()
            cells: list[Cell] = [number(value, unit) for value, unit in _of_body(values)]
            rows.append([name, *cells, *["–"] * (3 - len(cells))])
        header = ("body", heading("x", "kg"), heading("y", "kg"), heading("φ", "kg*m^2"))
        yield Table("Diagonal of the mass matrix M", header, rows)
        return
    yield from _parts(shown, "Mass matrix M")


def _of_body(values: Sequence[float]) -> Iterator[tuple[float, str]]:
    return zip(values, ("kg", "kg", "kg*m^2"), strict=False)


def _jacobian(subject: Subject) -> Iterator[Block]:
    """Φ_q with the rows of the coordinates that the start sets."""
    start, columns = subject.start, subject.model.column_names()
    held = {name: value for name, value in subject.held.items() if name in columns}
    if not subject.model.bodies or not (subject.model.n_rows or held):
        return
    found = start.matrices(held)
    shown = labelled(start.compiled, start, "Phi_q", assembly=held)
    size = " × ".join(map(str, shown.values.shape))
    rows = " with the rows of the quantities that hold during assembly" if held else ""
    own = start.matrices()
    whole = len(own.columns) + len(own.rows)
    yield Paragraph(
        f"The Jacobian Φ_q{rows} is {size} and has rank {found.rank}. Without them, "
        f"{_degrees(own.degrees_of_freedom)} left, and the matrix of the equations of motion is "
        f"{whole} × {whole}."
        if held
        else f"The Jacobian Φ_q is {size} and has rank {found.rank}: "
        f"{_degrees(own.degrees_of_freedom)} left. The matrix of the equations of motion is "
        f"{whole} × {whole}."
    )
    yield from _parts(shown, "Jacobian Φ_q")


def _degrees(count: int) -> str:
    return f"{count} degree{' of freedom is' if count == 1 else 's of freedom are'}"


def _parts(shown: Labelled, caption: str) -> Iterator[Block]:
    """A matrix in parts that fit on a page: whole groups of columns."""
    if len(shown.columns) > _MOST_COLUMNS:
        yield Paragraph(
            f"{caption} is {' × '.join(map(str, shown.values.shape))} and is omitted; kempe show "
            "FILE --format csv writes it."
        )
        return
    groups = [
        (name, len(list(of)))
        for name, of in groupby(shown.columns, lambda column: column.rpartition(".")[0])
    ]
    blocks: list[list[tuple[str, int]]] = [[]]
    for group in groups:
        if blocks[-1] and sum(count for _, count in blocks[-1]) + group[1] > _WIDTH:
            blocks.append([])
        blocks[-1].append(group)
    begin, cells = 0, shown.cells()
    for k, block in enumerate(blocks):
        end = begin + sum(count for _, count in block)
        part = f", columns {begin + 1} to {end}, rows with entries" if len(blocks) > 1 else ""
        chosen = f" in {', '.join(units().chosen)}" if units().chosen and k == 0 else ""
        yield Matrix(
            f"{caption}{part}{chosen}",
            block,
            [(name, _short(name)) for name in shown.columns[begin:end]],
            [
                (name, [Number(float(v), entry(c)) for v, c in zip(values, row, strict=True)])
                for name, values, row in zip(
                    shown.rows,
                    shown.values[:, begin:end],
                    cells[:, begin:end].tolist(),
                    strict=True,
                )
                if len(blocks) == 1 or any(row)
            ],
        )
        begin = end


def _short(name: str) -> str:
    last = name.rpartition(".")[2]
    return _SYMBOLS.get(last, last)


def _loads(state: State) -> Iterator[Block]:
    """q̈ and λ at the start; empty if masses or the position do not determine them."""
    try:
        acceleration = tidy(state.a, max(map(abs, state.compiled.gravity)))
        multipliers = tidy(state.lam)
    except KempeError as error:
        yield Paragraph(f"They are not determined: {error.args[0]}.")
        return
    rows = []
    for name, info in state.compiled.named_bodies.items():
        pairs = zip(acceleration[info.columns], _ACCELERATIONS, strict=False)
        cells: list[Cell] = [number(value, unit) for value, (_, unit) in pairs]
        rows.append([name, *cells, *["–"] * (3 - len(cells))])
    header = [
        heading(of, unit) for of, (_, unit) in zip(("ẍ", "ÿ", "φ̈"), _ACCELERATIONS, strict=True)
    ]
    yield Table("Accelerations q̈ at the start", ["body", *header], rows)
    shown = labelled(state.compiled, state, "lam")
    printed = zip(shown.rows, multipliers, shown.row_units, strict=False)
    yield Table(
        "Multipliers λ at the start",
        ("equation", "λ", "unit"),
        [(name, number(value, unit), display(unit).symbol) for name, value, unit in printed],
    )
