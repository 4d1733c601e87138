"""Plots: the value under the pointer, a shared window, keys, pictures, stored runs."""

import re
import xml.etree.ElementTree as ET
from pathlib import Path

import kempe as kp
import numpy as np
import pytest
from python.test_design_kinematics import four_bar
from studio.test_files import given
from studio.test_reading import choose, plot_only
from studio.window import Studio

EXAMPLES = Path(__file__).parents[2] / "examples"
CASE = EXAMPLES / "pendulum.toml"
GUESS = {"coupler.angle": "50 deg", "rocker.angle": "-90 deg"}
PNG = b"\x89PNG\r\n\x1a\n"
SVG = "{http://www.w3.org/2000/svg}"


def opened(one: Studio, *quantities: str) -> kp.Solution:
    """The run of the pendulum with a plot for each quantity; the same run in Python."""
    one.load(CASE.read_text(encoding="utf-8"))
    one.mode("read")
    for quantity in quantities:
        plot_only(one, quantity)
    return kp.load(CASE).run()["swing"]


def box(one: Studio, plot: int) -> dict[str, float]:
    canvas = one.page.locator(".curves").nth(plot)
    canvas.scroll_into_view_if_needed()
    found = canvas.bounding_box()
    assert found is not None
    return dict(found)


def point_at(one: Studio, plot: int, share: float) -> None:
    """The pointer over a plot, at a share of its width."""
    of = box(one, plot)
    one.page.mouse.move(of["x"] + share * of["width"], of["y"] + 0.5 * of["height"])
    one.settle()


def now(one: Studio) -> list[float]:
    """The values of the first and of the last curve in the legends, in the units of the axes."""
    texts = one.page.locator(".legend .now").all_inner_texts()
    numbers = [float(re.findall(r"-?[\d.]+", one.replace("−", "-"))[0]) for one in texts]
    return [numbers[0], numbers[-1]]


def test_all_plots_give_their_values_at_the_time_under_the_pointer(one: Studio) -> None:
    solution = opened(one, "rod.omega")
    angle, omega = solution["rod.angle"] * 180 / np.pi, solution["rod.omega"] * 30 / np.pi
    before = now(one)
    assert before == pytest.approx([angle[0], omega[0]], abs=1e-2)
    seen = []
    for share in (0.3, 0.5, 0.9):
        point_at(one, 0, share)
        seen.append(now(one))
    for pair in seen:  # both values belong to one time of the run
        away = np.hypot((angle - pair[0]) / np.ptp(angle), (omega - pair[1]) / np.ptp(omega))
        assert away.min() < 2e-3, pair
    assert len({tuple(pair) for pair in seen}) == len(seen)
    one.page.mouse.move(5, 5)
    one.settle()
    assert now(one) == before
    assert one.state()["t"] == solution.t[0]  # looking moves nothing
    of = box(one, 0)
    one.page.mouse.click(of["x"] + 0.5 * of["width"], of["y"] + 0.5 * of["height"])
    one.settle()
    assert one.state()["t"] == pytest.approx(0.5 * solution.t[-1], abs=0.1 * solution.t[-1])


def texts(one: Studio, tmp_path: Path) -> list[str]:
    """All texts of the plots, from their picture as SVG: ticks, labels, legends."""
    path = given(one, "Save the plots as SVG", tmp_path / "plots.svg")
    root = ET.fromstring(path.read_text(encoding="utf-8"))
    return [one.text or "" for one in root.iter(f"{SVG}text")]


def test_all_plots_are_stretched_together_by_keys_and_by_the_wheel(
    one: Studio, tmp_path: Path
) -> None:
    opened(one, "rod.omega")
    whole = texts(one, tmp_path)
    canvas = one.page.locator(".curves").first
    canvas.focus()
    for _ in range(6):
        one.page.keyboard.press("+")
    one.settle()
    near = texts(one, tmp_path)
    assert near != whole
    canvas.focus()
    one.page.keyboard.press("0")
    one.settle()
    assert texts(one, tmp_path) == whole
    point_at(one, 1, 0.5)
    one.page.keyboard.down("Control")
    for _ in range(4):
        one.page.mouse.wheel(0, -200)
    one.page.keyboard.up("Control")
    one.settle()
    assert texts(one, tmp_path) != whole
    of = box(one, 1)
    one.page.mouse.dblclick(of["x"] + 0.5 * of["width"], of["y"] + 0.5 * of["height"])
    one.settle()
    one.page.locator("#scrub").fill("0")
    one.settle()
    assert texts(one, tmp_path) == whole


