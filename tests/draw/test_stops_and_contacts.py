"""Where stops and contacts are drawn, and bodies that a curve encloses."""

from __future__ import annotations

from typing import Any

import kempe as kp
import numpy as np
import pytest
from kempe.draw.display import display
from kempe.draw.frame import frame_view


def door(angle: float) -> kp.Model:
    m = kp.Model("door")
    m.ground.points(O=(0.3, 0.2))
    m.body("door", mass=1, inertia=1, points={"O": (0, 0), "S": (0.5, 0)})
    m.revolute("hinge", "ground.O", "door.O")
    m.stop("stop", "door.S.y", lower=0.1, stiffness=100)
    m.coordinate_driver("motor", "door.angle", value=f"{angle} - t")
    return m


def symbol_of(scene: dict[str, Any], element: str) -> dict[str, Any]:
    (found,) = (one for one in scene["symbols"] if one["element"] == element)
    return dict(found)


@pytest.mark.parametrize("angle", [1.0, 0.5])
def test_a_stop_is_beside_the_place_where_its_point_comes_nearest(angle: float) -> None:
    m = door(angle)
    sol = kp.dynamics(m, kp.assemble(m), t_end=angle - 0.1, output_step=0.01)
    scene = kp.scene(sol)
    stop = symbol_of(scene, "stop")
    assert stop["mark"] == "shift_stop"
    np.testing.assert_allclose(stop["points"][0], [0.3 + 0.5 * np.cos(0.1), 0.1], rtol=0, atol=1e-6)
    items = display(scene, frame_view(scene))
    (name,) = (one for one in items if one["kind"] == "text" and one["text"] == "stop")
    assert name["frame"]["at"] == stop["points"][0]
    dots = [one for one in items if one["of"] == "door" and one["frame"].get("at") == [0.5, 0.0]]
    assert dots  # the stop does not stand for its point


@pytest.mark.parametrize(("limit", "sense"), [("upper", 1), ("lower", -1)])
def test_a_stop_of_a_slide_stands_at_its_limit(limit: str, sense: int) -> None:
    m = kp.Model("slide")
    m.ground.points(O=(0.3, 0.2))
    m.body("block", mass=1, inertia=1, points={"P": (0, 0)})
    m.translational("slide", "ground.O", "block.P", axes=(0.6, 0.6))
    m.stop("stop", "slide.displacement", stiffness=100, **{limit: sense * 0.7})
    stop = symbol_of(kp.scene(kp.assemble(m, set={"slide.displacement": 0.1})), "stop")
    expected = np.array([0.3, 0.2]) + sense * 0.7 * np.array([np.cos(0.6), np.sin(0.6)])
    np.testing.assert_allclose(stop["points"][0], expected, rtol=0, atol=1e-6)


def enclosed(point: tuple[float, float]) -> dict[str, Any]:
    m = kp.Model("wheel")
    m.ground.points(O=(0, 0))
    points = {"O": (0, 0), "P": point}
    m.body("wheel", mass=1, inertia=1, points=points, curves={"rim": {"circle": (0, 0, 0.1)}})
    m.body("ball", mass=1, inertia=1, points={"C": (0, 0)})
    m.revolute("axle", "ground.O", "wheel.O")
    m.contact("touch", "ball.C", "wheel.rim", radius=0.02, stiffness=1e5)
    return kp.scene(kp.assemble(m, set={"ball.x": 0.2, "ball.y": 0, "wheel.angle": 0}))


def test_the_circle_of_a_contact_is_a_part_of_its_body() -> None:
    scene = enclosed((0.05, 0))
    touch = symbol_of(scene, "touch")
    assert (touch["mark"], touch["bodies"], touch["radii"]) == ("round", [2, 1], [0.02, 0.0])
    items = display(scene, frame_view(scene))
    (area,) = (one for one in items if one["of"] == "touch" and one["kind"] == "fill")
    assert area["colour"] == "body 2"
    radii = np.hypot(*np.array(area["points"])[:, :2].T)
    np.testing.assert_allclose(radii, 0.02)
    # the contact names the point, once
    assert [one["text"] for one in items if one.get("text") in ("touch", "C")] == ["touch"]


@pytest.mark.parametrize(("point", "plate"), [((0.05, 0), True), ((0.2, 0), False)])
def test_a_curve_around_all_points_is_the_whole_body(
    point: tuple[float, float], plate: bool
) -> None:
    scene = enclosed(point)
    items = display(scene, frame_view(scene))
    links = [one for one in items if one["of"] == "wheel" and one.get("width", 0) > 8]
    assert bool(links) is not plate
    if plate:
        (number,) = (one for one in items if one.get("text") == "1")
        assert np.hypot(*number["frame"]["at"]) < 0.1  # in the rim


def test_a_curve_of_pieces_has_more_points() -> None:
    m = kp.Model("rims")
    bent = "0.1 - 0.02*max(cos(u), 0)^4"
    curves = {"smooth": {"polar": "0.1 + 0.01*cos(u)"}, "bent": {"polar": bent}}
    m.body("wheel", mass=1, inertia=1, curves=curves)
    found = m.bodies["wheel"].curves
    assert [len(found[name][0]) for name in curves] == [240, 720]
