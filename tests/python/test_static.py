"""Motions over a driven value: rates by the value, and the static case without inertia."""

import csv
import json
import math
from pathlib import Path

import kempe as kp
import numpy as np
import pytest
from command_line import kempe
from kempe.results.variable import Variable
from numpy.testing import assert_allclose

SIZES = [(1e-3, 1e3), (1.0, 1.0), (1e3, 1e-3)]
G = 9.81


def arm(size: float = 1.0, mass: float = 2.0) -> tuple[kp.Model, kp.State]:
    """A damped arm with a spring and a load at its end."""
    m = kp.Model("arm", gravity=(0, -G))
    m.ground.points(O=(0, 0), W=(2 * size, size))
    m.bar("arm", mass=mass, length=size, ends=("O", "P"))
    m.revolute("O", "ground.O", "arm.O")
    m.torsion_spring("damper", "ground", "arm", damping=30 * mass * size**2)
    m.spring_damper("spring", "ground.W", "arm.P", stiffness=3 * mass, damping=mass)
    m.force("load", "arm.P", force=(5 * mass, -2 * mass))
    return m, kp.assemble(m, set={"arm.angle": 0.2})


def required(size: float, mass: float, angle: np.ndarray) -> np.ndarray:
    """The torque at the pivot that balances weight, spring and load, by the moments about it."""
    x, y = size * np.cos(angle), size * np.sin(angle)
    weight = -mass * G * x / 2
    fx, fy = 3 * mass * (2 * size - x) + 5 * mass, 3 * mass * (size - y) - 2 * mass
    return -(weight + x * fy - y * fx)


@pytest.mark.parametrize(("size", "mass"), SIZES)
def test_static_efforts_balance_the_loads_at_rest(size: float, mass: float) -> None:
    m, start = arm(size, mass)
    sol = kp.inverse_dynamics(m, start, over="arm.angle", range=(0.2, 2.5), n=47, static=True)
    (drive,) = sol.model.drivers
    expected = required(size, mass, sol.t)
    assert_allclose(sol[f"{drive}.effort"], expected, rtol=1e-10, atol=1e-10 * mass * G * size)
    assert not np.any(sol.v)
    assert_allclose(sol.a, 0.0, atol=1e-11)
    assert_allclose(sol["damper.torque"], 0.0)
    between = sol(np.array([0.7, 1.234]))
    assert_allclose(between[f"{drive}.effort"], required(size, mass, between.t), rtol=1e-10)
    assert not np.any(between.v)


@pytest.mark.parametrize(("size", "mass"), SIZES)
def test_static_works_are_those_along_the_path(size: float, mass: float) -> None:
    m, start = arm(size, mass)
    sol = kp.inverse_dynamics(m, start, over="arm.angle", range=(0.2, 2.5), static=True)
    angle = np.linspace(0.2, 2.5, 20001)
    by_drive = np.trapezoid(required(size, mass, angle), angle)
    tip = size * np.array([math.cos(2.5) - math.cos(0.2), math.sin(2.5) - math.sin(0.2)])
    by_load = 5 * mass * tip[0] - 2 * mass * tip[1]
    assert sol.energy.work[-1] == pytest.approx(by_drive + by_load, rel=1e-7)
    assert not np.any(sol.energy.kinetic)
    assert np.abs(sol.energy.balance).max() < 1e-9
    assert not np.any(sol.drift.velocity)
    assert sol.newton_euler.balance.max() < 1e-12


def test_without_static_inertia_and_damping_act_at_unit_rate() -> None:
    m, start = arm()
    of = {"over": "arm.angle", "range": (0.2, 2.5), "n": 24}
    moving = kp.inverse_dynamics(m, start, **of)
    rest = kp.inverse_dynamics(m, start, static=True, **of)
    (drive,) = moving.model.drivers
    d = np.stack([np.cos(moving.t) - 2, np.sin(moving.t) - 1], axis=-1)
    along = np.stack([-np.sin(moving.t), np.cos(moving.t)], axis=-1)
    length = np.hypot(*d.T)
    rate = (d * along).sum(axis=-1) / length
    damped = 2 * rate * rate + 60  # of both dampers, at 1 rad/s
    assert_allclose(moving[f"{drive}.effort"] - rest[f"{drive}.effort"], damped, rtol=1e-9)
    assert moving.variable.condition == "with inertia and damping at 1 rad/s"
    assert rest.variable.condition == "at rest, without inertia and damping"


