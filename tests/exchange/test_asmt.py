"""Assemblies of OndselSolver, which the tests write themselves."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import kempe as kp
import numpy as np
import pytest
from exchange.asmt_text import Assembly, Part, X, Y, Z, turn
from exchange.machines import slide_position, slider_crank, spring_pendulum

#: The plane of the machine: xy, yz, zx, and one that is oblique.
OBLIQUE = turn(0.4) @ X @ turn(-0.7)
PLANES = {"xy": Z, "yz": X, "zx": Y, "oblique": OBLIQUE}


def written(folder: Path, assembly: Assembly, more: str = "") -> Path:
    path = folder / "machine.asmt"
    path.write_text(assembly.text() + more, encoding="utf-8")
    return path


@pytest.mark.parametrize("plane", PLANES)
@pytest.mark.parametrize(
    ("size", "mass", "rate"), [(1.0, 1.0, 2.0), (1e-3, 1e-3, 50.0), (1e3, 1e3, 0.01)]
)
def test_a_slider_crank_moves_as_its_formula(
    tmp_path: Path, plane: str, size: float, mass: float, rate: float
) -> None:
    machine = slider_crank(size, 3.0, rate, mass).turned(PLANES[plane])
    case = kp.load(written(tmp_path, machine))
    solution = case.run()["motion"]
    angle = 0.3 + rate * solution.t
    x0, y0 = (solution[f"crank.O.{c}"] for c in "xy")
    place = np.hypot(solution["piston.B.x"] - x0, solution["piston.B.y"] - y0)
    assert np.abs(place - slide_position(size, 3.0, angle)).max() < 1e-11 * size
    turned = np.abs(solution["crank.angle"] - solution["crank.angle"][0])
    assert np.abs(turned - rate * solution.t).max() < 1e-12 * (1 + rate * solution.t[-1])
    # the work of the motion is the change of energy: the moments of inertia about the right axis
    energy = solution["energy.kinetic"] + solution["energy.potential"]
    power = solution["drive.effort"] * rate * np.sign(solution["crank.omega"][0])
    work = np.concatenate([[0], np.cumsum((power[1:] + power[:-1]) / 2 * np.diff(solution.t))])
    assert np.abs(work - (energy - energy[0])).max() < 5e-3 * np.ptp(energy)


def test_a_spring_pulls_by_its_formula(tmp_path: Path) -> None:
    for k, length in [(50.0, 0.5), (5e-3, 100.0), (5e4, 2e-3)]:
        case = kp.load(written(tmp_path, spring_pendulum(k, length)))
        solution = case.run()["motion"]
        expected = length + 0.5 * length * np.cos(np.sqrt(k / 2.0) * solution.t)
        assert np.abs(solution["block.x"] - expected).max() < 1e-6 * length


def test_gears_turn_by_their_radii_whatever_the_angles(tmp_path: Path) -> None:
    for inner in (1, -1):
        distance = 2.0 + inner * 1.0
        ground = {"O": ((0, 0, 0), Z), "P": ((0, distance, 0), Z)}
        wheels = [
            Part(
                name, place, turn(angle), markers={"C": ((0, 0, 0), Z), "D": ((0, 0, 0), turn(0.7))}
            )
            for name, place, angle in (("a", (0, 0, 0), 2.5), ("b", (0, distance, 0), -3.0))
        ]
        joints = [
            ("RevoluteJoint", "Ja", {"MarkerI": "/O", "MarkerJ": "/a/C"}),
            ("RevoluteJoint", "Jb", {"MarkerI": "/P", "MarkerJ": "/b/C"}),
            (
                "GearJoint",
                "mesh",
                {"MarkerI": "/a/D", "MarkerJ": "/b/D", "radiusI": 2.0, "radiusJ": inner * 1.0},
            ),
        ]
        motion = (
            "RotationalMotion",
            "drive",
            {"MotionJoint": "/Ja", "RotationZ": "2.5d + sin(time)"},
        )
        solution = kp.load(written(tmp_path, Assembly(ground, wheels, joints, [motion]))).run()[
            "motion"
        ]
        assert np.allclose(solution["a.angle"], 2.5 + np.sin(solution.t), atol=1e-12)
        assert np.allclose(solution["b.angle"], -3.0 - inner * 2 * np.sin(solution.t), atol=1e-12)


@pytest.mark.parametrize("apart", [0.5, 12.0])
def test_a_rack_moves_its_pinion_at_any_distance(tmp_path: Path, apart: float) -> None:
    ground = {"S": ((0, 0, 0), X), "C": ((0, apart, 0), Z)}
    parts = [
        Part("rack", markers={"S": ((0, 0, 0), X), "R": ((0, 0, 0), Z)}),
        Part("pinion", (0, apart, 0), markers={"C": ((0, 0, 0), Z)}),
    ]
    joints = [
        ("TranslationalJoint", "guide", {"MarkerI": "/S", "MarkerJ": "/rack/S"}),
        ("RevoluteJoint", "pin", {"MarkerI": "/C", "MarkerJ": "/pinion/C"}),
        (
            "RackPinionJoint",
            "teeth",
            {"MarkerI": "/rack/R", "MarkerJ": "/pinion/C", "pitchRadius": 0.5},
        ),
    ]
    motion = ("TranslationalMotion", "drive", {"MotionJoint": "/guide", "TranslationZ": "0.2*time"})
    solution = kp.load(written(tmp_path, Assembly(ground, parts, joints, [motion]))).run()["motion"]
    assert np.allclose(solution["rack.x"], 0.2 * solution.t, atol=1e-12)
    assert np.allclose(solution["pinion.angle"], 0.4 * solution.t, atol=1e-12)


def test_a_general_motion_moves_a_part_in_the_frame_of_another(tmp_path: Path) -> None:
    crank = Part("crank", rotation=turn(0.5), markers={"O": ((0, 0, 0), Z)})
    hand = Part("hand", tuple(turn(0.5) @ [2.0, 0, 0]), turn(0.5), markers={"H": ((0, 0, 0), Z)})
    joint = ("RevoluteJoint", "J", {"MarkerI": "/O", "MarkerJ": "/crank/O"})
    motions = [
        ("RotationalMotion", "swing", {"MotionJoint": "/J", "RotationZ": "0.5 + time"}),
        (
            "GeneralMotion",
            "reach",
            {
                "MarkerI": "/crank/O",
                "MarkerJ": "/hand/H",
                "rIJI1": "2 + time",
                "rIJI2": "0",
                "rIJI3": "0",
                "angIJJ1": "0",
                "angIJJ2": "0",
                "angIJJ3": "time^2",
                "RotationOrder": "1\t2\t3",
            },
        ),
    ]
    machine = Assembly({"O": ((0, 0, 0), Z)}, [crank, hand], [joint], motions)
    solution = kp.load(written(tmp_path, machine)).run()["motion"]
    t = solution.t
    assert np.allclose(solution["hand.x"], (2 + t) * np.cos(0.5 + t), atol=1e-11)
    assert np.allclose(solution["hand.angle"], 0.5 + t + t**2, atol=1e-11)


def test_the_results_of_a_file_have_the_names_of_kempe(tmp_path: Path) -> None:
    rate, r, mass, t = 3.0, 0.4, 2.0, np.array([0.0, 0.1, 0.2])
    part = Part(
        "arm", omega=(0, 0, rate), mass=mass, center=(r, 0, 0), markers={"O": ((0, 0, 0), Z)}
    )
    joint = ("RevoluteJoint", "J", {"MarkerI": "/O", "MarkerJ": "/arm/O"})
    motion = ("RotationalMotion", "drive", {"MotionJoint": "/J", "RotationZ": f"{rate!r}*time"})
    zero, pull = 0 * t, mass * rate**2 * r
    series = {
        "PartSeries\t/Machine/arm": {
            "X": zero,
            "Y": zero,
            "Z": zero,
            "Bryantx": zero,
            "Bryanty": zero,
            "Bryantz": rate * t,
            "VX": zero,
            "VY": zero,
            "VZ": zero,
            "OmegaX": zero,
            "OmegaY": zero,
            "OmegaZ": rate + zero,
        },
        "RevoluteJointSeries\t/Machine/J": {
            "FXonI": pull * np.cos(rate * t),
            "FYonI": pull * np.sin(rate * t),
            "FZonI": zero,
            "TXonI": zero,
            "TYonI": zero,
            "TZonI": zero,
        },
    }
    row = lambda key, values: "\t".join([key, "0", *map(repr, map(float, values))])  # noqa: E731
    lines = ["TimeSeries", "Number\tInput\t1\t2\t3", "\t".join(["Time", "Input", *map(str, t)])]
    for head, rows in series.items():
        lines += [head, *(row(key, values) for key, values in rows.items())]
    machine = replace(Assembly({"O": ((0, 0, 0), Z)}, [part], [joint], [motion]), t_end=0.2)
    case = kp.load(written(tmp_path, machine, "\n".join(lines) + "\n"))
    solution = case.run()["motion"]
    assert {
        "t",
        "arm.x",
        "arm.angle",
        "arm.omega",
        "J.fx_on_arm",
        "J.fy_on_arm",
        "J.torque_on_arm",
    } <= set(case.recorded)
    for name in set(case.recorded) - {"t"}:
        assert np.allclose(solution[name], case.recorded[name], atol=1e-10 * pull), name


def test_what_has_no_equal_is_an_error_with_line_and_name(tmp_path: Path) -> None:
    machine = slider_crank(1.0, 3.0, 1.0, 1.0)
    machine.joints.append(
        ("ScrewJoint", "thread", {"MarkerI": "/O", "MarkerJ": "/crank/O", "pitch": 1})
    )
    machine.motions.append(
        ("RotationalMotion", "odd", {"MotionJoint": "/J2", "RotationZ": "spline(time)"})
    )
    path = written(tmp_path, machine)
    lines = path.read_text().splitlines()
    with pytest.raises(kp.FileError, match=r"line \d+: ScrewJoint thread: .*spatial") as caught:
        kp.load(path)
    places = {problem.line for problem in caught.value.problems}
    assert places == {k + 1 for k, line in enumerate(lines) if line == "\t\t\tScrewJoint"} | {
        k - 2 for k, line in enumerate(lines, 1) if line == "\t\t\t\t\todd"
    }
    case = kp.load(path, partial=True)
    assert sum("ScrewJoint thread" in text for text in case.unread) == 1
    assert sum("spline" in text for text in case.unread) == 1
    assert np.isfinite(case.run()["motion"]["piston.x"]).all()


def test_a_part_that_can_tilt_is_named(tmp_path: Path) -> None:
    machine = slider_crank(1.0, 3.0, 1.0, 1.0)
    machine.joints[1:3] = [
        ("SphericalJoint", name, fields) for _, name, fields in machine.joints[1:3]
    ]
    with pytest.raises(kp.FileError, match="part rod: no joint keeps it from tilting"):
        kp.load(written(tmp_path, machine))


def test_shapes_and_notes_are_listed_but_no_error(tmp_path: Path) -> None:
    machine = slider_crank(1.0, 3.0, 1.0, 1.0)
    case = kp.load(written(tmp_path, machine))
    assert any("Notes" in text for text in case.unread)
    assert all(text.startswith("line ") for text in case.unread)


def test_repeated_paths_are_named(tmp_path: Path) -> None:
    text = slider_crank(1.0, 3.0, 2.0, 1.0).text()
    path = tmp_path / "machine.asmt"
    for before, after, message in (
        ("\t\t\t\trod\n", "\t\t\t\tcrank\n", "another part /.*/crank"),
        ("\t\t\t\t\t\t\t\tB\n", "\t\t\t\t\t\t\t\tA\n", "another marker /.*/A"),
    ):
        assert before in text, before
        path.write_text(text.replace(before, after, 1))
        with pytest.raises(kp.FileError, match=message):
            kp.load(path)
