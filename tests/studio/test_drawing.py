"""Drawing with the mouse: the text says what was drawn, and kempe reads it."""

import math
from pathlib import Path

import kempe as kp
import pytest
from studio.window import Opener, Studio


def draw_four_bar(studio: Studio) -> None:
    """A crank-rocker from nothing: two fixed points and three bars."""
    studio.page.locator("#new").click()
    studio.settle()
    studio.tool("ground")
    studio.click(-0.4, -0.2)
    studio.click(0.2, -0.2)
    studio.tool("bar")
    for begin, end in [
        ((-0.4, -0.2), (-0.3, -0.1)),
        ((-0.3, -0.1), (0.3, 0.3)),
        ((0.3, 0.3), (0.2, -0.2)),
    ]:
        studio.click(*begin)
        studio.click(*end)
    studio.page.keyboard.press("Escape")
    studio.settle()


def test_a_four_bar_is_drawn_with_ten_clicks(studio: Opener, tmp_path: Path) -> None:
    one = studio()
    draw_four_bar(one)
    tree = one.tree()
    ends = [list(body["through"].values()) for body in list(tree["bodies"].values())[1:]]
    assert ends == [
        [[-0.4, -0.2], [-0.3, -0.1]],
        [[-0.3, -0.1], [0.3, 0.3]],
        [[0.3, 0.3], [0.2, -0.2]],
    ]
    assert [joint["type"] for joint in tree["joints"].values()] == 4 * ["revolute"]
    path = tmp_path / "drawn.toml"
    path.write_text(one.toml(), encoding="utf-8")
    case = kp.load(path)
    assert kp.mobility(case.model, case.start()).degrees_of_freedom == 1
    assert one.page.locator("#freedom").inner_text() == "1 degree of freedom"


def test_a_dragged_pin_moves_both_bars_in_one_step_of_the_history(studio: Opener) -> None:
    one = studio()
    draw_four_bar(one)
    before = one.toml()
    one.page.mouse.move(*one.screen(0.3, 0.3))
    one.page.mouse.down()
    for share in (0.2, 0.5, 0.8, 1.0):
        one.page.mouse.move(*one.screen(0.3 + 0.1 * share, 0.3 - 0.1 * share))
        one.page.wait_for_timeout(30)
    one.page.mouse.up()
    one.settle()
    bodies = list(one.tree()["bodies"].values())
    assert list(bodies[2]["through"].values())[1] == [0.4, 0.2]
    assert next(iter(bodies[3]["through"].values())) == [0.4, 0.2]
    one.page.keyboard.press("Control+z")
    one.settle()
    assert one.toml() == before
    one.page.keyboard.press("Control+Shift+z")
    one.settle()
    assert list(one.tree()["bodies"].values()) == bodies


def test_a_typed_length_is_that_of_the_bar(studio: Opener) -> None:
    one = studio()
    one.page.locator("#new").click()
    one.settle()
    one.tool("bar")
    one.click(-0.5, 0.0)
    one.page.keyboard.type("0.37")
    one.click(0.4, 0.0)
    ends = one.tree()["bodies"]["bar1"]["through"].values()
    assert list(ends) == [[-0.5, 0.0], [-0.13, 0.0]]


def test_a_plate_has_its_points_where_they_were_clicked(studio: Opener) -> None:
    one = studio()
    one.page.locator("#new").click()
    one.settle()
    one.tool("body")
    corners = [(-0.5, -0.3), (0.4, -0.1), (0.0, 0.5)]
    for corner in corners:
        one.click(*corner)
    one.page.keyboard.press("Enter")
    one.settle()
    tree = one.tree()["bodies"]["body1"]
    for point, (x, y) in zip(tree["through"], corners, strict=True):
        assert one.quantity(f"body1.{point}.x") == pytest.approx(x, abs=1e-12)
        assert one.quantity(f"body1.{point}.y") == pytest.approx(y, abs=1e-12)
    (x, y), turn = tree["center"], math.atan2(0.2, 0.9)
    assert -0.05 + x * math.cos(turn) - y * math.sin(turn) == pytest.approx(-0.1 / 3, abs=1e-3)
    assert -0.2 + x * math.sin(turn) + y * math.cos(turn) == pytest.approx(0.1 / 3, abs=1e-3)


def test_a_spring_is_placed_by_clicking_what_it_refers_to(studio: Opener) -> None:
    one = studio()
    draw_four_bar(one)
    one.tool("spring_damper")
    one.click(-0.4, -0.2)
    one.click(0.3, 0.3)
    (spring,) = one.tree()["forces"].values()
    assert spring["i"].split(".")[0] == "ground"
    assert spring["j"].split(".")[0] in ("bar2", "bar3")
    field = one.page.get_by_label("stiffness", exact=True)
    field.fill("250 N/m")
    field.press("Enter")
    one.settle()
    (spring,) = one.tree()["forces"].values()
    assert spring["stiffness"] == "250 N/m"


