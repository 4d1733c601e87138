"""Curves of many points: found again from their shape alone, by four-bars of their closed form."""

import time

import kempe as kp
import numpy as np
import pytest
from quiet import within
from sizes import count
from synthesis.linkages import Complexes, Floats, FourBar
from synthesis.test_motion import KNOWN, pins_of
from synthesis.test_path import curve, points

#: Points of a curve that is drawn by hand.
N = 36


def even(places: Complexes, closed: bool, n: int = N) -> Complexes:
    """Points at equal distances along a line."""
    line = np.append(places, places[0]) if closed else places
    far = np.append(0.0, np.cumsum(abs(np.diff(line))))
    at = np.linspace(0.0, far[-1], n, endpoint=not closed)
    return np.asarray(np.interp(at, far, line.real) + 1j * np.interp(at, far, line.imag))


def full(random: np.random.Generator) -> FourBar:
    """A four-bar whose crank turns fully, not near the limit of Grashof's condition."""
    while True:
        a, b, c, d = random.uniform(0.3, 3.0, 4)
        ordered = sorted([a, b, c, d])
        grashof = ordered[0] + ordered[3] < 0.95 * (ordered[1] + ordered[2])
        if grashof and ordered[0] in (a, d):
            return FourBar(a, b, c, d, complex(*random.normal(size=2) * 0.8 * b))


def drawn_curve(random: np.random.Generator, closed: bool) -> Complexes:
    """The path of a random four-bar or a part of it, in any place, direction and size."""
    bar = full(random)
    places, _ = bar.poses(np.linspace(0.0, 2.0 * np.pi, 4000, endpoint=False))
    if not closed:
        begin, length = random.integers(4000), int(4000 * random.uniform(0.25, 0.8))
        places = np.roll(places, -begin)[:length]
    if random.random() < 0.5:
        places = places[::-1]
    size, turn = 10.0 ** random.uniform(-3, 3), random.uniform(0.0, 6.0)
    return np.asarray(size * np.exp(1j * turn) * (even(places, closed) + 3.0))


@pytest.mark.parametrize("closed", [True, False])
def test_drawn_curves_are_found_again(closed: bool) -> None:
    random = np.random.default_rng(5 + closed)
    found = []
    for _ in range(count(6, 100)):
        places = drawn_curve(random, closed)
        size = float(abs(places - places.mean()).max())
        best = kp.synthesis.path(points(places), defects="tell")
        found.append(min(one.error for one in best) / size)
    # points between those of the fine line are off it by 1e-6 or less
    assert np.mean(np.array(found) < 2e-3) >= 0.8, found


def distance(one: kp.synthesis.Candidate, places: Complexes) -> float:
    """The largest distance of points from the whole path of a candidate, by its closed form."""
    crank = np.linspace(0.0, 2.0 * np.pi, 20_000)
    both = [curve(pins_of(one), crank, side) for side in (1.0, -1.0)]
    path = np.concatenate(both)
    return float(max(np.nanmin(abs(path - at)) for at in places))


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e3])
def test_the_error_is_the_distance_from_the_path(size: float) -> None:
    random = np.random.default_rng(3)
    crank = np.linspace(0.2, 4.0, 30)
    noise = 0.01 * (random.normal(size=30) + 1j * random.normal(size=30))
    places = size * (KNOWN.poses(crank)[0] + noise)
    found = kp.synthesis.path(points(places))
    for one in found[:4]:
        # the positions of the least squares are those nearest to the points, nearly
        assert distance(one, places) <= one.error * (1.0 + 1e-9) + 1e-6 * size
        assert one.error < 1.2 * distance(one, places) + 1e-4 * size
    assert found[0].error < 2.0 * size * float(abs(noise).max())


