"""Living and moving: pulls, sliders, played drivers, and a core that has to start again."""

import math
import time
from collections.abc import Callable
from pathlib import Path

import kempe as kp
import numpy as np
import pytest
from studio.test_foreign import DROP
from studio.window import Studio

EXAMPLES = Path(__file__).parents[2] / "examples"


def example(name: str) -> str:
    return (EXAMPLES / f"{name}.toml").read_text(encoding="utf-8")


#: A pendulum at rest, which only a pull moves.
HANGING = example("pendulum").replace("-60*deg", "-90*deg")
#: A disc on a spring: its frequency follows from the parameter k.
SPRING = """kempe = 1
[parameters]
k = 40
[bodies]
ground = { points = { A = [0, 0] } }
block = { mass = 2, inertia = 1, points = { P = [0, 0] } }
[joints]
slide = { type = "translational", i = "ground.A", j = "block.P", axes = [0, 0] }
[forces]
spring = { type = "spring_damper", i = "ground.A", j = "block.P", stiffness = "k" }
[start]
set = { "block.x" = 0.1 }
"""


def play(one: Studio) -> None:
    one.page.locator("#live-play").click()


def wait_for_angle(one: Studio, reached: Callable[[float], bool]) -> None:
    """Wait until the angle of the pendulum is reached; a busy machine plays slowly."""
    end = time.monotonic() + 20
    while not reached(one.state()["q"][2]):
        assert time.monotonic() < end


def test_places_on_the_screen_are_those_of_the_new_layout(one: Studio) -> None:
    one.load(HANGING)
    for _ in range(4):
        one.mode("live")  # without the palette, the sheet is wider
        first = one.screen(0.0, -1.0)
        one.page.wait_for_timeout(200)
        assert one.screen(0.0, -1.0) == first
        one.mode("edit")


def test_a_pull_moves_a_pendulum_that_hangs_towards_the_mouse(one: Studio) -> None:
    one.load(HANGING)
    one.mode("live")
    assert one.state()["q"][2] == pytest.approx(-math.pi / 2, abs=1e-9)
    one.page.mouse.move(*one.screen(0.0, -1.0))
    one.page.mouse.down()
    one.page.mouse.move(*one.screen(0.4, -0.9), steps=4)
    # the spring of the mouse draws the end of the rod to it, against the weight
    angle = math.atan2(-0.9, 0.4)
    wait_for_angle(one, lambda held: abs(held - angle) < 0.2)
    assert one.state()["q"][2] - -math.pi / 2 > 0.15
    one.page.mouse.up()
    one.page.wait_for_timeout(100)
    begin = one.state()["t"]
    angles = []
    while one.state()["t"] < begin + 1.6:
        angles.append(one.state()["q"][2])
    assert min(angles) < -math.pi / 2 - 0.05  # it swings through when it is free
    play(one)


def test_a_pull_after_going_back_to_the_start_begins_the_motion(one: Studio) -> None:
    one.load(HANGING)
    one.mode("live")
    one.page.get_by_role("button", name="Back to the start").click()
    one.settle()
    one.page.mouse.move(*one.screen(0.0, -1.0))
    one.page.locator("#sheet").focus()
    one.page.mouse.down()
    one.page.mouse.move(*one.screen(0.5, -0.8), steps=3)
    one.settle()
    assert one.message().strip() == ""
    one.page.keyboard.press("Space")
    wait_for_angle(one, lambda held: held > -math.pi / 2 + 0.1)
    one.page.mouse.up()
    play(one)


def stiffness(one: Studio) -> float:
    """The stiffness of the spring in the live motion: m v² + k x² stays the same."""
    squares = []
    for _ in range(14):
        one.page.locator("#live-step").click()
        one.settle()
        state = one.state()
        squares.append((state["q"][0] ** 2, state["v"][0] ** 2))
    x, v = np.array(squares).T
    assert np.ptp(x) > 1e-4
    return float(-2 * np.polyfit(x, v, 1)[0])


def slide(one: Studio, value: float) -> None:
    """Set the slider of a parameter, as a drag does."""
    one.page.locator(".slider input").fill(str(value))
    one.settle()


