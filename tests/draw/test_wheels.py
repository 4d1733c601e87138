"""Drawn gears mesh, racks and belts touch their wheels, and cylinders hold their pistons."""

from itertools import pairwise
from typing import Any

import kempe as kp
import numpy as np
import pytest
from house.places import ROOT
from kempe.draw.frame import Frame, frame_items, frame_view
from kempe.draw.geometry import placed
from kempe.draw.placing import hatching, place

Scene = dict[str, Any]


def scene_of(name: str, frames: int = 7) -> Scene:
    (solution,) = kp.load(ROOT / "examples" / f"{name}.toml").run().values()
    return kp.scene(solution, frames=frames)


def poses_of(scene: Scene, k: int) -> np.ndarray:
    return np.array([[0.0] * 3, *scene["frames"]["poses"][k]])


def teeth(scene: Scene, symbol: dict[str, Any], k: int) -> np.ndarray:
    """Places of the middles of the teeth of a wheel on its pitch circle, m."""
    radius, told = symbol["radii"][1], symbol["teeth"]
    count = 2 * radius / told["module"]
    assert count == pytest.approx(round(count), abs=1e-6)
    angle = told["phase"] + 2 * np.pi * np.arange(round(count)) / round(count)
    at = symbol["points"][1] + radius * np.column_stack([np.cos(angle), np.sin(angle)])
    return placed(poses_of(scene, k)[symbol["bodies"][1]], at)


def nearest(found: np.ndarray, place: np.ndarray) -> float:
    return float(np.hypot(*(found - place).T).min())


def train() -> kp.Solution:
    """An external pair with an offset, and a rack on the second wheel; radii without a module."""
    m = kp.Model("train")
    m.ground.points(A=(0, 0), B=(0.25, 0), R=(0.25, 0.15))
    for name, at in (("small", "A"), ("large", "B")):
        m.body(name, mass=1, inertia=1, points={at: (0, 0)})
        m.revolute(at, f"ground.{at}", f"{name}.{at}")
    m.body("bar", mass=1, inertia=1, points={"P": (0, 0)})
    m.gear("mesh", "small.A", "large.B", radii=(0.1, 0.15), offset=0.0123)
    m.translational("guide", "ground.R", "bar.P")
    m.rack("rack", "bar.P", "large.B", radius=-0.15, offset=0.004)
    start = kp.assemble(m, set={"small.angle": 0.7, "small.omega": 3})
    return kp.dynamics(m, start, t_end=1, output_step=0.1)


def meshing(scene: Scene, element: str) -> list[float]:
    """At each frame, how far the tooth of one wheel at the pitch point is from a gap of the other.

    In pitches; 0 is perfect. Both are measured along the pitch circles.
    """
    one, other = (s for s in scene["symbols"] if s["element"] == element)
    found = []
    for k in range(len(scene["frames"]["t"])):
        poses = poses_of(scene, k)
        centres = [placed(poses[s["bodies"][1]], s["points"][1]) for s in (one, other)]
        away = centres[1] - centres[0]
        inside = "toothed_ring" in (one["mark"], other["mark"])
        sign = -1.0 if inside and one["radii"][1] < other["radii"][1] else 1.0
        point = centres[0] + sign * one["radii"][1] * away / np.hypot(*away)
        tangent = np.array([-away[1], away[0]]) / np.hypot(*away)
        pitch = np.pi * one["teeth"]["module"]
        shares = []
        for symbol, centre in zip((one, other), centres, strict=True):
            turns = np.arctan2(*(teeth(scene, symbol, k) - centre).T[::-1])
            arm = point - centre
            off = np.angle(np.exp(1j * (turns - np.arctan2(arm[1], arm[0]))))
            sense = np.sign(arm[0] * tangent[1] - arm[1] * tangent[0])
            shares.append(sense * symbol["radii"][1] * off[np.abs(off).argmin()] / pitch)
        apart = shares[0] - shares[1] - 0.5
        found.append(abs(apart - round(apart)))
    return found


def test_the_teeth_of_gears_are_in_the_gaps_of_the_others() -> None:
    scene = kp.scene(train(), frames=9)
    assert max(meshing(scene, "mesh")) < 1e-6
    planetary = scene_of("planetary_gear")
    assert max(meshing(planetary, "inner") + meshing(planetary, "outer")) < 1e-6


