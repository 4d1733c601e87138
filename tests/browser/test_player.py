"""The player in a browser: it shows the solution, and does what its controls say."""

import io
import re
from typing import Any

import kempe as kp
import numpy as np
import pytest
from draw.mechanisms import (
    HOSTILE,
    PLAIN,
    moving,
    pendulum,
    point_pendulum,
    slider_crank,
    sprung,
)
from house.places import PACKAGE, ROOT
from kempe.draw.frame import frame_items
from kempe.draw.placing import View, place
from PIL import Image

SIZES = [(1600, 900), (600, 800)]
#: The colour of forces.
VIOLET = np.array([0x7A, 0x3D, 0xB8])


@pytest.fixture(scope="session")
def solutions() -> dict[str, kp.Solution]:
    return {"plain": moving(), "hostile": moving(HOSTILE)}


def picture(watched: Any, selector: str = "#drawing") -> np.ndarray:
    """What is seen of an element, (height, width, 3)."""
    shot = watched.page.locator(selector).screenshot()
    return np.array(Image.open(io.BytesIO(shot)).convert("RGB")).astype(int)


def pins(watched: Any) -> np.ndarray:
    return np.array([[pin["x"], pin["y"]] for pin in watched.state()["pins"]])


def in_the_window(solution: kp.Solution, t: float, ground: np.ndarray) -> np.ndarray:
    """Where the four joints must be, given where A = (0, 0) and D = (20, 0) are seen."""
    state = solution(t)
    crank, _, rocker = state.model.bodies
    scale = (ground[1, 0] - ground[0, 0]) / 20.0
    moving_pins = [state.body(crank).point("B").position, state.body(rocker).point("C").position]
    plane = np.array([[0, 0], *moving_pins, [20, 0]])
    return ground[0] + scale * plane * [1, -1]


@pytest.mark.parametrize("size", SIZES, ids=str)
@pytest.mark.parametrize("names", ["plain", "hostile"])
def test_pins_are_where_the_solution_has_them(
    opened: Any, solutions: dict[str, kp.Solution], names: str, size: tuple[int, int]
) -> None:
    watched, solution = opened(solutions[names], *size), solutions[names]
    told = {"plain": PLAIN, "hostile": HOSTILE}[names]
    assert [pin["name"] for pin in watched.state()["pins"]] == [told[name] for name in "ABCD"]
    watched.page.uncheck("#show-names")
    box = watched.page.locator("#drawing").bounding_box()
    for t in (0.0, 0.0613, 0.5, 1.0):
        watched.page.evaluate(f"kempe.seek({t})")
        watched.settle()
        seen = pins(watched)
        np.testing.assert_allclose(seen, in_the_window(solution, t, seen[[0, 3]]), atol=1.0)
        pixels = picture(watched)
        for x, y in seen - [box["x"], box["y"]]:
            column, row = int(x), int(y)
            assert (pixels[row, column] > 240).all()  # the white of the pin
            ring = pixels[row - 8 : row + 9, column - 8 : column + 9]
            dark = np.argwhere((ring < 110).all(axis=2))
            assert np.abs(dark.mean(axis=0) - 8.0).max() < 4.0
    assert watched.page.title() == told["title"]
    assert watched.page.locator("#title").text_content() == told["title"]


def test_it_plays_pauses_and_ends(opened: Any, solutions: dict[str, kp.Solution]) -> None:
    watched = opened(solutions["plain"], 1280, 720)
    before = picture(watched)
    assert len(np.unique(before.reshape(-1, 3), axis=0)) > 20  # not blank
    watched.page.click("#play")
    watched.wait("kempe.state().t > 0.05")
    assert watched.state()["playing"] is True
    assert watched.page.get_attribute("#play", "aria-label") == "Pause"
    watched.page.click("#play")
    paused = watched.state()
    assert paused["playing"] is False
    assert (picture(watched) != before).any()
    watched.page.wait_for_timeout(150)
    assert watched.state()["t"] == paused["t"]
    watched.page.select_option("#speed", label="5×")  # half of real time at normal speed
    watched.page.evaluate("kempe.play()")
    watched.wait("!kempe.state().playing")
    assert watched.state()["t"] == 1.0


