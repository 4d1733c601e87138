"""Drawings of the mechanism: what is painted, compared with coordinates known by hand."""

import math
from itertools import pairwise
from typing import Any

import kempe as kp
import numpy as np
import pytest
from draw.mechanisms import slider_crank, sprung
from kempe import plot
from kempe.draw.frame import Frame
from kempe.draw.painter import Painting
from kempe.draw.placing import hatching, place
from matplotlib.axes import Axes
from plot.clipping import clipped_lengths
from plot.paintings import lines_of, links, painting

GROUND = {
    "flagship": [(0.0, 0.0), (20.0, 0.0)],
    "six_bar": [(0.0, 0.0), (0.3, 0.0), (0.65, 0.0)],
    "crank": [(0.0, 0.0)],
}


def corners(axes: Axes, item: dict[str, Any]) -> np.ndarray:
    """The points of an item in the units of the axes."""
    found = painting(axes)
    dots = place(item, found.poses, found.view()) * axes.figure.dpi / 72.0
    return axes.transData.inverted().transform(dots)


def hatched(axes: Axes) -> list[tuple[dict[str, Any], np.ndarray]]:
    """Hatched lines and their ends, in the units of the axes."""
    found = [item for item in painting(axes).items if item.get("hatch")]
    return [(item, corners(axes, item)) for item in found]


@pytest.mark.parametrize("name", GROUND)
def test_ground_is_drawn_under_its_pins(name: str, request: pytest.FixtureRequest) -> None:
    solution = request.getfixturevalue(name)
    for axes in (plot.mechanism(solution), plot.configuration(solution, float(solution.t[-1]))):
        lines = [ends for item, ends in hatched(axes) if abs(ends[0, 1] - ends[-1, 1]) < 1e-9]
        for x, y in GROUND[name]:
            under = [ends for ends in lines if ends.mean(axis=0)[0] == pytest.approx(x, abs=1e-9)]
            assert any(ends[0, 1] < y for ends in under), (x, y)


def test_strokes_of_ground_are_on_its_side() -> None:
    strokes = hatching(np.array([[0.0, 0.0], [20.0, 0.0]]), -1)
    assert len(strokes) >= 4
    assert (strokes[:, 0, 1] == 0.0).all()
    assert (strokes[:, 1, 1] < 0.0).all()


@pytest.mark.parametrize("name", GROUND)
def test_hatching_of_a_pin_is_below_its_line(name: str, request: pytest.FixtureRequest) -> None:
    level = [
        (item, ends)
        for item, ends in hatched(plot.mechanism(request.getfixturevalue(name)))
        if item["of"] != "guide"
    ]
    assert len(level) >= len(GROUND[name])
    for item, ends in level:
        strokes = hatching(ends[[0, -1]] * [1e3, 1e3], int(item["hatch"]))
        assert (strokes[:, 1, 1] < 1e3 * ends[0, 1]).all()


def test_a_slider_is_turned_as_its_rail() -> None:
    """A rail at 0.3 rad in ground and 0.1 rad in the slider: the block is drawn along the rail."""
    axes = plot.configuration(slider_crank())
    items = [i for i in painting(axes).items if i["of"] == "guide" and i["kind"] == "fill"]
    block = corners(axes, items[0])
    sides = np.diff(np.vstack([block, block[:1]]), axis=0)
    longest = sides[np.hypot(*sides.T).argmax()]
    assert math.atan2(longest[1], longest[0]) % math.pi == pytest.approx(0.3, abs=1e-6)


