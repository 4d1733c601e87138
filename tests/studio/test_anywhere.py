"""What was drawn in the page runs on the command line."""

from pathlib import Path

import kempe as kp
import numpy as np
import pytest
from studio.test_drawing import draw_four_bar
from studio.window import Opener, Studio


def saved(one: Studio, path: Path) -> kp.Case:
    """The case of the file that the page saves."""
    with one.page.expect_download() as download:
        one.page.locator("#save").click()
    download.value.save_as(path)
    return kp.load(path)


def drive(one: Studio, x: float, y: float) -> None:
    one.tool("coordinate_driver")
    one.click(x, y)
    one.page.keyboard.press("Escape")


def test_a_drawn_case_is_run_by_kempe_run_as_by_read(studio: Opener, tmp_path: Path) -> None:
    one = studio()
    draw_four_bar(one)
    drive(one, -0.35, -0.15)
    one.mode("read")
    one.settle()
    values = one.call("kempe.values(['bar3.angle'])")
    case = saved(one, tmp_path / "drawn.toml")
    (solution,) = case.run().values()
    assert solution.t[-1] == pytest.approx(6)  # one turn at 10 rpm
    turn = solution["bar1.angle"][-1] - solution["bar1.angle"][0]
    assert turn == pytest.approx(2 * np.pi, rel=1e-5)
    np.testing.assert_allclose(values["rows"][0], solution["bar3.angle"], rtol=0, atol=1e-8)


def test_a_case_that_was_only_drawn_has_an_analysis_too(studio: Opener, tmp_path: Path) -> None:
    one = studio()
    draw_four_bar(one)
    case = saved(one, tmp_path / "drawn.toml")
    (solution,) = case.run().values()
    assert solution.t[-1] == 5
    again = saved(one, tmp_path / "again.toml")
    assert len(again.run()) == 1


def test_a_case_with_an_analysis_is_saved_as_it_is(studio: Opener, tmp_path: Path) -> None:
    one = studio()
    text = one.toml()
    one.mode("read")
    one.settle()
    saved(one, tmp_path / "case.toml")
    assert (tmp_path / "case.toml").read_text(encoding="utf-8") == text


def test_read_begins_where_a_driven_crank_was_moved(studio: Opener) -> None:
    one = studio()
    draw_four_bar(one)
    drive(one, -0.35, -0.15)
    one.mode("move")
    one.page.mouse.move(*one.screen(-0.3, -0.1))
    one.page.mouse.down()
    one.page.mouse.move(*one.screen(-0.4, -0.05), steps=6)
    one.page.mouse.up()
    one.settle()
    moved = one.quantity("bar1.angle")
    assert moved > 1.3  # it was at 45°
    one.mode("read")
    one.settle()
    (angles,) = one.call("kempe.values(['bar1.angle'])")["rows"]
    assert angles[0] == pytest.approx(moved, abs=1e-5)
    assert angles[-1] - angles[0] == pytest.approx(2 * np.pi, rel=1e-5)


def test_live_and_read_begin_at_the_drawn_pose(studio: Opener) -> None:
    one = studio()
    draw_four_bar(one)
    drive(one, -0.35, -0.15)
    one.mode("live")
    one.wait("kempe.state().then(({ t }) => t > 0.3)")
    one.mode("read")
    one.settle()
    found = one.call("kempe.values(['bar1.angle'])")
    assert found["t"][0] == 0
    assert found["rows"][0][0] == pytest.approx(np.pi / 4, abs=1e-6)
    one.mode("live")
    one.page.keyboard.press("Space")
    assert one.state()["t"] < 0.5
