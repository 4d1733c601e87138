"""Every tool of the palette, used as its messages say."""

import re

import pytest
from studio.window import Studio

#: Two pendulums that do not touch each other; the second one has a curve.
CASE = """kempe = 1

[bodies.ground]
points = { A = [-0.5, 0], B = [0.5, 0] }

[bodies.left]
type = "bar"
mass = 1
through = { A = [-0.5, 0], C = [-0.3, -0.4] }

[bodies.right]
type = "bar"
mass = 1
through = { B = [0.5, 0], D = [0.4, -0.4] }
curves = { rim = { circle = [0, 0, 0.1] } }

[joints.A]
type = "revolute"
i = "ground.A"
j = "left.A"

[joints.B]
type = "revolute"
i = "ground.B"
j = "right.B"
"""
#: Places for what a message requests, by the words in it.
PLACES = {
    "the joint": (-0.5, 0),
    "first wheel": (-0.4, -0.2),
    "second wheel": (0.45, -0.2),
    "curve": (0.45, -0.2),
    "body or joint": (-0.4, -0.2),
    "second one": (0.45, -0.2),
    "body that it turns": (-0.4, -0.2),
    "rotor": (-0.4, -0.2),
    "joint that moves": (-0.4, -0.2),
    "point that follows": (-0.3, -0.4),
    "its first end": (-0.3, -0.4),
    "first": (-0.3, -0.4),
    "second": (0.4, -0.4),
    "the guide": (-0.3, -0.4),
    "the ground": (-0.3, -0.4),
    "body that slides": (0.4, -0.4),
    "pin": (0.4, -0.4),
    "wheel that rolls": (0.4, -0.4),
    "other body": (0.4, -0.4),
    "point": (-0.3, -0.4),
    "centre": (-0.3, -0.4),
}
FREE = [(-0.2, 0.0), (0.1, 0.0), (0.0, -0.3)]


def place(message: str, count: int) -> tuple[float, float]:
    """Where to click next, from what the message requests."""
    if re.search(
        r": click (where|its first point|its second point|the next|the direction) ?", message
    ):
        return FREE[count]
    asked = re.search(r": click (.+)\.$", message)
    assert asked, message
    if asked[1] == "the point that follows a curve":
        return PLACES["first"]
    return next(at for words, at in PLACES.items() if words in asked[1])


def use(one: Studio, tool: str) -> str:
    """Use a tool until it has added something; returns the last message."""
    before = one.toml()
    one.tool(tool)
    one.settle()
    for count in range(3):
        one.click(*place(one.message().split("\n")[0], count))
        if one.toml() != before:
            return one.message()
    one.page.keyboard.press("Enter")
    one.settle()
    assert one.toml() != before, one.message()
    return one.message()


def tools(one: Studio) -> list[str]:
    names: list[str] = one.call(
        "[...document.querySelectorAll('.left [data-type]')].map(tool => tool.dataset.type)"
    )
    return names


def test_every_tool_adds_an_element_or_says_what_is_missing(one: Studio) -> None:
    names = tools(one)
    assert len(names) > 25
    for name in names:
        one.load(CASE)
        one.settle()
        message = use(one, name)
        assert "added." in message, (name, message)
        problems = one.page.locator("#tab-text").inner_text() != "Text"
        # nothing is missing; a joint of two points that cannot meet is the only fault of the text
        assert not problems, (name, message)
        assert "missing" not in message, (name, message)
        one.page.keyboard.press("Escape")
    assert one.messages == []


@pytest.mark.parametrize("tool", ["coupling", "constraint"])
def test_a_relation_of_clicked_coordinates_holds_where_they_are(one: Studio, tool: str) -> None:
    one.load(CASE)
    before = one.quantity("left.angle"), one.quantity("right.angle")
    one.settle()
    message = use(one, tool)
    assert "Problem" not in message
    assert one.state()["q"]
    after = one.quantity("left.angle"), one.quantity("right.angle")
    assert after == pytest.approx(before, abs=1e-9)
    freedom = one.page.locator("#freedom").inner_text()
    assert freedom == "1 degree of freedom"


@pytest.mark.parametrize(
    ("tool", "at", "body", "form"),
    [
        ("contact", (-0.4, -0.2), "left", r"\{ circle = \[0, 0, 0\.2236\] \}"),
        (
            "point_on_curve",
            (0.0, -0.3),
            "ground",
            r"\{ line = \[\[0\.\d, -0\.3\], \[-0\.\d, -0\.3\]\] \}",
        ),
    ],
)
def test_a_curve_is_added_where_a_tool_needs_one(
    one: Studio, tool: str, at: tuple[float, float], body: str, form: str
) -> None:
    one.load(CASE)
    one.settle()
    one.tool(tool)
    one.click(0.4, -0.4)
    one.click(*at)
    assert "There is no curve here" in one.message()
    one.page.locator("#message .link").click()
    one.settle()
    assert "added." in one.message()
    assert re.search(rf"^curves = \{{ curve1 = {form} \}}$", one.toml(), re.MULTILINE)
    assert f'\ncurve = "{body}.curve1"\n' in one.toml()