def test_links_of_a_six_bar_reach_from_pin_to_pin(six_bar: kp.Solution) -> None:
    """Crank upright: B = (0, 0.1) m; C and F follow from two circles each."""
    axes = plot.configuration(six_bar)
    drawn = [axes.transData.inverted().transform(ends) for _, ends in links(axes)]
    B, D, G = np.array([0.0, 0.1]), np.array([0.3, 0.0]), np.array([0.65, 0.0])
    C = meeting(B, 0.3, D, 0.2)
    angle = math.atan2(*(C - D)[::-1])
    c, s = math.cos(angle), math.sin(angle)
    E = D + np.array([0.12 * c + 0.15 * s, 0.12 * s - 0.15 * c])
    F = meeting(E, 0.28, G, 0.2)
    for one, other in (((0, 0), B), (B, C), (E, F), (F, G)):
        found = [ends for ends in drawn if len(ends) == 2]
        both = ([one, other], [other, one])
        assert any(np.allclose(ends, way, atol=1e-6) for ends in found for way in both)
    plate = next(ends for ends in drawn if len(ends) > 2)
    for corner in (C, D, E):
        assert np.hypot(*(plate - corner).T).min() < 1e-6


def meeting(one: np.ndarray, r: float, other: np.ndarray, s: float) -> np.ndarray:
    """The upper one of the two points at distances r and s."""
    d = float(np.hypot(*(other - one)))
    along = (d * d + r * r - s * s) / (2 * d)
    aside = math.sqrt(r * r - along * along)
    u = (other - one) / d
    found = [one + along * u + side * aside * np.array([-u[1], u[0]]) for side in (1, -1)]
    return max(found, key=lambda point: point[1])


def test_rails_have_the_angle_of_the_slide() -> None:
    axes = plot.configuration(slider_crank())
    rails = [ends for item, ends in hatched(axes) if item["of"] == "guide"]
    assert len(rails) == 2
    for ends in rails:
        along = ends[-1] - ends[0]
        assert math.atan2(along[1], along[0]) == pytest.approx(0.3, abs=1e-9)
    middle = (rails[0] + rails[1]).mean(axis=0) / 2.0
    assert middle @ [-math.sin(0.3), math.cos(0.3)] == pytest.approx(0.0, abs=1e-9)


def test_rails_of_a_level_slide_are_level(crank: kp.Solution) -> None:
    for axes in (plot.mechanism(crank), Frame(kp.scene(crank)).axes):
        rails = [ends for item, ends in hatched(axes) if item["of"] == "guide"]
        assert [ends[0, 1] == pytest.approx(ends[-1, 1], abs=1e-9) for ends in rails] == [True] * 2
    # In a frame they reach along the whole stroke, from l - r to l + r.
    assert all(ends[:, 0].min() < 0.2 and ends[:, 0].max() > 0.4 for ends in rails)


@pytest.mark.parametrize("name", ["flagship", "six_bar", "crank", "squeezer"])
def test_the_scale_bar_is_as_long_as_it_says(name: str, request: pytest.FixtureRequest) -> None:
    solution = request.getfixturevalue(name)
    axes = Frame(kp.scene(solution)).axes
    bar = next(line for line in axes.lines if len(line.get_xdata()) == 4)
    texts = [text.get_text() for text in axes.texts]
    words = next(text for text in texts if text.split()[-1] in ("m", "mm"))
    value, unit = words.split()
    metres = float(value) * {"m": 1.0, "mm": 1e-3}[unit]
    assert np.ptp(bar.get_xdata()) == pytest.approx(metres, rel=1e-9)
    # A figure has the same unit, and its axes the same length for it.
    figure = plot.mechanism(solution)
    assert figure.get_xlabel() == f"x / {unit}"
    assert figure.get_ylabel() == f"y / {unit}"


@pytest.mark.parametrize("name", ["flagship", "six_bar", "crank", "squeezer"])
def test_pictures_of_frames_and_figures_agree(name: str, request: pytest.FixtureRequest) -> None:
    """Pins are at the same places, in m, whatever the unit of the axes."""
    solution = request.getfixturevalue(name)
    scene = kp.scene(solution)
    frame, figure = Frame(scene).axes, plot.configuration(solution)
    metres = scene["length"]["metres"]

    def pins(axes: Axes) -> list[np.ndarray]:
        rims = [i for i in painting(axes).items if i["kind"] == "fill" and i["colour"] == "paper"]
        return [corners(axes, item).mean(axis=0) for item in rims if len(item["points"]) == 32]

    there = np.array(pins(figure)) * metres
    for pin in solution.model.joints.values():
        place_ = solution.initial.body(pin.j).at(pin.point_j).position
        assert np.hypot(*(there - place_).T).min() < 1e-6
        assert np.hypot(*(np.array(pins(frame)) - place_).T).min() < 1e-6


