"""Every example loads, assembles and runs, with a small error."""

from pathlib import Path

import kempe as kp
import numpy as np
import pytest
from house.places import ROOT

from examples import n_four_bar

EXAMPLES = sorted((ROOT / "examples").glob("*.toml"))


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_an_example_runs(path: Path) -> None:
    for solution in kp.load(path).run().values():
        assert solution.success
        assert solution.drift.position.max() < 1e-6
        assert np.abs(solution.energy.balance).max() < 1e-5


def test_the_period_of_the_pendulum_agrees_with_the_elliptic_integral() -> None:
    swing = kp.load(ROOT / "examples/pendulum.toml").run()["swing"]
    # T = 4 K(sin(θ₀/2)) / ω₀, ω₀² = 3 g / (2 L), θ₀ = 30°; K(m = sin² 15°) = 1.598142002112540
    period = 4 * 1.598142002112540 / np.sqrt(1.5 * 9.81)
    back = swing(period)
    assert back["rod"].angle == pytest.approx(np.radians(-60), abs=1e-5)
    assert back["rod"].omega == pytest.approx(0, abs=1e-4)


def test_the_six_bar_returns_after_a_turn() -> None:
    turns = kp.load(ROOT / "examples/six_bar.toml").run()["turns"]
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
