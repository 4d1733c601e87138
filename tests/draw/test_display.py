"""The display list shows the mechanism that there is, by the symbols of its physics."""

import json
import re
from collections.abc import Iterator
from typing import Any

import kempe as kp
import numpy as np
import pytest
from draw.mechanisms import moving, pendulum, point_pendulum, slider_crank, sprung
from house.places import PACKAGE, ROOT
from kempe import _core
from kempe.draw import items
from kempe.draw.display import display
from kempe.draw.frame import Frame, frame_items, frame_view
from kempe.draw.geometry import placed
from kempe.draw.painter import Painting
from kempe.draw.placing import View, hatching, place

Item = dict[str, Any]
SCHEMA = json.loads((PACKAGE / "draw" / "assets" / "scene.schema.json").read_text("utf-8"))
MARKS = SCHEMA["$defs"]["symbol"]["properties"]["mark"]["enum"]
#: Symbols that turn on a pin where an end of theirs is on ground.
PINNED = ("pin", "rod", "spring", "dashpot", "cylinder", "drive_cylinder")
EXAMPLES = ("four_bar", "slider_crank", "six_bar", "squeezer", "pendulum")


@pytest.fixture(scope="module", params=EXAMPLES)
def example(request: pytest.FixtureRequest) -> kp.State:
    return kp.load(ROOT / "examples" / f"{request.param}.toml").start()


def poses_of(scene: dict[str, Any], k: int = 0) -> np.ndarray:
    return np.array([[0.0] * 3, *scene["frames"]["poses"][k]])


def of(found: list[Item], name: str) -> list[Item]:
    return [item for item in found if item["of"] == name]


def at(scene: dict[str, Any], view: View, symbol: dict[str, Any], k: int) -> np.ndarray:
    """Where the point of a symbol on body i (0) or j (1) is, points of print."""
    return view.points(placed(poses_of(scene)[symbol["bodies"][k]], symbol["points"][k]))


def springs(**coefficients: float) -> list[Item]:
    """The display list of a block on a spring-damper and a disc on a rotational one."""
    m = kp.Model("springs")
    m.ground.points(O=(0, 0), Q=(2, 1))
    m.body("disc", mass=1, inertia=1, points={"P": (0, 0)})
    m.body("block", mass=1, inertia=1, points={"P": (0, 0)})
    m.revolute("pin", "ground.O", "disc.P")
    m.spring_damper("line", "ground.Q", "block.P", **coefficients)
    m.torsion_spring("turn", "ground", "disc", **coefficients)
    start = kp.assemble(m, set={"disc.angle": 0, "block.x": 1, "block.y": 3, "block.angle": 0})
    shown = kp.scene(start)
    return display(shown, frame_view(shown))


def rows(found: list[Item]) -> int:
    return max((len(item["points"]) for item in found if item["kind"] == "line"), default=0)


# --- symbols follow the physics -------------------------------------------------------------------


def test_every_symbol_is_where_its_points_are(example: kp.State) -> None:
    scene = kp.scene(example)
    view, poses = frame_view(scene), poses_of(scene)
    found = display(scene, view)
    for symbol in scene["symbols"]:
        own = [item for item in of(found, symbol["element"]) if item["kind"] == "fill"]
        middles = [place(item, poses, view).mean(axis=0) for item in own]
        frames = [place({**item, "points": [[0.0] * 4]}, poses, view)[0] for item in own]
        wanted = at(scene, view, symbol, 1)
        if symbol["mark"] in ("pin", "slide"):
            assert any(np.abs(middle - wanted).max() < 1e-9 for middle in middles) or not own
        if symbol["mark"] in ("torque_arrow", "drive_turn"):
            assert any(np.abs(frame - wanted).max() < 1e-12 for frame in frames)


def test_the_ends_of_a_spring_and_of_a_dashpot_are_its_points() -> None:
    scene = kp.scene(sprung())
    view, poses = frame_view(scene), poses_of(scene)
    for mark in ("spring", "dashpot"):
        symbol = next(one for one in scene["symbols"] if one["mark"] == mark)
        alone = display({**scene, "symbols": [symbol]}, view, labels=False)
        lines = [one for one in of(alone, "s") if one["kind"] == "line"]
        points = np.vstack([place(one, poses, view) for one in lines])
        for k in (0, 1):
            gap = np.hypot(*(points - at(scene, view, symbol, k)).T).min()
            assert gap < 1e-12 * np.abs(points).max()


