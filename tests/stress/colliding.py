"""Random mechanisms with friction, stops and contacts."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from stress.mechanisms import Random
from stress.rubbing import Drawn, angle, bar, empty, friction, speed, spring, stop, touch


def chain(random: Random) -> Drawn:
    """One to three bars on pins; the last one may hit ground."""
    d = empty(random)
    before = "ground.O"
    for k in range(random.integers(1, 4)):
        bar(d, f"b{k}", d.uniform(0.3, 1.2))
        d.model.revolute(f"J{k}", before, f"b{k}.A")
        at = angle(d)
        d.set |= {f"J{k}.angle": at, f"J{k}.omega": speed(d)}
        stop(d, f"J{k}.angle", at)
        friction(d, f"J{k}")
        before = f"b{k}.B"
    spring(d, "ground.O", before)
    if d.chance(0.4):
        rim(d, "wall", centre=(d.uniform(-1, 1), d.uniform(-2.5, -1)))
        d.model.contact("tip", before, "ground.wall", radius=0.02, **touch(d, 1.5, rubs=True))
    return d


def four_bar(random: Random) -> Drawn:
    """A four-bar linkage with friction in its pins and a stop of crank or rocker."""
    d = empty(random)
    crank, coupler, rocker = d.uniform(0.1, 0.4), d.uniform(0.6, 1.0), d.uniform(0.6, 1.0)
    d.model.ground.points(D=(d.uniform(0.7, 1.0), d.uniform(-0.2, 0.2)))
    for name, length in (("crank", crank), ("coupler", coupler), ("rocker", rocker)):
        bar(d, name, length)
    pins = ("ground.O crank.A", "crank.B coupler.A", "coupler.B rocker.B", "ground.D rocker.A")
    for name, ends in zip("ABCD", pins, strict=True):
        d.model.revolute(name, *ends.split())
        friction(d, name, 0.4)
    at = angle(d)
    d.set |= {"crank.angle": at}
    d.guess |= {"coupler.angle": 0.8, "rocker.angle": 1.6}
    if d.chance(0.3):
        driver(d, "crank.angle", at)
        return d
    d.set |= {"crank.omega": speed(d, 10)}
    stop(d, "crank.angle", at, 0.6, 3.0)
    stop(d, "rocker.angle", 1.6, 0.4, 1.0)
    spring(d, "ground.O", "coupler.B")
    return d


def slider_crank(random: Random) -> Drawn:
    """A slider-crank with friction in pins and slide and a stop of the slide."""
    d = empty(random)
    crank = d.uniform(0.1, 0.35)
    bar(d, "crank", crank)
    bar(d, "rod", d.uniform(0.5, 0.9))
    d.model.body("block", mass=d.uniform(0.2, 3), inertia=0.01, points={"P": (0, 0)})
    d.model.revolute("A", "ground.O", "crank.A")
    d.model.revolute("B", "crank.B", "rod.A")
    d.model.revolute("C", "rod.B", "block.P")
    d.model.translational("slide", "ground.O", "block.P")
    for name in ("A", "B", "C", "slide"):
        friction(d, name, 0.4)
    at = angle(d)
    d.set |= {"crank.angle": at}
    d.guess |= {"rod.angle": 0.0, "block.x": 0.7}
    if d.chance(0.3):
        driver(d, "crank.angle", at)
        return d
    d.set |= {"crank.omega": speed(d, 10)}
    stop(d, "slide.displacement", 0.7, 0.6, 0.3)
    stop(d, "crank.angle", at, 0.3, 3.0)
    spring(d, "ground.O", "rod.B")
    return d


def bead(random: Random) -> Drawn:
    """A bead in the slot of an arm that swings or is driven, with stops at the ends."""
    d = empty(random)
    d.model.body("arm", mass=d.uniform(0.5, 3), inertia=0.2, points={"O": (0, 0)})
    d.model.body("bead", mass=d.uniform(0.1, 1), inertia=0.01, points={"C": (0, 0)})
    d.model.revolute("pin", "ground.O", "arm.O")
    if d.chance(0.5):
        d.model.pin_in_slot("slot", "arm.O", "bead.C")
        d.set |= {"bead.angle": 0.0, "bead.omega": speed(d)}
    else:
        d.model.translational("slot", "arm.O", "bead.C")
    friction(d, "slot", 0.8)
    friction(d, "pin", 0.4)
    at, out = angle(d), d.uniform(0.2, 0.6)
    d.set |= {"slot.displacement": out, "slot.rate": speed(d, 3), "arm.angle": at}
    stop(d, "slot.displacement", out, 1.0, 0.4)
    spring(d, "ground.O", "bead.C")
    if d.chance(0.3):
        driver(d, "arm.angle", at)
    else:
        d.set |= {"arm.omega": speed(d)}
        stop(d, "arm.angle", at, 0.3)
    return d


def balls(random: Random) -> Drawn:
    """Balls and points that fall on a line, a circle, a ring or a wavy floor, and on each other."""
    d = empty(random)
    floor = rim(d, "floor", centre=(0.0, -1.0))
    count = int(random.integers(1, 4))
    for k in range(count):
        r = d.uniform(0.05, 0.12)
        mass = d.uniform(0.2, 3)
        d.model.body(
            f"b{k}",
            mass=mass,
            inertia=0.5 * mass * r**2,
            points={"C": (0, 0), "E": (d.uniform(-r, r), 0)},
            curves={"rim": {"circle": (0, 0, r)}},
        )
        x, y = 0.35 * (k - 1) + d.uniform(-0.05, 0.05), d.uniform(0.0, 0.4)
        d.set |= {f"b{k}.x": x, f"b{k}.y": y, f"b{k}.angle": 0.0}
        d.set |= {f"b{k}.vx": speed(d, 3), f"b{k}.vy": speed(d, 3), f"b{k}.omega": speed(d)}
        fields = touch(d, 1.5, rubs=True)
        side = "left" if floor == "ring" else "right"
        d.model.contact(f"c{k}", f"b{k}.C", "ground.floor", radius=r, side=side, **fields)
        for other in range(k):
            fields = touch(d, 1.5, rubs=True)
            d.model.contact(f"c{other}{k}", f"b{k}.C", f"b{other}.rim", radius=r, **fields)
        spring(d, "ground.O", f"b{k}.E", 0.2)
    return d


def hammer(random: Random) -> Drawn:
    """A crank that is driven or swings and hits a pendulum or a block with friction."""
    d = empty(random)
    bar(d, "crank", 0.5)
    d.model.revolute("pin", "ground.O", "crank.A")
    friction(d, "pin", 0.3)
    d.model.ground.points(D=(0.9, 0))
    curves = {"face": d.one([{"circle": (0, 0, 0.15)}, {"polar": "0.15 + 0.02*cos(3*u)"}])}
    d.model.body(
        "target", mass=d.uniform(0.2, 2), inertia=0.02, points={"P": (0, 0)}, curves=curves
    )
    d.model.contact("blow", "crank.B", "target.face", radius=0.05, **touch(d, 1.5, rubs=True))
    if d.chance(0.5):
        d.model.translational("slide", "ground.D", "target.P")
        d.set |= {"slide.displacement": d.uniform(-0.1, 0.3)}
        d.set |= {"slide.rate": 0.0}
        friction(d, "slide", 0.7)
        stop(d, "slide.displacement", 0.1, 0.3, 1.0)
    else:
        bar(d, "rod", 0.3)
        d.model.revolute("swing", "ground.D", "rod.A")
        d.model.revolute("hold", "rod.B", "target.P")
        d.set |= {"rod.angle": d.uniform(-2.5, -0.5), "rod.omega": 0.0}
        d.set |= {"target.angle": 0.0, "target.omega": 0.0}
        friction(d, "swing", 0.5)
        friction(d, "hold", 0.5)
    at = d.one([1.0, -1.0]) * d.uniform(1.4, 2.5)
    d.set |= {"crank.angle": at}
    if d.chance(0.3):
        driver(d, "crank.angle", at, -np.sign(at))
    else:
        d.set |= {"crank.omega": -np.sign(at) * d.uniform(0, 8)}
    return d


def driver(d: Drawn, coordinate: str, at: float, sense: float = 1.0) -> None:
    """A smooth motion of a coordinate from its value at the start."""
    rate, extent, pulse = d.uniform(1, 6), d.uniform(0, 0.5), d.uniform(2, 12)
    law = f"{at} + {sense * rate}*t + {extent}*(1 - cos({pulse}*t))"
    d.model.coordinate_driver("motor", coordinate, value=law)
    d.set.pop(coordinate)


def rim(d: Drawn, name: str, centre: tuple[float, float]) -> str:
    """A curve of ground; its kind."""
    kind = str(d.one(["line", "circle", "ring", "wavy", "spline"]))
    x, y = centre
    tilt = d.uniform(-0.4, 0.4)
    u = np.linspace(0, 2 * np.pi, 13)[:-1]
    radii = 0.5 + 0.05 * d.random.uniform(-1, 1, len(u))
    points = np.column_stack([x + radii * np.cos(u), y + radii * np.sin(u)]).tolist()
    curve = {
        "line": {"line": ((x + 20, y + 20 * tilt), (x - 20, y - 20 * tilt))},
        "circle": {"circle": (x, y, 0.5)},
        "ring": {"circle": (0, 0, 2.5)},
        "wavy": {"x": f"{x} - u", "y": f"{y} + 0.1*sin(3*u)", "range": [-12, 12]},
        "spline": {"points": points, "periodic": True},
    }[kind]
    d.model.ground.curves(**{name: curve})
    return kind


#: The kinds of mechanisms by name.
KINDS: dict[str, Callable[[Random], Drawn]] = {
    made.__name__: made for made in (chain, four_bar, slider_crank, bead, balls, hammer)
}
