"""Motion synthesis against known four-bars, an independent elimination and continuation."""

import itertools

import kempe as kp
import numpy as np
import pytest
from kempe import _core
from sizes import count
from synthesis.linkages import Complexes, Floats, FourBar, drawn, found_in, rows

KNOWN = FourBar(1.0, 2.6, 2.2, 3.0, 1.1 + 0.9j)
CRANK = np.array([0.2, 0.7, 1.2, 1.8, 2.4])


def pins_of(one: kp.synthesis.Candidate) -> dict[str, complex]:
    return {name: complex(*at) for name, at in one.points.items()}


def test_five_poses_of_a_known_four_bar_have_four_dyads_and_six_four_bars() -> None:
    places, angles = KNOWN.poses(CRANK)
    found = kp.synthesis.dyads(rows(places, angles))
    in_frame = sorted(((w - places[0]) * np.exp(-1j * angles[0]), g) for w, g in found)
    in_frame.sort(key=lambda pair: abs(pair[0]))
    assert len(found) == 4
    wanted = [-1.1 - 0.9j, 1.5 - 0.9j, 6.664 - 10.730j, -37.745 + 355.654j]
    wanted.sort(key=abs)
    assert [w for w, _ in in_frame] == pytest.approx(wanted, abs=1e-3)
    assert in_frame[0][0] == pytest.approx(-1.1 - 0.9j, abs=1e-12)
    assert in_frame[0][1] == pytest.approx(0.0, abs=1e-12)
    assert in_frame[1][1] == pytest.approx(3.0, abs=1e-12)
    bars = kp.synthesis.motion(rows(places, angles), defects="tell")
    assert len(bars) == 6
    assert bars.complete
    assert min(found_in(KNOWN, pins_of(one)) for one in bars) < 1e-12


def eliminated(places: Complexes, angles: Floats) -> int | None:
    """The number of real dyads by another elimination; None if a pair of roots nearly coincides.

    The pin and the pivot are linear functions of u + i v = ḡ w; both definitions are conics.
    """
    p = (places[1:] - places[0]) / abs(places - places[0]).max()
    turn = np.exp(1j * (angles[1:] - angles[0]))
    q = np.conj(p) * turn
    matrix = np.column_stack([q.real, -q.imag, -p.real, -p.imag])
    right = np.column_stack([-(abs(p) ** 2) / 2, turn.real - 1.0, -turn.imag])
    w1, w2, g1, g2 = np.linalg.solve(matrix, right)  # each: 1, u, v

    def times(x: Floats, y: Floats) -> Floats:
        return np.outer(x, y) + np.outer(y, x)

    first, second = times(g1, w1) + times(g2, w2), times(g1, w2) - times(g2, w1)
    first[0, 1] -= 1.0
    first[1, 0] -= 1.0
    second[0, 2] -= 1.0
    second[2, 0] -= 1.0

    def in_u(form: Floats) -> list[np.polynomial.Polynomial]:
        poly = np.polynomial.Polynomial
        return [
            poly([form[1, 1]]),
            poly([2 * form[0, 1], 2 * form[1, 2]]),
            poly([form[0, 0], 2 * form[0, 2], form[2, 2]]),
        ]

    (a, b, c), (d, e, f) = in_u(first), in_u(second)
    roots = ((a * f - d * c) ** 2 - (a * e - d * b) * (b * f - e * c)).roots()
    size = abs(roots) + 1e-3
    if min(abs(x - y) / (abs(x) + abs(y)) for x, y in itertools.combinations(roots, 2)) < 1e-4:
        return None
    return int((abs(roots.imag) < 1e-9 * size).sum())


def test_the_number_of_dyads_is_that_of_another_elimination() -> None:
    random, seen = np.random.default_rng(5), [0, 0, 0, 0, 0]
    for _ in range(count(100, 1000)):
        size = 10.0 ** random.uniform(-3, 3)
        places = size * (random.normal(size=5) + 1j * random.normal(size=5))
        angles = random.uniform(-np.pi, np.pi, 5)
        wanted = eliminated(places, angles)
        if wanted is None:
            continue
        found = kp.synthesis.dyads(rows(places, angles))
        assert len(found) == wanted
        seen[wanted] += 1
        for w, g in found:
            pins = places + (w - places[0]) * np.exp(1j * (angles - angles[0]))
            length = abs(pins - g)
            assert np.ptp(length) < 1e-9 * max(size, length.max())
    assert seen[0] and seen[2] and seen[4]


@pytest.mark.parametrize("n", [3, 4, 5])
def test_a_four_bar_is_found_from_its_own_poses(n: int) -> None:
    """Five poses give the four-bar itself, fewer ones an exact one without a defect."""
    random = np.random.default_rng(n)
    for _ in range(count(15, 200)):
        bar, crank = drawn(random, n)
        size = 10.0 ** random.uniform(-3, 3)
        places, angles = bar.poses(crank)
        task = rows(size * places, angles)
        found = kp.synthesis.motion(task)
        assert len(found)
        best = found[0]
        assert best.error < 1e-9 * best.size
        assert not best.defects
        assert found.complete == (n == 5)
        if n == 5:
            pins = [{k: x / size for k, x in pins_of(one).items()} for one in found]
            assert min(found_in(bar, one) for one in pins) < 1e-6
        takes(best, size * places, angles)


