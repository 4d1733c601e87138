"""Cases for FMUs, with the inputs and outputs that the tests use."""

from __future__ import annotations

from dataclasses import dataclass

import kempe as kp


@dataclass(frozen=True)
class Machine:
    case: kp.Case
    inputs: tuple[str, ...]
    outputs: tuple[str, ...]


def inverted_pendulum() -> kp.Case:
    """That of docs/stepping.md: a rod on a cart that a force drives."""
    m = kp.Model("inverted pendulum", gravity=(0, -9.81), parameters={"F": 0})
    m.ground.points(O=(0, 0))
    m.body("cart", mass=1.5, inertia=0.01, points={"S": (0, 0)})
    m.bar("rod", mass=0.4, length=0.7, ends=("P", "E"))
    m.translational("rail", "ground.O", "cart.S")
    m.revolute("pin", "cart.S", "rod.P")
    m.force("drive", "cart.S", force=("F", 0))
    return kp.Case(m, {"set": {"cart.x": 0, "rod.angle": "98 deg", "cart.vx": 0, "rod.omega": 0}})


def machine(name: str) -> Machine:
    if name == "four_bar":
        outputs = ("crank.angle", "rocker.omega", "coupler.C.ax", "spring.torque", "C.force")
        case = kp.load("examples/four_bar.toml")
        return Machine(case, ("k", "c"), (*outputs, "energy.total", "energy.dissipated"))
    if name == "motor_press":
        outputs = ("wheel.omega", "ram.y", "workpiece.force", "guide.force", "energy.work")
        return Machine(kp.load("examples/motor_press.toml"), ("stall", "free"), outputs)
    outputs = ("cart.x", "rod.angle", "rod.omega", "pin.fy", "rail.torque")
    return Machine(inverted_pendulum(), ("F",), outputs)


MACHINES = ("four_bar", "motor_press", "inverted_pendulum")
VERSIONS = ("2.0", "3.0")


def ball(restitution: float = 0.8, *, end: str = "") -> kp.Case:
    """A ball that falls from 5 m onto a floor, in 1 s; an event may end the run."""
    m = kp.Model("ball", gravity=(0, -10), parameters={"height": 5, "e": restitution})
    m.point_mass("ball", mass=1)
    m.stop("floor", "ball.y", lower=0.0, restitution="e")
    start = {"ball.x": 0, "ball.y": "height", "ball.vx": 0, "ball.vy": 0}
    analysis = kp.Dynamics(20.0, stop=end) if end else kp.Dynamics(20.0)
    return kp.Case(m, {"set": start}, {"fall": analysis.tree()})
