"""Mechanisms with light bodies between heavy ones, and light freedoms, for any ratio of masses."""

from __future__ import annotations

from collections.abc import Callable

import kempe as kp
from truth.massless import G


def hung(mass: float) -> tuple[kp.Model, dict[str, float]]:
    """A light pendulum on a heavy cart: a light freedom of its own."""
    m = kp.Model("cart", gravity=(0, -G))
    m.ground.points(O=(0, 0))
    m.body("cart", mass=1, inertia=1, points={"P": (0, 0)})
    m.bar("rod", mass=mass, length=1, ends=("P", "Q"))
    m.translational("S", "ground.O", "cart.P")
    m.revolute("P", "cart.P", "rod.P")
    return m, {"cart.x": 0, "cart.vx": 1, "rod.angle": 0.4, "rod.omega": 2}


def slack(mass: float) -> tuple[kp.Model, dict[str, float]]:
    """Three light links between two heavy pendulums: a light freedom between heavy bodies."""
    m = kp.Model("links", gravity=(0, -G))
    m.ground.points(O=(0, 0), E=(3, 0))
    m.bar("left", mass=1, length=1, ends=("O", "P"))
    m.bar("right", mass=1, length=1, ends=("E", "P"))
    for k in range(3):
        m.bar(f"link{k}", mass=mass, length=1.3, ends=("P", "Q"))
    m.revolute("O", "ground.O", "left.O")
    m.revolute("E", "ground.E", "right.E")
    ends = ["left.P", "link0.P", "link0.Q", "link1.P", "link1.Q", "link2.P", "link2.Q", "right.P"]
    for k in range(4):
        m.revolute(f"j{k}", ends[2 * k], ends[2 * k + 1])
    given = {"left.angle": -1.2, "right.angle": -1.7, "link0.angle": -0.6}
    return m, given | {"left.omega": 1, "right.omega": -0.5, "link0.omega": 1}


def chain(*masses: float) -> tuple[kp.Model, dict[str, float]]:
    m = kp.Model("chain", gravity=(0, -G))
    m.ground.points(O=(0, 0))
    last = "ground.O"
    given: dict[str, float] = {}
    for k, mass in enumerate(masses):
        m.bar(f"b{k}", mass=mass, length=1, ends=("P", "Q"))
        m.revolute(f"j{k}", last, f"b{k}.P")
        last = f"b{k}.Q"
        given |= {f"b{k}.angle": 0.3 * k - 1.2, f"b{k}.omega": 0.7 * (-1) ** k + 0.1 * k}
    return m, given


def quick_return(mass: float) -> tuple[kp.Model, dict[str, float]]:
    """A light block that slides on a heavy lever."""
    m = kp.Model("crank and lever", gravity=(0, -G))
    m.ground.points(O=(0, 0), D=(-2, 0))
    m.bar("crank", mass=1, length=1, ends=("O", "P"))
    m.bar("lever", mass=2, length=4, ends=("D", "E"))
    m.body("block", mass=mass, inertia=0.1 * mass, points={"P": (0, 0)})
    m.revolute("O", "ground.O", "crank.O")
    m.revolute("D", "ground.D", "lever.D")
    m.revolute("P", "crank.P", "block.P")
    m.translational("S", "lever.D", "block.P")
    return m, {"crank.angle": 0.7, "crank.omega": 3.0}


def flywheel(mass: float) -> tuple[kp.Model, dict[str, float]]:
    """A wheel with hardly any mass, a light tip that is welded to it, and a light rod."""
    m = kp.Model("flywheel", gravity=(0, -G))
    m.ground.points(O=(0, 0))
    m.body("wheel", mass=mass, inertia=0.4, points={"O": (0, 0), "A": (0.1, 0)})
    m.bar("rod", mass=mass, length=0.3, ends=("A", "B"))
    m.bar("tip", mass=0.5 * mass, length=0.1, ends=("P", "Q"))
    m.body("piston", mass=2, inertia=0, points={"B": (0, 0)})
    m.revolute("O", "ground.O", "wheel.O")
    m.revolute("A", "wheel.A", "rod.A")
    m.revolute("B", "rod.B", "piston.B")
    m.weld("W", "wheel.A", "tip.P", angle=0.5)
    m.translational("S", "ground.O", "piston.B")
    return m, {"wheel.angle": 0.6, "wheel.omega": 4.0}


