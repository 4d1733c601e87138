"""Dimension lines and gravity: where they are drawn, by hand from the places of the bars."""

import math
from typing import Any

import kempe as kp
import numpy as np
import pytest
from kempe.draw.display import Display
from kempe.draw.items import line, print_points, upright
from kempe.draw.placing import View, place
from kempe.model.drawing import measured

#: The view of most tests: 400 × 300 points of print, the origin in the lower left corner.
SIZE = np.array([400.0, 300.0])
HEAD = 6.0


def bars(
    *ends: tuple[float, float, float, float], scale: float = 100.0, ground: bool = False
) -> Display:
    """Bars from (x, y) of a length and an angle, each on a pin of ground if asked."""
    m = kp.Model(gravity=(0, -9.81))
    set_: dict[str, float] = {}
    for k, (x, y, length, angle) in enumerate(ends):
        m.bar(f"b{k}", mass=1, length=length, ends=("A", "B"))
        if ground:
            m.ground.points(**{f"A{k}": (x, y)})
            m.revolute(f"A{k}", f"ground.A{k}", f"b{k}.A")
        else:
            set_ |= {f"b{k}.x": x, f"b{k}.y": y}
        set_[f"b{k}.angle"] = angle
    state = kp.assemble(m, set=set_)
    if not ground:  # the frame of a bar has its origin in the middle
        for k, (x, y, *_) in enumerate(ends):
            shift = state[f"b{k}"].point("A").position - [x, y]
            set_ |= {f"b{k}.x": x - shift[0], f"b{k}.y": y - shift[1]}
        state = kp.assemble(m, set=set_)
    return Display(kp.scene(state), View(np.zeros(2), scale, SIZE))


def drawn(made: Display, of: str) -> dict[str, list[np.ndarray]]:
    """The lines, heads and texts of a dimension, points of print."""
    found: dict[str, list[np.ndarray]] = {"line": [], "fill": [], "text": []}
    for item in made.finish():
        if item["of"] == of:
            found[item["kind"]].append(place(item, made.first, made.view))
    return found


def obstacle(made: Display, *points: tuple[float, float]) -> None:
    made.add([line("obstacle", upright(0), print_points(points), "ink", 0.0)])


def check(made: Display, of: str, begin: Any, end: Any, aside: float) -> None:
    """A dimension line at a distance to the left of its object, with arrows that point outwards."""
    begin, end = np.array(begin, float), np.array(end, float)
    along = (end - begin) / math.dist(begin, end)
    left = np.array([-along[1], along[0]])
    found = drawn(made, of)
    here, there = begin + aside * left, end + aside * left
    one, other, measure = found["line"]
    np.testing.assert_allclose(one, [begin, begin + 1.15 * aside * left], atol=1e-9)
    np.testing.assert_allclose(other, [end, end + 1.15 * aside * left], atol=1e-9)
    np.testing.assert_allclose(measure, [here, there], atol=1e-9)
    for tip, outward, head in zip((here, there), (-along, along), found["fill"], strict=True):
        np.testing.assert_allclose(head[0], tip, atol=1e-9)
        np.testing.assert_allclose(head[1:].mean(axis=0), tip - HEAD * outward, atol=1e-9)
    np.testing.assert_allclose(found["text"], [[(here + there) / 2.0]], atol=1e-9)


def test_a_length_is_beside_its_bar_away_from_the_middle() -> None:
    """100 points long and 50 below the middle of the view, which is at (200, 150)."""
    made = bars((1.0, 1.0, 1.0, 0.0))
    made.add_dimensions()
    check(made, "length 1 m", (100, 100), (200, 100), -20.0)
    above = bars((1.0, 2.0, 1.0, 0.0))
    above.add_dimensions()
    check(above, "length 1 m", (100, 200), (200, 200), 20.0)
    # Upright and left of the middle: left of the bar, which is left of its direction.
    upright_ = bars((1.0, 1.0, 0.8, math.pi / 2.0))
    upright_.add_dimensions()
    check(upright_, "length 0.8 m", (100, 100), (100, 180), 20.0)
    slanted = bars((2.5, 1.0, 1.0, math.pi / 4.0))
    slanted.add_dimensions()
    far = 100.0 * math.sqrt(0.5)
    check(slanted, "length 1 m", (250, 100), (250 + far, 100 + far), -20.0)


