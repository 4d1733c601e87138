"""DXF drawings that are cut, read again and simulated; tables; the command; the figure."""

import csv
import json
from pathlib import Path

import ezdxf
import kempe as kp
import numpy as np
import pytest
from cams.machines import SIZES, lift_of, oscillating, programme, translating
from command_line import kempe
from kempe import plot
from plot.overlaps import faults
from sizes import FULL

LIFT = "segment, angle [deg], lift [mm], law\nrise, 100, 10, cycloidal\ndwell, 40\n"
LIFT += "return, 100, , cycloidal\ndwell, 120\n"


def outline(path: Path, layer: str = "cam") -> list:
    """The points of a layer as kempe reads them."""
    (points,) = (kp.load(path).model.tree()["bodies"][layer]["outline"],)
    return points if isinstance(points, list) else path_points(points["path"])


def path_points(path: str) -> list:
    """The corners of an SVG path of straight pieces."""
    numbers = [float(x) for x in path.replace(",", " ").split() if x not in ("M", "L", "Z")]
    return np.reshape(numbers, (-1, 2)).tolist()


@pytest.mark.parametrize("size", SIZES if FULL else SIZES[1:2])
def test_a_drawing_that_is_read_again_moves_the_follower_by_its_law(
    tmp_path: Path, size: float
) -> None:
    cam = translating(size=size, offset=0.004 * size)
    path = cam.write_dxf(tmp_path / "cam.dxf")
    assert not ezdxf.readfile(path).audit().errors
    m = kp.Model("cut", gravity=(0, -9.81))
    m.ground.points(O=(0, 0), G=(0.004 * size, 0))
    rim = {"points": outline(path), "periodic": True}
    m.body("cam", mass=1, inertia=1, points={"O": (0, 0)}, curves={"rim": rim})
    m.body("follower", mass=1, inertia=1, points={"P": (0, 0)})
    m.revolute("shaft", "ground.O", "cam.O")
    m.translational("guide", "ground.G", "follower.P", axes=("90 deg", "90 deg"))
    m.roller_on_curve("contact", "follower.P", "cam.rim", radius=0.008 * size, side="left")
    m.coordinate_driver("drive", "cam.angle", value="2*pi*t")
    guess = {"follower.x": 0.004 * size, "follower.y": 0.0378 * size, "contact.u": 0}
    start = kp.assemble(m, guess=guess)
    motion = kp.kinematics(m, start, t_end=1, output_step=1 / 720)
    found = motion["follower.y"] - np.sqrt(0.038**2 - 0.004**2) * size
    wanted = lift_of(motion["cam.angle"], 0.01 * size)
    assert np.abs(found - wanted).max() < 1e-9 * 0.01 * size


def test_layers_of_grooves_conjugates_and_cutters(tmp_path: Path) -> None:
    groove = translating(closure="groove")
    path = groove.write_dxf(tmp_path / "groove.dxf", cutter_radius="6 mm", unit="cm")
    layers = {e.dxf.layer for e in ezdxf.readfile(path).modelspace().query("POLYLINE")}
    assert layers == {"cam", "outer", "cutter", "cutter_outer"}
    inner, outer = (np.array(outline(path, name)) for name in ("cam", "outer"))
    assert np.hypot(*(outer - inner).T) == pytest.approx(0.016, rel=1e-6)
    pair = oscillating(closure="conjugate")
    path = pair.write_dxf(tmp_path / "pair.dxf", cutter_radius=0.02)
    layers = {e.dxf.layer for e in ezdxf.readfile(path).modelspace().query("POLYLINE")}
    assert layers == {"cam", "conjugate", "cutter", "cutter_conjugate"}
    with pytest.raises(kp.ModelError, match=r"at most 0\.008 m"):
        groove.write_dxf(tmp_path / "never.dxf", cutter_radius="9 mm")
    assert groove.cutter_path("8 mm") == pytest.approx(groove.pitch, abs=1e-12)
    with pytest.raises(kp.ModelError, match="unit"):
        groove.write_dxf(tmp_path / "never.dxf", unit="inch")


def test_a_cutter_that_does_not_fit_is_refused_and_a_smaller_one_fits() -> None:
    quick = [
        ("rise", "60 deg", 0.02, "cycloidal"),
        ("dwell", "80 deg"),
        ("return", "60 deg", "cycloidal"),
        ("dwell", "160 deg"),
    ]
    cam = translating(programme=quick)
    with pytest.raises(kp.ModelError, match="has a hollow of radius") as caught:
        cam.cutter_path("100 mm")
    hollow = float(str(caught.value).split("of radius ")[1].split()[0])
    assert hollow == pytest.approx(-cam.radius_of_curvature[cam.radius_of_curvature < 0].max())
    path = cam.cutter_path(0.99 * hollow)
    assert np.hypot(*(path - cam.profile).T) == pytest.approx(0.99 * hollow, rel=1e-9)


