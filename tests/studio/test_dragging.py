"""A drag of a point changes the numbers that determine it, in every example."""

import math
from pathlib import Path

import pytest
from sizes import FULL
from studio.window import Opener, Studio

EXAMPLES = Path(__file__).parents[2] / "examples"
#: The pointer moves by this, px: along no link and no axis.
DRAG = (17, -23)
#: All points of all examples take minutes.
EACH = 1 if FULL else 16
#: Points whose drag takes ten seconds.
LONG = {"cam_roller": "follower.P", "geneva_drive": "wheel.N1"}


def points(one: Studio) -> list[tuple[str, float, float]]:
    """A point for each place of the drawing, with its coordinates."""
    names = []
    for name, body in one.tree()["bodies"].items():
        beam = body.get("type") == "beam"
        own = [*body.get("points", {}), *body.get("ends", ["A", "B"] if beam else [])]
        own += [] if beam else [*body.get("through", {})]  # the shape of a beam
        names += [f"{name}.{point}" for point in own or ["P"]]  # a point mass has one point
    values = one.call(
        "names => Promise.all(names.map(name => kempe.quantity(name).then(x => x.value)))",
        [f"{name}.{axis}" for name in names for axis in "xy"],
    )
    found: dict[tuple[float, float], tuple[str, float, float]] = {}
    for name, x, y in zip(names, values[::2], values[1::2], strict=True):
        found.setdefault((round(x, 9), round(y, 9)), (name, x, y))
    return list(found.values())


def note(one: Studio) -> str:
    found = one.page.locator("#note")
    return found.inner_text() if found.count() else ""


def drag(one: Studio, begin: tuple[float, float], by: tuple[float, float]) -> None:
    """Drag a place of the window by pixels."""
    x, y = begin
    one.page.mouse.move(x, y)
    one.settle()
    one.page.mouse.down()
    for share in (0.3, 0.7, 1.0):
        one.page.mouse.move(x + share * by[0], y + share * by[1])
    one.settle()
    one.page.mouse.up()
    one.settle()


def followed(one: Studio, text: str, point: str, at: tuple[float, float]) -> bool | None:
    """Whether a point follows a drag, at least along the way of its number; None with a lock."""
    one.load(text)
    begin = one.screen(*at)
    one.page.mouse.move(*begin)
    one.settle()
    if one.page.locator("#note.lock").count():
        return None
    for by in (DRAG, (-DRAG[1], DRAG[0])):  # the first may be across the way of the point
        drag(one, begin, by)
        now = one.screen(one.quantity(f"{point}.x"), one.quantity(f"{point}.y"))
        if math.dist(begin, now) > 3:  # px
            return True
    return False


def test_nine_of_ten_points_follow_and_the_others_have_a_lock(studio: Opener) -> None:
    one = studio()
    results = []
    count = 0
    for path in sorted(EXAMPLES.glob("*.toml")):
        text = path.read_text(encoding="utf-8")
        one.load(text)
        for point, x, y in points(one):
            count += 1
            if count % EACH == 0 and (FULL or LONG.get(path.stem) != point):
                results.append((path.stem, point, followed(one, text, point, (x, y))))
    assert len(results) > (200 if FULL else 12)
    assert [one for one in results if one[2] is False] == []
    assert sum(one[2] is True for one in results) >= 0.9 * len(results)


def flagship(one: Studio, point: str, by: tuple[float, float]) -> dict[str, object]:
    """The parameters and the start of the flagship after a drag."""
    drag(one, one.screen(one.quantity(f"{point}.x"), one.quantity(f"{point}.y")), by)
    tree = one.tree()
    return {**tree["parameters"], "angle": tree["start"]["set"]["crank.angle"]}


def test_a_drag_along_a_length_changes_this_length_only(studio: Opener) -> None:
    one = studio()
    text = one.toml()
    before = one.tree()
    angle = math.radians(70)
    # a hand does not move along a line: 3 px aside
    aside = (3 * math.sin(angle), 3 * math.cos(angle))
    along = (30 * math.cos(angle), -30 * math.sin(angle))
    now = flagship(one, "crank.B", (along[0] + aside[0], along[1] + aside[1]))
    assert "L1 = " in note(one)
    scale = math.dist(one.screen(0, 0), one.screen(1, 0))
    assert now["L1"] == pytest.approx(10 + 30 / scale, abs=2 / scale)
    assert now == {**before["parameters"], "L1": now["L1"], "angle": "70*deg"}
    assert len(str(now["L1"])) < 6  # no digits that nobody can see
    one.page.keyboard.press("Control+z")
    one.settle()
    assert one.toml() == text  # one step


def test_a_point_follows_in_both_directions_and_other_choices_are_offered(studio: Opener) -> None:
    one = studio()
    one.page.mouse.move(*one.screen(one.quantity("coupler.C.x"), one.quantity("coupler.C.y")))
    one.settle()
    assert note(one) == "A drag changes L2, L3."  # before the drag
    x, y = one.screen(one.quantity("coupler.C.x"), one.quantity("coupler.C.y"))
    now = flagship(one, "coupler.C", DRAG)
    end = one.screen(one.quantity("coupler.C.x"), one.quantity("coupler.C.y"))
    assert math.dist(end, (x + DRAG[0], y + DRAG[1])) < 3
    assert (now["L1"], now["G"], now["angle"]) == (10, 20, "70*deg")
    assert now["L2"] != 26
    assert now["L3"] != 18
    one.page.locator("#note button").filter(has_text="L3").click()
    one.settle()
    tree = one.tree()
    assert tree["parameters"]["L2"] == 26
    assert tree["parameters"]["L3"] != 18
    one.page.keyboard.press("Control+z")
    one.settle()
    assert one.tree()["parameters"]["L3"] == 18


def test_a_point_goes_to_the_nearest_place_that_its_mechanism_allows(studio: Opener) -> None:
    one = studio()
    one.load((EXAMPLES / "slider_crank.toml").read_text(encoding="utf-8"))
    x, y = one.screen(one.quantity("rod.B.x"), one.quantity("rod.B.y"))
    drag(one, (x, y), (30, -40))
    end = one.screen(one.quantity("rod.B.x"), one.quantity("rod.B.y"))
    assert end == (pytest.approx(x + 30, abs=2), pytest.approx(y, abs=0.1))
    assert one.tree()["parameters"]["r"] == 0.1
    # far beyond what can be assembled: the nearest place that closes
    drag(one, end, (-600, 0))
    assert one.state() is not None
    assert one.page.locator("#tab-text").inner_text() == "Text"
    one.wait("!document.querySelector('.standing .problem')")


def test_a_point_that_joints_determine_has_a_lock_before_the_drag(studio: Opener) -> None:
    one = studio()
    one.page.locator("#sheet").focus()
    one.page.locator(".contents button").filter(has_text="crank").first.click()
    one.page.locator(".locks label").filter(has_text="lengths").click()
    one.page.locator(".locks label").filter(has_text="angle").click()
    text = one.toml()
    at = one.screen(one.quantity("crank.B.x"), one.quantity("crank.B.y"))
    one.page.mouse.move(*at)
    one.settle()
    assert one.page.locator("#note.lock").count() == 1
    assert "crank.B cannot be dragged" in note(one)
    drag(one, at, DRAG)
    assert one.toml() == text
