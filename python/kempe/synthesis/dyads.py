"""Dyads: a ground pivot and a point of the moving plane at a constant distance from it."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from kempe import _core
from kempe.base.arguments import explained
from kempe.base.arrays import Floats
from kempe.errors import ModelError
from kempe.synthesis import tasks
from kempe.synthesis.tasks import Complexes

#: A dyad has a pivot at infinity if its first number is below this share of the largest.
_INFINITE = 1e-10
#: A dyad is shorter than this share of the task: its pin and its pivot coincide.
_SHORTEST = 1e-9
#: Singular values that count as zero, relative to the largest, and sizes of the task within which
#: pins of slides are.
_SLIDE, _FAR = 1e-10, 1e3
#: The golden angle, which spreads directions evenly.
_GOLDEN = np.pi * (3.0 - np.sqrt(5.0))
#: The columns of the conditions in which the ends of a dyad are.
_COLUMN = {"pin": 1, "pivot": 3}


@dataclass(frozen=True)
class Dyads:
    """Dyads of some poses, in the frame of the task at its first pose.

    Attributes:
        pin: the place of the moving pin at the first pose, (n,); infinite for guides.
        pivot: its ground pivot, (n,); infinite for slides.
        way: for slides and guides, the direction of the line at the first pose, and the other
            pin; NaN for pins.
        complete: whether these are all.
    """

    pin: Complexes
    pivot: Complexes
    way: Complexes
    complete: bool

    def __len__(self) -> int:
        return len(self.pin)

    def of(self, kind: str) -> Dyads:
        """The dyads with two pins ("pin"), a pin on a line of ground ("slide"), or the reverse."""
        finite = {"pin": (True, True), "slide": (True, False), "guide": (False, True)}[kind]
        kept = (np.isfinite(self.pin) == finite[0]) & (np.isfinite(self.pivot) == finite[1])
        return Dyads(self.pin[kept], self.pivot[kept], self.way[kept], self.complete)


class Conditions:
    """The linear conditions of poses on (1, w, g, u, v); see ``synthesis/src/dyads.rs``.

    Args:
        places: the origin of the moving frame at each pose.
        angles: its angle, rad.
        what: the name of a pose in messages.
    """

    def __init__(self, places: Complexes, angles: Floats, what: str = "pose") -> None:
        self.what = what
        self.origin, self.size = complex(places[0]), tasks.size(places)
        p = (places[1:] - places[0]) / self.size
        turn = np.exp(1j * (angles[1:] - angles[0]))
        along = np.conj(p) * turn
        columns = [abs(p) ** 2 / 2, along.real, -along.imag, -p.real, -p.imag]
        self.rows = np.column_stack([*columns, 1.0 - turn.real, turn.imag])

    @staticmethod
    def line(column: int, x: float, y: float, distance: float) -> Floats:
        """The condition that a pin (column 1) or a pivot (3) lies on a line."""
        row = np.zeros(7)
        row[0], row[column], row[column + 1] = -distance, x, y
        return row

    def solved(self, more: Iterable[Floats] = ()) -> list[list[float]] | None:
        """The real dyads with all conditions, which must be four; None if they are dependent."""
        return _core.dyads([*self.rows.tolist(), *(row.tolist() for row in more)])

    def dyads(self, found: Iterable[Sequence[float]], complete: bool) -> Dyads:
        """Homogeneous numbers as dyads of the task."""
        numbers = np.array(list(found), dtype=np.float64).reshape(-1, 7)
        with np.errstate(all="ignore"):
            return self._dyads(numbers, complete)

    def _dyads(self, numbers: Floats, complete: bool) -> Dyads:
        numbers = numbers / np.abs(numbers).max(axis=1, keepdims=True, initial=1e-300)
        one, uv = numbers[:, 0], numbers[:, 5] + 1j * numbers[:, 6]
        w, g = numbers[:, 1] + 1j * numbers[:, 2], numbers[:, 3] + 1j * numbers[:, 4]
        finite = np.abs(one) > _INFINITE
        slide = ~finite & (np.abs(g) >= np.abs(w))
        # u + i v = ḡ w: the finite end of a slide or guide
        end_w, end_g = uv / np.conj(g), np.conj(uv / w)
        pin = np.where(finite, w / one, np.where(slide, end_w, np.inf))
        pivot = np.where(finite, g / one, np.where(slide, np.inf, end_g))
        way = np.where(finite, np.nan, 1j * np.where(slide, g / np.abs(g), w / np.abs(w)))
        scaled = [
            np.where(np.isfinite(x), self.origin + self.size * x, np.inf) for x in (pin, pivot)
        ]
        kept = ~(finite & (np.abs(pin - pivot) < _SHORTEST * (1.0 + np.abs(pin))))
        return Dyads(scaled[0][kept], scaled[1][kept], way[kept], complete)

    def sampled(self, more: Floats, n: int, seed: int, kinds: str) -> Dyads:
        """Dyads with free choices.

        If one choice is free, pins or pivots lie on random lines; otherwise they have random
        places.

        Args:
            more: further conditions, (m, 7).
            n: number of choices.
            seed: of the choices.
            kinds: "pin pivot", or one of them: what is chosen.
        """
        random = np.random.default_rng(seed)
        places = _scattered(n, random)
        if len(self.rows) + len(more) <= 2:
            near = _scattered(n, random)
            parts = [
                self.with_end(kind, places[k :: len(kinds.split())], more, near)
                for k, kind in enumerate(kinds.split())
            ]
            return joined(parts)
        found: list[list[float]] = []
        for k, at in enumerate(places.tolist()):
            column = _COLUMN[kinds.split()[k % len(kinds.split())]]
            line = self.line(
                column, at.real / abs(at), at.imag / abs(at), abs(at) * (-1) ** (k // 2)
            )
            found += self.solved([*more, line]) or []
        return self.dyads(found, complete=False)

    def with_end(
        self, kind: str, at: Complexes, more: Floats | None = None, near: Complexes | None = None
    ) -> Dyads:
        """The dyads with given pins or pivots; the other end is as near as possible to a place.

        Args:
            kind: "pin" or "pivot".
            at: their places, relative to the task: (place - origin) / size.
            more: further conditions, (m, 7).
            near: preferred places of the other ends, (n,), where they are not determined.
        """
        rows = self.rows if more is None else np.vstack([self.rows, more])
        r = rows.T[:, None, :]
        x, y = at.real[:, None], at.imag[:, None]
        own, other = (1, 3) if kind == "pin" else (3, 1)
        sign = 1.0 if kind == "pin" else -1.0
        columns = (
            r[other] + x * r[5] + sign * y * r[6],
            r[other + 1] + y * r[5] - sign * x * r[6],
        )
        matrix = np.stack(columns, axis=2)
        right = -(r[0] + x * r[own] + y * r[own + 1])
        start = np.zeros(len(at), dtype=complex) if near is None else near[: len(at)]
        start = np.column_stack([start.real, start.imag])[:, :, None]
        inverse = np.linalg.pinv(matrix, rcond=1e-11)
        end = start + inverse @ (right[:, :, None] - matrix @ start)
        left = abs(matrix @ end - right[:, :, None]).max(axis=(1, 2))
        ends = np.where(left < 1e-9, end[:, 0, 0] + 1j * end[:, 1, 0], np.inf)
        w, g = (at, ends) if kind == "pin" else (ends, at)
        kept = np.isfinite(ends) & (abs(w - g) > _SHORTEST * (1.0 + abs(w)))
        nowhere = np.full(int(kept.sum()), np.nan + 0j)
        exact = len(rows) >= 2 and near is None
        pin, pivot = (self.origin + self.size * np.asarray(end[kept]) for end in (w, g))
        return Dyads(np.asarray(pin), np.asarray(pivot), nowhere, exact)

    def all(
        self,
        n: int,
        seed: int,
        *,
        more: Floats | None = None,
        pivot: complex | None = None,
        kinds: str = "pin pivot",
    ) -> Dyads:
        """All dyads if their conditions determine them, otherwise samples.

        Args:
            n: number of samples.
            seed: of the samples.
            more: further conditions, (m, 7).
            pivot: a fixed ground pivot.
            kinds: what is sampled: "pin pivot", or one of them.

        Raises:
            ModelError: the conditions contradict each other or are dependent.
        """
        more = np.zeros((0, 7)) if more is None else more
        count, poses = len(self.rows) + len(more), f"{len(self.rows) + 1} {self.what}s"
        if pivot is not None:
            at = (pivot - self.origin) / self.size
            if len(self.rows) >= 2:
                found = self.with_end("pivot", np.array([at]))
                if len(self.rows) > 2 and not len(found):
                    hint = f"leave out a {self.what}, or let the pivot be free"
                    raise ModelError(f"{poses} and a fixed pivot contradict each other", hint=hint)
                return found
            near = _scattered(n, np.random.default_rng(seed))
            return self.with_end("pivot", np.full(n, at), near=near)
        if count < 4:
            return self.sampled(more, n, seed, kinds)
        solved = self.solved(more)
        if solved is None:
            raise ModelError(
                f"the conditions of the {poses} depend on each other: {self._dependent()}",
                hint=f"leave out a {self.what}, or change its angle",
            )
        return self.dyads(solved, complete=True)

    def slides(self, n: int, seed: int) -> Dyads:
        """Pins that move along straight lines of ground, and the directions of these lines.

        X = (0, 0, g, u, v) is a null vector of the conditions. Four poses have one such pin, three
        a circle of them, and two the whole plane, which are sampled.
        """
        _, sizes, vectors = np.linalg.svd(self.rows[:, 3:])
        rank = int((sizes > _SLIDE * sizes[0]).sum())
        null = vectors[rank:]
        free = np.random.default_rng(seed).normal(size=(n if len(null) > 1 else 1, len(null)))
        numbers = np.zeros((len(free), 7))
        numbers[:, 3:] = free @ null
        found = self.dyads(numbers[: n if len(null) else 0], complete=len(null) <= 1)
        kept = np.isfinite(found.pin) & (abs(found.pin - self.origin) < _FAR * self.size)
        return Dyads(found.pin[kept], found.pivot[kept], found.way[kept], found.complete)

    def _dependent(self) -> str:
        """Which pose follows from the others."""
        rank = np.linalg.matrix_rank(self.rows, tol=1e-9)
        for k in range(len(self.rows), 0, -1):
            if np.linalg.matrix_rank(np.delete(self.rows, k - 1, axis=0), tol=1e-9) == rank:
                return f"{self.what} {k + 1} adds none to the others"
        return "a limit follows from the poses"


def _scattered(n: int, random: np.random.Generator) -> Complexes:
    """Places around the task: directions are even, and few are far away."""
    angle = np.arange(n) * _GOLDEN + random.uniform(0.0, 2.0 * np.pi)
    return np.asarray(np.exp(1j * angle) * np.exp(random.normal(0.0, 1.0, n)))


def joined(parts: Sequence[Dyads]) -> Dyads:
    """Dyads of several lists."""
    pin, pivot, way = (
        np.concatenate([getattr(part, name) for part in parts]) for name in ("pin", "pivot", "way")
    )
    return Dyads(pin, pivot, way, all(part.complete for part in parts))


@explained
def dyads(poses: Sequence[tasks.Pose]) -> list[tuple[complex, complex]]:
    """All real dyads of five poses: pairs of a moving pin at the first pose and its ground pivot.

    Complex numbers x + iy, m. There are at most four (Burmester 1888), by elimination. A pin in the
    moving frame of the first pose is ``(pin - p)·exp(-i·angle)``.

    Raises:
        ModelError: there are not five poses, two are the same, or infinitely many dyads.
    """
    places, angles = tasks.poses(poses)
    if len(places) != 5:
        raise ModelError(f"poses: {len(places)}; five poses determine the dyads")
    found = Conditions(places, angles).all(0, 0).of("pin")
    pairs: Any = zip(found.pin.tolist(), found.pivot.tolist(), strict=True)
    return list(pairs)
