"""The examples with stops and contacts against closed forms and models with one coordinate."""

from __future__ import annotations

import kempe as kp
import numpy as np
import pytest
from house.places import ROOT
from motions import results
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

G = 9.81
M, B, PUSH = 25.0, 0.9, 12 * 2 * 0.9
R = B / 2
J = M * B**2 / 3
OMEGA = np.sqrt(2 * PUSH * R * np.pi / 3 / J)


def example(name: str, **parameters: float) -> kp.Case:
    return kp.load(ROOT / f"examples/{name}.toml", parameters=parameters or None)


@pytest.fixture(scope="module")
def door() -> kp.Case:
    return example("slamming_door")


def test_the_door_bounces_to_rest_in_the_time_of_a_geometric_series(door: kp.Case) -> None:
    slam = door.run()["slam"]
    alpha, e = PUSH * R / J, 0.3
    first = np.sqrt(2 * np.pi / 3 / alpha)
    hit = slam.events["stop.hit"]
    k = np.arange(len(hit.t))
    # sin φ of the coordinate S.y is zero where φ is; the motion in φ has constant acceleration
    expected = first + 2 * e * OMEGA / alpha * (1 - e**k) / (1 - e)
    np.testing.assert_allclose(hit.t, expected, atol=1e-7)
    rates = [state["door.omega"] for state in hit.states]
    np.testing.assert_allclose(rates, -OMEGA * e**k, rtol=1e-6, atol=1e-7)
    assert slam["door.angle"][-1] == pytest.approx(0, abs=1e-10)
    assert slam["stop.force"][-1] == pytest.approx(PUSH * R / 0.85, rel=1e-9)


@pytest.mark.parametrize("place", [0.1, 0.3, 0.6, 0.9])
def test_the_hinge_takes_the_impulse_that_the_stop_does_not(door: kp.Case, place: float) -> None:
    sol = kp.dynamics(door.model, door.start(), t_end=1.25, parameters={"s": place})
    hit = sol.events["stop.hit"]
    stop = J * 1.3 * OMEGA / place
    assert hit.impulse("stop", on="door")[0] == pytest.approx([0, stop], rel=1e-7, abs=1e-9)
    hinge = M * R * 1.3 * OMEGA - stop
    assert hit.impulse("hinge", on="door")[0] == pytest.approx([0, hinge], rel=1e-6, abs=1e-6)
    if place == 0.6:  # the centre of percussion, 2/3 of the width
        assert abs(hinge) < 1e-9 * stop


def test_the_buffer_and_the_hinge_follow_a_model_with_one_coordinate(door: kp.Case) -> None:
    s, proud, k, c = 0.85, 0.03, 3e4, 2.0

    def force(phi: float, omega: float) -> float:
        depth, rate = proud - s * np.sin(phi), -s * np.cos(phi) * omega
        return max(0.0, k * depth * (1 + c * rate)) if depth > 0 else 0.0

    def rates(_: float, y: np.ndarray) -> list[float]:
        return [y[1], (s * np.cos(y[0]) * force(*y) - PUSH * R) / J]

    soft = door.run()["buffered"]
    own = solve_ivp(
        rates, (0, 2.5), [np.pi / 3, 0], t_eval=soft.t, rtol=1e-9, atol=1e-11, max_step=2e-3
    )
    phi, omega = own.y
    np.testing.assert_allclose(soft["door.angle"], phi, atol=2e-6)
    pushed = np.array([force(*y) for y in own.y.T])
    np.testing.assert_allclose(soft["buffer.force"], pushed, atol=0.05)
    alpha = (s * np.cos(phi) * pushed - PUSH * R) / J
    along = np.exp(1j * phi)
    centre = R * (1j * alpha - omega**2) * along
    hinge = M * centre - 1j * pushed + PUSH * 1j * along
    found = soft["hinge"].force(on="door") @ [1, 1j]
    np.testing.assert_allclose(found, hinge, atol=0.05)
    assert pushed.max() > 900
    assert len(soft.events["stop.hit"].t) == 0


MASS, RATE, PRESSED, ECC = 0.3, 4000.0, 60 + 0.3 * G, 0.005
LIMIT = np.sqrt(RATE / MASS + PRESSED / (MASS * ECC))