def test_wheels_have_the_teeth_of_the_model() -> None:
    scene = scene_of("planetary_gear", 2)
    marks = [(s["mark"], s) for s in scene["symbols"] if s["teeth"]]
    counts = {mark: len(teeth(scene, symbol, 0)) for mark, symbol in marks}
    assert counts["toothed_ring"] == 52
    assert {len(teeth(scene, s, 0)) for mark, s in marks if mark == "toothed_wheel"} == {20, 16}


def test_a_rack_meshes_with_its_pinion_while_it_moves() -> None:
    scene = kp.scene(train(), frames=9)
    wheel, rack = (s for s in scene["symbols"] if s["element"] == "rack")
    assert rack["teeth"]["module"] == wheel["teeth"]["module"]
    pitch = np.pi * rack["teeth"]["module"]
    for k in range(9):
        poses = poses_of(scene, k)
        centre = placed(poses[wheel["bodies"][1]], wheel["points"][1])
        start = placed(poses[rack["bodies"][0]], rack["points"][0])
        tooth = teeth(scene, wheel, k)
        top = tooth[
            tooth[:, 1].argmax()
        ]  # the rack is above the wheel, its axis points to the right
        along_rack = np.arctan2(top[0] - centre[0], top[1] - centre[1]) * 0.15 + centre[0]
        gap = (along_rack - start[0] - rack["teeth"]["phase"]) / pitch - 0.5
        assert gap == pytest.approx(round(gap), abs=1e-6)


@pytest.mark.parametrize("crossed", [False, True])
def test_a_belt_wraps_its_wheels(crossed: bool) -> None:
    m = kp.Model("belt")
    m.ground.points(A=(0, 0), B=(0.5, 0.2))
    for name, at in (("small", "A"), ("large", "B")):
        m.body(name, mass=1, inertia=1, points={at: (0, 0)})
        m.revolute(at, f"ground.{at}", f"{name}.{at}")
    m.belt("belt", "small.A", "large.B", radii=(0.1, 0.2), crossed=crossed)
    scene = kp.scene(kp.assemble(m))
    view = frame_view(scene)
    (belt,) = (
        one for one in frame_items(scene) if one["of"] == "belt" and one.get("width", 0.0) > 1.5
    )
    rim = np.array([view.plane(at) for at in place(belt, poses_of(scene, 0), view)])
    gaps = [np.hypot(*(rim - c).T) - r for c, r in (((0, 0), 0.1), ((0.5, 0.2), 0.2))]
    np.testing.assert_allclose(np.minimum(*np.abs(gaps)), 0.0, atol=1e-9)
    steps = np.hypot(*np.diff(np.vstack([rim, rim[:1]]), axis=0).T)
    straight = np.sqrt(0.29 - (0.1 + 0.2 if crossed else 0.2 - 0.1) ** 2)
    np.testing.assert_allclose(np.sort(steps)[-2:], straight, rtol=1e-9)


def test_a_driven_length_is_a_cylinder_whose_piston_stays_in_it() -> None:
    scene = scene_of("excavator", 30)
    marks = {s["element"]: s for s in scene["symbols"] if s["mark"] == "drive_cylinder"}
    assert set(marks) == {"boom_cylinder", "arm_cylinder"}
    for name, symbol in marks.items():
        found = [item for item in frame_items(scene) if item["of"] == name]
        walls = next(item for item in found if item.get("width") == 1.2)
        barrel = max(row[0] for row in walls["points"])
        rod = max(item["points"][-1][0] for item in found if item.get("width") == 2.4)
        disc = next(item for item in found if item["kind"] == "line" and item["width"] == 3.0)
        assert disc["frame"]["type"] == "ray"
        view = frame_view(scene)
        for k in range(30):
            poses = poses_of(scene, k)
            ends = [placed(poses[symbol["bodies"][e]], symbol["points"][e]) for e in (0, 1)]
            piston = view.plane(place(disc, poses, view).mean(axis=0))
            assert np.hypot(*(piston - ends[1])) == pytest.approx(rod)
            place_in = np.hypot(*(piston - ends[0])) / barrel
            assert 0.05 < place_in < 0.95
        assert barrel < symbol["reach"][0]


