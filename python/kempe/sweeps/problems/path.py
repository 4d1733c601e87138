"""``kp.Path``: the distance of a point of a body from given points."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from kempe.base.arguments import Explained
from kempe.base.arrays import Floats, fixed
from kempe.errors import ModelError
from kempe.model.values import refuse
from kempe.results.solution import Solution

if TYPE_CHECKING:
    from kempe.sweeps.plan import Plan

#: Instants at which the nearest place of a curve is looked for, and steps of its refinement.
_INSTANTS, _STEPS = 400, 12


class Path(metaclass=Explained):
    """An objective: the root mean square distance of a point from given points, m.

    Args:
        points: the points, (n, 2), m.
        of: the point that should pass through them, such as ``"coupler.P"``.
        angles: the value of the quantity over which the analysis runs, or the time, at which the
            point should be there, for each point; None means the distance from its curve.

    Raises:
        ModelError: the arguments have other shapes, or numbers that are not finite.
    """

    def __init__(
        self, points: Sequence[Sequence[float]], of: str, angles: Sequence[float] | None = None
    ) -> None:
        self.points = fixed(_numbers(points, "points"))
        if self.points.ndim != 2 or self.points.shape[1:] != (2,) or not len(self.points):
            refuse("points", f"shape {self.points.shape}; must be (n, 2)")
        if not isinstance(of, str) or "." not in of:
            refuse("of", f"{of!r}; must be a point of a body such as 'coupler.P'")
        self.of = of
        self.angles = None if angles is None else fixed(_numbers(angles, "angles"))
        if self.angles is not None and self.angles.shape != (len(self.points),):
            refuse("angles", f"shape {self.angles.shape}; must be ({len(self.points)},)")

    @classmethod
    def read(cls, of: Any) -> Path:
        """The path in a section of a file."""
        return cls(of["points"], of["of"], of.get("angles"))

    def tree(self) -> dict[str, Any]:
        """The path as in a file."""
        angles = {} if self.angles is None else {"angles": self.angles.tolist()}
        return {"points": self.points.tolist(), "of": self.of, **angles}

    @property
    def measures(self) -> list[str]:
        """The coordinates of the point."""
        return [f"{self.of}.x", f"{self.of}.y"]

    @property
    def size(self) -> int:
        """The number of residuals."""
        return 2 * len(self.points)

    def residuals(self, plan: Plan, row: Floats) -> tuple[Floats, Floats]:
        """Differences whose mean square is the square of the distance, and their derivatives.

        Returns:
            (2 n,) m, divided by √n; (2 n, n_variables).

        Raises:
            KempeError: the run fails, or does not reach an angle.
        """
        times, along = self._times(plan, row)
        places, slopes = plan.slopes_at(self.measures, times, row)
        apart = places - self.points
        # within the motion, the nearest place moves along the curve, which changes nothing
        across = np.eye(2) - along[:, :, None] * along[:, None, :]
        apart = np.einsum("kij,kj->ki", across, apart)
        slopes = np.einsum("kij,kjn->kin", across, slopes)
        share = 1.0 / np.sqrt(len(self.points))
        return share * apart.ravel(), share * slopes.reshape(-1, slopes.shape[-1])

    def _times(self, plan: Plan, row: Floats) -> tuple[Floats, Floats]:
        """When the point should be at each place, and the direction in which it may move there."""
        if self.angles is not None:
            return self.angles, np.zeros_like(self.points)
        found = plan.run(row)
        if not isinstance(found, Solution):
            raise ModelError(f"{self.of}: a path needs a motion", hint="choose another analysis")
        return _nearest(found, self.of, self.points)


def _nearest(solution: Solution, of: str, points: Floats) -> tuple[Floats, Floats]:
    """The times at which a point is nearest to each place, and its direction of motion there.

    The direction is zero at the ends of the motion and where the point rests.
    """
    body, name = of.rsplit(".", 1)
    t = np.linspace(float(solution.t[0]), float(solution.t[-1]), _INSTANTS)
    t = np.unique(np.concatenate([solution.t, t]))

    def approach(at: Floats) -> tuple[Floats, Floats]:
        """Half the rate of the squared distance at a time for each place, and the velocity."""
        point = solution(at)[body].point(name)
        return ((point.position - points) * point.velocity).sum(axis=1), point.velocity

    apart = solution(t)[body].point(name).position[:, None] - points[None]
    best = np.argmin((apart**2).sum(axis=2), axis=0)
    low, high, at = t[np.maximum(best - 1, 0)], t[np.minimum(best + 1, len(t) - 1)], t[best]
    below, above = approach(low)[0], approach(high)[0]
    inside = (below < 0.0) & (above > 0.0)
    for _ in range(_STEPS):  # false position; the end that stays counts half
        share = np.divide(above, above - below, out=np.zeros_like(at), where=inside)
        at = np.where(inside, high - share * (high - low), at)
        rate, _ = approach(at)
        left, right = inside & (rate < 0.0), inside & (rate >= 0.0)
        low, below = (
            np.where(left, at, low),
            np.where(left, rate, np.where(right, below / 2, below)),
        )
        high, above = (
            np.where(right, at, high),
            np.where(right, rate, np.where(left, above / 2, above)),
        )
    velocity = approach(at)[1]
    speed = np.hypot(*velocity.T)
    moving = inside & (speed > 0.0)
    along = np.zeros_like(points)
    along[moving] = velocity[moving] / speed[moving, None]
    return at, along


def _numbers(values: Any, path: str) -> Floats:
    try:
        found = np.asarray(values, dtype=np.float64)
    except (TypeError, ValueError):
        refuse(path, f"{values!r}; must be numbers, in SI units and rad")
    if not np.isfinite(found).all():
        refuse(path, "a number is not finite")
    return found
