"""Dead points: crank and rod are in line, the slider reverses and the crank continues."""

import kempe as kp
import numpy as np
import pytest
from singular.linkages import Linkage, slider_crank
from singular.one_coordinate import places

GRID = np.arange(501) * 0.01
CASES = {
    "loaded": (slider_crank((1, 3), 0.5, 9.0, stiffness=5.0, damping=0.2), 1e-6),
    "folding to a hair": (slider_crank((1, 1.001), 0.5, 9.0), 1e-4),
}


@pytest.mark.parametrize("name", CASES)
def test_dead_points_are_passed(name: str) -> None:
    linkage, allowed = CASES[name]
    sol = kp.dynamics(linkage.model, linkage.start(), t_end=5, output_step=0.01)
    s = linkage.branch.motion(linkage.s0, linkage.rate, GRID)
    assert s[-1] - s[0] > 5 * np.pi  # five dead points and more
    assert np.abs(places(sol.q) - linkage.branch.places(s)).max() < allowed
    assert np.abs(sol.energy.balance).max() < allowed
    assert sol.drift.position.max() < 1e-10


def test_a_crank_that_the_slider_stops_swings_about_its_dead_point() -> None:
    """Released at rest close to the dead point, from which the spring pushes the crank away."""
    linkage: Linkage = slider_crank((1, 3), 0.02, 0.0, stiffness=200.0)
    sol = kp.dynamics(linkage.model, linkage.start(), t_end=3, output_step=0.01)
    s = linkage.branch.motion(0.02, 0.0, GRID[:301])
    assert np.abs(places(sol.q) - linkage.branch.places(s)).max() < 1e-5
