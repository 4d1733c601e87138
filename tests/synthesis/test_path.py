"""Path synthesis and cognates against known four-bars."""

import kempe as kp
import numpy as np
import pytest
from sizes import count
from synthesis.linkages import Complexes, Floats, FourBar, drawn, found_in
from synthesis.test_motion import KNOWN, pins_of


def points(places: Complexes) -> list[tuple[float, float]]:
    return list(zip(places.real.tolist(), places.imag.tolist(), strict=True))


def passes(one: kp.synthesis.Candidate, places: Complexes) -> float:
    """The largest distance of the points from a simulated path, in order along it."""
    case, end = one.case, one.crank_angles
    times = np.abs(end - end[0]) / (2.0 * np.pi)
    assert (np.diff(times) > 0.0).all()
    motion = kp.kinematics(case.model, case.start(), t_end=times[-1], output_step=times[-1] / 20)
    at = motion(times)
    return float(np.abs(at["coupler.P.x"] + 1j * at["coupler.P.y"] - places).max())


def test_five_points_with_crank_angles_have_the_source_among_all_solutions() -> None:
    random = np.random.default_rng(6)
    for _ in range(count(15, 200)):
        bar, crank = drawn(random, 5)
        places, _ = bar.poses(crank)
        size = 10.0 ** random.uniform(-3, 3)
        turned = crank + random.uniform(-3.0, 3.0)
        found = kp.synthesis.path(points(size * places), angles=turned, defects="tell")
        assert found.complete
        assert len(found) <= 12
        scaled = [{k: x / size for k, x in pins_of(one).items()} for one in found]
        assert min(found_in(bar, one) for one in scaled) < 1e-6
        assert max(one.error for one in found) < 1e-8 * max(one.size for one in found)


@pytest.mark.parametrize(("n", "offsets"), [(2, "free"), (3, "fixed"), (4, "free"), (4, "fixed")])
def test_fewer_points_with_crank_angles_are_exact(n: int, offsets: str) -> None:
    random = np.random.default_rng(n)
    for _ in range(count(3, 40)):
        bar, crank = drawn(random, n)
        places, _ = bar.poses(crank)
        found = kp.synthesis.path(points(places), angles=crank, offsets=offsets)
        assert not found.complete
        for one in found[:2]:
            assert passes(one, places) < 1e-7 * one.size
            assert one.crank_angles - one.crank_angles[0] == pytest.approx(
                crank - crank[0], abs=1e-7
            )
            if offsets == "fixed":
                assert np.exp(1j * (one.crank_angles - crank)) == pytest.approx(
                    np.ones(n), abs=1e-7
                )


@pytest.mark.parametrize("n", [2, 3, 4, 5, 6, 7])
def test_points_without_angles_are_exact(n: int) -> None:
    random = np.random.default_rng(20 + n)
    for _ in range(count(1, 10)):
        bar, crank = drawn(random, n)
        places, _ = bar.poses(crank)
        found = kp.synthesis.path(points(places))
        assert not found.complete
        assert found[0].error < 1e-10 * found[0].size
        assert passes(found[0], places) < 1e-6 * found[0].size


def test_a_search_from_starts_finds_nine_points_of_a_four_bar() -> None:
    random = np.random.default_rng(41)
    bar, crank = drawn(random, 9)
    places, _ = bar.poses(crank)
    found = kp.synthesis.path(points(places), starts=160, defects="tell")
    assert not found.complete
    assert found.followed is None
    exact = [one for one in found if one.error < 1e-10 * one.size]
    assert exact
    three = kp.synthesis.cognates(exact[0])
    pivots = [one.pins[0] for one in found]
    for one in three:  # the cognates of a solution are solutions
        assert min(abs(one.pins[0] - at) for at in [*pivots, *(o.pins[3] for o in found)]) < 1e-6