def test_a_driver_begins_where_the_body_is(studio: Opener) -> None:
    one = studio()
    draw_four_bar(one)
    one.tool("coordinate_driver")
    one.click(-0.35, -0.15)
    (driver,) = one.tree()["drivers"].values()
    assert driver["coordinate"] == "bar1.angle"
    begin, speed = driver["value"].split(" + ")
    assert speed == "speed1*t"
    assert float(begin) == pytest.approx(math.pi / 4, abs=1e-15)


def test_a_removed_body_takes_its_joints_along(studio: Opener) -> None:
    one = studio()
    draw_four_bar(one)
    one.click(0.0, 0.1)
    one.page.locator("#sheet").focus()
    one.page.keyboard.press("Delete")
    one.settle()
    tree = one.tree()
    assert list(tree["bodies"]) == ["ground", "bar1", "bar3"]
    assert len(tree["joints"]) == 2


def test_a_new_name_is_written_wherever_the_body_is_mentioned(studio: Opener) -> None:
    one = studio()
    draw_four_bar(one)
    one.click(0.0, 0.1)
    name = one.page.get_by_label("Name", exact=True)
    name.fill("coupler")
    name.press("Enter")
    one.settle()
    assert "bar2" not in one.toml()
    assert one.toml().count("coupler") == 3


def paste(studio: Studio, text: str) -> None:
    """Paste a text in place of all that is in the editor."""
    studio.page.locator(".cm-content").click()
    studio.page.keyboard.press("Control+a")
    studio.call(
        """([text]) => {
          const data = new DataTransfer();
          data.setData("text/plain", text);
          const editor = document.querySelector(".editor").shadowRoot;
          const event = new ClipboardEvent("paste", { clipboardData: data, bubbles: true });
          editor.querySelector(".cm-content").dispatchEvent(event);
        }""",
        [text],
    )
    studio.page.wait_for_timeout(400)
    studio.settle()


def test_text_and_drawing_follow_each_other(studio: Opener) -> None:
    one = studio()
    draw_four_bar(one)
    one.page.locator("#tab-text").click()
    text = one.toml().replace("[-0.3, -0.1]", "[-0.3, -0.05]")
    paste(one, text)
    assert one.quantity("bar1.y") == pytest.approx(-0.125, abs=1e-12)
    paste(one, text.replace('"bar"', '"bra"', 1))
    assert "bra" in one.message()
    assert one.page.locator(".cm-lintRange-error").count() > 0


def held(studio: Studio, body: str, what: str) -> None:
    """Keep a length, an angle or a point of a body while drawing."""
    studio.page.locator("#sheet").focus()
    studio.page.keyboard.press("Escape")
    studio.page.locator(".contents button").filter(has_text=body).first.click()
    studio.page.locator(".locks label").filter(has_text=what).click()


def drag(studio: Studio, begin: tuple[float, float], end: tuple[float, float]) -> None:
    studio.page.mouse.move(*studio.screen(*begin))
    studio.page.mouse.down()
    studio.page.mouse.move(*studio.screen(*end), steps=5)
    studio.page.wait_for_timeout(100)
    studio.page.mouse.up()
    studio.settle()


def ends(studio: Studio, body: str) -> list[list[float]]:
    return list(studio.tree()["bodies"][body]["through"].values())


def test_a_typed_length_of_a_drawn_bar_keeps_those_of_its_neighbours(studio: Opener) -> None:
    one = studio()
    draw_four_bar(one)
    before = [math.dist(*ends(one, name)) for name in ("bar1", "bar3")]
    one.click(0.0, 0.1)
    one.page.locator("#body-length").fill("0.8")
    one.page.locator("#body-length").press("Enter")
    one.settle()
    assert math.dist(*ends(one, "bar2")) == pytest.approx(0.8, rel=1e-9)
    after = [math.dist(*ends(one, name)) for name in ("bar1", "bar3")]
    assert after == pytest.approx(before, rel=1e-9)
    one.page.locator("#body-length").fill("5")
    one.page.locator("#body-length").press("Enter")
    one.settle()
    assert "cannot keep" in one.message()
    assert math.dist(*ends(one, "bar2")) == pytest.approx(5, rel=1e-9)


def test_a_point_is_added_to_the_coupler_and_dragged(studio: Opener) -> None:
    one = studio()
    draw_four_bar(one)
    one.click(0.0, 0.1)
    one.page.locator("#add-point").click()
    one.settle()
    name = list(one.tree()["bodies"]["bar2"]["through"])[2]
    drag(one, (one.quantity(f"bar2.{name}.x"), one.quantity(f"bar2.{name}.y")), (0.1, 0.5))
    assert one.quantity(f"bar2.{name}.x") == pytest.approx(0.1, abs=1e-9)
    assert one.quantity(f"bar2.{name}.y") == pytest.approx(0.5, abs=1e-9)
    traced = [list(body["through"]) for body in list(one.tree()["bodies"].values())[1:]]
    assert traced == [["A", "C"], ["C", "D", name], ["D", "B"]]