def test_a_spring_beside_its_dashpot_ends_at_its_points_too() -> None:
    scene = kp.scene(sprung())
    view, poses = frame_view(scene), poses_of(scene)
    lines = [one for one in of(display(scene, view), "s") if one["kind"] == "line"]
    points = np.vstack([place(one, poses, view) for one in lines if one["colour"] == "force"])
    for k in (0, 1):
        gap = np.hypot(*(points - at(scene, view, scene["symbols"][1], k)).T).min()
        assert gap < 1e-12 * np.abs(points).max()
    across = [one["points"] for one in lines if one["frame"]["type"] == "line"]
    sides = {np.sign(np.mean([row[3] for row in rows])) for rows in across if len(rows) > 3}
    assert sides == {1.0, -1.0}  # the coil to one side, the cup to the other


def test_what_is_zero_is_not_drawn() -> None:
    """A coil has many corners, a dashpot few; a spiral is in a frame that winds."""
    spring, damper = springs(stiffness=2.0), springs(damping=3.0)
    both, none = springs(stiffness=2.0, damping=3.0), springs()
    assert rows(of(spring, "line")) > 18
    assert rows([one for one in of(damper, "line") if one["frame"]["type"] == "line"]) == 4
    assert len(of(both, "line")) > len(of(spring, "line"))
    wound = [[one["frame"]["type"] == "twist" for one in of(f, "turn")] for f in (spring, damper)]
    assert any(wound[0])
    assert not any(wound[1])
    assert of(damper, "turn")
    assert not of(none, "line")
    assert not of(none, "turn")


def test_a_slide_has_rails_along_its_axis_and_no_pin() -> None:
    scene = kp.scene(slider_crank())
    view, poses = frame_view(scene), poses_of(scene)
    own = of(frame_items(scene), "guide")
    rails = [one for one in own if one["kind"] == "line" and one["hatch"]]
    assert sorted(one["hatch"] for one in rails) == [-1, 1]
    for rail in rails:
        begin, end = place(rail, poses, view)
        along = (end - begin) / np.hypot(*(end - begin))
        np.testing.assert_allclose(along, [np.cos(0.3), np.sin(0.3)], atol=1e-12)
    assert not [one for one in own if one["layer"] == items.PIN]
    block = next(one for one in own if one["kind"] == "fill")
    edges = place(block, poses, view)
    side = (edges[1] - edges[0]) / np.hypot(*(edges[1] - edges[0]))
    turned = scene["frames"]["poses"][0][2][2] + 0.1
    np.testing.assert_allclose(side, [np.cos(turned), np.sin(turned)], atol=1e-12)


def test_rails_on_a_moving_body_are_not_hatched() -> None:
    m = kp.Model("cart on an arm")
    m.ground.points(O=(0, 0))
    m.bar("arm", mass=1, length=1, ends=("O", "E"))
    m.body("cart", mass=1, inertia=1, points={"P": (0, 0)})
    m.revolute("O", "ground.O", "arm.O")
    m.translational("slide", "arm.E", "cart.P")
    start = kp.assemble(m, set={"arm.angle": 0.3, "cart.x": 0.2})
    own = of(frame_items(kp.scene(start)), "slide")
    rails = [one for one in own if one["layer"] == items.GROUND]
    assert [(one["colour"], one["hatch"]) for one in rails] == [("body 1", 0), ("body 1", 0)]


def test_ground_is_hatched_once_under_each_pin_on_it(example: kp.State) -> None:
    scene = kp.scene(example)
    view, poses = frame_view(scene), poses_of(scene)
    hatched = [one for one in frame_items(scene) if one.get("hatch")]
    supports = [one for one in hatched if not np.any(np.array(one["points"])[:, :2])]
    bases = {tuple(np.round(place(one, poses, view).mean(axis=0), 5)) for one in supports}
    pivots = {
        tuple(np.round(at(scene, view, symbol, k) - [0.0, 12.0], 5))
        for symbol in scene["symbols"]
        for k in (0, 1)
        if symbol["bodies"][k] == 0 and symbol["mark"] in PINNED
    }
    assert bases == pivots
    assert len(bases) == len(supports)