def takes(one: kp.synthesis.Candidate, places: Complexes, angles: Floats) -> None:
    """A simulation of the candidate reaches all poses in order."""
    end = one.crank_angles
    rate = 1.0 if end[-1] > end[0] else -1.0
    case = one.case
    start = case.start()
    q = start["coupler.P.x"] + 1j * start["coupler.P.y"], start["coupler.angle"]
    assert abs(q[0] - places[0]) < 1e-8 * one.size
    times = rate * (end - end[0]) / (2.0 * np.pi)
    assert np.all(np.diff(times) > 0.0)
    motion = kp.kinematics(case.model, start, t_end=float(times[-1]), output_step=times[-1] / 50)
    at = motion(times)
    apart = at["coupler.P.x"] + 1j * at["coupler.P.y"] - places
    assert np.abs(apart).max() < 1e-6 * one.size
    assert np.abs(np.exp(1j * (at["coupler.angle"] - angles)) - 1.0).max() < 1e-6


def traced(o: complex, a: Complexes, b: Complexes, d: complex) -> str:
    """The defect of a four-bar by continuation along its circuit; empty if it has none.

    ``a`` and ``b`` are the pins of crank and rocker at the positions.
    """
    unit, turn = abs(d - o), np.angle(d - o)
    bar = FourBar(abs(a[0] - o) / unit, abs(b - a)[0] / unit, abs(b[0] - d) / unit, 1.0, 0j)
    at = np.column_stack([np.angle(a - o), np.angle(b - a), np.angle(b - d)]) - turn
    path = bar.circuit(at[0])
    apart = np.linalg.norm(np.exp(1j * at)[:, None] - np.exp(1j * path)[None], axis=2)
    if (apart.min(axis=1) > 0.03).any():
        return "circuit"
    place = apart[:, :-1].argmin(axis=1)
    turning = np.sign(np.diff(path[:, 0]))
    changes = np.flatnonzero(turning != np.roll(turning, 1))
    if len(changes):  # parts of the circuit between dead points, one of them over its end
        part = np.searchsorted(changes, place, side="right") % len(changes)
        if (part != part[0]).any():
            return "branch"
        steps = np.diff((place - changes[part - 1]) % len(turning))
        return "" if (steps > 0).all() or (steps < 0).all() else "order"
    around = np.diff(place) % len(turning)
    back = -np.diff(place) % len(turning)
    return "" if min(around.sum(), back.sum()) < len(turning) else "order"


def test_defects_are_those_of_a_continuation() -> None:
    random, seen = np.random.default_rng(11), dict[str, int]()
    for k in range(count(12, 400)):
        bar, crank = drawn(random, 4)
        places, angles = bar.poses(random.permutation(crank))
        if k % 2:  # any poses
            places, angles = random.normal(size=(4, 2)) @ [1.0, 1.0j], random.uniform(-2, 2, 4)
        for one in kp.synthesis.motion(rows(places, angles), defects="tell", samples=5):
            lengths = sorted(one.lengths.values())
            margin = abs(lengths[0] + lengths[3] - lengths[1] - lengths[2])
            if margin < 0.02 * lengths[3] or lengths[3] > 30.0 * lengths[0]:
                continue  # circuits come close to each other there
            o, a, b, d, _ = one.pins
            turn = np.exp(1j * (angles - angles[0]))
            a, b = (places + (pin - places[0]) * turn for pin in (a, b))
            for first, pin, other, last in ((o, a, b, d), (d, b, a, o)):  # either as the crank
                numbers = np.array([[first, *pin, *other, last]]).view(np.float64)
                asked = (True, None, None, None, 0)
                (known,), _ = _core.ranked_linkages(numbers, [0.0], False, asked, False, True)
                if known[5] < 0.1:  # a dead point between two steps of the continuation
                    continue
                told = known[6][0].split(":")[0] if known[6] else ""
                assert told == traced(first, pin, other, last), one
                seen[told] = seen.get(told, 0) + 1
    assert min(seen.get(kind, 0) for kind in ("", "order", "branch", "circuit")) > 3, seen


def test_fixed_pivots_and_limits_are_respected() -> None:
    places, angles = KNOWN.poses(CRANK)
    task = rows(places, angles)
    (one,) = kp.synthesis.motion(task[:3], pivots={"O": (0, 0), "D": (3, 0)})
    assert found_in(KNOWN, pins_of(one)) < 1e-12
    box = [(-1, 4), (-1, 4)]
    found = kp.synthesis.motion(task[:4], within=box, transmission_angle="40 deg", grashof=True)
    assert len(found) > 5
    assert found.excluded["pivots"]
    for one in found:
        assert one.grashof
        assert one.transmission_angle >= np.radians(40.0)
        assert all(-1 <= x <= 4 for name in "OD" for x in one.points[name])
    other = kp.synthesis.motion(task[:4], direction="cw")
    assert all(one.crank_angles[-1] < one.crank_angles[0] for one in other)


