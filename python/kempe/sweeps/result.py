"""The result of a sweep: its table, and the replay of each row."""

from __future__ import annotations

import csv
import io
from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import cached_property
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from kempe._upwards import CALLS
from kempe.base import files
from kempe.base.arguments import explain_methods
from kempe.base.arrays import Floats, fixed
from kempe.base.display_units import units
from kempe.base.exports import write_mat
from kempe.base.names import entry
from kempe.errors import ModelError
from kempe.results.table import Column, column
from kempe.sweeps import remarked
from kempe.sweeps.plan import Plan
from kempe.sweeps.variables import Variable

if TYPE_CHECKING:
    from kempe.case import Case
    from kempe.results.result import Result
    from kempe.results.solution import Solution
    from kempe.sweeps.table import Table


#: Attributes that are computed again.
_CACHED = ("_by_name", "succeeded", "_tables", "choices", "unbounded", "remarks")


@explain_methods
class SweepResult:
    """The variants of a case: a row for each, in the order of the design.

    Attributes:
        variables: the variables, in the order of columns.
        measures: the texts of the measures, in the order of columns.
        units: SI units of all columns; empty for an unknown one.
        reasons: why a row failed, by its number.
    """

    def __init__(
        self, plan: Plan, variables: Sequence[Variable], design: Floats, table: Table
    ) -> None:
        self._plan = plan
        self.variables = tuple(variables)
        self.measures = tuple(one.text for one in plan.wanted)
        known = {variable.name: plan.unit_of(variable.name) for variable in variables}
        self.units: Mapping[str, str] = MappingProxyType(
            known | {one.text: one.unit for one in plan.wanted}
        )
        self.reasons: Mapping[int, str] = MappingProxyType(table.reasons)
        self._design, self._values = fixed(design), fixed(table.values)
        self._marks = table.marks

    def __len__(self) -> int:
        return len(self._design)

    @property
    def columns(self) -> tuple[str, ...]:
        """The names of the columns of numbers: variables, then measures."""
        return (*(variable.name for variable in self.variables), *self.measures)

    @cached_property
    def choices(self) -> Mapping[str, str]:
        """The measures that read reactions which are not unique; see ``Measure.choice``."""
        return remarked.choices(self)

    @cached_property
    def unbounded(self) -> Mapping[str, tuple[int, ...]]:
        """The rows in which a measure has no bound, by its text; see ``Measure.unbounded_at``.

        These variants pass a singular position beside which the measure has no bound. Extreme
        values exclude the values there; integrals and means include them. Final values are not
        marked.
        """
        return remarked.unbounded(self)

    @cached_property
    def remarks(self) -> Mapping[str, str]:
        """The remarks on measures, by their texts; a measure without a remark is not in it.

        A remark is ``minimum norm`` if redundant constraints leave a reaction open,
        ``second-order load left out`` if joints keep a coordinate only to second order, ``middle of
        friction at rest`` if drivers hold friction at rest, ``one way to share the load`` if
        contacts and friction at rest share it, and ``without bound in 2 of 16 variants`` if so many
        of the variants that succeeded are in ``unbounded``; or both, with a comma. Remarks have no
        unit. Their source is ``Measure.choice`` and ``Measure.unbounded_at`` of each variant.
        """
        return remarked.remarks(self)

    def __getitem__(self, column: str) -> Floats:
        """A column, (n,): NaN in the measures of rows that failed.

        Raises:
            ModelError: there is no such column.
        """
        return entry("column", column, self._by_name)

    @cached_property
    def _by_name(self) -> Mapping[str, Floats]:
        all_columns = (*self._design.T, *self._values.T)
        return dict(zip(self.columns, map(fixed, all_columns), strict=True))

    @cached_property
    def succeeded(self) -> NDArray[np.bool_]:
        """Whether each variant succeeded, (n,)."""
        found = np.ones(len(self), dtype=bool)
        found[list(self.reasons)] = False
        return found

    @property
    def table(self) -> Any:
        """Variables by name, measures by text, and ``reason``, which is empty in most rows.

        A pandas data frame, or a structured array if pandas is not installed. Its numbers have the
        units of ``kp.units``, which are in ``attrs["units"]`` or ``dtype.metadata["units"]``. The
        same mappings have ``remarks``, a dict.
        """
        chosen = units().chosen
        if chosen not in self._tables:
            self._tables[chosen] = self._tabulated()
        return self._tables[chosen]

    @cached_property
    def _tables(self) -> dict[tuple[str, ...], Any]:
        """The table for each choice of units."""
        return {}

    def _tabulated(self) -> Any:
        columns = self._shown()
        reasons = np.full(len(self), "", dtype=object)
        for k, reason in self.reasons.items():
            reasons[k] = reason
        about = {
            "units": {each.name: each.unit for each in columns},
            "remarks": dict(self.remarks),
        }
        try:
            import pandas
        except ImportError:
            kinds = [*((each.name, np.float64) for each in columns), ("reason", object)]
            found = np.empty(len(self), np.dtype(kinds, metadata=about))
            for each in columns:
                found[each.name] = each.values
            found["reason"] = reasons
            return found
        values = {each.name: each.values for each in columns}
        frame = pandas.DataFrame({**values, "reason": reasons})
        frame.attrs.update(about)
        return frame

    def _shown(self) -> list[Column]:
        """The columns in the units of ``kp.units``."""
        of = ((name, column(name, self.units[name], self[name])) for name in self.columns)
        return [replace(one, choice=self.choices.get(name, "")) for name, one in of]

    def to_csv(self, path: Path | str) -> None:
        """Write the table as CSV with 17 digits, which preserves every number.

        If units were chosen by ``kp.units``, the header has them: ``L2 [mm]``.

        Raises:
            FileError: the file cannot be written; an existing file is not changed.
        """
        text, columns = io.StringIO(), self._shown()
        write = csv.writer(text, lineterminator="\n").writerow
        stated = bool(units().chosen)
        names = ((each.label if stated else remarked.labelled(self, each.name)) for each in columns)
        write([*names, "reason"])
        for k, row in enumerate(np.column_stack([each.values for each in columns]).tolist()):
            cells = ["" if np.isnan(x) else f"{x:.17g}" for x in row]
            write([*cells, self.reasons.get(k, "")])
        files.write_text(path, text.getvalue())

    def to_parquet(self, path: Path | str) -> None:
        """Write the table as a Parquet file.

        Raises:
            ModelError: pandas or pyarrow is not installed.
            FileError: the file cannot be written.
        """
        try:
            import pandas
            import pyarrow  # noqa: F401 - pandas writes with it
        except ImportError as error:
            raise ModelError(
                f"to_parquet needs pandas and pyarrow; {error.name} is not installed",
                hint="pip install pandas pyarrow, or use to_csv",
            ) from error
        table = self.table
        assert isinstance(table, pandas.DataFrame)
        with files.writing(files.checked_path(path, "write")) as file:
            table.to_parquet(file)

    def to_mat(self, path: Path | str) -> None:
        """Write the table as a ``.mat`` file of MATLAB, with the cell array ``reasons``.

        A variable such as ``C_force_max`` contains a column. The cell arrays ``variables``,
        ``names`` and ``units`` give the name and the unit of each.

        Raises:
            ModelError: SciPy is not installed.
            FileError: the file cannot be written; an existing file is not changed.
        """
        shown = [(one.name, one.unit, np.asarray(one.values, float)) for one in self._shown()]
        rows = len(shown[0][2]) if shown else 0
        reasons = tuple(self.reasons.get(k, "") for k in range(rows))
        write_mat(path, shown, {"reasons": reasons})

    def case(self, k: int) -> Case:
        """The case of a row, which can be run, drawn, saved and opened in the player.

        Raises:
            IndexError: there is no such row.
            ModelError: the model is impossible with these values.
        """
        return self._plan.variant(self._design[self._place(k)])

    def run(self, k: int) -> Solution | Result:
        """The result of the analysis of a row, computed again.

        Raises:
            IndexError: there is no such row.
            KempeError: it fails; the reason of the row is its message in one line.
        """
        return self._plan.run(self._design[self._place(k)])

    def _place(self, k: int) -> int:
        if not -len(self) <= k < len(self):
            raise IndexError(f"row {k}; the sweep has {len(self)}")
        return int(k)

    def __getstate__(self) -> dict[str, Any]:
        """What a copy in another process needs; views of mappings cannot be pickled."""
        state = {name: value for name, value in vars(self).items() if name not in _CACHED}
        return {**state, "units": dict(self.units), "reasons": dict(self.reasons)}

    def __setstate__(self, state: dict[str, Any]) -> None:
        views = {name: MappingProxyType(state[name]) for name in ("units", "reasons")}
        self.__dict__.update(state | views)

    def _repr_html_(self) -> str:
        return str(CALLS["html"](self))

    def __repr__(self) -> str:
        names = ", ".join(variable.name for variable in self.variables)
        told = f"{len(self)} variants over {names}; {len(self.reasons)} failed"
        measures = (
            f"{text} ({self.remarks[text]})" if text in self.remarks else text
            for text in self.measures
        )
        return f"<SweepResult: {told}; {', '.join(measures)}>"
