"""Arrays are lists of names and numbers, and an empty one is as good as none."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import kempe as kp
import numpy as np
import pytest

CASE = kp.load(Path(__file__).parents[2] / "examples" / "pendulum.toml")
NONE = np.array([])
MEASURES, NAMES = ["rod.angle.final", "pin.force.max"], ["L"]
LEVELS = {"L": [0.5, 0.6]}


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: kp.sweep(CASE, LEVELS, NONE), "sweep: no measures"),
        (lambda: kp.gradient(CASE, NONE, NAMES), "gradient: no measures"),
        (lambda: kp.gradient(CASE, MEASURES, NONE), "gradient: no variables"),
        (lambda: kp.optimize(CASE, NONE, minimize="pin.force.max"), "optimize: no variables"),
    ],
)
def test_an_empty_array_is_told(call: Callable[[], Any], message: str) -> None:
    with pytest.raises(kp.ModelError) as caught:
        call()
    assert str(caught.value).startswith(message)


def test_arrays_give_what_lists_give() -> None:
    lists = kp.sweep(CASE, LEVELS, MEASURES)
    arrays = kp.sweep(CASE, {"L": np.array(LEVELS["L"])}, np.array(MEASURES))
    np.testing.assert_array_equal(arrays["pin.force.max"], lists["pin.force.max"])
    slopes = kp.gradient(CASE, np.array(MEASURES), np.array(NAMES))
    np.testing.assert_array_equal(slopes.jacobian, kp.gradient(CASE, MEASURES, NAMES).jacobian)
    asked = {"minimize": "rod.angle.final^2", "subject_to": NONE}
    ends = kp.optimize(CASE, {"L": np.array([0.5, 0.6])}, **asked)
    assert ends.values == kp.optimize(CASE, {"L": (0.5, 0.6)}, minimize=asked["minimize"]).values
