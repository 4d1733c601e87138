"""Forces and events at the time at which a law jumps: no force is beyond what its joint can carry.

Each mechanism holds until a law jumps at half of the run, and cannot hold against its new value.
"""

from __future__ import annotations

from collections.abc import Callable

import kempe as kp
import numpy as np
import pytest

SIZES = [(1.0, 1.0), (1e-3, 1e3), (1e3, 1e-3), (3.7e2, 41.0)]
G = 9.81


def block(mass: float, size: float, law: str, pair: str) -> tuple[kp.Model, dict[str, float]]:
    m = kp.Model("block", gravity=(0, -G))
    m.ground.points(O=(0, 0))
    m.body("block", mass=mass, inertia=mass * size**2, points={"P": (0, 0)})
    axes = ("90 deg", "90 deg") if pair == "stop" else (0, 0)
    m.translational("slide", "ground.O", "block.P", axes=axes)
    if pair == "stop":
        m.stop("pair", "slide.displacement", lower=0, restitution=0)
    else:
        m.friction("pair", "slide", kinetic=0.2, static=0.3)
    m.generalized_force("push", "slide.displacement", value=law)
    return m, {"slide.displacement": 0, "slide.rate": 0}


def rubbed(mass: float, size: float, t: float) -> tuple[kp.Model, dict[str, float], list[float]]:
    w = mass * G
    m, rest = block(mass, size, f"if(t < {t!r}, {0.1 * w!r}, {5 * w!r})", "friction")
    return m, rest, [-0.1 * w, -0.2 * w]


def lifted(mass: float, size: float, t: float) -> tuple[kp.Model, dict[str, float], list[float]]:
    w = mass * G
    m, rest = block(mass, size, f"if(t < {t!r}, 0, {3 * w!r})", "stop")
    return m, rest, [w, 0.0]


def pushed(mass: float, size: float, t: float) -> tuple[kp.Model, dict[str, float], list[float]]:
    """The law depends on the place of another body."""
    w, v = mass * G, size / t
    m, rest = block(mass, size, f"if(cart.x < {size!r}, {0.1 * w!r}, {5 * w!r})", "friction")
    m.body("cart", mass=mass, inertia=mass * size**2, points={"P": (0, 0)})
    m.translational("rail", "ground.O", "cart.P")
    return m, rest | {"rail.displacement": 0, "rail.rate": v}, [-0.1 * w, -0.2 * w]


def clutched(mass: float, size: float, t: float) -> tuple[kp.Model, dict[str, float], list[float]]:
    m = kp.Model("clutch")
    m.ground.points(O=(0, 0))
    m.body("wheel", mass=mass, inertia=mass * size**2, points={"P": (0, 0)})
    m.revolute("pin", "ground.O", "wheel.P")
    torque = mass * G * size
    m.clutch("pair", "ground", "wheel", capacity=2 * torque)
    m.torque("drive", "wheel", torque=f"if(t < {t!r}, {torque!r}, {30 * torque!r})")
    return m, {"wheel.angle": 0, "wheel.omega": 0}, [-torque, -2 * torque]


def controlled(
    mass: float, size: float, t: float
) -> tuple[kp.Model, dict[str, float], list[float]]:
    """A digital controller, whose torque jumps at its second sample."""
    m = kp.Model("controlled clutch")
    m.ground.points(O=(0, 0))
    m.body("wheel", mass=mass, inertia=mass * size**2, points={"P": (0, 0)})
    m.revolute("pin", "ground.O", "wheel.P")
    torque = mass * G * size
    m.clutch("pair", "ground", "wheel", capacity=2 * torque)
    law = kp.Sampled(lambda at, _: torque if at < 0.9 * t else 30 * torque, t)
    m.torque("drive", "wheel", torque=law)
    return m, {"wheel.angle": 0, "wheel.omega": 0}, [-torque, -2 * torque]


def rolled(mass: float, size: float, t: float) -> tuple[kp.Model, dict[str, float], list[float]]:
    """A wheel with the inertia m r² passes half of the torque to the line as long as it rolls."""
    m = kp.Model("wheel", gravity=(0, -G))
    m.ground.points(O=(0, 0))
    m.body("wheel", mass=mass, inertia=mass * size**2, points={"P": (0, 0)})
    m.rolling("pair", "ground.O", "wheel.P", radius=size, friction=0.2)
    w = mass * G
    m.torque("drive", "wheel", torque=f"if(t < {t!r}, {0.2 * w * size!r}, {9 * w * size!r})")
    rest = {"pair.displacement": 0, "pair.rate": 0, "wheel.angle": 0, "wheel.omega": 0}
    return m, rest, [0.1 * w, 0.2 * w]


