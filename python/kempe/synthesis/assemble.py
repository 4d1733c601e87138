"""From pairs of dyads to candidates."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from kempe.base.arguments import explained
from kempe.base.arrays import Floats
from kempe.model.given import value
from kempe.model.values import Number, refuse
from kempe.synthesis import tasks
from kempe.synthesis.candidate import TYPES, Candidate, masses_of, unwrapped
from kempe.synthesis.defects import KINDS, Flags, Judged, judged, judged_slides
from kempe.synthesis.dyads import Dyads
from kempe.synthesis.found import Found
from kempe.synthesis.slider import SliderCrank
from kempe.synthesis.tasks import Complexes

#: Candidates of a task with free choices: those kept, and pairs of dyads that are judged.
KEPT, _PAIRS = 100, 20_000
T = TypeVar("T", "Bars", "Judged")
B = TypeVar("B", bound="Bars")
#: A larger transmission angle is no better, rad.
_GOOD = np.pi / 4.0
_DIRECTIONS = {"ccw": 1, "cw": -1, None: 0}


@dataclass(frozen=True)
class Limits:
    """Limits of all candidates, besides the task.

    Attributes:
        tell: whether candidates with defects are kept.
        transmission_angle: least over the full turn, rad; or None.
        grashof: whether Grashof's condition must hold, or the type; or None.
        within: the least and largest x and y of the ground pivots, (2, 2), m; or None.
        way: 1 or -1 if the crank must turn counter-clockwise or clockwise, otherwise 0.
        masses: masses by body, kg.
    """

    tell: bool = False
    transmission_angle: float | None = None
    grashof: bool | str | None = None
    within: Floats | None = None
    way: int = 0
    masses: Mapping[str, float] = field(default_factory=dict)


@explained
def limits(
    *,
    defects: str = "exclude",
    transmission_angle: Number | None = None,
    grashof: bool | str = False,
    within: Sequence[Sequence[Number]] | None = None,
    direction: str | None = None,
    masses: Mapping[str, Number] | None = None,
) -> Limits:
    """The limits that ``motion``, ``path`` and ``function`` accept as further arguments.

    Args:
        defects: "exclude" leaves candidates with a defect out and counts them, "tell" keeps them.
        transmission_angle: least over the full turn, rad, or "40 deg"; no limit by default.
        grashof: True if Grashof's condition must hold, or a type such as "crank-rocker".
        within: limits of both ground pivots, ``[(x_min, x_max), (y_min, y_max)]``, m.
        direction: "ccw" or "cw", in which the crank turns through the task; None for either.
        masses: masses of ``crank``, ``coupler`` and ``rocker``, kg; by default 1 kg per metre of
            their sides.

    Raises:
        ModelError: one of them is invalid.
    """
    if defects not in ("exclude", "tell"):
        refuse("defects", f"{defects!r}; must be 'exclude' or 'tell'")
    if grashof not in (True, False, *TYPES):
        refuse("grashof", f"{grashof!r}; must be True or {', '.join(TYPES)}")
    if direction not in _DIRECTIONS:
        refuse("direction", f"{direction!r}; must be 'ccw', 'cw' or None")
    least, box = transmission_angle, None
    if within is not None:
        box = tasks.rows(within, "within", ["m", "m"], "[(x_min, x_max), (y_min, y_max)]")
        if box.shape != (2, 2) or (box[:, 1] < box[:, 0]).any():
            refuse("within", "must be [(x_min, x_max), (y_min, y_max)]")
    return Limits(
        defects == "tell",
        None if least is None else value(least, "transmission_angle", "rad"),
        grashof or None,
        box,
        _DIRECTIONS[direction],
        masses_of(masses),
    )


def pairs_of(first: Dyads, second: Dyads | None, seed: int) -> NDArray[np.int64]:
    """Pairs of places in two lists of dyads, (2, n); in one list if there is no second."""
    if second is None:
        places = np.array(np.triu_indices(len(first), 1))
    else:
        places = np.indices((len(first), len(second))).reshape(2, -1)
    if places.shape[1] > _PAIRS:
        random = np.random.default_rng(seed)
        places = places[:, random.choice(places.shape[1], _PAIRS, replace=False)]
    return np.asarray(places, dtype=np.int64)


def moved(at: Complexes, places: Complexes, angles: Floats) -> Complexes:
    """Points of the moving plane at all poses, (n, n_poses), from those at the first pose."""
    turn = np.exp(1j * (angles - angles[0]))
    return np.asarray(places + (at[:, None] - places[0]) * turn)


@dataclass(frozen=True)
class Bars:
    """Four-bars at the positions of a task.

    Attributes:
        o, d: ground pivots, (n,).
        a, b, p: pins and coupler point, (n, n_positions).
        frame: the angle of the moving frame at the first position, (n,).
        error: (n,).
    """

    o: Complexes
    a: Complexes
    b: Complexes
    d: Complexes
    p: Complexes
    frame: Floats
    error: Floats

    def reversed(self) -> Bars:
        """The rocker as the crank."""
        return Bars(self.d, self.b, self.a, self.o, self.p, self.frame, self.error)

    def taken(self: B, places: Any) -> B:
        """Some of them."""
        return type(self)(*(getattr(self, name)[places] for name in self.__dataclass_fields__))

    def judged(self, way: int) -> Judged:
        """Their defects with the first link as the crank."""
        return judged(self.o, self.a, self.b, self.d, way)

    def shapely(self: B) -> B:
        """Those without links or grounds of no length."""
        sides = np.stack([abs(side) for side in self.sides()])
        kept = sides.min(axis=0) > tasks.SAME * sides.max(axis=0)
        return self.taken(kept & np.isfinite(sides).all(axis=0))

    def sides(self) -> list[Complexes]:
        """The links and the ground at the first position."""
        a, b = self.a[:, 0], self.b[:, 0]
        return [a - self.o, b - a, self.d - b, self.d - self.o]


@dataclass(frozen=True)
class Slides(Bars):
    """Slider-cranks: B moves on a line through d.

    Attributes:
        slide: the direction of the line, (n,).
    """

    slide: Complexes

    def judged(self, way: int) -> Judged:
        """Their defects."""
        return judged_slides(self.o, self.a, self.b, self.slide, way)

    def sides(self) -> list[Complexes]:
        """Crank and coupler at the first position."""
        return super().sides()[:2]


def collected(
    bars: Bars, limits: Limits, *, either: bool, complete: bool, task: Complexes, poses: Any = None
) -> Found:
    """The result of a task: all solutions without defects, or the best of many samples.

    Args:
        bars: the four-bars.
        limits: of the candidates.
        either: whether the rocker may be the crank, with the better of both taken.
        complete: whether these are all solutions.
        task: places of the point.
        poses: the poses, if there are any.
    """
    bars = bars.shapely()
    found = bars.judged(limits.way)
    if either:
        back = bars.reversed()
        other = back.judged(limits.way)
        better = _worth(other) > _worth(found)
        bars, found = _either(bars, back, better), _either(found, other, better)
    wrong = _wrong(bars, found, limits)
    bad = np.any(list(wrong.values()), axis=0)
    excluded = {kind: int(of.sum()) for kind, of in wrong.items() if of.any()}
    size = found.lengths.max(axis=1)
    exact = np.where(bars.error < 1e-9 * size, 0.0, bars.error)
    least, here = (-np.round(np.minimum(x, _GOOD), 2) for x in (found.least, found.here))
    order = np.lexsort((size, here, least, exact, found.count))
    if not limits.tell:
        order = order[~bad[order]]
    else:
        excluded = {}
    kept = order if complete else order[:KEPT]
    made = [_candidate(bars, found, k, limits, wrong) for k in kept.tolist()]
    return Found(made, complete, excluded, task, poses)


def _either(one: T, other: T, better: Flags) -> T:
    """The second of two where it is better."""

    def chosen(name: str) -> Any:
        x, y = getattr(one, name), getattr(other, name)
        across = name == "places"  # defects are the first axis there
        return np.where(better if across or x.ndim == 1 else better[:, None], y, x)

    return type(one)(*(chosen(name) for name in one.__dataclass_fields__))


def _worth(of: Judged) -> Floats:
    """Fewer defects first, then a crank that turns fully, then the transmission angle."""
    return np.asarray(-10.0 * of.count + of.turns + 0.1 * of.least + 0.01 * of.here)


def _wrong(bars: Bars, of: Judged, limits: Limits) -> dict[str, Flags]:
    """Which candidates have each defect, or are beyond each limit."""
    wrong = {kind: places >= 0 for kind, places in zip(KINDS, of.places, strict=True)}
    least, asked, within = limits.transmission_angle, limits.grashof, limits.within
    if least is not None:
        wrong["transmission angle"] = of.least < least
    if asked is not None:
        shortest = of.lengths.argmin(axis=1)
        fits = True if asked is True else shortest == TYPES.index(asked)
        wrong["grashof"] = ~(of.grashof & fits)
    if within is not None:
        low, high = within.T
        outside = [
            (at.real < low[0]) | (at.real > high[0]) | (at.imag < low[1]) | (at.imag > high[1])
            for at in (bars.o, bars.d)
        ]
        wrong["pivots"] = outside[0] | outside[1]
    return wrong


def _candidate(
    bars: Bars, of: Judged, k: int, limits: Limits, wrong: Mapping[str, Flags]
) -> Candidate:
    places = dict(zip(KINDS, of.places[:, k].tolist(), strict=True))
    texts = [
        f"{kind}: at position {places[kind] + 1}" if kind in places else f"{kind}: beyond the limit"
        for kind, flags in wrong.items()
        if flags[k]
    ]
    angles = np.angle(bars.a[k] - bars.o[k])
    pins = (bars.o[k], bars.a[k, 0], bars.b[k, 0], bars.d[k], bars.p[k, 0])
    turns = bool(of.turns[k])
    slide = (complex(bars.slide[k]),) if isinstance(bars, Slides) else ()
    kind: Any = SliderCrank if slide else Candidate
    made: Candidate = kind(
        tuple(complex(at) for at in pins),
        float(bars.frame[k]),
        float(bars.error[k]),
        float(of.least[k]),
        bool(of.grashof[k]),
        turns,
        tuple(texts),
        unwrapped(angles, bool(of.forward[k]), turns),
        limits.masses,
        *slide,
    )
    return made


def families(family: str, known: Sequence[str] = ("four_bar",)) -> None:
    """Refuse an unknown family.

    Raises:
        ModelError: it is unknown.
    """
    if family not in known:
        refuse("family", f"{family!r}; must be {' or '.join(map(repr, known))}")
