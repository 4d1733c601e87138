"""The linkages that synthesis found, best first."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, overload

import numpy as np

from kempe.base.arguments import explain_methods
from kempe.errors import KempeError, ModelError
from kempe.sweeps.asked import plan_of
from kempe.synthesis.candidate import Candidate
from kempe.synthesis.tasks import Complexes, Pose


@dataclass(frozen=True)
class Followed:
    """The complex solutions that a search through nine points followed to their ends.

    Attributes:
        paths: those that start, as many as theory gives. Cognates are not counted.
        found: different ends; if there are as many as starts, none is missing.
        again: those that were lost at first, and followed again with smaller steps; none if so many
            were lost that the points are special.
        real: ends that are real four-bars.
    """

    paths: int
    found: int
    again: int
    real: int


@explain_methods
class Found(Sequence[Candidate]):
    """Candidates, best first.

    Exact candidates come first, then those whose crank turns fully with a transmission angle of
    45° or the largest one, then small ones.

    Attributes:
        complete: whether all solutions are known to be found.
        excluded: the number of candidates left out because of each defect or limit.
        task: places of the point in the task, complex x + iy.
        poses: the poses of the task; None for other tasks.
        followed: numbers of complex solutions of nine points; None for other tasks.
    """

    def __init__(
        self,
        candidates: Sequence[Candidate],
        complete: bool,
        excluded: Mapping[str, int],
        task: Complexes,
        poses: Sequence[Pose] | None = None,
        *,
        followed: Followed | None = None,
    ) -> None:
        self._candidates = tuple(candidates)
        self.complete = complete
        self.excluded = MappingProxyType(dict(excluded))
        self.task, self.poses, self.followed = task, poses, followed

    @overload
    def __getitem__(self, k: int) -> Candidate: ...
    @overload
    def __getitem__(self, k: slice) -> Sequence[Candidate]: ...
    def __getitem__(self, k: int | slice) -> Candidate | Sequence[Candidate]:
        if isinstance(k, int) and not -len(self) <= k < len(self):
            raise IndexError(f"no candidate {k} in {self!r}; defects='tell' keeps all")
        return self._candidates[k]

    def __len__(self) -> int:
        return len(self._candidates)

    def __iter__(self) -> Iterator[Candidate]:
        return iter(self._candidates)

    def ranked(self, column: str) -> Found:
        """The candidates by a column of sweeps of their cases, least first.

        Candidates whose motion fails, or without a value, come last.

        Args:
            column: such as ``"drive.effort.peak"`` or ``"A.force.max"``.

        Raises:
            ModelError: there is no such column.
        """
        values = self.values(column)
        order = np.argsort(np.where(np.isfinite(values), values, np.inf), kind="stable")
        kept = [self._candidates[k] for k in order]
        return Found(
            kept, self.complete, self.excluded, self.task, self.poses, followed=self.followed
        )

    def values(self, column: str) -> list[float]:
        """A column of sweeps for each candidate; NaN where its motion fails."""
        found, wrong = [], None
        for candidate in self:
            try:
                found.append(_read(candidate, column))
            except ModelError as error:
                wrong = error
                found.append(np.nan)
            except KempeError:
                found.append(np.nan)
        if wrong is not None and not np.isfinite(found).any():
            raise wrong
        return found

    @property
    def table(self) -> Any:
        """The candidates as a data frame; needs pandas."""
        import pandas

        return pandas.DataFrame(self._rows())

    def _rows(self) -> list[dict[str, Any]]:
        rows = []
        for one in self:
            row: dict[str, Any] = {"error": one.error, "type": one.type}
            row |= {f"{name} [m]": x for name, x in one.lengths.items()}
            for name, (x, y) in one.points.items():
                row |= {f"{name}.x [m]": x, f"{name}.y [m]": y}
            row["transmission_angle [deg]"] = np.degrees(one.transmission_angle)
            rows.append(row | {"defects": "; ".join(one.defects)})
        return rows

    def text(self) -> str:
        """The candidates as CSV."""
        rows, out = self._rows(), io.StringIO()
        if rows:
            writer = csv.DictWriter(out, list(rows[0]), lineterminator="\n")
            writer.writeheader()
            writer.writerows(rows)
        return out.getvalue()

    def __repr__(self) -> str:
        told = f"{len(self)} candidate{'' if len(self) == 1 else 's'}"
        told += "; there are no others" if self.complete and not self.excluded else ""
        left = ", ".join(f"{count} by {kind}" for kind, count in self.excluded.items())
        told += f"; excluded: {left}" if left else ""
        if self.followed is not None:
            told += f"; {self.followed.found} of {self.followed.paths} complex solutions found"
        return f"<Found: {told}>"


def ended_early(error: BaseException, result: Found | None) -> BaseException:
    """The exception that ended a search, such as KeyboardInterrupt, with what was found so far."""
    error.result = result  # type: ignore[attr-defined]
    return error


def _read(candidate: Candidate, column: str) -> float:
    plan = plan_of(candidate.case, {"measures": [column], "analysis": None}, ())
    return plan.read(np.zeros(0))[0][0]
