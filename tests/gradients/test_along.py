"""Slopes of quantities over the time of a run."""

import pickle
from typing import Any

import kempe as kp
import numpy as np
import pytest
from gradients.test_events import EXACT, ball, block

SCALES = [(1.0, 1.0, 1.0), (1e-3, 1e3, 30.0), (1e2, 1e-3, 0.1)]


@pytest.mark.parametrize("scale", SCALES)
def test_an_oscillator_in_two_runs(scale: tuple[float, float, float]) -> None:
    size, mass, rate = scale
    m = block({"m": mass, "k": 4 * mass * rate**2, "x0": 0.8 * size})
    m.generalized_force("spring", "block.x", value="-k * block.x")
    start = kp.assemble(m, set={"block.x": "x0"})
    kept: dict[str, Any] = {"method": EXACT, "slopes": ["k", "x0", "m"]}
    first = kp.dynamics(m, start, t_end=1 / rate, output_step=0.1 / rate, **kept)
    second = kp.dynamics(m, first.final, t_end=3 / rate, output_step=0.1 / rate, **kept)
    w, x0 = 2 * rate, 0.8 * size
    for sol in (first, second):
        t = sol.t
        by_w = -x0 * t * np.sin(w * t)
        assert sol.slope("block.x", "x0") == pytest.approx(np.cos(w * t), abs=1e-9)
        by_k = by_w * w / (2 * 4 * mass * rate**2)
        assert sol.slope("block.x", "k") == pytest.approx(by_k, abs=1e-9 * abs(by_k).max())
        braking = -(w**2) * np.cos(w * t)
        found = sol.slope("block.ax", "x0")
        assert found == pytest.approx(braking, abs=1e-9 * w**2)
    assert second.slope("block.x", "k").shape == second.t.shape


def test_both_sides_of_a_hit() -> None:
    m = ball({"m": 1.0, "g": 9.0, "e": 0.8}, restitution="e")
    start = kp.assemble(m, set={"ball.y": 2.0})
    sol = kp.dynamics(m, start, t_end=1.0, method=EXACT, slopes=["e", "g"])
    hit = 2.0 / 3.0
    before, after = np.flatnonzero(np.isclose(sol.t, hit, atol=1e-9))[-2:]
    # v = -g t, and e √(2 g h) - g (t - √(2 h/g)) after the hit
    by_g = sol.slope("ball.vy", "g")
    assert by_g[before] == pytest.approx(-hit, rel=1e-9)
    assert by_g[after] == pytest.approx(0.8 * 6.0 / 18.0 - hit / 2.0, rel=1e-9)
    assert sol.slope("ball.vy", "e")[[before, after]] == pytest.approx([0.0, 6.0], abs=1e-9)


def test_a_driven_motion() -> None:
    m = kp.Model("crank", parameters={"a": 0.3, "b": 1.0})
    m.ground.points(O=(0, 0))
    m.bar("crank", mass=1, length="a", ends=("O", "A"))
    m.bar("rod", mass=1, length="b", ends=("A", "B"))
    m.body("slide", mass=2, inertia=1, points={"B": (0, 0)})
    m.revolute("O", "ground.O", "crank.O")
    m.revolute("A", "crank.A", "rod.A")
    m.revolute("B", "rod.B", "slide.B")
    m.translational("guide", "ground.O", "slide.B")
    m.coordinate_driver("drive", "O.angle", value="2 * t")
    start = kp.assemble(m, guess={"slide.x": 1.3, "rod.angle": 0})
    sol = kp.kinematics(m, start, t_end=2.0, slopes=["a", "b"])
    turn = 2 * sol.t
    root = np.sqrt(1.0 - (0.3 * np.sin(turn)) ** 2)
    by_a = np.cos(turn) - 0.3 * np.sin(turn) ** 2 / root
    assert sol.slope("slide.x", "a") == pytest.approx(by_a, abs=1e-10)
    assert sol.slope("slide.x", "b") == pytest.approx(1.0 / root, abs=1e-10)
    efforts = kp.inverse_dynamics(m, start, t_end=2.0, slopes=["a"])
    longer = kp.inverse_dynamics(m.with_parameters({"a": 0.3 + 1e-5}), *_start(m, 1e-5), t_end=2.0)
    shorter = kp.inverse_dynamics(m.with_parameters({"a": 0.3 - 1e-5}), *_start(m, -1e-5), t_end=2)
    slope = (longer["drive.effort"] - shorter["drive.effort"]) / 2e-5
    assert efforts.slope("drive.effort", "a") == pytest.approx(slope, abs=1e-6 * abs(slope).max())


@pytest.mark.parametrize(("mass", "size"), [(2.0, 0.3), (1e-3, 40.0)])
def test_the_effort_over_a_quantity(mass: float, size: float) -> None:
    """At rest a bar on a pin needs m g a/2 cos φ, which grows with its length a and its mass."""
    m = kp.Model("bar", gravity=(0, -9.81), parameters={"a": size, "m": mass})
    m.ground.points(O=(0, 0))
    m.bar("bar", mass="m", length="a", ends=("O", "A"))
    m.revolute("O", "ground.O", "bar.O")
    way: dict[str, Any] = {"over": "bar.angle", "range": (0.1, 2.0), "n": 9, "static": True}
    sol = kp.inverse_dynamics(m, kp.assemble(m), **way, slopes=["a", "m"])
    turn = np.cos(sol.t) * 9.81 / 2
    assert sol["over.effort"] == pytest.approx(turn * mass * size, rel=1e-9)
    assert sol.slope("over.effort", "a") == pytest.approx(turn * mass, rel=1e-9)
    assert sol.slope("over.effort", "m") == pytest.approx(turn * size, rel=1e-9)


def _start(m: kp.Model, change: float) -> tuple[kp.State]:
    other = m.with_parameters({"a": 0.3 + change})
    return (kp.assemble(other, guess={"slide.x": 1.3, "rod.angle": 0}),)


def test_what_is_refused_and_what_is_kept() -> None:
    m = block({"m": 1.0, "k": 4.0})
    m.generalized_force("spring", "block.x", value="-k * block.x")
    start = kp.assemble(m, set={"block.x": 1.0})
    plain = kp.dynamics(m, start, t_end=0.5)
    with pytest.raises(kp.ModelError, match=r'no slopes; pass slopes=\["k"\]'):
        plain.slope("block.x", "k")
    with pytest.raises(kp.ModelError, match="not known how the start depends"):
        kp.dynamics(m, plain.final, t_end=1.0, slopes=["k"])
    with pytest.raises(kp.ModelError, match="unknown variable 'kk'"):
        kp.dynamics(m, start, t_end=1.0, slopes=["kk"])
    sol = kp.dynamics(m, start, t_end=0.5, slopes=["k", "block.x"])
    with pytest.raises(kp.ModelError, match="unknown variable of the slopes 'm'"):
        sol.slope("block.x", "m")
    with pytest.raises(kp.ModelError, match=r"block\.xx"):
        sol.slope("block.xx", "k")
    again = pickle.loads(pickle.dumps(sol))
    assert again.slope("block.x", "block.x") == pytest.approx(np.cos(2 * sol.t), abs=1e-6)
    act = kp.Event("block.x < 0", action=lambda _: None)
    with pytest.raises(kp.ModelError, match="actions"):
        kp.dynamics(m, start, t_end=1.0, slopes=["k"], events={"act": act})