def test_the_transmission_angle_is_that_of_a_turn() -> None:
    places, angles = KNOWN.poses(CRANK)
    one = min(kp.synthesis.motion(rows(places, angles)), key=lambda one: one.lengths["crank"])
    turn = kp.design.transmission_angle(one.case.run()["motion"], "B")
    assert one.type == "crank-rocker"
    assert one.transmission_angle == pytest.approx(np.min(turn.angle), abs=1e-3)


def test_candidates_are_ranked_by_a_column() -> None:
    places, angles = KNOWN.poses(CRANK)
    found = kp.synthesis.motion(rows(places, angles)[:3], pivots={"O": (0, 0)}, samples=20)
    values = found.ranked("drive.effort.peak").values("drive.effort.peak")
    finite = [x for x in values if np.isfinite(x)]
    assert finite == sorted(finite)
    assert len(finite) > 3
    with pytest.raises(kp.ModelError, match="effrot"):
        found.ranked("drive.effrot.peak")


@pytest.mark.parametrize(
    ("poses", "options", "message"),
    [
        ([(0, 0, 0)], {}, "at least two"),
        ([(0, 0, 0), (1, 0, 1), (0, 0, 0)], {}, "poses 1 and 3 are the same"),
        ([(0, 0, 0), (1, 0)], {}, r"poses\[2\].*3 numbers"),
        ([(0, 0, 0), (1, 0, "30 dge")], {}, r"poses\[2\]"),
        ([(0, 0, 0), (1, 0, 1)], {"pivots": {"Q": (0, 0)}}, "Q"),
        ([(0, 0, 0), (1, 0, 1)], {"pivots": {"O": (0, 0), "D": (0, 0)}}, "O and D are the same"),
        ([(0, 0, 0), (1, 0, 1)], {"family": "five_bar"}, "family"),
        ([(0, 0, 0), (1, 0, 1)], {"masses": {"crank": -1}}, "masses.crank"),
    ],
)
def test_wrong_tasks_are_explained(poses: list, options: dict, message: str) -> None:
    with pytest.raises(kp.ModelError, match=message):
        kp.synthesis.motion(poses, **options)


def test_impossible_tasks_are_explained() -> None:
    with pytest.raises(kp.ModelError, match=r"no four-bar takes all 5.*leave out or move a pose"):
        none = [(0.5, -1, 2.4), (4, -3, 1), (4, -4, 2.3), (1, 0.5, -1.9), (3.5, -2, 1.5)]
        kp.synthesis.motion(none)
    places, angles = KNOWN.poses(CRANK)
    with pytest.raises(kp.ModelError, match="fixed pivot contradict"):
        kp.synthesis.motion(rows(places, angles)[:4], pivots={"O": (0.3, 0.2)})
    same = [(float(k), float(k * k), 0.5) for k in range(5)]
    with pytest.raises(kp.ModelError, match="depend on each other"):
        kp.synthesis.motion(same)


def test_more_than_five_poses_are_approximated() -> None:
    random = np.random.default_rng(8)
    for n in (6, 9, 20):
        bar, crank = drawn(random, n)
        places, angles = bar.poses(crank)
        exact = kp.synthesis.motion(rows(places, angles))
        assert not exact.complete
        assert exact[0].error < 1e-9
        assert found_in(bar, pins_of(exact[0])) < 1e-6
        noise = 1e-3 * (random.normal(size=n) + 1j * random.normal(size=n))
        near = kp.synthesis.motion(rows(places + noise, angles))
        assert near[0].error < 4.0 * np.abs(noise).max()


def test_the_figures_have_a_panel_for_each_candidate_and_the_curves_pass_the_pins() -> None:
    places, angles = KNOWN.poses(CRANK)
    found = kp.synthesis.motion(rows(places, angles), defects="tell")
    assert len(kp.plot.synthesis(found).axes) == 6
    curves = kp.synthesis.burmester(rows(places, angles)[:4])
    at = np.column_stack([curves.circle_points, curves.centre_points])
    size = np.abs(at).max(axis=1)
    for kind, (x, y) in zip(("circle", "centre"), (at.T[:2], at.T[2:]), strict=True):
        assert (np.abs(curves.level(kind, x, y)) < 1e-9 * (1.0 + size**3)).all()
    for one in kp.synthesis.dyads(rows(places, angles)):
        for kind, pin in zip(("circle", "centre"), one, strict=True):
            level = curves.level(kind, np.array(pin.real), np.array(pin.imag))
            assert abs(level) < 1e-9 * (1.0 + abs(pin) ** 3)
    assert len(kp.plot.burmester(curves).lines) > 3
