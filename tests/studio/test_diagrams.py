"""Centres, polygons and free bodies of the page against those of Python."""

import warnings
from itertools import combinations
from pathlib import Path
from typing import Any

import kempe as kp
import numpy as np
import pytest
from kempe import design
from kempe.design.wrenches import inertia, loads
from sizes import some
from studio.window import Studio

EXAMPLES = Path(__file__).parents[2] / "examples"
#: Cases with pins, slides, slots, wheels, cams, springs, drivers and redundant joints.
NAMES = [
    "slider_crank",
    "quick_return",
    "four_bar",
    "watt_six_bar",
    "planetary_gear",
    "excavator",
    "cam_roller",
    "squeezer",
    "scotch_yoke",
    "bicycle_chain",
    "oldham_coupling",
    "pump_jack",
]

#: An inverted slider-crank; its lengths are multiplied by SIZE.
SCALED = """kempe = 1
gravity = [0, -9.81]
[bodies.ground]
points = {{ O = [0, 0], Q = [{d}, 0] }}
[bodies.crank]
type = "bar"
mass = {m}
through = {{ O = [0, 0], A = [{x}, {y}] }}
[bodies.lever]
type = "bar"
mass = {m}
through = {{ Q = [{d}, 0], E = [{e}, {f}] }}
[joints.O]
type = "revolute"
i = "ground.O"
j = "crank.O"
[joints.Q]
type = "revolute"
i = "ground.Q"
j = "lever.Q"
[joints.slot]
type = "pin_in_slot"
i = "lever.Q"
j = "crank.A"
axis = 0
[drivers.motor]
type = "coordinate_driver"
coordinate = "crank.angle"
value = "{w}*t"
[start]
guess = {{ "lever.angle" = 2.0 }}
[analyses.turn]
type = "inverse_dynamics"
t_end = {end}
output_step = {step}
"""


def scaled(length: float, mass: float, rate: float) -> str:
    turn = 6.0 / rate
    lengths = {
        "d": 0.5 * length,
        "x": 0.2 * length,
        "y": 0.0,
        "e": 0.1 * length,
        "f": 0.6 * length,
    }
    return SCALED.format(m=mass, w=rate, end=turn, step=turn / 50, **lengths)


def same(found: Any, expected: Any, size: float, what: object) -> None:
    np.testing.assert_allclose(
        found, expected, rtol=0, atol=1e-8 * (size or 1.0), err_msg=str(what)
    )


def check_centres(found: dict[str, Any], state: kp.State) -> int:
    names = list(state.compiled.all_bodies)
    shown = {(one["i"], one["j"]): one for one in found["centres"]}
    count = 0
    for i, j in combinations(range(len(names)), 2):
        try:
            centre = design.instant_centre(state, names[i], names[j])
        except kp.ModelError:
            continue
        one = shown[i, j]
        assert (one["at"] is None) == bool(centre.at_infinity)
        if one["at"] is not None:
            scale = max(1.0, float(np.abs(centre.position).max()))
            # a centre far away is as inexact as the small difference of the rates
            spread = abs(float(centre.omega)) / max(abs(float(state.body(n).omega)) for n in names)
            same(one["at"], centre.position, scale / max(spread, 1e-12), (names[i], names[j]))
            count += 1
    return count


def check_polygon(found: dict[str, Any], expected: design.Polygon, largest: float) -> None:
    assert set(found["images"]) == set(expected.images)
    for name, image in expected.images.items():
        same(found["images"][name], image, largest, name)
    assert len(found["sides"]) == len(expected.sides)
    for side, own in zip(expected.sides, found["sides"], strict=True):
        assert (own["name"], own["part"]) == (side.name, side.part)
        same(own["start"], side.start, largest, side)
        same(own["vector"], side.vector, largest, side)


def check_loads(found: dict[str, Any], state: kp.State) -> None:
    """All loads on all bodies, relative to the largest of the mechanism at this instant."""
    bodies = list(state.compiled.bodies)
    of = {body: inertia(state, body) for body in bodies}
    expected = {body: loads(state, body) for body in bodies}
    every = [(body, load) for body in bodies for load in expected[body]]
    force = max(
        *(float(np.hypot(*load.force)) for _, load in every),
        *(float(np.hypot(*of[body].force)) for body in bodies),
    )
    arms = (float(np.hypot(*(load.place - of[body].centre))) for body, load in every)
    moment = max(
        force * max(arms),
        *(abs(float(load.about(of[body].centre))) for body, load in every),
        *(abs(float(of[body].moment)) for body in bodies),
    )
    for body in bodies:
        own, centre = found["free"][body], of[body].centre
        assert [one["name"] for one in own["loads"]] == [load.name for load in expected[body]]
        for one, load in zip(own["loads"], expected[body], strict=True):
            same(one["force"], load.force, force, load)
            arm = np.array(one["place"]) - centre
            about = one["moment"] + arm[0] * one["force"][1] - arm[1] * one["force"][0]
            same(about, load.about(centre), moment, load)
        same(own["force"], of[body].force, force, body)
        same(own["moment"], of[body].moment, moment, body)
        assert own["error"] < 1e-6


