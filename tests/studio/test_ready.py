"""What can be computed with a drawn mechanism, and the way to the element that prevents it."""

from pathlib import Path

import kempe as kp
import pytest
from studio.window import Studio

EXAMPLES = Path(__file__).parents[2] / "examples"


def shown(one: Studio) -> dict[str, str]:
    """The lines of the list by analysis."""
    one.settle()
    rows = one.page.locator("#readiness > div")
    names, texts = rows.locator("dt").all_inner_texts(), rows.locator("dd").all_inner_texts()
    return dict(zip(names, texts, strict=True))


def test_a_pendulum_moves_freely_but_has_no_driver(one: Studio) -> None:
    case = EXAMPLES / "pendulum.toml"
    one.load(case.read_text(encoding="utf-8"))
    one.mode("edit")
    found = shown(one)
    assert found["Assembly"] == found["Dynamics"] == "ready"
    model = kp.load(case).model
    with pytest.raises(kp.KempeError) as caught:
        kp.kinematics(model, kp.assemble(model), t_end=1)
    assert "1 degree of freedom" in str(caught.value)
    assert "1 degree of freedom" in found["Kinematics"]


def test_a_click_leads_to_the_joint_that_stays_open(one: Studio) -> None:
    text = (EXAMPLES / "four_bar.toml").read_text(encoding="utf-8")
    one.load(text.replace("L2 = 26", "L2 = 1"))
    one.mode("edit")
    assert "short" in shown(one)["Assembly"]
    link = one.page.locator("#readiness .link").first
    group, name = link.inner_text().split(".")
    assert group == "joints"
    link.click()
    one.settle()
    assert one.page.locator("#readiness").count() == 0  # the fields of the joint are shown
    assert one.page.get_by_label("Name", exact=True).input_value() == name


def test_a_click_begins_the_driver_that_is_missing(one: Studio) -> None:
    one.load((EXAMPLES / "pendulum.toml").read_text(encoding="utf-8"))
    one.mode("edit")
    shown(one)
    row = one.page.locator("#readiness > div").filter(has_text="Kinematics")
    row.locator(".link").first.click()
    one.settle()
    assert one.page.locator(".left [data-type=coordinate_driver][aria-pressed=true]").count() == 1
    one.click(one.quantity("rod.B.x"), one.quantity("rod.B.y"))
    assert len(one.tree()["drivers"]) == 1
    one.page.keyboard.press("Escape")
    one.page.keyboard.press("Escape")
    assert shown(one)["Kinematics"] == "ready"


def test_other_analyses_are_listed(one: Studio) -> None:
    one.load((EXAMPLES / "pendulum.toml").read_text(encoding="utf-8"))
    one.mode("edit")
    found = shown(one)
    for name in ("Equilibrium", "Modes", "Limits"):
        assert found[name] == "ready"


def test_limits_need_a_single_freedom(one: Studio) -> None:
    case = EXAMPLES / "double_pendulum.toml"
    one.load(case.read_text(encoding="utf-8"))
    one.mode("edit")
    obstacle = shown(one)["Limits"]
    assert "2 degrees of freedom" in obstacle
    assert "add a driver" in obstacle
    model = kp.load(case).model
    with pytest.raises(kp.KempeError):
        kp.limits(model, kp.assemble(model), over="first.angle")
    one.load((EXAMPLES / "hoecken.toml").read_text(encoding="utf-8"))  # with its driver
    assert shown(one)["Limits"] == "ready"
