"""The cam of design mode: a programme by mouse, its numbers, its drawing and its case."""

from pathlib import Path
from typing import Any

import ezdxf
import kempe as kp
import numpy as np
import pytest
from cams.machines import programme
from cams.test_files import outline
from studio.hands import Hands, run
from studio.window import Opener, Studio

PROGRAMME = [
    ("dwell", "60 deg"),
    ("rise", "110 deg", "12 mm", "modified_sine"),
    ("dwell", "40 deg"),
    ("return", "150 deg", "cycloidal"),
]


def begun(one: Studio) -> Hands:
    """The cam on an empty sheet."""
    hands = Hands(one)
    hands.new()
    hands.press("#mode-design")
    hands.press("#by-cam")
    return hands


def told(one: Studio) -> Any:
    return one.call("kempe.cam()")


def typed(hands: Hands, *fields: tuple[str, str]) -> None:
    """Type into fields of the panel, by their ids."""
    for field, words in fields:
        at = hands.one.page.locator(f"#{field}")
        at.click()
        at.fill(words)
        at.press("Enter")
        hands.clicks += 1
        hands.keys += len(words) + 1
    hands.one.settle()


def same(shown: Any, cam: kp.design.Cam) -> None:
    """The numbers of the page are those of Python."""
    size = float(np.hypot(*cam.profile.T).max())
    for name in ("profile", "pitch"):
        if name in shown["curves"]:
            places = np.reshape(shown["curves"][name], (-1, 2))
            assert np.abs(places - getattr(cam, name)).max() < 1e-9 * size
    steep = shown["pressure_angle"]["largest"]
    assert steep == pytest.approx(cam.largest_pressure_angle, abs=1e-9)
    sharp = shown["radius_of_curvature"]["least"]
    assert sharp == pytest.approx(cam.least_radius_of_curvature, abs=1e-9 * size)
    assert np.array(shown["undercut"]).ravel() == pytest.approx(np.ravel(cam.undercut), abs=1e-9)


def test_a_cam_from_nothing_by_mouse_is_cut_and_simulated(fresh: Opener, tmp_path: Path) -> None:
    one = fresh(accept_downloads=True)
    hands = begun(one)
    # dwell, rise, dwell, return in place of rise, dwell, return, dwell
    for k, way in enumerate(("dwell", "rise", "dwell", "return"), 1):
        hands.choose(f"Motion of segment {k}", way)
    hands.choose("Law of segment 2", "modified_sine")
    typed(
        hands,
        *((f"segment-{k}-angle", angle) for k, angle in enumerate(("60", "110", "40", "150"), 1)),
        ("segment-2-lift", "0.012"),
        ("cam-base_radius", "0.032"),
    )
    cam = kp.design.cam("roller", PROGRAMME, base_radius="32 mm", roller_radius="8 mm")
    same(told(one), cam)
    with one.page.expect_download() as download:
        hands.press("#cam-dxf")
    path = tmp_path / "cam.dxf"
    download.value.save_as(path)
    assert not ezdxf.readfile(path).audit().errors
    drawn, own = (outline(name) for name in (path, cam.write_dxf(tmp_path / "own.dxf")))
    assert np.array(drawn) == pytest.approx(np.array(own), abs=1e-12)
    before = one.toml()
    hands.press("#cam-use")
    hands.press("#run-cam")
    one.wait("!document.querySelector('#run')?.disabled", 30.0)
    lift = np.array(one.call("kempe.values(['follower.y'])")["rows"][0])
    motion = cam.case.run()["turn"]
    assert lift == pytest.approx(motion["follower.y"], abs=1e-9 * 0.012)
    assert hands.clicks <= 26, hands.counts()
    # the file is an ordinary case: the command runs it, and repeats the numbers of the page
    names = ["follower.y", "contact.normal", "drive.effort"]
    rows = one.call("names => kempe.values(names)", names)["rows"]
    saved = hands.saved(tmp_path)
    run(saved)
    repeated = kp.load(saved).run()["turn"]
    for name, row in zip(names, rows, strict=True):
        size = float(np.abs(row).max())
        assert repeated[name] == pytest.approx(np.array(row), abs=1e-9 * size)
    hands.press("#mode-design")
    hands.press("#undo")
    assert one.toml() == before


@pytest.mark.parametrize(
    ("choices", "follower", "sizes"),
    [
        ({"Follower": "flat"}, "flat", {}),
        (
            {"Motion of the follower": "oscillating", "Turn of the cam": "cw"},
            "roller",
            {"arm": 0.07, "pivot": (0.08, 0.01), "direction": "cw"},
        ),
        ({"Closure": "groove"}, "roller", {"closure": "groove"}),
    ],
)
def test_other_followers_are_those_of_python(
    fresh: Opener, choices: dict[str, str], follower: str, sizes: dict[str, Any]
) -> None:
    one = fresh(accept_downloads=True)
    hands = begun(one)
    for label, words in choices.items():
        hands.choose(label, words)
    given = {"base_radius": 0.03, **sizes} | (
        {"roller_radius": 0.008} if follower != "flat" else {}
    )
    lift = "15 deg" if "arm" in sizes else 0.01
    cam = kp.design.cam(follower, programme(lift), **given)
    same(told(one), cam)
    hands.press("#cam-use")
    page, own = one.tree()["bodies"]["cam"], cam.case.tree()["bodies"]["cam"]
    for name, curve in own["curves"].items():
        assert np.array(page["curves"][name]["points"]) == pytest.approx(
            np.array(curve["points"]), abs=1e-12
        )


def test_an_undercut_is_marked_and_its_remedy_removes_it(fresh: Opener) -> None:
    one = fresh()
    hands = begun(one)
    typed(hands, ("cam-base_radius", "0.003"), ("cam-roller_radius", "0.02"))
    shown = told(one)
    assert shown["undercut"]
    assert one.page.locator("#undercut").count() == 1
    assert one.page.locator("#cam-use").is_disabled()
    hands.press("#smaller-roller")
    assert told(one)["undercut"] == []
    assert told(one)["radius_of_curvature"]["least"] > 0.0
    assert not one.page.locator("#cam-use").is_disabled()


def test_knots_are_dragged_and_a_turn_is_filled(fresh: Opener) -> None:
    one = fresh()
    hands = begun(one)
    knot = one.page.locator("#knot-1")
    box = knot.locator("circle").last.bounding_box()
    assert box is not None
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    one.page.mouse.move(x, y)
    one.page.mouse.down()
    one.page.mouse.move(x + 30, y + 10, steps=4)
    one.page.mouse.up()
    one.settle()
    angle, lift = (
        float(one.page.locator(f"#segment-1-{of}").input_value()) for of in ("angle", "lift")
    )
    assert 120.0 < angle < 140.0
    assert 0.005 < lift < 0.01
    assert max(told(one)["diagram"]["s"]) == pytest.approx(lift, rel=1e-12)
    knot.focus()
    hands.key("ArrowLeft")
    assert float(one.page.locator("#segment-1-angle").input_value()) == angle - 1.0
    typed(hands, ("segment-4-angle", "100"))
    assert "lack" in one.page.locator("#cam-fault").inner_text()
    hands.press("#cam-fill")
    assert one.page.locator("#cam-fault").count() == 0
    assert float(one.page.locator("#segment-4-angle").input_value()) == 120.0