def solved(path: Path) -> tuple[str, kp.Solution]:
    """The first motion of a case."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        results = kp.load(path).run()
    return next((name, one) for name, one in results.items() if isinstance(one, kp.Solution))


def compare(one: Studio, path: Path) -> int:
    """All diagrams at some outputs; the number of compared centres."""
    name, solution = solved(path)
    one.load(path.read_text(encoding="utf-8"))
    ran = one.call("name => kempe.run(name)", name)
    assert ran["error"] is None
    # a long motion spreads small differences
    most = int(np.searchsorted(solution.t, 1.0, side="right")) - 1
    outputs = sorted({0, most // 3, most // 2})
    states = [solution(float(solution.t[k])) for k in outputs]
    # where the mechanism rests, its rates are rounding errors of those at other outputs
    polygons = {
        "velocity": [design.velocity_polygon(state) for state in states],
        "acceleration": [design.acceleration_polygon(state) for state in states],
    }
    largest = {
        kind: max(float(np.hypot(*image)) for one in all_ for image in one.images.values())
        for kind, all_ in polygons.items()
    }
    count = 0
    for n, (k, state) in enumerate(zip(outputs, states, strict=True)):
        found = one.call("k => kempe.diagrams(k)", k)
        assert found["t"] == pytest.approx(float(solution.t[k]), rel=1e-9, abs=1e-12)
        count += check_centres(found, state)
        for kind, all_ in polygons.items():
            check_polygon(found[kind], all_[n], largest[kind])
        check_loads(found, state)
    return count


@pytest.mark.parametrize("name", some(NAMES, 5))
def test_all_diagrams_have_the_numbers_of_python(one: Studio, name: str) -> None:
    assert compare(one, EXAMPLES / f"{name}.toml") > 0


@pytest.mark.parametrize(
    ("length", "mass", "rate"), [(1.0, 1.0, 6.0), (1e-3, 1e-3, 600.0), (1e3, 1e3, 0.02)]
)
def test_diagrams_of_machines_of_all_sizes(
    one: Studio, tmp_path: Path, length: float, mass: float, rate: float
) -> None:
    path = tmp_path / "slot.toml"
    path.write_text(scaled(length, mass, rate), encoding="utf-8")
    assert compare(one, path) > 0


#: A block that rests on the floor with two corners; its lengths are multiplied by SIZE.
RESTING = """kempe = 1
gravity = [{g}, -9.81]
[bodies.ground]
points = {{}}
curves = {{ floor = {{ line = [[{far}, 0], [-{far}, 0]] }} }}
[bodies.block]
type = "body"
mass = {m}
inertia = {j}
through = {{ P = [-{w}, {h}], Q = [{w}, {h}] }}
curves = {{ rim = {{ polygon = [[-{w}, -{h}], [{w}, -{h}], [{w}, {h}], [-{w}, {h}]] }} }}
[forces.touch]
type = "contact"
curves = ["block.rim", "ground.floor"]
restitution = 0
friction = 0.3
[analyses.rest]
type = "dynamics"
t_end = 0.1
output_step = 0.01
"""


@pytest.mark.parametrize(("length", "mass"), [(1.0, 1.0), (1e-3, 1e-3), (1e3, 1e3)])
def test_a_contact_at_rest_is_one_load(
    one: Studio, tmp_path: Path, length: float, mass: float
) -> None:
    """The equations that hold the corners are a part of the contact."""
    width, high = 0.2 * length, 0.1 * length
    inertia_of = mass * (width**2 + high**2) / 3
    path = tmp_path / "rest.toml"
    text = RESTING.format(g=1.0, far=5 * length, m=mass, j=inertia_of, w=width, h=high)
    path.write_text(text, encoding="utf-8")
    _, solution = solved(path)
    one.load(text)
    assert one.call("kempe.run('rest')")["error"] is None
    found = one.call("kempe.diagrams(5)")
    check_loads(found, solution(float(solution.t[5])))
    touch = found["free"]["block"]["loads"][0]
    assert touch["force"] == pytest.approx([-mass, 9.81 * mass], rel=1e-6)
