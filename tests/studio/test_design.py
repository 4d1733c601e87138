"""Design mode: poses by mouse, the four-bars through them, and the case of one of them."""

import json
import math
from pathlib import Path
from typing import Any

import kempe as kp
import numpy as np
import pytest
from command_line import kempe
from kempe.model.measure_infos import measure_info
from quiet import within
from studio.hands import Hands, run
from studio.window import Opener, Studio
from synthesis.test_motion import CRANK, KNOWN

#: Places of the poses, m, and where their arms are dragged to.
PLACES = [(-0.4, 0.2), (0.0, 0.4), (0.4, 0.3)]


def told(one: Studio) -> Any:
    return one.call("kempe.synthesis()")


def task(poses: str, more: str = "") -> str:
    return f'kempe = 1\n\n[synthesis]\ntask = "motion"\nposes = [{poses}]\n{more}'


def known(n: int) -> str:
    places, angles = KNOWN.poses(CRANK)
    rows = np.column_stack([places.real, places.imag, angles])[:n].tolist()
    return ", ".join(map(repr, rows))


def turn(hands: Hands, at: tuple[float, float], degrees: float, before: float = 0.0) -> None:
    """Drag the arm of a pose from one direction to another."""
    one = hands.one
    x, y = one.screen(*at)
    ends = [
        (x + 52 * math.cos(math.radians(a)), y - 52 * math.sin(math.radians(a)))
        for a in (before, degrees)
    ]
    one.page.mouse.move(*ends[0])
    one.page.mouse.down()
    one.page.mouse.move(*ends[1], steps=4)
    one.page.mouse.up()
    hands.drags += 1
    one.settle()


def placed(one: Studio) -> Hands:
    """Three poses by mouse on an empty sheet."""
    hands = Hands(one)
    hands.new()
    hands.press("#mode-design")
    hands.at(*PLACES)
    turn(hands, PLACES[1], 30)
    turn(hands, PLACES[2], 75)
    return hands


def same(shown: Any, found: kp.synthesis.Found) -> None:
    """All candidates of the page are those of Python."""
    assert len(shown["candidates"]) == len(found) > 0
    assert shown["complete"] == found.complete
    assert {one["kind"]: one["count"] for one in shown["excluded"]} == dict(found.excluded)
    for one, other in zip(shown["candidates"], found, strict=True):
        assert one["defects"] == list(other.defects)
        assert one["type"] == other.type
        size = other.size
        for name, at in other.points.items():
            assert one["points"][name] == pytest.approx(at, abs=1e-9 * size)
        assert one["transmission_angle"] == pytest.approx(other.transmission_angle, abs=1e-9)
        assert one["crank_angles"] == pytest.approx(other.crank_angles.tolist(), abs=1e-9)
        assert one["lengths"] == pytest.approx(list(other.lengths.values()), rel=1e-9)


def test_three_poses_by_mouse_become_a_case_that_runs(studio: Opener, tmp_path: Path) -> None:
    one = studio()
    hands = placed(one)
    section = one.tree()["synthesis"]
    assert [row[2] for row in section["poses"]] == ["0 deg", "30 deg", "75 deg"]
    assert np.array([row[:2] for row in section["poses"]]) == pytest.approx(
        np.array(PLACES), abs=0.02
    )
    shown = told(one)
    assert len(shown["candidates"]) > 10
    one.page.locator("#candidate").focus()
    hands.key("ArrowRight")
    assert "Four-bar 2 of" in one.page.locator("#candidate-number").inner_text()
    hands.press("#take")
    hands.press("#run-taken")
    one.wait("!document.querySelector('#run')?.disabled", 30.0)
    assert "states up to" in one.message(), one.message()
    torque = one.call("kempe.values(['drive.effort'])")["rows"][0]
    path = hands.saved(tmp_path)
    assert hands.clicks < 12
    # Python: the same candidates, the same case, the same motion, and the command
    case = kp.load(path)
    found = kp.synthesis.from_case(case)
    same(shown, found)
    run(path)
    best = found[1].case
    start, wanted = case.start(), best.start()
    for name in ("crank.angle", "coupler.P.x", "coupler.P.y", "coupler.angle", "rocker.angle"):
        assert start[name] == pytest.approx(wanted[name], abs=1e-9)
    motion = best.run()["motion"]
    efforts = motion.measure(measure_info(motion.compiled, "drive.effort")).values
    # the sheet has the gravity of an empty one, as the case of Python
    assert case.tree()["gravity"] == best.tree()["gravity"]
    largest = float(np.abs(efforts).max())
    assert torque == pytest.approx(np.ravel(efforts).tolist(), abs=1e-8 * largest)
    answer = json.loads(kempe("synthesis", path, "-o", tmp_path / "out", "--json").stdout)
    lengths = [list(one["lengths"].values()) for one in answer["candidates"]]
    own = np.array([one["lengths"] for one in shown["candidates"]])
    assert own == pytest.approx(np.array(lengths), rel=1e-9)
    # another candidate replaces the one before
    hands.press("#mode-design")
    one.page.locator("#candidate").press("Home")
    hands.press("#take")
    assert one.tree()["synthesis"]["choice"] == 1
    assert set(one.tree()["bodies"]) == {"ground", "crank", "coupler", "rocker"}
    hands.press("#undo")
    assert one.tree()["synthesis"]["choice"] == 2


