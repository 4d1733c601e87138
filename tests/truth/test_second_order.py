"""Mechanisms that are singular in every position, against the linear constraint."""

import math
import warnings
from itertools import pairwise

import kempe as kp
import numpy as np
import pytest

pytestmark = pytest.mark.filterwarnings(
    "ignore::kempe.AssemblyWarning", "ignore:the reactions leave out the load::"
)


class Mechanism:
    """A mechanism whose equations hold only to second order, or with linear constraints instead.

    Attributes:
        model: the mechanism.
        set: coordinates of the start.
        guess: a position beside the start.
        over: a coordinate that moves it.
        shared: a joint without a unique reaction.
    """

    #: Further linear constraints, where the form is a sum of squares.
    more = ()

    def __init__(self, size, mass, linear):
        redundancy = "allow" if linear else "refuse"
        self.size, self.mass = size, mass
        self.model = kp.Model(
            type(self).__name__, gravity=(0.3 * size, -9.81 * size), redundancy=redundancy
        )
        self.build()
        if linear:
            for k, (terms, value) in enumerate([self.linear, *self.more]):
                self.model.coupling(f"linear{k}", terms=terms, value=value)

    def body(self, name, **points):
        inertia = 0.1 * self.mass * self.size**2
        self.model.body(name, mass=self.mass, inertia=inertia, points=points)

    def bar(self, name, length, *ends):
        self.model.bar(name, mass=self.mass, length=length * self.size, ends=ends)

    def pin(self, name, i, j):
        self.model.revolute(name, i, j)


class Platen(Mechanism):
    """A bar between two guides, as long as their distance."""

    linear = {"beam.angle": 1}, 0.0
    over, shared = "left.y", "J1"

    def build(self):
        s, m = self.size, self.model
        m.ground.points(A=(0, 0), B=(3 * s, 0))
        self.body("left", P=(0, 0))
        self.body("right", P=(0, 0))
        self.bar("beam", 3, "P", "Q")
        for name, at, body in (("L", "A", "left"), ("R", "B", "right")):
            m.translational(name, f"ground.{at}", f"{body}.P", axes=(math.pi / 2, math.pi / 2))
        self.pin("J1", "left.P", "beam.P")
        self.pin("J2", "right.P", "beam.Q")
        self.set, self.guess = {"left.y": 0.5 * s}, {"beam.angle": 0.02}


class Slots(Mechanism):
    """A bar whose ends run in two parallel slots, as long as their distance."""

    linear = {"bar.angle": 1}, math.pi / 2
    over, shared = "bar.x", "S1"

    def build(self):
        s, m = self.size, self.model
        m.ground.points(A=(0, 0), B=(0, 2 * s))
        self.bar("bar", 2, "P", "Q")
        m.pin_in_slot("S1", "ground.A", "bar.P")
        m.pin_in_slot("S2", "ground.B", "bar.Q")
        self.set, self.guess = {"bar.x": 0.3 * s}, {"bar.angle": 1.5}


class Braces(Mechanism):
    """A parallelogram with two bars in line, together as long as its cranks."""

    linear = {"b2.angle": 1, "b1.angle": -1}, 0.0
    over, shared = "c1.angle", "M1"
    #: The lengths of the bars in line.
    braces = 0.4, 0.6

    def build(self):
        s, m = self.size, self.model
        m.ground.points(A=(0, 0), D=(2 * s, 0), M0=(s, 0))
        self.bar("c1", 1, "A", "B")
        self.bar("c2", 1, "D", "C")
        last = f"M{len(self.braces)}"
        self.body("rod", B=(0, 0), C=(2 * s, 0), **{last: (s, 0)})
        names = [f"b{k + 1}" for k in range(len(self.braces))]
        for k, (name, length) in enumerate(zip(names, self.braces, strict=True)):
            self.bar(name, length, f"M{k}", f"M{k + 1}")
        chain = ["ground", *names, "rod"]
        for name, i, j in (
            ("A", "ground", "c1"),
            ("B", "c1", "rod"),
            ("C", "c2", "rod"),
            ("D", "ground", "c2"),
            *((f"M{k}", i, j) for k, (i, j) in enumerate(pairwise(chain))),
        ):
            self.pin(name, f"{i}.{name}", f"{j}.{name}")
        self.set = {"c1.angle": 1.2}
        self.guess = {
            "c2.angle": 1.2,
            "rod.angle": 0,
            **dict.fromkeys((f"{name}.angle" for name in names), 1.2),
            "b1.angle": 1.21,
        }


