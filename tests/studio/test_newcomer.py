"""What a newcomer stumbles over in a first drawing, by mouse only."""

import re
from pathlib import Path

import numpy as np
import pytest
from studio.hands import Hands
from studio.test_arrows import drawing
from studio.window import Studio

EXAMPLES = Path(__file__).parents[2] / "examples"


@pytest.fixture
def hands(one: Studio) -> Hands:
    return Hands(one)


@pytest.mark.parametrize("mode", ["edit", "move", "live", "read", "design"])
def test_new_shows_the_tools(hands: Hands, mode: str) -> None:
    hands.one.mode(mode)
    hands.new()
    assert hands.one.page.locator("#mode-edit").get_attribute("aria-checked") == "true"
    hands.use("bar", (0.0, 0.0), (0.2, 0.1))
    assert list(hands.one.tree()["bodies"]) == ["ground", "bar1"]


def test_a_spring_at_the_pin_of_a_slider_holds_the_moving_body(hands: Hands) -> None:
    """The guide of the slider has a point of the ground at the same place."""
    hands.new()
    hands.use("ground", (-0.5, 0.0), (0.7, 0.0))
    hands.bars((-0.5, 0.0), (-0.35, 0.2), (-0.35, 0.2), (0.2, 0.0))
    hands.use("slider", (0.2, 0.0), (0.5, 0.0))
    hands.use("spring_damper", (0.2, 0.0), (0.7, 0.0))
    spring = hands.one.tree()["forces"]["spring1"]
    assert {spring["i"].split(".")[0], spring["j"].split(".")[0]} == {"bar2", "ground"}


def test_a_click_beside_a_free_end_takes_the_pivot_of_a_wheel(hands: Hands) -> None:
    hands.new()
    hands.use("ground", (-0.4, 0.0), (0.2, 0.0))
    hands.bars((-0.4, 0.0), (-0.4, 0.15), (0.2, 0.0), (0.2, 0.15))
    hands.use("gear", (-0.4, 0.11), (0.2, 0.11))
    gear = hands.one.tree()["joints"]["gear1"]
    assert [gear["i"], gear["j"]] == ["bar1.A", "bar2.B"]
    assert sum(gear["radii"]) == pytest.approx(0.6)


def test_what_is_deleted_with_a_body_is_named(hands: Hands) -> None:
    hands.new()
    hands.use("ground", (-0.4, -0.2))
    hands.bars((-0.4, -0.2), (-0.3, 0.1), (-0.3, 0.1), (0.3, 0.3))
    hands.use("coordinate_driver", (-0.35, -0.05))
    hands.select((0.0, 0.2))
    hands.key("Delete")
    assert "“bar2” was deleted, with what needs it: B." in hands.one.message()
    hands.select((-0.35, -0.05))
    hands.key("Delete")
    message = hands.one.message()
    assert "“bar1”" in message and "A" in message and "driver1" in message


def lengths_of_slots(picture: str) -> list[float]:
    """The lengths of painted lines around long areas with round ends, px."""
    found = []
    for path in re.findall(r'<path d="([^"]*)"', picture):
        corners = np.array(re.findall(r"(-?[\d.]+) (-?[\d.]+)", path), dtype=float)
        if path.endswith("Z") and len(corners) > 10:
            small, large = sorted(np.ptp(corners, axis=0))
            found += [large] if large > 5 * small else []
    return found


def test_a_slot_is_as_long_as_the_travel_of_its_pin(one: Studio, tmp_path: Path) -> None:
    """The pin of a crank stays in the drawn slot of a yoke over the whole run."""
    one.load((EXAMPLES / "scotch_yoke.toml").read_text(encoding="utf-8"))
    one.mode("read")
    one.wait("!document.querySelector('#run')?.disabled", 30.0)
    one.settle()
    (_, high), (_, low) = one.screen(0.0, 0.08), one.screen(0.0, -0.08)
    assert max(lengths_of_slots(drawing(one, tmp_path)), default=0.0) > low - high


def test_the_first_plot_shows_what_moves(one: Studio) -> None:
    """The yoke does not turn, and its guide does not either."""
    one.load((EXAMPLES / "scotch_yoke.toml").read_text(encoding="utf-8"))
    one.mode("read")
    one.wait("!document.querySelector('#run')?.disabled", 30.0)
    one.wait("!!document.querySelector('.plot')")
    words = one.page.locator(".plot").first.inner_text()
    assert "crank.angle" in words and "yoke.angle" not in words.split("Add a quantity")[0]