def test_a_static_solution_is_saved_with_this_property(tmp_path: Path) -> None:
    m, start = arm()
    sol = kp.inverse_dynamics(m, start, over="arm.angle", range=(0.2, 1), n=5, static=True)
    sol.save(tmp_path / "rest.npz")
    again = kp.load_solution(tmp_path / "rest.npz")
    assert again.variable == Variable("arm.angle", "rad", static=True)
    assert not np.any(again.drift.velocity)
    (drive,) = sol.model.drivers
    assert_allclose(again(0.5)[f"{drive}.effort"], sol(0.5)[f"{drive}.effort"], rtol=1e-12)


def test_static_needs_a_value() -> None:
    m, _ = arm()
    m.coordinate_driver("motor", "arm.angle", value="0.2 + t")
    with pytest.raises(kp.ModelError, match="static: true, over time; give over and range"):
        kp.inverse_dynamics(m, kp.assemble(m), t_end=1, static=True)


CASE = """
kempe = 1
gravity = [0, -9.81]
[bodies.ground]
points = { O = [0, 0] }
[bodies.arm]
type = "bar"
mass = 2
length = 1
ends = ["O", "P"]
[joints.O]
type = "revolute"
i = "ground.O"
j = "arm.O"
[forces.damper]
type = "torsion_spring"
i = "ground"
j = "arm"
damping = 30
[measures]
speed = "arm.omega"
[start]
set = { "arm.angle" = 0 }
[analyses.duty]
type = "inverse_dynamics"
over = "arm.angle"
range = [0, "90 deg"]
n = 10
"""


def run(tmp_path: Path, text: str, *more: str) -> tuple:
    path = tmp_path / "case.toml"
    path.write_text(text, encoding="utf-8")
    done = kempe("run", str(path), "-o", str(tmp_path / "out"), "--figures", "none", *more)
    assert done.returncode == 0
    with (tmp_path / "out" / "solution.csv").open(encoding="utf-8") as file:
        rows = list(csv.reader(file))
    return done.stdout, rows


def test_a_case_has_units_by_the_value_and_says_at_which_rate(tmp_path: Path) -> None:
    told, rows = run(tmp_path, CASE)
    assert "forces and efforts with inertia and damping at 1 rad/s" in told
    assert {"arm.vx [m/rad]", "arm.omega [rad/rad]", "arm.ax [m/rad^2]"} <= set(rows[0])
    assert not [name for name in rows[0] if "/s" in name.partition(", with ")[0]]
    told, rows = run(tmp_path, CASE, "--units", "mm,deg")
    speeds = rows[0].index("arm.vy [mm/deg]")
    # the centre moves by 500 mm for each rad, which is 57.3 degrees
    assert float(rows[1][speeds]) == pytest.approx(500 * math.pi / 180, rel=1e-12)
    assert "arm.alpha [deg/deg^2]" in rows[0]


def test_a_case_may_be_static(tmp_path: Path) -> None:
    told, rows = run(tmp_path, CASE + "static = true\n")
    assert "forces and efforts at rest, without inertia and damping" in told
    torque = next(
        k for k, name in enumerate(rows[0]) if "torque_on_arm" in name and "O." not in name
    )
    first = abs(float(rows[1][torque]))
    assert first == pytest.approx(0.0, abs=1e-12) or first == pytest.approx(9.81, rel=1e-9)
    summary = json.loads((tmp_path / "out" / "summary.json").read_text("utf-8"))
    assert summary["static"] is True
    assert summary["energy"]["largest_imbalance"] < 1e-9