def test_repeat_starts_again(opened: Any, solutions: dict[str, kp.Solution]) -> None:
    watched = opened(solutions["plain"], 1280, 720)
    watched.page.click("#loop")
    assert watched.page.get_attribute("#loop", "aria-pressed") == "true"
    watched.page.select_option("#speed", label="5×")
    watched.page.evaluate("kempe.seek(0.95); kempe.play()")
    watched.wait("kempe.state().t < 0.9")
    assert watched.state()["playing"] is True


def test_keys(opened: Any, solutions: dict[str, kp.Solution]) -> None:
    watched = opened(solutions["plain"], 1280, 720)
    press = watched.page.keyboard.press
    frames = []
    for key in ("ArrowRight", "ArrowRight", "ArrowLeft", "Shift+ArrowRight", "End", "Home"):
        press(key)
        frames.append(watched.state()["frame"])
    assert frames == [1, 2, 1, 11, 240, 0]
    press("ArrowUp")
    assert watched.state()["speed"] == 2
    press("ArrowDown")
    press("ArrowDown")
    assert watched.state()["speed"] == 0.5
    press(" ")
    assert watched.state()["playing"] is True
    press(" ")
    assert watched.state()["playing"] is False
    width = np.ptp(pins(watched)[:, 0])
    press("+")
    assert np.ptp(pins(watched)[:, 0]) == pytest.approx(1.25 * width)
    press("0")
    assert np.ptp(pins(watched)[:, 0]) == pytest.approx(width)


def test_a_focused_control_keeps_its_own_keys(
    opened: Any, solutions: dict[str, kp.Solution]
) -> None:
    watched = opened(solutions["plain"], 1280, 720)
    watched.page.focus("#play")
    watched.page.keyboard.press(" ")
    assert watched.state()["playing"] is True  # once, not twice
    watched.page.keyboard.press(" ")
    watched.page.evaluate("kempe.seek(0)")
    watched.page.focus("#show-paths")
    watched.page.keyboard.press(" ")
    assert not watched.page.is_checked("#show-paths")
    assert watched.state()["playing"] is False
    watched.page.focus("#scrub")
    watched.page.keyboard.press("ArrowRight")
    assert watched.state()["frame"] == 1