def test_pictures_of_the_plots_have_axes_curves_and_legends(one: Studio, tmp_path: Path) -> None:
    opened(one, "rod.omega")
    path = given(one, "Save the plots as SVG", tmp_path / "plots.svg")
    root = ET.fromstring(path.read_text(encoding="utf-8"))
    written = [one.text or "" for one in root.iter(f"{SVG}text")]
    for text in ("rod.angle / °", "rod.omega / rpm", "t / s"):
        assert text in written
    assert any(text.startswith("rod.omega  ") for text in written)
    longest = sorted(len(one.get("d", "")) for one in root.iter(f"{SVG}path"))[-2:]
    assert longest[0] > 1000  # two curves of some hundred points
    path = given(one, "Save the plots as PNG", tmp_path / "plots.png")
    assert path.read_bytes().startswith(PNG)


def test_a_logarithmic_axis(one: Studio, tmp_path: Path) -> None:
    opened(one, "pin.force")
    box_of_log = one.page.locator(".plot").nth(1).get_by_label("log")
    box_of_log.check()
    one.settle()
    assert any("10⁰" in text or "10¹" in text for text in texts(one, tmp_path))
    box_of_log.uncheck()


def machine(one: Studio, tmp_path: Path, *analyses: kp.Kinematics) -> kp.Case:
    path = tmp_path / "machine.toml"
    kp.Case(four_bar(), {"guess": GUESS}, list(analyses)).save(path)
    assert one.load(path.read_text(encoding="utf-8"))["problems"] == []
    one.mode("read")
    one.page.get_by_label("Add plot").select_option("rocker.angle")
    one.settle()
    return kp.load(path)


TURN = kp.Kinematics(over="crank.angle", range=(0, "2*pi"), name="turn")
TIMED = kp.Kinematics(t_end=2, output_step=0.01, name="timed")


def stored_words(one: Studio) -> int:
    """How many curves have a stored one beside them."""
    entries = one.page.locator(".legend li").all_inner_texts()
    return sum("stored" in entry for entry in entries)


def test_a_stored_run_over_an_angle_is_not_drawn_over_the_time(one: Studio, tmp_path: Path) -> None:
    solution = machine(one, tmp_path, TURN).run()["turn"]
    path = tmp_path / "turn.npz"
    solution.save(path)
    choose(one, path)
    assert stored_words(one) > 0  # over the same angle it is
    assert one.page.locator("#other-axis").count() == 0
    machine(one, tmp_path, TIMED)
    choose(one, path)
    assert stored_words(one) == 0
    words = one.page.locator("#other-axis").inner_text()
    assert "over crank.angle" in words
    assert "It is not drawn" in words
    end = one.page.locator("#scrub").get_attribute("max")
    assert float(end or "") == pytest.approx(2)


def test_of_a_stored_run_over_the_time_positions_are_drawn_over_the_angle(
    one: Studio, tmp_path: Path
) -> None:
    path = tmp_path / "timed.npz"
    machine(one, tmp_path, TIMED).run()["timed"].save(path)
    machine(one, tmp_path, TURN)
    one.page.get_by_label("Add plot").select_option("rocker.omega")
    one.settle()
    choose(one, path)
    assert "Only its positions are drawn" in one.page.locator("#other-axis").inner_text()
    entries = one.page.locator(".legend li").all_inner_texts()
    assert any("rocker.angle" in entry and "stored" in entry for entry in entries)
    assert not any("rocker.omega" in entry and "stored" in entry for entry in entries)


def test_the_pages_own_archive_keeps_what_its_run_is_over(one: Studio, tmp_path: Path) -> None:
    machine(one, tmp_path, TURN)
    hint = "Save times, poses and plotted quantities for NumPy"
    path = given(one, hint, tmp_path / "turn.npz")
    with np.load(path) as arrays:
        assert list(arrays["variable"]) == ["crank.angle", "rad"]
        assert arrays["t"][-1] == pytest.approx(2 * np.pi)
    machine(one, tmp_path, TIMED)
    choose(one, path)
    assert stored_words(one) == 0
    assert "over crank.angle" in one.page.locator("#other-axis").inner_text()
