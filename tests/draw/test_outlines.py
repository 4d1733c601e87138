"""Outlines of bodies and of shapes: the same geometry in scenes and on paper, and no number."""

from __future__ import annotations

import itertools
from typing import Any

import kempe as kp
import matplotlib.pyplot as plt
import numpy as np
import pytest
from kempe.draw.frame import Frame
from kempe.draw.items import BODY, GROUND

PATH = "M 0 0 L 0.2 0 0.2 0.1 0 0.1 Z"


def drawn(outline: Any, **parameters: float) -> list[tuple[str, np.ndarray]]:
    m = kp.Model("drawn", parameters=parameters)
    m.body("b", mass=1, inertia=1, outline=outline)
    return [(form, np.array(points)) for form, points in m.compile().bodies["b"].drawn]


def path(text: str) -> list[tuple[str, np.ndarray]]:
    return drawn({"path": text})


def area(ring: np.ndarray) -> float:
    return 0.5 * float(
        np.sum(ring[:, 0] * np.roll(ring[:, 1], -1) - np.roll(ring[:, 0], -1) * ring[:, 1])
    )


def test_polygons_and_circles_follow_parameters() -> None:
    (polygon,) = drawn([(0, 0), ("R", 0), (0, "2*R")], R=0.3)
    assert polygon[0] == "area"
    np.testing.assert_allclose(polygon[1], [(0, 0), (0.3, 0), (0, 0.6)])
    ((form, circle),) = drawn({"circle": (1, "R", "R")}, R=0.3)
    assert form == "area"
    np.testing.assert_allclose(np.hypot(*(circle - [1, 0.3]).T), 0.3, rtol=1e-14)
    assert area(circle) == pytest.approx(np.pi * 0.09, rel=1e-3)


@pytest.mark.parametrize(
    "text",
    [
        "M 0 0 L 2 0 L 2 1 L 0 1 Z",
        "m0,0 2,0 0,1 -2,0z",
        "M0 0H2V1H0Z",
        "m 0 0 h 2 v 1 h -2 z",
        "M0-0L2.0.0 2 1e0 0 1z",
        " M 0 0 2 0 2 1 , 0 1 Z ",
    ],
)
def test_lines_of_a_path_absolute_and_relative(text: str) -> None:
    assert [form for form, _ in path(text)] == ["area"]
    np.testing.assert_allclose(path(text)[0][1], [(0, 0), (2, 0), (2, 1), (0, 1)], atol=1e-15)


def bezier(points: Any, s: np.ndarray) -> np.ndarray:
    """De Casteljau's construction."""
    points = [np.asarray(p, dtype=float)[None] for p in points]
    while len(points) > 1:
        points = [a + s[:, None] * (b - a) for a, b in itertools.pairwise(points)]
    return points[0]


@pytest.mark.parametrize(
    ("text", "curves"),
    [
        ("M 0 0 C 0 1 2 1 2 0", [[(0, 0), (0, 1), (2, 1), (2, 0)]]),
        ("M 0 0 l 1 1 c 0 1 2 1 2 0", [None, [(1, 1), (1, 2), (3, 2), (3, 1)]]),
        (
            "M 0 0 C 0 1 2 1 2 0 S 4 -3 4 0",
            [[(0, 0), (0, 1), (2, 1), (2, 0)], [(2, 0), (2, -1), (4, -3), (4, 0)]],
        ),
        ("M 0 0 L 1 0 s 1 1 2 0", [None, [(1, 0), (1, 0), (2, 1), (3, 0)]]),
        ("M 0 0 Q 1 2 2 0", [[(0, 0), (1, 2), (2, 0)]]),
        ("M 0 0 q 1 2 2 0 t 2 0", [[(0, 0), (1, 2), (2, 0)], [(2, 0), (3, -2), (4, 0)]]),
        ("M 0 0 T 2 2", [[(0, 0), (0, 0), (2, 2)]]),
    ],
)
def test_bezier_curves_of_a_path(text: str, curves: list[Any]) -> None:
    ((form, found),) = path(text)
    assert form == "line"
    s = np.linspace(0, 1, 25)
    wanted = [np.zeros((1, 2))]
    for curve in curves:
        after = curves[-1][0]
        wanted.append(np.array([after]) if curve is None else bezier(curve, s)[1:])
    np.testing.assert_allclose(found, np.vstack(wanted), atol=1e-14)


