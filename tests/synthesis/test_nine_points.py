"""All four-bars through nine points, and four-bars through eight."""

import kempe as kp
import numpy as np
import pytest
from kempe import _core
from kempe.synthesis import nine
from sizes import count, only_full
from synthesis.linkages import Complexes, drawn
from synthesis.test_motion import pins_of
from synthesis.test_path import curve, points

#: The points of FourBarLinkages.jl (Breiding, Eckhardt & Timme 2019).
EXAMPLE = [
    (0.8961867, -0.09802917),
    (1.2156535, -1.18749100),
    (1.5151435, -0.85449808),
    (1.6754775, -0.48768058),
    (1.7138690, -0.30099232),
    (1.7215236, 0.03269953),
    (1.6642029, 0.33241088),
    (1.4984171, 0.74435576),
    (1.3011834, 0.92153806),
]


def off(one: kp.synthesis.Candidate, places: Complexes) -> float:
    """The largest distance of the points from the curve, on the nearer closure of each.

    Near a dead point, it is the root of rounding errors.
    """
    both = [abs(curve(pins_of(one), one.crank_angles, side) - places) for side in (1.0, -1.0)]
    return float(np.min(both, axis=0).max())


def test_the_source_of_nine_points_and_its_cognates_are_among_all_four_bars() -> None:
    random = np.random.default_rng(41)
    for _ in range(count(1, 10)):
        bar, crank = drawn(random, 9)
        places, _ = bar.poses(crank)
        found = kp.synthesis.path(points(places), defects="tell")
        followed = found.followed
        assert followed is not None
        assert (followed.paths, followed.found) == (1442, 1442)
        assert found.complete
        assert len(found) == 3 * followed.real
        assert max(one.error / one.size for one in found) < 1e-10
        assert max(off(one, places) / one.size for one in found) < 1e-7
        # both pivots of the source, and the third one of its cognates
        share = bar.point / bar.b
        three = np.array([0.0, bar.d, share * bar.d])
        pivots = np.array([[one.pins[0], one.pins[3]] for one in found])
        near = abs(pivots[:, :, None] - three).min(axis=2).max(axis=1) < 1e-6 * abs(three).max()
        assert near.sum() == 3


def test_four_bars_through_eight_points_pass_them() -> None:
    random = np.random.default_rng(803)
    bar, crank = drawn(random, 8)
    places, _ = bar.poses(crank)
    bars = nine.through_eight(places, None)[0]
    assert bars is not None
    for pins, pivot in ((bars.a, bars.o), (bars.b, bars.d)):
        arms = abs(pins - pivot[:, None])
        assert (np.ptp(arms, axis=1) < 1e-10 * (arms[:, 0] + abs(bars.o - bars.d))).all()
    assert bars.p == pytest.approx(np.tile(places, (len(bars.o), 1)), abs=1e-12)


@only_full
def test_a_public_example_has_all_solutions() -> None:
    found = kp.synthesis.path(EXAMPLE, defects="tell")
    assert found.followed is not None
    assert (found.followed.found, found.followed.real) == (1442, 21)
    assert len(found) == 63
    assert "1442 of 1442" in repr(found)
    places = np.array(EXAMPLE) @ [1.0, 1.0j]
    assert max(off(one, places) / one.size for one in found) < 1e-7


@only_full
def test_special_points_are_not_complete() -> None:
    angles = np.linspace(-2.0, 2.0, 9)
    found = kp.synthesis.path(points(np.cos(angles) + 0.5j * np.sin(angles)), defects="tell")
    assert found.followed is not None
    assert not found.complete
    assert 0 < found.followed.real <= found.followed.found < found.followed.paths
    assert found.followed.again == 0
    assert max(one.error / one.size for one in found) < 1e-10


def test_a_case_with_a_choice_has_the_candidates_of_the_studio() -> None:
    random = np.random.default_rng(41)
    bar, crank = drawn(random, 9)
    task = {"task": "path", "points": points(bar.poses(crank)[0]), "defects": "tell"}
    chosen = kp.synthesis.from_case(kp.Case(kp.Model(), synthesis={**task, "choice": 1}))
    assert chosen.followed is None
    assert not chosen.complete
    assert chosen[0].error < 1e-10 * chosen[0].size


def test_a_wrong_start_is_refused() -> None:
    with pytest.raises(ValueError, match="nine places"):
        _core.nine_point_four_bars(EXAMPLE, b"", None)


def test_the_stored_solutions_are_small() -> None:
    """They are in every wheel and source distribution."""
    assert 0 < nine._START.stat().st_size <= 100_000
