"""Slider-cranks for poses, against known ones and simulations."""

import kempe as kp
import numpy as np
import pytest
from sizes import count
from synthesis.linkages import Complexes, Floats, rows
from synthesis.test_motion import takes


def posed(
    random: np.random.Generator, n: int
) -> tuple[tuple[float, float, float], Complexes, Floats]:
    """Lengths of a slider-crank with O at (0, 0), and poses of its coupler."""
    a, offset = random.uniform(0.5, 2.0), random.uniform(-1.0, 1.0)
    b = a + abs(offset) + random.uniform(0.2, 3.0)
    point, tilt = complex(*random.normal(size=2)), random.uniform(-3.0, 3.0)
    crank = random.uniform(0.0, 6.0) + np.cumsum(random.uniform(0.2, 1.5, n))
    pin = a * np.exp(1j * crank)
    angle = np.arcsin((offset - pin.imag) / b)
    places = (pin + point * np.exp(1j * angle)) * np.exp(1j * tilt)
    return (a, b, abs(offset)), places, angle + tilt


def test_a_slider_crank_is_found_from_its_own_poses() -> None:
    random = np.random.default_rng(3)
    for _ in range(count(15, 200)):
        lengths, places, angles = posed(random, 4)
        size = 10.0 ** random.uniform(-3, 3)
        task = rows(size * places, angles)
        (one,) = kp.synthesis.motion(task, family="slider_crank", pivots={"O": (0, 0)})
        assert [x / size for x in one.lengths.values()] == pytest.approx(lengths, abs=1e-6)
        assert one.type == "slider-crank"
        assert not one.defects
        assert "D" not in one.points
        takes(one, size * places, angles)


def test_candidates_for_fewer_poses_are_exact_and_take_them_in_order() -> None:
    random, seen = np.random.default_rng(5), set()
    for n in (2, 3, 4, 2, 3):
        places, angles = random.normal(size=(n, 2)) @ [1.0, 1.0j], random.uniform(-1, 1, n)
        if n == 4:
            _, places, angles = posed(random, n)
        task = rows(places, angles)
        found = kp.synthesis.motion(task, family="slider_crank", samples=40)
        for one in found[:: max(len(found) // 6, 1)]:
            assert one.error < 1e-9 * one.size
            takes(one, places, angles)
            seen.add(one.type)
    assert seen == {"slider-crank", "slider-rocker"}


def test_the_slide_and_the_transmission_angle_are_those_of_a_simulation() -> None:
    _, places, angles = posed(np.random.default_rng(8), 3)
    one = kp.synthesis.motion(rows(places, angles), family="slider_crank", grashof=True)[0]
    motion = one.case.run()["motion"]
    worst = kp.design.transmission_angle(motion, "B").worst.value
    assert one.transmission_angle == pytest.approx(worst, abs=1e-6)
    (x, y), (along, across) = one.slide
    off = (motion["coupler.B.x"] - x) * across - (motion["coupler.B.y"] - y) * along
    assert np.abs(off).max() < 1e-9 * one.size
    at = one.positions(len(motion.t))
    assert at[2, :, 0] == pytest.approx(motion["coupler.P.x"], abs=1e-9 * one.size)
    figure = kp.plot.synthesis(kp.synthesis.motion(rows(places, angles), family="slider_crank"))
    assert len(figure.axes) == 9


def test_a_pose_on_another_circuit_is_not_reached() -> None:
    random, seen = np.random.default_rng(13), 0
    for _ in range(4):
        places, angles = random.normal(size=(3, 2)) @ [1.0, 1.0j], random.uniform(-2, 2, 3)
        for one in kp.synthesis.motion(
            rows(places, angles), family="slider_crank", defects="tell", samples=20
        ):
            kind = one.defects[0] if one.defects else ""
            if not one.turns or "dead" in kind or one.lengths["coupler"] > 20.0:
                continue
            pin, _, at = one.positions(4000) @ [1.0, 1.0j]
            pins = places + (pin[0] - places[0]) * np.exp(1j * (angles - angles[0]))
            apart = abs(at[:, None] - places) + abs(pin[:, None] - pins)
            apart = apart.min(axis=0).max()
            assert (apart > 0.02) == kind.startswith("circuit") or "order" in kind, one
            seen += kind.startswith("circuit")
    assert seen > 3


def test_five_poses_are_refused() -> None:
    _, places, angles = posed(np.random.default_rng(8), 5)
    with pytest.raises(kp.ModelError, match=r"at most four.*leave out poses"):
        kp.synthesis.motion(rows(places, angles), family="slider_crank")
