"""The tables of a solution: data frames, datasets and files."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from kempe.base.exports import write_mat, write_parquet
from kempe.results.table import Extent, columns, dataframe, dataset, write_csv
from kempe.results.views.frames import Frame

if TYPE_CHECKING:
    import pandas

    from kempe.results.solution import Solution


class Tables:
    """A solution as a table of all its quantities."""

    def _solution(self) -> Solution:
        return self  # type: ignore[return-value]

    def to_dataframe(
        self,
        *,
        frames: Sequence[Frame] = ("global",),
        points: Sequence[str] | bool = (),
        index: bool = False,
    ) -> pandas.DataFrame:
        """A pandas data frame with a column for each quantity, such as ``rocker.angle``.

        Values are in the units chosen by ``kp.units``; ``attrs["units"]`` contains the units.

        Args:
            frames: frames of the reactions, as in ``to_csv``.
            points: points whose paths are columns, as in ``to_csv``.
            index: whether the time or driven quantity is the index instead of the first column.

        Raises:
            ModelError: pandas is not installed, or there is no such frame or point.
        """
        found = dataframe(self._solution(), Extent(frames, points))
        return found.set_index(self._solution().variable.name) if index else found

    def to_xarray(
        self, *, frames: Sequence[Frame] = ("global",), points: Sequence[str] | bool = ()
    ) -> Any:
        """An xarray ``Dataset`` over the time or driven quantity; see ``to_dataframe``.

        Each variable has the attributes of its column: ``units``, and ``choice`` and ``condition``
        where the value has one.

        Raises:
            ModelError: xarray is not installed, or there is no such frame or point.
        """
        return dataset(self._solution(), Extent(frames, points))

    def to_csv(
        self,
        path: Path | str,
        *,
        frames: Sequence[Frame] = ("global",),
        points: Sequence[str] | bool = (),
    ) -> None:
        """Write all quantities as CSV, one line per time, with units in the header.

        Values are in the units chosen by ``kp.units``. Each column name is valid in ``sol[name]``.

        Args:
            path: the file.
            frames: frames in which reactions on each moving body are written: "global", "body",
                "joint"; none to leave them out.
            points: points whose paths are written, such as ``["coupler.P"]``; True for all named
                points of moving bodies.

        Raises:
            FileError: the file cannot be written; an existing file is not changed.
            ModelError: there is no such frame or point.
        """
        write_csv(self._solution(), path, Extent(frames, points))

    def to_parquet(
        self,
        path: Path | str,
        *,
        frames: Sequence[Frame] = ("global",),
        points: Sequence[str] | bool = (),
    ) -> None:
        """Write all quantities as a Parquet file; see ``to_csv``.

        The unit of a column is its metadata ``unit``.

        Raises:
            ModelError: pyarrow is not installed, or there is no such frame or point.
            FileError: the file cannot be written; an existing file is not changed.
        """
        table = columns(self._solution(), Extent(frames, points))
        write_parquet(path, [(one.name, one.unit, one.values) for one in table])

    def to_mat(
        self,
        path: Path | str,
        *,
        frames: Sequence[Frame] = ("global",),
        points: Sequence[str] | bool = (),
    ) -> None:
        """Write all quantities as a ``.mat`` file of MATLAB; see ``to_csv``.

        A variable such as ``rod_angle`` contains a quantity. The cell arrays ``variables``,
        ``names`` and ``units`` give the name and the unit of each.

        Raises:
            ModelError: SciPy is not installed, or there is no such frame or point.
            FileError: the file cannot be written; an existing file is not changed.
        """
        table = columns(self._solution(), Extent(frames, points))
        write_mat(path, [(one.name, one.unit, one.values) for one in table], {})
