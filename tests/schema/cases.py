"""Cases for the tests of the schema, and mutations of them."""

import copy
import json
import random
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from kempe import _core
from kempe.base import files

ROOT = Path(__file__).parents[2]
FILES = sorted([*ROOT.glob("examples/*.toml"), *ROOT.glob("python/kempe/templates/*.toml")])

#: Every type of body, joint, driver, force and method.
EVERYTHING = """
kempe = 1
title = "everything"
gravity = [0, "-g"]
redundancy = "allow"
[parameters]
g = "9.81 m/s^2"
[tables.lift]
x = [0, 90, 180]
y = [0, 10, 0]
x_unit = "deg"
y_unit = "mm"
interpolation = "quintic"
periodic = false
outside = "hold"
[tables.measured]
file = "measured.csv"
columns = ["t / s", "lift.y"]
interpolation = "monotone"
[bodies.ground]
points = { O = [0, 0], P = [1, 0] }
[bodies.a]
type = "bar"
outline = { circle = [0, 0, 1] }
mass = "3 kg"
length = 1
ends = ["A", "B"]
points = { C = [0.1, 0] }
[bodies.b]
type = "bar"
mass = 3
through = { A = [0, 0], B = [1, 0] }
[bodies.c]
mass = 1
inertia = 0
center = [0, 0.1]
[bodies.d]
type = "body"
mass = 1
inertia = "0.1/2"
points = { P = [0, 0] }
[bodies.f]
outline = [[0, 0], [1, "0.1*2"], [0, 1]]
[[bodies.f.shapes]]
type = "rod"
length = 1
mass = 1
[[bodies.f.shapes]]
type = "plate"
width = 1
height = "20 mm"
density = -1
thickness = "1 mm"
[[bodies.f.shapes]]
type = "disc"
radius = 1
mass = 2
at = [0, 1]
[[bodies.f.shapes]]
type = "ring"
inner = 1
outer = 2
mass = 2
angle = "30 deg"
[[bodies.f.shapes]]
type = "polygon"
points = [[0, 0], [1, 0], [0, 1]]
mass = 2
[bodies.strip]
type = "beam"
ends = ["E", "F"]
length = 0.5
section = { rectangle = [0.01, "20 mm"] }
young = "210 GPa"
density = 7850
damping = 1e-4
elements = 2
points = { G = 0.1 }

[bodies.e]
type = "point_mass"
outline = { path = "M 0 0 h 1" }
mass = 1
at = [0, 1]
[joints.r]
type = "revolute"
i = "ground.O"
j = "a.A"
[joints.slide]
type = "translational"
i = "ground.O"
j = "d.P"
axes = [0.1, 0]
[joints.s]
type = "distance"
i = "ground.O"
j = "e.P"
length = "1 + 0.1*2"
[joints.w]
type = "weld"
i = "a.B"
j = "b.A"
[drivers.m]
type = "coordinate_driver"
coordinate = "a.angle"
value = "2*t"
[forces.spring]
type = "torsion_spring"
i = "ground"
j = "a"
stiffness = 2
damping = "0.1*2"
[forces.strut]
type = "spring_damper"
i = "ground.P"
j = "d.P"
stiffness = 10
free_length = 1
[forces.torque]
type = "torque"
j = "a"
torque = "sin(t)"
[forces.motor]
type = "motor"
j = "a"
voltage = 12
resistance = 1
torque_constant = 0.1
inductance = 0.01
[start]
set = { "a.angle" = "70*deg", "motor.current" = 0 }
[start.guess]
b = { x = 1, vx = 2 }
[analyses.one]
type = "dynamics"
t_end = 2
output_step = 0.1
method = { type = "rk45", rtol = 1e-6, max_step = 0.1 }
stabilization = { type = "baumgarte", alpha = 1, beta = 2 }
[analyses.two]
type = "dynamics"
t_end = "3 s"
from = "start"
output = "steps"
method = { type = "rk4", step = 0.1 }
stabilization = { type = "none" }
max_steps = 100
dense_output = false
[analyses.three]
type = "dynamics"
t_end = 4
method = { type = "radau", step = 0.1 }
[analyses.four]
type = "dynamics"
t_end = 5
singularity = "pass"
method = { type = "hht", alpha = -0.1 }
stabilization = { type = "projection", tolerance = 1e-10 }
[analyses.five]
type = "dynamics"
t_end = 6
method = { type = "generalized_alpha", rho = 0.5 }
[analyses.six]
type = "dynamics"
t_end = 7
method = { type = "dop853", first_step = 1e-3 }
stabilization = { type = "baumgarte", gains = "step" }
[analyses.seven]
type = "kinematics"
t_end = 8
output_step = 0.1
[analyses.eight]
type = "inverse_dynamics"
over = "a.angle"
range = [0, "90 deg"]
n = 10
from = "start"
[analyses.rest]
type = "equilibrium"
hold = ["a.angle"]
over = "g"
range = [9, 10]
nearest = true
from = "start"
[analyses.nine]
type = "modes"
n = 2
inputs = ["a.angle"]
outputs = ["a.x", "a.alpha"]
[analyses.limits]
type = "limits"
over = "a.angle"
from = "start"
[analyses.ten]
type = "mobility"
from = "start"
[analyses.twelve]
type = "reachable"
of = "d.P"
over = ["a.angle", "b.angle"]
ranges = [[0, 1], [0, 1]]
from = "start"
[analyses.eleven]
type = "configurations"
set = { "a.angle" = "20 deg" }
limit = 5
from = "start"
"""


