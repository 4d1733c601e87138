"""Wear where the sliding reverses, and friction of two curves in both orders."""

from typing import Any

import kempe as kp
import numpy as np
import pytest

SIZES = [1.0, 1e-3, 1e3]


@pytest.mark.parametrize("size", SIZES)
def test_wear_where_the_sliding_reverses(size: float) -> None:
    """A driven disc slides to and fro under a constant load; each reversal bends the rates."""
    m = kp.Model("disc", gravity=(0, 0))
    m.ground.curves(floor={"line": ((3 * size, 0), (-3 * size, 0))})
    m.body("disc", mass=1, inertia=0.1 * size**2, points={"C": (0, 0)})
    law: dict[str, Any] = {"radius": size, "stiffness": 500 / size, "exponent": 1}
    m.contact(
        "touch", "disc.C", "ground.floor", friction=0.3, velocity=0.01 * size, wear=1e-9, **law
    )
    m.coordinate_driver("turn", "disc.angle", value=0)
    m.coordinate_driver("lift", "disc.y", value=0.99 * size)
    m.coordinate_driver("feed", "disc.x", value=f"{0.3 * size!r}*sin(7*t)")
    sol = kp.dynamics(m, kp.assemble(m), t_end=4 * np.pi / 7)
    way = 8 * 0.3 * size
    assert sol["touch.sliding_distance"][-1] == pytest.approx(way, rel=1e-9)
    assert sol["touch.wear_volume"][-1] == pytest.approx(1e-9 * 5.0 * way, rel=1e-9)


def test_wear_without_sliding() -> None:
    """A disc falls along the normal of an inclined floor, and slides by rounding errors only."""
    c, s = np.cos(1.1), np.sin(1.1)
    m = kp.Model("disc", gravity=(9.81 * s, -9.81 * c))
    m.ground.curves(floor={"line": ((3 * c, 3 * s), (-3 * c, -3 * s))})
    m.body("disc", mass=1, inertia=0.1, points={"C": (0, 0)})
    law: dict[str, Any] = {"radius": 0.1, "stiffness": 1e6, "damping": 0.2}
    m.contact("touch", "disc.C", "ground.floor", friction=0.3, velocity=0.01, wear=1e-12, **law)
    start = kp.assemble(m, {"disc.x": -0.3 * s, "disc.y": 0.3 * c, "disc.angle": 0})
    sol = kp.dynamics(m, start, t_end=0.6)
    assert sol["touch.force"].max() > 9.81
    assert sol["touch.sliding_distance"][-1] < 1e-10


def circle(radius: float) -> dict[str, Any]:
    return {"circle": (0, 0, radius)}


def oval(a: float, b: float) -> dict[str, Any]:
    formulas = {"x": f"{a!r}*cos(u)", "y": f"{b!r}*sin(u)*(1+0.2*cos(u))"}
    return {**formulas, "range": [0, "2*pi"], "periodic": True}


def pressed(order: list[str], curves: list[dict[str, Any]], size: float) -> kp.State:
    """Two bodies that overlap and slide."""
    m = kp.Model("two curves", gravity=(0, 0))
    for name, rim in zip("ab", curves, strict=True):
        m.body(name, mass=1, inertia=0.1 * size**2, curves={"rim": rim})
    law: dict[str, Any] = {"stiffness": 1e4 / size**1.5, "friction": 0.4, "velocity": 0.1 * size}
    m.contact("touch", curves=order, **law)
    names = ["x", "y", "angle", "vx", "vy", "omega"]
    rest = {f"{body}.{name}": 0.0 for body in "ab" for name in names}
    moving = {"b.x": 2.9 * size, "b.vy": 0.3 * size, "a.omega": 0.7, "b.angle": 0.3}
    return kp.assemble(m, {**rest, **moving})


@pytest.mark.parametrize("size", SIZES)
def test_friction_of_two_circles_acts_in_the_middle_of_the_depth(size: float) -> None:
    for order in (["a.rim", "b.rim"], ["b.rim", "a.rim"]):
        state = pressed(order, [circle(size), circle(2 * size)], size)
        depth = 0.1 * size
        arms = np.array([size - depth / 2, 2 * size - depth / 2])
        slide = 0.7 * arms[0] - 0.3 * size
        force = 0.4 * 1e4 * 0.1**1.5 * np.tanh(slide / (0.1 * size))
        found = np.array([state["a.alpha"], state["b.alpha"]]) * 0.1 * size**2
        assert found == pytest.approx(-force * arms, rel=1e-9)


@pytest.mark.parametrize("size", SIZES)
def test_the_order_of_two_smooth_curves_does_not_matter(size: float) -> None:
    curves = [oval(size, 0.8 * size), oval(2 * size, 1.5 * size)]
    one = pressed(["a.rim", "b.rim"], curves, size)
    other = pressed(["b.rim", "a.rim"], curves, size)
    assert one["touch.force"] > 0
    for name in ["a.ax", "a.ay", "a.alpha", "b.ax", "b.ay", "b.alpha"]:
        assert one[name] == pytest.approx(other[name], rel=1e-9), name


def test_the_speed_of_an_impact_is_no_mode() -> None:
    """A disc rests on a floor: one mode for each coordinate, none for the speed of its impact."""
    m = kp.Model("disc", gravity=(0, -9.81))
    m.ground.curves(floor={"line": ((1, 0), (-1, 0))})
    m.body("disc", mass=2, inertia=0.1, points={"C": (0, 0)})
    law: dict[str, Any] = {"law": "flores", "restitution": 0.6}
    m.contact("touch", "disc.C", "ground.floor", radius=0.1, stiffness=1e5, exponent=1, **law)
    m.generalized_force("along", "disc.x", value="-20*disc.x")
    m.generalized_force("turn", "disc.angle", value="-10*disc.angle")
    rest = kp.equilibrium(m, kp.assemble(m, {"disc.x": 0, "disc.y": 0.0995, "disc.angle": 0}))
    expected = np.sqrt([20 / 2, 10 / 0.1, 1e5 / 2])
    assert kp.modes(m, rest.state).omega == pytest.approx(expected, rel=1e-9)
