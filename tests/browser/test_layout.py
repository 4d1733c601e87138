"""The page at every size: nothing is cut or covered, and playback stays on the screen."""

import importlib.util
import io
import itertools
from pathlib import Path
from types import ModuleType
from typing import Any

import kempe as kp
import numpy as np
import pytest
from browser.test_player import picture
from browser.test_values import example
from house.places import ROOT
from PIL import Image
from sizes import some

SIZES = [(1280, 800), (390, 844), (844, 390)]
SCHEMES = ["light", "dark"]
SHORT = ["four_bar", "pendulum", "six_bar", "slider_crank", "squeezer"]
#: Each example and each size at least once.
PAGES = some([*itertools.product(SHORT, SIZES)], 8)


@pytest.fixture(scope="session")
def examples() -> dict[str, kp.Solution]:
    return {name: example(name) for name in SHORT} | {"n_four_bar": windows(4)}


def script(path: Path) -> ModuleType:
    spec = importlib.util.spec_from_file_location(path.stem, path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def windows(n: int) -> kp.Solution:
    module = script(ROOT / "examples" / "n_four_bar.py")
    model = module.windows(n)
    return kp.dynamics(model, module.upright(model, n), t_end=2.0, output_step=0.01)


def inside(box: dict[str, float], width: float, height: float) -> bool:
    fits = box["x"] >= 0 and box["x"] + box["width"] <= width
    return fits and box["y"] >= 0 and box["y"] + box["height"] <= height


@pytest.mark.parametrize("size", SIZES, ids=str)
@pytest.mark.parametrize("name", ["six_bar", "slider_crank", "n_four_bar"])
def test_playback_is_on_the_screen(
    opened: Any, examples: dict[str, kp.Solution], name: str, size: tuple[int, int]
) -> None:
    watched = opened(examples[name], *size)
    for kind in ("reactions", "velocities", "accelerations"):
        watched.page.check(f"#show-{kind}")
    watched.page.click("#add-plot")
    for place in (0, 100_000):  # also when the page is scrolled
        watched.page.evaluate(f"window.scrollTo(0, {place})")
        watched.settle()
        for control in ("#play", "#first", "#last", "#scrub", "#speed", "#loop"):
            assert inside(watched.page.locator(control).bounding_box(), *size), control
    watched.page.click("#play")
    watched.wait("kempe.state().t > 0")
    assert watched.page.evaluate("document.documentElement.scrollWidth") == size[0]


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_the_drawing_is_seen_beside_playback(
    opened: Any, examples: dict[str, kp.Solution], size: tuple[int, int]
) -> None:
    watched = opened(examples["six_bar"], *size)
    drawing = watched.page.locator("#drawing").bounding_box()
    footer = watched.page.locator("footer").bounding_box()
    assert drawing["y"] + drawing["height"] <= footer["y"]
    assert drawing["width"] >= 300
    assert drawing["height"] >= 200


@pytest.mark.parametrize(("name", "size"), PAGES, ids=str)
def test_no_button_covers_the_drawing_and_all_of_it_is_seen(
    opened: Any, examples: dict[str, kp.Solution], name: str, size: tuple[int, int]
) -> None:
    watched = opened(examples[name], *size)
    watched.page.check("#show-reactions")
    drawing = watched.page.locator("#drawing").bounding_box()
    for button in watched.page.locator("#drawing-panel button:visible").all():
        box = button.bounding_box()
        apart = box["x"] + box["width"] <= drawing["x"] or box["y"] + box["height"] <= drawing["y"]
        assert apart, button
        assert box["y"] + box["height"] <= drawing["y"] + drawing["height"]
    end = watched.state()["end"]
    for t in np.linspace(0.0, end, 7):
        watched.seek(float(t))
        for pin in watched.state()["pins"]:
            assert drawing["x"] < pin["x"] < drawing["x"] + drawing["width"]
            assert drawing["y"] < pin["y"] < drawing["y"] + drawing["height"] - 26  # the scales


@pytest.mark.parametrize("size", SIZES, ids=str)
@pytest.mark.parametrize("name", ["squeezer", "n_four_bar"])
def test_the_whole_legend_can_be_seen(
    opened: Any, examples: dict[str, kp.Solution], name: str, size: tuple[int, int]
) -> None:
    watched = opened(examples[name], *size)
    watched.choose("Reaction force", "All")
    joints = examples[name].model.joints
    assert list(watched.values()) == [f"{joint}.force" for joint in joints]
    assert len(joints) > 8
    hidden = "one => one.scrollHeight - one.clientHeight"  # the list of plots scrolls, not this
    assert watched.page.locator(".legend").evaluate(hidden) <= 1
    overflow = "one => getComputedStyle(one).overflowY"
    assert watched.page.locator("#scroll").evaluate(overflow) in ("auto", "visible")
    footer = watched.page.locator("footer").bounding_box()
    for entry in watched.page.locator(".legend li").all():
        entry.evaluate("one => one.scrollIntoView({ block: 'center' })")
        box, legend = entry.bounding_box(), watched.page.locator(".legend").bounding_box()
        assert inside(box, size[0], footer["y"])
        assert box["y"] + box["height"] <= legend["y"] + legend["height"] + 0.5
        shown = entry.evaluate(
            """one => { const box = one.getBoundingClientRect();
            return one.contains(document.elementFromPoint(box.x + 40, box.y + box.height / 2)); }"""
        )
        assert shown, "something covers the entry"


def test_curves_of_one_plot_can_be_distinguished(
    opened: Any, examples: dict[str, kp.Solution]
) -> None:
    watched = opened(examples["n_four_bar"], 1280, 800)
    watched.choose("Reaction force", "All")
    looks = watched.page.evaluate(
        """[...document.querySelectorAll(".legend line")].map(one =>
        one.getAttribute("stroke") + "|" + one.getAttribute("stroke-dasharray"))"""
    )
    assert len(looks) == len(set(looks)) == 13


@pytest.mark.parametrize(("name", "size"), PAGES, ids=str)
def test_no_text_of_a_plot_is_cut(
    opened: Any, examples: dict[str, kp.Solution], name: str, size: tuple[int, int]
) -> None:
    watched = opened(examples[name], *size)
    end = watched.state()["end"]
    for quantity in ("Angle", "Reaction force", "Energy", "Acceleration"):
        watched.choose(quantity)
        for log in (False, True):
            watched.page.locator(".log").set_checked(log)
            watched.settle()
            box, texts = watched.page.locator(".curves").bounding_box(), watched.texts(".curves")
            for one in texts:
                assert one["left"] >= -0.5, one
                assert one["right"] <= box["width"] + 0.5, one
                assert one["top"] >= -0.5, one
                assert one["bottom"] <= box["height"] + 0.5, one
            bottom = [one for one in texts if one["top"] > box["height"] - 34]
            ticks = sorted(float(one["text"]) for one in bottom if one["text"] != "t / s")
            assert ticks[-1] > end - (ticks[1] - ticks[0]) * 0.999  # the last one is there


def test_plots_can_be_added_and_removed(opened: Any, examples: dict[str, kp.Solution]) -> None:
    watched = opened(examples["six_bar"], 1280, 800)
    assert watched.page.locator(".remove:visible").count() == 0
    while watched.page.is_enabled("#add-plot"):
        watched.page.click("#add-plot")
    names = [one["name"] for one in watched.state()["plots"]]
    assert len(names) == len(set(names)) == 6
    watched.page.locator(".remove").nth(2).click()
    del names[2]
    assert [one["name"] for one in watched.state()["plots"]] == names
    assert watched.page.is_enabled("#add-plot")
    canvases = watched.page.locator(".curves").all()
    assert all(one.bounding_box()["height"] >= 150 for one in canvases)
    watched.choose("Energy", "energy.kinetic", 4)
    before = picture(watched, ".plot:nth-child(1) .curves")
    watched.seek(1.5)
    assert (picture(watched, ".plot:nth-child(1) .curves") != before).any()


@pytest.mark.parametrize("scheme", SCHEMES)
def test_pictures_are_on_white_paper(
    opened: Any, examples: dict[str, kp.Solution], scheme: str
) -> None:
    watched = opened(examples["six_bar"], 1280, 800, color_scheme=scheme)
    watched.page.click("#add-plot")
    for button, ending in (("#save-drawing", "drawing.png"), ("#save-plots", "plots.png")):
        with watched.page.expect_download() as offered:
            watched.page.click(button)
        name = offered.value.suggested_filename
        assert name == f"six_bar_linkage_of_watt_s_second_kind_dr_{ending}"
        image = Image.open(io.BytesIO(offered.value.path().read_bytes())).convert("RGB")
        pixels = np.array(image)
        assert min(image.size) > 600
        assert (pixels[[0, -1]][:, [0, -1]] == 255).all()
        assert (pixels.reshape(-1, 3) == 255).all(axis=1).mean() > 0.5
        colours = pixels[::5].astype(int) @ (1 << 16, 1 << 8, 1)
        assert len(np.unique(colours)) > 50
    panel = "getComputedStyle(document.documentElement).getPropertyValue('--panel').trim()"
    assert watched.page.evaluate(panel) == {"light": "#ffffff", "dark": "#181c22"}[scheme]


def test_nothing_moves_by_itself(opened: Any, examples: dict[str, kp.Solution]) -> None:
    watched = opened(examples["pendulum"], 1280, 800, reduced_motion="reduce")
    watched.page.wait_for_timeout(300)
    assert watched.state()["playing"] is False
    assert watched.state()["t"] == 0.0
    moving = "[...document.querySelectorAll('*')].map(one => getComputedStyle(one))" + (
        ".filter(one => one.transitionDuration !== '0s' || one.animationName !== 'none').length"
    )
    assert watched.page.evaluate(moving) == 0