def test_lengths_are_those_of_the_mechanism(six_bar: kp.Solution, squeezer: kp.Solution) -> None:
    texts = {text.get_text() for text in plot.mechanism(six_bar).texts}
    assert {"0.1 m", "0.3 m", "0.28 m", "0.2 m", "g = 9.81 m/s²"} <= texts
    assert {"7 mm", "28 mm", "2 × 20 mm"} <= {t.get_text() for t in plot.mechanism(squeezer).texts}


def test_names_of_one_place_are_joined(squeezer: kp.Solution, crank: kp.Solution) -> None:
    for solution, names in ((squeezer, {"E3 · E4 · E6", "A5 · A7"}), (crank, {"B · guide"})):
        for axes in (plot.configuration(solution), Frame(kp.scene(solution)).axes):
            assert names <= {text.get_text() for text in axes.texts}


def test_a_spring_turns_on_a_pin_where_it_ends_on_ground() -> None:
    axes = plot.mechanism(sprung())
    found = [i for i in painting(axes).items if i["of"] == "s" and len(i["points"]) == 32]
    rims = [item for item in found if (item["kind"], item["colour"]) == ("fill", "paper")]
    assert [corners(axes, rim).mean(axis=0) for rim in rims] == [pytest.approx((-1.2, 0.3))]
    under = [ends.mean(axis=0) for item, ends in hatched(axes) if item["of"] == "s"]
    assert [x for x, _ in under] == [pytest.approx(-1.2)]


def test_the_unit_of_length_does_not_depend_on_the_motion() -> None:
    m = kp.Model("arm", gravity=(0, 0))
    m.ground.points(O=(0, 0))
    m.bar("arm", mass=1, length=0.15, ends=("O", "P"))
    m.revolute("O", "ground.O", "arm.O")
    start = kp.assemble(m, set={"arm.angle": 0.0, "arm.omega": 1.0})
    solution = kp.dynamics(m, start, t_end=6.0, output_step=0.1)
    units = {kp.scene(drawn)["length"]["unit"] for drawn in (solution, start, solution.final)}
    assert units == {"mm"}


def test_names_of_a_still_lie_on_no_link(squeezer: kp.Solution) -> None:
    """They are laid out for that instant alone, and those of the motion are hidden meanwhile."""
    scene = kp.scene(squeezer)
    frame = Frame(scene)
    names = {joint["name"] for joint in scene["joints"]}
    frame.put(-1)
    with frame._laid_out_at(-1):
        shown = [a for a in frame.axes.get_children() if isinstance(a, Painting)]
        assert [one.get_visible() for one in shown] == [False, True]
        frame.figure.canvas.draw()
        ends = np.array([pair for _, dots in lines_of(shown[1]) for pair in pairwise(dots)])
        for item, artist in shown[1].texts:
            assert artist.get_visible()
            if set(item["text"].split(" · ")) <= names:
                box = artist.get_window_extent()
                assert clipped_lengths(box.min, box.max, ends).sum() == 0.0, item["text"]
    assert [a for a in frame.axes.get_children() if isinstance(a, Painting)] == [frame.painting]
    assert frame.painting.get_visible()
    assert all(artist.get_visible() for _, artist in frame.painting.texts)


def test_a_gif_has_a_white_background(crank: kp.Solution, tmp_path: Any) -> None:
    from PIL import Image

    path = kp.animate(crank, tmp_path / "a.gif", fps=2)
    with Image.open(path) as gif:
        for k in range(gif.n_frames):
            gif.seek(k)
            picture = np.asarray(gif.convert("RGB"))
            for x, y in ((3, 3), (-3, 3), (-3, -3)):
                assert tuple(picture[y, x]) == (255, 255, 255)
            assert (picture == 255).all(axis=2).mean() > 0.7