def jumping(speed: float) -> kp.Solution:
    return example("jumping_follower", speed=speed).run()["turns"]


@pytest.mark.parametrize("part", [0.5, 0.97, 0.9999])
def test_below_the_limit_the_follower_stays_on_the_cam(part: float) -> None:
    speed = part * LIMIT
    sol = jumping(speed)
    assert not any(len(sol.events[f"touch.{name}"].t) for name in ("hit", "release"))
    normal = PRESSED + (RATE - MASS * speed**2) * ECC * np.sin(speed * sol.t)
    np.testing.assert_allclose(sol["touch.force"], normal, atol=1e-7)
    np.testing.assert_allclose(sol["touch.gap"], 0, atol=1e-12)


@pytest.mark.parametrize("part", [1.0001, 1.002, 1.01, 1.1, 1.3])
def test_above_the_limit_it_flies_as_a_mass_on_a_spring(part: float) -> None:
    speed = part * LIMIT
    sol = jumping(speed)
    leaves = np.arcsin(PRESSED / ((MASS * speed**2 - RATE) * ECC)) / speed
    release, hit = (sol.events[f"touch.{name}"] for name in ("release", "hit"))
    # the force is nearly level where it becomes zero just above the limit
    assert release.t[0] == pytest.approx(leaves, abs=1e-9 / (part - 1))
    natural, rest = np.sqrt(RATE / MASS), -PRESSED / RATE
    x, v = ECC * np.sin(speed * leaves), ECC * speed * np.cos(speed * leaves)

    def gap(t: float) -> float:
        s = natural * (t - leaves)
        flown = rest + (x - rest) * np.cos(s) + v / natural * np.sin(s)
        return flown - ECC * np.sin(speed * t)

    # at first the gap grows with the third power of time
    lands = brentq(gap, leaves + 1.2 * (np.pi / (2 * speed) - leaves), leaves + 2 * np.pi / speed)
    assert hit.t[0] == pytest.approx(lands, rel=1e-6)
    rate = (gap(lands + 1e-7) - gap(lands - 1e-7)) / 2e-7
    assert hit.states[0]["touch.gap_rate"] == pytest.approx(rate, rel=1e-4)
    impulse = hit.impulse("touch", on="follower")[0]
    assert impulse == pytest.approx([0, -1.2 * MASS * rate], rel=1e-4, abs=1e-9)
    assert sol["touch.gap"].min() > -1e-11


def test_the_joint_and_the_contact_agree_until_the_follower_leaves() -> None:
    contact = jumping(260)
    tree = example("jumping_follower").model.tree()
    del tree["forces"]["touch"]
    tree["joints"]["touch"] = {"type": "flat_on_curve", "i": "follower.P", "curve": "cam.rim"}
    held = kp.Model.from_tree(tree)
    start = kp.assemble(held, guess={"follower.y": 0.025})
    with pytest.warns(kp.EventWarning, match="touch.lift_off"):
        sol = kp.dynamics(held, start, t_end=0.006, output_step=2e-4)
    leaves = contact.events["touch.release"].t[0]
    assert sol.events["touch.lift_off"].t[0] == pytest.approx(leaves, rel=1e-8)
    for t in np.linspace(0, 0.99 * leaves, 7):
        assert sol(t)["touch.normal"] == pytest.approx(contact(t)["touch.force"], rel=1e-6)


ARM, STATION = 0.05, np.pi / 2
SPEED = 2 * np.pi
CLEAR, SOFT = 5e-5, 2e6


@pytest.fixture(scope="module")
def geneva() -> kp.Solution:
    return results("geneva_drive")["turns"]


def of_pin(sol: kp.Solution) -> tuple[np.ndarray, np.ndarray]:
    """The angle of the pin from the line of the shafts, and the number of the turn."""
    turn = np.round((sol["driver.angle"] - np.pi) / (2 * np.pi))
    return sol["driver.angle"] - np.pi - 2 * np.pi * turn, turn


