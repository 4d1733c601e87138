"""Tools say what they want, refuse what makes no sense, and place what works at once."""

import math

import pytest
from studio.test_drawing import draw_four_bar
from studio.test_palette import CASE
from studio.window import Studio


def note(one: Studio) -> str:
    found = one.page.locator("#note")
    return found.inner_text() if found.count() else ""


def new(one: Studio) -> None:
    one.page.locator("#new").click()
    one.settle()


def drag(one: Studio, begin: tuple[float, float], end: tuple[float, float]) -> None:
    one.page.mouse.move(*one.screen(*begin))
    one.page.mouse.down()
    one.page.mouse.move(*one.screen(*end), steps=6)
    one.settle()


def test_a_slot_asks_for_its_parts_by_name_and_can_be_swapped(one: Studio) -> None:
    one.load(CASE)
    one.tool("pin_in_slot")
    assert "click the body with the slot" in one.message()
    one.page.mouse.move(*one.screen(-0.4, -0.2))
    one.settle()
    assert "click the body with the slot" in note(one)
    one.click(-0.3, -0.4)
    assert "click the pin, a point of another body" in one.message()
    text = one.toml()
    one.click(-0.4, -0.2)  # the same body
    assert one.toml() == text
    assert "This is left again" in note(one)
    one.click(0.4, -0.4)
    joint = one.tree()["joints"]["slot1"]
    assert (joint["i"], joint["j"]) == ("left.C", "right.D")
    turned = one.quantity("left.angle") - one.quantity("right.angle")
    one.page.locator("#message .link").filter(has_text="Swap").click()
    one.settle()
    joint = one.tree()["joints"]["slot1"]
    assert (joint["i"], joint["j"]) == ("right.D", "left.C")
    assert joint["axis"] == pytest.approx(turned, abs=1e-9)  # the direction in the plane stays
    one.page.keyboard.press("Escape")
    one.page.locator("#swap").click()
    one.settle()
    assert one.tree()["joints"]["slot1"]["i"] == "left.C"


def test_a_tool_stays_until_escape_or_another_tool(one: Studio) -> None:
    one.load(CASE)
    for _ in range(3):
        one.tool("spring_damper")
        pressed = one.page.locator(".left [data-type=spring_damper]")
        assert pressed.get_attribute("aria-pressed") == "true"
    one.click(-0.3, -0.4)
    one.click(0.4, -0.4)
    assert len(one.tree()["forces"]) == 1
    one.click(-0.4, -0.2)
    one.click(0.45, -0.2)
    assert len(one.tree()["forces"]) == 2
    one.page.keyboard.press("Escape")
    assert pressed.get_attribute("aria-pressed") == "false"


def test_the_ground_is_refused_where_nothing_can_move_it(one: Studio) -> None:
    one.load(CASE)
    text = one.toml()
    one.tool("torque")
    one.click(0.0, 0.3)
    assert "The ground does not move" in note(one)
    one.tool("spring_damper")
    one.click(0.0, 0.3)
    one.click(0.1, 0.2)  # the ground again
    assert "This is ground again" in note(one)
    one.page.mouse.move(*one.screen(0.3, 0.3))
    assert "click its second end" in note(one)  # the prompt is back
    assert one.toml() == text
    one.page.keyboard.press("Escape")


def test_ends_that_are_dropped_on_each_other_are_pinned_unless_a_key_is_held(one: Studio) -> None:
    new(one)
    one.tool("bar")
    for x, y in [(-0.5, -0.2), (-0.2, 0.3), (0.1, 0.3), (0.5, -0.2)]:
        one.click(x, y)
    one.page.keyboard.press("Escape")
    one.page.keyboard.press("Escape")
    text = one.toml()
    one.page.keyboard.down("Alt")
    drag(one, (0.1, 0.3), (-0.2, 0.3))
    one.page.mouse.up()
    one.page.keyboard.up("Alt")
    one.settle()
    assert "joints" not in one.tree()
    one.page.keyboard.press("Control+z")
    one.settle()
    assert one.toml() == text
    drag(one, (0.1, 0.3), (-0.19, 0.31))
    assert "Pinned to bar1.B" in note(one)
    one.page.mouse.up()
    one.settle()
    (joint,) = one.tree()["joints"].values()
    assert (joint["type"], joint["i"], joint["j"]) == ("revolute", "bar1.B", "bar2.C")
    assert one.tree()["bodies"]["bar2"]["through"]["C"] == [-0.2, 0.3]
    one.page.keyboard.press("Control+z")
    one.settle()
    assert one.toml() == text  # one step


def test_a_point_snaps_to_a_link(one: Studio) -> None:
    new(one)
    one.tool("bar")
    one.click(-0.5, -0.3)
    one.click(0.4, 0.2)
    one.page.keyboard.press("Escape")
    one.tool("bar")
    x, y = one.screen(-0.15, -0.3 + 0.35 * 5 / 9)
    one.page.mouse.click(x, y + 5)
    one.settle()
    one.click(0.2, -0.4)
    x, y = next(iter(one.tree()["bodies"]["bar2"]["through"].values()))
    assert y + 0.3 == pytest.approx((x + 0.5) * 5 / 9, abs=1e-6)


