"""Units of the numbers of a task, and candidates that do not exist."""

from collections.abc import Callable
from typing import Any

import kempe as kp
import pytest

POSES = [(0, 0, 0), (1, 0.5, "30 deg"), (2, 0, "60 deg")]
synthesis = kp.synthesis


@pytest.mark.parametrize(
    ("solve", "message"),
    [
        (lambda: synthesis.motion([(0, 0, "10 m"), *POSES[1:]]), r"poses\[1\]: '10 m' is in m"),
        (lambda: synthesis.motion([("1 deg", 0, 0), *POSES[1:]]), r"poses\[1\]: '1 deg' is in rad"),
        (lambda: synthesis.path([(0, 0), ("3 s", 1)]), r"points\[2\]: '3 s' is in s; must be in m"),
        (
            lambda: synthesis.path([(0, 0), (3, 1)], angles=["1 m", "2 m"]),
            r"angles\[1\]: '1 m' is in m; must be an angle",
        ),
        (
            lambda: synthesis.function([("10 m", "35 deg"), ("20 deg", "50 deg")]),
            r"pairs\[1\]: '10 m' is in m; must be an angle",
        ),
        (
            lambda: synthesis.motion(POSES, transmission_angle="4 m"),
            r"transmission_angle: '4 m' is in m",
        ),
        (lambda: synthesis.motion(POSES, masses={"crank": "1 m"}), r"masses.crank: '1 m' is in m"),
        (lambda: synthesis.motion(POSES, pivots={"O": ("1 N", 0)}), "is in N; must be in m"),
    ],
)
def test_a_number_has_the_unit_of_its_place(solve: Callable[[], Any], message: str) -> None:
    with pytest.raises(kp.ModelError, match=message):
        solve()


def test_units_are_converted() -> None:
    one = synthesis.path([("10 mm", "5 mm"), ("20 mm", "9 mm")], defects="tell")
    other = synthesis.path([(0.01, 0.005), (0.02, 0.009)], defects="tell")
    assert one[0].points == other[0].points


def test_a_candidate_that_does_not_exist_is_an_error_with_the_counts() -> None:
    found = synthesis.motion(POSES, transmission_angle="89.9 deg")
    assert len(found) == 0
    with pytest.raises(IndexError, match=r"no candidate 0 in <Found: 0 candidates; excluded: "):
        found[0]
