"""Six-bars for functions and paths against simulated six-bars."""

from pathlib import Path
from typing import Any

import kempe as kp
import numpy as np
import pytest
from sizes import FULL, count
from synthesis.six_bars import LINKS, Complexes, Floats, drawn

FAMILIES = list(LINKS)
#: Points on a closed curve.
TURN = (24, 2.0 * np.pi * 23.0 / 24.0)

#: Fewer than usual, for time.
STARTS = 24


def points(places: Complexes) -> list[tuple[float, float]]:
    return list(zip(places.real.tolist(), places.imag.tolist(), strict=True))


def simulated(one: kp.synthesis.Candidate, name: str) -> Floats:
    """A quantity of a candidate at the positions of its task, by a run of its case."""
    case, angles = one.case, one.crank_angles
    ends = (float(angles[0]), float(angles[-1]))
    assert (np.diff(angles) > 0.0).all() or (np.diff(angles) < 0.0).all()
    sol = kp.kinematics(case.model, case.start(), over="crank.angle", range=ends, n=40)
    return np.asarray(sol(angles)[name])


def passes(one: kp.synthesis.Candidate, places: Complexes) -> float:
    """The largest distance of the simulated point P from points."""
    x, y = (simulated(one, f"coupler.P.{axis}") for axis in "xy")
    return float(abs(x + 1j * y - places).max())


#: Families of the usual tests: those of paths, and those of functions.
PATHS, FUNCTIONS = ["watt_1", "stephenson_2"], ["watt_2", "stephenson_1", "stephenson_3"]


@pytest.mark.parametrize("family", FAMILIES if FULL else PATHS)
def test_the_curve_of_a_six_bar_is_approximated(family: str) -> None:
    for seed in range(count(1, 6)):
        _, _, at = drawn(family, 1 + seed, *TURN)
        size = 10.0 ** (3.0 * np.cos(3.0 + seed + FAMILIES.index(family)))
        places = (at["P"] + 1.0 - 2.0j) * size
        found = kp.synthesis.path(points(places), family, starts=STARTS)
        best, far = found[0], abs(places - places[0]).max()
        assert best.error < 0.01 * far and not best.defects
        assert passes(best, places) == pytest.approx(best.error, abs=1e-9 * best.size)
        assert best.turns and best.case.model.title == best.type


@pytest.mark.parametrize("family", FAMILIES if FULL else FUNCTIONS)
def test_the_function_of_a_six_bar_is_generated(family: str) -> None:
    for n in (3, 4, 5, 8) if FULL else (3 + FUNCTIONS.index(family),):
        six, crank, at = drawn(family, n, n, 1.8)
        arm = six.arm(at)
        pairs = list(zip(crank + 0.4, arm - 1.1, strict=True))
        found = kp.synthesis.function(pairs, family, ground=50.0, samples=STARTS)
        best = found[0]
        assert best.error < (1e-6 if n <= 5 else 1e-3) and not best.defects
        assert best.crank_angles - best.crank_angles[0] == pytest.approx(crank, abs=1e-12)
        gap = np.unwrap(simulated(best, "arm.angle")) - arm
        # the largest error for the best offset is half of the range, for its own at most all
        assert 0.5 * np.ptp(gap) <= best.error + 1e-9
        assert best.error <= np.ptp(gap) + 1e-9
        assert best.points["D"] == pytest.approx((50.0, 0.0), abs=1e-9)


def test_fixed_offsets_are_angles_from_the_x_axis() -> None:
    six, crank, at = drawn("watt_2", 2, 4, 1.8)
    arm = six.arm(at)
    offset = float(np.angle(at["A"][0]))
    found = kp.synthesis.function(
        list(zip(crank + offset, arm, strict=True)), "watt_2", offsets="fixed", samples=STARTS
    )
    best = found[0]
    for name, wanted in (("crank", crank + offset), ("arm", arm)):
        angles = simulated(best, f"{name}.angle")
        gap = abs(np.angle(np.exp(1j * (angles - wanted)))).max()
        assert gap <= best.error + 1e-9 and best.error < 1e-6


def test_crank_angles_of_a_path_are_kept() -> None:
    _, crank, at = drawn("stephenson_3", 4, 6, 2.0)
    found = kp.synthesis.path(points(at["P"]), "stephenson_3", crank + 1.0, starts=STARTS)
    best = found[0]
    assert best.error < 1e-3
    assert best.crank_angles - best.crank_angles[0] == pytest.approx(crank, abs=1e-9)
    assert passes(best, at["P"]) < best.error + 1e-9


@pytest.mark.parametrize("family", ["watt_1", "stephenson_2"] if FULL else ["watt_1"])
def test_prescribed_parts_stay(family: str) -> None:
    _, _, at = drawn(family, 3, *TURN)

    names = ["link", "coupler"][family == "stephenson_2"]
    triangle = {key: (at[key][0].real, at[key][0].imag) for key in "ABC"}
    parts: dict[str, Any] = {names: triangle, "crank": abs(at["A"][0]), "arm": (0.05, 9.0)}
    found = kp.synthesis.path(
        points(at["P"]), family, pivots={"O": (0, 0)}, parts=parts, defects="tell", starts=40
    )
    for one in found[:3]:
        pins = {key: complex(*xy) for key, xy in one.points.items()}
        assert pins["O"] == 0.0
        assert abs(pins["A"]) == pytest.approx(abs(at["A"][0]), rel=1e-12)
        for x, y in ("AB", "BC", "AC"):
            assert abs(pins[x] - pins[y]) == pytest.approx(abs(at[x][0] - at[y][0]), rel=1e-12)
        assert 0.05 <= one.lengths["arm"] <= 9.0
    assert found[0].error < 0.02 * abs(at["P"] - at["P"][0]).max()


