"""Conditions that jump where the motion does: at impacts, releases, switches and actions."""

from __future__ import annotations

import kempe as kp
import numpy as np
import pytest

METHODS: list[kp.Option] = [kp.Auto(), kp.RK45(), kp.Radau(), kp.GeneralizedAlpha()]
each_method = pytest.mark.parametrize("method", METHODS, ids=lambda method: method.kind)


def ball(size: float, mass: float) -> tuple[kp.Model, kp.State]:
    """A ball that falls from 5 sizes onto a floor in 1 s, and bounces with 0.8 of its speed."""
    m = kp.Model("ball", gravity=(0, -10 * size))
    m.point_mass("ball", mass=mass)
    m.stop("floor", "ball.y", lower=0.0, restitution=0.8)
    start = {"ball.x": 0, "ball.y": 5 * size, "ball.vx": 0, "ball.vy": 0}
    return m, kp.assemble(m, start)


@each_method
@pytest.mark.parametrize(("size", "mass"), [(1.0, 1.0), (1e-3, 1e3), (1e3, 1e-3)])
def test_a_condition_that_becomes_true_in_an_impact(
    method: kp.Option, size: float, mass: float
) -> None:
    m, start = ball(size, mass)
    events = {
        "up": "ball.vy > 0",
        "any": f"ball.vy - {3 * size!r}",
        "down": kp.Event("ball.vy", direction="falling"),
        "place": f"ball.y < {-size!r}",
    }
    found = kp.dynamics(m, start, t_end=4, method=method, events=events).events
    hits = [1.0, 2.6, 3.88]
    assert found["up"].t == pytest.approx(hits, abs=1e-6)
    assert found["up"].t == pytest.approx(found["floor.hit"].t, abs=1e-12)
    assert found["any"].t == pytest.approx([1.0, 1.5, 2.6, 2.94, 3.88], abs=1e-6)
    assert found["down"].t == pytest.approx([1.8, 3.24], abs=1e-6)
    assert len(found["place"].t) == 0


@each_method
def test_an_impact_stops_the_run_and_acts(method: kp.Option) -> None:
    m, start = ball(1.0, 2.0)
    sol = kp.dynamics(m, start, t_end=4, method=method, stop="ball.vy > 7")
    assert (sol.status, sol.t[-1]) == (1, pytest.approx(1.0, abs=1e-6))
    assert sol["ball.vy"][-1] == pytest.approx(8.0, abs=1e-5)
    seen: list[float] = []

    def note(state: kp.State) -> None:
        seen.append(float(state["ball.vy"]))

    event = {"up": kp.Event("ball.vy > 0", action=note)}
    kp.dynamics(m, start, t_end=3, method=method, events=event)
    assert seen == pytest.approx([8.0, 6.4], abs=1e-5)


def test_steps_list_the_same_events() -> None:
    m, _ = ball(1.0, 2.0)
    case = kp.Case(m, {"set": {"ball.x": 0, "ball.y": 5, "ball.vx": 0, "ball.vy": 0}})
    stepper, found = kp.Stepper(case, kp.Dynamics(1, events={"up": "ball.vy > 0"})), []
    for _ in range(40):
        stepper.step(0.1)
        found += stepper.events["up"].t.tolist()
    assert found == pytest.approx([1.0, 2.6, 3.88], abs=1e-9)


def test_forces_that_jump_at_a_release_or_where_friction_turns() -> None:
    wheel = kp.Model("wheel")
    wheel.ground.points(O=(0, 0))
    wheel.body("w", mass=1, inertia=1, points={"O": (0, 0)})
    wheel.revolute("pin", "ground.O", "w.O")
    wheel.coordinate_driver("drive", "w.angle", value="t", release="t > 0.5")
    wheel.torque("load", "w", torque=2)
    conditions = {"free": "w.alpha > 1", "effort": "drive.effort + 1"}
    sol = kp.dynamics(wheel, kp.assemble(wheel), t_end=1, events=conditions)
    for name in conditions:
        assert sol.events[name].t == pytest.approx([0.5], abs=1e-12), name
    block = kp.Model("block", gravity=(0, -10))
    block.ground.points(O=(0, 0))
    block.body("b", mass=1, inertia=1, points={"P": (0, 0)})
    block.translational("slide", "ground.O", "b.P")
    block.friction("rub", "slide", kinetic=0.3)
    block.force("pull", "b.P", force=(-8, 0))
    start = kp.assemble(block, {"slide.displacement": 0, "slide.rate": 1})
    sol = kp.dynamics(block, start, t_end=1, events={"turns": "rub.force > 0", "a": "b.ax + 8"})
    for name in ("turns", "a"):
        assert sol.events[name].t == pytest.approx([1 / 11], abs=1e-9), name


def test_rest_is_no_jump() -> None:
    """A ball without restitution keeps a rate of rounding errors."""
    m = kp.Model("ball", gravity=(0.0, -10.0))
    m.point_mass("ball", mass=2)
    m.stop("floor", "ball.y", lower=0.0, restitution=0)
    start = kp.assemble(m, {"ball.x": 0, "ball.y": 5, "ball.vx": 0, "ball.vy": 0})
    sol = kp.dynamics(m, start, t_end=3, events={"up": "ball.vy > 0"})
    assert len(sol.events["up"].t) == 0
    assert np.abs(sol["ball.vy"][-1]) < 1e-12
