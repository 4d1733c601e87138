"""Slopes of random motions with hits, friction, switches and releases, against differences."""

import warnings
from collections.abc import Callable
from typing import Any

import kempe as kp
import numpy as np
import pytest
from gradients.test_random import differences
from sizes import count

EXACT = kp.DOP853(rtol=1e-12, atol=1e-14)
#: Relative changes of a variable. Larger ones would change the order of events.
STEPS = (2e-5, 4e-5, 8e-5)
#: Largest error of a slope, as a part of its scale.
MOST = 1e-6
Made = tuple[kp.Model, dict[str, float], list[str], float]


class Numbers:
    """Random numbers for a size, a mass and a rate over some orders of magnitude."""

    def __init__(self, seed: int) -> None:
        self.draw = np.random.default_rng(seed)
        self.size, self.mass, self.rate = (10.0 ** self.draw.uniform(-2, 2) for _ in range(3))
        self.g = 9.81 * self.size * self.rate**2
        self.inertia = self.mass * self.size**2
        self.k = self.mass * self.rate**2

    def near(self, x: float) -> float:
        return float(x * self.draw.uniform(0.8, 1.25))


def double_pendulum(of: Numbers) -> Made:
    """A stop with restitution, or a soft one, between two bars."""
    numbers = {"m2": of.near(of.mass), "L1": of.near(of.size), "g": of.g, "most": of.near(0.35)}
    m = kp.Model("double", gravity=(0, "-g"), parameters=numbers)
    m.ground.points(O=(0, 0))
    m.bar("one", mass=of.mass, length="L1", ends=("O", "A"))
    m.bar("two", mass="m2", length=0.7 * of.size, ends=("A", "B"))
    m.revolute("O", "ground.O", "one.O")
    m.revolute("A", "one.A", "two.A")
    soft = {"stiffness": of.near(3e3 * of.g * of.mass * of.size), "damping": 0.2 / of.rate}
    law: dict[str, Any] = soft if of.draw.random() < 0.5 else {"restitution": of.near(0.6)}
    m.stop("stop", "A.angle", lower="-most", upper="most", **law)
    start = {"one.angle": of.near(-0.6), "A.angle": of.near(0.2)}
    return m, start, ["two.angle.final", "two.B.x.final", "one.omega.max"], of.near(3.0)


def stick_slip(of: Numbers) -> Made:
    """A driven spring pulls a block with static friction."""
    load = of.k * of.size
    numbers = {"m": of.mass, "k": of.near(4 * of.k), "mu": of.near(0.3), "u": of.near(0.6)}
    m = kp.Model("stick", gravity=(0, 0), parameters=numbers)
    m.ground.points(O=(0, 0))
    m.body("block", mass="m", inertia=of.inertia, points={"P": (0, 0)})
    m.translational("guide", "ground.O", "block.P")
    pull = f"k * (u * {of.size * of.rate} * t - block.x)"
    m.generalized_force("spring", "block.x", value=pull)
    m.friction("rubs", "guide", kinetic="mu", static=of.near(0.7), load=load)
    return m, {"block.x": 0.0}, ["block.x.final", "block.vx.max"], of.near(4.0)


def cradle(of: Numbers) -> Made:
    """Three balls on a line, with different restitutions."""
    r = 0.1 * of.size
    numbers = {"m1": of.mass, "m2": of.near(of.mass), "e": of.near(0.6), "x3": of.near(of.size)}
    m = kp.Model("cradle", gravity=(0, 0), parameters=numbers)
    m.ground.points(O=(0, 0))
    for k, mass in enumerate(["m1", "m2", of.near(2 * of.mass)], 1):
        rim = {"circle": (0, 0, r)}
        m.body(f"b{k}", mass=mass, inertia=of.inertia, points={"C": (0, 0)}, curves={"rim": rim})
        m.translational(f"guide{k}", "ground.O", f"b{k}.C")
    m.contact("c12", "b1.C", "b2.rim", radius=r, restitution="e")
    m.contact("c23", "b2.C", "b3.rim", radius=r, restitution=of.near(0.75))
    m.generalized_force("pull", "b3.x", value=-0.3 * of.mass * of.size * of.rate**2)
    start = {"b1.x": 0.0, "b1.vx": of.near(of.size * of.rate), "b2.x": 0.4 * of.size, "b3.x": "x3"}
    measures = ["b1.x.final", "b2.vx.final", "b3.x.final", "energy.dissipated.final"]
    return m, start, measures, of.near(2.0)  # type: ignore[return-value]