@pytest.mark.parametrize("large", [0, 1])
@pytest.mark.parametrize("sweep", [0, 1])
def test_arcs_of_a_path(large: int, sweep: int) -> None:
    """On the ellipse, on the right side, of the right length."""
    turn, radii, ends = np.radians(30), np.array([3.0, 1.5]), np.array([[1.0, 1.0], [3.0, 2.0]])
    ((_, found),) = path(f"M 1 1 A 3 1.5 30 {large} {sweep} 3 2")
    ((_, tight),) = path(f"M1 1a3 1.5 30 {large}{sweep}2 1")
    np.testing.assert_allclose(tight, found, atol=1e-14)
    np.testing.assert_allclose(found[[0, -1]], ends, atol=1e-14)
    back = np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
    on_circle = found @ back.T / radii
    # the centre of the unit circle through three points, by perpendicular bisectors
    a, b, c = on_circle[0], on_circle[len(found) // 2], on_circle[-1]
    rows, values = np.array([b - a, c - a]), np.array([b @ b - a @ a, c @ c - a @ a]) / 2
    centre = np.linalg.solve(rows, values)
    np.testing.assert_allclose(np.hypot(*(on_circle - centre).T), 1.0, rtol=1e-10)
    angle = np.unwrap(np.arctan2(*(on_circle - centre).T[::-1]))
    assert np.sign(angle[-1] - angle[0]) == (1 if sweep else -1)
    assert (abs(angle[-1] - angle[0]) > np.pi) == bool(large)


def test_an_arc_that_is_too_small_is_enlarged_and_flat_ones_are_lines() -> None:
    ((_, found),) = path("M 0 0 A 0.1 0.1 0 0 1 2 0")
    np.testing.assert_allclose(np.hypot(*(found - [1, 0]).T), 1.0, rtol=1e-12)
    ((_, found),) = path("M 0 0 A 0 1 0 0 1 2 0")
    np.testing.assert_allclose(found, [(0, 0), (2, 0)])


def test_parts_of_a_path_start_where_the_last_one_did() -> None:
    first, second, third = path("M 1 1 h 1 v 1 z l -1 0 M 5 5 l 1 1")
    assert [first[0], second[0], third[0]] == ["area", "line", "line"]
    np.testing.assert_allclose(second[1], [(1, 1), (0, 1)])
    np.testing.assert_allclose(third[1], [(5, 5), (6, 6)])


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "draws nothing"),
        ("M 1 1", "draws nothing"),
        ("L 1 1", r"starts with 'L'; must start with M \(character 1\)"),
        ("M 0 0 L 1", r"ends before its last command has all numbers \(character 10\)"),
        ("M 0 0 X 1 1", r"'X' is not a command.*\(character 7\)"),
        ("M 0 0 L 1 1 Z 2 2", r"'2' is not a command.*\(character 15\)"),
        ("M 0 0 L 1 b", r"'b' is not a number \(character 11\)"),
        ("M 0 0 L 1 1e999", r"'1e999' is not a number"),
        ("M 0 0 A 1 1 0 2 1 1 1", r"a flag of an arc must be 0 or 1 \(character 15\)"),
        ("M 0 0 L ½ 1", r"'½' is not a number \(character 9\)"),
    ],
)
def test_bad_paths_are_refused_with_their_place(text: str, words: str) -> None:
    with pytest.raises(kp.ModelError, match=f"bodies.b.outline.path: {words}"):
        path(text)


@pytest.mark.parametrize(
    ("outline", "words"),
    [
        ([(0, 0), (1, 0)], "a list of 2; must be at least three points"),
        ({"circle": (0, 0)}, "a list of 2; must be a list of three numbers"),
        ({"circle": (0, 0, -1)}, "its radius is -1 m; must be > 0"),
        ({"circle": (0, 0, 1), "path": PATH}, "a table of 2; must have either circle or path"),
        ({"square": 1}, "unknown field 'square' of an outline"),
        ({}, "must have either circle or path"),
    ],
)
def test_faulty_outlines_are_refused(outline: Any, words: str) -> None:
    with pytest.raises(kp.ModelError, match=words):
        drawn(outline)
    with pytest.raises(kp.ModelError):
        kp.Model("no").body("b", mass=1, inertia=1, outline="M 0 0")


def winding(rings: list[np.ndarray], at: np.ndarray) -> int:
    """How many times closed lines go around a point, counter-clockwise."""
    turns = 0.0
    for ring in rings:
        angles = np.arctan2(*(np.vstack([ring, ring[:1]]) - at).T[::-1])
        turns += float(np.diff(np.unwrap(angles)).sum())
    return round(turns / (2.0 * np.pi))


def rotor(outline: bool) -> kp.Model:
    m = kp.Model("rotor", gravity=(0, -9.81))
    m.ground.points(A=(0, 0))
    if outline:
        m.ground.outline([(-0.3, -0.5), (0.3, -0.5), (0.3, -0.6)])
    given: dict[str, Any] = {"outline": {"path": PATH + "M 0.05 0.05 h 0.1"}} if outline else {}
    m.bar("a", mass=1, length=0.4, ends=("A", "B"), **given)
    m.point_mass("p", mass=1, **({"outline": {"circle": (0, 0, 0.05)}} if outline else {}))
    m.revolute("A", "ground.A", "a.A")
    m.revolute("B", "a.B", "p.P")
    return m