def test_limits_exclude_and_are_told() -> None:
    _, _, at = drawn("stephenson_3", 5, *TURN)
    asked: dict[str, Any] = {"transmission_angle": "30 deg", "grashof": True, "direction": "ccw"}
    asked["starts"] = 12
    found = kp.synthesis.path(points(at["P"]), "stephenson_3", **asked)
    assert all(one.turns and one.transmission_angle >= np.radians(30) for one in found)
    assert all(one.crank_angles[-1] > one.crank_angles[0] for one in found)
    told = kp.synthesis.path(points(at["P"]), "stephenson_3", defects="tell", **asked)
    assert len(told) == len(found) + sum(bool(one.defects) for one in told)
    again = kp.synthesis.path(points(at["P"]), "stephenson_3", **asked)
    assert [one.pins for one in again] == [one.pins for one in found]


def test_masses_and_ranks() -> None:
    _, _, at = drawn("watt_1", 1, *TURN)
    found = kp.synthesis.path(
        points(at["P"]), "watt_1", starts=12, masses={"arm": 0.25}, defects="tell"
    )
    assert found[0].case.model.bodies["arm"].mass == 0.25
    kept = [one for one in found if not one.defects]
    values = found.ranked("drive.effort.peak").values("drive.effort.peak")
    finite = [x for x in values if np.isfinite(x)]
    assert len(finite) >= len(kept) and finite == sorted(finite)
    assert found.text().count("Watt I") == len(found)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"family": "watt_3"}, "family.*'watt_1'.*'stephenson_3'"),
        ({"parts": {"elbow": 1}}, "elbow.*crank, link, rocker, coupler, arm"),
        ({"parts": {"crank": -1}}, r"parts\.crank.*> 0"),
        ({"parts": {"crank": (2, 1)}}, "least length first"),
        ({"parts": {"link": {"A": (0, 0)}}}, r"parts\.link.*its points are A, B, C"),
        ({"parts": {"link": dict.fromkeys("ABC", (0, 0))}}, "A and B are the same; move"),
        ({"pivots": {"G": (0, 0)}}, "'G'; must be one of O, D"),
        ({"pivots": {"O": (9, 0)}, "within": [(0, 1), (0, 1)]}, "outside 'within'; move it"),
        ({"grashof": "crank-rocker"}, "types are those of four-bars"),
        ({"masses": {"slider": 1}}, "'slider'; must be crank, link, rocker, coupler or arm"),
        (
            {
                "parts": dict.fromkeys(["crank", "link", "rocker"], 1e-3),
                "pivots": {"O": (0, 0), "D": (9, 9)},
            },
            "leave parts or pivots free",
        ),
    ],
)
def test_wrong_arguments_are_explained(options: dict[str, Any], message: str) -> None:
    places = [(0, 0), (1, 0), (1, 1), (0.5, 1.4), (0, 1)]
    with pytest.raises(kp.ModelError, match=message):
        kp.synthesis.path(places, **{"family": "watt_1", "starts": 8, **options})


def test_wrong_tasks_are_explained() -> None:
    with pytest.raises(kp.ModelError, match="points 1 and 3 are the same; leave one of them out"):
        kp.synthesis.path([(0, 0), (1, 0), (0, 0)], "watt_1")
    with pytest.raises(kp.ModelError, match="at least two"):
        kp.synthesis.path([(0, 0)], "watt_1")
    with pytest.raises(kp.ModelError, match="choose such a family"):
        kp.synthesis.path([(0, 0), (1, 0)], parts={"crank": 1})
    with pytest.raises(kp.ModelError, match="pairs 1 and 2 have the same crank angle"):
        kp.synthesis.function([(0, 1), (0, 2)], "watt_2")
    with pytest.raises(kp.ModelError, match="family"):
        kp.synthesis.motion([(0, 0, 0), (1, 0, 1)], "watt_1")
    six = kp.synthesis.function([(0, 0), (0.5, 0.3)], "watt_2", samples=8, defects="tell")[0]
    with pytest.raises(kp.ModelError, match="Watt II has no cognates"):
        kp.synthesis.cognates(six)


def test_a_foot_of_jansens_leg_walks_by_six_bars() -> None:
    """Theo Jansen's numbers, The Great Pretender, 2007; a four-bar leaves 5 % of the step."""
    leg = kp.load(Path(__file__).parents[2] / "examples" / "jansen_leg.toml")
    ends = (0.0, 2.0 * np.pi)
    sol = kp.kinematics(leg.model, leg.start(), over="crank.angle", range=ends, n=37)
    foot = (sol["foot.F.x"] + 1j * sol["foot.F.y"])[:-1]
    step = np.ptp(foot.real)
    for family, part in (
        {"stephenson_2": 0.02, "stephenson_3": 0.01}.items() if FULL else [("stephenson_2", 0.02)]
    ):
        best = kp.synthesis.path(points(foot), family)[0]
        assert best.turns and not best.defects
        assert passes(best, foot) < part * step