def test_a_rod_reaches_from_point_to_point_with_a_pin_at_each() -> None:
    scene = kp.scene(point_pendulum())
    view, poses = frame_view(scene), poses_of(scene)
    own = of(frame_items(scene), "rod")
    (symbol,) = scene["symbols"]
    ends = [at(scene, view, symbol, k) for k in (0, 1)]
    (bar,) = (one for one in own if one["frame"]["type"] == "line" and one["kind"] == "line")
    np.testing.assert_allclose(place(bar, poses, view), ends, atol=1e-10)
    pins = [one for one in own if one["kind"] == "fill" and one["layer"] == items.PIN]
    assert len(pins) == 2


def test_drives_and_torques_have_arrows() -> None:
    driven = frame_items(kp.scene(kp.load(ROOT / "examples" / "six_bar.toml").start()))
    assert {"line", "fill", "text"} <= {one["kind"] for one in of(driven, "motor")}
    assert {one["colour"] for one in of(driven, "motor")} == {"drive"}
    turned = frame_items(kp.scene(kp.load(ROOT / "examples" / "squeezer.toml").start()))
    assert {one["colour"] for one in of(turned, "motor")} == {"force"}
    m = kp.Model("lift")
    m.body("box", mass=1, inertia=1, points={"P": (0, 0)})
    m.coordinate_driver("up", "box.y", value="t")
    lifted = kp.scene(kp.assemble(m, set={"box.x": 0, "box.angle": 1}))
    shaft = next(one for one in of(frame_items(lifted), "up") if one["kind"] == "line")
    begin, end = place(shaft, poses_of(lifted), frame_view(lifted))
    np.testing.assert_allclose((end - begin) / np.hypot(*(end - begin)), [0, 1], atol=1e-12)


@pytest.mark.parametrize("mark", MARKS)
def test_every_word_of_the_vocabulary_can_be_drawn(mark: str) -> None:
    symbol = {
        "element": "e",
        "mark": mark,
        "bodies": [0, 1],
        "points": [[0.0, 0.0], [0.5, 0.0]],
        "axes": [0.0, 0.0],
        "radii": [0.2, 0.3],
        "teeth": {"module": 0.03, "phase": 0.0},
        "reach": [0.0, 1.0],
        "turning": [0.0, 1.0],
        "sense": 1,
    }
    ground, body = (
        {"name": str(k), "number": k, "kind": "body", "center": [0, 0], "points": []}
        | {"outline": [[0, 0]] * k, "drawn": [], "curves": []}
        for k in (0, 1)
    )
    scene = {"title": "", "gravity": [0, 0], "bounds": [0, 0, 1, 1], "bodies": [ground, body]}
    scene |= {"length": {"unit": "m", "metres": 1}, "joints": [], "symbols": [symbol]}
    scene |= {"frames": {"poses": [[[0.0, 0.0, 0.0]]]}}
    view, poses = View(np.zeros(2), 100.0, np.array([500.0, 300.0])), np.zeros((2, 3))
    found = of(display(scene, view, labels=False), "e")
    assert found
    assert json.loads(json.dumps(found)) == found
    for item in found:
        assert np.isfinite(place(item, poses, view)).all()
    if mark == "circle":
        radii = np.hypot(*(place(found[0], poses, view) - [50.0, 0.0]).T)
        np.testing.assert_allclose(radii, 30.0)


def test_a_spiral_winds_as_its_bodies_turn() -> None:
    scene = kp.scene(moving())
    view = frame_view(scene)
    spiral = next(i for i in of(frame_items(scene), "spring") if i["frame"]["type"] == "twist")
    turns = []
    for k in (0, 60):
        around = place(spiral, poses_of(scene, k), view)
        middle = place({**spiral, "points": [[0.0] * 4]}, poses_of(scene, k), view)
        angle = np.unwrap(np.arctan2(*(around - middle).T[::-1]))
        turns.append(angle[-1] - angle[0])
    rocker = [poses_of(scene, k)[3, 2] for k in (0, 60)]
    assert turns[1] - turns[0] == pytest.approx(rocker[1] - rocker[0], abs=1e-6)


