"""``kp.compare``: a solution beside another one, or beside a table of values."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np

from kempe.base.arguments import explain_methods, explained
from kempe.base.arrays import Floats, fixed
from kempe.base.display_units import display
from kempe.base.names import few
from kempe.errors import ModelError
from kempe.model.measure_infos import measure_info
from kempe.model.values import instance, mapping, texts
from kempe.results import quantities as quantities_by_name
from kempe.results.fine import jumps
from kempe.results.motion import Motion
from kempe.results.quantities import values_of
from kempe.results.solution import Solution
from kempe.results.table import Extent, column_names
from kempe.sweeps.fits.data import Data, headers, is_empty, read_table

#: Times count as equal within this fraction of the largest time.
_SAME = 1e-12
#: Part of the largest value of a unit below which values are small.
_NOISE = 1e-6


@dataclass(frozen=True)
class Compared:
    """A quantity of both, at the times of the reference within the motion.

    Attributes:
        t: the times, (n,).
        found: its values in the solution, in SI units and rad. Where the solution jumps, the
            nearer one of both values.
        reference: its values in the reference.
        unit: its SI unit.
    """

    t: Floats
    found: Floats
    reference: Floats
    unit: str

    @property
    def difference(self) -> Floats:
        """The solution minus the reference, (n,)."""
        return self.found - self.reference


@explain_methods
class Comparison:
    """The differences of a solution and a reference.

    Attributes:
        largest: the largest magnitude of the difference by quantity, in SI units and rad.
        relative: the same as a fraction of the largest magnitude in the reference, or of 1e-6 of
            the largest one of all quantities with the same unit if this is more.
        at: the time of the largest difference, by quantity.
        quantities: both courses by quantity; see ``Compared``.
        unread: what was not compared, in words: columns that are not quantities, and times outside
            of the motion.
    """

    def __init__(
        self,
        solution: Solution,
        quantities: Mapping[str, Compared],
        unread: Sequence[str],
    ) -> None:
        self.solution = solution
        self.quantities = MappingProxyType(dict(quantities))
        self.unread = tuple(unread)
        sizes = {name: np.abs(one.difference) for name, one in quantities.items()}
        most = {name: int(np.argmax(of)) for name, of in sizes.items()}
        largest = {name: float(of[most[name]]) for name, of in sizes.items()}
        scales = _scales(quantities)
        self.largest: Mapping[str, float] = MappingProxyType(largest)
        self.relative: Mapping[str, float] = MappingProxyType(
            {name: _share(of, scales[name]) for name, of in largest.items()}
        )
        self.at: Mapping[str, float] = MappingProxyType(
            {name: float(one.t[most[name]]) for name, one in quantities.items()}
        )

    def table(self) -> tuple[list[str], list[list[str]]]:
        """Header and rows: quantity, largest difference, its time, and its fraction."""
        of = self.solution.variable
        first = display(of.unit)
        rows = []
        for name, one in self.quantities.items():
            shown = display(one.unit)
            size = f"{self.largest[name] / shown.divisor:.3g} {shown.unit}".rstrip()
            when = f"{self.at[name] / first.divisor:g} {first.unit}"
            rows.append([name, size, when, f"{self.relative[name]:.1e}"])
        return ["quantity", "largest difference", f"at {of.name}", "of the largest value"], rows

    def __str__(self) -> str:
        header, rows = self.table()
        widths = [max(map(len, column)) for column in zip(header, *rows, strict=True)]
        lines = [
            "  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip()
            for row in (header, *rows)
        ]
        return "\n".join([*lines, *(f"not compared: {text}" for text in self.unread)])

    def __repr__(self) -> str:
        name = max(self.relative, key=lambda name: self.relative[name])
        told = f"{len(self.quantities)} quantities; largest difference {self.relative[name]:.1e}"
        return f"<Comparison: {told} of the largest value, of {name}>"


@explained
def compare(
    solution: Solution,
    reference: Solution | Path | str | Mapping[str, Any] | Any,
    columns: Mapping[str, str] | None = None,
    *,
    t: str = "t",
    quantities: Sequence[str] | None = None,
) -> Comparison:
    """Compare a solution with another one, or with a table.

    The reference gives the times. The interpolant of the solution gives its values there.

    Args:
        solution: the solution; it needs its interpolant.
        reference: another solution; or a table: a CSV file, a data frame, or a mapping of headers
            to arrays. A unit in a header, such as ``rod.angle [deg]``, is converted.
        columns: headers by quantity, if the headers are not names of quantities:
            ``{"rod.angle": "phi [deg]"}``; a quantity may be an expression.
        t: header of the times; for a motion over a quantity, of its values.
        quantities: the quantities that are compared; by default all that both have.

    Raises:
        ModelError: nothing can be compared, or a header, a unit or a name is invalid.
        FileError: the file cannot be read.
    """
    instance(solution, Solution, "a solution, as kp.dynamics returns")
    if solution.dense is None or not len(solution.t):
        raise ModelError("solution: it has no interpolant", hint="use dense_output=True")
    asked = None if quantities is None else list(texts(quantities, "quantities"))
    unread: list[str] = []
    if isinstance(reference, Solution):
        given = _of_solution(solution, reference, asked)
    else:
        given = _of_table(solution, reference, (columns, t), asked, unread)
    found: dict[str, Compared] = {}
    motions = _Motions(solution)
    for name, (times, values) in given.items():
        inside = _inside(solution, times)
        if not inside.all():
            unread.append(f"{name} at {np.count_nonzero(~inside)} times outside of the motion")
        if not inside.any():
            continue
        both = times[inside], values[inside]
        of = _quantity(solution, name)
        own = _nearest(motions, of, *both)
        good = np.isfinite(own) & np.isfinite(both[1])
        if good.any():
            found[name] = Compared(both[0][good], own[good], both[1][good], of.unit)
        if not good.all():
            unread.append(f"{name} at {np.count_nonzero(~good)} times without a value")
    if not found:
        hint = "compute a motion that contains the times of the reference"
        told = "; ".join(["reference: there is nothing to compare", *unread])
        raise ModelError(told, hint=hint)
    return Comparison(solution, found, unread)


def _scales(quantities: Mapping[str, Compared]) -> dict[str, float]:
    """The magnitude by which the difference of each quantity is divided."""
    own = {name: float(np.abs(one.reference).max()) for name, one in quantities.items()}
    of_unit: dict[str, float] = {}
    for name, one in quantities.items():
        of_unit[one.unit] = max(own[name], of_unit.get(one.unit, 0.0))
    return {name: max(own[name], _NOISE * of_unit[of.unit]) for name, of in quantities.items()}


def _share(size: float, scale: float) -> float:
    return 0.0 if size == 0.0 else size / scale if scale > 0.0 else np.inf


class _Motions:
    """The motion of a solution at times; computed once for all quantities with these times."""

    def __init__(self, solution: Solution) -> None:
        self.solution = solution
        self._known: dict[bytes, Motion] = {}

    def at(self, t: Floats) -> Motion:
        return self._known.setdefault(t.tobytes(), self.solution(t))


@dataclass(frozen=True)
class _Quantity:
    """A quantity of a solution: a name, a measure or an expression.

    Attributes:
        unit: its SI unit.
        own: its values at the outputs.
        at: its values in a motion of the solution.
    """

    unit: str
    own: Callable[[], Floats]
    at: Callable[[Motion], Floats]


def _quantity(solution: Solution, name: str) -> _Quantity:
    """A quantity by name.

    Raises:
        ModelError: there is no such quantity, and it is not an expression of them.
    """
    compiled = solution.compiled
    try:
        info = compiled.measures.get(name) or measure_info(compiled, name)
    except ModelError as error:
        try:
            named = quantities_by_name.named(solution, name)
        except ModelError:
            raise error from None
        at = partial(quantities_by_name.named, name=name)
        return _Quantity(named.unit, named.read, lambda motion: at(motion).read())
    if not info.quantities:
        raise ModelError(f"{name}: it is not a quantity of the mechanism", name=name)

    def read(motion: Motion) -> Floats:
        return values_of(motion, info, solution.energy_at(motion.t) if info.is_of_run else None)

    return _Quantity(info.unit, lambda: values_of(solution, info), read)


def _of_solution(
    solution: Solution, reference: Solution, asked: list[str] | None
) -> dict[str, tuple[Floats, Floats]]:
    """Times and values of the quantities of another solution."""
    if solution.variable != reference.variable:
        pair = f"{solution.variable.name} and {reference.variable.name}"
        raise ModelError(f"reference: the motions go over different quantities, {pair}")
    if asked is None:
        known = set(column_names(solution, Extent()))
        asked = [name for name in column_names(reference, Extent()) if name in known]
    if not asked:
        raise ModelError("reference: the solutions have no quantity in common")
    for name in asked:
        own, other = _quantity(solution, name).unit, _quantity(reference, name).unit
        if own != other:
            pair = f"{own or 'no unit'} in the solution, {other or 'no unit'} in the reference"
            raise ModelError(f"{name}: its units differ: {pair}", name=name)
    return {name: (reference.t, _quantity(reference, name).own()) for name in asked}


def _of_table(
    solution: Solution,
    table: Any,
    how: tuple[Mapping[str, str] | None, str],
    asked: list[str] | None,
    unread: list[str],
) -> dict[str, tuple[Floats, Floats]]:
    """Times and values of the columns of a table."""
    columns, t = how
    table = read_table(_with_units(table))
    chosen = dict(mapping(columns or {}, "columns", "{'rod.angle': 'phi [deg]'}"))
    if not chosen:
        for name, header in headers(table, t).items():
            if asked is not None and name not in asked:
                continue
            if asked is None and is_empty(table, header):
                unread.append(f"column {header!r}, which has no values")
            elif _is_quantity(solution, name):
                chosen[name] = header
            else:
                unread.append(f"column {header!r}, which is not a quantity of the mechanism")
    for name in asked or ():
        if name not in chosen:
            raise ModelError(f"quantities: the table has no column of {name}", name=name)
    if not chosen:
        raise ModelError(
            f"reference: no header is a quantity of the mechanism: {few(headers(table, t))}",
            hint='columns={"rod.angle": "phi [deg]"} gives the quantity of a header',
        )
    data = Data(table, t, chosen)
    units = {name: _quantity(solution, name).unit for name in chosen}
    data.check(units, solution.variable.unit)
    unread += [f"{name} in {n} rows without a value" for name, n in data.missing.items() if n]
    return {name: (data.t[name], data.values[name]) for name in chosen}


def _with_units(table: Any) -> Any:
    """A data frame of kempe has the units of its columns beside them."""
    units = getattr(table, "attrs", {}).get("units") if hasattr(table, "columns") else None
    if not isinstance(units, Mapping):
        return table
    named = {f"{name} [{units[name]}]" if units.get(name) else name: name for name in table.columns}
    return {header: table[name] for header, name in named.items()}


def _is_quantity(solution: Solution, name: str) -> bool:
    try:
        _quantity(solution, name)
    except ModelError:
        return False
    return True


def _inside(solution: Solution, t: Floats) -> Any:
    low, high = sorted((solution.t[0], solution.t[-1]))
    slack = _SAME * max(abs(low), abs(high))
    return (t >= low - slack) & (t <= high + slack)


def _nearest(motions: _Motions, of: _Quantity, t: Floats, reference: Floats) -> Floats:
    """Values of a quantity at times; where it jumps, the nearer ones of those on both sides."""
    found, solution = np.array(of.at(motions.at(t))), motions.solution
    at = jumps(solution.t)
    if len(at):
        own = of.own()
        slack = _SAME * max(abs(solution.t[0]), abs(solution.t[-1]))
        for row in at:
            here = np.abs(t - solution.t[row]) <= slack
            for side in (own[row - 1], own[row]):
                nearer = here & (np.abs(side - reference) < np.abs(found - reference))
                found[nearer] = side
    return fixed(found)
