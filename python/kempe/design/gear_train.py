"""Tooth numbers for a ratio of speeds, and the gear train as a case."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np

from kempe.errors import ModelError
from kempe.model.model import Model
from kempe.model.values import refuse, two

if TYPE_CHECKING:
    from kempe.case import Case

#: Module of the wheels, m; density × width, kg/m²; speed of the input, rad/s.
_MODULE, _SURFACE, _SPEED = 2e-3, 156.0, 2.0 * np.pi


@dataclass(frozen=True, repr=False)
class GearTrain:
    """Tooth numbers of a gear train.

    Attributes:
        kind: "simple", "compound" or "planetary".
        teeth: numbers of teeth by the name of the wheel.
        ratio: speed of the input over that of the output; negative if they turn opposite ways.
        error: (ratio - wanted) / wanted.
        planets: number of planets that can be assembled with equal distances; 0 without planets.
    """

    kind: str
    teeth: Mapping[str, int]
    ratio: float
    error: float
    planets: int = 0

    @cached_property
    def case(self) -> Case:
        """The train with wheels as discs, 2 mm module and 20 mm wide, of steel.

        The input turns once in 1 s. Wheels have the names of ``teeth``; ``input`` and ``output``
        are the wheels, or the carrier, that turn with them. One planet is modelled.
        """
        return _planetary_case(self.teeth) if self.kind == "planetary" else _fixed_case(self)

    def __repr__(self) -> str:
        told = ", ".join(f"{name} {count}" for name, count in self.teeth.items())
        return f"<GearTrain: {told}; ratio {self.ratio:.8g}, error {self.error:.2g}>"


def gear_train(
    ratio: float,
    kind: str = "simple",
    teeth: tuple[int, int] = (17, 100),
    *,
    planets: int = 3,
) -> GearTrain:
    """The gear train whose ratio is nearest to a given one, with the fewest teeth.

    Args:
        ratio: speed of the input over that of the output; negative if they turn opposite ways.
        kind: "simple": two wheels, with an idler between them if the ratio is positive;
            "compound": two pairs in a row, each external, so that the ratio is positive;
            "planetary": input at the sun, output at the carrier, fixed ring: ratio 1 + ring/sun.
        teeth: least and largest number of teeth of a wheel; of a ring, three times the largest.
        planets: number of planets, which must fit with equal distances.

    Raises:
        ModelError: there is no such train within the limits.
    """
    if kind not in _KINDS:
        refuse("kind", f"{kind!r}; must be simple, compound or planetary")
    if not np.isfinite(ratio) or ratio == 0.0:
        refuse("ratio", f"{ratio!r}; must be a number other than 0")
    given = two(teeth, "teeth", "(least, largest), at least 3")
    low, high = (int(x) if isinstance(x, int | np.integer) else 0 for x in given)
    if not 3 <= low <= high:
        refuse("teeth", f"{teeth!r}; must be (least, largest), at least 3")
    if kind != "simple" and ratio <= (1.0 if kind == "planetary" else 0.0):
        hint = "choose kind='simple', or another ratio"
        raise ModelError(f"ratio: {ratio:g} is impossible for a {kind} train", hint=hint)
    found = list(_KINDS[kind](ratio, low, high, planets))
    if not found:
        hint = "widen teeth=, or choose another number of planets"
        raise ModelError(f"no {kind} train within {low} to {high} teeth", hint=hint)

    def worth(one: tuple[dict[str, int], float]) -> tuple[float, int]:
        return (round(abs(one[1] / ratio - 1.0), 12), sum(one[0].values()))

    best, reached = min(found, key=worth)
    count = planets if kind == "planetary" else 0
    return GearTrain(kind, MappingProxyType(best), reached, reached / ratio - 1.0, count)


def _simple(ratio: float, low: int, high: int, _: int) -> Iterable[tuple[dict[str, int], float]]:
    for a in range(low, high + 1):
        for b in {int(np.clip(f(a * abs(ratio)), low, high)) for f in (np.floor, np.ceil)}:
            idler = {"idler": low} if ratio > 0.0 else {}
            yield {"input": a, **idler, "output": b}, np.copysign(b / a, ratio)


def _compound(ratio: float, low: int, high: int, _: int) -> Iterable[tuple[dict[str, int], float]]:
    counts = np.arange(low, high + 1)
    drivers = np.multiply.outer(counts, counts)
    for first, b in enumerate(counts):
        for second in range(first, len(counts)):
            d = counts[second]
            place = np.argmin(abs(b * d / drivers - ratio))
            a, c = (int(counts[k]) for k in np.unravel_index(place, drivers.shape))
            wheels = {"input": a, "first": int(b), "second": c, "output": int(d)}
            yield wheels, float(b * d / (a * c))


def _planetary(
    _: float, low: int, high: int, planets: int
) -> Iterable[tuple[dict[str, int], float]]:
    if planets < 1:
        refuse("planets", f"{planets!r}; must be at least 1")
    for sun in range(low, high + 1):
        for planet in range(low, high + 1):
            ring = sun + 2 * planet
            # planets of equal distances mesh, and do not touch each other
            meshes = (sun + ring) % planets == 0
            fits = planets < 2 or (sun + planet) * np.sin(np.pi / planets) > planet + 2
            if meshes and fits and ring <= 3 * high:
                yield {"sun": sun, "planet": planet, "ring": ring}, 1.0 + ring / sun


_KINDS: dict[str, Callable[..., Iterable[tuple[dict[str, int], float]]]] = {
    "simple": _simple,
    "compound": _compound,
    "planetary": _planetary,
}


def _disc(count: int) -> dict[str, Any]:
    radius = _MODULE * count / 2.0
    return {"type": "disc", "radius": radius, "mass": _SURFACE * np.pi * radius**2}


def _fixed_case(train: GearTrain) -> Case:
    """Wheels side by side on fixed axles."""
    names = list(train.teeth)
    if train.kind == "compound":  # the first wheel of the second pair is on the axle of the first
        rows = [("input", "first"), ("second", "output")]
        bodies = [("input",), ("first", "second"), ("output",)]
    else:
        rows = list(pairwise(names))
        bodies = [(name,) for name in names]
    m, at, place = Model(f"{train.kind} gear train", gravity=(0.0, 0.0)), {}, 0.0
    steps = [0.0, *(_MODULE * (train.teeth[a] + train.teeth[b]) / 2.0 for a, b in rows)]
    for step, wheels in zip(steps, bodies, strict=True):
        place += step
        at[wheels[0]] = (place, 0.0)
    m.ground.points(**at)
    owner = {wheel: wheels[0] for wheels in bodies for wheel in wheels}
    for wheels in bodies:
        shapes = [_disc(train.teeth[wheel]) for wheel in wheels]
        m.body(wheels[0], shapes=shapes, points={"O": (0.0, 0.0)})
        m.revolute(f"axle_{wheels[0]}", f"ground.{wheels[0]}", f"{wheels[0]}.O")
    for k, (a, b) in enumerate(rows, 1):
        counts = (train.teeth[a], train.teeth[b])
        m.gear(f"mesh_{k}", f"{owner[a]}.O", f"{owner[b]}.O", teeth=counts, module=_MODULE)
    return _driven(m, "input")


def _planetary_case(teeth: Mapping[str, int]) -> Case:
    """Sun, one planet, carrier, and the ring as ground."""
    sun, planet, ring = teeth["sun"], teeth["planet"], teeth["ring"]
    arm = _MODULE * (sun + planet) / 2.0
    m = Model("planetary gear train", gravity=(0.0, 0.0))
    m.ground.points(O=(0, 0))
    m.body("sun", shapes=[_disc(sun)], points={"O": (0, 0)})
    m.bar("carrier", mass=_SURFACE * _MODULE * 10.0 * arm, through={"O": (0, 0), "P": (arm, 0)})
    m.body("planet", shapes=[_disc(planet)], points={"P": (0, 0)})
    m.revolute("axle_sun", "ground.O", "sun.O")
    m.revolute("axle_carrier", "ground.O", "carrier.O")
    m.revolute("axle_planet", "carrier.P", "planet.P")
    m.gear("inner", "sun.O", "planet.P", teeth=(sun, planet), module=_MODULE)
    m.gear("outer", "ground.O", "planet.P", teeth=(ring, planet), module=_MODULE, internal=True)
    return _driven(m, "sun")


def _driven(m: Model, body: str) -> Case:
    from kempe.case import Case

    m.coordinate_driver("drive", f"{body}.angle", value=f"{_SPEED!r}*t")
    motion = {"type": "inverse_dynamics", "t_end": 1.0, "output_step": 0.01}
    return Case(m, analyses={"motion": motion})
