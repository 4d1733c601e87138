"""Mechanisms with massless bodies, and their equations in minimal coordinates.

Each mechanism with one degree of freedom has an independent coordinate a; its parts have masses at
points r(a) and moments of inertia with angles f(a). With derivatives by a,

    Σ m r′·(r′ a″ + r″ a′² - g) + Σ J f′ (f′ a″ + f″ a′²) = Q.

The points and angles are closed forms.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable
from dataclasses import dataclass

import kempe as kp
import numpy as np
from numpy.typing import NDArray

G = 9.81
#: Stiffness of the spring on a light rocker, N·m/rad.
SPRING = 20.0

Vector = NDArray[np.float64]
#: Derivatives of orders 1 and 2 by the independent coordinate.
Rates = tuple[complex, complex]


def turned(length: float, angle: float, f1: float, f2: float) -> Rates:
    """Derivatives of length e^(i f)."""
    arm = length * cmath.exp(1j * angle)
    return 1j * arm * f1, arm * (1j * f2 - f1 * f1)


@dataclass(frozen=True)
class Part:
    """A mass at a point, and a moment of inertia."""

    mass: float
    point: Rates = (0j, 0j)
    inertia: float = 0.0
    angle: tuple[float, float] = (0.0, 0.0)


def acceleration(parts: list[Part], rate: float, load: float = 0.0) -> float:
    """a″ of the independent coordinate under gravity and a generalized force."""
    inertia, force = 0.0, load
    for part in parts:
        (r1, r2), (f1, f2) = part.point, part.angle
        inertia += part.mass * abs(r1) ** 2 + part.inertia * f1**2
        force -= part.mass * (r1.conjugate() * (r2 * rate**2 + 1j * G)).real
        force -= part.inertia * f1 * f2 * rate**2
    return force / inertia


def bar(mass: float, length: float, end: Rates, rates: tuple[float, float], angle: float) -> Part:
    """A slender bar; ``end`` are the derivatives of its first end."""
    half = turned(length / 2, angle, *rates)
    middle = (end[0] + half[0], end[1] + half[1])
    return Part(mass, middle, mass * length**2 / 12, rates)


FIXED: Rates = (0j, 0j)


@dataclass(frozen=True)
class Case:
    """A mechanism whose light bodies have a mass, and its equation of motion without them."""

    model: Callable[[float], kp.Model]
    given: dict[str, float]
    coordinates: tuple[str, ...]
    rates: Callable[[float, Vector], list[float]]
    #: The mass of the light bodies of the twin.
    twin: float = 0.05
    #: The given values that only choose the assembly mode.
    guessed: tuple[str, ...] = ("rocker.angle",)


def four_bar(mass: float) -> kp.Model:
    m = kp.Model("four-bar with a light coupler", gravity=(0, -G))
    m.ground.points(A=(0, 0), D=(4, 0))
    m.bar("crank", mass=1, length=1, ends=("A", "B"))
    points = {"B": (0, 0), "C": (3, 0.4)}
    m.body("coupler", mass=mass, inertia=mass / 3, center=(1.5, 0.5), points=points)
    m.bar("rocker", mass=2, length=2.5, ends=("D", "C"))
    m.revolute("A", "ground.A", "crank.A")
    m.revolute("B", "crank.B", "coupler.B")
    m.revolute("C", "coupler.C", "rocker.C")
    m.revolute("D", "ground.D", "rocker.D")
    return m


def sprung_four_bar(mass: float) -> kp.Model:
    """Coupler and rocker are light, and a spring acts on the rocker."""
    tree = four_bar(mass).tree()
    tree["bodies"]["rocker"]["mass"] = mass
    m = kp.Model.from_tree(tree)
    m.torsion_spring("spring", "ground", "rocker", stiffness=SPRING, free_angle=2)
    return m


def of_rocker(a: float) -> tuple[float, float, float]:
    """The angle of the rocker and its derivatives."""
    d, l3 = math.hypot(3, 0.4), 2.5
    w = 4 - cmath.exp(1j * a)
    # the angle of the rocker from w + l3 e^(ic) = d e^(ib)
    cosine = (d**2 - l3**2 - abs(w) ** 2) / (2 * l3 * abs(w))
    c = cmath.phase(w) + math.acos(cosine)
    b = cmath.phase(w + l3 * cmath.exp(1j * c))
    columns = np.array([[-d * math.sin(b), l3 * math.sin(c)], [d * math.cos(b), -l3 * math.cos(c)]])

    def solved(right: complex) -> Vector:
        return np.linalg.solve(columns, [right.real, right.imag])

    b1, c1 = solved(-1j * cmath.exp(1j * a))
    second = cmath.exp(1j * a) + d * cmath.exp(1j * b) * b1**2 - l3 * cmath.exp(1j * c) * c1**2
    _, c2 = solved(second)
    return c, c1, c2


def of_four_bar(_: float, y: Vector) -> list[float]:
    a, rate = y
    c, c1, c2 = of_rocker(a)
    crank = bar(1, 1, FIXED, (1, 0), a)
    return [rate, acceleration([crank, bar(2, 2.5, FIXED, (c1, c2), c)], rate)]


def of_sprung_four_bar(_: float, y: Vector) -> list[float]:
    a, rate = y
    c, c1, _c2 = of_rocker(a)
    crank = bar(1, 1, FIXED, (1, 0), a)
    return [rate, acceleration([crank], rate, -SPRING * (c - 2) * c1)]


def slider(a: float, l2: float) -> tuple[float, tuple[float, float], Rates]:
    """The angle of a rod, its derivatives, and those of the slider, for a crank of 1 m."""
    f = -math.asin(math.sin(a) / l2)
    f1 = -math.cos(a) / (l2 * math.cos(f))
    f2 = (math.sin(a) + l2 * math.sin(f) * f1**2) / (l2 * math.cos(f))
    first, second = turned(1, a, 1, 0), turned(l2, f, f1, f2)
    return f, (f1, f2), (first[0] + second[0], first[1] + second[1])


def engine(*, crank: float, rod: float, piston: float) -> kp.Model:
    m = kp.Model("slider-crank", gravity=(0, -G))
    m.ground.points(O=(0, 0))
    m.bar("crank", mass=crank, length=1, ends=("O", "P"))
    m.bar("rod", mass=rod, length=2.5, ends=("P", "Q"))
    m.body("piston", mass=piston, inertia=0.1 * piston, points={"Q": (0, 0)})
    m.revolute("O", "ground.O", "crank.O")
    m.revolute("P", "crank.P", "rod.P")
    m.revolute("Q", "rod.Q", "piston.Q")
    m.translational("S", "ground.O", "piston.Q")
    return m


def of_light_piston(_: float, y: Vector) -> list[float]:
    a, rate = y
    f, rates = slider(a, 2.5)[:2]
    parts = [bar(1, 1, FIXED, (1, 0), a), bar(0.5, 2.5, turned(1, a, 1, 0), rates, f)]
    return [rate, acceleration(parts, rate)]


def of_light_rod(_: float, y: Vector) -> list[float]:
    a, rate = y
    moved = slider(a, 2.5)[2]
    return [rate, acceleration([bar(1, 1, FIXED, (1, 0), a), Part(0.8, moved)], rate)]


def of_crank(_: float, y: Vector) -> list[float]:
    a, rate = y
    return [rate, acceleration([bar(1, 1, FIXED, (1, 0), a)], rate)]


def trammel(mass: float) -> kp.Model:
    m = kp.Model("slider loop: a rod on two sliders", gravity=(0, -G))
    m.ground.points(O=(0, 0))
    m.bar("rod", mass=1, length=2, ends=("A", "B"))
    for name in ("across", "up"):
        m.body(name, mass=mass, inertia=0.1 * mass, points={"P": (0, 0)})
    m.revolute("A", "rod.A", "across.P")
    m.revolute("B", "rod.B", "up.P")
    m.translational("rail", "ground.O", "across.P")
    m.translational("column", "ground.O", "up.P", axes=(math.pi / 2, 0))
    return m


def of_trammel(_: float, y: Vector) -> list[float]:
    # A on the x axis and B on the y axis: the centre is at (-cos a, sin a) and J + m = 4/3
    a, rate = y
    return [rate, -G * math.cos(a) / (4 / 3)]


def loop(mass: float) -> kp.Model:
    """A kinematic loop of massless links, with masses at the elbow and on a sprung slider."""
    m = kp.Model("loop of massless links and a slider", gravity=(0, -G))
    m.ground.points(O=(0, 0), W=(4.5, 0))
    m.bar("first", mass=mass, length=1, ends=("O", "P"))
    m.bar("second", mass=mass, length=2, ends=("P", "Q"))
    m.point_mass("elbow", mass=1)
    m.body("slider", mass=2, inertia=0, points={"Q": (0, 0)})
    m.revolute("O", "ground.O", "first.O")
    m.revolute("P", "first.P", "second.P")
    m.revolute("E", "first.P", "elbow.P")
    m.revolute("Q", "second.Q", "slider.Q")
    m.translational("S", "ground.O", "slider.Q")
    m.spring_damper("spring", "ground.W", "slider.Q", stiffness=40, damping=0.5, free_length=2)
    return m


def of_loop(_: float, y: Vector) -> list[float]:
    a, rate = y
    (f, moved) = slider(a, 2)[::2]
    x, x1 = math.cos(a) + 2 * math.cos(f), moved[0].real
    load = (40 * (4.5 - x - 2) - 0.5 * x1 * rate) * x1
    return [rate, acceleration([Part(1, turned(1, a, 1, 0)), Part(2, moved)], rate, load)]


def rods(mass: float) -> kp.Model:
    m = kp.Model("point masses on massless rods", gravity=(0, -G))
    m.ground.points(O=(0, 0))
    m.bar("upper", mass=mass, length=1, ends=("P", "Q"))
    m.bar("lower", mass=mass, length=1.5, ends=("P", "Q"))
    m.point_mass("near", mass=1)
    m.point_mass("far", mass=2)
    m.revolute("A", "ground.O", "upper.P")
    m.revolute("B", "upper.Q", "near.P")
    m.revolute("C", "near.P", "lower.P")
    m.revolute("D", "lower.Q", "far.P")
    return m


def of_rods(_: float, y: Vector) -> list[float]:
    """The double pendulum; angles from the x axis."""
    a, b, a1, b1 = y
    m1, m2, l1, l2 = 1.0, 2.0, 1.0, 1.5
    c, s = math.cos(a - b), math.sin(a - b)
    mass = [[(m1 + m2) * l1**2, m2 * l1 * l2 * c], [m2 * l1 * l2 * c, m2 * l2**2]]
    right = [
        -m2 * l1 * l2 * s * b1**2 - (m1 + m2) * G * l1 * math.cos(a),
        m2 * l1 * l2 * s * a1**2 - m2 * G * l2 * math.cos(b),
    ]
    return [a1, b1, *np.linalg.solve(mass, right)]


def dlr_loop(mass: float) -> kp.Model:
    """``Examples.KinematicLoop`` of DLR's PlanarMechanics library for Modelica, with its data.

    Two massless links of 0.5 m hang from ground and from a massless slider on the x axis, which has
    a spring of 20 N/m and a damper of 4 N·s/m; at their elbow hangs an arm of 0.6 m with a body of
    1 kg and 0.1 kg·m². The slider is released at 0.4 m, where the spring is relaxed, and the arm at
    -40° from the first link.
    """
    m = kp.Model("kinematic loop of PlanarMechanics", gravity=(0, -G))
    m.ground.points(O=(0, 0), W=(-1, 0))
    m.bar("first", mass=mass, length=0.5, ends=("O", "P"))
    m.bar("second", mass=mass, length=0.5, ends=("Q", "P"))
    m.body("slider", mass=mass, inertia=0.1 * mass, points={"Q": (0, 0)})
    m.body("arm", mass=1, inertia=0.1, center=(0.6, 0), points={"P": (0, 0)})
    m.revolute("O", "ground.O", "first.O")
    m.revolute("Q", "slider.Q", "second.Q")
    m.revolute("P", "first.P", "second.P")
    m.revolute("E", "first.P", "arm.P")
    m.translational("S", "ground.O", "slider.Q")
    m.spring_damper("spring", "ground.W", "slider.Q", stiffness=20, damping=4, free_length=1.4)
    return m


def of_dlr_loop(_: float, y: Vector) -> list[float]:
    """The slider at x and the arm at the angle a; the elbow is at (x/2, -h)."""
    x, a, x1, a1 = y
    h = math.sqrt(0.25 - x * x / 4)
    h1, h2 = -x / (4 * h), -1 / (16 * h**3)
    elbow, arm = complex(0.5, -h1), 0.6 * cmath.exp(1j * a)
    # the mass is at elbow + arm: its acceleration is elbow x″ + i arm a″ + the rest
    rest, weight = -1j * h2 * x1**2 - arm * a1**2, -1j * G
    mixed = (elbow.conjugate() * 1j * arm).real
    mass = [[abs(elbow) ** 2, mixed], [mixed, 0.1 + abs(arm) ** 2]]
    push = weight - rest
    right = [
        (elbow.conjugate() * push).real - 20 * (x - 0.4) - 4 * x1,
        ((1j * arm).conjugate() * push).real,
    ]
    return [x1, a1, *np.linalg.solve(mass, right)]


#: The first link starts asin(0.4 / 0.5 / 2) from the vertical.
TILT = math.asin(0.4)
CRANK = {"crank.angle": 0.6, "crank.omega": 4.0}
CASES = {
    "coupler": Case(
        four_bar,
        {"crank.angle": 0.9, "crank.omega": 3.0, "rocker.angle": 2.0},
        ("crank.angle",),
        of_four_bar,
    ),
    "piston": Case(
        lambda mass: engine(crank=1, rod=0.5, piston=mass), CRANK, ("crank.angle",), of_light_piston
    ),
    "rod": Case(
        lambda mass: engine(crank=1, rod=mass, piston=0.8), CRANK, ("crank.angle",), of_light_rod
    ),
    "rocker and coupler": Case(
        sprung_four_bar,
        {"crank.angle": 0.9, "crank.omega": 3.0, "rocker.angle": 2.0},
        ("crank.angle",),
        of_sprung_four_bar,
    ),
    "piston and rod": Case(
        lambda mass: engine(crank=1, rod=mass, piston=mass), CRANK, ("crank.angle",), of_crank
    ),
    "slider loop": Case(trammel, {"rod.angle": 2.6, "rod.omega": 0.5}, ("rod.angle",), of_trammel),
    "loop": Case(loop, {"first.angle": 1.0, "first.omega": 2.0}, ("first.angle",), of_loop),
    "loop of DLR": Case(
        dlr_loop,
        {
            "slider.x": 0.4,
            "arm.angle": TILT - 0.69813170079773 - math.pi / 2,
            "first.angle": TILT - math.pi / 2,
        },
        ("slider.x", "arm.angle"),
        of_dlr_loop,
        # a heavier slider would be another damped motion: the body lends it only some 0.06 kg
        twin=0.001,
        guessed=("first.angle",),
    ),
    "rods": Case(
        rods,
        {"upper.angle": 0.3, "lower.angle": -0.8},
        ("upper.angle", "lower.angle"),
        of_rods,
    ),
}


FILE = """
kempe = 1
title = "Massless by parameters"
gravity = [0, -9.81]

[parameters]
light = "0 kg"
a = "1 m"

[bodies.ground]
points = { O = [0, 0] }
[bodies.crank]
type = "bar"
mass = 1
length = 1
ends = ["O", "P"]
[bodies.rod]
type = "bar"
mass = "light"
length = 2.5
ends = ["P", "Q"]
[bodies.piston]
mass = "light"
inertia = "light * a * a"
points = { Q = [0, 0] }
[joints.O]
type = "revolute"
i = "ground.O"
j = "crank.O"
[joints.P]
type = "revolute"
i = "crank.P"
j = "rod.P"
[joints.Q]
type = "revolute"
i = "rod.Q"
j = "piston.Q"
[joints.S]
type = "translational"
i = "ground.O"
j = "piston.Q"

[start]
set = { "crank.angle" = 0.6 }

[analyses.run]
type = "dynamics"
t_end = 1
output_step = 0.1
"""
