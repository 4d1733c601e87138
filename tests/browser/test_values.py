"""The numbers on the page are those of the solution, on several mechanisms."""

import csv
import io
import math
import re
from collections.abc import Callable
from typing import Any

import kempe as kp
import numpy as np
import pytest
from draw.mechanisms import moving, slider_crank, sprung
from house.places import ROOT
from sizes import FULL

PREFIXES = {"G": 1e9, "M": 1e6, "k": 1e3, "": 1.0, "m": 1e-3, "µ": 1e-6}
SUPERSCRIPTS = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789-")
UNITS = ("m", "rad", "m/s", "rad/s", "m/s²", "rad/s²", "N", "N·m", "J")
DEGREES = {"°": "rad", "°/s²": "rad/s²"}


def example(name: str) -> kp.Solution:
    solutions = kp.load(ROOT / "examples" / f"{name}.toml").run()
    return next(iter(solutions.values()))


MADE: dict[str, Callable[[], kp.Solution]] = {
    "four_bar": moving,
    "slider_crank": slider_crank,
    "six_bar": lambda: example("six_bar"),
}


#: The part of the time at which the values of a mechanism are read; all of them in full size.
PARTS = {"four_bar": 0.0, "slider_crank": 0.5, "six_bar": 1.0}


@pytest.fixture(scope="session")
def solved() -> dict[str, kp.Solution]:
    return {name: make() for name, make in MADE.items()}


def read(text: str) -> tuple[float, float, str]:
    """A text such as "−1.234 kN": value and half a unit of its last digit in SI units, SI unit."""
    number, _, unit = text.replace("°", " °", 1).replace("  ", " ").partition(" ")
    mantissa, _, power = number.replace("−", "-").partition("·10")
    value, decimals = float(mantissa), len(mantissa.partition(".")[2])
    factor = 10.0 ** int(power.translate(SUPERSCRIPTS)) if power else 1.0
    if found := re.match(r"10([⁻⁰-⁹¹²³]+) ", unit):
        factor *= 10.0 ** int(found[1].translate(SUPERSCRIPTS))
        unit = unit[found.end() :]
    if unit in DEGREES:
        factor, unit = factor * math.pi / 180.0, DEGREES[unit]
    if unit not in UNITS:
        factor, unit = factor * PREFIXES[unit[0]], unit[1:]
    return value * factor, 0.501 * 10.0**-decimals * factor, unit


def expected(solution: kp.Solution, t: float) -> dict[str, tuple[float, str]]:
    """Every plotted quantity at t by name, by the views of the solution."""
    at = solution(np.array([t]))
    found: dict[str, tuple[float, str]] = {}

    def put(name: str, values: Any, unit: str) -> None:
        found[name] = float(np.asarray(values).ravel()[0]), unit

    for name in at.model.bodies:
        body = at.body(name)
        for key, unit in (("angle", "rad"), ("omega", "rad/s"), ("alpha", "rad/s²")):
            put(f"{name}.{key}", getattr(body, key), unit)
        points = {name: body.at((0.0, 0.0))}
        points |= {f"{name}.{point}": body.point(point) for point in body.info.points}
        for subject, point in points.items():
            keys = (("x", "y"), ("vx", "vy", "speed"), ("ax", "ay", "acceleration"))
            vectors = (point.position, point.velocity, point.acceleration)
            for names, vector, unit in zip(keys, vectors, ("m", "m/s", "m/s²"), strict=True):
                for key, value in zip(names, (*vector[0], np.hypot(*vector[0])), strict=False):
                    put(f"{subject}.{key}", value, unit)
    for name, info in (at.model.constraints | at.model.forces).items():
        force, torque = at[name].force(on=info.j)[0], at[name].torque(on=info.j)
        put(f"{name}.force", np.hypot(*force), "N")
        put(f"{name}.force_x", force[0], "N")
        put(f"{name}.force_y", force[1], "N")
        put(f"{name}.torque", torque, "N·m")
    kinetic = sum(
        0.5 * info.mass * np.hypot(*at.body(name).at(info.center).velocity[0]) ** 2
        + 0.5 * info.inertia * float(at.body(name).omega[0]) ** 2
        for name, info in at.model.bodies.items()
    )
    put("energy.kinetic", kinetic, "J")
    row = int(np.abs(solution.t - t).argmin())
    if abs(solution.t[row] - t) < 1e-12:
        for key in ("potential", "dissipated", "work", "total"):
            put(f"energy.{key}", getattr(solution.energy, key)[row], "J")
    return found


