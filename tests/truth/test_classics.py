"""The mechanisms of ``examples/classics/`` against geometry and balances derived by hand."""

import functools
from pathlib import Path

import kempe as kp
import numpy as np
import pytest
from house.places import ROOT
from numpy.testing import assert_allclose
from numpy.typing import NDArray

CLASSICS = sorted((ROOT / "examples" / "classics").glob("*.toml"))
Points = NDArray[np.complex128]


@functools.cache
def motion(name: str) -> kp.Solution:
    (solution,) = kp.load(ROOT / "examples" / "classics" / f"{name}.toml").run().values()
    assert isinstance(solution, kp.Solution)
    return solution


def at(solution: kp.Solution, point: str) -> Points:
    """The path of a point in the complex plane."""
    return np.asarray(solution[f"{point}.x"] + 1j * solution[f"{point}.y"])


def turned(solution: kp.Solution, angle: str) -> Points:
    return np.asarray(np.exp(1j * solution[angle]))


def meeting(p: Points | complex, q: Points | complex, rp: float, rq: float, side: int) -> Points:
    """Where circles about p and q meet, on the left (1) or right (-1) of the way from p to q."""
    d = np.asarray(q - p)
    x = (abs(d) ** 2 + rp**2 - rq**2) / (2 * abs(d))
    return p + d / abs(d) * (x + 1j * side * np.sqrt(rp**2 - x**2))


@pytest.mark.parametrize("path", CLASSICS, ids=lambda path: path.stem)
def test_a_classic_runs_and_says_in_one_sentence_what_it_is(path: Path) -> None:
    solution = motion(path.stem)
    assert solution.success
    assert solution.drift.position.max() < 1e-8
    name, _, sentence = kp.load(path).model.title.partition(": ")
    assert 0 < len(name) < 30
    assert 5 < len(sentence.split()) < 25
    long = path.stem == "walker" or path.stem.endswith("_exercise")
    assert long or path.stat().st_size < 2000


def test_chebyshev() -> None:
    run = motion("chebyshev")
    b = 5 * turned(run, "left.angle")
    middle = (b + meeting(b, 4, 2, 5, -1)) / 2
    assert_allclose(at(run, "coupler.P"), middle, atol=1e-9)
    assert np.ptp(middle.imag) < 0.02
    assert np.ptp(middle.real) > 2


def test_roberts() -> None:
    run = motion("roberts")
    b = 1.3 * turned(run, "left.angle")
    c = meeting(b, 2, 1, 1.3, 1)
    tip = (b + c) / 2 - 1.2j * (c - b)
    assert_allclose(at(run, "plate.P"), tip, atol=1e-4)  # the drawn lengths have four digits
    assert np.ptp(tip.imag) < 0.02
    assert np.ptp(tip.real) > 1


def test_scott_russell() -> None:
    run = motion("scott_russell")
    assert_allclose(at(run, "rod.P"), 2j * turned(run, "crank.angle").imag, atol=1e-12)


def test_grasshopper() -> None:
    path = at(motion("grasshopper"), "beam.P")
    assert np.ptp(path.real) < 0.05
    assert np.ptp(path.imag) > 1


def test_hart() -> None:
    run = motion("hart")
    p, q = at(run, "short1.P"), at(run, "short2.Q")
    # OP OQ = (4² - 2²)/4, on one line through O; P is on a circle through O with the radius 0.9
    assert_allclose(p * np.conj(q), -3, atol=1e-9)
    assert_allclose(q.real, -3 / 1.8, atol=1e-9)
    assert np.ptp(q.imag) > 2


def test_lambda_legs() -> None:
    run = motion("lambda_legs")
    front, back = at(run, "front_leg.F"), at(run, "back_leg.F")
    low = np.minimum(front.imag, back.imag)
    assert_allclose(low, -2, atol=0.03)  # one foot is always down
    assert np.maximum(front.imag, back.imag).max() > -1.2  # while the other is lifted
    pin = turned(run, "crank.angle")
    joint = meeting(pin, 2, 2.5, 2.5, 1)
    assert_allclose(front, 2 * joint - pin - 6j, atol=1e-9)


