"""Every example loads, assembles and runs, with a small error and balanced forces."""

from pathlib import Path

import kempe as kp
import numpy as np
import pytest
from house.places import ROOT
from motions import results
from sizes import FULL

from examples import n_four_bar

EXAMPLES = sorted((ROOT / "examples").glob("*.toml"))
#: Its run takes six seconds; tests/truth/test_example_contacts.py compares it with closed forms.
LONG = "geneva_drive"


@pytest.mark.parametrize(
    "path", [one for one in EXAMPLES if FULL or one.stem != LONG], ids=lambda path: path.stem
)
def test_an_example_runs(path: Path, tmp_path: Path) -> None:
    for solution in results(path.stem).values():
        if not isinstance(solution, kp.Solution):
            assert solution.complete  # the path of a structure reaches its end
            continue
        assert solution.success
        assert solution.drift.position.max() < 1e-6
        assert np.abs(solution.energy.balance).max() < 1e-5
        assert solution.newton_euler.largest <= 1e-9
        solution.to_csv(tmp_path / "solution.csv")
        header = (tmp_path / "solution.csv").read_text(encoding="utf-8").partition("\n")[0]
        assert header.count("lambda_") >= len(solution.compiled.constraints)


def test_the_period_of_the_pendulum_agrees_with_the_elliptic_integral() -> None:
    swing = results("pendulum")["swing"]
    # T = 4 K(sin(θ₀/2)) / ω₀, ω₀² = 3 g / (2 L), θ₀ = 30°; K(m = sin² 15°) = 1.598142002112540
    period = 4 * 1.598142002112540 / np.sqrt(1.5 * 9.81)
    back = swing(period)
    assert back["rod"].angle == pytest.approx(np.radians(-60), abs=1e-5)
    assert back["rod"].omega == pytest.approx(0, abs=1e-4)


def test_the_six_bar_returns_after_a_turn() -> None:
    turns = results("six_bar")["turns"]
    # one radian per radian of the crank; the other bodies come back
    np.testing.assert_allclose(turns(1.0).q[3:], turns.q[0, 3:], atol=1e-7)
    assert turns.q[-1, 2] - turns.q[0, 2] == pytest.approx(4 * np.pi, abs=1e-7)


def test_the_rates_of_windows_agree_with_their_energy(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("sys.argv", ["n_four_bar.py", "2"])
    n_four_bar.main()
    told = capsys.readouterr().out
    assert "2 windows, 15 coordinates" in told
    assert float(told.split("energy: ")[1].split()[0]) < 1e-6


def test_the_yoke_moves_harmonically_and_its_pin_carries_the_inertia() -> None:
    turns = results("scotch_yoke")["turns"]
    speed = 10 * np.pi
    cos, sin = np.cos(speed * turns.t), np.sin(speed * turns.t)
    np.testing.assert_allclose(turns["yoke.x"], 0.08 * cos, atol=1e-11)
    np.testing.assert_allclose(turns["yoke.vx"], -0.08 * speed * sin, atol=1e-9)
    force = -3 * 0.08 * speed**2 * cos
    np.testing.assert_allclose(turns["slot"].force(on="yoke")[:, 0], force, atol=1e-7)
    np.testing.assert_allclose(turns["motor.effort"], force * -0.08 * sin, atol=1e-7)


def test_the_planetary_gear_reaches_the_speed_and_torque_of_its_ratio() -> None:
    run = results("planetary_gear")["speeding_up"]
    np.testing.assert_allclose(run["sun.omega"], 3.6 * run["carrier.omega"], atol=1e-8)
    arm, carrier, planet = 0.036, 1 / 3.6, 1 / 3.6 * (1 - 52 / 16)
    equivalent = 6e-5 + (3e-4 + 0.2 * arm**2) * carrier**2 + 3e-5 * planet**2
    rate = 0.09 * carrier**2 / equivalent
    omega = 0.5 * 3.6**2 / 0.09 * (1 - np.exp(-rate * run.t))
    np.testing.assert_allclose(run["sun.omega"], omega, rtol=1e-6, atol=1e-6)
    assert run["load.torque"][-1] == pytest.approx(-3.6 * 0.5, rel=1e-3)
    tangential = (0.5 - 6e-5 * run["sun.alpha"]) / 0.02
    np.testing.assert_allclose(run["inner"].tangential, tangential, rtol=1e-8)
    np.testing.assert_allclose(run["inner.tangential"], run["inner"].lam[:, 0])


def test_the_shaper_returns_faster_than_it_cuts() -> None:
    cuts = results("quick_return")["cuts"]
    pin = 0.1 * np.exp(2j * np.pi * cuts.t) + 0.25j
    np.testing.assert_allclose(cuts["lever.angle"], np.angle(pin), atol=1e-10)
    # the lever is at its extremes where the crank is normal to it
    alpha = np.arcsin(0.1 / 0.25)
    assert cuts["lever.angle"].max() == pytest.approx(np.pi / 2 + alpha, abs=1e-4)
    fast = np.count_nonzero(cuts["ram.vx"][:-1] > 0) / (len(cuts.t) - 1)
    assert fast == pytest.approx(0.5 - alpha / np.pi, abs=0.02)