def test_a_spring_may_hold_a_bar_anywhere(studio: Opener) -> None:
    one = studio()
    draw_four_bar(one)
    one.tool("spring_damper")
    one.click(-0.4, -0.2)
    one.click(0.0, 0.1)  # on the coupler, where it has no point
    (spring,) = one.tree()["forces"].values()
    assert spring["j"].startswith("bar2.")
    assert one.quantity(f"{spring['j']}.x") == pytest.approx(0.0, abs=1e-6)
    assert one.page.locator("#tab-text").inner_text() == "Text"  # without a fault


def test_a_drag_keeps_the_lengths_angles_and_points_that_are_held(studio: Opener) -> None:
    one = studio()
    draw_four_bar(one)
    length = math.dist(*ends(one, "bar3"))
    held(one, "bar3", "lengths")
    drag(one, (0.3, 0.3), (0.5, 0.2))
    (cx, cy), _ = after = ends(one, "bar3")
    assert math.dist(*after) == pytest.approx(length, rel=1e-9)
    assert (cx, cy) == pytest.approx(ends(one, "bar2")[1], abs=1e-12)
    assert cx > 0.35
    held(one, "bar1", "angle")
    drag(one, (-0.3, -0.1), (-0.1, -0.1))
    (ax, ay), (bx, by) = ends(one, "bar1")
    assert bx - ax == pytest.approx(by - ay, abs=1e-9)  # 45°, as it was drawn
    assert bx > -0.29
    text = one.toml()
    held(one, "ground", "A")
    drag(one, (-0.4, -0.2), (-0.5, 0.0))
    assert one.toml() == text


def test_the_editor_has_its_styles_within_the_policy(studio: Opener) -> None:
    one = studio()
    one.load('kempe = 1\ntitle = "A"\nmass = 3\n')
    one.page.locator("#tab-text").click()
    one.page.wait_for_timeout(300)
    style = """([name, property]) => getComputedStyle(
      document.querySelector(".editor").shadowRoot.querySelector(name))[property]"""
    assert "monospace" in one.call(style, [".cm-scroller", "fontFamily"])
    assert one.call(style, [".cm-scroller", "display"]) == "flex"
    assert "wavy" in one.call(style, [".cm-lintRange-error", "textDecorationStyle"])
    one.page.locator(".cm-lintRange-error").hover()
    one.page.wait_for_timeout(800)
    assert one.call(style, [".cm-tooltip", "position"]) in ("absolute", "fixed")
    assert "mass" in one.page.locator(".cm-tooltip").inner_text()


def test_keys_of_the_editor_and_its_history_are_those_of_the_case(studio: Opener) -> None:
    one = studio()
    text = one.toml()
    one.page.locator("#tab-text").click()
    one.page.locator(".cm-content").click()
    one.page.keyboard.press("Control+End")
    one.page.keyboard.type("[parameters.x]")
    one.page.keyboard.press("Enter")
    one.page.keyboard.press("Tab")
    one.page.keyboard.type("# aa")
    one.page.keyboard.press("Enter")
    one.page.keyboard.type("b")
    one.page.keyboard.press("Backspace")
    one.page.wait_for_timeout(300)
    one.settle()
    assert one.toml() == text + "[parameters.x]\n  # aa\n  "
    one.page.keyboard.press("Control+z")
    one.settle()
    assert one.toml() == text
    one.page.keyboard.press("Control+Shift+z")
    one.settle()
    assert one.toml().endswith("# aa\n  ")
    one.page.keyboard.press("Control+a")
    one.page.keyboard.press("Delete")
    one.page.wait_for_timeout(300)
    assert one.toml() == ""
    one.page.keyboard.press("Control+z")
    one.settle()
    colour = """name => getComputedStyle([...document.querySelector(".editor").shadowRoot
      .querySelectorAll(".cm-line span")].find(one => one.textContent === name)).color"""
    assert len({one.call(colour, name) for name in ("kempe", "15", "[bodies.crank]")} - {None}) == 2


def test_what_was_typed_last_is_not_lost_by_the_next_click(studio: Opener) -> None:
    one = studio()
    first = one.toml()
    one.page.locator("#tab-text").click()
    for words in ("# a", "# b"):
        one.page.locator(".cm-content").click()
        one.page.keyboard.press("Control+End")
        one.page.keyboard.type(words)
        one.page.locator("#new").click()  # at once, before the text was taken
        one.settle()
        assert words not in one.toml()
        one.page.locator("#undo").click()
        one.settle()
        assert one.toml().endswith(words)
        one.page.wait_for_timeout(400)
        assert one.toml().endswith(words)
    one.page.locator("#undo").click()
    one.page.locator(".cm-content").click()
    one.page.keyboard.press("Control+End")
    one.page.keyboard.type(
        "# c"
    )  # soon after an undo: a step of its own, after which nothing is redone
    one.page.locator("#tab-main").click()
    one.settle()
    assert not one.page.locator("#redo").is_enabled()
    one.page.locator("#undo").click()
    one.settle()
    assert one.toml() == first + "# a"