def test_the_wheel_turns_by_a_quarter_and_dwells(geneva: kp.Solution) -> None:
    """tan ψ = sin φ/(√2 - cos φ) for |φ| < 45°, and 270° of dwell; play and depth apart."""
    phi, turn = of_pin(geneva)
    inside = np.clip(phi, -np.pi / 4, np.pi / 4)
    psi = np.arctan2(np.sin(inside), np.sqrt(2) - np.cos(inside))
    apart = geneva["wheel.angle"] + psi + turn * STATION
    x = ARM * np.sqrt(3 - 2 * np.sqrt(2) * np.cos(inside))
    driven = abs(phi) < np.pi / 4
    depth = np.maximum(-geneva["pin.gap"], 0)
    assert np.all(abs(apart[driven]) * x[driven] < CLEAR + depth[driven] + 1e-6)
    # the corners of the disc leave more play than the noses, at most this
    assert abs(apart[~driven]).max() < 2.5e-3
    assert np.ptp(geneva["wheel.angle"]) == pytest.approx(2 * STATION, abs=5e-3)
    assert len(geneva.events["pin.hit"].t) >= 4


def test_the_gap_of_the_pin_is_its_distance_from_the_walls(geneva: kp.Solution) -> None:
    phi, _ = of_pin(geneva)
    deep = abs(phi) < 0.7
    pin = ARM * np.exp(1j * phi[deep]) - ARM * np.sqrt(2)
    local = pin * np.exp(-1j * geneva["wheel.angle"][deep])
    slot = np.round(np.angle(local) / STATION)
    local = local * np.exp(-1j * slot * STATION)
    gap = CLEAR - abs(local.imag)
    np.testing.assert_allclose(geneva["pin.gap"][deep], gap, atol=1e-12)
    pressed = np.where(gap < 0, SOFT * -gap * (1 - 20 * geneva["pin.gap_rate"][deep]), 0)
    np.testing.assert_allclose(geneva["pin.force"][deep], np.maximum(pressed, 0), atol=1e-4)
    # its moment turns the wheel: across the slot, at the distance of the pin along it
    omega, alpha = (geneva[f"wheel.{name}"][deep] for name in ("omega", "alpha"))
    moment = np.sign(local.imag) * geneva["pin.force"][deep] * local.real
    np.testing.assert_allclose(5e-3 * alpha + 0.02 * omega, moment, atol=1e-6)
    # and the motor works against the same force, about the other shaft
    across = np.exp(1j * (geneva["wheel.angle"][deep] + slot * STATION + np.pi / 2))
    force = np.sign(local.imag) * geneva["pin.force"][deep] * across
    effort = (np.conj(ARM * np.exp(1j * phi[deep])) * force).imag
    np.testing.assert_allclose(geneva["motor.effort"][deep], effort, atol=1e-6)


def test_the_force_of_the_pin_is_that_of_a_rigid_one_until_it_changes_the_wall(
    geneva: kp.Solution,
) -> None:
    phi, _ = of_pin(geneva)
    before = (phi > -0.35) & (phi < -0.1)
    below = 3 - 2 * np.sqrt(2) * np.cos(phi[before])
    rate = SPEED * (np.sqrt(2) * np.cos(phi[before]) - 1) / below
    acceleration = -(SPEED**2) * np.sqrt(2) * np.sin(phi[before]) / below**2
    rigid = (5e-3 * acceleration + 0.02 * rate) / (ARM * np.sqrt(below))
    np.testing.assert_allclose(geneva["pin.force"][before], rigid, rtol=0.08)


@pytest.mark.parametrize("sign", [1, -1])
def test_a_nose_holds_the_wheel(sign: int) -> None:
    """2 N·m at 50 mm: 40 N, and the play and the depth over 50 mm."""
    case = example("geneva_drive")
    case.model.torque("push", "wheel", torque=f"{2 * sign}*step5(t, 0.02, 0, 0.1, 1)")
    sol = kp.dynamics(case.model, case.start(), t_end=0.2)
    forces = np.array([sol[f"N{k}.force"][-1] for k in range(1, 9)])
    assert sorted(forces)[-1] == pytest.approx(40, rel=0.01)
    assert np.count_nonzero(forces) == 1
    moved = sign * (sol["wheel.angle"][-1] - np.pi / 4)
    assert moved == pytest.approx((CLEAR + 40 / SOFT) / ARM, rel=0.01)
