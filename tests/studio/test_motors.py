"""The torque of a driver in a plot, and two mechanisms in one drawing."""

import math
from pathlib import Path

import kempe as kp
import numpy as np
import pytest
from studio.test_modes import CRANK_ROCKER
from studio.test_reading import plot_only, shown
from studio.window import Studio

DRIVEN = (
    CRANK_ROCKER.replace('[start]\nset = { "crank.angle" = "30 deg" }\n', "")
    + """
[drivers]
motor = { type = "coordinate_driver", coordinate = "crank.angle", value = "30*deg + 2*t" }

[analyses.turn]
type = "dynamics"
t_end = 1
output_step = 0.01
"""
)
FALL = """
[analyses.fall]
type = "dynamics"
t_end = 1
output_step = 0.01
"""
#: A pendulum of its own beside the crank-rocker.
TWO = (
    CRANK_ROCKER.replace("D = [4, 0] }", "D = [4, 0], O = [8, 0] }")
    .replace(
        "\n[joints]",
        'other = { type = "bar", mass = 1, length = 2, ends = ["O", "P"] }\n\n[joints]',
    )
    .replace("\n[start]", 'O = { type = "revolute", i = "ground.O", j = "other.O" }\n\n[start]')
    .replace('"30 deg" }', '"30 deg", "other.angle" = "-60 deg" }')
)


def native(text: str, tmp_path: Path) -> kp.Case:
    path = tmp_path / "case.toml"
    path.write_text(text, encoding="utf-8")
    return kp.load(path)


@pytest.mark.parametrize("quantity", ["motor.effort", "motor.torque"])
def test_the_torque_of_a_driver_is_plotted(one: Studio, tmp_path: Path, quantity: str) -> None:
    found = one.load(DRIVEN)
    assert found["problems"] == [] and found["unassembled"] is None
    one.mode("read")
    plot_only(one, quantity)
    expected = native(DRIVEN, tmp_path).run()["turn"][quantity]
    ours = one.call("name => kempe.values([name])", quantity)
    assert ours["units"] == ["N*m"]
    scale = np.abs(expected).max()
    assert scale > 1
    np.testing.assert_allclose(ours["rows"][0], expected, rtol=0, atol=1e-9 * scale)
    peak = expected[np.abs(expected).argmax()]
    assert shown(one, "peak", quantity) == pytest.approx(peak, rel=1e-3)


def test_two_mechanisms_in_one_drawing_move_independently(one: Studio) -> None:
    found = one.load(TWO)
    assert found["problems"] == [] and found["unassembled"] is None
    one.mode("move")
    assert one.page.locator("#freedom").inner_text() == "2 degrees of freedom"
    before = np.array(one.state()["q"])
    (crank, other) = (slice(0, 9), slice(9, 12))
    drag(one, (math.cos(math.pi / 6), math.sin(math.pi / 6)), (math.cos(1), math.sin(1)))
    turned = np.array(one.state()["q"])
    assert turned[2] == pytest.approx(1, abs=0.03)
    assert turned[other] == pytest.approx(before[other], abs=1e-12)
    drag(one, (9, -math.sqrt(3)), (8, -2))
    swung = np.array(one.state()["q"])
    assert swung[11] == pytest.approx(-math.pi / 2, abs=0.03)
    assert swung[crank] == pytest.approx(turned[crank], abs=1e-12)


def test_two_mechanisms_run_as_each_does_alone(one: Studio, tmp_path: Path) -> None:
    assert one.load(TWO + FALL)["problems"] == []
    one.call("kempe.run()")
    ours = one.call("kempe.values(['rocker.angle', 'other.angle'])")["rows"]
    alone = native(CRANK_ROCKER + FALL, tmp_path).run()["fall"]["rocker.angle"]
    np.testing.assert_allclose(ours[0], alone, rtol=0, atol=1e-5)
    assert np.ptp(alone) > 0.3
    assert np.ptp(ours[1]) > 0.3


def drag(one: Studio, begin: tuple[float, float], end: tuple[float, float]) -> None:
    one.page.mouse.move(*one.screen(*begin))
    one.page.mouse.down()
    one.page.mouse.move(*one.screen(*end), steps=12)
    one.settle()
    one.page.mouse.up()
    one.settle()
