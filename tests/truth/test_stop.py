"""Stops against closed forms."""

from __future__ import annotations

from typing import Any

import kempe as kp
import numpy as np
import pytest

TIGHT = kp.DOP853(rtol=1e-11, atol=1e-13)
K = 5e4


def turning(m: kp.Model) -> tuple[str, float]:
    m.ground.points(O=(0, 0))
    m.body("wheel", mass=1, inertia=0.4, points={"O": (0, 0)})
    m.revolute("O", "ground.O", "wheel.O")
    return "wheel.angle", 0.4


def relative(m: kp.Model) -> tuple[str, float]:
    turning(m)
    return "O.angle", 0.4


def sliding(m: kp.Model) -> tuple[str, float]:
    m.ground.points(O=(0, 0))
    m.body("block", mass=2, inertia=1, points={"P": (0, 0)})
    m.translational("slide", "ground.O", "block.P", axes=(0.6, 0.6))
    return "slide.displacement", 2.0


def falling(m: kp.Model) -> tuple[str, float]:
    m.body("block", mass=3, inertia=1, points={"P": (0.5, 0)})
    m.ground.points(O=(0, 0))
    m.constraint("level", residual=["block.x", "block.angle"], units=["m", "rad"])
    return "block.P.y", 3.0


def apart(m: kp.Model) -> tuple[str, float]:
    m.ground.points(O=(0, 0))
    m.point_mass("bead", mass=1.5)
    m.constraint("line", residual=["bead.y - bead.x"], units=["m"])
    m.spring_damper("cord", "ground.O", "bead.P")
    return "cord.length", 1.5


@pytest.mark.parametrize("make", [turning, relative, sliding, falling, apart])
@pytest.mark.parametrize("upper", [True, False])
def test_half_an_oscillation_on_a_linear_stop(make, upper: bool) -> None:  # type: ignore[no-untyped-def]
    """The time in contact is π √(m/k), the depth v √(m/k), and the speed is that of the arrival."""
    m = kp.Model("stop")
    coordinate, mass = make(m)
    limit = 0.7
    field = {"upper": limit} if upper else {"lower": limit}
    m.stop("stop", coordinate, stiffness=K, **field)
    start, rate = (0.6, 1.5) if upper else (0.8, -1.5)
    rates = {
        "wheel.angle": "wheel.omega",
        "O.angle": "wheel.omega",
        "slide.displacement": "slide.rate",
        "block.P.y": "block.vy",
        "cord.length": "cord.rate",
    }
    guess = {"bead.x": 0.5} if make is apart else {}
    along = {
        turning: {"wheel.omega": rate},
        relative: {"wheel.omega": rate},
        sliding: {"block.vx": rate * np.cos(0.6)},
        falling: {"block.vy": rate},
        apart: {"bead.vx": rate * np.sqrt(0.5)},
    }[make]
    begin = kp.assemble(m, set={coordinate: start} | along, guess=guess)
    assert begin[rates[coordinate]] == pytest.approx(rate, rel=1e-12)
    events = {"deep": "stop.gap_rate"}
    sol = kp.dynamics(m, begin, t_end=0.3, method=TIGHT, events=events)
    hit, release = sol.events["stop.hit"].t, sol.events["stop.release"].t
    assert len(hit) == len(release) == 1
    assert hit[0] == pytest.approx(0.1 / 1.5, rel=1e-10)
    assert release[0] - hit[0] == pytest.approx(np.pi * np.sqrt(mass / K), rel=1e-8)
    deep = sol.events["deep"].states[0]
    assert -deep["stop.gap"] == pytest.approx(1.5 * np.sqrt(mass / K), rel=1e-7)
    effort = "stop.torque" if "angle" in coordinate else "stop.force"
    sign = -1 if upper else 1
    assert deep[effort] == pytest.approx(sign * 1.5 * np.sqrt(mass * K), rel=1e-7)
    assert sol[rates[coordinate]][-1] == pytest.approx(-rate, rel=1e-8)
    assert np.abs(sol["energy.balance"]).max() < 1e-8
    np.testing.assert_allclose(sol["energy.dissipated"], 0, atol=1e-12)
    np.testing.assert_allclose(sol["energy.work"], 0, atol=1e-9)


def test_a_stop_on_both_sides() -> None:
    """A block between two stops: the period is that of two crossings and two half oscillations."""
    m = kp.Model("both")
    coordinate, mass = sliding(m)
    m.stop("stop", coordinate, lower=-0.2, upper=0.3, stiffness=K)
    start = kp.assemble(m, set={coordinate: 0.0, "block.vx": 2 * np.cos(0.6)})
    period = 2 * (0.5 / 2 + np.pi * np.sqrt(mass / K))
    sol = kp.dynamics(m, start, t_end=5 * period, output_step=period, method=TIGHT)
    np.testing.assert_allclose(sol[coordinate], 0, atol=1e-7)
    assert len(sol.events["stop.hit"].t) == 10
    assert sol["stop.gap"][0] == pytest.approx(0.2)
    assert sol["stop.gap_rate"][0] == pytest.approx(2)


def test_the_gap_of_a_stop_in_laws_measures_and_conditions() -> None:
    m = kp.Model("laws")
    coordinate, _ = sliding(m)
    m.stop("stop", coordinate, lower=-0.2, upper=0.3, stiffness=K)
    m.generalized_force("push", coordinate, value="20*stop.gap + stop.gap_rate")
    start = kp.assemble(m, set={coordinate: 0.2, "block.vx": 0.5 * np.cos(0.6)})
    assert start["stop.gap"] == pytest.approx(0.1)
    assert start["push.fx"] == pytest.approx((2 - 0.5) * np.cos(0.6))
    sol = kp.dynamics(m, start, t_end=0.1, events={"near": "stop.gap < 0.08"})
    assert len(sol.events["near"].t) == 1
    assert sol.events["near"].states[0][coordinate] == pytest.approx(0.22, rel=1e-9)


def test_faults_of_stops_and_contacts() -> None:
    def stop(**fields: float) -> str:
        m = kp.Model("fault")
        coordinate, _ = turning(m)
        with pytest.raises(kp.ModelError) as error:
            m.stop("stop", coordinate, **fields)
            kp.assemble(m)
        return str(error.value)

    assert "give lower, upper or both" in stop(stiffness=1)
    assert "must be larger than lower" in stop(stiffness=1, lower=2, upper=1)
    assert "give stiffness or restitution" in stop(lower=1)
    assert "not together with stiffness" in stop(lower=1, stiffness=1, restitution=0.5)
    assert "from 0 to 1" in stop(lower=1, restitution=1.5)
    assert "not together with restitution" in stop(lower=1, restitution=0.5, damping=1)
    assert "not together with restitution" in stop(lower=1, restitution=0.5, exponent=2)

    def contact(**fields: Any) -> str:
        m = kp.Model("fault")
        m.point_mass("ball", mass=1)
        m.ground.curves(floor={"line": ((1, 0), (-1, 0))})
        with pytest.raises(kp.ModelError) as error:
            m.contact("touch", "ball.P", "ground.floor", **fields)
            kp.assemble(m)
        return str(error.value)

    assert "not together with restitution" in contact(restitution=1, friction=0.2, velocity=1)
    assert "must not be below friction" in contact(restitution=1, friction=0.2, static=0.1)
    sticks = "belongs to friction that sticks"
    assert sticks in contact(stiffness=1, friction=0.2, static=0.3, velocity=1)
    assert "must not be negative" in contact(stiffness=1, radius=-1)