def test_a_curve_of_many_points_is_found_again() -> None:
    crank = np.linspace(0.0, 2.0 * np.pi, 24, endpoint=False)
    places, _ = KNOWN.poses(crank)
    found = kp.synthesis.path(points(places))
    assert found[0].error < 1e-6
    timed = kp.synthesis.path(points(places), angles=crank)
    assert min(found_in(KNOWN, pins_of(one)) for one in timed) < 1e-6
    noise = 1e-3 * np.random.default_rng(0).normal(size=(24, 2)) @ [1.0, 1.0j]
    near = kp.synthesis.path(points(places + noise), angles=crank)
    assert near[0].error < 4.0 * np.abs(noise).max()


def curve(bar: dict[str, complex], crank: Floats, other: float = 1.0) -> Complexes:
    """The point P of a four-bar at crank angles, on the closure of its position or the other."""
    o, a, b, d, p = (bar[name] for name in "OABDP")
    unit = (d - o) / abs(d - o)
    own = FourBar(abs(a - o), abs(b - a), abs(b - d), abs(d - o), (p - a) / (b - a) * abs(b - a))
    side = np.sign((np.conj(d - a) * (b - a)).imag)
    at, _ = own.poses(crank - np.angle(unit), side * other)
    return np.asarray(o + unit * at)


def test_cognates_trace_the_same_curve() -> None:
    random = np.random.default_rng(9)
    for _ in range(count(10, 100)):
        bar, crank = drawn(random, 4)
        size = 10.0 ** random.uniform(-3, 3)
        places, angles = bar.poses(crank)
        task = list(zip(size * places.real, size * places.imag, angles, strict=True))
        pivots = {"O": (0, 0), "D": (size * bar.d, 0)}
        (one,) = kp.synthesis.motion(task[:3], pivots=pivots, defects="tell")
        first, second = kp.synthesis.cognates(one)
        by_pivot = {round(abs(x.pins[3]) / size, 6): x for x in (first, second)}
        at_d = by_pivot[round(bar.d, 6)]
        turned = crank + np.angle(at_d.pins[1] - at_d.pins[0]) - crank[0]
        assert curve(pins_of(at_d), turned) == pytest.approx(size * places, abs=1e-9 * at_d.size)
        at_o = by_pivot[0.0]
        rocker = np.unwrap(bar.rocker(crank))
        turned = rocker + np.angle(at_o.pins[1] - at_o.pins[0]) - rocker[0]
        # its crank may pass a dead point, where the other closure takes over
        apart = [abs(curve(pins_of(at_o), turned, side) - size * places) for side in (1, -1)]
        assert np.min(apart, axis=0).max() < 1e-9 * at_o.size
        assert apart[0][0] < 1e-9 * at_o.size


def test_the_cognate_of_a_case_is_simulated_along_the_same_curve() -> None:
    places, angles = KNOWN.poses(np.array([0.2, 0.7, 1.2]))
    task = list(zip(places.real, places.imag, angles, strict=True))
    (one,) = kp.synthesis.motion(task, pivots={"O": (0, 0), "D": (3, 0)})
    two = kp.synthesis.cognates(one.case)
    assert len(two) == 2
    same = next(other for other in two if other.turns)
    paths = [other.case.run()["motion"] for other in (one, same)]
    x, y = (np.array([path[f"coupler.P.{axis}"] for path in paths]) for axis in "xy")
    assert np.abs(x[0] - x[1]).max() < 1e-9
    assert np.abs(y[0] - y[1]).max() < 1e-9
    with pytest.raises(kp.ModelError, match="not a four-bar"):
        kp.synthesis.cognates(kp.load("examples/pendulum.toml"))


@pytest.mark.parametrize(
    ("given", "options", "message"),
    [
        ([(0, 0)], {}, "at least two"),
        ([(0, 0), (1, 0), (0, 0)], {}, "points 1 and 3 are the same"),
        ([(0, 0), (1, 0)], {"angles": [0.0]}, "1 for 2 points"),
        ([(0, 0), (1, 0)], {"angles": [0.0, 0.0]}, "angle 2 occurs twice"),
        ([(0, 0), (1, 0)], {"offsets": "none"}, "offsets"),
        ([(0, 0), (1, "a")], {}, r"points\[2\]"),
    ],
)
def test_wrong_points_are_explained(given: list, options: dict, message: str) -> None:
    with pytest.raises(kp.ModelError, match=message):
        kp.synthesis.path(given, **options)