def test_walker() -> None:
    run = motion("walker")
    for side, pivot in (("left", -0.38 - 0.078j), ("right", 0.38 - 0.078j)):
        pin = 0.15 * turned(run, "crank.angle")
        # the lengths of Theo Jansen, m
        for one, other, length in (
            (f"{side}_shoulder.T", pin, 0.5),
            (f"{side}_foot.K", pin, 0.619),
            (f"{side}_shoulder.T", pivot, 0.415),
            (f"{side}_foot.K", pivot, 0.393),
            (f"{side}_shoulder.L", pivot, 0.401),
        ):
            assert_allclose(abs(at(run, one) - other), length, atol=2e-4)
    assert run["crank.omega"].min() > 1
    assert run["crank.omega"].max() < 3.5
    assert np.abs(run.energy.balance).max() < 1e-6


def test_whitworth() -> None:
    run = motion("whitworth")
    pin = turned(run, "crank.angle") + 0.5j
    assert_allclose(turned(run, "lever.angle"), pin / abs(pin), atol=1e-12)
    tail = -0.7 * pin / abs(pin)
    assert_allclose(abs(run["ram.x"] - tail), abs(2.9 + 0.7j), atol=1e-9)
    # where the lever is level, the crank is at ±30°: it turns by 240° above and by 120° below
    level = np.mean(pin.imag[:-1] > 0)
    assert level == pytest.approx(2 / 3, abs=0.01)


def test_drag_link() -> None:
    run = motion("drag_link")
    b = 2.2 * turned(run, "crank.angle")
    assert_allclose(at(run, "driven.C"), meeting(b, 1, 2, 2.5, 1), atol=2e-4)
    turn = np.ptp(np.unwrap(run["driven.angle"]))
    assert turn == pytest.approx(2 * np.pi, abs=1e-3)


def test_oscillating_cylinder() -> None:
    run = motion("oscillating_cylinder")
    way = 1.2 - 0.3 * turned(run, "crank.angle")
    assert_allclose(turned(run, "cylinder.angle"), way / abs(way), atol=1e-12)
    assert_allclose(run["slide.displacement"], -abs(way), atol=1e-12)


def test_flat_cam() -> None:
    run = motion("flat_cam")
    assert_allclose(run["follower.y"], 0.5 + 0.2 * np.sin(2 * np.pi * run.t), atol=1e-12)


def test_geared_five_bar() -> None:
    run = motion("geared_five_bar")
    first, second = 0.5 * turned(run, "wheel.angle"), 1.5 + 0.3 * turned(run, "pinion.angle")
    assert_allclose(run["pinion.angle"], -2 * run["wheel.angle"], atol=1e-9)
    assert_allclose(at(run, "first.P"), meeting(first, second, 1.4, 1.4, 1), atol=1e-9)


def test_belt_drive() -> None:
    run = motion("belt_drive")
    assert_allclose(run["small.omega"], 3 * run["large.omega"], atol=1e-9)
    # 2 (1 - ω/8) = 0.5 (ω/3) / 3 at rest, and the inertia 0.1 + 1/9 at the small pulley
    rate, end = (1 / 4 + 1 / 18) / (0.1 + 1 / 9), 2 / (1 / 4 + 1 / 18)
    assert_allclose(run["small.omega"], end * (1 - np.exp(-rate * run.t)), atol=1e-4)


def test_toggle_clamp() -> None:
    run = motion("toggle_clamp")
    e = 2 + 0.6 * turned(run, "handle.angle")
    c = meeting(e, 0, 1.2, 1.5, -1)
    assert_allclose(turned(run, "arm.angle"), c / abs(c), atol=1e-9)
    # with handle and link in line, the arm is at its limit: a triangle with the sides 1.5, 2, 1.8
    limit = np.arccos((1.5**2 + 2**2 - 1.8**2) / (2 * 1.5 * 2))
    assert run["arm.angle"].max() == pytest.approx(limit, abs=1e-3)