class Pieces(Mechanism):
    """Two bars in line between two guides, together as long as their distance."""

    linear, more = ({"b1.angle": 1}, 0.0), (({"b2.angle": 1}, 0.0),)
    over, shared = "left.y", "M"

    def build(self):
        s, m = self.size, self.model
        m.ground.points(A=(0, 0), B=(3 * s, 0))
        self.bar("b1", 1, "P", "M")
        self.bar("b2", 2, "M", "Q")
        for name, at, body in (("L", "A", "left"), ("R", "B", "right")):
            self.body(body, P=(0, 0))
            m.translational(name, f"ground.{at}", f"{body}.P", axes=(math.pi / 2, math.pi / 2))
        self.pin("J1", "left.P", "b1.P")
        self.pin("M", "b1.M", "b2.M")
        self.pin("J2", "right.P", "b2.Q")
        self.set, self.guess = {"left.y": 0.5 * s}, {"b1.angle": 0.02, "b2.angle": -0.01}


class ThreeBraces(Braces):
    """A parallelogram with three bars in line, together as long as its cranks."""

    linear = {"b2.angle": 1, "b1.angle": -1}, 0.0
    more = (({"b3.angle": 1, "b1.angle": -1}, 0.0),)
    braces = 0.4, 0.25, 0.35


class ScottRussell(Mechanism):
    """Two Scott-Russell mechanisms, joined by a bar that is as long as their distance."""

    linear = {"link.angle": 1}, 0.0
    over, shared = "crank0.angle", "C0"

    def build(self):
        s, m = self.size, self.model
        m.ground.points(O0=(0, 0), O1=(5 * s, 0))
        self.bar("link", 5, "C0", "C1")
        for k in range(2):
            self.bar(f"crank{k}", 1, "O", "A")
            self.body(f"rod{k}", A=(0, 0), B=(s, 0), C=(-s, 0))
            self.body(f"slide{k}", B=(0, 0))
            self.pin(f"O{k}", f"ground.O{k}", f"crank{k}.O")
            self.pin(f"A{k}", f"crank{k}.A", f"rod{k}.A")
            self.pin(f"B{k}", f"rod{k}.B", f"slide{k}.B")
            m.translational(f"T{k}", f"ground.O{k}", f"slide{k}.B")
            self.pin(f"C{k}", f"rod{k}.C", f"link.C{k}")
        self.set = {"crank0.angle": 0.7}
        self.guess = {"crank1.angle": 0.7, "rod0.angle": -0.7, "rod1.angle": -0.7}
        self.guess |= {"slide0.x": 1.5 * s, "slide1.x": 6.5 * s, "link.angle": 0.01}