def test_scrubbing_and_the_plot_go_to_a_time(
    opened: Any, solutions: dict[str, kp.Solution]
) -> None:
    watched = opened(solutions["plain"], 1280, 720)
    box = watched.page.locator("#scrub").bounding_box()
    watched.page.mouse.click(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    assert watched.state()["t"] == pytest.approx(0.5, abs=0.02)
    assert watched.page.inner_text("#now").startswith("0.")
    plot = watched.page.locator(".curves").bounding_box()
    times = []
    for share in (0.3, 0.6, 0.9):
        watched.page.mouse.click(plot["x"] + share * plot["width"], plot["y"] + 100)
        times.append(watched.state()["t"])
    steps = np.diff(times)
    assert steps[0] == pytest.approx(steps[1], rel=0.02)
    assert 0.3 < steps[0] < 0.45


def test_moving_and_zooming(opened: Any, solutions: dict[str, kp.Solution]) -> None:
    watched = opened(solutions["plain"], 1280, 720)
    mouse, first = watched.page.mouse, pins(watched)
    mouse.move(400, 400)
    mouse.down()
    mouse.move(430, 380)
    mouse.up()
    np.testing.assert_allclose(pins(watched), first + np.array([30, -20]), atol=0.01)
    at = pins(watched)[1]
    mouse.move(*at)
    mouse.wheel(0, -120)
    watched.settle()
    zoomed = pins(watched)
    np.testing.assert_allclose(zoomed[1], at, atol=1.0)  # what is under the pointer stays there
    assert np.ptp(zoomed[:, 0]) > 1.2 * np.ptp(first[:, 0])
    watched.page.click("#fit")
    np.testing.assert_allclose(pins(watched), first, atol=0.01)


@pytest.mark.parametrize(
    "what", ["names", "numbers", "paths", "reactions", "velocities", "accelerations"]
)
def test_what_is_shown_can_be_chosen(
    opened: Any, solutions: dict[str, kp.Solution], what: str
) -> None:
    watched = opened(solutions["plain"], 1280, 720)
    before = picture(watched)
    watched.page.locator(f"#show-{what}").click()
    watched.settle()
    assert (picture(watched) != before).any()
    watched.page.locator(f"#show-{what}").click()
    watched.page.mouse.move(5, 5)
    watched.settle()
    assert (picture(watched) == before).all()


def test_every_plot_can_be_chosen(opened: Any, solutions: dict[str, kp.Solution]) -> None:
    watched = opened(solutions["hostile"], 1280, 720)
    names = watched.page.locator(".quantity option").all_inner_texts()
    assert len(names) > 15
    seen = set()
    for name in names:
        watched.choose(name)
        last = watched.page.locator(".subject option").count() - 1
        for k in {0, last}:
            watched.page.select_option(".subject", index=k)
            watched.settle()
            seen.add((name, k, picture(watched, "#plots").tobytes()))
            assert "NaN" not in watched.page.inner_text(".legend")
    assert len({shot for *_, shot in seen}) == len(seen)


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("width", [600, 900, 1600])
def test_nothing_overflows(
    opened: Any, solutions: dict[str, kp.Solution], width: int, scheme: str
) -> None:
    watched = opened(solutions["hostile"], width, 800, color_scheme=scheme)
    watched.page.check("#show-reactions")
    watched.settle()
    assert watched.page.evaluate("document.documentElement.scrollWidth") == width
    for selector in (
        "#play",
        "#scrub",
        "#speed",
        ".quantity",
        ".subject",
        "#drawing",
        ".curves",
        "#now",
        "#fit",
    ):
        box = watched.page.locator(selector).bounding_box()
        assert box["x"] >= 0
        assert box["x"] + box["width"] <= width
        assert box["width"] >= 24
        assert box["height"] >= 20


def test_controls_have_names_and_can_be_reached_by_tab(
    opened: Any, solutions: dict[str, kp.Solution]
) -> None:
    watched = opened(solutions["plain"], 1280, 720)
    reached = set()
    for _ in range(40):
        watched.page.keyboard.press("Tab")
        reached.add(watched.page.evaluate("document.activeElement.id"))
        reached.add(watched.page.evaluate("document.activeElement.className"))
    assert {
        "play",
        "scrub",
        "speed",
        "show-names",
        "loop",
        "fit",
        "degrees",
        "save-values",
    } <= reached
    assert {"quantity", "subject", "log"} <= reached
    unnamed = watched.page.evaluate(
        """[...document.querySelectorAll("button, input, select, canvas")].filter(one =>
        !(one.getAttribute("aria-label") || one.innerText || one.labels?.[0]?.innerText)
        && one.checkVisibility()).map(one => one.id)"""
    )
    assert unnamed == []


def test_a_single_state_stands_still(opened: Any, solutions: dict[str, kp.Solution]) -> None:
    watched = opened(solutions["plain"].initial, 1280, 720)
    assert watched.page.is_disabled("#play")
    assert not watched.page.is_visible("#plot-panel")
    watched.page.keyboard.press(" ")
    assert watched.state()["playing"] is False
    assert len(np.unique(picture(watched).reshape(-1, 3), axis=0)) > 20


def test_a_slider_moves(opened: Any) -> None:
    watched = opened(slider_crank(), 1280, 720)
    box = watched.page.locator("#drawing").bounding_box()
    places = []
    for t in (0.0, 0.1):
        watched.page.evaluate(f"kempe.seek({t})")
        watched.settle()
        x, y = pins(watched)[3]
        places.append((x, y))
        red, green, _ = picture(watched)[int(y - box["y"]) - 9, int(x - box["x"])]
        assert green > red + 15  # the green of body 3, beside the white pin of B
    assert np.hypot(*np.subtract(*places)) > 20


def test_a_spring_damper_is_drawn_and_stretches(opened: Any) -> None:
    watched = opened(sprung(), 1280, 720)
    widths = []
    for t in (0.0, 0.2):
        watched.page.evaluate(f"kempe.seek({t})")
        watched.settle()
        colours = picture(watched)
        violet = np.abs(colours - VIOLET).max(axis=-1) < 40
        widths.append(np.ptp(np.nonzero(violet)[1]))
    assert min(widths) > 50
    assert abs(widths[0] - widths[1]) > 20


def test_a_rod_reaches_from_its_support_to_its_mass(opened: Any) -> None:
    solution = point_pendulum()
    watched = opened(solution, 1280, 720)
    (begin,) = pins(watched)
    watched.page.evaluate("kempe.seek(0.5)")
    watched.settle()
    (end,) = pins(watched)
    gone = solution(0.5).body("bob").r - [-1.0, 0.0]
    scale = np.hypot(*(end - begin)) / np.hypot(*gone)
    support = begin + scale * np.array([1.0, 0.0])
    box = watched.page.locator("#drawing").bounding_box()
    for share in (0.3, 0.7):
        x, y = support + share * (end - support) - [box["x"], box["y"]]
        near = picture(watched)[int(y) - 2 : int(y) + 3, int(x) - 2 : int(x) + 3]
        assert near.min() < 120  # dark on the light drawing


def test_a_plate_and_a_motion_without_interpolation(opened: Any) -> None:
    plate = opened(pendulum(), 1280, 720)
    assert [pin["name"] for pin in plate.state()["pins"]] == ["hinge"]
    coarse = opened(moving(dense_output=False), 1280, 720)
    coarse.page.evaluate("kempe.seek(0.5031)")
    assert coarse.state()["frame"] == 50
    at_frame = pins(coarse)
    coarse.page.evaluate("kempe.seek(0.5)")
    np.testing.assert_array_equal(pins(coarse), at_frame)


def test_seeking_nonsense_changes_nothing(opened: Any, solutions: dict[str, kp.Solution]) -> None:
    watched = opened(solutions["plain"], 1280, 720)
    watched.page.evaluate("kempe.seek(0.25); kempe.seek(NaN); kempe.seek('x'); kempe.seek()")
    assert watched.state()["t"] == 0.25
    watched.page.evaluate("kempe.seek(99)")
    assert watched.state()["t"] == 1.0
    watched.page.evaluate("kempe.seek(-99)")
    assert watched.state()["t"] == 0.0


@pytest.mark.parametrize("made", [moving, slider_crank, sprung, point_pendulum])
def test_the_page_puts_items_where_frames_have_them(browser: Any, made: Any) -> None:
    """``studio/src/draw/place.ts`` and ``kempe.draw.placing`` have the same rules."""
    shown = kp.scene(made())
    found, scale = frame_items(shown), 17.0
    poses = [[0.0] * 3, *shown["frames"]["poses"][-1]]
    page = browser.new_page()
    page.add_script_tag(content="".join(map(module, ("plane/points", "draw/place"))))
    told = page.evaluate(
        """([items, poses, scale]) => {
          const view = { scale, toScreen: ([x, y]) => [x * scale, -y * scale] };
          return items.map((item) => placeItem(item, poses, view, 1).points);
        }""",
        [found, poses, scale],
    )
    page.close()
    view = View(np.zeros(2), scale, np.array([500.0, 300.0]))
    for item, points in zip(found, told, strict=True):
        expected = place(item, np.array(poses), view)
        np.testing.assert_allclose(np.array(points) * [1, -1], expected, atol=1e-9)


def module(name: str) -> str:
    """The part of the page's script that comes from one module; its functions are then global."""
    text = (PACKAGE / "draw" / "assets" / "player.js").read_text(encoding="utf-8")
    parts = dict(
        re.findall(r"^// src/(\S+)\.ts\n(.*?)(?=^// src/|\Z)", text, re.MULTILINE | re.DOTALL)
    )
    return str(parts[name])


def test_a_motion_over_a_quantity_shows_its_name_and_unit(opened: Any) -> None:
    case = kp.load(ROOT / "examples" / "four_bar.toml")
    turned = kp.kinematics(
        case.model, case.start(), over="crank.angle", range=["70 deg", "90 deg"], n=21
    )
    watched = opened(turned, 1280, 720)
    watched.page.evaluate(f"kempe.seek({float(np.radians(80.0))})")
    assert watched.page.inner_text("#variable") == "crank.angle ="
    assert watched.page.inner_text("#now") == "80.000°"
    assert watched.page.inner_text("#end") == "of 90°"