# --- names ----------------------------------------------------------------------------------------


def texts(found: list[Item]) -> list[str]:
    return [one["text"] for one in found if one["kind"] == "text"]


def test_names_of_one_place_are_written_once() -> None:
    shown = texts(frame_items(kp.scene(slider_crank())))
    assert sorted(shown) == ["1", "2", "3", "A", "B · guide", "O"]
    plate = texts(frame_items(kp.scene(pendulum())))
    assert sorted(plate) == ["1", "Q", "R", "S", "hinge"]


def test_names_do_not_lie_on_each_other(example: kp.State) -> None:
    scene = kp.scene(example)
    frame = Frame(scene)
    frame.pixels(0)
    boxes = [(a.get_text(), a.get_window_extent()) for _, a in frame.painting.texts]
    for k, (one, a) in enumerate(boxes):
        for other, b in boxes[:k]:
            across = min(a.x1, b.x1) - max(a.x0, b.x0)
            up = min(a.y1, b.y1) - max(a.y0, b.y0)
            assert min(across, up) <= 1.0, (one, other)


# --- painters -------------------------------------------------------------------------------------


def test_frame_and_page_paint_the_same_items(example: kp.State, tmp_path: Any) -> None:
    scene = kp.scene(example)
    text = kp.player(example, tmp_path / "a.html").read_text(encoding="utf-8")
    told = json.loads(re.findall(r'id="scene">(.*?)</script>', text)[0])["display"]
    painted = Frame(scene).painting.items
    assert len(told) == len(painted)
    for one, other in zip(told, painted, strict=True):
        assert one["of"] == other["of"]
        assert one["frame"]["type"] == other["frame"]["type"]
        np.testing.assert_allclose(one["points"], other["points"], rtol=1e-8, atol=1e-12)


def test_a_figure_has_the_symbols_of_the_frame(example: kp.State) -> None:
    from matplotlib import pyplot

    figure = kp.plot.configuration(example)
    painting = next(one for one in figure.get_children() if isinstance(one, Painting))
    pyplot.close("all")

    def symbols_of(found: list[Item]) -> Iterator[str]:
        for item in found:
            if item["kind"] != "text" and item["layer"] < items.NUMBER:
                yield json.dumps(item, sort_keys=True)

    assert sorted(symbols_of(painting.items)) == sorted(symbols_of(frame_items(kp.scene(example))))


def test_hatching_is_on_its_side() -> None:
    strokes = hatching(np.array([[0.0, 0.0], [40.0, 0.0]]), -1)
    assert len(strokes) == 10
    assert (strokes[:, 0, 1] == 0.0).all()
    assert (strokes[:, 1, 1] < 0.0).all()
    assert (hatching(np.array([[0.0, 0.0], [40.0, 0.0]]), 1)[:, 1, 1] > 0.0).all()


def test_no_name_of_an_element_type_is_in_a_drawing() -> None:
    catalogue = json.loads(_core.catalogue())
    names = [one["name"] for group in ("joints", "drivers", "forces") for one in catalogue[group]]
    #: Words that are quantities of views too: ``view.torque(on=…)``, ``quantity="torque"``.
    common = {"torque", "force"}
    for part in ("draw", "plot", "sweeps/studies"):
        for path in (PACKAGE / part).rglob("*"):
            if path.suffix not in (".py", ".js"):
                continue
            text = path.read_text(encoding="utf-8")
            for name in set(names) - common:
                assert not re.search(rf"""["'`]{name}["'`]""", text), (path.name, name)


@pytest.mark.parametrize(
    ("name", "moving"), [("bistable_switch", "shuttle"), ("leaf_spring_guide", "stage")]
)
def test_a_beam_is_one_body_in_the_numbers(name: str, moving: str) -> None:
    shown = kp.scene(kp.load(ROOT / "examples" / f"{name}.toml").start())
    made = display(shown, frame_view(shown))
    found = {item["of"]: item["text"] for item in made if item.get("role") == "number"}
    assert found == {"left": "1", "right": "2", moving: "3"}
