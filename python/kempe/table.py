"""All quantities of a solution as columns with names and units."""

from __future__ import annotations

import io
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from kempe import files
from kempe.arrays import Floats
from kempe.compiled import ACCELERATIONS, COORDINATES, RATES
from kempe.errors import ModelError

if TYPE_CHECKING:
    import pandas

    from kempe.solution import Solution

#: Units of coordinates, rates and accelerations of a body.
_UNITS = (("m", "m", "rad"), ("m/s", "m/s", "rad/s"), ("m/s^2", "m/s^2", "rad/s^2"))
_ENERGIES = ("kinetic", "potential", "dissipated", "work", "total")
#: A multiplier times its residual is an energy, so its unit is J per unit of the residual.
_MULTIPLIER_UNITS = {"m": "N", "rad": "N*m"}


@dataclass(frozen=True)
class Column:
    """One quantity over time.

    Attributes:
        name: such as ``rocker.angle``.
        unit: such as ``rad``.
        values: (n_t,).
    """

    name: str
    unit: str
    values: Floats


def columns(solution: Solution) -> list[Column]:
    """Time, coordinates, multipliers, first-order states, torques and energies."""
    table = [Column("t", "s", solution.t)]
    for name in solution.model.bodies:
        body = solution.body(name)
        for quantity, unit in _quantities(body.info.count):
            table.append(Column(f"{name}.{quantity}", unit, getattr(body, quantity)))
    table += _internal(solution)
    rows = zip(solution.model.row_names(), solution.model.row_units(), strict=True)
    for k, (name, unit) in enumerate(rows):
        constraint, _, equation = name.rpartition(".")
        label = f"{constraint}.lambda_{equation}"
        table.append(Column(label, _MULTIPLIER_UNITS.get(unit, f"J/{unit}"), solution.lam[:, k]))
    states = zip(solution.model.state_names(), solution.model.state_units(), strict=True)
    for k, (name, unit) in enumerate(states):
        table.append(Column(name, unit, solution.z[:, k]))
    for info in solution.model.forces.values():
        torque = solution.force(info.name).torque(on=info.j)
        table.append(Column(f"{info.name}.torque_on_{info.j}", "N*m", torque))
    for name in _ENERGIES:
        table.append(Column(f"energy.{name}", "J", getattr(solution.energy, name)))
    return table


def _quantities(count: int) -> list[tuple[str, str]]:
    """Coordinates, rates and accelerations of a body with so many coordinates, with units."""
    families = (COORDINATES, RATES, ACCELERATIONS)
    return [
        pair
        for names, units in zip(families, _UNITS, strict=True)
        for pair in zip(names[:count], units[:count], strict=True)
    ]


def _internal(solution: Solution) -> list[Column]:
    """Internal coordinates of joints and their rates."""
    found = []
    for info in solution.model.constraints.values():
        first = info.columns.start
        for k, (name, unit) in enumerate(info.coordinates, first):
            found.append(Column(f"{info.name}.{name}", unit, solution.q[:, k]))
            found.append(Column(f"{info.name}.{name}_rate", f"{unit}/s", solution.v[:, k]))
    return found


def dataframe(solution: Solution) -> pandas.DataFrame:
    """The columns as a pandas data frame; units in ``attrs["units"]``."""
    try:
        import pandas
    except ImportError as error:
        raise ModelError(
            "to_dataframe needs pandas, which is not installed", hint="pip install pandas"
        ) from error
    table = columns(solution)
    frame = pandas.DataFrame({column.name: column.values for column in table})
    frame.attrs["units"] = {column.name: column.unit for column in table}
    return frame


def write_csv(solution: Solution, path: Path | str) -> None:
    """Write the columns as CSV with 17 digits, which preserves every number."""
    table = columns(solution)
    text = io.StringIO()
    text.write(",".join(_quoted(f"{column.name} [{column.unit}]") for column in table) + "\n")
    np.savetxt(text, np.column_stack([column.values for column in table]), "%.17g", ",")
    files.write_text(path, text.getvalue())


def _quoted(text: str) -> str:
    """A field of a CSV file (RFC 4180)."""
    return '"' + text.replace('"', '""') + '"' if set(text) & set(',"\n') else text
