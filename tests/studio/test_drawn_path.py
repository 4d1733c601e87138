"""A path that is drawn by mouse or finger: its four-bars, and the case of one of them."""

import json
import time
from pathlib import Path
from typing import Any

import kempe as kp
import numpy as np
import pytest
from command_line import kempe
from quiet import within
from studio.hands import Hands, run
from studio.test_design import same
from studio.window import Finger, Mouse, Opener, Studio
from synthesis.linkages import Complexes
from synthesis.test_curves import even
from synthesis.test_motion import KNOWN

#: The path of a known four-bar, m, so that it fits on an empty sheet.
TURN = 0.18 * (KNOWN.poses(np.linspace(0.0, 2.0 * np.pi, 90))[0] - (1.5 + 1.5j))
FOUND = "!document.querySelector('#stop') && document.querySelector('button.trace') !== null"


def begin(one: Studio) -> Hands:
    """An empty sheet that waits for a path."""
    hands = Hands(one)
    hands.new()
    hands.press("#mode-design")
    hands.press("#by-points")
    return hands


def draw(one: Studio, places: Complexes, by: Any = Mouse) -> None:
    """Draw a line in one go."""
    at = [one.screen(z.real, z.imag) for z in places]
    pen = by(one)
    pen.down(*at[0])
    for place in at[1:]:
        pen.move(*place)
    pen.up()


def first_found(one: Studio) -> None:
    """Wait for three candidates, and end the search where it still goes on."""
    one.wait("document.querySelectorAll('button.trace').length > 2", 30.0)
    one.call("document.querySelector('#stop')?.click()")
    one.settle()
    one.wait(FOUND, 20.0)


def rows(one: Studio) -> list[str]:
    found: list[str] = one.page.locator("button.trace").all_inner_texts()
    return found


def test_a_path_by_mouse_becomes_a_case_that_runs(studio: Opener, tmp_path: Path) -> None:
    one = studio()
    hands = begin(one)
    draw(one, TURN)
    begun = time.monotonic()
    one.wait("document.querySelector('button.trace') !== null", 8.0)
    first = time.monotonic() - begun
    one.wait(FOUND, 20.0)
    print(f"\n{first:.2f} s to the first candidates, {time.monotonic() - begun:.2f} s to all")
    section = one.tree()["synthesis"]
    assert section["task"] == "path"
    assert len(section["points"]) == 36
    assert len(rows(one)) > 2
    # the second one, chosen and run
    one.page.locator("button.trace").nth(1).click()
    hands.press("#take")
    assert one.tree()["synthesis"]["choice"] == 2
    hands.press("#run-taken")
    one.wait("!document.querySelector('#run')?.disabled", 30.0)
    assert "states up to" in one.message(), one.message()
    shown = one.call("kempe.synthesis()")
    path = hands.saved(tmp_path)
    run(path)
    # Python and the command: the same candidates and the same mechanism
    case = kp.load(path)
    found = kp.synthesis.from_case(case)
    same(shown, found)
    size = float(abs(TURN - TURN.mean()).max())
    assert found[0].error < 0.01 * size
    assert [one["error"] for one in shown["candidates"]] == pytest.approx(
        [one.error for one in found], abs=1e-9 * size
    )
    start, wanted = case.start(), found[1].case.start()
    for name in ("crank.angle", "coupler.P.x", "coupler.P.y", "rocker.angle"):
        assert start[name] == pytest.approx(wanted[name], abs=1e-9)
    answer = json.loads(kempe("synthesis", path, "-o", tmp_path / "out", "--json").stdout)
    assert len(answer["candidates"]) == len(found)
    # the motion follows the drawn line
    motion = case.run()["motion"]
    places = motion["coupler.P.x"] + 1j * motion["coupler.P.y"]
    assert max(abs(places - at).min() for at in TURN) < 0.05 * size
    # the mechanism moves live, and undo takes it away
    hands.press("#mode-live")
    one.page.wait_for_timeout(300)
    hands.one.page.locator("#mode-design").click()
    one.settle()
    hands.press("#undo")
    assert "crank" not in one.tree()["bodies"]
    hands.press("#undo")
    assert "synthesis" not in one.tree()


@pytest.mark.alone
def test_a_drawn_path_has_candidates_at_once(studio: Opener) -> None:
    one = studio()
    begin(one)

    def longest() -> float:
        waits = []
        for line in (TURN, TURN[10:60]):
            draw(one, line)
            drawn = time.monotonic()
            one.wait(FOUND, 20.0)
            waits.append(time.monotonic() - drawn)
        return max(waits)

    assert within(2.0, longest)  # on a core of its own


