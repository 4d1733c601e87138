"""Peaks of runs that pass singular positions agree with closed forms.

All windows of an N-four-bar remain parallelograms. Moments about both ends of each coupler give the
vertical forces, and moments about the pivots of the cranks the horizontal ones. These are quotients
by the sine of the crank angle: for more than one window they have a pole on the line.
"""

from functools import cache
from typing import Any

import kempe as kp
import numpy as np
import pytest
from kempe.plot.panel import curve
from kempe.report import summary
from kempe.results.extrema import largest, least, peak, unbounded
from sizes import FULL

from examples import n_four_bar
from examples.n_four_bar import GRAVITY, rate, upright, windows


@cache
def passing(n: int, output_step: float = 0.01) -> kp.Solution:
    model = windows(n)
    return kp.dynamics(model, upright(model, n), t_end=10, output_step=output_step)


def forces(angle: np.ndarray, n: int) -> np.ndarray:
    """Forces on the left ends of all couplers at crank angles, (n_t, n, 2), N."""
    omega, sine, cosine = rate(angle, n), np.sin(angle), np.cos(angle)
    alpha = -GRAVITY * ((n + 1) / 2 + n) * cosine / ((n + 1) / 3 + n)
    ax, ay = -alpha * sine - omega**2 * cosine, alpha * cosine - omega**2 * sine
    vertical = (GRAVITY + ay) / 2
    found, right = np.empty((len(angle), n, 2)), np.zeros_like(angle)
    for k in range(n):
        on_tip = -(1 if k == 0 else 2) * vertical
        left = -((on_tip - GRAVITY / 2) * cosine - alpha / 3) / sine - right
        found[:, k] = np.stack([left, vertical], axis=1)
        right = ax - left
    return found


def force(k: int, motion: kp.Motion) -> np.ndarray:
    return motion.constraint(f"B{k}").force(on=f"coupler{k}")


#: Windows and one of their joints.
JOINTS = [(1, 0), (2, 0), (2, 1), (40, 20), *[(40, 0), (40, 39)] * FULL]


@pytest.mark.parametrize(("n", "k"), JOINTS)
def test_peaks_are_those_away_from_singular_positions(n: int, k: int) -> None:
    sol = passing(n)
    angle = np.linspace(0, 2 * np.pi, 200_001)
    angle = angle[np.abs(np.sin(angle)) > 0.15]  # nearer to the line the poles outgrow the rest
    exact = forces(angle, n)[:, k]
    high = peak(sol, lambda motion: np.hypot(*force(k, motion).T))
    assert high.value == pytest.approx(np.hypot(*exact.T).max(), rel=1e-6)
    for axis in (0, 1):
        most = largest(sol, lambda motion, axis=axis: force(k, motion)[:, axis])
        less = least(sol, lambda motion, axis=axis: force(k, motion)[:, axis])
        found, true = (most.value, less.value), (exact[:, axis].max(), exact[:, axis].min())
        assert found == pytest.approx(true, rel=1e-6)


@pytest.mark.parametrize("method", [kp.Auto(), kp.RK45(), kp.DOP853()])
@pytest.mark.parametrize("n", [1, 2])
def test_a_finite_peak_on_the_line(n: int, method: object, monkeypatch: Any) -> None:
    """Without weight each coupler is carried by m ω²/2 = 0.5 N along the cranks."""
    monkeypatch.setattr(n_four_bar, "GRAVITY", 0.0)
    model = windows(n)
    sol = kp.dynamics(model, upright(model, n), t_end=10, method=method)
    for extreme, value in ((largest, 0.5), (least, -0.5)):
        found = extreme(sol, lambda motion: force(0, motion)[:, 0])
        assert found.value == pytest.approx(value, rel=0.02)
    assert not len(unbounded(sol, lambda motion: force(0, motion)[:, 0]))


def test_times_without_bound_are_those_on_the_line() -> None:
    for n in (2, 40):
        sol = passing(n)
        times = unbounded(sol, lambda motion: np.hypot(*force(0, motion).T))
        crossings = np.flatnonzero(np.diff(np.sign(np.sin(sol["crank0"].angle))))
        assert len(times) == len(crossings) == 10
        assert np.abs(np.sin(sol(times)["crank0"].angle)).max() < 1e-3
    one = passing(1)  # its forces are finite on the line
    assert not len(unbounded(one, lambda motion: np.hypot(*force(0, motion).T)))


def test_summary_and_figure_agree_whatever_the_outputs_are() -> None:
    runs = [passing(2, step) for step in (0.01, 0.0037)]
    first, second = (summary(sol)["peaks"]["reactions"] for sol in runs)
    assert first == second
    drawn = curve(runs[0], "|F|", lambda motion: np.hypot(*force(0, motion).T), {})
    (printed,) = (r for r in first if r["joint"] == "B0")
    assert drawn.high == (printed["force"], printed["force_at"])
    assert drawn.span[1] == drawn.high.value < 0.2 * drawn.values.max()
    assert len(printed["unbounded_at"]) == 10


def test_a_blow_is_no_singular_position() -> None:
    """A mass of 2 kg is pushed by 1 mm within a millisecond: F = m ẍ, at most 2 · 2 kN."""
    width = 1e-3
    m = kp.Model("blow", gravity=(0, 0))
    m.ground.points(O=(0, 0))
    m.body("mass", mass=2, inertia=1, points={"P": (0, 0)})
    m.translational("guide", "ground.O", "mass.P")
    m.coordinate_driver("push", "mass.x", value=f"0.001*exp(-((t - 0.5)/{width})^2)")
    sol = kp.dynamics(m, kp.assemble(m), t_end=1, output_step=0.013, method=kp.RK45(max_step=1e-3))
    found = peak(sol, lambda motion: motion.constraint("push").force(on="mass")[:, 0])
    assert abs(found.value) == pytest.approx(2 * 0.001 * 2 / width**2, rel=1e-4)
    assert found.t == pytest.approx(0.5, abs=1e-5)
    assert not len(unbounded(sol, lambda motion: motion.lam[:, 0]))


def test_arrows_take_their_scale_from_values_away_from_singular_positions() -> None:
    sol = passing(2)
    angle = np.linspace(0, 2 * np.pi, 200_001)
    angle = angle[np.abs(np.sin(angle)) > 0.15]
    printed = summary(sol)["peaks"]["reactions"]
    scene, beside = kp.scene(sol), sol(np.linspace(0, 10, 100_001))
    told, (low, high) = scene["reaction_scale"], np.array(scene["bounds"]).reshape(2, 2)
    longest = 0.3 * float((high - low).max()) * told["force"] / told["length"]
    assert longest == pytest.approx(max(one["force"] for one in printed), rel=1e-6)
    assert np.hypot(*force(0, beside).T).max() > 2 * longest  # at the pole there is no bound
    # alpha sets the acceleration of the tips, which has no pole
    alpha, omega = -GRAVITY * 3.5 * np.cos(angle) / 3, rate(angle, 2)
    tips = np.hypot(alpha, omega**2).max()
    assert scene["largest"]["acceleration"] == pytest.approx(tips, rel=1e-4)
    assert scene["largest"]["velocity"] == pytest.approx(np.abs(omega).max(), rel=1e-4)
