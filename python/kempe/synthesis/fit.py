"""Four-bars that approximate points, poses or crank angles, by least squares from several starts.

Places are relative to the task: (place - centre) / size. The unknowns are those of ``Coupler`` in
``synthesis/src/linkage.rs``: O, a, b, p, D, c, the crank angle at the origin of the given ones and
the angle of the moving frame in that of the coupler; at each position crank and coupler angles.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from kempe import _core
from kempe.base.arrays import Floats
from kempe.synthesis.assemble import Bars
from kempe.synthesis.tasks import Complexes, size

#: Steps of the method, the factor of the closure for approximations, and its steps of refinement.
_STEPS, _CLOSING = 200, 1e3
#: A solution is exact if its largest error is below this share of the task.
EXACT = 1e-10


@dataclass(frozen=True)
class Start:
    """Unknowns of a linkage and its positions, relative to the task."""

    linkage: list[float]
    positions: Floats


@dataclass(frozen=True)
class Task:
    """Positions of the coupler.

    Attributes:
        places: of the coupler point.
        frames: angles of the moving frame; None if they are free.
        cranks: angles of the crank; None if they are free.
        offset: whether the crank angles have a free origin.
        pivots: fixed ground pivots.
    """

    places: Complexes
    frames: Floats | None = None
    cranks: Floats | None = None
    offset: bool = True
    pivots: Mapping[str, complex] | None = None

    @property
    def centre(self) -> complex:
        """The origin of relative places."""
        return complex(self.places.mean())

    @property
    def size(self) -> float:
        """The unit of relative places."""
        return size(self.places)

    def relative(self, at: Complexes) -> Complexes:
        """Places relative to the task."""
        return np.asarray((at - self.centre) / self.size)

    @property
    def exact(self) -> bool:
        """Whether linkages can satisfy the task exactly: equations do not outnumber unknowns."""
        n = len(self.places)
        fixed = 2 * len(self.pivots or {})
        if self.frames is not None:
            return 2 * (n - 1) <= 8 - fixed
        if self.cranks is not None:
            return 3 * n <= 9 + self.offset + n - fixed
        return n <= 9 - fixed

    def fitted(
        self, start: Start, *, steps: int = _STEPS, closing: tuple[float, ...] | None = None
    ) -> tuple[Start, float]:
        """The least sum of squares near a start, for factors of the closure one by one."""
        linkage, positions = list(start.linkage), start.positions
        free = [True] * 9 + [self.cranks is not None and self.offset, self.frames is not None]
        for name, at in (self.pivots or {}).items():
            place = {"O": 0, "D": 6}[name]
            relative = complex(self.relative(np.array([at]))[0])
            linkage[place : place + 2] = relative.real, relative.imag
            free[place] = free[place + 1] = False
        targets = self.targets(linkage[10], positions)
        found = (linkage, positions.tolist(), 0.0)
        for factor in closing or ((1.0,) if self.exact else (10.0, _CLOSING)):
            found = _core.fit_coupler(targets, (factor, 1.0), *found[:2], free, steps)
        return Start(found[0], np.array(found[1])), found[2]

    def targets(self, between: float, positions: Floats) -> list[list[float]]:
        """x, y, frame and crank at each position; NaN where an angle is free."""
        at, free = self.relative(self.places), np.full(len(self.places), np.nan)
        frames, cranks = free, free
        if self.frames is not None:  # within half a turn of the start
            near = positions[:, 1] + between
            frames = near + (self.frames - near + np.pi) % (2.0 * np.pi) - np.pi
        if self.cranks is not None:
            cranks = self.cranks
        rows: list[list[float]] = np.column_stack([at.real, at.imag, frames, cranks]).tolist()
        return rows

    def start_of(self, bars: Bars, k: int) -> Start:
        """A four-bar at its positions."""
        o, d = self.relative(np.array([bars.o[k], bars.d[k]]))
        a, b, p = (self.relative(at[k]) for at in (bars.a, bars.b, bars.p))
        arm, bar = a - o, b - a
        point = ((p - a) * np.conj(bar) / abs(bar))[0]
        between = bars.frame[k] - np.angle(bar[0])
        crank = np.unwrap(np.angle(arm))
        offset = 0.0 if self.cranks is None else float(np.mean(crank - self.cranks))
        lengths = [abs(arm[0]), abs(bar[0]), point.real, point.imag]
        linkage = [o.real, o.imag, *lengths, d.real, d.imag, abs(b[0] - d), offset, between]
        positions = np.column_stack([crank, np.angle(bar)])
        return Start([float(x) for x in linkage], positions)

    def bars(self, found: list[Start]) -> Bars:
        """The four-bars of some unknowns, closed exactly at their crank angles."""
        x = np.array([one.linkage for one in found]).reshape(-1, 11).T
        crank, coupler = np.array([one.positions for one in found]).transpose(2, 0, 1)
        o, d, point = x[0] + 1j * x[1], x[6] + 1j * x[7], x[4] + 1j * x[5]
        a = o[:, None] + x[2][:, None] * np.exp(1j * crank)
        far = d[:, None] - a
        with np.errstate(all="ignore"):
            cosine = (x[3][:, None] ** 2 + abs(far) ** 2 - x[8][:, None] ** 2) / (
                2.0 * x[3][:, None] * abs(far)
            )
        between = np.arccos(np.clip(cosine, -1.0, 1.0))
        side = np.sign(np.sin(coupler - np.angle(far)) * np.sign(x[3])[:, None])
        turn = np.exp(1j * (np.angle(far) + side * between))
        b, p = a + x[3][:, None] * turn, a + point[:, None] * turn
        frame = np.angle(turn * np.exp(1j * x[10])[:, None])
        error = abs(p - self.relative(self.places)).max(axis=1) * self.size
        loose = abs(abs(b - d[:, None]) - abs(x[8])[:, None]).max(axis=1)
        error = np.maximum(error, loose * self.size)
        if self.frames is not None:
            apart = abs(np.angle(np.exp(1j * (frame - self.frames)))).max(axis=1)
            error = np.maximum(error, apart)
        if self.cranks is not None:
            apart = crank - x[9][:, None] - self.cranks
            error = np.maximum(error, abs(np.angle(np.exp(1j * apart))).max(axis=1))
        scaled = [self.centre + self.size * at for at in (o, a, b, d, p)]
        return Bars(scaled[0], scaled[1], scaled[2], scaled[3], scaled[4], frame[:, 0], error)


def distinct(bars: Bars) -> Bars:
    """Each four-bar once, those with the least error first."""
    bars = bars.taken(np.argsort(bars.error, kind="stable"))
    at = np.column_stack([bars.o, bars.a[:, 0], bars.b[:, 0], bars.d])
    kept: list[int] = []
    for k in range(len(at)):
        size = abs(at[k] - at[k].mean()).max()
        both = [at[kept], at[kept][:, ::-1]]
        if all(not (abs(one - at[k]).max(axis=1) < 1e-6 * size).any() for one in both):
            kept.append(k)
    return bars.taken(np.array(kept, dtype=int))
