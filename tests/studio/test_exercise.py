"""Exercises: questions with right and wrong answers, variants, results and their grades."""

import json
import math
from pathlib import Path
from typing import Any

import kempe as kp
import pytest
from command_line import kempe
from studio.hands import Hands
from studio.window import Opener, Studio

CLASSICS = Path(__file__).parents[2] / "examples" / "classics"
CRANK, PENDULUM = (CLASSICS / f"{name}_exercise.toml" for name in ("crank", "pendulum"))
QUESTIONS = ("dead_centre", "nearest", "acceleration")


def opened(studio: Opener, path: Path = CRANK, width: int = 1280) -> tuple[Studio, Hands]:
    one = studio(width)
    assert one.load(path.read_text("utf-8"))["problems"] == []
    one.wait("document.querySelector('#save-result')")
    return one, Hands(one)


def answer(hands: Hands, name: str, words: str) -> str:
    """Type an answer and check it; the sentence below it."""
    field = hands.one.page.locator(f"#answer-{name}")
    field.fill(words)
    field.press("Enter")
    hands.keys += len(words) + 1
    hands.one.settle()
    said: str = hands.one.page.locator(f"#state-{name}").inner_text()
    return said


def variant(hands: Hands, seed: int) -> None:
    field = hands.one.page.locator("#variant")
    field.fill(str(seed))
    field.press("Enter")
    hands.one.settle()
    hands.one.settle()


def saved(hands: Hands, folder: Path) -> Path:
    with hands.one.page.expect_download() as download:
        hands.press("#save-result")
    path = folder / "result.json"
    download.value.save_as(path)
    return path


def test_right_and_wrong_answers_and_units(studio: Opener) -> None:
    one, hands = opened(studio)
    assert "60 mm turns at 300 rpm" in one.page.locator(".task").inner_text()
    assert answer(hands, "dead_centre", "200") == "Not right yet."
    assert answer(hands, "dead_centre", "0.26") == "Not right yet (2 tries)."  # mm, not m
    assert answer(hands, "dead_centre", "260 N").count("must be in mm") == 1
    for right in ("260", "260,3", "0.26 m", "26 cm", "2.6e2 mm"):
        assert answer(hands, "dead_centre", right) == "Right.", right
    # ω² r (1 + r/l): just within one percent, and just outside
    exact = (10.0 * math.pi) ** 2 * 0.06 * 1.3
    assert answer(hands, "acceleration", f"{1.0099 * exact}") == "Right."
    assert answer(hands, "acceleration", f"{1.0101 * exact}").startswith("Not right")
    assert answer(hands, "acceleration", f"{1e-3 * exact} km/s^2") == "Right."
    assert "3 of 4 points" in one.page.locator("#score").inner_text()
    hands.press("#hint-nearest")
    assert "one line again" in one.page.locator(".hint-text").inner_text()


@pytest.mark.parametrize("path", [CRANK, PENDULUM])
def test_the_keys_of_variants_are_those_of_python(studio: Opener, path: Path) -> None:
    one, hands = opened(studio, path)
    for seed in (1, 2, 4711):
        variant(hands, seed)
        known = kp.Exercise(kp.load(path), seed)
        assert one.tree()["exercise"]["seed"] == seed
        assert known.text in one.page.locator(".task").inner_text()
        for name, of in known.questions.items():
            for share, says in ((0.999, "Right."), (1.001, "Not")):
                given = (of.value + share * of.within) / (of.value / of.shown)
                assert answer(hands, name, repr(given)).startswith(says), (seed, name, share)
        # the mechanism has these numbers
        for name, value in known.values.items():
            drawn = kp.load(path, parameters={name: one.tree()["parameters"][name]})
            assert drawn.model.compile().parameters[name] == pytest.approx(value, rel=1e-12)