def test_a_long_stroke_is_drawn_in_shares() -> None:
    m = kp.Model("lift")
    m.ground.points(O=(0, 0))
    m.body("cage", mass=1, inertia=1, points={"P": (0, 0)})
    m.translational("guide", "ground.O", "cage.P", axes=("90*deg", "90*deg"))
    m.distance("jack", "ground.O", "cage.P", length="1 + 4*t")
    solution = kp.dynamics(m, kp.assemble(m, guess={"cage.y": 1}), t_end=1, output_step=0.1)
    own = [one for one in frame_items(kp.scene(solution)) if one["of"] == "jack"]
    assert {one["frame"]["type"] for one in own if one["kind"] == "line"} >= {"line"}
    assert not [one for one in own if one["frame"]["type"] == "ray"]


def test_hatching_goes_on_around_corners() -> None:
    corners = 100.0 * np.column_stack([np.cos(a := np.linspace(0, 2 * np.pi, 200)), np.sin(a)])
    strokes = hatching(corners, -1)
    length = sum(float(np.hypot(*(b - a))) for a, b in pairwise(corners))
    assert len(strokes) == int((length - 3.0) // 4.0) + 1
    np.testing.assert_allclose(np.hypot(*strokes[:, 0].T), 100.0, atol=0.02)
    assert (np.hypot(*strokes[:, 1].T) > 102.0).all()


def test_torques_around_one_place_have_arrows_side_by_side() -> None:
    scene = scene_of("planetary_gear", 2)
    poses, view = poses_of(scene, 0), frame_view(scene)
    radii = []
    for name in ("motor", "load"):
        shaft = next(i for i in frame_items(scene) if i["of"] == name and i["kind"] == "line")
        centre = place({**shaft, "points": [[0.0] * 4]}, poses, view)[0]
        radii.append(float(np.hypot(*(place(shaft, poses, view) - centre).T).mean()))
    assert abs(radii[0] - radii[1]) > 5.0


def test_a_link_in_a_slot_is_painted_over_it() -> None:
    found = frame_items(scene_of("quick_return", 2))
    order = [(item["of"], item["kind"]) for item in found]
    assert (
        order.index(("lever", "line"))
        < order.index(("slot", "fill"))
        < order.index(("crank", "line"))
    )


def test_the_support_of_a_shaft_is_painted_over_its_cam() -> None:
    found = frame_items(scene_of("cam_roller", 2))
    cam = next(k for k, item in enumerate(found) if item["of"] == "cam" and item["kind"] == "fill")
    hatched = [k for k, item in enumerate(found) if item.get("hatch") and item["of"] == "shaft"]
    assert hatched
    assert min(hatched) > cam


def test_a_reference_point_of_a_slide_on_ground_has_a_dot() -> None:
    scene = scene_of("garage_door", 2)
    at = next(p["at"] for p in scene["bodies"][0]["points"] if p["name"] == "R")
    dots = [i for i in frame_items(scene) if i["of"] == "ground" and i["kind"] == "fill"]
    assert at in [dot["frame"]["at"] for dot in dots]


def test_names_stay_clear_of_the_title() -> None:
    scene = scene_of("quick_return", 2)
    frame = Frame(scene)
    frame.pixels(0)
    title = frame.axes.texts[0].get_window_extent()
    assert "Quick" in frame.axes.texts[0].get_text()
    for _, text in frame.painting.texts:
        box = text.get_window_extent()
        assert not (box.overlaps(title)), text.get_text()


def test_the_arrow_of_a_force_has_its_direction() -> None:
    scene = scene_of("engine", 20)
    (symbol,) = (one for one in scene["symbols"] if one["element"] == "gas")
    assert abs(symbol["axes"][0]) == pytest.approx(np.pi)  # the gas pushes the piston to the left
    shaft = next(i for i in frame_items(scene) if i["of"] == "gas" and i["kind"] == "line")
    begin, end = place(shaft, poses_of(scene, 3), frame_view(scene))
    np.testing.assert_allclose((end - begin) / np.hypot(*(end - begin)), [-1, 0], atol=1e-12)


@pytest.mark.parametrize(("name", "sense"), [("motor", 1), ("load", -1)])
def test_the_arrow_of_a_torque_has_its_sense(name: str, sense: int) -> None:
    scene = scene_of("planetary_gear", 5)
    head = next(i for i in frame_items(scene) if i["of"] == name and i["kind"] == "fill")
    poses, view = poses_of(scene, 0), frame_view(scene)
    tip, *base = place(head, poses, view)
    centre = place({**head, "points": [[0.0] * 4]}, poses, view)[0]
    arm, along = tip - centre, tip - np.mean(base, axis=0)
    assert np.sign(arm[0] * along[1] - arm[1] * along[0]) == sense