def test_an_outline_changes_no_number() -> None:
    start = {"a.angle": 0.3}
    plain, outlined = (
        kp.dynamics(m, kp.assemble(m, set=start), t_end=1, output_step=0.05)
        for m in (rotor(False), rotor(True))
    )
    np.testing.assert_array_equal(plain.q, outlined.q)
    np.testing.assert_array_equal(plain["A"].force(on="a"), outlined["A"].force(on="a"))
    one, other = kp.scene(plain), kp.scene(outlined)
    assert one["frames"] == other["frames"]
    assert [body["outline"] for body in one["bodies"]] == [b["outline"] for b in other["bodies"]]


def painted(scene: dict[str, Any]) -> dict[str, list[dict[str, Any]]]:
    """The items of the layers of bodies and of ground, by the body."""
    frame = Frame(scene, 60)
    frame.put(0)
    found: dict[str, list[dict[str, Any]]] = {}
    for artist in frame.figure.axes[0].get_children():
        for item in getattr(artist, "items", []):
            if item["layer"] in (BODY, GROUND) and item["kind"] in ("line", "fill"):
                found.setdefault(item["of"], []).append(item)
    plt.close(frame.figure)
    return found


def test_the_outline_is_drawn_in_place_of_the_link_and_belongs_to_the_area() -> None:
    m = rotor(True)
    scene = kp.scene(kp.assemble(m, set={"a.angle": 0}))
    assert scene["bounds"] == pytest.approx([-0.3, -0.6, 0.45, 0.1])
    items = painted(scene)
    edge, whole, line = items["a"]
    corners = [[0, 0], [0.2, 0], [0.2, 0.1], [0, 0.1]]
    assert [row[:2] for row in edge["points"]] == pytest.approx(np.array(corners))
    assert (edge["kind"], whole["kind"], line["kind"]) == ("line", "fill", "line")
    assert (edge["closed"], line["closed"]) == (True, False)
    assert edge["frame"]["body"] == 1
    assert {item["layer"] for item in items["ground"]} == {GROUND}
    assert {item["colour"] for item in items["ground"]} == {"ground"}
    plain = painted(kp.scene(kp.assemble(rotor(False), set={"a.angle": 0})))
    assert [item["kind"] for item in plain["a"]] == ["line", "line"]
    assert "ground" not in plain


def test_shapes_are_drawn_as_they_are() -> None:
    """Rods as bars, holes as holes; where shapes overlap there is one area."""
    m = kp.Model("wheel")
    m.body(
        "b",
        points={"P": (0, 0)},
        shapes=[
            {"type": "polygon", "points": [(-1, -1), (-1, 1), (1, 1), (1, -1)], "mass": 9},
            {"type": "ring", "inner": 0.5, "outer": 2, "mass": 9, "at": (3, 0)},
            {"type": "plate", "width": 0.4, "height": 0.2, "mass": -1, "angle": np.pi / 2},
            {"type": "rod", "length": 2, "mass": 1, "at": (0, 3), "angle": np.pi / 2},
            {"type": "rod", "length": 2, "mass": -0.1},
        ],
    )
    forms = m.compile().bodies["b"].drawn
    assert [form for form, _ in forms] == ["area", "area", "area", "area", "rod"]
    np.testing.assert_allclose(forms[-1][1], [(0, 2), (0, 4)], atol=1e-15)
    rings = [np.array(points) for form, points in forms if form == "area"]
    assert [area(ring) for ring in rings] == pytest.approx(
        [4, np.pi * 4, -np.pi / 4, -0.08], rel=1e-3
    )
    inside = {
        (0.9, 0.9): 1,
        (0, 0): 0,
        (3, 0): 0,
        (4.5, 0): 1,
        (0.95, 0): 1,
        (1.2, 0): 1,
        (9, 9): 0,
    }
    items = painted(kp.scene(kp.assemble(m, set={"b.x": 0, "b.y": 0, "b.angle": 0})))["b"]
    (whole,) = (item for item in items if item["kind"] == "fill")
    one = np.array(whole["points"])[:, :2]
    for at, wanted in inside.items():
        assert winding(rings, np.array(at)) == wanted, at
        assert winding([one], np.array(at)) == wanted, at
    for at in np.random.default_rng(1).uniform((-1.5, -2.5), (5.5, 2.5), (500, 2)):
        assert winding(rings, at) == winding([one], at), at