def cases() -> dict[str, Any]:
    """The examples, the templates and a case with every type, as data."""
    read = {path.name: files.read_text(path) for path in FILES} | {"everything": EVERYTHING}
    return {name: json.loads(_core.Case(text, "toml", name).tree()) for name, text in read.items()}


Place = tuple[Any, Any]


def places(node: Any) -> Iterator[Place]:
    """All containers with each of their keys or indices."""
    entries = node.items() if isinstance(node, dict) else enumerate(node)
    for key, value in list(entries):
        yield node, key
        if isinstance(value, dict | list):
            yield from places(value)


def typo(word: str, chance: random.Random) -> str:
    """The word with one letter changed, dropped or doubled."""
    k = chance.randrange(len(word))
    return chance.choice(
        [
            word[:k] + ("x" if word[k : k + 1] == "q" else "q") + word[k + 1 :],
            word[:k] + word[k + 1 :],
            word[:k] + word[k : k + 1] + word[k:],
        ]
    )


def _renamed(node: dict[str, Any], key: str, name: str) -> None:
    entries = [(name if known == key else known, value) for known, value in node.items()]
    node.clear()
    node.update(entries)


VALUES: list[Any] = [
    True,
    False,
    0,
    1,
    2,
    -1,
    1.5,
    1e6,
    "",
    "text",
    "1 + t",
    "a.b",
    [],
    [1],
    [1, 2],
    ["A", "B"],
    ["A", "A"],
    ["A", "b.c"],
    [1, 2, 3],
    [[1, 2]],
    {},
    {"type": "rk45"},
    {"type": "bar"},
    {"x": 1},
    {"a.b": 1},
    {"P": [0, 0]},
]
NAMES = [
    "t",
    "pi",
    "deg",
    "ground",
    "start",
    "",
    " ",
    "a.b",
    "two words",
    "ö",
    "a\n",
    "a\tb",
    "a\u202eb",
    "\u2066",
    "n" * 201,
    "n" * 200,
]


def mutated(case: dict[str, Any], chance: random.Random) -> tuple[str, dict[str, Any]]:
    """A case with one mutation, and its description."""
    other = copy.deepcopy(case)
    node, key = chance.choice(list(places(other)))
    kind = chance.choice(["typo", "delete", "add", "value", "value", "word", "name"])
    if kind == "delete":
        del node[key]
    elif kind == "add" and isinstance(node, dict):
        node[chance.choice(["wheels", "type", "length", "mass", "output", "kempe"])] = (
            chance.choice(VALUES)
        )
    elif kind == "typo" and isinstance(node, dict):
        _renamed(node, key, typo(key, chance))
    elif kind == "name" and isinstance(node, dict):
        _renamed(node, key, chance.choice(NAMES))
    elif kind == "word" and isinstance(node[key], str) and node[key]:
        node[key] = typo(node[key], chance)
    else:
        node[key] = chance.choice(VALUES)
    return f"{kind} at {key!r}: {node}", other
