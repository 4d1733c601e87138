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
    """The linear conditions of poses on (1, w, g, u, v); see ``synthesis/src/conditions.rs``.

    Args:
        places: the origin of the moving frame at each pose.
        angles: its angle, rad.
        what: the name of a pose in messages.
    """

    def __init__(self, places: Complexes, angles: Floats, what: str = "pose") -> None:
        self.what = what
        self.origin, self.size = complex(places[0]), tasks.size(places)
        rows = _core.dyad_conditions(tasks.pairs_in(places), angles.tolist())
        self.rows = np.array(rows, dtype=np.float64).reshape(-1, 7)

    @staticmethod
    def line(column: int, x: float, y: float, distance: float) -> Floats:
        """The condition that a pin (column 1) or a pivot (3) lies on a line."""
        row = np.zeros(7)
        row[0], row[column], row[column + 1] = -distance, x, y
        return row

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

    def with_end(self, kind: str, at: Complexes, more: Floats) -> Dyads:
        """The dyads with given pins or pivots; the shortest one where several have this end.

        Args:
            kind: "pin" or "pivot".
            at: their places, relative to the task: (place - origin) / size.
            more: further conditions, (m, 7).
        """
        rows = np.vstack([self.rows, more])
        found = _core.dyads_with_end(rows.tolist(), kind, tasks.pairs_in(at))
        return self.dyads(found, complete=len(rows) >= 2)

    def all(
        self, n: int, seed: int, *, more: Floats | None = None, kinds: str = "pin pivot"
    ) -> Dyads:
        """All dyads if their conditions determine them, otherwise samples.

        Args:
            n: number of samples.
            seed: of the samples.
            more: further conditions, (m, 7).
            kinds: what is sampled: "pin pivot", or one of them.

        Raises:
            ModelError: the conditions are dependent.
        """
        rows = self.rows if more is None else np.vstack([self.rows, more])
        found, complete = _core.all_dyads(
            rows.tolist(), len(self.rows), None, n, seed, kinds.split(), self.what
        )
        return self.dyads(found, complete)

    def with_pivot(self, pivot: complex, n: int, seed: int) -> Dyads:
        """The dyads with a fixed ground pivot, or samples of them for two poses.

        Args:
            pivot: its place.
            n: number of samples.
            seed: of the samples.

        Raises:
            ModelError: the poses and the pivot contradict each other.
        """
        at = (pivot - self.origin) / self.size
        found, complete = _core.all_dyads(
            self.rows.tolist(), len(self.rows), (at.real, at.imag), n, seed, ["pivot"], self.what
        )
        return self.dyads(found, complete)

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
