"""The region that a point reaches while two quantities vary."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from kempe.analyses.options import Reachable
from kempe.analyses.record import Progress, Record, run_analysis
from kempe.base.arguments import explained
from kempe.base.arrays import Floats, fixed
from kempe.model.model import Model, compiled_model
from kempe.model.values import Pairs, Words
from kempe.results.result import Result
from kempe.results.state import State
from kempe.results.table import Column

if TYPE_CHECKING:
    from kempe.model.compiled import CompiledModel

#: Number of values of each quantity, if none is given.
VALUES = 61


class ReachableResult(Result):
    """The region that a point reaches while two quantities vary within ranges.

    Attributes:
        of: the point, such as ``"hand.P"``.
        over: the two drivers or position quantities.
        points: (n_points, 2), the positions of the point for the values of both, m.
        boundary: the closed contours of the region, each (n, 2), m: its outer sides
            counterclockwise, and those of its holes clockwise.
        area: its area, m²; the error falls with the square of the number of values.
        complete: whether the motion met no limit within the ranges. Otherwise the region contains
            the positions up to the limits, and other ways may reach further ones.
        limit: the first limit that was met, in words; None without one.
    """

    kind = "reachable"

    def __init__(self, record: Record) -> None:
        findings, numbers = record.findings, record.numbers
        self._initial = record.initial
        self.of: str = findings["of"]
        self.over: tuple[str, ...] = tuple(findings["over"])
        self.area: float = findings["area"]
        self.complete: bool = findings["complete"]
        self.limit: str | None = findings["limit"]
        self.points: Floats = fixed(numbers["points"])
        contours, places = numbers["boundary"][:, 0], numbers["boundary"][:, 1:]
        self.boundary: tuple[Floats, ...] = tuple(
            fixed(places[contours == k]) for k in np.unique(contours)
        )

    @property
    def final(self) -> State:
        """The state at the start."""
        return self._initial

    def summary(self) -> dict[str, Any]:
        """The region as plain data, m and m²."""
        low, high = self.points.min(axis=0), self.points.max(axis=0)
        return {
            "type": self.kind,
            "of": self.of,
            "over": list(self.over),
            "area": self.area,
            "complete": self.complete,
            "limit": self.limit,
            "x": [float(low[0]), float(high[0])],
            "y": [float(low[1]), float(high[1])],
            "contours": len(self.boundary),
        }

    def report(self) -> list[str]:
        """The area of the region, its extent, and a limit within the ranges."""
        told = self.summary()
        lines = [
            f"{self.of} reaches {self.area:.6g} m² over {' and '.join(self.over)}",
            "x from {:.6g} to {:.6g} m, y from {:.6g} to {:.6g} m".format(*told["x"], *told["y"]),
        ]
        if self.limit is not None:
            lines.append(f"the motion meets limits within the ranges: {self.limit}")
        return lines

    def tables(self) -> Mapping[str, Sequence[Column]]:
        """``reachable``: the points; ``boundary``: the points of each contour."""
        numbers = [np.full(len(one), k, dtype=float) for k, one in enumerate(self.boundary, 1)]
        edges = np.concatenate([np.empty((0, 2)), *self.boundary])
        points = [Column(name, "m", self.points[:, k]) for k, name in enumerate("xy")]
        contours = [Column(name, "m", edges[:, k]) for k, name in enumerate("xy")]
        number = Column("contour", "", np.concatenate([np.empty(0), *numbers]))
        return {"reachable": points, "boundary": [number, *contours]}

    def __repr__(self) -> str:
        return f"<ReachableResult: {self.report()[0]}>"


@explained
def reachable(
    model: Model | CompiledModel,
    start: State,
    *,
    of: str,
    over: Words,
    ranges: Pairs,
    n: int = VALUES,
    progress: Progress | None = None,
) -> ReachableResult:
    """The region that a point reaches while two drivers or position quantities vary.

    The motion is followed from the start as by ``kinematics``: along the first quantity, and from
    each of its values along the second one. It ends at a limit within a range, such as a dead
    point. The region is the union of the triangles between neighbouring positions.

    Args:
        model: the mechanism. Drivers of other quantities keep their value at the start.
        start: an assembled state.
        of: a point of a body, such as ``"hand.P"``.
        over: two drivers, or position quantities such as ``["arm.angle", "hand.angle"]``.
        ranges: first and last value of each, in SI units and rad.
        n: number of values of each, both ends included.
        progress: called repeatedly with the value of the first quantity.

    Raises:
        ModelError: an argument is invalid, or the quantities do not determine the motion.
        SingularityError: the motion cannot be followed, although no limit was found.
        AssemblyError: the start does not satisfy the constraints.
    """
    entry = Reachable(of, over, ranges, n).tree()
    return ReachableResult(run_analysis(compiled_model(model), start, entry, progress))
