"""The result of a gradient: measures, variables, derivatives and remarks."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from math import isfinite
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np

from kempe._upwards import CALLS
from kempe.base import files
from kempe.base.arguments import explain_methods
from kempe.base.arrays import Floats, fixed
from kempe.base.display_units import Shown, display
from kempe.base.names import entry, few
from kempe.errors import ModelError

if TYPE_CHECKING:
    from kempe.sweeps.plan import Plan


@dataclass(frozen=True)
class Slope:
    """One derivative, in display units.

    Attributes:
        measure: the text of the measure.
        variable: the name of the variable.
        value: the derivative; NaN if there is none.
        unit: its unit.
        relative: relative change of the measure divided by that of the variable.
        remark: why there is no derivative, or why it is inaccurate; often empty.
    """

    measure: str
    variable: str
    value: float
    unit: Shown
    relative: float
    remark: str


@explain_methods
class Gradient:
    """The derivatives of measures with respect to variables.

    Attributes:
        measures: the measures by their texts, in SI units and rad.
        variables: the values of the variables by name, in the order given, in SI units and rad.
        jacobian: the derivatives, (n_measures, n_variables), in SI units and rad; NaN where there
            is none.
        hessian: the second derivatives, (n_measures, n_variables, n_variables), with ``second``;
            None without. NaN where there is none.
        units: SI units of measures and variables; empty for an unknown one.
        remarks: why a derivative does not exist, or is inaccurate, by measure and variable.
    """

    def __init__(
        self,
        plan: Plan,
        row: Floats,
        found: tuple[Floats, Floats, Floats | None],
        remarks: Mapping[tuple[int, int], str],
    ) -> None:
        values, slopes, hessian = found
        texts = [one.text for one in plan.wanted]
        units = {name: plan.unit_of(name) for name in plan.names}
        units |= {one.text: "" if one.unit == "SI" else one.unit for one in plan.wanted}
        told = {(texts[k], plan.names[of]): text for (k, of), text in sorted(remarks.items())}
        self.measures: Mapping[str, float] = _view(zip(texts, values.tolist(), strict=True))
        self.variables: Mapping[str, float] = _view(zip(plan.names, row.tolist(), strict=True))
        self.jacobian = fixed(slopes)
        self.hessian: Floats | None = None if hessian is None else fixed(hessian)
        self.units: Mapping[str, str] = _view(units)
        self.remarks: Mapping[tuple[str, str], str] = _view(told)

    def __getitem__(self, pair: tuple[str, str]) -> float:
        """The derivative of a measure with respect to a variable, in SI units and rad.

        Raises:
            ModelError: there is no such measure or variable.
        """
        given: object = pair
        if not isinstance(given, tuple) or len(given) != 2:
            first, second = next(iter(self.measures)), next(iter(self.variables))
            raise ModelError(
                f"{given!r} is not a measure and a variable", hint=f"write g[{first!r}, {second!r}]"
            )
        return float(self.jacobian[self._place(*given)])

    def _place(self, measure: str, variable: str) -> tuple[int, int]:
        rows = {name: k for k, name in enumerate(self.measures)}
        columns = {name: k for k, name in enumerate(self.variables)}
        return entry("measure", measure, rows), entry("variable", variable, columns)

    def unit(self, measure: str, variable: str) -> str:
        """The SI unit of a derivative, such as ``N/m``.

        An unknown unit is written as the name in brackets: ``N/[k]`` is N per unit of k.

        Raises:
            ModelError: there is no such measure or variable.
        """
        self._place(measure, variable)
        return self._shown(measure, variable, Shown).unit

    @property
    def table(self) -> Any:
        """The derivatives: a row for each measure, a column for each variable.

        A pandas data frame, or a structured array if pandas is not installed. Its numbers have the
        units of ``kp.units``; ``attrs["units"]`` or ``dtype.metadata["units"]`` has those of
        measures and variables. The same mappings have ``remarks``.
        """
        values = [each.value for each in self.slopes()]
        units = {name: display(unit).unit for name, unit in self.units.items()}
        return self._tabulated(values, units)

    @property
    def relative(self) -> Any:
        """The relative derivatives (dm/m)/(dp/p), as ``table``; NaN where a measure is 0."""
        return self._tabulated([each.relative for each in self.slopes()], {})

    def slopes(self) -> Iterator[Slope]:
        """All derivatives in the units of ``kp.units``, measure by measure."""
        for k, (measure, m) in enumerate(self.measures.items()):
            for of, (variable, p) in enumerate(self.variables.items()):
                slope = float(self.jacobian[k, of])
                unit = self._shown(measure, variable, display)
                relative = slope * p / m if m else float("nan")
                remark = self.remarks.get((measure, variable), "")
                yield Slope(measure, variable, slope / unit.divisor, unit, relative, remark)

    def ranked(self, measure: str) -> list[Slope]:
        """The derivatives of a measure, the largest relative ones first, those without one last.

        Raises:
            ModelError: there is no such measure.
        """
        entry("measure", measure, self.measures)
        own = (one for one in self.slopes() if one.measure == measure)
        return sorted(own, key=lambda one: -abs(one.relative) if isfinite(one.relative) else 1.0)

    def _shown(self, measure: str, variable: str, shown: Any) -> Shown:
        """The unit of a derivative, of the units that ``shown`` gives for those in SI."""
        top, bottom = shown(self.units[measure]), shown(self.units[variable])
        above, below = top.unit or f"[{measure}]", bottom.unit or f"[{variable}]"
        if above == below:
            return Shown("1", top.divisor / bottom.divisor)
        if below == "1":
            return Shown(above, top.divisor / bottom.divisor)
        if below.endswith("^-1"):
            return Shown(f"{above}*{below[:-3]}", top.divisor / bottom.divisor)
        below = f"({below})" if bottom.unit and {"*", "/", "^"} & set(below) else below
        return Shown(f"{above}/{below}", top.divisor / bottom.divisor)

    def _tabulated(self, values: list[float], units: Mapping[str, str]) -> Any:
        columns, rows = list(self.variables), list(self.measures)
        about = {"units": dict(units), "remarks": dict(self.remarks)}
        numbers = np.reshape(values, (len(rows), len(columns)))
        try:
            import pandas
        except ImportError:
            kinds = [("measure", object), *((name, np.float64) for name in columns)]
            found = np.empty(len(rows), np.dtype(kinds, metadata=about))
            found["measure"] = rows
            for name, column in zip(columns, numbers.T, strict=True):
                found[name] = column
            return found
        frame = pandas.DataFrame(numbers, index=rows, columns=columns)
        frame.attrs.update(about)
        return frame

    def to_csv(self, path: Path | str) -> None:
        """Write a row for each derivative as CSV with 17 digits, in the units of ``kp.units``.

        Raises:
            FileError: the file cannot be written; an existing file is not changed.
        """
        text = io.StringIO()
        write = csv.writer(text, lineterminator="\n").writerow
        write(["measure", "variable", "slope", "unit", "relative slope", "remark"])
        for one in self.slopes():
            numbers = ["" if np.isnan(x) else f"{x:.17g}" for x in (one.value, one.relative)]
            write([one.measure, one.variable, numbers[0], one.unit.unit, numbers[1], one.remark])
        files.write_text(path, text.getvalue())

    def __getstate__(self) -> dict[str, Any]:
        """What a copy in another process needs; views of mappings cannot be pickled."""
        return {
            name: dict(of) if isinstance(of, MappingProxyType) else of
            for name, of in vars(self).items()
        }

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(
            {name: _view(of) if isinstance(of, dict) else of for name, of in state.items()}
        )

    def _repr_html_(self) -> str:
        return str(CALLS["html"](self))

    def __repr__(self) -> str:
        measures = ", ".join(f"{text} = {value:.6g}" for text, value in self.measures.items())
        told = f"; {len(self.remarks)} remarks" if self.remarks else ""
        told = told.removesuffix("s") if len(self.remarks) == 1 else told
        return f"<Gradient of {measures} over {few(self.variables)}{told}>"


def _view(pairs: Any) -> Any:
    return MappingProxyType(dict(pairs))