def near(found, exact, unit, tolerance):
    """Whether coordinates agree, with lengths relative to the size, angles up to whole turns."""
    by = (np.asarray(found) - np.asarray(exact)) / unit
    turns = np.where(unit == 1.0, 2 * math.pi * np.round(by / (2 * math.pi)), 0.0)
    return np.abs(by - turns).max() <= tolerance


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e3])
@pytest.mark.parametrize("kind", [Platen, Slots, Braces, Pieces, ThreeBraces, ScottRussell])
def test_it_moves_as_with_the_linear_constraint(kind, size):
    mass = 1 / size
    one, other = kind(size, mass, False), kind(size, mass, True)
    with pytest.warns(kp.AssemblyWarning, match="in every position"):
        start = kp.assemble(one.model, set=one.set, guess=one.guess)
    begin = kp.assemble(other.model, set=other.set, guess=other.guess)
    unit = np.array([size if u == "m" else 1.0 for u in start.compiled.column_units()])
    assert near(start.q, begin.q, unit, 1e-10)

    found = kp.mobility(one.model, start)
    assert found.degrees_of_freedom == 1
    assert [entry.kind for entry in found.singular] == ["second order"]
    assert not start[one.shared].unique

    scale = np.abs(begin.a / unit).max()
    assert np.abs((start.a - begin.a) / unit).max() <= 1e-8 * scale
    for rate in (0.0, 2.0):
        name = one.over.replace(".angle", ".omega").replace(".x", ".vx").replace(".y", ".vy")
        speed = {name: rate * (1 if "angle" in one.over else size)}
        mine = kp.dynamics(
            one.model, kp.assemble(one.model, set=one.set | speed, guess=one.guess), t_end=0.3
        )
        its = kp.dynamics(
            other.model,
            kp.assemble(other.model, set=other.set | speed, guess=other.guess),
            t_end=0.3,
        )
        assert near(mine.q[-1], its.q[-1], unit, 1e-7)
        assert mine.drift.position.max() <= 1e-9 * max(size, 1)

    value = start[one.over]
    end = value + 0.2 * (1 if "angle" in one.over else size)
    mine = kp.kinematics(one.model, start, over=one.over, range=[value, end], n=7)
    its = kp.kinematics(other.model, begin, over=other.over, range=[value, end], n=7)
    assert near(mine.q, its.q, unit, 1e-9)
    eigenvalues = kp.modes(one.model, start).eigenvalues, kp.modes(other.model, begin).eigenvalues
    assert np.abs(eigenvalues[0] - eigenvalues[1]).max() < 1e-6


def test_bars_in_line_between_fixed_pins_have_no_motion():
    m = kp.Model("in line")
    m.ground.points(A=(0, 0), D=(3, 0))
    m.bar("left", mass=1, length=1, ends=("A", "B"))
    m.bar("right", mass=1, length=2, ends=("B", "D"))
    for name, i, j in (("A", "ground", "left"), ("B", "left", "right"), ("D", "ground", "right")):
        m.revolute(name, f"{i}.{name}", f"{j}.{name}")
    flat = kp.State(m, 0, [0.5, 0, 0, 2, 0, 0], np.zeros(6))
    (entry,) = kp.mobility(m, flat).singular
    assert entry.kind == "uncertainty"


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e3])
@pytest.mark.parametrize("moment", [0.0, 2.0])
def test_a_load_that_is_kept_to_second_order_is_told(size, moment):
    """A torque on the platen's bar would need infinite forces."""
    mass = 1 / size

    def run(linear):
        made = Platen(size, mass, linear)
        made.model.torque("twist", "beam", torque=moment)
        start = kp.assemble(made.model, set=made.set, guess={} if linear else made.guess)
        return start, kp.dynamics(made.model, start, t_end=0.1)

    with warnings.catch_warnings(record=True) as heard:
        warnings.simplefilter("always", kp.AccuracyWarning)
        start, sol = run(linear=False)
    texts = [str(one.message) for one in heard if issubclass(one.category, kp.AccuracyWarning)]
    told = ["leave out the load along beam.angle" in text for text in texts]
    assert told == ([True] if moment else [])
    assert sol["beam.ay"][0] == pytest.approx(-9.81 * size, rel=1e-9)
    left = sol.newton_euler.moment[:, sol.newton_euler.bodies.index("beam")]
    assert np.abs(left - moment).max() <= 1e-9 * (moment or mass * size**2)
    over = kp.kinematics(start.model, start, over="left.y", range=[0.5 * size, 0.7 * size], n=5)
    for motion in (start, sol, over):
        assert "second-order load left out" in motion["J1"].choice
    # the remedy of the warning
    with warnings.catch_warnings():
        warnings.simplefilter("error", kp.AccuracyWarning)
        _, sol = run(linear=True)
    assert sol.newton_euler.largest < 1e-9
    assert sol["J1"].choice == "minimum norm"