def test_a_slider_carries_a_point_along_a_guide(one: Studio) -> None:
    new(one)
    one.tool("bar")
    one.click(-0.4, 0.0)
    one.click(0.2, 0.3)
    one.tool("slider")
    assert "where the block is" in one.message()
    one.click(0.2, 0.3)
    assert "direction of the guide" in one.message()
    one.click(0.5, 0.3)
    tree = one.tree()
    kinds = sorted(joint["type"] for joint in tree["joints"].values())
    assert kinds == ["revolute", "translational"]
    assert one.page.locator("#freedom").inner_text() == "2 degrees of freedom"
    one.page.keyboard.press("Escape")
    one.mode("move")
    drag(one, (0.2, 0.3), (0.35, 0.4))
    one.page.mouse.up()
    one.settle()
    block = next(name for name in tree["bodies"] if name.startswith("block"))
    point = next(iter(tree["bodies"][block]["through"]))
    assert one.quantity(f"{block}.{point}.y") == pytest.approx(0.3, abs=1e-9)
    assert one.quantity(f"{block}.{point}.x") > 0.25


def test_a_cylinder_lengthens_and_turns_a_boom(one: Studio) -> None:
    new(one)
    one.tool("ground")
    one.click(-0.4, 0.0)
    one.tool("bar")
    one.click(-0.4, 0.0)
    one.click(0.4, 0.2)
    one.tool("cylinder")
    one.click(-0.2, -0.4)
    one.click(0.2, 0.15)
    assert "Problem" not in one.message()
    assert one.page.locator("#freedom").inner_text() == "0 degrees of freedom"  # the driver
    one.page.keyboard.press("Escape")
    run = one.call("kempe.run(0.5)")
    assert run["error"] is None
    (angle,) = one.call("kempe.values(['bar1.angle'])")["rows"]
    assert angle[-1] > angle[0] + 0.01


def test_a_new_spring_holds_the_mechanism_where_it_is(one: Studio) -> None:
    draw_four_bar(one)
    one.tool("spring_damper")
    one.click(-0.4, -0.2)
    one.click(0.3, 0.3)
    (spring,) = one.tree()["forces"].values()
    assert spring["free_length"] == pytest.approx(math.hypot(0.7, 0.5), rel=1e-3)
    assert spring["stiffness"] == pytest.approx(10 * 3 * 9.81 / 0.7, rel=0.5)  # 3 kg, 0.7 m
    assert spring["damping"] > 0
    one.page.keyboard.press("Escape")
    one.call("kempe.run(3)")
    (length,) = one.call("kempe.values(['spring1.length'])")["rows"]
    assert max(abs(one_ - length[0]) for one_ in length) < 0.4  # it does not fall through


def test_a_click_on_a_wheel_takes_its_pivot_as_centre(one: Studio) -> None:
    one.load(CASE)
    one.tool("gear")
    one.click(-0.4, -0.2)
    one.click(0.45, -0.2)
    gear = one.tree()["joints"]["gear1"]
    assert (gear["i"], gear["j"]) == ("left.A", "right.B")
    assert gear["radii"] == [0.5, 0.5]  # they touch
    assert one.page.locator("#freedom").inner_text() == "1 degree of freedom"
    one.page.keyboard.press("Escape")
    one.load(CASE)
    one.tool("belt")
    one.click(-0.5, 0.0)  # where the ground has a point, too
    one.click(0.5, 0.0)
    belt = one.tree()["joints"]["belt1"]
    assert (belt["i"], belt["j"]) == ("left.A", "right.B")
    one.page.keyboard.press("Escape")


def test_a_weld_takes_the_place_of_a_pin_and_keeps_the_drawn_angle(one: Studio) -> None:
    new(one)
    one.tool("ground")
    one.click(-0.5, 0.2)
    one.tool("bar")
    one.click(-0.5, 0.2)
    one.click(0.3, 0.6)
    one.tool("weld")
    one.page.mouse.move(*one.screen(-0.5, 0.2))
    one.settle()
    one.click(-0.5, 0.2)
    assert "its second end" in note(one)  # also where the mouse rests
    one.click(-0.5, 0.2)
    assert "in place of “A”" in one.message()
    (weld,) = one.tree()["joints"].values()
    assert weld["angle"] == pytest.approx(math.atan2(0.4, 0.8), abs=1e-8)
    assert one.quantity("bar1.B.y") == pytest.approx(0.6, abs=1e-6)
    one.page.locator("#undo").click()
    one.settle()
    assert list(one.tree()["joints"]) == ["A"]


def test_a_floor_is_where_it_was_clicked_and_a_cam_on_its_pin_is_the_cam(one: Studio) -> None:
    new(one)
    one.tool("ground")
    one.click(-0.8, 0.0)
    one.tool("body")
    one.click(0.2, 0.3)
    one.click(0.4, 0.3)
    one.page.keyboard.press("Enter")
    one.tool("contact")
    one.click(0.2, 0.3)
    one.click(0.3, -0.3)
    one.page.locator("#message .link").filter(has_text="Add a curve to ground").click()
    one.settle()
    right, left = one.tree()["bodies"]["ground"]["curves"]["curve1"]["line"]
    assert right[1] == left[1] == pytest.approx(-0.3, abs=1e-9)
    assert left[0] < -0.8
    assert right[0] > 0.3
    one.page.keyboard.press("Escape")
    one.load(CASE)
    one.tool("roller_on_curve")
    one.click(0.4, -0.4)
    one.click(-0.4, -0.2)  # the pin of the left body on the ground
    offers = one.page.locator("#message .link").all_inner_texts()
    assert offers == ["Add a curve to left"]


def test_a_belt_is_not_elastic(one: Studio) -> None:
    one.load(CASE)
    one.tool("belt")
    one.click(-0.4, -0.2)
    one.click(0.45, -0.2)
    assert set(one.tree()["joints"]["belt1"]) <= {"type", "i", "j", "radii", "offset"}
    assert one.page.locator("#freedom").inner_text() == "1 degree of freedom"
    one.page.keyboard.press("Escape")