def six_bar(mass: float) -> tuple[kp.Model, dict[str, float]]:
    """The coupler of a four-bar linkage moves a second dyad; only the first crank is heavy."""
    m = kp.Model("six-bar", gravity=(0, -G))
    m.ground.points(A=(0, 0), D=(4, 0), H=(7, 0))
    m.bar("crank", mass=1, length=1, ends=("A", "B"))
    points = {"B": (0, 0), "C": (3.5, 0), "E": (2, 1)}
    m.body("coupler", mass=mass, inertia=0.5 * mass, points=points)
    m.bar("rocker", mass=mass, length=2.5, ends=("D", "C"))
    m.bar("link", mass=mass, length=4, ends=("E", "F"))
    m.bar("output", mass=mass, length=3, ends=("H", "F"))
    m.revolute("A", "ground.A", "crank.A")
    m.revolute("B", "crank.B", "coupler.B")
    m.revolute("C", "coupler.C", "rocker.C")
    m.revolute("D", "ground.D", "rocker.D")
    m.revolute("E", "coupler.E", "link.E")
    m.revolute("F", "link.F", "output.F")
    m.revolute("H", "ground.H", "output.H")
    m.torsion_spring("load", "ground", "output", stiffness=5, damping=0.5, free_angle=1)
    return m, {"crank.angle": 1.0, "crank.omega": 3.0}


def planets(mass: float) -> tuple[kp.Model, dict[str, float]]:
    """A heavy sun and carrier with a light planet wheel between them."""
    m = kp.Model("planetary gear", gravity=(0, -G))
    m.ground.points(O=(0, 0))
    m.body("sun", mass=1, inertia=0.1, points={"O": (0, 0)})
    m.body("arm", mass=2, inertia=0.4, center=(0.1, 0), points={"O": (0, 0), "P": (0.3, 0)})
    m.body("planet", mass=mass, inertia=0.01 * mass, points={"P": (0, 0)})
    m.body("ring", mass=3, inertia=1, points={"O": (0, 0)})
    m.revolute("O", "ground.O", "sun.O")
    m.revolute("A", "ground.O", "arm.O")
    m.revolute("R", "ground.O", "ring.O")
    m.revolute("P", "arm.P", "planet.P")
    m.gear("inner", "sun.O", "planet.P", radii=(0.2, 0.1))
    m.gear("outer", "planet.P", "ring.O", radii=(0.1, 0.4), internal=True)
    m.torque("drive", "sun", torque=2)
    return m, {"sun.angle": 0, "arm.angle": 0.3, "arm.omega": 1}


def on_rods(mass: float) -> tuple[kp.Model, dict[str, float]]:
    """A heavy weight hangs on a light point that two massless rods hold."""
    m = kp.Model("point on rods", gravity=(0, -G))
    m.ground.points(A=(0, 0), B=(2, 0))
    m.point_mass("node", mass=mass)
    m.bar("weight", mass=1, length=1, ends=("P", "Q"))
    m.distance("left", "ground.A", "node.P", length=1.5)
    m.distance("right", "ground.B", "node.P", length=1.2)
    m.revolute("hook", "node.P", "weight.P")
    return m, {"weight.angle": -1.0, "weight.omega": 2}


LIGHT: dict[str, Callable[[float], tuple[kp.Model, dict[str, float]]]] = {
    "hung": hung,
    "slack": slack,
    "quick return": quick_return,
    "flywheel": flywheel,
    "six-bar": six_bar,
    "planets": planets,
    "point on rods": on_rods,
    "between": lambda r: chain(1, r, 1),
    "ever lighter": lambda r: chain(1, r**0.25, r**0.5, r**0.75, r),
    "ever heavier": lambda r: chain(r, r**0.5, 1),
    "rope": lambda r: chain(r, r, r, r, r, r, 1),
    "mixed": lambda r: chain(1, r, 1, r**0.5, r, r, 1),
}
