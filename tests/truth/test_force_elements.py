"""Force elements through the public interface, by their own quantities, against closed forms."""

import json
from typing import Any

import kempe as kp
import numpy as np
import pytest
from house.places import ROOT

ADAMS = json.loads((ROOT / "tests/reference/adams.json").read_text("utf-8"))["cases"]
EXACT = kp.DOP853(rtol=1e-12, atol=1e-14)


def run(m: kp.Model, start: dict[str, Any], t_end: float = 3.0) -> kp.Solution:
    return kp.dynamics(m, kp.assemble(m, set=start), t_end=t_end, output_step=0.01, method=EXACT)


def damped(t: np.ndarray, x: float, rate: float, decay: float) -> tuple[np.ndarray, np.ndarray]:
    """x″ + 2 decay x′ + rate² x = 0, released from rest at x: value and derivative."""
    fast = np.sqrt(rate**2 - decay**2)
    cos, sin = np.cos(fast * t), np.sin(fast * t)
    value = x * np.exp(-decay * t) * (cos + decay / fast * sin)
    return value, -x * np.exp(-decay * t) * rate**2 / fast * sin


@pytest.mark.parametrize("name", ADAMS)
def test_the_rod_of_adams(name: str) -> None:
    m = kp.Model("rod", gravity=(0, -9.80665))
    m.ground.points(O=(0, 0))
    m.body("rod", mass=1, inertia=0.1, points={"O": (-2, 0)})
    m.revolute("pin", "ground.O", "rod.O")
    sprung = "spring" in name
    if sprung:
        m.torsion_spring("spring", "ground", "rod", stiffness=200, damping=10)
    sol = run(m, {"rod.angle": 0}, t_end=5)
    for row in ADAMS[name]["rows"]:
        at = sol(row["t"])
        place = [at["rod.x"], at["rod.y"]]
        assert place == pytest.approx(row["adams_pos"], abs=1e-5)
        np.testing.assert_allclose([*place, at["pin.angle"]], row["q"], rtol=0, atol=1e-9)
        on_ground = [-at["pin.fx"], -at["pin.fy"]]
        assert on_ground == pytest.approx(row["adams_Rforce"], abs=1e-2)
        np.testing.assert_allclose(on_ground, row["Rforce"], rtol=0, atol=1e-8)
        assert [at["pin.omega"], at["pin.alpha"]] == pytest.approx([row["v"][2], row["a"][2]])
        if sprung:
            torque = -200 * row["q"][2] - 10 * row["v"][2]
            assert at["spring.torque"] == pytest.approx(torque, abs=1e-7)


def test_a_spring_damper_with_preload() -> None:
    m = kp.Model("TSDA")
    m.ground.points(O=(0, 0))
    m.body("mass", mass=2, inertia=1, points={"P": (0, 0)})
    m.translational("guide", "ground.O", "mass.P")
    m.spring_damper("s", "ground.O", "mass.P", stiffness=50, damping=4, free_length=1, preload=-10)
    sol = run(m, {"mass.x": 1.5})
    rest = 1 + 10 / 50  # 50 (l - 1) - 10 = 0
    x, v = damped(sol.t, 1.5 - rest, 5, 1)
    np.testing.assert_allclose(sol["s.length"], rest + x, rtol=0, atol=1e-9)
    np.testing.assert_allclose(sol["s.rate"], v, rtol=0, atol=1e-9)
    np.testing.assert_allclose(sol["s.force"], -50 * x - 4 * v, rtol=0, atol=1e-8)


def test_a_torsion_spring_with_preload() -> None:
    m = kp.Model("RSDA")
    m.ground.points(O=(0, 0))
    m.body("wheel", mass=1, inertia=0.5, points={"O": (0, 0)})
    m.revolute("pin", "ground.O", "wheel.O")
    m.torsion_spring("s", "ground", "wheel", stiffness=8, damping=0.6, free_angle=0.3, preload=1.6)
    sol = run(m, {"wheel.angle": 0.7})
    rest = 0.3 - 1.6 / 8
    x, v = damped(sol.t, 0.7 - rest, 4, 0.6)
    np.testing.assert_allclose(sol["s.angle"], rest + x, rtol=0, atol=1e-9)
    np.testing.assert_allclose(sol["s.omega"], v, rtol=0, atol=1e-9)
    np.testing.assert_allclose(sol["s.torque"], -8 * x - 0.6 * v, rtol=0, atol=1e-8)


@pytest.mark.parametrize(("only", "sign"), [("tension", 1), ("compression", -1)])
def test_a_spring_that_acts_on_one_side(only: str, sign: int) -> None:
    """Free flight, half a period at the spring, free flight back."""
    m = kp.Model("cord")
    m.ground.points(O=(0, 0))
    m.body("mass", mass=2, inertia=1, points={"P": (0, 0)})
    m.translational("guide", "ground.O", "mass.P")
    m.spring_damper("s", "ground.O", "mass.P", stiffness=50, free_length=2, only=only)
    sol = run(m, {"mass.x": 2 - sign * 0.5, "mass.vx": sign * 2}, t_end=1.2)
    touch, leave = 0.25, 0.25 + np.pi / 5
    stretch = np.select(
        [sol.t < touch, sol.t < leave],
        [2 * (sol.t - touch), 0.4 * np.sin(5 * (sol.t - touch))],
        -2 * (sol.t - leave),
    )
    np.testing.assert_allclose(sign * (sol["s.length"] - 2), stretch, rtol=0, atol=1e-9)
    force = -sign * 50 * np.maximum(stretch, 0)
    np.testing.assert_allclose(sol["s.force"], force, rtol=0, atol=1e-7)


def test_a_bushing_with_three_frequencies() -> None:
    m = kp.Model("mount")
    m.ground.points(O=(0.4, -0.2))
    m.body("engine", mass=2, inertia=0.5, points={"P": (0, 0)})
    m.bushing("b", "ground.O", "engine.P", stiffness=(8, 18, 8), damping=(0.8, 1.6, 0.4))
    sol = run(m, {"engine.x": 0.5, "engine.y": 0, "engine.angle": 0.3})
    cases = (("x", "vx", 0.1, 2, 0.2), ("y", "vy", 0.2, 3, 0.4), ("angle", "omega", 0.3, 4, 0.4))
    for place, rate, first, frequency, decay in cases:
        x, v = damped(sol.t, first, frequency, decay)
        np.testing.assert_allclose(sol[f"b.{place}"], x, rtol=0, atol=1e-9)
        np.testing.assert_allclose(sol[f"b.{rate}"], v, rtol=0, atol=1e-9)
    x, v = damped(sol.t, 0.3, 4, 0.4)
    np.testing.assert_allclose(sol["b.torque"], -8 * x - 0.4 * v, rtol=0, atol=1e-8)