def largest(solution: kp.Solution) -> dict[str, float]:
    """How large quantities of each unit are; rounding errors are shown as zero."""
    motion = solution
    size = float(np.ptp(kp.scene(solution, frames=20)["bounds"]))
    speed = max(np.abs(motion.v).max(), 1e-300) * (1.0 + size)
    rise = np.abs(motion.a).max() * (1.0 + size)
    force = np.abs(motion.lam).max() * (1.0 + 1.0 / size)
    sizes = {"m": size, "rad": 1.0, "m/s": speed, "rad/s": speed / size, "m/s²": rise}
    energy = max(np.abs(getattr(motion.energy, key)).max() for key in ("kinetic", "potential"))
    return sizes | {"rad/s²": rise / size, "N": force, "N·m": force * size, "J": 2.0 * energy}


@pytest.mark.parametrize("name", MADE)
def test_every_value_in_the_legends_is_that_of_the_solution(
    opened: Any, solved: dict[str, kp.Solution], name: str
) -> None:
    solution = solved[name]
    watched, scales = opened(solution, 1280, 800), largest(solution)
    watched.page.uncheck("#degrees")
    end = float(solution.t[-1])
    checked = set()
    for t in [part * end for part in (PARTS.values() if FULL else [PARTS[name]])]:
        told = expected(solution, t)
        watched.seek(t)
        for quantity in watched.page.locator(".quantity option").all_inner_texts():
            if quantity.startswith("Residual"):
                continue
            watched.choose(quantity)
            for whole in watched.page.locator(".subject option").all_inner_texts():
                if not whole.startswith("All"):
                    continue
                watched.choose(quantity, whole)
                for curve, text in watched.values().items():
                    value, half, unit = read(text)
                    right, right_unit = told[curve]
                    checked.add(curve)
                    assert unit == right_unit, (curve, text)
                    slack = half + 5e-9 * (abs(right) + scales[unit])
                    assert value == pytest.approx(right, abs=slack), (curve, t, text)
    joints, bodies = solution.model.joints, solution.model.bodies
    assert {f"{body}.{key}" for body in bodies for key in ("x", "vy", "ax", "alpha")} <= checked
    assert {f"{joint}.force_x" for joint in joints} <= checked
    assert {"energy.kinetic", "energy.total"} <= checked
    assert any(curve.count(".") == 2 for curve in checked)  # points


