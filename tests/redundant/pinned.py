"""Classic redundancies of pins, slides and bars, each with its start and the joints in it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import kempe as kp

G = (0.3, -9.81)


@dataclass(frozen=True)
class Redundant:
    """A mechanism with redundant joints.

    Attributes:
        model: the mechanism; it refuses redundancy.
        count: number of redundant equations.
        joints: all joints that take part.
        start: what is set, and what is guessed.
    """

    model: kp.Model
    count: int
    joints: set[str]
    start: dict[str, float] = field(default_factory=dict)
    guess: dict[str, float] = field(default_factory=dict)


def beam_on_two_pins() -> Redundant:
    """Both ends are pinned: the beam cannot be stretched."""
    m = kp.Model("beam on two pins", gravity=G)
    m.ground.points(A=(0, 0), B=(2, 0))
    m.body("beam", mass=3, inertia=1, center=(1, 0), points={"A": (0, 0), "B": (2, 0)})
    m.revolute("A", "ground.A", "beam.A")
    m.revolute("B", "ground.B", "beam.B")
    return Redundant(m, 1, {"A", "B"})


def tilted_beam() -> Redundant:
    """A beam at 30° on a disc that turns."""
    m = kp.Model("beam on a disc", gravity=G)
    m.ground.points(O=(0, 0))
    ends = {"P": (0.1, 0.2), "Q": (0.1 + 0.75**0.5, 0.7)}
    m.body("disc", mass=5, inertia=2, center=(0.1, 0), points={"O": (0, 0), **ends})
    m.body("beam", mass=1, inertia=0.2, points={"P": (-0.5, 0), "Q": (0.5, 0)})
    m.revolute("O", "ground.O", "disc.O")
    m.revolute("P", "disc.P", "beam.P")
    m.revolute("Q", "disc.Q", "beam.Q")
    return Redundant(m, 1, {"P", "Q"}, {"disc.angle": 0.2}, {"beam.angle": 0.7})


def cranks(count: int) -> Redundant:
    """Equal cranks on one rod."""
    m = kp.Model(f"{count} cranks", gravity=G)
    m.ground.points(**{f"G{k}": (k, 0) for k in range(count)})
    m.body("rod", mass=2, inertia=1, points={f"P{k}": (k, 0) for k in range(count)})
    for k in range(count):
        m.bar(f"crank{k}", mass=1, length=0.6, ends=("A", "B"))
        m.revolute(f"A{k}", f"ground.G{k}", f"crank{k}.A")
        m.revolute(f"B{k}", f"crank{k}.B", f"rod.P{k}")
    guess = {f"crank{k}.angle": 1.2 for k in range(1, count)} | {"rod.angle": 0.0}
    return Redundant(m, count - 2, set(m.compile().joints), {"crank0.angle": 1.2}, guess)


def double_parallelogram() -> Redundant:
    """Two levers with two rods between them."""
    m = kp.Model("double parallelogram", gravity=G)
    m.ground.points(G0=(0, 0), G1=(1, 0))
    for k in (0, 1):
        points = {"A": (0, 0), "B": (0.5, 0), "C": (0.9, 0)}
        m.body(f"lever{k}", mass=1, inertia=0.1, center=(0.4, 0), points=points)
        m.bar(("lower", "upper")[k], mass=1, length=1, ends=("P", "Q"))
        m.revolute(f"A{k}", f"ground.G{k}", f"lever{k}.A")
    for k, end in ((0, "P"), (1, "Q")):
        m.revolute(f"B{k}", f"lever{k}.B", f"lower.{end}")
        m.revolute(f"C{k}", f"lever{k}.C", f"upper.{end}")
    guess = {"lever1.angle": 1.0, "lower.angle": 0.0, "upper.angle": 0.0}
    return Redundant(m, 1, {"A0", "A1", "B0", "B1", "C0", "C1"}, {"lever0.angle": 1.0}, guess)


def guides_in_line() -> Redundant:
    """A carriage in two guides on one line."""
    m = kp.Model("guides in line", gravity=(2.0, -9.81))
    m.ground.points(A=(0, 0), B=(0, 0))
    m.body("carriage", mass=2, inertia=1, center=(0.3, 0.2), points={"A": (0, 0), "B": (0.8, 0)})
    m.translational("A", "ground.A", "carriage.A")
    m.translational("B", "ground.B", "carriage.B")
    return Redundant(m, 2, {"A", "B"})


def drawer() -> Redundant:
    """A drawer in a rail on each side."""
    m = kp.Model("drawer", gravity=(2.0, -9.81))
    m.ground.points(L=(0, 0), R=(0, 0.6))
    m.body("drawer", mass=4, inertia=1, center=(0.2, 0.3), points={"L": (0, 0), "R": (0, 0.6)})
    m.translational("left", "ground.L", "drawer.L")
    m.translational("right", "ground.R", "drawer.R")
    return Redundant(m, 2, {"left", "right"})


def slide_with_pin() -> Redundant:
    """The crosshead of a slider-crank has a guide and a pin in a groove on the same line."""
    m = kp.Model("slide with pin", gravity=G)
    m.ground.points(O=(0, 0), S=(0, 0))
    m.bar("crank", mass=1, length=0.3, ends=("O", "A"))
    m.bar("rod", mass=1, length=0.9, ends=("A", "B"))
    m.body("slider", mass=2, inertia=0.1, points={"B": (0, 0), "K": (0.2, 0)})
    m.revolute("O", "ground.O", "crank.O")
    m.revolute("A", "crank.A", "rod.A")
    m.revolute("B", "rod.B", "slider.B")
    m.translational("guide", "ground.S", "slider.B")
    m.pin_in_slot("groove", "ground.S", "slider.K")
    return Redundant(m, 1, {"guide", "groove"}, {"crank.angle": 0.8}, {"rod.angle": -0.3})


def welded_triangle() -> Redundant:
    """A triangle of three bars, welded at each corner, swings about one corner."""
    m = kp.Model("welded triangle", gravity=G)
    m.ground.points(O=(0, 0))
    for name in ("a", "b", "c"):
        m.bar(name, mass=1, length=1, ends=("P", "Q"))
    third = 2.0943951023931953
    m.revolute("O", "ground.O", "a.P")
    m.weld("ab", "a.Q", "b.P", angle=third)
    m.weld("bc", "b.Q", "c.P", angle=third)
    m.weld("ca", "c.Q", "a.P", angle=third - 2 * 3.141592653589793)
    guess = {"b.angle": 0.3 + third, "c.angle": 0.3 + 2 * third}
    return Redundant(m, 3, {"ab", "bc", "ca"}, {"a.angle": 0.3}, guess)


def scott_russell() -> Redundant:
    """A straight-line link with both slots and the link that replaces one of them."""
    m = kp.Model("Scott-Russell", gravity=G)
    m.ground.points(O=(0, 0))
    m.body("link", mass=2, inertia=0.4, points={"A": (-0.5, 0), "C": (0, 0), "B": (0.5, 0)})
    m.bar("arm", mass=1, length=0.5, ends=("O", "C"))
    m.revolute("O", "ground.O", "arm.O")
    m.revolute("C", "arm.C", "link.C")
    m.pin_in_slot("A", "ground.O", "link.A")
    m.pin_in_slot("B", "ground.O", "link.B", axis="90 deg")
    guess = {"link.angle": 3.141592653589793 - 0.7, "link.x": 0.38, "link.y": 0.32}
    return Redundant(m, 1, {"O", "C", "A", "B"}, {"arm.angle": 0.7}, guess)


def pantograph() -> Redundant:
    """A pantograph whose parallelogram has a further bar parallel to its sides."""
    m = kp.Model("pantograph", gravity=G)
    m.ground.points(O=(0, 0))
    points = {"O": (0, 0), "A": (0.4, 0), "M": (0.6, 0), "B": (0.8, 0)}
    m.body("arm", mass=1, inertia=0.1, center=(0.4, 0), points=points)
    m.body("tip", mass=1, inertia=0.1, points={"B": (0, 0), "D": (0.4, 0), "P": (0.8, 0)})
    m.bar("side", mass=1, length=0.4, ends=("A", "E"))
    m.bar("middle", mass=1, length=0.4, ends=("M", "N"))
    m.body("foot", mass=1, inertia=0.1, points={"E": (0, 0), "N": (0.2, 0), "D": (0.4, 0)})
    m.revolute("O", "ground.O", "arm.O")
    for pin, i, j in (
        ("A", "arm", "side"),
        ("B", "arm", "tip"),
        ("M", "arm", "middle"),
        ("E", "side", "foot"),
        ("N", "middle", "foot"),
        ("D", "tip", "foot"),
    ):
        m.revolute(pin, f"{i}.{pin}", f"{j}.{pin}")
    angles = {"side.angle": -0.9, "middle.angle": -0.9, "foot.angle": 0.5}
    start = {"arm.angle": 0.5, "tip.angle": -0.9}
    return Redundant(m, 1, {"A", "B", "M", "E", "N", "D"}, start, angles)


def scissor_lift() -> Redundant:
    """A scissor lift whose platform is guided upright as well."""
    m = kp.Model("scissor lift", gravity=G)
    m.ground.points(A=(0, 0), S=(0, 0))
    for name in ("rising", "falling"):
        points = {"low": (-0.6, 0), "mid": (0, 0), "high": (0.6, 0)}
        m.body(name, mass=1, inertia=0.1, points=points)
    m.body("platform", mass=3, inertia=0.3, center=(0.5, 0), points={"A": (0, 0)})
    m.revolute("A", "ground.A", "rising.low")
    m.pin_in_slot("B", "ground.A", "falling.high")
    m.revolute("mid", "rising.mid", "falling.mid")
    m.revolute("C", "platform.A", "falling.low")
    m.pin_in_slot("D", "platform.A", "rising.high")
    m.translational("guide", "ground.S", "platform.A", axes=("90 deg", "90 deg"))
    guess = {"falling.angle": -0.6, "falling.x": 0.5, "falling.y": 0.34}
    guess |= {"platform.x": 0.0, "platform.y": 0.68, "platform.angle": 0.0}
    return Redundant(m, 2, {"A", "B", "mid", "C", "D", "guide"}, {"rising.angle": 0.6}, guess)


def swing() -> Redundant:
    """A board on three ropes of equal length."""
    m = kp.Model("swing", gravity=G)
    m.ground.points(A=(0, 1), B=(0.5, 1), C=(1, 1))
    points = {"A": (-0.5, 0), "B": (0, 0), "C": (0.5, 0)}
    m.body("board", mass=5, inertia=0.5, points=points)
    for name in points:
        m.distance(name, f"ground.{name}", f"board.{name}", length=0.8)
    guess = {"board.y": 0.3, "board.angle": 0.0}
    return Redundant(m, 1, {"A", "B", "C"}, {"board.x": 0.7}, guess)


def shaft_in_three_bearings() -> Redundant:
    """A rod slides in three bushings."""
    m = kp.Model("three bearings", gravity=(2.0, -9.81))
    m.ground.points(A=(0, 0), B=(1, 0), C=(2, 0))
    points = {"A": (0, 0), "B": (1, 0), "C": (2, 0)}
    m.body("shaft", mass=3, inertia=1, center=(1.2, 0), points=points)
    for name in points:
        m.pin_in_slot(name, f"ground.{name}", f"shaft.{name}")
    return Redundant(m, 1, {"A", "B", "C"})


def twin_hinge() -> Redundant:
    """A lever with the same pin twice."""
    m = kp.Model("twin hinge", gravity=G)
    m.ground.points(A=(0, 0))
    m.bar("lever", mass=1, length=1, ends=("A", "B"))
    m.revolute("A", "ground.A", "lever.A")
    m.revolute("A2", "ground.A", "lever.A")
    return Redundant(m, 2, {"A", "A2"}, {"lever.angle": 0.4})


def three_sliders() -> Redundant:
    """A Cardan disc with three points on straight lines."""
    m = kp.Model("three sliders", gravity=G)
    m.ground.points(O=(0, 0))
    circle = {"A": (0.5, 0), "B": (-0.25, 0.4330127018922193), "C": (-0.25, -0.4330127018922193)}
    m.body("disc", mass=2, inertia=0.3, points={"M": (0, 0), **circle})
    for name, axis in (("A", 0), ("B", 60), ("C", -60)):
        m.pin_in_slot(name, "ground.O", f"disc.{name}", axis=f"{axis} deg")
    guess = {"disc.x": 0.46, "disc.y": -0.19}
    return Redundant(m, 1, {"A", "B", "C"}, {"disc.angle": 0.4}, guess)


PINNED: dict[str, Callable[[], Redundant]] = {
    "beam on two pins": beam_on_two_pins,
    "beam on a disc": tilted_beam,
    "three cranks on a rod": lambda: cranks(3),
    "five cranks on a rod": lambda: cranks(5),
    "double parallelogram": double_parallelogram,
    "two guides in line": guides_in_line,
    "drawer in two rails": drawer,
    "slide with pin and groove": slide_with_pin,
    "welded triangle": welded_triangle,
    "Scott-Russell with slot and link": scott_russell,
    "pantograph with a further arm": pantograph,
    "guided scissor lift": scissor_lift,
    "swing on three ropes": swing,
    "shaft in three bearings": shaft_in_three_bearings,
    "the same pin twice": twin_hinge,
    "Cardan disc with three slots": three_sliders,
}
