"""Assemblies that kempe writes: read again they move in the same way; what they lack is listed."""

from __future__ import annotations

from pathlib import Path

import kempe as kp
import numpy as np
import pytest
from command_line import kempe

EXAMPLES = Path(__file__).parents[2] / "examples"
PRECISE = kp.DOP853(rtol=1e-10)
#: Examples that the format can contain, with pins, slides, slots, gears and springs.
WRITTEN = (
    "balanced_lamp",
    "cardan_gear",
    "double_pendulum",
    "jansen_leg",
    "quick_return",
    "slider_crank",
    "trebuchet",
    "wiper",
    "classics/geared_five_bar",
    "classics/umbrella",
    "classics/whitworth",
)

#: Times, and quantities that OndselSolver computed from these files (commit 09d6175a, 2025).
ONDSEL = (
    (
        "quick_return",
        0.61,
        {"lever.angle": 1.9630411817242142, "rod.x": -0.1060521909204426}
        | {"ram.x": -0.036263060481255986, "ram.vx": 0.4537084986568087},
    ),
    (
        "two_cylinder_engine",
        0.0244,
        {"rod_1.x": -0.04420292628279075, "rod_1.omega": 51.064951031123606}
        | {"piston_1.x": 0.09214818833737883, "piston_2.vx": 6.942542620812185},
    ),
    (
        "watt_six_bar",
        1.22,
        {"coupler.x": 0.29244574469797463, "coupler.omega": -0.45554962970305346}
        | {"right.y": 0.2489014785548535, "rod.vx": -0.17915411729896746},
    ),
    (
        "classics/geared_five_bar",
        0.7,
        {"pinion.angle": -4.3982297150254865, "first.x": 0.1702077312709583}
        | {"second.omega": 2.3350838643867378, "second.vx": 0.4298765639611705},
    ),
)


def rig(size: float, mass: float) -> kp.Case:
    """Elements that are written, with axes, offsets and names that no example has."""
    inertia = mass * size**2
    weight = mass * 9.81 * size
    pivot = {"C": (0, 0)}
    m = kp.Model("rig/1", gravity=(0.3 * size, -9.81 * size), parameters={"k": 40 * mass})
    m.ground.points(O=(0, 0), S=(0.2 * size, 0.9 * size), W=(-size, 0), R=(0, 3 * size))
    m.ground.points(G=(0.4 * size, 3 * size))
    m.body("cart", mass=2 * mass, inertia=inertia, points={"P": (0.1 * size, 0.02 * size)})
    m.bar("rod", mass=0.7 * mass, length=0.8 * size, ends=("A", "B"))
    m.bar("tip", mass=0.4 * mass, length=0.5 * size, ends=("A", "B"))
    m.body("plate", mass=mass, inertia=0.2 * inertia, points={"Q": (0.1 * size, 0)})
    m.point_mass("ball", mass=0.1 * mass)
    m.body("wheel", mass=mass, inertia=inertia, center=(0.1 * size, 0), points=pivot)
    m.body("pinion", mass=mass, inertia=inertia, points=pivot)
    m.body("bar", mass=mass, inertia=inertia, points={"R": (0, 0)})
    m.translational("slope", "cart.P", "ground.O", axes=("10 deg", "30 deg"))
    m.revolute("pin", "rod.A", "cart.P", axes=("20 deg", "-50 deg"))
    m.weld("elbow", "rod.B", "tip.A", angle="-40 deg")
    m.distance("string", "ball.P", "tip.B", length=0.3 * size)
    m.revolute("axle", "ground.W", "wheel.C")
    m.revolute("shaft", "pinion.C", "ground.R")
    m.gear("mesh", "wheel.C", "pinion.C", radii=(2 * size, (10**0.5 - 2) * size))
    m.rack("teeth", "bar.R", "pinion.C", radius=0.4 * size, axis="90 deg")
    m.translational("guide", "ground.G", "bar.R", axes=("90 deg", "90 deg"))
    m.spring_damper("tie", "plate.Q", "tip.B", stiffness="k/2", damping=mass, preload=weight / 9)
    push = f"{weight}*sin(3*t) - k*length/9 - tan(t)*k*rate/99"
    m.actuator("push", "ground.S", "plate.Q", force=push)
    start = {"slope.displacement": 0.1 * size, "rod.angle": -1.0, "slope.rate": 0.2 * size}
    start |= {"rod.omega": 1.0, "wheel.angle": 0.4, "wheel.omega": -2.0}
    start |= {"plate.x": 0.7 * size, "plate.y": 0.1 * size, "plate.angle": 0.5, "plate.omega": 0.7}
    return kp.Case(m, {"set": start})