@pytest.mark.parametrize(
    ("taken", "aside"),
    [
        ([], -20.0),
        ([80], 20.0),
        ([80, 120], -32.0),
        ([80, 120, 68], 32.0),
        ([80, 120, 68, 132], -44.0),
        ([80, 120, 68, 132, 56], 44.0),
    ],
)
@pytest.mark.parametrize("y", [1.0, 2.0])
def test_a_length_goes_where_the_lines_leave_room(
    taken: list[float], aside: float, y: float
) -> None:
    """Away from the middle first: downwards below it, upwards above it."""
    made, outwards = bars((1.0, y, 1.0, 0.0)), 1.0 if y < 1.5 else -1.0
    for height in taken:
        there = 100.0 * y + outwards * (height - 100.0)
        obstacle(made, (110.0, there), (120.0, there))
    made.add_dimensions()
    check(made, "length 1 m", (100, 100 * y), (200, 100 * y), outwards * aside)
    assert {i["width"] for i in made.finish() if i["of"] == "length 1 m" and "width" in i} == {0.6}


@pytest.mark.parametrize("angle", [0.0, 2.0, -0.7])
def test_arrows_of_a_short_length_point_inwards_and_its_text_is_beside(angle: float) -> None:
    """10 points are too few for "100 mm" and two heads of 6 points."""
    made = bars((2.0, 1.0, 0.1, angle))
    made.add_dimensions()
    along = np.array([math.cos(angle), math.sin(angle)])
    left = np.array([-along[1], along[0]])
    found = drawn(made, "length 100 mm")
    begin = np.array([200.0, 100.0])
    aside = float((found["line"][2][0] - begin) @ left)
    assert abs(aside) == pytest.approx(20.0)
    here, there = begin + aside * left, begin + 10.0 * along + aside * left
    np.testing.assert_allclose(found["line"][2], [here - 10.8 * along, there + 10.8 * along])
    for tip, inward, head in zip((here, there), (along, -along), found["fill"], strict=True):
        np.testing.assert_allclose(head[0], tip)
        np.testing.assert_allclose(head[1:].mean(axis=0), tip - HEAD * inward)
    width = measured("100 mm", 8.0)[0]
    expected = there + (10.8 + width / 2.0 + 2.0) * along
    np.testing.assert_allclose(found["text"], [[expected]])


@pytest.mark.parametrize(("more", "inside"), [(0.01, True), (-0.01, False)])
def test_a_text_is_between_arrows_that_leave_room_for_it(more: float, inside: bool) -> None:
    width = measured("0.5 m", 8.0)[0]
    made = bars((0.5, 0.5, 0.5, 0.0), scale=(width + 2.0 * HEAD + more) / 0.5)
    made.add_dimensions()
    found = drawn(made, "length 0.5 m")
    begin, end = found["line"][2]
    assert (begin[0] < found["text"][0][0, 0] < end[0]) == inside
    assert (math.dist(begin, end) == pytest.approx(width + 2.0 * HEAD + more)) == inside


