"""Improve: better values of ticked parameters by mouse, and the same values by kempe."""

import math
import re
from pathlib import Path
from typing import Any

import kempe as kp
import pytest
from command_line import kempe
from studio.hands import Hands
from studio.window import Opener, Studio

EXAMPLES = Path(__file__).parents[2] / "examples"
DOOR = (Path(__file__).parents[2] / "docs" / "tutorials" / "garage_spring.md").read_text("utf-8")
#: The garage door of the tutorial, without its section.
TEXT, _, SECTION = re.search(r"```toml\n(.*?)```", DOOR, re.S)[1].partition("[optimize]")  # type: ignore[index]
ENDS = {"stiffness": ("500", "10000"), "anchor": ("0.1", "0.35"), "lever": ("0.1", "0.6")}


def opened(studio: Opener, text: str) -> tuple[Studio, Hands]:
    one = studio()
    assert one.load(text)["problems"] == []
    if not one.page.locator("#slope-measure").is_visible():
        one.page.locator(".sliders summary").click()
    one.settle()
    return one, Hands(one)


def vary(hands: Hands, name: str, least: str, most: str) -> None:
    page = hands.one.page
    page.locator(f"#vary-{name}").check()
    for which, value in (("Largest", most), ("Least", least)):
        field = page.locator(f"[aria-label^='{which} {name}']")
        field.fill(value)
        field.press("Enter")
    hands.one.settle()


def ask(hands: Hands, measure: str, aim: str = "minimize", limits: str = "") -> None:
    page = hands.one.page
    page.locator("#slope-measure").fill(measure)
    page.locator("#aim").select_option(aim)
    page.locator("#limits").fill(limits)


def ended(hands: Hands) -> str:
    hands.press("#improve")
    hands.one.wait("document.querySelector('#improve') !== null", 120.0)
    hands.one.settle()
    return hands.one.page.locator("#improve-state").inner_text()


def saved(one: Studio, folder: Path, name: str = "case.toml") -> kp.Case:
    path = folder / name
    path.write_text(one.toml(), encoding="utf-8")
    return kp.load(path)


def numbers(one: Studio) -> list[str]:
    return one.page.locator("#improved dd").all_inner_texts()


def test_the_spring_of_a_garage_door_is_improved_by_mouse(studio: Opener, tmp_path: Path) -> None:
    one, hands = opened(studio, TEXT)
    ask(hands, "over.effort.peak", limits="spring.force.peak <= 2 kN")
    for name, ends in ENDS.items():
        vary(hands, name, *ends)
    assert "Nothing better is near." in ended(hands)
    assert numbers(one)[0].startswith("182.5 N → 42.99 N")
    assert "is reached" in numbers(one)[-1]
    assert one.page.locator("#improved dd", has_text="its bound").count() == 2
    after = saved(one, tmp_path)
    section = after.tree()["optimize"]
    assert section["minimize"] == "over.effort.peak"
    assert section["variables"] == {name: [float(x) for x in ends] for name, ends in ENDS.items()}
    # the same search by kempe, from the numbers before and from those after
    hands.press("#discard-improved")
    before = saved(one, tmp_path, "before.toml")
    assert before.model.parameters["anchor"] == 0.25
    for case in (before, after):
        best = kp.optimize(case)
        assert best.success
        own = kp.sweep(after, {"free": [0.25]}, ["over.effort.peak"])["over.effort.peak"][0]
        assert own == pytest.approx(best.objective, rel=1e-7)
        for name, value in best.values.items():
            assert after.model.parameters[name] == pytest.approx(value, rel=1e-6), name
    # the units of the text remain, and the command repeats it
    assert one.toml().count(" mm") == 3
    assert re.search(r'stiffness = "2\.87785\d+ kN/m"', (tmp_path / "case.toml").read_text("utf-8"))
    done = kempe("optimize", tmp_path / "before.toml", "-o", tmp_path / "out")
    assert "over.effort.peak = 42.989" in done.stdout, done.stderr
    hands.press("#redo")
    assert one.tree()["parameters"] == after.tree()["parameters"]


CRANK = (
    (EXAMPLES / "classics" / "crank_exercise.toml").read_text("utf-8").partition("[exercise]")[0]
)


@pytest.mark.parametrize(
    ("aim", "measure", "limits", "names"),
    [
        ("maximize", "piston.x.max - piston.x.min", "motor.effort.rms <= 40", ("r", "l")),
        ("target", "piston.vx.max", "", ("r", "l")),
        ("minimize", "motor.effort.rms", "r >= 50 mm\nl <= 4*r", ("r", "l", "n")),
    ],
)
def test_the_numbers_are_those_of_python(
    studio: Opener, aim: str, measure: str, limits: str, names: tuple[str, ...], tmp_path: Path
) -> None:
    one, hands = opened(studio, CRANK)
    ask(hands, measure, aim, limits)
    if aim == "target":
        one.page.locator("#target").fill("2,1")
    for name in names:
        one.page.locator(f"#vary-{name}").check()
    assert "Nothing better is near." in ended(hands)
    after = saved(one, tmp_path)
    hands.press("#discard-improved")
    best = kp.optimize(saved(one, tmp_path))
    own = kp.optimize(after)
    if aim == "target":  # a curve of solutions
        assert own.objective < 1e-6 > best.objective
        value = kp.sweep(after, {"r": [after.model.parameters["r"]]}, [measure])[measure][0]
        assert value == pytest.approx(2.1, rel=1e-7)
        return
    assert own.objective == pytest.approx(best.objective, rel=1e-8)
    for name, value in best.values.items():
        assert after.model.parameters[name] == pytest.approx(value, rel=1e-6), name