def differences(own: kp.Case, again: kp.Case, t_end: float, step: float) -> dict[str, float]:
    """The largest difference of each quantity, as a share of its largest value over all bodies."""
    runs = [
        kp.dynamics(c.model, c.start(), t_end=t_end, output_step=step, method=PRECISE)
        for c in (own, again)
    ]
    names = list(own.start().compiled.bodies)
    rates = [f"{b}.omega" for b in names if f"{b}.angle" in runs[0]]
    found = {}
    for kinds in (("x", "y"), ("angle",), ("vx", "vy"), ("omega",), ("ax", "ay"), ("alpha",)):
        columns = [
            [run[f"{body}.{kind}"] for run in runs]
            for body in names
            for kind in kinds
            if f"{body}.{kind}" in runs[0]
        ]
        pairs = [(a, b) for a, b in columns]
        if kinds == ("angle",):  # a file has no whole turns
            full = 2 * np.pi
            pairs = [(a, b + full * np.round((a[0] - b[0]) / full)) for a, b in pairs]
        largest = max(np.abs(a).max() for a, _ in pairs)
        if kinds == ("alpha",):  # at constant speed it is zero up to rounding
            largest += max(np.abs(run[name]).max() ** 2 for run in runs[:1] for name in rates)
        found[kinds[0]] = max(np.abs(a - b).max() for a, b in pairs) / (largest or 1.0)
    return found


@pytest.mark.parametrize("name", WRITTEN)
def test_an_example_moves_alike_after_reading_back(tmp_path: Path, name: str) -> None:
    own = kp.load(EXAMPLES / f"{name}.toml")
    kp.write_asmt(own, tmp_path / "out.asmt")
    again = kp.load(tmp_path / "out.asmt")
    entry = again.analyses["motion"]
    (motion, original), *_ = own.analyses.items()
    formula = isinstance(original["t_end"], str)
    t_end = own.run()[motion].t[-1] if formula else original["t_end"]
    assert entry["t_end"] == pytest.approx(t_end, rel=1e-15)
    found = differences(own, again, min(entry["t_end"], 1.0), entry["output_step"])
    assert max(found.values()) < 2e-7, found


@pytest.mark.parametrize(("size", "mass"), [(1.0, 1.0), (1e-3, 1e3), (1e3, 1e-3)])
def test_all_elements_move_alike_after_reading_back(
    tmp_path: Path, size: float, mass: float
) -> None:
    own = rig(size, mass)
    kp.write_asmt(own, tmp_path / "out.asmt")
    again = kp.load(tmp_path / "out.asmt")
    found = differences(own, again, 0.5, 0.01)
    assert max(found.values()) < 1e-8, found
    points = {
        name: body.get("points", {}).keys() for name, body in again.model.tree()["bodies"].items()
    }
    for name, body in own.model.tree()["bodies"].items():
        assert body.get("points", {}).keys() <= points[name], name
    wheel = kp.dynamics(own.model, own.start(), t_end=0.5)["wheel.angle"]
    assert np.ptp(wheel) > 0.1


