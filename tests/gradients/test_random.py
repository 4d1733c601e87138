"""Slopes of random mechanisms against extrapolated differences of runs."""

import warnings

import kempe as kp
import numpy as np
import pytest
from gradients.mechanisms import Random
from kempe.base.arrays import Floats
from sizes import count

#: Relative changes of a variable; their differences are extrapolated to order six.
STEPS = (1e-3, 2e-3, 4e-3)
#: Largest error of a slope, as a part of its scale.
MOST = 1e-6


def differences(
    case: kp.Case, g: kp.Gradient, steps: tuple[float, ...] = STEPS
) -> tuple[Floats, Floats]:
    """The slopes from runs beside the case, and how far the last extrapolation changed them."""
    found = np.full((2, *g.jacobian.shape), np.nan)
    for of, (name, x) in enumerate(g.variables.items()):
        size = abs(x) or 1.0
        levels = [x + sign * step * size for step in steps for sign in (-1.0, 1.0)]
        held = {other: [value] * len(levels) for other, value in g.variables.items()}
        swept = kp.sweep(case, {**held, name: levels}, list(g.measures), design="paired")
        for k, measure in enumerate(g.measures):
            below, above = swept[measure][::2], swept[measure][1::2]
            first = (above - below) / (2.0 * np.array(steps) * size)
            second = (4.0 * first[:-1] - first[1:]) / 3.0
            found[0, k, of] = (16.0 * second[0] - second[1]) / 15.0
            found[1, k, of] = abs(found[0, k, of] - second[0])
    return found[0], found[1]


def scales(g: kp.Gradient) -> Floats:
    """The size that a slope can have: of the measure and its largest change, by the variable."""
    values = np.abs(list(g.measures.values()))[:, None]
    given = np.array([abs(x) or 1.0 for x in g.variables.values()])
    changes = np.nanmax(np.abs(g.jacobian) * given, axis=1, keepdims=True, initial=0.0)
    return np.asarray((values + changes) / given)


@pytest.mark.parametrize("seed", range(count(30, 300)))
def test_slopes_of_a_random_mechanism(seed: int) -> None:
    made = Random(seed)
    case = made.case()
    measures, variables = made.request()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        g = kp.gradient(case, measures, variables)
        true, doubt = differences(case, g)
    remarked = np.isnan(g.jacobian)
    assert remarked.sum() == len(g.remarks)
    error = np.abs(g.jacobian - true) / scales(g)
    # where differences do not settle, they say nothing; a random draw has few of them
    settled = doubt < MOST * scales(g)
    wrong = ~remarked & settled & ~(error < MOST)
    told = [
        f"{measures[k]} over {variables[of]}: {g.jacobian[k, of]:.10g}, runs {true[k, of]:.10g}"
        for k, of in np.argwhere(wrong).tolist()
    ]
    assert not told
    assert (remarked | settled).mean() > 0.5
