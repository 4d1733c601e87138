"""From pairs of dyads to candidates."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from kempe import _core
from kempe.base.arguments import explained
from kempe.base.arrays import Floats, fixed
from kempe.model.given import value
from kempe.model.values import Number, refuse
from kempe.synthesis import tasks
from kempe.synthesis.candidate import TYPES, Candidate, masses_of
from kempe.synthesis.dyads import Dyads
from kempe.synthesis.found import Followed, Found
from kempe.synthesis.six_bar.topology import FAMILIES, Topology, topology
from kempe.synthesis.slider import SliderCrank
from kempe.synthesis.tasks import Complexes

B = TypeVar("B", bound="Bars")
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
        masses: masses by body, such as ``crank``, ``coupler`` and ``rocker``, kg; by default 1 kg
            per metre of their sides.

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
    found = _core.pairs_of_dyads(len(first), None if second is None else len(second), seed)
    return np.asarray(np.array(found, dtype=np.int64).reshape(-1, 2).T)


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

    def taken(self: B, places: Any) -> B:
        """Some of them."""
        return type(self)(*(getattr(self, name)[places] for name in self.__dataclass_fields__))

    def numbers(self) -> Floats:
        """Both pivots and both pins at all positions as the core takes them, (n, 4 n_positions)."""
        all_ = np.column_stack([self.o, self.a, self.b, self.end]).astype(np.complex128)
        return np.ascontiguousarray(all_).view(np.float64)

    @property
    def end(self) -> Complexes:
        """The ground pivot of the rocker."""
        return self.d

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

    @property
    def end(self) -> Complexes:
        """The direction of the slide."""
        return self.slide

    def sides(self) -> list[Complexes]:
        """Crank and coupler at the first position."""
        return super().sides()[:2]


def collected(
    bars: Bars,
    limits: Limits,
    *,
    either: bool,
    complete: bool,
    task: Complexes,
    poses: Any = None,
    followed: Followed | None = None,
) -> Found:
    """The result of a task: all solutions without defects, or the best of many samples.

    Args:
        bars: the four-bars.
        limits: of the candidates.
        either: whether the rocker may be the crank, with the better of both taken.
        complete: whether these are all solutions.
        task: places of the point.
        poses: the poses, if there are any.
        followed: numbers of complex solutions; all four-bars are kept if it is given.
    """
    grashof = limits.grashof
    asked = (
        limits.tell,
        limits.transmission_angle,
        grashof if isinstance(grashof, str) else ("holds" if grashof else None),
        None if limits.within is None else limits.within.tolist(),
        limits.way,
    )
    slides = isinstance(bars, Slides)
    found, excluded = _core.ranked_linkages(
        bars.numbers(),
        bars.error.tolist(),
        slides,
        asked,
        either,
        complete or followed is not None,
    )
    made = [_candidate(bars, of, limits) for of in found]
    return Found(made, complete, dict(excluded), task, poses, followed=followed)


def _candidate(bars: Bars, of: _core.RankedLinkage, limits: Limits) -> Candidate:
    k, reverse, turns, grashof, least, _, defects, crank_angles = of
    pins = (bars.o[k], bars.a[k, 0], bars.b[k, 0], bars.d[k], bars.p[k, 0])
    if reverse:
        pins = (pins[3], pins[2], pins[1], pins[0], pins[4])
    slide = (complex(bars.slide[k]),) if isinstance(bars, Slides) else ()
    kind: Any = SliderCrank if slide else Candidate
    made: Candidate = kind(
        tuple(complex(at) for at in pins),
        float(bars.frame[k]),
        float(bars.error[k]),
        least,
        grashof,
        turns,
        tuple(defects),
        fixed(np.array(crank_angles)),
        limits.masses,
        *slide,
    )
    return made


def families(
    family: str,
    known: Sequence[str],
    limits: Mapping[str, Any],
    parts: Mapping[str, Any] | None = None,
) -> Topology | None:
    """The bodies of a family of six-bars; None for the others.

    Raises:
        ModelError: the family is unknown, or has no such masses, parts or types.
    """
    if family not in known:
        refuse("family", f"{family!r}; must be {' or '.join(map(repr, known))}")
    six = topology(family) if family in FAMILIES else None
    own = ("crank", "coupler", "rocker", "slider") if six is None else tuple(six.bodies)
    for name in limits.get("masses") or {}:
        if name not in own:
            refuse("masses", f"{name!r}; must be {', '.join(own[:-1])} or {own[-1]}")
    if six is None and parts is not None:
        refuse("parts", "only those of six-bars can be prescribed; choose such a family")
    if six is not None and isinstance(limits.get("grashof"), str):
        refuse("grashof", "types are those of four-bars; must be True or False for six-bars")
    return six


def together(parts: list[Bars]) -> Bars:
    """Four-bars of several lists."""
    parts = [part for part in parts if len(part.o)]
    if not parts:
        none, wide = np.zeros(0, dtype=complex), np.zeros((0, 1), dtype=complex)
        return Bars(none, wide, wide, none, wide, np.zeros(0), np.zeros(0))
    names = Bars.__dataclass_fields__
    return Bars(*(np.concatenate([getattr(part, name) for part in parts]) for name in names))


def traced(found: _core.Traces, n: int) -> Bars:
    """Four-bars of the core at n positions."""
    flat, frames, errors = found
    at = flat.view(np.complex128).reshape(len(errors), 3 * n + 2)
    o, a, b, d, p = (
        at[:, 0],
        at[:, 1 : n + 1],
        at[:, n + 1 : 2 * n + 1],
        at[:, 2 * n + 1],
        at[:, -n:],
    )
    return Bars(o, a, b, d, p, np.array(frames), np.array(errors))


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
