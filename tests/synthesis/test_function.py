"""Function generation against Freudenstein's equation and known four-bars."""

import kempe as kp
import numpy as np
import pytest
from sizes import count
from synthesis.linkages import Floats, FourBar, drawn


def freudenstein(crank: Floats, rocker: Floats) -> tuple[float, float, float]:
    """Lengths of crank, coupler and rocker for three pairs; ground 1 (Freudenstein 1955).

    K1 cos ψ - K2 cos φ + K3 = cos(φ - ψ) with K1 = d/a, K2 = d/c, K3 = (a² - b² + c² + d²)/(2ac).
    """
    matrix = np.column_stack([np.cos(rocker), -np.cos(crank), np.ones(3)])
    k1, k2, k3 = np.linalg.solve(matrix, np.cos(crank - rocker))
    a, c = 1.0 / k1, 1.0 / k2
    return a, float(np.sqrt(a * a + c * c + 1.0 - 2.0 * a * c * k3)), c


def lengths(one: kp.synthesis.Candidate) -> list[float]:
    return [one.lengths[name] for name in ("crank", "coupler", "rocker")]


def test_three_pairs_have_the_four_bar_of_freudensteins_equation() -> None:
    random = np.random.default_rng(1)
    for _ in range(count(40, 400)):
        crank, rocker = np.sort(random.uniform(0.0, 3.0, (2, 3)))
        a, b, c = freudenstein(crank, rocker)
        if not np.isfinite(b) or max(abs(a), b, abs(c)) > 100.0 or min(abs(a), abs(c)) < 0.01:
            continue
        (one,) = kp.synthesis.function(list(zip(crank, rocker, strict=True)), defects="tell")
        assert lengths(one) == pytest.approx([abs(a), b, abs(c)], rel=1e-8)
        at = (np.array(one.points["A"]), np.array(one.points["B"]) - [1.0, 0.0])
        for link, length, angle in zip(at, (a, c), (crank[0], rocker[0]), strict=True):
            assert link == pytest.approx(
                length * np.array([np.cos(angle), np.sin(angle)]), rel=1e-7
            )


def compared(bar: FourBar, found: kp.synthesis.Found) -> float:
    """The least difference of a candidate from a four-bar, ground 1."""
    wanted = np.array([bar.a, bar.b, bar.c]) / bar.d
    return float(min(np.abs(np.array(lengths(one)) - wanted).max() for one in found))


@pytest.mark.parametrize(
    ("n", "offsets"), [(5, "free"), (3, "fixed"), (6, "free"), (12, "free"), (5, "fixed")]
)
def test_a_four_bar_is_found_from_its_own_angles(n: int, offsets: str) -> None:
    random = np.random.default_rng(n)
    for _ in range(count(2 if n > 5 else 12, 200 if n <= 5 else 20)):
        bar, crank = drawn(random, n)
        rocker = np.unwrap(bar.rocker(crank))
        turned = (0.0, 0.0) if offsets == "fixed" else random.uniform(-3.0, 3.0, 2)
        pairs = list(zip(crank + turned[0], rocker + turned[1], strict=True))
        found = kp.synthesis.function(pairs, offsets=offsets, defects="tell")
        assert compared(bar, found) < 1e-6
        assert found.complete == ((n == 5 and offsets == "free") or n == 3)
        assert found[0].error < 1e-9


def test_the_simulated_rocker_has_the_angles() -> None:
    random, seen = np.random.default_rng(3), 0
    for n in (2, 3, 4, 5, 2, 3, 4, 5):
        bar, crank = drawn(random, n)
        rocker = np.unwrap(bar.rocker(crank))
        found = kp.synthesis.function(list(zip(crank, rocker, strict=True)), ground="20 mm")
        for one in found[:2]:
            end = one.crank_angles
            times = np.abs(end - end[0]) / (2.0 * np.pi)
            case = one.case
            motion = kp.kinematics(
                case.model, case.start(), t_end=times[-1], output_step=times[-1] / 9
            )
            turned = np.unwrap(motion(times)["rocker.angle"])
            assert turned - turned[0] == pytest.approx(rocker - rocker[0], abs=1e-6)
            assert np.abs(end - end[0]) == pytest.approx(np.abs(crank - crank[0]), abs=1e-9)
            assert one.points["D"] == pytest.approx((0.02, 0.0))
            seen += 1
    assert seen > 8


def test_free_scales_make_six_and_seven_pairs_exact() -> None:
    """The search is not complete: it may end with an error in place of a solution."""
    random, sources = np.random.default_rng(4), 0
    for n in (7, 7, 7, 6):
        bar, crank = drawn(random, n)
        x, y = 3.0 + 0.2 * crank, 7.0 - 4.0 * np.unwrap(bar.rocker(crank))
        pairs = list(zip(x, y, strict=True))
        try:
            found = kp.synthesis.function(pairs, scales="free", defects="tell")
        except kp.ModelError as error:
            assert n == 7 and "no four-bar found" in str(error)
            continue
        assert not found.complete
        assert found[0].error < 1e-9
        sources += n == 7 and compared(bar, found) < 1e-6
    assert sources >= 2


@pytest.mark.parametrize(
    ("pairs", "options", "message"),
    [
        ([(0, 1)], {}, "at least two"),
        ([(0, 1), (0, 2)], {}, "pairs 1 and 2 have the same crank angle"),
        ([(0, 1), (1, 2)], {"scales": "loose"}, "scales"),
        ([(x, x) for x in range(5)], {}, "pair 5 adds none to the others; leave out a pair"),
        ([(0, 1), (1, 2)], {"ground": 0}, "ground"),
        ([(0, "1 dge"), (1, 2)], {}, r"pairs\[1\]"),
    ],
)
def test_wrong_pairs_are_explained(pairs: list, options: dict, message: str) -> None:
    with pytest.raises(kp.ModelError, match=message):
        kp.synthesis.function(pairs, **options)