def test_a_lamp_is_balanced(studio: Opener, tmp_path: Path) -> None:
    page = (Path(__file__).parents[2] / "docs" / "optimization.md").read_text("utf-8")
    text = re.search(r"```toml\n(.*?)\[optimize\]", page, re.S)[1]  # type: ignore[index]
    one, hands = opened(studio, text)
    ask(hands, "over.effort.rms", limits="h <= 250 mm\nspring.force.peak <= 60")
    vary(hands, "k", "50", "2000")
    vary(hands, "h", "0.05", "0.3")
    assert "Nothing better is near." in ended(hands)
    assert numbers(one)[0].endswith("→ 0.2072 N·m")
    assert [number for number in numbers(one) if "reached" in number] == ["is reached"] * 2
    after = saved(one, tmp_path)
    best = kp.optimize(after)
    for name, value in best.values.items():
        assert after.model.parameters[name] == pytest.approx(value, rel=1e-6), name


def test_a_search_can_be_cancelled_and_its_task_is_read_again(studio: Opener) -> None:
    one, hands = opened(studio, TEXT + "[optimize]" + SECTION)
    page = one.page
    assert page.locator("#slope-measure").input_value() == "over.effort.peak"
    assert page.locator("#limits").input_value() == "spring.force.peak <= 2000"
    assert page.locator("#vary-lever").is_checked()
    assert not page.locator("#vary-free").is_checked()
    page.locator("#improve").click()
    page.locator("#cancel-improve").click()
    one.wait("document.querySelector('#improve') !== null", 60.0)
    one.settle()
    told = page.locator("#improve-state").inner_text()
    assert "Cancelled" in told
    assert "4 starts" in told
    # a change of the mechanism ends the comparison
    hands.press("#undo")
    assert not page.locator("#improved").count()


@pytest.mark.parametrize(
    ("measure", "limits", "tick", "says"),
    [
        ("", "", True, "Type the number"),
        ("motor.effort.rms", "", False, "Tick a parameter"),
        ("motor.effort.most", "", True, "no statistic 'most'"),
        ("nothing", "", True, "nothing"),
        ("motor.effort.rms", "l <= motor.effort.rms", True, "l <= motor.effort.rms"),
        ("motor.effort.rms", "l = 3", True, "not one comparison"),
        ("turn:motor.effort.rms", "", True, "several analyses"),
        ("worst(motor.effort.rms)", "", True, "load cases"),
    ],
)
def test_what_is_not_possible_is_explained(
    studio: Opener, measure: str, limits: str, tick: bool, says: str
) -> None:
    one, hands = opened(studio, CRANK)
    ask(hands, measure, limits=limits)
    if tick:
        one.page.locator("#vary-r").check()
    assert says in ended(hands)
    assert one.tree()["parameters"]["r"] == "60 mm"
    ask(hands, "motor.effort.rms")  # the remedy
    one.page.locator("#vary-r").check()
    assert "Nothing better is near." in ended(hands)


def test_limits_that_cannot_hold_are_named(studio: Opener) -> None:
    one, hands = opened(studio, CRANK.replace("t_end = 0.2", "t_end = 0.02"))
    ask(hands, "motor.effort.rms", limits="piston.x.max >= 5")
    one.page.locator("#vary-r").check()
    ended(hands)
    assert "is missed" in numbers(one)[-1]


def test_differences_replace_slopes_by_formulas_of_the_analysis(
    studio: Opener, tmp_path: Path
) -> None:
    text = CRANK.replace("[parameters]", "[parameters]\nend = 0.05")
    one, hands = opened(studio, text.replace("t_end = 0.2", 't_end = "end"'))
    ask(hands, "piston.x.final", "target")
    one.page.locator("#target").fill("0.2")
    one.page.locator("#vary-end").check()
    assert "Nothing better is near." in ended(hands)
    after = saved(one, tmp_path).model.parameters["end"]
    # x = r cos φ + √(l² - r² sin² φ) with r = 60 mm and l = x = 200 mm: cos φ = r/(2 l)
    assert after == pytest.approx(math.acos(0.15) / (10.0 * math.pi), rel=1e-7)
    hands.press("#discard-improved")
    assert after == pytest.approx(kp.optimize(saved(one, tmp_path)).values["end"], rel=1e-6)


@pytest.mark.parametrize("size", [1e-3, 1e3])
def test_sizes_and_masses_do_not_matter(studio: Opener, size: float, tmp_path: Path) -> None:
    """Lengths times a factor, masses times its cube."""
    text = CRANK
    for old, new in (
        ('r = "60 mm"', f"r = {0.06 * size!r}"),
        ('l = "200 mm"', f"l = {0.2 * size!r}"),
        ("mass = 1\n", f"mass = {size**3!r}\n"),
        ("mass = 0.5", f"mass = {0.5 * size**3!r}"),
        ("mass = 0.8", f"mass = {0.8 * size**3!r}"),
    ):
        assert old in text
        text = text.replace(old, new)
    one, hands = opened(studio, text)
    limit = 40.0 * size**5
    ask(hands, "piston.x.max - piston.x.min", "maximize", f"motor.effort.rms <= {limit!r}")
    for name in ("r", "l"):
        one.page.locator(f"#vary-{name}").check()
    assert "Nothing better is near." in ended(hands)
    found: dict[str, Any] = dict(saved(one, tmp_path).model.parameters)
    base, hands = opened(studio, CRANK)
    ask(hands, "piston.x.max - piston.x.min", "maximize", "motor.effort.rms <= 40")
    for name in ("r", "l"):
        base.page.locator(f"#vary-{name}").check()
    ended(hands)
    wanted = saved(base, tmp_path).model.parameters
    for name in ("r", "l"):
        assert found[name] == pytest.approx(size * wanted[name], rel=1e-6)
