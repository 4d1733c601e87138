"""Drawings as DXF, with ezdxf as the other program."""

from __future__ import annotations

import time
from pathlib import Path
from typing import Any

import ezdxf
import kempe as kp
import numpy as np
import pytest
from kempe.draw.dxf import UNITS

ROOT = Path(__file__).parents[2]


def drawing(folder: Path, unit: int = 4, release: str = "R2000") -> tuple[Any, Any, Path]:
    """A new drawing, its space and the path at which it will be saved."""
    document = ezdxf.new(release)
    document.header["$INSUNITS"] = unit
    return document, document.modelspace(), folder / "made.dxf"


def points_of(case: kp.Case) -> dict[str, np.ndarray]:
    """All points of a case at its start, global."""
    start = case.start()
    return {
        f"{name}.{point}": np.array([start[f"{name}.{point}.{axis}"] for axis in "xy"])
        for name, body in case.model.tree()["bodies"].items()
        for point in [*body.get("points", {}), *body.get("ends", [])]
        if name != "ground"
    }


@pytest.mark.parametrize("unit", UNITS)
@pytest.mark.parametrize("name", ["four_bar", "slider_crank", "jansen_leg", "scissor_lift"])
def test_points_and_pins_return(tmp_path: Path, name: str, unit: str) -> None:
    case = kp.load(ROOT / "examples" / f"{name}.toml")
    path = kp.write_dxf(case.start(), tmp_path / "out.dxf", unit=unit)
    assert not ezdxf.readfile(path).audit().errors
    again = kp.load(path)
    before, after = points_of(case), points_of(again)
    size = max(np.abs(list(before.values())).max(), 1e-9)
    assert set(before) <= set(after)
    for point, at in before.items():
        assert np.abs(after[point] - at).max() < 1e-9 * size, point


def test_a_plate_has_the_lines_that_another_program_draws(tmp_path: Path) -> None:
    case = kp.load(ROOT / "examples" / "four_bar.toml")
    path = kp.write_dxf(case.start(), tmp_path / "out.dxf", width=2, hole=0.5, unit="m")
    document = ezdxf.readfile(path)
    assert document.units == 6
    crank = document.modelspace().query('POLYLINE[layer=="crank"]').first
    # the perimeter of a rounded bar: two sides and a circle
    pieces = [piece.dxf for piece in crank.virtual_entities()]
    length = sum(
        abs(piece.end - piece.start)
        if hasattr(piece, "end") and not piece.hasattr("radius")
        else piece.radius * np.deg2rad((piece.end_angle - piece.start_angle) % 360)
        for piece in pieces
    )
    assert length == pytest.approx(2 * 10 + 2 * np.pi, rel=1e-9)
    circles = document.modelspace().query('CIRCLE[layer=="crank"]')
    assert [circle.dxf.radius for circle in circles] == [0.25, 0.25]


@pytest.mark.parametrize(
    ("release", "code", "size"),
    [("R12", 4, 1e-3), ("R2000", 1, 0.0254), ("R2000", 6, 1.0), ("R2018", 5, 1e-2)],
)
def test_a_plate_of_another_program_has_its_mass(
    tmp_path: Path, release: str, code: int, size: float
) -> None:
    document, space, path = drawing(tmp_path, code, release)
    corners = [(0, -10, 0), (100, -10, 1), (100, 10, 0), (0, 10, 1)]
    attributes = {"layer": "lever"}
    if release == "R12":
        space.add_polyline2d(corners, format="xyb", close=True, dxfattribs=attributes)
    else:
        space.add_lwpolyline(corners, format="xyb", close=True, dxfattribs=attributes)
    for x in (0, 100):
        space.add_circle((x, 0), 4, dxfattribs=attributes)
    document.saveas(path)
    body = kp.load(path).model.tree()["bodies"]["lever"]
    area = 100 * 20 + np.pi * 100
    assert body["mass"] == pytest.approx(39.25 * area * size**2, rel=1e-3)
    half = np.pi * 100 / 2
    offset = 50 + 40 / (3 * np.pi)
    own = half * (100 / 2) - half * (40 / (3 * np.pi)) ** 2
    second = 2000 * (100**2 + 20**2) / 12 + 2 * (own + half * offset**2)
    assert body["inertia"] == pytest.approx(39.25 * second * size**4, rel=1e-3)
    assert np.allclose(body["center"], [50 * size, 0], atol=1e-9)
    assert body["points"] == {"P1": [0, 0], "P2": [pytest.approx(100 * size), 0]}


