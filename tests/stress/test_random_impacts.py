"""Impacts, rest, sticking and sliding of random mechanisms."""

import pytest
from sizes import FULL, count
from stress.random_impacts import outcome
from stress.random_stops import BEYOND, deepest


@pytest.mark.parametrize("seed", range(count(18, 36)))
def test_a_random_mechanism(seed: int) -> None:
    assert not outcome(seed).faults


#: Upper limits, flights shorter than a step, loads that are rounding errors, friction exactly at
#: its limit, a rest between a stop and friction, elastic bounces that are damped.
DIFFICULT = (
    107,
    322,
    438,
    441,
    509,
    632,
    652,
    659,
    823,
    911,
    920,
    985,
    1032,
    1071,
    1233,
    1333,
    1357,
    1478,
    1482,
    1745,
    1770,
    1826,
    1870,
    1939,
    1941,
    1959,
    2505,
    4653,
    4725,
    4733,
    5794,
    5899,
    8052,
    9706,
    11817,
)


#: Those that take seconds.
LONG = {322, 1357, 1478, 1939, 1959, 4653, 5899}


@pytest.mark.parametrize("seed", [one for one in DIFFICULT if FULL or one not in LONG])
def test_a_difficult_mechanism(seed: int) -> None:
    assert not outcome(seed).faults


@pytest.mark.parametrize("seed", range(count(6, 12)))
def test_a_random_chain(seed: int) -> None:
    assert not outcome(seed, "chain").faults


@pytest.mark.parametrize("seed", [0, 1, 2, 4, 5])
def test_no_stop_is_missed(seed: int) -> None:
    depth, impacts = deepest(seed)
    assert impacts > 0
    assert depth < BEYOND
