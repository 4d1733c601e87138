"""Six-bars near starts that fit a task: least squares of many starts side by side.

Unknowns are those of the linkage and the angles of its bodies at each position, so that a start
need not close. Gaps of the loops are residuals with a growing weight. The method is that of
Levenberg and Marquardt (Marquardt 1963) within bounds; the block of each position is eliminated
first.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from kempe.base.arrays import Floats
from kempe.synthesis.six_bar.topology import Term, Topology, solved
from kempe.synthesis.tasks import Complexes

#: The part of a step that shows its bend, and the largest bend as a part of it.
_PART, _BENT = 0.1, 0.75


@dataclass(frozen=True)
class Task:
    """What the positions of a six-bar must be, in units of the task.

    Attributes:
        family: its bodies.
        low, high: bounds of the unknowns of a linkage, (size,); equal if prescribed.
        places: of P, (n,); None for functions.
        crank: given angles of the crank, (n,), or None.
        arm: given angles of the arm, (n,), or None.
    """

    family: Topology
    low: Floats
    high: Floats
    places: Complexes | None = None
    crank: Floats | None = None
    arm: Floats | None = None

    @property
    def count(self) -> int:
        """Number of positions."""
        given = self.crank if self.places is None else self.places
        return 0 if given is None else len(given)

    def part(self, chosen: Any) -> Task:
        """Some of the positions."""
        given = (self.places, self.crank, self.arm)
        places, crank, arm = (None if of is None else of[chosen] for of in given)
        return replace(self, places=places, crank=crank, arm=arm)

    def residuals(
        self, linkage: Floats, angles: Floats, weight: float
    ) -> tuple[Floats, Floats, Floats]:
        """Residuals (n_linkages, n, r), slopes by the angles and by the linkage, (..., size)."""
        of, turned = self.family, np.exp(1j * angles)
        found, own, more = [], [], []
        sums: list[tuple[float, tuple[Term, ...], Any]]
        sums = [(weight, closure, None) for closure in of.closures]
        if self.places is not None:
            sums.append((1.0, of.places["P"], self.places))
        for factor, terms, wanted in sums:
            z = of.sum(terms, linkage, turned) - (0.0 if wanted is None else wanted)
            by_angles, by_linkage = of.slopes(terms, linkage, turned)
            for part in ("real", "imag"):
                found.append(factor * getattr(z, part))
                own.append(factor * getattr(by_angles, part))
                more.append(factor * getattr(by_linkage, part))
        for k, (body, given) in enumerate([(of.crank, self.crank), (of.arm, self.arm)]):
            if given is None:
                continue
            factor, offset, scale = weight if k == 0 else 1.0, of.angles + k, of.angles + 2 + k
            aim = linkage[:, offset, None] + linkage[:, scale, None] * given
            found.append(factor * np.angle(np.exp(1j * (angles[:, :, body] - aim))))
            own.append(np.zeros(angles.shape))
            own[-1][:, :, body] = factor
            more.append(np.zeros((*angles.shape[:2], of.size)))
            more[-1][:, :, offset] = -factor
            more[-1][:, :, scale] = -factor * given
        return np.stack(found, axis=2), np.stack(own, axis=2), np.stack(more, axis=2)


@dataclass(frozen=True)
class _Sum:
    """A sum of squares of starts.

    Attributes:
        task: what is fitted.
        weight: of the gaps.
        guard: for each start a weight, (n,), which keeps its determinant away from zero, and the
            sign, (n, n_positions), and the mean logarithm of this determinant, (n,).
    """

    task: Task
    weight: float
    guard: tuple[Floats, Floats, Floats]

    def residuals(self, linkage: Floats, angles: Floats, rows: Any) -> tuple[Floats, ...]:
        """As ``Task.residuals``; infinite where a position is beyond a dead point."""
        found, own, more = self.task.residuals(linkage, angles, self.weight)
        sign, log, by_angles, by_linkage = self.task.family.room(linkage, angles)
        share, signs, mean = (part[rows] for part in self.guard)
        with np.errstate(over="ignore", invalid="ignore"):
            far = share[:, None] * np.exp(mean[:, None] - log)
            slopes = [-far[:, :, None, None] * of[:, :, None] for of in (by_angles, by_linkage)]
        far = np.where(sign == signs, far, np.inf)
        parts = [(found, own, more), (far[:, :, None], *map(np.nan_to_num, slopes))]
        if self.task.crank is None:
            parts.append(self._order(angles, share))
        first, second, third = (np.concatenate(part, axis=2) for part in zip(*parts, strict=True))
        return first, second, third

    def _order(self, angles: Floats, share: Floats) -> tuple[Floats, Floats, Floats]:
        """Residuals that are infinite where the crank does not turn on to the next position.

        Those of a pair of positions belong to both, and their slopes to each of them.
        """
        crank, (count, n, bodies) = self.task.family.crank, angles.shape
        steps = np.diff(angles[:, :, crank], axis=1)
        mean = (angles[:, -1, crank] - angles[:, 0, crank])[:, None] / max(n - 1, 1)
        with np.errstate(all="ignore"):
            pairs = np.where(steps * mean > 0.0, share[:, None] * mean / steps, np.inf)
            slopes = np.nan_to_num(pairs / steps, posinf=0.0, neginf=0.0)
        found, own = np.zeros((count, n, 2)), np.zeros((count, n, 2, bodies))
        found[:, 1:, 0], own[:, 1:, 0, crank] = pairs, -slopes
        found[:, :-1, 1], own[:, :-1, 1, crank] = pairs, slopes
        return found, own, np.zeros((count, n, 2, self.task.family.size))


def fitted(
    task: Task, linkage: Floats, angles: Floats, *, weight: float, steps: int, guard: float
) -> tuple[Floats, Floats, Floats]:
    """Linkages (n, size), their angles (n, n_positions, n_bodies) and errors near starts.

    No position passes a dead point. A part of the error at the start keeps linkages away from
    dead points, where any error vanishes for a linkage that folds.

    Args:
        task: what is fitted.
        linkage: the starts, (n, size).
        angles: of their bodies, (n, n_positions, n_bodies).
        weight: of the gaps.
        steps: most trials of each start.
        guard: the part of the error that keeps linkages away from dead points.
    """
    linkage, angles = np.clip(linkage, task.low, task.high), angles.copy()
    sign, log, _, _ = task.family.room(linkage, angles)
    first = task.residuals(linkage, angles, weight)[0]
    share = guard * np.sqrt((first**2).mean(axis=(1, 2)))
    of = _Sum(task, weight, (share, sign, log.mean(axis=1)))
    damping, active = np.full(len(linkage), 1e-3), np.arange(len(linkage))
    now = of.residuals(linkage, angles, active)
    best = _squares(now[0])
    for _ in range(steps):
        active, now = (
            active[np.isfinite(best[active])],
            tuple(part[np.isfinite(best[active])] for part in now),
        )
        if not len(active):
            break
        at, turned = linkage[active], angles[active]
        to, by = _bent(of, (at, turned, active), now, damping[active])
        moved, turned = np.clip(at + to, task.low, task.high), turned + by
        new = of.residuals(moved, turned, active)
        total = _squares(new[0])
        better = total < best[active]
        taken = active[better]
        idle = better & (total > best[active] * (1.0 - 1e-5)) | (total < 1e-28)
        linkage[taken], angles[taken], best[taken] = moved[better], turned[better], total[better]
        now = tuple(np.where(_wide(better, a), b, a) for a, b in zip(now, new, strict=True))
        damping[active] = np.where(
            better, np.maximum(damping[active] * 0.3, 1e-15), damping[active] * 3.0
        )
        going = ~(idle & better) & (damping[active] < 1e8)
        active, now = active[going], tuple(part[going] for part in now)
    errors = task.residuals(linkage, angles, weight)[0]
    return linkage, angles, np.sqrt((errors**2).mean(axis=(1, 2)))


def _squares(residuals: Floats) -> Floats:
    """Sums of squares, (n,)."""
    with np.errstate(over="ignore", invalid="ignore"):
        found = (residuals**2).sum(axis=(1, 2))
    return np.where(np.isfinite(found), found, np.inf)


def _wide(flags: Any, like: Floats) -> Any:
    return flags.reshape(-1, *[1] * (like.ndim - 1))


def _bent(
    of: _Sum, start: tuple[Floats, Floats, Any], now: tuple[Floats, ...], damping: Floats
) -> tuple[Floats, Floats]:
    """Steps along parabolas, which follow narrow valleys (Transtrum and Sethna 2012)."""
    linkage, angles, rows = start
    residuals, own, more = now
    to, by = _step(of.task, linkage, now, damping)
    ahead = of.residuals(linkage + _PART * to, angles + _PART * by, rows)[0]
    straight = (own @ by[..., None] + more @ to[:, None, :, None])[..., 0]
    bend = np.nan_to_num(2.0 / _PART * ((ahead - residuals) / _PART - straight), posinf=0.0)
    more_to, more_by = _step(of.task, linkage, (bend, own, more), damping)
    sizes = [
        np.sqrt((x**2).sum(axis=1) + (y**2).sum(axis=(1, 2)))
        for x, y in ((to, by), (more_to, more_by))
    ]
    share = np.where(2.0 * sizes[1] < _BENT * sizes[0], 0.5, 0.0)
    return to + _wide(share, to) * more_to, by + _wide(share, by) * more_by


def _step(
    task: Task, linkage: Floats, now: tuple[Floats, ...], damping: Floats
) -> tuple[Floats, Floats]:
    """The steps of linkages and of the angles of their positions."""
    residuals, own, more = now
    count, size = linkage.shape
    turned = np.swapaxes(own, 2, 3)
    block, both, side = turned @ own, turned @ more, (turned @ residuals[..., None])
    for k in range(block.shape[-1]):
        block[..., k, k] *= 1.0 + damping[:, None]
        block[..., k, k] += 1e-14
    flat = more.reshape(count, -1, size)
    matrix = np.swapaxes(flat, 1, 2) @ flat
    right = (np.swapaxes(flat, 1, 2) @ residuals.reshape(count, -1, 1))[..., 0]
    diagonal = np.einsum("kii->ki", matrix)
    ahead = solved(block, np.concatenate([both, side], axis=-1))
    wide = both.reshape(count, -1, size)
    matrix = matrix - np.swapaxes(wide, 1, 2) @ ahead[..., :-1].reshape(count, -1, size)
    right = right - (np.swapaxes(wide, 1, 2) @ ahead[..., -1].reshape(count, -1, 1))[..., 0]
    held = ((linkage <= task.low) & (right > 0.0)) | ((linkage >= task.high) & (right < 0.0))
    held |= task.low == task.high
    places = np.arange(size)
    # what is left after the elimination may be far smaller than the diagonal before
    left = np.maximum(matrix[:, places, places], 1e-9 * diagonal + 1e-14)
    matrix[:, places, places] += damping[:, None] * left
    free = ~held
    matrix = np.where(free[:, :, None] & free[:, None, :], matrix, 0.0)
    matrix[:, places, places] = np.where(free, matrix[:, places, places], 1.0)
    to = -solved(matrix, np.where(free, right, 0.0)[..., None])[..., 0]
    by = -ahead[..., -1] - (ahead[..., :-1] @ to[:, None, :, None])[..., 0]
    return np.nan_to_num(to), np.nan_to_num(by)