def test_layers_are_pinned_where_their_points_coincide(tmp_path: Path) -> None:
    document, space, path = drawing(tmp_path)
    for layer, places in {
        "a": [(0, 0), (30, 40)],
        "b": [(30, 40), (90, 0)],
        "GROUND": [(0, 0), (90, 0)],
    }.items():
        for place in places:
            space.add_circle(place, 2, dxfattribs={"layer": layer})
    space.add_text("joint", dxfattribs={"layer": "a", "insert": (30, 40)})
    document.saveas(path)
    case = kp.load(path)
    joints = case.model.tree()["joints"]
    assert {(joint["i"], joint["j"]) for joint in joints.values()} == {
        ("ground.P1", "a.P1"),
        ("a.joint", "b.P1"),
        ("ground.P2", "b.P2"),
    }
    assert np.allclose(case.start()["b.P1.y"], 0.04)


def test_positions_and_paths_have_layers(tmp_path: Path) -> None:
    case = kp.load(ROOT / "examples" / "four_bar.toml")
    solution = kp.dynamics(case.model, case.start(), t_end=1, output_step=0.1)
    path = kp.write_dxf(solution, tmp_path / "out.dxf", times=[1], paths=["coupler.C"], unit="m")
    space = ezdxf.readfile(path).modelspace()
    line = space.query('POLYLINE[layer=="path coupler.C"]').first
    drawn = np.array([tuple(vertex.dxf.location)[:2] for vertex in line.vertices])
    expected = np.column_stack([solution["coupler.C.x"], solution["coupler.C.y"]])
    assert not line.is_closed
    assert np.allclose(drawn, expected, atol=1e-12)
    end = [circle.dxf.center for circle in space.query('CIRCLE[layer=="crank t 1 s"]')]
    assert np.allclose([end[1].x, end[1].y], [solution["crank.B.x"][-1], solution["crank.B.y"][-1]])


def test_what_is_no_plate_is_listed_and_blocks_are_refused(tmp_path: Path) -> None:
    document, space, path = drawing(tmp_path, 0)
    space.add_circle((0, 0), 2, dxfattribs={"layer": "a"})
    space.add_line((0, 0), (1, 1), dxfattribs={"layer": "a"})
    space.add_circle((5, 0), 2, dxfattribs={"layer": "a", "extrusion": (0, 0, -1)})
    document.saveas(path)
    case = kp.load(path)
    assert any("millimetres" in text for text in case.unread)
    assert any("LINE on layer a" in text for text in case.unread)
    assert case.model.tree()["bodies"]["a"]["points"]["P2"] == [-0.005, 0]
    document.blocks.new("part").add_circle((0, 0), 1)
    space.add_blockref("part", (0, 0))
    document.saveas(path)
    with pytest.raises(kp.FileError, match="INSERT: the block part"):
        kp.load(path)
    assert any("INSERT" in text for text in kp.load(path, partial=True).unread)


def test_binary_and_broken_files_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "broken.dxf"
    for content, message in [
        (b"AutoCAD Binary DXF\r\n\x1a", "binary"),
        (b"hello", "not a group code"),
        (b"0\nSECTION\n2\nENTITIES\n0\nCIRCLE\n10\nabc\n", "line 8: CIRCLE: not a number"),
        (b"0\nSECTION\n2\nENTITIES\n0\n", "ends within"),
    ]:
        path.write_bytes(content)
        with pytest.raises(kp.FileError, match=message):
            kp.load(path)


def test_points_at_one_place_are_pinned_wherever_it_lies(tmp_path: Path) -> None:
    """Their coordinates differ by the rounding of a file with six decimals."""
    rng = np.random.default_rng(3)
    document, space, path = drawing(tmp_path)
    for k, (x, y) in enumerate(rng.uniform(-100, 100, (40, 2))):
        for layer, shift in ((f"a{k}", -2e-6), (f"b{k}", 2e-6)):
            space.add_circle((x + shift, y), 2, dxfattribs={"layer": layer})
    document.saveas(path)
    joints = kp.load(path).model.tree()["joints"].values()
    assert {(joint["i"], joint["j"]) for joint in joints} == {
        (f"a{k}.P1", f"b{k}.P1") for k in range(40)
    }