def test_the_table_has_the_law_and_the_curves(tmp_path: Path) -> None:
    cam = translating(offset=0.004)
    path = cam.write_csv(tmp_path / "cam.csv", step="0.5 deg", cutter_radius=0.02)
    rows = list(csv.DictReader(path.read_text("utf-8").splitlines()))
    assert len(rows) == 720
    columns = {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}
    angle = np.radians(columns["angle [deg]"])
    for order, name in enumerate(("s [m]", "v [m/rad]", "a [m/rad^2]")):
        assert columns[name] == pytest.approx(lift_of(angle, 0.01, order), abs=1e-14)
    one = cam.at(angle)
    assert columns["profile_x [m]"] == pytest.approx(one.profile.real)
    assert columns["radius_of_curvature [m]"] == pytest.approx(one.radius)
    away = np.hypot(
        columns["cutter_x [m]"] - columns["profile_x [m]"],
        columns["cutter_y [m]"] - columns["profile_y [m]"],
    )
    assert away == pytest.approx(0.02)
    with pytest.raises(kp.ModelError, match="whole part of a turn"):
        cam.write_csv(tmp_path / "never.csv", step="0.7 deg")


@pytest.mark.parametrize("size", [1e-2, 1.0, 50.0])
def test_the_table_has_both_walls_and_both_cams(size: float, tmp_path: Path) -> None:
    """Points of the walls of a groove are a roller's diameter apart, with the path between them."""
    cam = translating(size=size, closure="groove")
    pair = oscillating(size=size, closure="conjugate")
    found = []
    for k, one in enumerate((cam, pair)):
        path = one.write_csv(tmp_path / f"{k}.csv", step="1 deg")
        rows = list(csv.DictReader(path.read_text("utf-8").splitlines()))
        columns = {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}
        names = {name.rpartition("_")[0] for name in columns if name.endswith("_x [m]")}
        places = {n: columns[f"{n}_x [m]"] + 1j * columns[f"{n}_y [m]"] for n in names}
        found.append(places)
    groove, both = found
    assert set(groove) == {"pitch", "profile", "outer"}
    assert abs(groove["outer"] - groove["profile"]) == pytest.approx(0.016 * size, rel=1e-9)
    middle = (groove["outer"] + groove["profile"]) / 2
    assert abs(middle - groove["pitch"]).max() < 1e-9 * size
    assert set(both) == {"pitch", "profile", "conjugate"}
    angle = np.radians(np.arange(360))
    expected = pair.at(angle, second=True).profile
    assert abs(both["conjugate"] - expected).max() < 1e-12 * size


def test_the_case_has_the_curves_that_it_needs() -> None:
    for cam, names in (
        (translating(), {"rim"}),
        (translating("flat"), {"rim"}),
        (translating(closure="groove"), {"rim", "outer", "pitch"}),
        (oscillating(closure="conjugate"), {"rim", "second", "pitch"}),
        (translating("flat", closure="conjugate"), {"rim", "second"}),
    ):
        assert set(cam.case.model.compile().bodies["cam"].curves) == names


def test_a_programme_in_a_file(tmp_path: Path) -> None:
    path = tmp_path / "lift.csv"
    path.write_text(LIFT, "utf-8")
    own = kp.design.cam(
        "roller", kp.design.read_programme(path), base_radius=0.03, roller_radius=0.008
    )
    assert own.profile == pytest.approx(translating().profile, abs=1e-15)
    path.write_text("segment, angle [deg]\nrise, 100\n", "utf-8")
    with pytest.raises(kp.FileError, match=r"no column lift and law.*lift \[mm\]"):
        kp.design.read_programme(path)
    path.write_text("segment, angle, lift, law\nrise\n", "utf-8")
    with pytest.raises(kp.FileError, match="row 2 has no angle"):
        kp.design.read_programme(path)


def test_the_command_writes_case_drawing_table_and_figure(tmp_path: Path) -> None:
    path = tmp_path / "lift.csv"
    path.write_text(LIFT, "utf-8")
    words = [
        "cam",
        path,
        "--base-radius",
        "30 mm",
        "--roller-radius",
        "8 mm",
        "-o",
        tmp_path / "out",
    ]
    answer = kempe(*words, "--spring", "1500 N/m", "30 N", "--mass", "0.25", "--json")
    told = json.loads(answer.stdout)
    cam = translating(mass=0.25, spring=(1500, 30))
    assert told["lift_off_speed"] == pytest.approx(cam.lift_off_speed)
    assert told["pressure_angle"] == pytest.approx(cam.largest_pressure_angle)
    assert {Path(name).name for name in told["files"]} >= {"cam.toml", "cam.dxf", "cam.csv"}
    assert "follower" in kp.load(tmp_path / "out" / "cam.toml").tree()["bodies"]
    sharp = ["cam", path, "--follower", "flat", "--base-radius", "1 mm", "-o", tmp_path / "sharp"]
    undercut = kempe(*sharp)
    assert "lift-off speed" in undercut.stdout
    assert "undercut" in undercut.stdout
    assert "base_radius of at least" in undercut.stdout


def test_no_text_of_the_figure_covers_another_or_leaves_the_paper() -> None:
    undercut = translating("flat", base_radius=0.004)
    for cam in (translating(closure="groove"), undercut, oscillating(closure="conjugate")):
        figure = plot.cam(cam)
        assert faults(figure) == ([], [])


def test_a_figure_of_something_else_is_refused() -> None:
    with pytest.raises(kp.ModelError, match=r"kp\.design\.cam"):
        plot.cam(programme(0.01))  # type: ignore[arg-type]
