"""The data of a mechanism: drawings, parameters, bodies, points, and fields of elements."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from typing import Any

from kempe import mobility
from kempe.base.arrays import ROUNDING
from kempe.base.display_units import Shown, display, heading
from kempe.errors import KempeError
from kempe.lab_report.blocks import Block, Cell, Paragraph, Points, Section, Table
from kempe.lab_report.figures import drawn
from kempe.lab_report.printed import number, text
from kempe.lab_report.subject import Subject
from kempe.model.catalogue import about, declared
from kempe.model.doubts import NO_GRAVITY
from kempe.model.model import Model
from kempe.plot.drawing_pages import of_configuration, of_mechanism

#: Fields of elements that other tables contain.
_ELSEWHERE = ("type", "i", "j")


def mechanism(subject: Subject) -> Section:
    """Drawings, numbers of bodies, counts of equations and degrees of freedom."""
    start, model = subject.start, subject.model
    found = mobility(model, start)
    named = [f"{info.shown_number} {name}" for name, info in model.shown_bodies.items()]
    drawings: list[Block] = []
    if model.bodies:
        drawings = [
            drawn(of_mechanism(start), "start"),
            drawn(of_configuration("initial", start, 1), "start"),
        ]
    return Section(
        "Mechanism",
        [
            Paragraph(
                f"Bodies have numbers in the order of the model: 0 ground, {', '.join(named)}."
            ),
            *drawings,
            Paragraph("Degrees of freedom at the initial configuration:"),
            Points(found.report()),
        ],
    )


def data(subject: Subject) -> Section:
    """Parameters, bodies, points, force elements, and fields of joints and drivers."""
    model, tree = subject.model, subject.tree
    gravity = ", ".join(number(part, "m/s^2").text for part in model.gravity)
    unit = display("m/s^2").symbol
    return Section(
        "Data",
        [
            Paragraph(
                f"Acceleration of free fall: [{gravity}] {unit} in x and y of ground."
                if any(model.gravity)
                else f"{NO_GRAVITY.capitalize()}."
            ),
            _parameters(subject),
            _bodies(subject),
            Points(list(_forms(subject))),
            _points(subject),
            _shapes(tree),
            _fields("Force elements", "forces", subject),
            Points(list(_laws("forces", subject))),
            _fields("Fields of joints and drivers", "joints drivers", subject),
            _tables(tree),
        ],
    )


def _parameters(subject: Subject) -> Table:
    values = subject.model.parameters
    written = subject.tree.get("parameters", {})
    rows = [
        (name, _written(written.get(name, value)), number(value)) for name, value in values.items()
    ]
    header = ("parameter", "as written", "value in SI units and rad")
    return Table("Parameters", header, rows)


def _bodies(subject: Subject) -> Table:
    rows: list[tuple[Cell, ...]] = []
    for name, info in subject.model.shown_bodies.items():
        inertia = number(info.inertia, "kg*m^2") if info.has_inertia else "–"
        is_rigid = info.has_inertia or not info.turns
        center = (number(part, "m") if is_rigid else "–" for part in info.center)
        rows.append(
            (str(info.shown_number), name, info.type, number(info.mass, "kg"), inertia, *center)
        )
    header = (
        "no.",
        "body",
        "type",
        heading("mass", "kg"),
        heading("inertia about centre", "kg*m^2"),
        heading("centre x′", "m"),
        heading("centre y′", "m"),
    )
    return Table("Bodies; mass centres in the frames of the bodies", header, rows)


def _forms(subject: Subject) -> Iterator[str]:
    """Descriptions of the types of bodies that determine their own inertia."""
    kinds = dict.fromkeys(info.type for info in subject.model.shown_bodies.values())
    return (f"{kind}: {about('bodies', kind)}" for kind in kinds if kind != "body")


def _points(subject: Subject) -> Table:
    rows: list[tuple[Cell, ...]] = []
    size = float(abs(subject.start.q).max(initial=1.0))
    for body, info in subject.model.all_bodies.items():
        for point, local in info.points.items():
            at = subject.start.body(body).at(local).position
            rounded = (part if abs(part) > ROUNDING * size else 0.0 for part in map(float, at))
            cells = [number(part, "m") for part in (*local, *rounded)]
            rows.append((body, point, *cells))
    names = ("x′", "y′", "x at the start", "y at the start")
    header = ("body", "point", *(heading(name, "m") for name in names))
    caption = "Points: x′, y′ in the frames of the bodies, x, y in that of ground"
    return Table(caption, header, rows)


def _shapes(tree: Mapping[str, Any]) -> Table:
    """Curves and homogeneous pieces as written."""
    rows = [
        (body, key, _compact(entry[key]))
        for body, entry in tree.get("bodies", {}).items()
        for key in ("curves", "shapes")
        if entry.get(key)
    ]
    return Table("Curves and shapes of bodies", ("body", "field", "as written"), rows)


def _tables(tree: Mapping[str, Any]) -> Table:
    rows = [(name, _compact(entry)) for name, entry in tree.get("tables", {}).items()]
    return Table("Tables", ("function", "as written"), rows)


def _fields(caption: str, groups: str, subject: Subject) -> Table:
    """The fields of elements as written, with their units."""
    rows: list[tuple[Cell, ...]] = []
    for group in groups.split():
        for name, entry in subject.tree.get(group, {}).items():
            units = {of["name"]: _unit(of) for of in declared(group)[entry["type"]]["fields"]}
            given = {key: entry[key] for key in entry if key not in _ELSEWHERE}
            told = f"{entry['type']}{_between(entry)}"
            for key, value in given.items():
                unit = units.get(key, "")
                first = key == next(iter(given))
                rows.append(
                    (
                        name if first else "",
                        told if first else "",
                        key,
                        *_value(value, subject),
                        unit,
                    )
                )
    header = ("element", "type", "field", "as written", "value", "unit")
    return Table(caption, header, rows)


def _unit(field: Mapping[str, Any]) -> str:
    """The unit of a field; ``m|rad`` depends on a coordinate."""
    unit = field["unit"] or ""
    return "" if unit == "any" else " or ".join(Shown(part).symbol for part in unit.split("|"))


def _between(entry: Mapping[str, Any]) -> str:
    """The bodies or points between which an element acts."""
    ends = [str(entry[key]) for key in ("i", "j") if key in entry]
    return f", {' – '.join(ends)}" if ends else ""


def _value(value: Any, subject: Subject) -> tuple[Cell, Cell]:
    """A field as written, and its value if it is a number or a formula in the parameters."""
    if isinstance(value, int | float) and not isinstance(value, bool):
        return text(value), number(value)
    if isinstance(value, str):
        found = _evaluated(value, subject.tree.get("parameters", {}))
        return value, number(found) if found is not None else ""
    return _compact(value), ""


def _evaluated(formula: str, parameters: Mapping[str, Any]) -> float | None:
    """The number of a formula in the parameters; None for a law, a name and a function."""
    name = "value_" + "_".join(parameters)  # no parameter has this name
    try:
        return Model("a formula", parameters={**parameters, name: formula}).parameters[name]
    except KempeError:
        return None


def _laws(group: str, subject: Subject) -> Iterator[str]:
    """The law of each type of element that occurs."""
    kinds = dict.fromkeys(entry["type"] for entry in subject.tree.get(group, {}).values())
    return (f"{kind}: {about(group, kind)}" for kind in kinds)


def initial_set(subject: Subject) -> Table:
    """The quantities that are set and guessed at the start."""
    rows: list[tuple[Cell, ...]] = []
    for told, given in (("set", subject.held), ("guess", subject.guessed)):
        for name, value in given.items():
            rows.append((told, name, _written(value)))
    return Table("Request for the start", ("", "quantity", "as written"), rows)


def _written(value: Any) -> str:
    """A number or formula of a file."""
    return text(value) if isinstance(value, int | float) else str(value)


def _compact(value: Any) -> str:
    """Nested data on one line."""
    return json.dumps(value, ensure_ascii=False).replace('"', "")