def test_a_search_that_is_stopped_is_repeated_by_python(studio: Opener, tmp_path: Path) -> None:
    one = studio()
    hands = begin(one)
    draw(one, TURN[10:60])
    one.wait("document.querySelector('button.trace') !== null", 8.0)
    one.page.keyboard.press("Escape")
    one.settle()
    assert one.page.locator("#stop").count() == 0
    hands.press("#take")
    section = one.tree()["synthesis"]
    shown = one.call("kempe.synthesis()")
    if "starts" in section:  # otherwise the search had ended before
        assert section["starts"] == shown["tried"] < 60
    path = tmp_path / "stopped.toml"
    path.write_text(one.toml(), encoding="utf-8")
    found = kp.synthesis.from_case(kp.load(path))
    same(shown, found)
    size = float(abs(TURN - TURN.mean()).max())
    assert kp.load(path).start()["coupler.P.x"] == pytest.approx(
        found[0].points["P"][0], abs=1e-9 * size
    )
    # a new path needs all starts again, and keeps the mechanism until it is replaced
    hands.press("#mode-design")
    draw(one, TURN)
    one.settle()
    one.wait(FOUND, 20.0)
    assert "starts" not in one.tree()["synthesis"]
    hands.press("#take")
    assert set(one.tree()["bodies"]) == {"ground", "crank", "coupler", "rocker"}


def test_clicked_points_are_passed_exactly(studio: Opener, tmp_path: Path) -> None:
    one = studio()
    hands = begin(one)
    hands.at(*((z.real, z.imag) for z in even(TURN[:-1], closed=True, n=6)))
    one.wait(FOUND, 20.0)
    assert len(one.tree()["synthesis"]["points"]) == 6
    shown = one.call("kempe.synthesis()")
    assert max(each["error"] for each in shown["candidates"]) < 1e-8
    # a point is typed, dragged and deleted
    hands.fill("y of point 1", "0.3")
    assert one.tree()["synthesis"]["points"][0][1] == pytest.approx(0.3)
    hands.drag((float(one.tree()["synthesis"]["points"][0][0]), 0.3), (0.1, 0.35))
    assert one.tree()["synthesis"]["points"][0] == pytest.approx([0.1, 0.35], abs=0.03)
    one.page.get_by_label("Delete point 6").click()
    one.settle()
    one.wait(FOUND, 20.0)
    path = tmp_path / "clicked.toml"
    path.write_text(one.toml(), encoding="utf-8")
    found = kp.synthesis.from_case(kp.load(path))
    shown = one.call("kempe.synthesis()")
    assert len(shown["candidates"]) == len(found)
    assert shown["candidates"][0]["error"] == pytest.approx(found[0].error, abs=1e-9)


def test_the_pointer_over_a_candidate_shows_it(studio: Opener) -> None:
    one = studio()
    begin(one)
    draw(one, TURN)
    first_found(one)
    facts = one.page.locator(".facts")
    before = facts.inner_text()
    one.page.locator("button.trace").nth(2).hover()
    one.settle()
    assert facts.inner_text() != before
    one.page.locator("#sheet").hover()
    one.settle()
    assert facts.inner_text() == before
    # a line that is too short, one that is cancelled, and poses in place of the path
    text = one.toml()
    draw(one, TURN[:4])
    one.settle()
    assert "too short" in one.message()
    mouse = Mouse(one)
    at = [one.screen(z.real, z.imag) for z in TURN[:30]]
    mouse.down(*at[0])
    mouse.move(*at[20])
    one.page.keyboard.press("Escape")
    mouse.up()
    one.settle()
    assert one.toml() == text
    Hands(one).press("#by-poses")
    Hands(one).at((0.2, 0.2))
    assert one.tree()["synthesis"] == {"task": "motion", "poses": [[0.2, 0.2, "0 deg"]]}


def test_a_finger_draws_a_path(fresh: Opener) -> None:
    one = fresh(390, 760, has_touch=True, is_mobile=True)
    one.load("kempe = 1\n\n[bodies.ground]\npoints = { O = [-0.6, -0.6], D = [0.6, 0.6] }\n")
    one.mode("design")
    one.page.locator("#by-points").click()
    draw(one, TURN, Finger)
    first_found(one)
    assert len(one.tree()["synthesis"]["points"]) == 36
    one.page.locator("button.trace").first.tap()
    one.page.locator("#take").tap()
    one.settle()
    assert "crank" in one.tree()["bodies"]


@pytest.mark.parametrize(
    "more",
    [
        "seed = 3\nstarts = 7\n",
        'defects = "tell"\ntransmission_angle = "20 deg"\n',
        "pivots = { O = [0, 0] }\nstarts = 20\n",
        'angles = [{angles}]\ndefects = "tell"\nstarts = 3\n',
    ],
)
def test_the_paths_of_a_file_are_those_of_python(studio: Opener, more: str, tmp_path: Path) -> None:
    crank = np.linspace(0.3, 4.0, 14)
    places = even(KNOWN.poses(crank)[0], closed=False, n=14)
    listed = json.dumps([[z.real, z.imag] for z in places])
    angles = ", ".join(map(repr, crank.tolist()))
    one = studio()
    text = f'kempe = 1\n\n[synthesis]\ntask = "path"\npoints = {listed}\n'
    assert one.load(text + more.replace("{angles}", angles))["problems"] == []
    path = tmp_path / "task.toml"
    path.write_text(one.toml(), encoding="utf-8")
    shown = one.call("kempe.synthesis()")
    found = kp.synthesis.from_case(kp.load(path))
    assert len(shown["candidates"]) == len(found) > 0
    assert [each["error"] for each in shown["candidates"]] == pytest.approx(
        [each.error for each in found], rel=1e-6, abs=1e-9
    )
