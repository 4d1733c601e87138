"""Models of the solver of MSC Adams, which the tests write themselves."""

from __future__ import annotations

from pathlib import Path

import kempe as kp
import numpy as np
import pytest

SAMPLE = Path(__file__).parents[2] / "exchange" / "tests" / "samples" / "pendulum.adm"


def changed(folder: Path, *pairs: tuple[str, str]) -> Path:
    """The pendulum with other texts."""
    text = SAMPLE.read_text()
    for before, after in pairs:
        assert before in text
        text = text.replace(before, after)
    path = folder / "changed.adm"
    path.write_text(text)
    return path


def test_a_pendulum_in_the_xz_plane_falls_by_its_formula(tmp_path: Path) -> None:
    path = changed(tmp_path, ("- 0.1*(dm", "- 0*(dm"), ("(1.0E-3", "(0"))
    case = kp.load(path)
    body = case.model.tree()["bodies"]["rod"]
    assert body["mass"] == 2
    assert body["inertia"] == pytest.approx(0.6)
    solution = kp.dynamics(case.model, case.start(), t_end=1, output_step=0.01)
    angle, omega = solution["rod.angle"], solution["rod.omega"]
    # the energy of a compound pendulum that starts at rest in the horizontal position
    assert np.allclose(0.5 * (0.6 + 2) * omega**2, -2 * 9.80665 * np.sin(angle), atol=1e-6)
    assert solution["rod.alpha"][0] == pytest.approx(-2 * 9.80665 / 2.6)


def test_a_spring_with_a_formula_over_several_lines_has_its_force() -> None:
    case = kp.load(SAMPLE)
    start = case.start()
    # 0.1 N/mm over the 500 mm by which it is longer, upwards at the mass centre
    force = 0.1 * (1000 - 500)
    assert start["rod"].alpha == pytest.approx((force - 2 * 9.80665) / 2.6)


@pytest.mark.parametrize("law", ["30D*time", "(pi/6)*time", "0.5235987755982988*time"])
def test_a_motion_turns_marker_i_from_marker_j(tmp_path: Path, law: str) -> None:
    motion = f"MOTION/1, JOINT = 1, ROTATION\n, FUNCTION = {law}\nSFORCE/1"
    solution = kp.load(changed(tmp_path, ("SFORCE/1", motion))).run()["motion"]
    # the axis of the joint is y, and the plane xz shows y from behind
    assert np.allclose(solution["rod.angle"], -np.pi / 6 * solution.t, atol=1e-12)


def test_what_has_no_equal_is_named_with_its_line(tmp_path: Path) -> None:
    path = changed(
        tmp_path,
        ("END\n", "BEAM/1, I = 0101\nJOINT/2, SCREW\n, I = 0202, J = 0101, PITCH = 1\nEND\n"),
    )
    lines = path.read_text().splitlines()
    with pytest.raises(kp.FileError) as caught:
        kp.load(path)
    found = {problem.line: problem.message for problem in caught.value.problems}
    assert "BEAM/1" in found[lines.index("BEAM/1, I = 0101") + 1]
    assert "SCREW" in found[lines.index("JOINT/2, SCREW") + 1]
    case = kp.load(path, partial=True)
    assert any("GRAPHICS" in text for text in case.unread)
    assert any("BEAM" in text for text in case.unread)


def test_units_and_inertias_that_are_not_known_are_named(tmp_path: Path) -> None:
    for pair, message in [
        (("LENGTH = MILLIMETER", "LENGTH = CUBIT"), "LENGTH = CUBIT"),
        (("6.0E5, 6.0E5", "6.0E5, 6.0E5, 5"), "products of inertia"),
        (("J = 0101\nSFORCE", "J = 0999\nSFORCE"), "no marker 999"),
        (("QP = 1000, 0, 0", "QP = 1000, 0"), "must be 3"),
    ]:
        with pytest.raises(kp.FileError, match=message):
            kp.load(changed(tmp_path, pair))


@pytest.mark.parametrize(
    ("pair", "message"),
    [
        (("JOINT/1, REVOLUTE", "JOINT/1, REVOLUTE, IC = 10D"), "JOINT/1: IC is not supported"),
        ((", TRANSLATIONAL\n", ", TRANSLATIONAL, ACTIONONLY\n"), "SFORCE/1: ACTIONONLY"),
        (("TIME = SECOND", "TIME = SECOND, SYSTEM = CGS"), "SYSTEM is not supported"),
        (("PART/02, MASS = 2", "PART/02, MASS = 2, MASS = 3"), "MASS is given twice"),
        (("IP = 1000, 6.0E5", "IP = 1000, abc"), "ABC is not supported"),
        (("MARKER/0103", "MARKER/0201"), "MARKER/201: there is another statement"),
        ((", CM = 0201, IP", ", IP"), "CM: there is no such marker"),
        (("KGRAV = -9806.65\n", "KGRAV = -9806.65\nACCGRAV/\n, IGRAV = 1\n"), "another such"),
        (("180D, 90D, 180D\nMARKER/0103", "180D, 90D, 180D, 4\nMARKER/0103"), "REULER: 4 values"),
    ],
)
def test_words_that_are_not_read_are_named(
    tmp_path: Path, pair: tuple[str, str], message: str
) -> None:
    with pytest.raises(kp.FileError, match=message):
        kp.load(changed(tmp_path, pair))


def test_markers_with_one_name_keep_their_places(tmp_path: Path) -> None:
    view = "!    adams_view_name='{}'\nMARKER/"
    path = changed(
        tmp_path,
        ("MARKER/0201", view.format("M/1") + "0201"),
        ("MARKER/0202", view.format("M/1") + "0202"),
        (
            "END\n",
            "JPRIM/1, INPLANE, I = 0101, J = 0103\nMOTION/1, ROTATION, JOINT = 1\n"
            ", FUNCTION = 30D*time\nEND\n",
        ),
    )
    case = kp.load(path, partial=True)
    # the pin is at the origin of the rod, and the motion is that of JOINT/1, not of JPRIM/1
    assert case.start()["rod.x"] == pytest.approx(0, abs=1e-12)
    assert case.model.tree()["drivers"]["MOTION_1"]["coordinate"] == "pin.angle"
    assert case.model.tree()["bodies"]["rod"]["center"] == pytest.approx([1, 0])
