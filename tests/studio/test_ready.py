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
