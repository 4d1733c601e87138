"""Settling times of functions whose entry into the band is known."""

import math

import numpy as np
import pytest
from kempe.results.settling import Settling, settling


def test_a_decay_enters_the_band_where_it_does_between_the_outputs() -> None:
    """e^(-2t) - f is 0.005 (1 - f) with the final value f = e^(-20)."""
    final = math.exp(-20.0)
    entry = -math.log(0.005 * (1.0 - final) + final) / 2.0
    t = np.linspace(0.0, 10.0, 41)  # the entry at 2.649 s is between 2.5 and 2.75 s
    values = np.exp(-2.0 * t)
    assert settling(t, values) == Settling(moves=True, time=2.75)
    found = settling(t, values, between=lambda at: np.exp(-2.0 * at))
    assert found.time == pytest.approx(entry, abs=1e-10)
    shifted = settling(t + 3.0, 5.0 - values, between=lambda at: 5.0 - np.exp(-2.0 * (at - 3.0)))
    assert shifted.time == pytest.approx(3.0 + entry, abs=1e-10)


def test_the_last_entry_counts() -> None:
    """A ramp through the band and back into it: |1.25 - t| is 0.005 · 1.25 at 1.25625 s."""
    t = np.array([0.0, 1.0, 1.5, 2.0, 5.0])

    def path(at: np.ndarray) -> np.ndarray:
        return np.where(at < 1.25, at - 1.25, np.maximum(0.0, 0.05 - np.abs(at - 1.3)))

    # From 1.25 s up to 0.05 at 1.3 s and down: it is 0.00625 at 1.34375 s for the last time.
    found = settling(t, path(t), between=path)
    assert found.time == pytest.approx(1.34375, abs=1e-9)


@pytest.mark.parametrize(
    ("inside", "end", "time"),
    [(9.05, 10.0, None), (8.95, 10.0, 8.95), (-8.95, -10.0, -8.95), (-9.05, -10.0, None)],
)
def test_a_settled_motion_is_quiet_for_a_tenth_of_the_time(
    inside: float, end: float, time: float | None
) -> None:
    t = np.array([0.0, inside, end])
    assert settling(t, np.array([1.0, 0.0, 0.0])) == Settling(moves=True, time=time)


def test_noise_does_not_move() -> None:
    t = np.array([0.0, 1.0, 2.0, 3.0])
    still = Settling(moves=False, time=None)
    for size, noise in ((1e-12, None), (1e-9, 1e-9), (0.0, None)):
        assert settling(t, np.array([size, 0, 0, 0]), noise=noise) == still
    assert settling(t, np.array([1.1e-12, 0, 0, 0])).time == 1.0
    assert settling(t, np.array([1.1e-9, 0, 0, 0]), noise=1e-9).time == 1.0
    # Relative to the largest value: 1e-12 of 1000.
    assert settling(t, 1000.0 + np.array([0.9e-9, 0, 0, 0])) == still
    assert settling(t, -1000.0 + np.array([2e-9, 0, 0, 0])).moves
    # The band is 0.5 % of the largest deviation.
    assert settling(t, np.array([1.0, 0.0049, 0, 0])).time == 1.0
    assert settling(t, np.array([-1.0, 0.0051, 0, 0])).time == 2.0