def test_sizes_and_places_do_not_matter() -> None:
    random = np.random.default_rng(8)
    places = even(KNOWN.poses(np.linspace(0.0, 5.0, 400))[0], closed=False)
    places = places + 0.01 * (random.normal(size=N) + 1j * random.normal(size=N))
    first = kp.synthesis.path(points(places))
    for by in (2.0**-10, 2.0**10):  # powers of two change no digit
        other = kp.synthesis.path(points(by * places))
        assert [one.error for one in other] == [by * one.error for one in first]
    for by, to in [(1e-3, 0.0), (1e3 * np.exp(0.7j), 2e3 - 5e3j)]:
        other = kp.synthesis.path(points(by * places + to))
        # the search ends where a step improves the sum of squares by less than 1e-9 of it
        assert other[0].error == pytest.approx(abs(by) * first[0].error, rel=1e-3)
        assert list(other[0].lengths.values()) == pytest.approx(
            [abs(by) * x for x in first[0].lengths.values()], rel=1e-2
        )


def test_more_starts_only_add_to_what_is_found() -> None:
    random = np.random.default_rng(2)
    places = even(KNOWN.poses(np.linspace(0.0, 5.0, 400))[0], closed=False)
    places = places + 0.02 * (random.normal(size=N) + 1j * random.normal(size=N))
    errors = [
        min(one.error for one in kp.synthesis.path(points(places), starts=k, defects="tell"))
        for k in (1, 4, 16, 60)
    ]
    assert errors == sorted(errors, reverse=True)
    again = kp.synthesis.path(points(places), defects="tell")
    assert min(one.error for one in again) == errors[-1]


def test_the_candidates_of_a_curve_contain_cognates() -> None:
    places, _ = KNOWN.poses(np.linspace(0.0, 2.0 * np.pi, 48, endpoint=False))
    found = kp.synthesis.path(points(places), defects="tell")
    best = found[0]
    for other in kp.synthesis.cognates(best):
        apart = [
            min(
                abs(one.pins[0] - other.pins[i]) + abs(one.pins[3] - other.pins[3 - i])
                for i in (0, 3)
            )
            for one in found
        ]
        assert min(apart) < 1e-6 * best.size


@pytest.mark.alone
def test_a_curve_of_many_points_takes_less_than_a_second() -> None:
    crank: Floats = np.linspace(0.0, 2.0 * np.pi, 60, endpoint=False)
    noise = np.random.default_rng(0).normal(size=(60, 2)) @ [0.01, 0.01j]
    places = KNOWN.poses(crank)[0] + noise

    def seconds() -> float:
        begin = time.process_time()
        kp.synthesis.path(points(places))
        return time.process_time() - begin

    assert within(1.0, seconds)


def test_a_straight_line_has_four_bars() -> None:
    """An open line of 24 points, which no four-bar passes exactly (Watt, Chebyshev)."""
    x = np.linspace(-0.2, 0.2, 24)
    found = kp.synthesis.path(points(x + 0j))
    assert found[0].error < 2e-4
    full_turns = [one for one in found if one.turns]
    assert min(one.error for one in full_turns) < 1e-3


def test_a_curve_may_cross_itself() -> None:
    crank = np.linspace(0.0, 2.0 * np.pi, N, endpoint=False)
    eight = np.sin(crank) + 0.5j * np.sin(2.0 * crank)
    assert abs(eight[0] - eight[N // 2]) < 1e-12
    assert kp.synthesis.path(points(eight))[0].error < 0.15


def test_no_two_candidates_are_nearly_the_same() -> None:
    random = np.random.default_rng(0)
    places = even(KNOWN.poses(np.linspace(0.0, 2.0 * np.pi, 400)[:-1])[0], closed=True)
    places = places + 0.01 * (random.normal(size=N) + 1j * random.normal(size=N))
    found = kp.synthesis.path(points(places))
    assert found[0].turns
    assert not found[0].defects
    pins = np.array([one.pins[:4] for one in found])
    for k, own in enumerate(pins):
        for other in pins[:k]:
            apart = min(abs(own - other).max(), abs(own - other[::-1]).max())
            assert apart > 0.02 * abs(own - own.mean()).max()


def test_wrong_starts_are_refused() -> None:
    with pytest.raises(kp.ModelError, match="at least one"):
        kp.synthesis.path([(0, 0), (1, 0), (2, 1)], starts=0)