def test_a_cantilever_is_drawn_and_its_bending_moment_read(hands: Hands) -> None:
    one = hands.one
    hands.new()
    hands.use("ground", (-0.5, 0.0))
    hands.use("beam", (-0.5, 0.0), (0.5, 0.0))
    beam = one.tree()["bodies"]["beam1"]
    assert beam["ends"] == ["A", "B"] and beam["section"] == {"rectangle": [0.02, 0.02]}
    hands.select((-0.5, 0.0))
    hands.key("Delete")  # the pin, for a weld
    hands.use("weld", (-0.5, 0.0), (-0.5, 0.0))
    hands.use("force", (0.5, 0.0))
    assert one.tree()["forces"]["force1"]["j"] == "beam1.B"
    hands.fill("force", "0; -100")
    hands.read()
    found = one.call("kempe.values(['beam1.bending_moment', 'beam1.B.y'])")
    moment, tip = (row[-1] for row in found["rows"])
    line, stiffness = 7850 * 0.02**2 * 9.81, 210e9 * 0.02**4 / 12
    assert moment == pytest.approx(100.0 + line / 2, rel=2e-3)
    assert tip == pytest.approx(-(100 / 3 + line / 8) / stiffness, rel=5e-3)


def test_no_point_is_added_within_a_beam(hands: Hands) -> None:
    """A beam has points at lengths along it, not in a frame."""
    hands.new()
    hands.use("ground", (-0.5, 0.0))
    hands.use("beam", (-0.5, 0.0), (0.5, 0.0))
    hands.use("bar", (0.5, 0.0), (0.7, 0.2))
    assert hands.one.tree()["joints"]["B"]["i"] == "beam1.B"
    before = hands.one.toml()
    hands.use("force", (0.2, 0.0))
    assert "no point here" in hands.one.message()
    assert hands.one.toml() == before
    hands.select((0.2, 0.0))
    assert hands.one.page.locator("#add-point").count() == 0


def test_a_run_is_in_view_unless_the_view_was_enlarged(one: Studio) -> None:
    def places() -> list[bool]:
        box = one.page.locator("#sheet").bounding_box()
        assert box
        circle = [(0.1, 0.0), (-0.1, 0.0), (0.0, 0.1), (0.0, -0.1), (0.4, 0.0)]
        return [
            0 <= x - box["x"] <= box["width"] and 0 <= y - box["y"] <= box["height"]
            for x, y in (one.screen(*place) for place in circle)
        ]

    one.load((EXAMPLES / "slider_crank.toml").read_text(encoding="utf-8"))
    one.mode("read")
    one.wait("!document.querySelector('#run')?.disabled", 30.0)
    one.settle()
    assert all(places())
    one.mode("edit")
    for _ in range(4):
        one.page.keyboard.press("+")
    one.mode("read")
    one.wait("!document.querySelector('#run')?.disabled", 30.0)
    one.settle()
    assert not all(places())


def test_a_typed_place_is_that_of_the_whole_pin(hands: Hands) -> None:
    one = hands.one
    hands.new()
    hands.use("ground", (-0.4, -0.2), (0.2, -0.2))
    hands.bars((-0.4, -0.2), (-0.3, 0.1), (-0.3, 0.1), (0.3, 0.3), (0.3, 0.3), (0.2, -0.2))
    hands.select((0.0, 0.2))
    names = list(one.tree()["bodies"]["bar2"]["through"])
    hands.fill(names[0], "-0,35; 0,05")
    bodies = one.tree()["bodies"]
    assert bodies["bar1"]["through"][names[0]] == bodies["bar2"]["through"][names[0]]
    assert one.quantity("bar1.angle") == pytest.approx(np.arctan2(0.25, 0.05))
    hands.key("Escape")
    hands.press(".contents button:has-text('ground')")
    first = next(iter(bodies["ground"]["points"]))
    hands.fill(first, "-0.5; -0.25")
    bodies = one.tree()["bodies"]
    assert bodies["bar1"]["through"][first] == bodies["ground"]["points"][first] == [-0.5, -0.25]
