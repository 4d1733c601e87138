"""Drivers that are added by a click: they fit the start, play, and have a speed in any unit."""

import math
from pathlib import Path

import pytest
from studio.window import Opener, Studio

EXAMPLES = Path(__file__).parents[2] / "examples"
# A block on a guide at an angle of its own, and a rod that hangs on it.
GUIDED = """kempe = 1
title = "Guided block"

[bodies.ground]
points = { O = [0, 0] }

[bodies.block]
mass = 1
inertia = 0.1
points = { P = [0, 0], Q = [0.2, 0.1], R = [-0.2, 0.1] }

[joints.guide]
type = "translational"
i = "ground.O"
j = "block.P"
axes = [SLOPE, 0]

[start]
set = { "block.x" = 0.25 }
"""


def drive(one: Studio, x: str, y: str) -> dict[str, str]:
    """Add a driver by a click at the place of a point; returns its table."""
    one.mode("edit")
    before = set(one.tree().get("drivers", {}))
    one.tool("coordinate_driver")
    one.click(one.quantity(x), one.quantity(y))
    one.page.keyboard.press("Escape")
    one.settle()
    found: dict[str, dict[str, str]] = one.tree()["drivers"]
    (name,) = set(found) - before
    return found[name]


def play(one: Studio, name: str, until: float = 0.3) -> tuple[float, float]:
    """Play what is shown up to a time; returns the time and the quantity."""
    one.wait(f"kempe.state().then(state => state.t > {until})", 20.0)
    one.page.keyboard.press("Space")
    one.settle()
    return one.state()["t"], one.quantity(name)


@pytest.mark.parametrize(
    ("example", "point", "coordinate", "begin", "speed"),
    [
        ("four_bar", "crank.B", "crank.angle", "70*deg", "10 rpm"),
        ("pendulum", "rod.B", "rod.angle", "-60*deg", "10 rpm"),
        ("slider_crank", "crank.A", "crank.angle", "60*deg", "30 rad/s"),
        ("double_pendulum", "first.A", "first.angle", "100*deg", "10 rpm"),
    ],
)
def test_a_driver_fits_the_start_of_an_example_and_plays(
    one: Studio, example: str, point: str, coordinate: str, begin: str, speed: str
) -> None:
    text = (EXAMPLES / f"{example}.toml").read_text(encoding="utf-8")
    one.load(text)
    found = drive(one, f"{point}.x", f"{point}.y")
    assert found["coordinate"] == coordinate
    assert found["value"] == f"{begin} + speed1*t"
    assert one.tree()["parameters"]["speed1"] == speed
    assert one.page.locator("footer .problem").count() == 0
    first = one.quantity(found["coordinate"])
    one.mode("live")
    t, angle = play(one, found["coordinate"])
    number, unit = speed.split()
    rate = float(number) * (math.pi / 30 if unit == "rpm" else 1)
    assert angle == pytest.approx(first + rate * t, abs=1e-6)


@pytest.mark.parametrize(("slope", "coordinate"), [("0", "x"), ("0.3", "x"), ("1.2", "y")])
def test_a_guided_block_slides_at_the_speed_of_its_parameter(
    one: Studio, slope: str, coordinate: str
) -> None:
    one.load(GUIDED.replace("SLOPE", slope))
    found = drive(one, "block.Q.x", "block.Q.y")
    assert found["coordinate"] == f"block.{coordinate}"
    assert one.tree()["parameters"]["speed1"].endswith(" mm/s")
    one.mode("move")
    field = one.page.get_by_label("speed1", exact=True)
    field.fill("30 mm/s")
    field.press("Enter")
    one.settle()
    first = one.quantity(found["coordinate"])
    one.page.locator("#play-drivers").click()
    one.page.locator("#sheet").focus()
    t, place = play(one, found["coordinate"])
    assert place == pytest.approx(first + 0.03 * t, abs=1e-7)
    assert "30.00 mm/s" in one.page.locator(".side").inner_text()


def test_a_guide_upwards_is_driven_along_y(one: Studio) -> None:
    one.load(GUIDED.replace("SLOPE", '"pi/2"').replace('"block.x" = 0.25', '"block.y" = 0.25'))
    assert drive(one, "block.Q.x", "block.Q.y")["coordinate"] == "block.y"


def test_the_speed_is_shown_and_written_in_the_users_unit(studio: Opener) -> None:
    one = studio()
    one.load((EXAMPLES / "four_bar.toml").read_text(encoding="utf-8"))
    drive(one, "crank.B.x", "crank.B.y")
    one.mode("move")
    side = one.page.locator(".side")
    assert "10.00 rpm" in side.inner_text()
    field = one.page.get_by_label("speed1", exact=True)
    field.fill("2 rad/s")
    field.press("Enter")
    one.settle()
    assert one.tree()["parameters"]["speed1"] == "2 rad/s"
    assert "19.10 rpm" in side.inner_text()
    one.mode("live")
    one.page.keyboard.press("Space")
    assert one.page.locator(".slider output").first.inner_text() == "19.10 rpm"


def test_a_body_without_freedom_is_not_driven(one: Studio) -> None:
    one.load((EXAMPLES / "pendulum.toml").read_text(encoding="utf-8"))
    drive(one, "rod.B.x", "rod.B.y")
    before = one.toml()
    one.tool("coordinate_driver")
    one.click(one.quantity("rod.B.x"), one.quantity("rod.B.y"))
    assert one.toml() == before
    assert "no freedom" in one.message()
