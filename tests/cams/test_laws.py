"""Programmes: laws against the core and by hand, and refusals whose remedies work."""

import kempe as kp
import numpy as np
import pytest
from cams.machines import lift_of, programme, translating
from kempe import _core
from kempe.design.cams.laws import LAWS, programme_of


@pytest.mark.parametrize("law", [law for law in LAWS if law != "linear"])
def test_laws_are_those_of_formulas(law: str) -> None:
    own = programme_of(programme(0.01, law, law), "m")
    for angle in np.linspace(0.0, 2.0 * np.pi, 200, endpoint=False).tolist():
        rise, back = (f"{law}(({angle!r} - {at})/(100*deg))" for at in ("0", "140*deg"))
        wanted = _core.formula_value(f"0.01*({rise} - {back})", [], [])[0]
        assert float(own.at(angle)) == pytest.approx(wanted, abs=1e-15)


@pytest.mark.parametrize("law", LAWS)
def test_derivatives_of_laws_are_those_of_differences(law: str) -> None:
    one = ("rise", "180 deg", 1.0, law), ("return", "180 deg", law)
    if law == "linear":
        with pytest.raises(kp.ModelError, match=r"speed jumps by .* at 0°"):
            programme_of(one, "m")
        return
    own = programme_of(one, "m")
    angle = np.linspace(0.02, 3.0, 97)  # between the ends of pieces
    for order in range(3):
        step = 1e-5
        ahead, behind = own.at(angle + step, order), own.at(angle - step, order)
        scale = np.abs(own.at(angle, order + 1)).max()
        assert np.abs((ahead - behind) / (2 * step) - own.at(angle, order + 1)).max() < 1e-4 * scale


def test_the_cycloidal_programme_is_that_by_hand() -> None:
    own = programme_of(programme(0.01), "m")
    angle = np.linspace(0.0, 6.28, 500)
    for order in range(3):
        assert own.at(angle, order) == pytest.approx(lift_of(angle, 0.01, order), abs=1e-14)
    assert own.size == pytest.approx(0.01, rel=1e-14)
    assert own.jumps == ()


def test_polynomials_and_splines_meet_their_end_conditions() -> None:
    middle = {"type": "polynomial", "start": [0, 0, 0], "end": ["5 mm/rad", 0]}
    on = {"type": "polynomial", "start": ["5 mm/rad", 0], "end": [0, 0]}
    points = [("30 deg", 0.021), ("60 deg", 0.012), ("90 deg", 0.002)]
    spline = {"type": "spline", "points": points, "start": [0, 0], "end": [0, 0]}
    own = programme_of(
        [
            ("rise", 1.0, 0.01, middle),
            ("rise", 1.0, 0.012, on),
            ("return", "120 deg", spline),
            ("dwell", 2 * np.pi - 2.0 - np.radians(120)),
        ],
        "m",
    )
    just = np.nextafter(1.0, 0.0)
    assert [float(own.at(just, k)) for k in range(3)] == pytest.approx(
        [0.01, 0.005, 0.0], abs=1e-12
    )
    assert float(own.at(0.0, 3)) == pytest.approx(0.0, abs=1e-12)
    assert [float(own.at(1.0, k)) for k in range(3)] == pytest.approx([0.01, 0.005, 0.0], abs=1e-12)
    for at, lift in zip(np.radians([30, 60, 90]), (0.021, 0.012, 0.002), strict=True):
        assert float(own.at(2.0 + at)) == pytest.approx(lift, abs=1e-14)
        for order in range(5):  # four continuous derivatives
            ahead, behind = own.at(2.0 + at + 1e-9, order), own.at(2.0 + at - 1e-9, order)
            assert float(ahead) == pytest.approx(float(behind), abs=1e-5)
    assert own.jumps == ()


@pytest.mark.parametrize(
    ("bad", "message", "remedy"),
    [
        (
            [*programme(0.01)[:3], ("dwell", "110 deg")],
            r"cover 350°, not 360°; add \('dwell', '10 deg'\)",
            [*programme(0.01)[:3], ("dwell", "110 deg"), ("dwell", "10 deg")],
        ),
        (
            [("rise", "180 deg", 0.01, "cycloidal"), ("dwell", "180 deg")],
            r"ends 0\.01 m above its start; add \('return'",
            [
                ("rise", "180 deg", 0.01, "cycloidal"),
                ("dwell", "90 deg"),
                ("return", "90 deg", "cycloidal"),
            ],
        ),
        (
            programme(0.01, "linear"),
            r"speed jumps by 0\.0057\d* m/rad at 0°; choose a law .* 'cycloidal'",
            programme(0.01, "cycloidal"),
        ),
        (
            [("dwell", "360 deg")],
            "does not move; add a rise and a return",
            programme(0.01),
        ),
        (
            [("return", "100 deg", "cycloidal"), ("dwell", "260 deg")],
            "no lift from which to return; begin with a rise",
            programme(0.01),
        ),
    ],
)
def test_programmes_that_are_no_turn_are_refused_with_a_remedy(
    bad: list, message: str, remedy: list
) -> None:
    with pytest.raises(kp.ModelError, match=message):
        translating(programme=bad)
    assert translating(programme=remedy).programme.size == pytest.approx(0.01)


@pytest.mark.parametrize(
    ("bad", "message"),
    [
        ("rise", "list of segments"),
        ([("climb", 1.0, 0.01, "cycloidal")], r"programme\[1\]: .*'rise'"),
        ([("rise", 1.0, "cycloidal")], r"programme\[1\]: .*3 parts"),
        ([("rise", "1 m", 0.01, "cycloidal")], "an angle"),
        ([("rise", 1.0, "1 deg", "cycloidal")], "in m"),
        ([("rise", -1.0, 0.01, "cycloidal")], "must be positive"),
        ([("rise", 1.0, -0.01, "cycloidal")], "must be > 0"),
        ([("rise", 1.0, 0.01, "sine")], "modified_sine"),
        ([("rise", 1.0, 0.01, {"type": "polynomial", "begin": [0]})], "unknown key 'begin'"),
        ([("rise", 1.0, 0.01, {"type": "spline", "points": [(2.0, 0.1)]})], "within the segment"),
        ([("rise", 1.0, 0.01, {"type": "spline", "points": [3]})], r"points\[1\]"),
        ([("rise", 1.0, 0.01, {"type": "polynomial", "end": [0] * 5})], "at most four"),
        ([], "no segments"),
    ],
)
def test_wrong_segments_are_explained(bad: object, message: str) -> None:
    with pytest.raises(kp.ModelError, match=message):
        programme_of(bad, "m")


def test_a_jump_of_the_acceleration_is_a_remark_and_its_remedy_works() -> None:
    with_jump = translating(programme=programme(0.01, "harmonic", "harmonic"))
    jump = 0.01 * np.pi**2 / 2 / np.radians(100) ** 2
    assert [by for _, by in with_jump.programme.jumps] == pytest.approx(
        [jump, jump, -jump, -jump], rel=1e-9
    )
    assert sum("acceleration jumps" in text for text in with_jump.remarks) == 4
    assert translating(programme=programme(0.01, "poly345", "poly345")).remarks == ()


def test_a_lift_below_the_base_circle_is_a_remark() -> None:
    dip = {"type": "polynomial", "start": [0, -0.05], "end": [0, 0]}
    cam = translating(programme=programme(0.01, dip))
    assert any("below the base circle" in text for text in cam.remarks)