@pytest.mark.parametrize(
    ("n", "more"),
    [
        (2, "seed = 3\nsamples = 60\n"),
        (3, 'transmission_angle = "30 deg"\ngrashof = true\n'),
        (3, "pivots = { O = [0, 0], D = [3, 0] }\n"),
        (4, 'defects = "tell"\nsamples = 40\ndirection = "ccw"\n'),
        (4, 'within = [[-1, 4], [-1, 4]]\ngrashof = "crank-rocker"\nsamples = 100\n'),
        (5, ""),
        (5, 'defects = "tell"\n'),
    ],
)
def test_the_four_bars_of_a_file_are_those_of_python(
    studio: Opener, n: int, more: str, tmp_path: Path
) -> None:
    one = studio()
    assert one.load(task(known(n), more))["problems"] == []
    path = tmp_path / "task.toml"
    path.write_text(one.toml(), encoding="utf-8")
    same(told(one), kp.synthesis.from_case(kp.load(path)))


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e3])
def test_sizes_do_not_matter(studio: Opener, size: float) -> None:
    one = studio()
    places, angles = KNOWN.poses(CRANK)
    rows = np.column_stack([size * places.real, size * places.imag, angles]).tolist()
    one.load(task(", ".join(map(repr, rows))))
    found = told(one)["candidates"]
    assert len(found) == 5
    assert any(
        sorted(each["lengths"]) == pytest.approx([size * x for x in (1.0, 2.2, 2.6, 3.0)], rel=1e-7)
        for each in found
    )


@pytest.mark.alone
def test_five_poses_are_solved_within_a_frame(studio: Opener) -> None:
    one = studio()
    one.load(task(known(5)))

    def middle() -> float:
        times = one.call(
            """async () => {
                const all = [];
                for (let k = 0; k < 30; k += 1) {
                    const before = performance.now();
                    await kempe.synthesis();
                    all.push(performance.now() - before);
                }
                return all.sort((a, b) => a - b);
            }"""
        )
        return float(times[len(times) // 2])

    assert within(16.0, middle)


def test_what_is_not_possible_is_explained_with_a_remedy(studio: Opener) -> None:
    one = studio()
    hands = placed(one)
    poses = one.toml().split("[synthesis]")[1]
    # a body with the name of a link
    one.load(one.toml() + "\n[bodies.crank]\nmass = 1\ninertia = 1\n")
    hands.press("#mode-design")
    hands.press("#take")
    assert "bodies.crank" in one.message()
    assert "crank" in one.tree()["bodies"]
    assert "rocker" not in one.tree()["bodies"]
    one.load(one.toml().replace("[bodies.crank]", "[bodies.other]"))  # the remedy
    hands.press("#mode-design")
    hands.press("#take")
    assert set(one.tree()["bodies"]) > {"other", "rocker"}
    # a sixth pose, a task of another kind, and two poses that are the same
    one.load(task(known(5)))
    hands.press("#mode-design")
    hands.at((0.1, 0.1))
    assert "at most 5 poses" in one.message()
    one.load('kempe = 1\n[synthesis]\ntask = "function"\npairs = [[0, 0], [1, 0.5], [2, 1]]\n')
    hands.press("#mode-design")
    assert "kempe synthesis" in one.page.locator(".poses-panel .wrong").inner_text()
    one.load(task("[0, 0, 0], [1, 0, 0], [1, 0, 0]"))
    hands.press("#mode-design")
    assert "poses 2 and 3 are the same" in one.page.locator(".poses-panel").inner_text()
    one.page.get_by_label("Delete pose 3").click()
    one.settle()
    assert one.page.locator("#take").is_visible()
    assert poses


def test_poses_are_typed_and_moved_by_keys(studio: Opener) -> None:
    one = studio()
    hands = Hands(one)
    hands.new()
    hands.key("5")
    for _ in range(3):
        hands.press("#add-pose")
    hands.fill("y of pose 2", "300 mm")
    hands.fill("angle of pose 2", "20")
    hands.fill("angle of pose 3", "0.8 rad")
    rows = one.tree()["synthesis"]["poses"]
    assert rows[1][1] == "300 mm"
    assert rows[1][2] == "20 deg"
    assert rows[2][2] == "0.8 rad"
    shown = told(one)["poses"]
    assert shown[1][1:] == pytest.approx([0.3, math.radians(20.0)])
    one.page.locator(".pose-row button").first.click()
    one.page.locator("#sheet").focus()
    hands.key("ArrowUp")
    assert told(one)["poses"][0][1] > shown[0][1]
    hands.key("Delete")
    assert len(told(one)["poses"]) == 2


def test_defects_are_shown_where_they_are_asked_for(studio: Opener) -> None:
    one = studio()
    one.load(task(known(5)))
    hands = Hands(one)
    hands.press("#mode-design")
    assert "by branch" in one.page.locator("#excluded").inner_text()
    one.page.get_by_text("Show defects").click()
    one.settle()
    assert one.tree()["synthesis"]["defects"] == "tell"
    one.page.locator("#candidate").press("End")
    one.settle()
    assert "at position" in one.page.locator("#defects").inner_text()
    hands.fill("Transmission", "89")
    assert one.tree()["synthesis"]["transmission_angle"] == "89 deg"
    assert "transmission angle: beyond the limit" in one.page.locator("#defects").inner_text()