def test_ondsel_solver_computes_the_same(tmp_path: Path) -> None:
    for name, t, values in ONDSEL:
        own = kp.load(EXAMPLES / f"{name}.toml")
        kp.write_asmt(own, tmp_path / "out.asmt")
        again = kp.load(tmp_path / "out.asmt")
        for case in (own, again):
            run = kp.kinematics(case.model, case.start(), t_end=t)
            for quantity, value in values.items():
                found = float(run[quantity][-1])
                assert found == pytest.approx(value, rel=1e-9, abs=1e-11), (name, quantity)


@pytest.mark.parametrize("coordinate", ["hinge.angle", "door.angle"])
@pytest.mark.parametrize("ends", [("door.A", "ground.O"), ("ground.O", "door.A")])
def test_angles_of_turned_joint_frames_are_driven_and_limited(
    tmp_path: Path, ends: tuple[str, str], coordinate: str
) -> None:
    m = kp.Model("door")
    m.ground.points(O=(0, 0))
    m.bar("door", mass=1, length=1, ends=("A", "B"))
    m.bar("leaf", mass=1, length=1, ends=("A", "B"))
    m.revolute("hinge", *ends, axes=(0.7, "30 deg"))
    m.revolute("fold", "door.B", "leaf.A", axes=(-1.1, 0.4))
    m.coordinate_driver("turn", coordinate, value="0.3 + 2*t")
    m.stop("bounds", "fold.angle", lower=-0.8, upper=0.6, restitution=0)
    own = kp.Case(m, {"set": {"fold.angle": 0.5}})
    kp.write_asmt(own, tmp_path / "out.asmt")
    again = kp.load(tmp_path / "out.asmt")
    found = differences(own, again, 0.3, 0.01)
    assert max(found[name] for name in ("x", "angle", "vx", "omega")) < 1e-7, found


def test_a_stop_is_a_limit(tmp_path: Path) -> None:
    m = kp.Model("door", gravity=(0, -9.81))
    m.ground.points(O=(0, 0))
    m.bar("door", mass=1, length=1, ends=("A", "B"))
    m.revolute("hinge", "door.A", "ground.O", axes=(0, "30 deg"))
    m.stop("bounds", "door.angle", lower="-1", upper="0.9", restitution=0)
    own = kp.Case(m, {"set": {"door.angle": 0.5, "door.omega": 1.0}})
    kp.write_asmt(own, tmp_path / "out.asmt")
    again = kp.load(tmp_path / "out.asmt")
    assert differences(own, again, 1.0, 0.01)["angle"] < 1e-8
    angle = kp.dynamics(again.model, again.start(), t_end=1.0)["door.angle"]
    assert angle.min() == pytest.approx(-1.0, abs=1e-9)


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("four_bar", "spring: elements of type torsion_spring cannot be written"),
        ("boom", "cylinder.length = .* is not constant"),
        ("crane_trolley", "drive.value = .*: the function max cannot be written"),
        ("elliptical_trammel", "hand: rod.angle cannot be written"),
        ("bistable_switch", "left: a beam cannot be written"),
        ("classics/ratchet", "motor: release cannot be written"),
        ("classics/inverted_pendulum", "control.force = .* cannot be written"),
    ],
)
def test_what_the_format_lacks_is_refused_by_name(tmp_path: Path, name: str, message: str) -> None:
    path = tmp_path / "out.asmt"
    with pytest.raises(kp.ModelError, match=message):
        kp.write_asmt(kp.load(EXAMPLES / f"{name}.toml"), path)
    assert not path.exists()


def test_the_command_tells_what_is_left_out(tmp_path: Path) -> None:
    out = tmp_path / "out.asmt"
    refused = kempe("convert", str(EXAMPLES / "four_bar.toml"), str(out))
    assert refused.returncode != 0
    assert "--partial" in refused.stderr
    done = kempe("convert", str(EXAMPLES / "four_bar.toml"), str(out), "--partial")
    assert done.returncode == 0, done.stderr
    assert "left out: spring: elements of type torsion_spring" in done.stdout
    assert "left out: parameters" in done.stdout
    assert "ForceTorques\n\tConstantGravity" in out.read_text()
    assert kp.load(out).run()["motion"].t[-1] > 0
