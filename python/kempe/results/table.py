"""All quantities of a solution as columns with names and units."""

from __future__ import annotations

import io
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from kempe.base import files
from kempe.base.arrays import Floats
from kempe.base.display_units import display
from kempe.errors import ModelError
from kempe.model.values import texts
from kempe.results import quantities, remarks
from kempe.results.views.frames import FRAMES, Frame, checked_frame

if TYPE_CHECKING:
    import pandas

    from kempe.results.solution import Solution


@dataclass(frozen=True)
class Column:
    """One quantity over time.

    Attributes:
        name: such as ``rocker.angle``.
        unit: display unit, such as ``rad``.
        values: (n_t,), in this unit.
        choice: for a reaction, or a measure that reads it, which of the possible values is given;
            empty if they are unique.
        condition: what a force, torque or power over a driven quantity contains; or empty.
    """

    name: str
    unit: str
    values: Floats
    choice: str = ""
    condition: str = ""

    @property
    def unique(self) -> bool:
        """Whether the values are unique."""
        return not self.choice

    @property
    def label(self) -> str:
        """Name and unit, such as ``C.fx_on_rocker [N]``, with the condition and other remarks."""
        beside = ", ".join(filter(None, (self.unit, self.condition, self.choice)))
        return f"{self.name} [{beside}]" if beside else self.name


@dataclass(frozen=True)
class Extent:
    """The columns that a table has besides coordinates, states and energies.

    Attributes:
        frames: frames of the reactions on each moving body, some of "global", "body" and "joint".
        points: points whose paths are written, such as ``("coupler.P",)``; True for all named
            points of moving bodies.
    """

    frames: Sequence[Frame] = ("global",)
    points: Sequence[str] | bool = ()


def columns(solution: Solution, extent: Extent | None = None) -> list[Column]:
    """Time, coordinates, multipliers, reactions, states, forces, energies and measures.

    In a motion over a driven quantity, its values replace the time.

    Raises:
        ModelError: there is no such frame or point.
    """
    first = solution.variable
    table = [column(first.name, first.unit, solution.t)]
    for name in column_names(solution, extent or Extent()):
        if name == first.name:
            continue
        quantity = quantities.named(solution, name)
        table.append(remarked(solution, name, quantity.unit, quantity.read()))
    return table


def remarked(solution: Solution, name: str, unit: str, values: Floats) -> Column:
    """A column of a quantity of a solution, with the remarks on it."""
    return replace(
        column(name, unit, values),
        choice=remarks.choice_of(solution, name),
        condition=remarks.condition(solution, name, unit),
    )


def column(name: str, unit: str, values: Floats) -> Column:
    """A column in the display unit of a quantity in SI units."""
    shown = display(unit)
    return Column(name, shown.unit, values / shown.divisor)


def column_names(solution: Solution, extent: Extent) -> Iterator[str]:
    """Names of the columns, in their order."""
    compiled = solution.compiled
    for name, body in compiled.named_bodies.items():
        yield from (f"{name}.{quantity}" for quantity in quantities.of_body(solution, body))
    for point in _points(solution, extent.points):
        yield from (f"{point}.{quantity}" for quantity in ("x", "y"))
    for name, joint in compiled.constraints.items():
        for coordinate, _ in joint.coordinates:
            yield from (f"{name}.{coordinate}", f"{name}.{coordinate}_rate")
    # the locks inside of beams have rows without a name of their own
    rows = map(_parted, compiled.row_names())
    yield from (f"{name}.lambda_{row}" for name, _, row in rows if name in compiled.constraints)
    frames = texts(extent.frames, "frames")
    for name in compiled.constraints:
        for frame in map(checked_frame, frames):
            yield from _reactions(solution, name, frame)
    yield from compiled.state_names()
    for name, force in compiled.shown_forces.items():
        yield from (f"{name}.force",) if force.points is not None else ()
        yield f"{name}.torque_on_{force.j}"
    yield from (f"energy.{name}" for name in quantities.ENERGIES)
    yield from compiled.measures


def _parted(name: str) -> tuple[str, str, str]:
    return name.rpartition(".")


def _reactions(solution: Solution, name: str, frame: str) -> Iterator[str]:
    """Components of the reaction on each moving body; the torque is the same in all frames."""
    for body in dict.fromkeys(solution.compiled.constraints[name].bodies):
        if body in solution.compiled.bodies:
            kinds = ("fx", "fy", "torque") if frame == FRAMES[0] else ("fx", "fy")
            yield from (quantities.reaction_name(name, kind, body, frame) for kind in kinds)


def _points(solution: Solution, wanted: Sequence[str] | bool) -> list[str]:
    """Names of points."""
    known = [f"{name}.{p}" for name, body in solution.compiled.bodies.items() for p in body.points]
    if isinstance(wanted, bool):
        return known if wanted else []
    return list(texts(wanted, "points"))


def dataframe(solution: Solution, extent: Extent | None = None) -> pandas.DataFrame:
    """The columns as a pandas data frame; units in ``attrs["units"]``."""
    try:
        import pandas
    except ImportError as error:
        raise ModelError(
            "to_dataframe needs pandas, which is not installed", hint="pip install pandas"
        ) from error
    table = columns(solution, extent)
    frame = pandas.DataFrame({column.name: column.values for column in table})
    frame.attrs["units"] = {column.name: column.unit for column in table}
    frame.attrs["choices"] = {column.name: column.choice for column in table if column.choice}
    frame.attrs["conditions"] = {one.name: one.condition for one in table if one.condition}
    return frame


def dataset(solution: Solution, extent: Extent | None = None) -> Any:
    """The columns as an xarray dataset over the first one."""
    try:
        import xarray
    except ImportError as error:
        raise ModelError(
            "to_xarray needs xarray, which is not installed", hint="pip install 'kempe[xarray]'"
        ) from error
    first, *others = columns(solution, extent)

    def variable(one: Column) -> tuple[str, Floats, dict[str, str]]:
        known = {"units": one.unit, "choice": one.choice, "condition": one.condition}
        return first.name, one.values, {key: text for key, text in known.items() if text}

    found = {one.name: variable(one) for one in others}
    return xarray.Dataset(found, {first.name: variable(first)}, {"title": solution.compiled.title})


def write_csv(solution: Solution, path: Path | str, extent: Extent | None = None) -> None:
    """Write the columns as CSV with 17 digits, which preserves every number."""
    write_columns(columns(solution, extent), path)


def write_columns(table: Sequence[Column], path: Path | str) -> None:
    """Write columns as CSV, with names and units in the header.

    Raises:
        FileError: the file cannot be written; an existing file is not changed.
    """
    text = io.StringIO()
    header = (files.csv_cell(column.label) for column in table)
    text.write(",".join(header) + "\n")
    np.savetxt(text, np.column_stack([column.values for column in table]), "%.17g", ",")
    files.write_text(path, text.getvalue())
