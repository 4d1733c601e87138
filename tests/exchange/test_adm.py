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
