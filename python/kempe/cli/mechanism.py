"""Printing of the mechanism, its initial configuration and its Jacobian."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from rich.console import Console
from rich.text import Text

from kempe.cli.console import figure, heading, table
from kempe.model.doubts import NO_GRAVITY

if TYPE_CHECKING:
    from kempe.model.infos import ConstraintInfo, ForceInfo
    from kempe.model.values import Number
    from kempe.results.matrices.values import Matrices
    from kempe.results.state import State

#: Largest number of columns of a printed Jacobian.
WIDEST = 30


def show_mechanism(console: Console, state: State) -> None:
    """Print bodies, joints, drivers, forces and degrees of freedom."""
    model = state.model
    console.print(Text(model.title or "untitled", style="bold"))
    heading(console, "Bodies")
    bodies = [
        (
            str(b.shown_number),
            b.name,
            b.type,
            figure(b.mass),
            figure(b.inertia) if b.has_inertia else "–",
        )
        for b in model.compile().shown_bodies.values()
    ]
    table(console, ("", "name", "type", "mass / kg", "inertia / kg·m²"), bodies, left=3)
    forces = model.compile().shown_forces.values()
    groups: dict[str, list[ConstraintInfo | ForceInfo]] = {
        "Joints": [*model.joints.values(), *(force for force in forces if force.is_joint)],
        "Drivers": [*model.drivers.values()],
        "Forces": [force for force in forces if not force.is_joint],
    }
    for title, elements in groups.items():
        if elements:
            heading(console, title)
            rows = [(e.name, e.type, e.i, e.j) for e in elements]
            table(console, ("name", "type", "body i", "body j"), rows, left=4)
    if not any(model.gravity):
        console.print(Text(f"  {NO_GRAVITY}", style="yellow"))
    free = state.matrices().degrees_of_freedom
    console.print()
    counts = f"{model.n_q} coordinates, {model.n_rows} constraint equations"
    console.print(Text(f"  {counts}, {free} degree{'' if free == 1 else 's'} of freedom"))


def show_configuration(console: Console, state: State) -> None:
    """Print the initial configuration and the assembly report."""
    from kempe.base.display_units import display

    time = display("s")
    told = f"{figure(state.t / time.divisor)} {time.symbol}"
    heading(console, f"Initial configuration, t = {told}")
    header, rows = state.table()
    table(console, header, rows)
    if state.report is not None:
        for line in str(state.report).splitlines():
            console.print(Text(f"  {line}", style="yellow" if line.startswith("warning") else ""))


def show_jacobian(console: Console, state: State, held: Mapping[str, Number]) -> None:
    """Print Φ_q at the start with rows joint.equation and columns body.coordinate.

    Each prescribed coordinate of the assembly has a row.
    """
    positions = {name: value for name, value in held.items() if name in state.model.column_names()}
    found = state.matrices(positions)
    rows, columns = found.Phi_q.shape
    heading(console, f"Jacobian Φ_q at the start, {rows} × {columns}")
    if columns > WIDEST:
        console.print(Text(f"  not shown: more than {WIDEST} columns"))
        return
    table(console, ("", *found.columns), _cells(found))


def _cells(found: Matrices) -> list[tuple[str, ...]]:
    return [
        (label, *(_entry(value) for value in row))
        for label, row in zip(found.rows, found.Phi_q.tolist(), strict=True)
    ]


def _entry(value: float) -> str:
    """Print structural zeros as dots to show the sparsity pattern."""
    return "·" if value == 0.0 else f"{value:.4f}".rstrip("0").rstrip(".")
