"""A fault is shown at the thing, in one sentence, with a way back."""

import re

from studio.test_motion import ANALYSIS, STOPPING
from studio.test_palette import CASE
from studio.window import Opener, Studio

#: The number of pixels with the colour of problems around a place of the window.
RED = """([x, y]) => {
  const canvas = document.getElementById("sheet");
  const box = canvas.getBoundingClientRect();
  const ratio = canvas.width / box.width;
  const [left, top] = [ratio * (x - box.left - 26), ratio * (y - box.top - 26)];
  const copy = new OffscreenCanvas(52 * ratio, 52 * ratio).getContext("2d");
  copy.drawImage(canvas, -left, -top);
  const { data } = copy.getImageData(0, 0, 52 * ratio, 52 * ratio);
  let count = 0;
  for (let k = 0; k < data.length; k += 4)
    if (data[k] > 150 && data[k + 1] < 80 && data[k + 2] < 80) count += 1;
  return count;
}"""


def red(one: Studio, x: float, y: float) -> int:
    one.settle()
    found: int = one.call(RED, list(one.screen(x, y)))
    return found


def test_a_joint_that_cannot_close_is_marked_and_undone(one: Studio) -> None:
    one.load(CASE)
    assert red(one, -0.3, -0.4) < 5
    text = one.toml()
    one.tool("weld")
    one.click(-0.3, -0.4)
    one.click(0.4, -0.4)
    one.page.keyboard.press("Escape")
    one.page.keyboard.press("Escape")
    one.settle()
    x, y = one.quantity("left.C.x"), one.quantity("left.C.y")
    assert red(one, x, y) > 40
    links = one.page.locator("#message .link")
    assert "weld1" in links.all_inner_texts()
    links.filter(has_text="weld1").click()
    assert one.page.locator("#entry-name").input_value() == "weld1"
    one.page.locator("#remedy-undo").click()
    one.settle()
    assert one.toml() == text
    assert red(one, -0.3, -0.4) < 5


def test_new_names_are_words(studio: Opener) -> None:
    one = studio()
    one.load(CASE)
    for tool, places in {
        "coordinate_driver": [(-0.4, -0.2)],
        "pin_in_slot": [(-0.3, -0.4), (0.4, -0.4)],
        "spring_damper": [(-0.3, -0.4), (0.4, -0.4)],
    }.items():
        one.tool(tool)
        for place in places:
            one.click(*place)
        one.page.keyboard.press("Escape")
    tree = one.tree()
    names = [*tree["drivers"], *tree["forces"], *list(tree["joints"])[2:]]
    assert names == ["driver1", "spring1", "slot1"]


def test_no_message_speaks_of_constraints_that_depend_on_others(one: Studio) -> None:
    one.load(STOPPING.replace("SPEED", "10 rpm").replace("speed*t", "speed*t^2/t") + ANALYSIS)
    one.mode("read")
    one.settle()
    seen = one.page.locator("body").inner_text()
    assert not re.search(r"depends? on the others|singular position", seen), seen