@pytest.mark.parametrize("name", MADE)
def test_the_table_has_the_numbers_of_the_solution(
    opened: Any, solved: dict[str, kp.Solution], name: str
) -> None:
    solution = solved[name]
    watched = opened(solution, 1280, 800)
    for k, (quantity, subject) in enumerate(
        [
            ("Angle", "All"),
            ("Position y", "All points"),
            ("Reaction force x", "All"),
            ("Acceleration x", "All points"),
            ("Energy", "All"),
        ]
    ):
        if k:
            watched.page.click("#add-plot")
        watched.choose(quantity, subject, k)
    with watched.page.expect_download() as offered:
        watched.page.click("#save-values")
    assert offered.value.suggested_filename.endswith("_values.csv")
    text = offered.value.path().read_text(encoding="utf-8")
    head, *rows = csv.reader(io.StringIO(text))
    table = np.array(rows, dtype=float)
    assert head[0] == "t [s]"
    assert len(head) == len(set(head)) > 15
    assert len(table) == len(kp.scene(solution)["frames"]["t"])
    scales = largest(solution)
    for row in (0, len(table) // 3, -1):
        told = expected(solution, float(table[row, 0]))
        for heading, value in zip(head[1:], table[row, 1:], strict=True):
            curve, unit = heading.removesuffix("]").rsplit(" [", 1)
            if curve.startswith("energy.") and curve not in told:
                continue
            right, right_unit = told[curve]
            assert unit == right_unit.replace("²", "^2").replace("·", "*")
            assert value == pytest.approx(right, rel=1e-8, abs=5e-9 * scales[right_unit]), heading


def test_energies_between_outputs_are_those_of_the_states(solved: dict[str, kp.Solution]) -> None:
    """The frames are not the outputs; kinetic and potential energy by hand, the total constant."""
    solution = solved["slider_crank"]
    scene = kp.scene(solution, frames=64)
    told = {one["name"]: np.array(one["values"]) for one in scene["channels"]}
    t = np.array(scene["frames"]["t"])
    assert np.abs(t[:, None] - solution.t).min(axis=1).max() > 1e-4
    motion = solution(t)
    potential, kinetic = np.zeros(len(t)), np.zeros(len(t))
    for name, info in motion.model.bodies.items():
        centre = motion.body(name).at(info.center)
        potential += 9.81 * info.mass * centre.position[:, 1]
        kinetic += 0.5 * info.mass * (centre.velocity**2).sum(axis=1)
        kinetic += 0.5 * info.inertia * motion.body(name).omega ** 2
    np.testing.assert_allclose(told["energy.potential"], potential, rtol=1e-8, atol=1e-8)
    np.testing.assert_allclose(told["energy.kinetic"], kinetic, rtol=1e-8)
    np.testing.assert_allclose(told["energy.total"], solution.energy.total[0], rtol=1e-5)


def test_energies_at_outputs_are_those_of_the_solution() -> None:
    solution = moving(t_end=1.0)
    scene = kp.scene(solution, frames=101)  # the outputs
    told = {one["name"]: np.array(one["values"]) for one in scene["channels"]}
    for key in ("kinetic", "potential", "dissipated", "work", "total"):
        right = getattr(solution.energy, key)
        np.testing.assert_allclose(told[f"energy.{key}"], right, rtol=1e-7, atol=1e-4)
    assert told["energy.dissipated"][-1] > 1000.0


def parallelogram() -> kp.Solution:
    """The coupler keeps its angle, except for rounding errors."""
    m = kp.Model("parallelogram", gravity=(0, -9.81))
    m.ground.points(A=(0, 0), D=(1, 0))
    for name in ("left", "right"):
        m.bar(name, mass=1, length=0.7, ends=("A", "B"))
    m.bar("coupler", mass=1, length=1, ends=("B", "C"))
    m.revolute("A", "ground.A", "left.A")
    m.revolute("B", "left.B", "coupler.B")
    m.revolute("C", "coupler.C", "right.B")
    m.revolute("D", "ground.D", "right.A")
    start = kp.assemble(m, set={"left.angle": 1.0, "left.omega": 2.0}, guess={"right.angle": 1.0})
    return kp.dynamics(m, start, t_end=1.0, output_step=0.01)


def test_a_point_mass_has_no_angle(opened: Any) -> None:
    m = kp.Model("two", gravity=(0.0, -9.81))
    m.ground.points(O=(0.0, 0.0))
    m.point_mass("bob", mass=2.0, at=(0.6, -0.8))
    m.bar("rod", mass=1.0, length=1.0, ends=("A", "B"))
    m.distance("string", "ground.O", "bob.P", length=1.0)
    m.revolute("pin", "ground.O", "rod.A")
    start = kp.assemble(m, {"bob.x": 0.6, "rod.angle": 0.0})
    watched = opened(kp.dynamics(m, start, t_end=1.0, output_step=0.1), 1280, 800)
    assert set(watched.values()) == {"rod.angle"}
    watched.choose("Position x", "All bodies")
    assert set(watched.values()) == {"bob.x", "rod.x"}


@pytest.mark.parametrize("name", MADE)
def test_values_between_instants_have_the_stated_accuracy(
    opened: Any, solved: dict[str, kp.Solution], name: str
) -> None:
    solution = solved[name]
    scene = kp.scene(solution)
    assert 0.0 < scene["accuracy"] < 0.01
    watched = opened(solution, 1280, 800)
    stated = f"{100 * scene['accuracy']:.2g} %"
    assert watched.page.inner_text("#sampling").endswith(stated)
    t = np.array(scene["frames"]["t"])
    motion = solution(t)
    forces = {joint: motion.constraint(joint) for joint in motion.model.joints}
    largest_force = max(np.abs(one.force(on=one.info.j)).max() for one in forces.values())
    turning = {body: motion.body(body).alpha for body in motion.model.bodies}
    largest_alpha = max(np.abs(one).max() for one in turning.values())
    middles = (t[:-1] + t[1:]) / 2.0
    for at in middles[[0, len(t) // 5, len(t) // 2, -1]]:
        watched.seek(float(at))
        watched.choose("Reaction force x")
        for curve, text in watched.values().items():
            joint = solution(float(at)).constraint(curve.removesuffix(".force_x"))
            value, half, _ = read(text)
            right = float(joint.force(on=joint.info.j)[0])
            assert abs(value - right) <= half + 2.0 * scene["accuracy"] * largest_force
        watched.choose("Angular acceleration")
        for curve, text in watched.values().items():
            value, half, _ = read(text)
            right = float(solution(float(at)).body(curve.removesuffix(".alpha")).alpha)
            assert abs(value - right) <= half + 1.1 * scene["accuracy"] * largest_alpha
        watched.choose("Position x", "All bodies")
        for curve, text in watched.values().items():
            value, half, _ = read(text)
            right = float(solution(float(at)).body(curve.removesuffix(".x")).x)
            assert abs(value - right) <= half + 1e-4 * np.ptp(scene["bounds"])


def test_numbers_of_rounding_size_are_zero(opened: Any) -> None:
    solution = parallelogram()
    scene = kp.scene(solution)
    angle = [frame[2][2] for frame in scene["frames"]["poses"]]
    watched = opened(solution, 1280, 800)
    k = int(np.abs(angle).argmax())
    assert 0.0 < abs(angle[k]) < 1e-9
    watched.seek(scene["frames"]["t"][k])
    watched.choose("Angle", "coupler")
    assert watched.values() == {"coupler.angle": "0°"}
    assert watched.state()["plots"][0]["label"] == "φ / °"
    low, high = watched.state()["plots"][0]["range"]
    assert high - low >= 1.0  # the curve is a line, not noise
    watched.choose("Angle", "All")
    assert watched.values()["coupler.angle"] == "0°"


def test_a_small_value_that_is_not_rounding_is_kept(opened: Any) -> None:
    """The residual has no natural scale: it is shown as it is."""
    solution = example("six_bar")
    watched = opened(solution, 1280, 800)
    scene = kp.scene(solution)
    channel = next(one for one in scene["channels"] if one["name"] == "residual.length")
    k = int(np.argmax(channel["values"]))
    watched.seek(scene["frames"]["t"][k])
    watched.choose("Residual |Φ| / m", "residual.length")
    value, half, unit = read(watched.values()["residual.length"])
    assert unit == "m"
    assert value == pytest.approx(channel["values"][k], abs=half)


def test_degrees(opened: Any, solved: dict[str, kp.Solution]) -> None:
    solution = solved["six_bar"]
    watched = opened(solution, 1280, 800)
    watched.page.click("#add-plot")
    watched.choose("Angular velocity", "output", 1)
    watched.page.check("#degrees")
    watched.seek(1.0)
    at = solution(1.0)
    assert read(watched.values()["crank.angle"])[0] == pytest.approx(2.5 * math.pi, abs=1e-4)
    assert watched.values()["crank.angle"] == "450.00°"  # 90° and a turn
    omega = float(at.body("output").omega) * 30 / math.pi
    shown = watched.values(1)["output.omega"]
    assert shown.endswith(" rpm")
    assert float(shown.split()[0].replace("−", "-")) == pytest.approx(omega, abs=0.02)
    labels = [one["label"] for one in watched.state()["plots"]]
    assert labels == ["φ / °", "ω / rpm"]
    watched.choose("Reaction force", "A")
    assert watched.values()["A.force"].endswith(" N")


def test_a_logarithmic_axis(opened: Any, solved: dict[str, kp.Solution]) -> None:
    solution = solved["six_bar"]
    watched = opened(solution, 1280, 800)
    watched.choose("Reaction force", "A")
    watched.page.check(".log")
    watched.seek(0.5)
    force = solution.constraint("A").force(on="crank")
    magnitude = np.hypot(force[:, 0], force[:, 1])
    low, high = watched.state()["plots"][0]["range"]
    assert low == math.floor(np.log10(magnitude.min()))
    assert high == math.ceil(np.log10(magnitude.max()))
    assert {"10⁰", "10¹"} & {one["text"] for one in watched.texts(".curves")}
    value, half, _ = read(watched.values()["A.force"])
    at = solution(0.5).constraint("A").force(on="crank")
    assert value == pytest.approx(float(np.hypot(*at)), abs=half)
    watched.choose("Reaction force x", "A")
    assert watched.state()["plots"][0]["label"] == "|Fx| / N"


def test_the_value_under_the_pointer(opened: Any, solved: dict[str, kp.Solution]) -> None:
    solution = solved["six_bar"]
    watched = opened(solution, 1280, 800)
    watched.choose("Reaction force", "C")
    box = watched.page.locator(".curves").bounding_box()
    before = watched.state()["t"]
    watched.page.mouse.move(box["x"] + 0.6 * box["width"], box["y"] + 0.5 * box["height"])
    watched.settle()
    name, _, text = watched.state()["plots"][0]["reading"].partition(" = ")
    assert name == "C.force"
    assert text == watched.values()["C.force"]
    value, half, _ = read(text)
    times = np.array(kp.scene(solution)["frames"]["t"])
    force = solution(times).constraint("C").force(on="plate")
    near = np.abs(times - 1.2) < 0.1  # about where the pointer is
    assert np.abs(np.hypot(*force[near].T) - value).min() <= half
    assert any(one["text"].startswith("C.force = ") for one in watched.texts(".curves"))
    assert watched.state()["t"] == before
    watched.page.mouse.move(5, 5)
    watched.settle()
    assert watched.state()["plots"][0]["reading"] == ""


def test_forces_of_elements_and_drivers(opened: Any, solved: dict[str, kp.Solution]) -> None:
    six_bar = solved["six_bar"]
    watched = opened(six_bar, 1280, 800)
    watched.seek(0.25)
    watched.choose("Reaction torque")
    value, half, _ = read(watched.values()["motor.torque"])
    torque = float(six_bar(0.25).constraint("motor").torque(on="crank"))
    assert value == pytest.approx(torque, abs=half)
    spring = sprung()
    other = opened(spring, 1280, 800)
    other.seek(0.25)
    other.choose("Element force y")
    value, half, _ = read(other.values()["s.force_y"])
    assert value == pytest.approx(float(spring(0.25).force("s").force(on="rod")[1]), abs=half)
