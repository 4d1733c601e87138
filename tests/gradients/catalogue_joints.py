"""Small mechanisms in which each joint and each driver matters; all numbers are variables."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

import kempe as kp
import numpy as np


@dataclass
class Made:
    """A mechanism, its start, what is measured, and the analyses that fit."""

    model: kp.Model
    measures: list[str]
    start: dict[str, float] = field(default_factory=dict)
    guess: dict[str, float] = field(default_factory=dict)
    #: The time of a run, in units of the time of the mechanism.
    end: float = 1.0
    analyses: tuple[str, ...] = ("dynamics",)
    #: Whether the motion changes at times that the variables move.
    changes: bool = False


class Units:
    """Random units of length, mass and time, and numbers near given ones in these units."""

    def __init__(self, seed: int) -> None:
        self.draw = np.random.default_rng(seed)
        self.size, self.mass, self.rate = (10.0 ** self.draw.uniform(-2, 2) for _ in range(3))
        self.g = self.size * self.rate**2
        self.force = self.mass * self.g
        self.torque = self.force * self.size
        self.inertia = self.mass * self.size**2
        self.stiffness = self.force / self.size
        self.damping = self.mass * self.rate

    def near(self, x: float) -> float:
        return float(x * self.draw.uniform(0.85, 1.15))

    def model(self, *, weight: bool = True, **given: tuple[float, float]) -> kp.Model:
        """A model with parameters, each a number near the first one, in the unit of the second."""
        numbers = {name: self.near(x) * unit for name, (x, unit) in given.items()}
        pull = (0.0, -self.g) if weight else (0.0, 0.0)
        return kp.Model("element", gravity=pull, parameters=numbers)

    def bar(self, m: kp.Model, name: str, length: Any, ends: tuple[str, str]) -> None:
        m.bar(name, mass=self.near(self.mass), length=length, ends=ends)

    def disc(self, m: kp.Model, name: str, points: Mapping[str, Any], **more: Any) -> None:
        inertia = self.near(0.5) * self.inertia
        m.body(name, mass=self.near(self.mass), inertia=inertia, points=dict(points), **more)


Maker = Callable[[Units], Made]


def slide_on_a_bar(of: Units) -> Made:
    """A block on a swinging bar; laws read the quantities of both joints, which their axes turn."""
    s, one = of.size, 1.0
    m = of.model(a=(0.3, one), b=(0.2, one), c=(0.15, one), d=(0.25, one), k=(3, of.stiffness))
    m.ground.points(O=(0, 0))
    of.bar(m, "bar", s, ("O", "A"))
    of.disc(m, "block", {"P": (0.1 * s, 0.05 * s)})
    m.revolute("pin", "ground.O", "bar.O", axes=("a", "b"))
    m.translational("slide", "bar.O", "block.P", axes=("c", "d"))
    m.generalized_force(
        "back", "slide.displacement", value=f"-k * (slide.displacement - {0.4 * s})"
    )
    m.generalized_force("turn", "pin.angle", value=f"-{0.4 * of.torque} * sin(pin.angle)")
    measures = ["slide.displacement.final", "slide.force.max", "slide.torque.final"]
    measures += ["pin.angle.integral", "pin.force.final", "block.x.final"]
    start = {"pin.angle": of.near(-1.0), "slide.displacement": 0.6 * s, "slide.rate": s * of.rate}
    return Made(m, measures, start, end=1.5)


def rod_with_a_law(of: Units) -> Made:
    """A double pendulum whose lower rod is a distance that changes over the time."""
    s = of.size
    m = of.model(l=(0.8, s), dl=(0.1, s), w=(3, of.rate), L=(1, s))
    m.ground.points(O=(0, 0))
    of.bar(m, "bar", "L", ("O", "A"))
    of.disc(m, "bob", {"P": (0.1 * s, 0)})
    m.revolute("O", "ground.O", "bar.O")
    m.distance("rod", "bar.A", "bob.P", length="l + dl * sin(w * t)")
    start = {"bar.angle": of.near(-1.0), "bar.omega": of.rate, "bob.angle": 0.3}
    start |= {"bob.omega": 0.5 * of.rate, "bob.x": 0.7 * s, "bob.vx": 0.2 * s * of.rate}
    guess = {"bob.y": -1.6 * s}
    measures = ["rod.tension.final", "rod.tension.max", "bob.x.final", "bob.omega.final"]
    measures += ["bar.angle.mean", "energy.work.final", "O.force.final"]
    return Made(m, measures, start, guess)


def bent_bar(of: Units) -> Made:
    """Two bars welded at an angle swing about a pin."""
    m = of.model(bend=(0.7, 1), L=(1, of.size), a=(0.4, of.size))
    m.ground.points(O=(0, 0))
    of.bar(m, "one", "L", ("O", "A"))
    of.bar(m, "two", "a", ("A", "B"))
    m.revolute("O", "ground.O", "one.O")
    m.weld("corner", "one.A", "two.A", angle="bend")
    measures = ["two.B.x.final", "corner.torque.final", "corner.force.max", "one.omega.final"]
    start = {"one.angle": of.near(-0.5), "one.omega": of.rate}
    return Made(m, measures, start, end=2.0)


def yoke(of: Units) -> Made:
    """A crank moves a slide by a pin in its inclined slot."""
    s = of.size
    m = of.model(r=(0.3, s), tilt=(1.2, 1), w=(2, of.rate))
    m.ground.points(O=(0, 0), S=(0, 0))
    of.bar(m, "crank", "r", ("O", "A"))
    of.disc(m, "yoke", {"S": (0, 0)})
    m.revolute("O", "ground.O", "crank.O")
    m.translational("slide", "ground.S", "yoke.S")
    m.pin_in_slot("slot", "yoke.S", "crank.A", axis="tilt")
    m.torque("motor", "crank", torque=f"{of.torque} * sin(w * t)")
    measures = ["yoke.x.final", "slot.force.max", "slot.displacement.final", "slot.rate.final"]
    return Made(
        m, [*measures, "slide.torque.final"], {"crank.angle": of.near(0.6), "crank.omega": of.rate}
    )


def driven_yoke(of: Units) -> Made:
    """The yoke with a driver: the driver determines the motion."""
    made = yoke(of)
    made.model.coordinate_driver("drive", "crank.angle", value="0.6 + w * t + 0.2 * sin(w * t)")
    made.measures += ["drive.effort.final", "drive.power.max", "drive.effort.integral"]
    return Made(made.model, made.measures, end=2.0, analyses=DRIVEN)


def gears(of: Units) -> Made:
    """A planet on an arm about a fixed wheel, and a wheel with teeth in mesh with the planet."""
    s = of.size
    m = of.model(r1=(0.5, s), r2=(0.2, s), slip=(0.05, s), press=(0.35, 1), mod=(0.01, s))
    m.ground.points(O=(0, 0))
    of.bar(m, "arm", "r1 + r2", ("O", "P"))
    of.disc(m, "planet", {"P": (0, 0), "Q": (0.1 * s, 0)})
    of.disc(m, "ring", {"O": (0, 0)})
    m.revolute("O", "ground.O", "arm.O")
    m.revolute("P", "arm.P", "planet.P")
    m.revolute("R", "ground.O", "ring.O")
    m.gear("sun", "ground.O", "planet.P", radii=("r1", "r2"), offset="slip", pressure_angle="press")
    m.gear("rim", "ring.O", "planet.P", radii=("r1 + 2 * r2", "r2"), internal=True)
    m.ground.points(T=("-30 * mod", 0))
    of.disc(m, "wheel", {"T": (0, 0)})
    m.revolute("T", "ground.T", "wheel.T")
    m.gear("mesh", "wheel.T", "ring.O", teeth=(20, 40), module="mod", pressure_angle="press")
    m.generalized_force("band", "ring.angle", value=f"-{of.torque} * sin(ring.angle)")
    m.generalized_force("spin", "planet.angle", value=f"{0.3 * of.torque} * cos(planet.angle)")
    measures = ["arm.angle.final", "planet.Q.x.final", "sun.tangential.final", "ring.omega.final"]
    measures += ["rim.force.max", "sun.force.final", "mesh.tangential.integral", "T.fy.final"]
    return Made(m, measures, {"arm.angle": of.near(0.6), "arm.omega": of.rate}, end=1.5)


def rack_and_pinion(of: Units) -> Made:
    """A rack slides down an incline and turns a pinion."""
    s = of.size
    m = of.model(r=(0.3, s), tilt=(-0.4, 1), slip=(0.1, s), k=(2, of.stiffness))
    m.ground.points(O=(0, 0), S=("r * sin(tilt)", "-r * cos(tilt)"))
    of.disc(m, "pinion", {"O": (0, 0)}, center=(0.1 * s, 0.05 * s))
    of.disc(m, "bar", {"S": (0, 0)})
    m.revolute("O", "ground.O", "pinion.O")
    m.translational("slide", "ground.S", "bar.S", axes=("tilt", "tilt"))
    m.rack("mesh", "bar.S", "pinion.O", radius="r", axis="tilt", offset="slip")
    m.spring_damper("spring", "ground.S", "bar.S", stiffness="k", free_length=0.2 * s)
    measures = ["pinion.angle.final", "bar.x.final", "mesh.tangential.final", "O.fy.max"]
    measures += ["mesh.force.final", "spring.energy.final"]
    return Made(m, measures, {"bar.x": of.near(0.3) * s, "bar.vx": s * of.rate})


def loose_teeth(of: Units) -> Made:
    """A wheel is thrown at the teeth of a loose wheel, which moves a loose rack under a spring."""
    s, w = of.size, of.rate
    m = of.model(
        weight=False,
        r1=(0.2, s),
        r2=(0.5, s),
        b=(0.04, s),
        e=(0.5, 1),
        h=(0.05, s),
        c=(0.3, 1),
        k=(2, of.stiffness),
    )
    m.ground.points(O=(0, 0), Q=("r1 + r2", 0), S=("r1 + r2", "-r2"))
    for name, at in (("drive", "O"), ("wheel", "Q")):
        of.disc(m, name, {"C": (0, 0)})
        m.revolute(at, f"ground.{at}", f"{name}.C")
    of.disc(m, "bar", {"P": (0, 0)})
    m.translational("slide", "ground.S", "bar.P")
    m.gear("teeth", "drive.C", "wheel.C", radii=("r1", "r2"), backlash="b", restitution="e")
    m.rack("mesh", "bar.P", "wheel.C", radius="r2", backlash="h", restitution="c")
    m.spring_damper("spring", "ground.O", "bar.P", stiffness="k", free_length=0.9 * s)
    start = {"drive.angle": 0.0, "drive.omega": of.near(2) * w, "wheel.angle": 0.0}
    start |= {"wheel.omega": 0.0, "bar.x": m.parameters["r1"] + m.parameters["r2"], "bar.vx": 0.0}
    measures = ["wheel.angle.final", "drive.omega.final", "bar.x.final", "mesh.gap.final"]
    measures += ["teeth.play.final", "energy.dissipated.final"]
    return Made(m, measures, start, end=0.4, changes=True)


def rolling_wheel(of: Units) -> Made:
    """A wheel with its mass centre beside its axis rolls along an incline."""
    s = of.size
    m = of.model(r=(0.5, s), tilt=(-0.3, 1), slip=(0.1, s), e=(0.1, s))
    m.ground.points(L=(0.1 * s, 0.2 * s))
    of.disc(m, "wheel", {"C": (0, 0), "P": (0.3 * s, 0)}, center=("e", 0))
    m.rolling("roll", "ground.L", "wheel.C", radius="r", axis="tilt", offset="slip")
    measures = ["wheel.P.y.final", "roll.tangential.max", "roll.force.final", "wheel.omega.max"]
    return Made(m, measures, {"roll.displacement": s, "roll.rate": of.near(1) * s * of.rate})


def slipping_wheel(of: Units) -> Made:
    """A wheel with its mass centre beside its axis is thrown along a line, slides and rolls."""
    s = of.size
    m = of.model(r=(0.5, s), tilt=(-0.1, 1), e=(0.05, s), mu=(0.3, 1), mus=(0.4, 1))
    m.ground.points(L=(0.1 * s, 0.2 * s))
    of.disc(m, "wheel", {"C": (0, 0)}, center=("e", 0))
    m.rolling("roll", "ground.L", "wheel.C", radius="r", axis="tilt", friction="mu", static="mus")
    start = {"roll.displacement": s, "roll.rate": of.near(1) * s * of.rate}
    start |= {"wheel.angle": 0.2, "wheel.omega": 0.0}
    measures = ["wheel.x.final", "roll.slipped.final", "roll.force.final", "wheel.omega.final"]
    measures += ["roll.tangential.final"]
    return Made(m, measures, start, end=0.8, changes=True)


def bead(of: Units) -> Made:
    """A bead on a wire in the shape of a formula, of points, of a circle or of a line."""
    s = of.size
    heights = [2.0, 0.9, 0.3, 0.05, 0.35, 0.8, 2.1]
    points: list[Any] = [[(k - 3) * 0.6 * s, h * s] for k, h in enumerate(heights)]
    points[4][1] = "tip"
    wavy = {"x": "u + 0.1 * b * sin(u / b)", "y": "a * u^2", "range": [-3 * s, 3 * s]}
    choices: list[tuple[dict[str, Any], dict[str, tuple[float, float]]]] = [
        (wavy, {"a": (0.5, 1 / s), "b": (0.2, s)}),
        ({"points": points, "interpolation": "quintic"}, {"tip": (0.35, s)}),
        ({"circle": ["x0", "r", "r"]}, {"x0": (0.1, s), "r": (1.2, s)}),
        ({"line": [["-b", "h"], [2 * s, "-h"]]}, {"b": (0.2, s), "h": (0.4, s)}),
        ({"polar": "r + b * cos(2 * u)"}, {"r": (1.2, s), "b": (0.2, s)}),
    ]
    curve, given = choices[int(of.draw.integers(len(choices)))]
    m = of.model(**given)
    m.ground.curves(wire=curve)
    of.disc(m, "bead", {"P": (0.05 * s, 0.02 * s)})
    m.point_on_curve("on", "bead.P", "ground.wire")
    start = {"bead.angle": 0.2, "bead.omega": of.rate, "bead.P.x": of.near(0.6) * s}
    start |= {"bead.P.vx": 0.4 * s * of.rate}
    measures = ["bead.x.final", "bead.y.final", "on.u.final", "on.u_rate.final", "on.force.max"]
    return Made(m, [*measures, "on.force.final"], start, {"bead.y": -s})


def cam(of: Units, rim: Any, **more: tuple[float, float]) -> tuple[kp.Model, list[str]]:
    """A cam whose follower presses on it by a spring."""
    s = of.size
    m = of.model(R=(1, s), e=(0.15, s), tilt=(0.1, 1), k=(5, of.stiffness), **more)
    m.ground.points(O=(0, 0), S=(0.05 * s, 0), T=(0, 5 * s))
    of.disc(m, "cam", {"O": (0, 0)}, curves={"rim": rim})
    of.disc(m, "follower", {"P": (0, 0)})
    m.revolute("O", "ground.O", "cam.O")
    m.translational("slide", "ground.S", "follower.P", axes=("pi/2 - tilt/3", "pi/2 - tilt/3"))
    m.spring_damper(
        "spring",
        "ground.T",
        "follower.P",
        stiffness="k",
        damping=0.1 * of.damping,
        free_length="8 * R",
    )
    measures = ["follower.y.final", "touch.normal.max", "touch.u.final", "O.force.final"]
    return m, [*measures, "touch.force.final", "spring.dissipated.final"]


def roller(of: Units) -> Made:
    """A cam under its own inertia, with a roller on it, on either side."""
    m, measures = cam(of, {"polar": "R + e * cos(u)"}, r=(0.2, of.size))
    side = "right" if of.draw.random() < 0.5 else "left"
    m.roller_on_curve("touch", "follower.P", "cam.rim", radius="r", side=side)
    start = {"cam.angle": of.near(0.5), "cam.omega": of.near(2) * of.rate}
    return Made(m, measures, start, {"follower.y": of.size}, end=0.3)


def flat(of: Units, **more: tuple[float, float]) -> Made:
    """A cam under its own inertia, with a flat follower."""
    m, measures = cam(of, {"circle": ["e", 0, "R"]}, **more)
    m.flat_on_curve("touch", "follower.P", "cam.rim", axis="tilt")
    start = {"cam.angle": of.near(0.5), "cam.omega": of.near(2) * of.rate}
    return Made(m, measures, start, {"follower.y": of.size}, end=0.3)


def driven_flat(of: Units) -> Made:
    """A driven cam with a flat follower."""
    made = flat(of, w=(2, of.rate))
    made.model.coordinate_driver("drive", "cam.angle", value="w * t + 0.3")
    measures = [*made.measures[:-1], "drive.effort.final", "drive.effort.max"]
    return Made(made.model, measures, {}, made.guess, 0.5, DRIVEN)


def coupled(of: Units) -> Made:
    """Two pendulums with a linear relation of their angles, which changes over the time."""
    s = of.size
    m = of.model(p=(2, 1), n=(-1, 1), c=(0.3, 1), w=(2, of.rate))
    m.ground.points(O=(0, 0), P=(s, 0))
    of.bar(m, "one", s, ("O", "A"))
    of.bar(m, "two", 0.7 * s, ("P", "B"))
    m.revolute("O", "ground.O", "one.O")
    m.revolute("P", "ground.P", "two.P")
    m.coupling("link", terms={"one.angle": "p", "two.angle": "n"}, value="c * cos(w * t)")
    measures = ["two.angle.final", "O.force.max", "one.omega.final", "energy.work.final"]
    return Made(m, measures, {"one.angle": of.near(-0.9), "one.omega": of.rate}, end=2.0)


def written(of: Units) -> Made:
    """Constraints as formulas: a bead on a moving parabola, which turns as it goes."""
    s = of.size
    m = of.model(a=(0.5, 1 / s), b=(0.1, s), w=(2, of.rate), n=(0.7, 1 / s))
    of.disc(m, "bead", {"P": (0.1 * s, 0)})
    residual = ["bead.y - a * bead.x^2 - b * sin(w * t)", "bead.angle - n * bead.x"]
    m.constraint("wire", residual=residual, units=["m", "rad"])
    measures = ["bead.x.final", "bead.P.y.final", "bead.omega.max", "energy.work.final"]
    return Made(m, measures, {"bead.x": of.near(0.8) * s, "bead.vx": s * of.rate}, end=2.0)


def lifted(of: Units) -> Made:
    """A driver lifts a bar by a table and lets it go."""
    s = of.size
    m = of.model(m=(1, of.mass), L=(1, s), T=(1, 1 / of.rate), up=(0.8, 1), at=(0.6, 1))
    knots = {"x": [0, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0], "y": [0, 0.1, 0.5, 0.9, 1.2, 1.3, 1.3]}
    m.table("rise", **knots, interpolation="quintic", outside="hold")
    m.ground.points(O=(0, 0))
    m.bar("bar", mass="m", length="L", ends=("O", "A"))
    m.revolute("O", "ground.O", "bar.O")
    m.coordinate_driver("lift", "bar.angle", value="up * rise(t / T)", release="bar.angle > at")
    measures = ["bar.angle.final", "bar.omega.min", "lift.power.max", "energy.work.final"]
    return Made(m, [*measures, "O.force.final"], end=2.5, changes=True)


def limited(of: Units) -> Made:
    """A drive that gives way to a load, and follows its law again."""
    s = of.size
    m = of.model(L=(1, s), w=(2, of.rate), F=(0.6, of.torque), k=(0.2, 1), weight=False)
    m.ground.points(O=(0, 0))
    of.bar(m, "bar", "L", ("O", "A"))
    m.revolute("O", "ground.O", "bar.O")
    limit = f"F * (1 - k * bar.omega / {of.rate!r})"
    m.coordinate_driver("drive", "bar.angle", value="0.4 * sin(w * t)", limit=limit)
    load = f"{of.torque!r} * sin(1.3 * w * t)"
    m.generalized_force("load", "bar.angle", value=load)
    measures = ["bar.angle.final", "drive.effort.rms", "drive.power.mean", "O.force.max"]
    return Made(m, [*measures, "energy.work.final"], end=4.0, changes=True)


DRIVEN = ("kinematics", "inverse_dynamics", "dynamics")
JOINTS: list[Maker] = [
    slide_on_a_bar,
    rod_with_a_law,
    bent_bar,
    yoke,
    driven_yoke,
    gears,
    rack_and_pinion,
    loose_teeth,
    rolling_wheel,
    slipping_wheel,
    bead,
    roller,
    flat,
    driven_flat,
    coupled,
    written,
    lifted,
    limited,
]
