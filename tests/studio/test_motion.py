"""A motion as people mean it: a whole turn, a swing between the ends of a crank, paths in view."""

import math

import numpy as np
import pytest
from studio.window import Opener, Studio

#: The crank cannot turn: it stops where coupler and rocker are in line.
STOPPING = """kempe = 1
gravity = [0, -9.81]

[bodies.ground]
points = { A = [0, 0], D = [0.5, 0] }
[bodies.crank]
type = "bar"
mass = 1
through = { A = [0, 0], B = [0.2, 0.25] }
[bodies.coupler]
type = "bar"
mass = 1
through = { B = [0.2, 0.25], C = [0.45, 0.3] }
[bodies.rocker]
type = "bar"
mass = 1
through = { C = [0.45, 0.3], D = [0.5, 0] }
[joints]
A = { type = "revolute", i = "ground.A", j = "crank.A" }
B = { type = "revolute", i = "crank.B", j = "coupler.B" }
C = { type = "revolute", i = "coupler.C", j = "rocker.C" }
D = { type = "revolute", i = "ground.D", j = "rocker.D" }
[parameters]
speed = "SPEED"
[drivers.motor]
type = "coordinate_driver"
coordinate = "crank.angle"
value = "51.3402*deg + speed*t"
"""
#: The dead point, by the law of cosines.
CRANK, OTHERS = math.hypot(0.2, 0.25), math.hypot(0.25, 0.05) + math.hypot(0.05, 0.3)
DEAD = math.acos((CRANK**2 + 0.5**2 - OTHERS**2) / (2 * CRANK * 0.5))
ANALYSIS = '[analyses.run]\ntype = "dynamics"\nt_end = 6\noutput_step = 0.01\n'


def load(one: Studio, more: str = "", speed: str = "10 rpm") -> None:
    one.load(STOPPING.replace("SPEED", speed) + more)
    one.settle()


def crank(one: Studio) -> list[float]:
    (found,) = one.call("kempe.values(['crank.angle'])")["rows"]
    return list(found)


@pytest.mark.parametrize("speed", ["10 rpm", "-10 rpm"])
def test_a_drawn_crank_that_cannot_turn_swings_between_its_ends(one: Studio, speed: str) -> None:
    load(one, speed=speed)
    one.mode("read")
    one.settle()
    message = one.message()
    assert f"crank stops at {math.degrees(DEAD):.2f}".rstrip("0") in message
    assert "coupler and rocker in line" in message
    assert "singular" not in message
    angles = crank(one)
    assert angles[0] == pytest.approx(math.radians(51.3402), abs=1e-4)
    assert max(angles) == pytest.approx(0.98 * DEAD, rel=1e-3)
    assert min(angles) == pytest.approx(-0.98 * DEAD, rel=1e-3)
    assert angles[-1] == pytest.approx(angles[0], abs=1e-3)  # a whole swing
    assert np.sign(angles[5] - angles[0]) == (-1 if speed.startswith("-") else 1)
    one.page.keyboard.press("Control+z")  # the law, then the analysis
    one.settle()
    assert "51.3402*deg + speed*t" in one.toml()


def test_the_analysis_of_a_case_stops_with_the_place_marked(one: Studio) -> None:
    load(one, ANALYSIS)
    text = one.toml()
    one.mode("read")
    one.settle()
    assert one.toml() == text
    assert "crank stops at 82.8" in one.message()
    assert "singular" not in one.message()
    note = one.page.locator("#note")
    assert "crank stops at" in note.inner_text()
    state_end = crank(one)[-1]
    assert state_end == pytest.approx(DEAD, abs=0.05)
    one.page.locator("#message .link").filter(has_text="Swing").click()
    one.settle()
    one.wait("kempe.toml().then(text => text.includes('sin('))")
    one.settle()
    assert max(crank(one)) == pytest.approx(0.98 * DEAD, rel=1e-3)


def test_live_says_where_the_crank_stops(one: Studio) -> None:
    load(one, speed="60 rpm")
    one.mode("live")
    one.wait("document.getElementById('message').innerText.includes('crank stops at 82.8')", 20)
    assert "singular" not in one.message()
    one.mode("edit")


def test_paths_are_in_view(studio: Opener) -> None:
    one = studio()
    one.page.locator("#new").click()
    one.settle()
    one.tool("ground")
    one.click(0.0, 0.0)
    one.tool("bar")
    one.click(0.0, 0.0)
    one.click(0.7, 0.2)
    one.page.keyboard.press("Escape")
    one.page.keyboard.press("Escape")
    one.page.keyboard.press("0")
    one.tool("coordinate_driver")
    one.click(0.35, 0.1)
    one.page.keyboard.press("Escape")
    one.mode("read")
    one.settle()
    box = one.page.locator("#sheet").bounding_box()
    assert box
    radius = math.hypot(0.7, 0.2)
    for x, y in [(radius, 0), (-radius, 0), (0, radius), (0, -radius)]:
        px, py = one.screen(x, y)
        assert box["x"] < px < box["x"] + box["width"]
        assert box["y"] < py < box["y"] + box["height"]
