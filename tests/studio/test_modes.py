"""Moving, living and reading, compared with the results of Python."""

import itertools
import math
import re
from pathlib import Path
from typing import Any

import kempe as kp
import pytest
from studio.window import Finger, Mouse, Opener, Studio

EXAMPLES = Path(__file__).parents[2] / "examples"
CRANK_ROCKER = """kempe = 1
title = "Crank-rocker"
gravity = [0, -9.81]

[bodies]
ground = { points = { A = [0, 0], D = [4, 0] } }
crank = { type = "bar", mass = 1, length = 1, ends = ["A", "B"] }
coupler = { type = "bar", mass = 1, length = 3.5, ends = ["B", "C"] }
rocker = { type = "bar", mass = 1, length = 3, ends = ["D", "C"] }

[joints]
A = { type = "revolute", i = "ground.A", j = "crank.A" }
B = { type = "revolute", i = "crank.B", j = "coupler.B" }
C = { type = "revolute", i = "coupler.C", j = "rocker.C" }
D = { type = "revolute", i = "ground.D", j = "rocker.D" }

[start]
set = { "crank.angle" = "30 deg" }
"""


def gap(q: list[float]) -> float:
    """How far the coupler and the rocker are apart at C, m."""
    (_, _, _, x2, y2, a2, x3, y3, a3) = q
    end = (x2 + 1.75 * math.cos(a2), y2 + 1.75 * math.sin(a2))
    other = (x3 + 1.5 * math.cos(a3), y3 + 1.5 * math.sin(a3))
    return math.dist(end, other)


def drag_around(studio: Studio, angles: list[float], hand: Mouse | Finger) -> list[list[float]]:
    """Drag the end of the crank to these angles; returns q at each."""
    states = []
    hand.down(*studio.screen(math.cos(angles[0]), math.sin(angles[0])))
    for angle in angles:
        hand.move(*studio.screen(math.cos(angle), math.sin(angle)))
        studio.settle()
        states.append(studio.state()["q"])
    hand.up()
    return states


#: How a crank is dragged: with a mouse on a desktop, with a finger on a phone.
DESKTOP = ({"width": 1280, "height": 800}, Mouse)
PHONE = (
    {"width": 390, "height": 844, "has_touch": True, "is_mobile": True, "device_scale_factor": 2},
    Finger,
)
devices = pytest.mark.parametrize(("window", "hand"), [DESKTOP, PHONE], ids=["desktop", "phone"])


@devices
def test_a_crank_is_dragged_through_a_turn_on_one_branch(
    studio: Opener, fresh: Opener, window: dict[str, Any], hand: type[Mouse | Finger]
) -> None:
    one = fresh(**window) if hand is Finger else studio(**window)
    assert one.load(CRANK_ROCKER)["problems"] == []
    one.mode("move")
    angles = [math.radians(30 + 15 * k) for k in range(25)]
    states = drag_around(one, angles, hand(one))
    assert max(map(gap, states)) < 1e-9
    for q, angle in zip(states, angles, strict=True):
        assert q[2] == pytest.approx(angle, abs=0.03)
    turns = [q[8] for q in states]
    assert max(abs(b - a) for a, b in itertools.pairwise(turns)) < 0.5
    assert turns[-1] == pytest.approx(turns[0], abs=0.03)


@devices
def test_a_crank_that_cannot_turn_stops_at_its_dead_point(
    studio: Opener, fresh: Opener, window: dict[str, Any], hand: type[Mouse | Finger]
) -> None:
    one = fresh(**window) if hand is Finger else studio(**window)
    one.load(
        CRANK_ROCKER.replace("length = 3.5,", "length = 2.5,").replace("length = 3,", "length = 2,")
    )
    one.mode("move")
    begin = one.state()["q"][2]
    states = drag_around(one, [begin + math.radians(10 * k) for k in range(13)], hand(one))
    limit = math.acos((1 + 16 - 4.5**2) / 8)  # where coupler and rocker are in line
    assert states[-1][2] == pytest.approx(limit, abs=1e-3)
    assert one.message().strip()


def test_assembly_modes_are_found_and_chosen(studio: Opener) -> None:
    one = studio()
    one.load(CRANK_ROCKER)
    one.mode("move")
    before = one.state()["q"]
    one.page.locator("#find-configurations").click()
    one.settle()
    modes = one.page.get_by_role("button", name=re.compile(r"^Mode \d"))
    assert modes.count() == 2
    for k in range(2):
        modes.nth(k).click()
        one.settle()
        q = one.state()["q"]
        assert gap(q) < 1e-9
        assert q[2] == pytest.approx(before[2], abs=1e-9)


def test_a_linkage_at_a_change_point_has_its_panels(studio: Opener) -> None:
    """The arms of the wiper are parallel: which link turns fully depends on the branch."""
    one = studio()
    one.load((EXAMPLES / "wiper.toml").read_text(encoding="utf-8"))
    one.mode("move")
    assert "change point" in one.page.locator(".properties").inner_text()
    one.mode("read")
    one.page.locator("#analysis").select_option("over a quantity")
    one.settle()
    assert one.page.locator("#over option").count() > 3


def test_a_pendulum_swings_in_real_time_and_keeps_its_energy(studio: Opener) -> None:
    one = studio()
    one.load((EXAMPLES / "pendulum.toml").read_text(encoding="utf-8"))
    one.mode("live")
    one.page.wait_for_timeout(1200)
    state = one.state()
    assert 0.3 < state["t"] < 4
    one.page.keyboard.press("Space")
    one.settle()
    stopped = one.state()["t"]
    one.page.wait_for_timeout(200)
    assert one.state()["t"] == stopped
    assert one.page.locator(".facts").first.is_visible()


def test_a_run_has_the_values_of_python(studio: Opener) -> None:
    one = studio()
    path = EXAMPLES / "four_bar.toml"
    one.load(path.read_text(encoding="utf-8"))
    case = kp.load(path)
    start = case.start()
    for name in ("crank.angle", "coupler.x", "C.force"):
        assert one.quantity(name) == pytest.approx(start[name], rel=1e-9)
    found = one.call("kempe.run()")
    solution = case.run()["release"]
    assert found["count"] == len(solution.t)
    assert found["t_end"] == pytest.approx(15)
    assert one.page.locator("#play").is_visible()
    assert one.page.locator(".plot").count() == 1