def test_what_names_no_point_lies_on_a_sheet_or_is_a_mesh_is_listed(tmp_path: Path) -> None:
    document, space, path = drawing(tmp_path)
    space.add_circle((0, 0), 2, dxfattribs={"layer": "a"})
    document.paperspace().add_circle((9, 0), 2, dxfattribs={"layer": "a"})
    for text, place in (("A", (0, 0)), ("B", (0, 0)), ("far", (5, 5))):
        space.add_text(text, dxfattribs={"layer": "a", "insert": place})
    mesh = space.add_polymesh((3, 3), dxfattribs={"layer": "a"})
    mesh.close(True, True)
    document.saveas(path)
    case = kp.load(path)
    assert case.model.tree()["bodies"]["a"]["points"] == {"A": [0, 0]}
    for told, times in (("on a sheet", 1), ("name of no point", 2), ("mesh", 1)):
        assert sum(told in text for text in case.unread) == times, told


def test_lost_lines_of_a_file_are_named(tmp_path: Path) -> None:
    document, space, path = drawing(tmp_path)
    attributes = {"layer": "a"}
    space.add_lwpolyline([(0, 0), (9, 0), (9, 9), (0, 9)], close=True, dxfattribs=attributes)
    space.add_circle((3, 4), 2, dxfattribs=attributes)
    document.saveas(path)
    text = path.read_text()
    kp.load(path)
    for lost, message in (
        ("  0\nEOF\n", "no end, EOF"),
        (" 20\n9.0\n", "LWPOLYLINE: a coordinate is missing"),
        (" 10\n3.0\n", "CIRCLE: a coordinate is missing"),
    ):
        assert lost in text
        path.write_text(text.replace(lost, "", 1))
        with pytest.raises(kp.FileError, match=message):
            kp.load(path)


def test_a_large_drawing_is_read_quickly(tmp_path: Path) -> None:
    """Points and texts of one layer at many places."""
    n = 20_000
    parts = ["0\nSECTION\n2\nENTITIES"]
    for k in range(n):
        parts.append(f"0\nPOINT\n8\na\n10\n{k}\n20\n1\n0\nTEXT\n8\na\n10\n{k}\n20\n1\n1\nA")
    path = tmp_path / "large.dxf"
    path.write_text("\n".join([*parts, "0\nENDSEC\n0\nEOF\n"]))
    began = time.perf_counter()
    points = kp.load(path).model.tree()["bodies"]["a"]["points"]
    assert time.perf_counter() - began < 5
    assert len(points) == n


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e3])
@pytest.mark.parametrize(
    "names", [("a/b", "a:b"), ("0", "x"), ("Ground", "z"), ("A", "a"), ("ground ", "y")]
)
def test_bodies_whose_names_are_alike_in_a_file_keep_their_layers(
    tmp_path: Path, names: tuple[str, str], size: float
) -> None:
    m = kp.Model("two")
    m.ground.points(O=(size / 3, size / 7))
    for name in names:
        m.bar(name, mass=1, length=size, ends=("O", "P"))
    m.revolute("J", "ground.O", f"{names[0]}.O")
    m.revolute("K", f"{names[0]}.P", f"{names[1]}.P")
    start = kp.assemble(m, {f"{names[0]}.angle": 0.4, f"{names[1]}.angle": -1.0})
    case = kp.load(kp.write_dxf(start, tmp_path / "out.dxf"))
    tree = case.model.tree()
    assert case.unread == () and len(tree["bodies"]) == 3 and len(tree["joints"]) == 2
    assert tree["bodies"]["ground"]["points"]["O"] == pytest.approx([size / 3, size / 7], rel=1e-14)
    found = list(points_of(case).values())
    for name in names:
        for point in ("O", "P"):
            place = [start[f"{name}.{point}.{axis}"] for axis in "xy"]
            assert min(np.hypot(*(place - other)) for other in found) < 1e-12 * size