def test_a_result_is_a_file_that_the_command_grades(studio: Opener, tmp_path: Path) -> None:
    one, hands = opened(studio)
    variant(hands, 12)
    known = kp.Exercise(kp.load(CRANK), 12)
    one.page.locator("#student").fill("Ada Lovelace")
    answer(hands, "dead_centre", str(known.questions["dead_centre"].shown))
    answer(hands, "acceleration", "1 m/s^2")
    path = saved(hands, tmp_path)
    result: dict[str, Any] = json.loads(path.read_text("utf-8"))
    assert (result["name"], result["seed"], result["points"]) == ("Ada Lovelace", 12, 1)
    told = json.loads(kempe("exercise", CRANK, "--check", path, "--json").stdout)["results"][0]
    assert told["right"] == {"dead_centre": True, "nearest": False, "acceleration": False}
    assert (told["name"], told["points"], told["most"]) == ("Ada Lovelace", 1.0, 4.0)
    # marks of the file itself do not count
    result["answers"]["acceleration"]["right"] = True
    result["points"] = 4
    path.write_text(json.dumps(result), "utf-8")
    told = json.loads(kempe("exercise", CRANK, "--check", path, "--json").stdout)["results"][0]
    assert told["points"] == 1.0


def test_undo_brings_the_former_variant_back(studio: Opener) -> None:
    one, hands = opened(studio)
    variant(hands, 3)
    assert "seed = 3" in one.toml()
    hands.press("#undo")
    assert "seed" not in one.toml()
    assert "60 mm turns" in one.page.locator(".task").inner_text()
    hands.press("#another-variant")
    one.settle()
    assert "seed = " in one.toml()
    variant(hands, -1)
    assert "whole number from 1" in one.message()


def test_what_has_no_answer_says_so(studio: Opener) -> None:
    one, hands = opened(studio)
    text = CRANK.read_text("utf-8").replace('"piston.x.max"', '"piston.y.max"')
    one.load(text.replace('tolerance = "0.5 mm"', "tolerance = 0.01", 1))
    one.settle()
    assert "no relative tolerance" in answer(hands, "dead_centre", "1")
    one.load(text)  # the remedy: a tolerance with a unit
    one.settle()
    assert answer(hands, "dead_centre", "0.2") == "Right."
    wrong = one.load(CRANK.read_text("utf-8").replace("piston.x.max", "piston.z.max"))
    assert "exercise.questions.dead_centre.measure" in json.dumps(wrong["problems"])


def test_a_lecturer_writes_questions_by_mouse(studio: Opener, tmp_path: Path) -> None:
    one = studio()
    hands = Hands(one)
    one.load(CRANK.read_text("utf-8").partition("[exercise]")[0])
    hands.press("#add-question")
    one.page.locator("summary", has_text="q1").click()
    for label, words in (
        ("Task", "A crank of {r} turns."),
        ("q1: question", "How far does the piston come?"),
        ("q1: hints, with | between", "They lie on one line. | Add both lengths."),
        ("q1: measure", "piston.x.max"),
        ("q1: unit", "mm"),
        ("q1: tolerance", "0.5 mm"),
        ("q1: points", "2"),
    ):
        hands.fill(label, words)
    assert one.tree()["exercise"] == {
        "text": "A crank of {r} turns.",
        "questions": {
            "q1": {
                "text": "How far does the piston come?",
                "hints": ["They lie on one line.", "Add both lengths."],
                "measure": "piston.x.max",
                "unit": "mm",
                "tolerance": "0.5 mm",
                "points": 2,
            }
        },
    }
    path = tmp_path / "written.toml"
    path.write_text(one.toml(), "utf-8")
    key = json.loads(kempe("exercise", path, "--json").stdout)["variants"][0]
    assert key["questions"]["q1"]["value"] == pytest.approx(0.26, rel=1e-9)
    one.load(one.toml())  # the student opens it
    one.settle()
    assert answer(hands, "q1", "260") == "Right."
    assert "2 of 2 points" in one.page.locator("#score").inner_text()


def test_a_second_question_is_deleted_and_then_the_first(studio: Opener) -> None:
    one = studio()
    hands = Hands(one)
    one.load(CRANK.read_text("utf-8").partition("[exercise]")[0])
    hands.press("#add-question")
    hands.press("#add-question")
    assert set(one.tree()["exercise"]["questions"]) == {"q1", "q2"}
    for name in ("q2", "q1"):
        one.page.locator("summary", has_text=name).click()
        one.page.get_by_role("button", name=f"Delete {name}").click()
        one.settle()
    assert "[exercise" not in one.toml()