def test_a_slider_changes_the_motion_and_not_the_text(one: Studio) -> None:
    one.load(SPRING)
    text = one.toml()
    one.mode("live")
    play(one)
    one.settle()
    assert stiffness(one) == pytest.approx(40, rel=1e-6)
    slide(one, 80)
    assert stiffness(one) == pytest.approx(80, rel=1e-6)
    assert one.toml() == text
    assert "80" in one.page.locator(".slider output").inner_text()
    one.mode("read")  # the text counts again
    one.call("kempe.run(1)")
    case = one.call("kempe.values(['block.ax', 'block.x'])")
    ratio = [a / x for a, x in zip(*case["rows"], strict=True) if abs(x) > 0.01]
    assert ratio == pytest.approx([-40 / 2] * len(ratio), rel=1e-6)


def test_a_played_driver_turns_the_crank_at_its_speed(one: Studio) -> None:
    one.load(example("quick_return"))
    one.mode("move")
    start = one.state()["q"]
    one.page.locator("#play-drivers").click()
    one.page.wait_for_timeout(700)
    one.page.locator("#play-drivers").click()
    one.settle()
    now = one.state()
    assert 0.1 < now["t"] < 4
    case = kp.load(EXAMPLES / "quick_return.toml")
    solution = kp.kinematics(case.model, case.start(), t_end=now["t"], output_step=now["t"])
    assert now["q"] == pytest.approx(list(solution.q[-1]), abs=1e-8)
    assert now["q"] != start
    assert one.quantity("crank.omega") == pytest.approx(solution["crank.omega"][-1], rel=1e-9)
    one.page.mouse.move(*one.screen(*now["q"][:2]))
    one.page.mouse.down()
    one.page.mouse.move(*one.screen(*now["q"][:2]), steps=3)
    one.page.mouse.up()
    one.settle()
    assert one.state()["q"] == pytest.approx(now["q"], abs=0.05)  # a drag goes on from there


def test_a_core_that_traps_is_started_again(one: Studio) -> None:
    one.load(example("four_bar"))
    one.mode("live")
    one.page.wait_for_timeout(200)
    one.page.workers[-1].evaluate(
        "void (TextDecoder.prototype.decode = () => { throw Error('broken') })"
    )
    one.wait("document.querySelector('#message').innerText.includes('started again')")
    one.settle()
    assert one.toml() == example("four_bar")
    assert one.state()["t"] == 0
    one.page.locator("#live-play").click()
    one.wait("kempe.state().then(({ t }) => t > 0.05)")
    assert "no motion" not in one.message()
    play(one)
    one.mode("read")
    one.settle()
    one.page.workers[-1].evaluate("void setTimeout(() => { throw Error('broken') })")
    one.wait("document.querySelector('#message').innerText.includes('started again')")
    one.settle()
    one.mode("edit")
    one.mode("read")
    one.settle()
    assert "15 s" in one.message()


def test_results_are_those_of_the_core_after_a_visit_to_the_drawing(one: Studio) -> None:
    one.load(example("pendulum"))
    one.mode("read")
    one.mode("edit")
    one.mode("read")
    one.settle()
    assert "5 s" in one.message()
    assert len(one.call("kempe.values(['rod.angle'])")["rows"][0]) == 501


def test_a_driven_mechanism_that_was_dragged_lives_from_its_start(one: Studio) -> None:
    one.load(example("quick_return"))
    start = one.state()["q"]
    one.mode("move")
    one.page.locator("#sheet").focus()
    for _ in range(4):
        one.page.keyboard.press("ArrowUp")
        one.settle()
    assert one.state()["q"] != start
    one.mode("live")
    one.wait("kempe.state().then(({ t }) => t > 0.2)", 30.0)
    assert one.message() == ""


def test_another_file_may_be_opened_while_a_motion_plays(one: Studio) -> None:
    one.load(HANGING)
    one.mode("live")
    for name in ("four_bar", "pendulum") * 6:
        one.wait("document.getElementById('live-play').title.startsWith('Pause')")
        one.call(DROP, [f"{name}.toml", example(name)])
        one.wait(f"kempe.toml().then(text => text.includes({example(name)[12:60]!r}))")
        one.settle()
        assert one.message() == ""
        play(one)