def four_bar(of: Numbers) -> Made:
    """A four-bar linkage with laws that switch, a rope and friction in a pin."""
    numbers = {"crank": 0.3 * of.size, "rod": of.near(of.size), "at": of.near(0.4) / of.rate}
    numbers |= {"k": of.near(30 * of.k), "dead": of.near(0.1), "c": of.near(0.2)}
    torque = of.near(of.mass * of.g * of.size)
    table = {
        "x": [-3, -1, 0.5, 2, 4],
        "y": [0, 0.6, -0.2, 0.9, 0.1],
        "interpolation": "linear",
        "outside": "hold",
    }
    m = kp.Model("four-bar", gravity=(0, -of.g), parameters=numbers)
    m.table("wave", **table)
    m.ground.points(O=(0, 0), D=(of.size, 0))
    m.bar("a", mass=of.mass, length="crank", ends=("O", "A"))
    m.bar("b", mass=of.mass, length="rod", ends=("A", "B"))
    m.bar("d", mass=of.mass, length=0.8 * of.size, ends=("B", "D"))
    m.revolute("O", "ground.O", "a.O")
    m.revolute("A", "a.A", "b.A")
    m.revolute("B", "b.B", "d.B")
    m.revolute("D", "ground.D", "d.D")
    m.torque("motor", "a", torque=f"if(t < at, {torque}, 0) - {torque / of.rate} * a.omega / 9")
    band = f"-{torque} * (max(0, d.angle + 1 - dead) + min(0, d.angle + 1 + dead))"
    m.torque("band", "d", torque=band)
    m.torque("wavy", "b", torque=f"{torque} * wave(5 * b.angle)")
    m.spring_damper(
        "rope", "ground.O", "b.B", stiffness="k", free_length=of.near(1.3 * of.size), only="tension"
    )
    m.friction("rubs", "A", kinetic="c", radius=0.05 * of.size, velocity=0.1 * of.rate)
    return (
        m,
        {"a.angle": of.near(1.2)},
        ["b.angle.final", "d.omega.final", "a.omega.max"],
        of.near(1.6),
    )


def released(of: Numbers) -> Made:
    """A driver with a law in pieces lifts a bar and lets it go; it falls onto a soft stop."""
    numbers = {"m": of.mass, "L": of.size, "t1": of.near(1.0) / of.rate, "up": of.near(1.1)}
    m = kp.Model("released", gravity=(0, "-g"), parameters={**numbers, "g": of.g})
    m.ground.points(O=(0, 0))
    m.bar("bar", mass="m", length="L", ends=("O", "A"))
    m.revolute("O", "ground.O", "bar.O")
    m.coordinate_driver(
        "lift", "bar.angle", value="step5(t, 0, 0, t1, up)", release="bar.angle > up / 2"
    )
    m.stop("rest", "bar.angle", lower=-0.1, stiffness=of.near(900 * of.k * of.size**2))
    return m, {}, ["bar.angle.max", "bar.omega.min", "rest.torque.final"], 2.0


MADE: list[Callable[[Numbers], Made]] = [double_pendulum, stick_slip, cradle, four_bar, released]


@pytest.mark.parametrize("seed", range(count(20, 200)))
def test_slopes_of_a_random_motion_with_events(seed: int) -> None:
    of = Numbers(seed)
    m, start, measures, end = MADE[seed % len(MADE)](of)
    run = kp.Dynamics(t_end=end / of.rate, method=EXACT)
    case = kp.Case(m, {"set": start}, [run])
    variables = [name for name in m.parameters if name != "g"]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        g = kp.gradient(case, measures, variables)
        true, doubt = differences(case, g, STEPS)
    given = np.abs(list(g.variables.values()))
    size = np.nanmax(np.abs(np.where(np.isnan(g.jacobian), true, g.jacobian)) * given, axis=1)
    scale = (np.abs(list(g.measures.values())) + size)[:, None] / given
    settled, remarked = doubt < MOST * scale / 10, np.isnan(g.jacobian)
    wrong = ~remarked & settled & ~(np.abs(g.jacobian - true) < MOST * scale)
    told = [
        f"{measures[k]} over {variables[j]}: {g.jacobian[k, j]:.10g}, runs {true[k, j]:.10g}"
        for k, j in np.argwhere(wrong).tolist()
    ]
    assert not told
    assert (~remarked).mean() > 0.5, g.remarks