def test_the_distance_of_two_pins_on_ground_is_measured() -> None:
    two = bars((1.0, 1.0, 0.5, 1.5), (3.0, 1.0, 0.7, 1.6), ground=True)
    two.add_dimensions()
    words = [item["text"] for item in two.finish() if item["kind"] == "text"]
    assert words == ["0.5 m", "0.7 m", "2 m"]
    check(two, "length 2 m", (100, 100), (300, 100), -20.0)
    one_pin = bars((1.0, 1.0, 0.5, 1.5), (1.0, 1.0, 0.7, 0.6), ground=True)
    one_pin.add_dimensions()
    assert [i["text"] for i in one_pin.finish() if i["kind"] == "text"] == ["0.5 m", "0.7 m"]
    three = bars(*((float(k), 1.0, 0.5, 1.5) for k in range(3)), ground=True)
    three.add_dimensions()
    assert [i["text"] for i in three.finish() if i["kind"] == "text"] == ["0.5 m"] * 3


@pytest.mark.parametrize(("count", "shown"), [(7, 7), (8, 0)])
def test_more_than_seven_lengths_are_left_out(count: int, shown: int) -> None:
    made = bars(*((0.4 * k, 1.0, 0.5 + 0.01 * k, 1.5) for k in range(count)))
    made.add_dimensions()
    assert len([item for item in made.finish() if item["kind"] == "text"]) == shown


@pytest.mark.parametrize(("gap", "shown"), [(0.6, ["0.5 m"] * 6), (0.1, ["6 × 0.5 m"])])
def test_one_line_stands_for_equal_lengths_without_room(gap: float, shown: list[str]) -> None:
    made = bars(*((0.3 + gap * k, 1.0, 0.5, 1.5) for k in range(6)))
    made.add_dimensions()
    texts = [item["text"] for item in made.finish() if item["kind"] == "text"]
    assert texts == shown


@pytest.mark.parametrize("x", [0.02, 1.0, 3.9])
def test_the_text_beside_a_short_length_stays_in_the_view(x: float) -> None:
    made = bars((x, 1.5, 0.05, 0.0))
    made.add_dimensions()
    (text,) = drawn(made, "length 50 mm")["text"]
    half = measured("50 mm", 8.0)[0] / 2.0
    assert half <= text[0, 0] <= SIZE[0] - half


#: The centres of the corners, 1.6 and 1.05 lengths of 30 points from the edges.
CORNERS = {
    "upper right": (352.0, 268.5),
    "upper left": (48.0, 268.5),
    "lower right": (352.0, 31.5),
    "lower left": (48.0, 31.5),
}


@pytest.mark.parametrize("free", CORNERS)
def test_gravity_is_in_the_first_free_corner(free: str) -> None:
    made = bars((0.0, 0.0, 0.01, 0.0))
    for x, y in list(CORNERS.values())[: list(CORNERS).index(free)]:
        obstacle(made, (x - 5, y), (x + 5, y))
    made.add_gravity()
    (shaft,) = drawn(made, "gravity")["line"]
    np.testing.assert_allclose(shaft.mean(axis=0), np.add(CORNERS[free], [0.0, 2.25]))


@pytest.mark.parametrize("gravity", [(0.0, -9.81), (3.0, 4.0)])
def test_the_arrow_of_gravity_points_along_it(gravity: tuple[float, float]) -> None:
    made = bars((1.0, 1.0, 1.0, 0.0))
    made.scene["gravity"] = gravity
    made.add_gravity()
    size = math.hypot(*gravity)
    along = np.array(gravity) / size
    centre = np.array(CORNERS["upper right"])
    found = drawn(made, "gravity")
    np.testing.assert_allclose(found["line"], [[centre - 15 * along, centre + 10.5 * along]])
    (head,) = found["fill"]
    np.testing.assert_allclose(head[0], centre + 15.0 * along)
    np.testing.assert_allclose(head[1:].mean(axis=0), centre + 8.0 * along)
    (name,) = (item for item in made.finish() if item["kind"] == "text")
    assert name["text"] == f"g = {size:g} m/s²"


def test_without_gravity_there_is_no_arrow() -> None:
    made = bars((1.0, 1.0, 1.0, 0.0))
    made.scene["gravity"] = (0.0, 0.0)
    made.add_gravity()
    assert made.finish() == []