Maker = Callable[[float, float, float], tuple[kp.Model, dict[str, float], list[float]]]
CASES: list[tuple[Maker, str]] = [
    (rubbed, "pair.force"),
    (pushed, "pair.force"),
    (lifted, "pair.force"),
    (clutched, "pair.torque"),
    (rolled, "pair.tangential"),
    (controlled, "pair.torque"),
]


@pytest.mark.parametrize(("mass", "size"), SIZES)
@pytest.mark.parametrize(("maker", "name"), CASES)
def test_no_force_is_beyond_its_limit(maker: Maker, name: str, mass: float, size: float) -> None:
    t = float(np.sqrt(size / G))
    m, rest, (before, after) = maker(mass, size, t)
    m.measures(force=name)
    sol = kp.dynamics(m, kp.assemble(m, set=rest), t_end=2 * t, output_step=0.3 * t)
    scale = max(abs(before), abs(after))
    held = sol.t < t * (1 - 1e-9)
    np.testing.assert_allclose(sol[name][held], before, atol=1e-7 * scale)
    np.testing.assert_allclose(sol[name][~held], after, atol=1e-7 * scale)
    assert np.count_nonzero(np.isclose(sol.t, t, rtol=1e-9)) >= 2  # the event is a row
    measure = sol.measure("force")
    assert np.isclose(measure.max, max(before, after), rtol=0, atol=1e-6 * scale)
    assert np.isclose(measure.min, min(before, after), rtol=0, atol=1e-6 * scale)
    assert np.isclose(measure.mean, (before + after) / 2, rtol=0, atol=1e-6 * scale)
    case = kp.Case(m, start={"set": rest}, analyses=[kp.Dynamics(t_end=2 * t)])
    swept = kp.sweep(case, {next(iter(rest)): [0.0]}, ["force.max", "force.min"])
    assert swept["force.max"][0] == pytest.approx(measure.max, abs=1e-6 * scale)
    assert swept["force.min"][0] == pytest.approx(measure.min, abs=1e-6 * scale)


def test_a_force_that_grows_to_its_limit_is_listed_before_and_after() -> None:
    m, rest = block(2.0, 1.0, "if(t < 1, 4*t, 4*t^2)", "friction")
    sol = kp.dynamics(m, kp.assemble(m, set=rest), t_end=2)
    limit, w = sol.events["pair.slip"].t[0], 2 * G
    assert np.isclose(limit, np.sqrt(0.3 * w / 4), rtol=1e-9)
    rows = np.flatnonzero(sol.t == limit)
    np.testing.assert_allclose(sol["pair.force"][rows], [-0.3 * w, -0.2 * w], rtol=1e-8)
    assert np.isclose(sol.events["pair.slip"].states[0]["pair.force"], -0.3 * w)


def test_the_state_of_an_event_has_the_force_of_the_law_at_this_time() -> None:
    m, rest, (_, after) = rubbed(2.0, 1.0, 1.0)
    sol = kp.dynamics(m, kp.assemble(m, set=rest), t_end=2)
    assert np.isclose(sol.events["pair.slip"].states[0]["pair.force"], after)


@pytest.mark.parametrize(("mass", "size"), SIZES)
def test_a_condition_becomes_true_at_a_sample(mass: float, size: float) -> None:
    t = float(np.sqrt(size / G))
    m = kp.Model("wheel")
    m.ground.points(O=(0, 0))
    m.body("wheel", mass=mass, inertia=mass * size**2, points={"P": (0, 0)})
    m.revolute("pin", "ground.O", "wheel.P")
    one = mass * size**2 / t**2
    values = [one, one, 30 * one, 30 * one, one, one]
    law = kp.Sampled(lambda at, _: values[round(at / t)], t)
    m.torque("drive", "wheel", torque=law)
    rest = kp.assemble(m, set={"wheel.angle": 0, "wheel.omega": 0})
    limit = repr(5 / t**2)
    events = {"fast": f"wheel.alpha > {limit}", "change": f"wheel.alpha - {limit}"}
    sol = kp.dynamics(m, rest, t_end=5.5 * t, events=events)
    np.testing.assert_allclose(sol.events["fast"].t, [2 * t], rtol=1e-9)
    np.testing.assert_allclose(sol.events["change"].t, [2 * t, 4 * t], rtol=1e-9)
    stopped = kp.dynamics(m, rest, t_end=5.5 * t, stop=f"wheel.alpha > {limit}")
    assert np.isclose(stopped.t[-1], 2 * t, rtol=1e-9)