def test_parallel_lift() -> None:
    run = motion("parallel_lift")
    assert_allclose(run["platform.angle"], 0, atol=1e-9)
    length = abs(at(run, "upper.M") - 1.3j)
    assert_allclose(length, length[0] - 0.22 + 0.22 * np.cos(np.pi * run.t), atol=1e-9)
    assert np.ptp(run["platform.y"]) > 0.5


def test_conveyor() -> None:
    run = motion("conveyor")
    assert_allclose(run["trough.angle"], 0, atol=1e-4)
    pin = -1.1 + 0.55j + 0.12 * turned(run, "crank.angle")
    top = 0.6 * np.exp(1j * np.radians(110))
    rod = abs(-0.98 + 0.55j - top)
    assert_allclose(at(run, "trough.B"), meeting(0, pin, 0.6, rod, -1), atol=2e-4)


def test_ackermann() -> None:
    run = motion("ackermann")
    left, right = run["left.angle"], run["right.angle"]
    arm = (0.6 - 2j) / abs(0.6 - 2j) * 0.2
    pin = -0.6 + arm * turned(run, "left.angle")
    other = meeting(pin, 0.6, 1.2 - 2 * arm.real, 0.2, -1)
    turn = (other - 0.6) / -np.conj(arm)
    assert_allclose(turned(run, "right.angle"), turn / abs(turn), atol=1e-3)
    # for a turn to the left, the left wheel is the inner one: cot(outer) > cot(inner)
    bent = left > np.radians(5)
    assert np.all(1 / np.tan(right[bent]) - 1 / np.tan(left[bent]) > 0.3)


def test_umbrella() -> None:
    run = motion("umbrella")
    y = run["runner.y"]
    assert_allclose(at(run, "right.T"), np.sqrt(1 - y**2) + 1j * y, atol=1e-9)
    assert_allclose(at(run, "left.T"), -np.sqrt(1 - y**2) + 1j * y, atol=1e-9)


def test_inverted_pendulum() -> None:
    run = motion("inverted_pendulum")
    for time, place in ((3.0, 0.0), (6.0, 0.5)):
        end = run(time - 1e-6)
        assert end["rod"].angle == pytest.approx(np.pi / 2, abs=0.03)
        assert end["cart"].x == pytest.approx(place, abs=0.03)


def test_gripper() -> None:
    run = motion("gripper")
    assert_allclose(at(run, "upper.T"), np.conj(at(run, "lower.T")), atol=1e-9)
    assert run(1.0)["piston"].x == pytest.approx(0, abs=3e-3)
    assert run(2.0)["piston"].x == pytest.approx(-0.1, abs=3e-3)
    closed = 2 * at(run, "upper.T").imag[np.searchsorted(run.t, 1.0)]
    assert 0 < closed < 0.5


def test_ratchet() -> None:
    """The motor is released at 75 degrees, and the wheel falls back to the tooth at 60 degrees."""
    run = motion("ratchet")
    released = run.events["motor.release"].t
    assert_allclose(released, np.radians(75) / 0.8, rtol=1e-9)
    assert run["wheel.angle"].max() > np.radians(75)
    assert_allclose(run["wheel.angle"][-1], np.radians(60), atol=1e-4)
    assert_allclose(run["pawl.angle"][-1], 0, atol=1e-4)
    # the torque of the pawl about the axle is that of the weight
    force = run["catch"].force(on="wheel")[-1]
    assert_allclose(-0.8 * force[0], 60, rtol=1e-3)


def test_rocking_block() -> None:
    """Housner: each blow keeps 1 - 1.5 sin^2 of the spin, with tan = 0.25."""
    run = motion("rocking_block")
    hits = run.events["touch.hit"]
    before = np.array([state["block.omega"] for state in hits.states[:4]])
    after = np.array([run(t)["block.omega"] for t in hits.t[:4]])
    assert_allclose(after / before, 1 - 1.5 * np.sin(np.arctan(0.25)) ** 2, rtol=1e-4)
    falls = np.diff(hits.t[:5])
    assert (np.diff(falls) < 0).all()
