"""Exercises: keys against closed forms, answers with units, variants, the command, the file."""

import json
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import kempe as kp
import pytest
from command_line import kempe
from kempe.exercise import read_result

CLASSICS = Path(__file__).parents[2] / "examples" / "classics"
CRANK, PENDULUM = (CLASSICS / f"{name}_exercise.toml" for name in ("crank", "pendulum"))


def numbers(path: Path, seed: int, names: str) -> tuple[kp.Exercise, list[float]]:
    one = kp.Exercise(kp.load(path), seed)
    known = one.case.model.compile().parameters
    return one, [float(known[name]) for name in names.split()]


@pytest.mark.parametrize("seed", [0, 1, 2, 3])
def test_keys_are_those_of_closed_forms(seed: int) -> None:
    one, (r, length, n) = numbers(CRANK, seed, "r l n")
    values = {name: of.value for name, of in one.questions.items()}
    assert values["dead_centre"] == pytest.approx(length + r, rel=1e-9)
    assert values["nearest"] == pytest.approx(length - r, rel=1e-9)
    assert values["acceleration"] == pytest.approx(n**2 * r * (1.0 + r / length), rel=1e-9)
    one, (m, length, phi) = numbers(PENDULUM, seed, "m L release")
    values = {name: of.value for name, of in one.questions.items()}
    drop = 1.0 - math.cos(phi)
    assert values["release"] == pytest.approx(9.81 * m * math.cos(phi), rel=1e-9)
    assert values["lowest"] == pytest.approx(9.81 * m * (1.0 + 2.0 * drop), rel=1e-6)
    assert values["speed"] == pytest.approx(math.sqrt(2.0 * 9.81 * drop / length), rel=1e-6)


#: The answers of the other exercises of the gallery from their parameters.
CLOSED: dict[str, Callable[..., dict[str, float]]] = {
    "four_bar": lambda r, l, c, d, **_: {  # noqa: E741
        "outer": math.pi - math.acos((d**2 + c**2 - (l + r) ** 2) / (2.0 * d * c)),
        "inner": math.pi - math.acos((d**2 + c**2 - (l - r) ** 2) / (2.0 * d * c)),
    },
    "yoke": lambda r, m, n: {
        "speed": r * n,
        "acceleration": r * n**2,
        "torque": 0.5 * m * (r * n) ** 2,
    },
    "gear": lambda m, n: {
        "carrier": n / 3.6,
        "planet": n / 3.6 * (1.0 - 52.0 / 16.0),
        "centre": n / 3.6 * 18.0 * m,
    },
    "spring": lambda m, k: {
        "force": 2.0 * m * 9.81,
        "lowest": 2.0 * m * 9.81 / k,
        "speed": 9.81 * math.sqrt(m / k),
    },
    "boom": lambda reach, m, load, slope: {
        "torque": 9.81 * reach * (0.5 * m + load) * math.cos(slope),
        "pin": 9.81 * (m + load),
    },
    "throw": lambda g, v, slope: {
        "height": (v * math.sin(slope)) ** 2 / (2.0 * g),
        "range": v**2 * math.sin(2.0 * slope) / g,
        "slowest": v * math.cos(slope),
    },
    "flywheel": lambda inertia, torque, brake: {
        "first": torque / inertia,
        "speed": torque / brake * (1.0 - math.exp(-2.0 * brake / inertia)),
    },
    "shaper": lambda r, d, n: {
        "end": 0.5 * math.pi - math.asin(r / d),
        "slow": r * n / (d + r),
        "fast": -r * n / (d - r),
    },
}


@pytest.mark.parametrize("name", sorted(CLOSED))
@pytest.mark.parametrize("seed", [0, 2])
def test_the_exercises_of_the_gallery_have_the_answers_of_closed_forms(
    name: str, seed: int
) -> None:
    one = kp.Exercise(kp.load(CLASSICS / f"{name}_exercise.toml"), seed=seed)
    wanted = CLOSED[name](**one.case.model.compile().parameters)
    assert list(wanted) == list(one.questions)
    for question, value in wanted.items():
        found = one.questions[question]
        assert found.value == pytest.approx(value, rel=1e-4), question
        typed = value * found.shown / found.value
        assert found.check(typed), question
        assert not found.check(1.03 * typed), question


def test_variants_are_within_their_ranges_and_on_their_steps() -> None:
    case, seen = kp.load(CRANK), set[float]()
    ranges = case.exercise["parameters"]
    for seed in range(1, 200):
        drawn, _ = case._core().variant(seed, [])
        for name, value, shown in drawn:
            own, unit = ranges[name], float(shown.split()[0])
            assert own["from"] <= unit <= own["to"]
            steps = (unit - own["from"]) / own["step"]
            assert steps == pytest.approx(round(steps), abs=1e-9)
            if name == "r":
                assert value == pytest.approx(1e-3 * unit)
                seen.add(unit)
    assert seen == set(range(40, 81, 5))  # both ends occur
    assert case._core().variant(7, [])[0] == case._core().variant(7, [])[0]


def test_answers_have_units() -> None:
    one = kp.Exercise(kp.load(CRANK)).questions["dead_centre"]
    for right in (260, "260", "0.26 m", "26 cm", "259.6"):
        assert one.check(right), right
    for wrong in (0.26, "261", "-260", "26 m"):
        assert not one.check(wrong), wrong
    for unread, reason in (("260 N", "must be in mm"), ("many", "many"), ("1/0", "not finite")):
        with pytest.raises(kp.ModelError, match=reason):
            one.check(unread)


def test_a_quantity_at_a_time_and_at_an_angle(tmp_path: Path) -> None:
    question = 'text = "x?"\nquantity = "piston.x"\nat = 0.05\nunit = "mm"\n'
    text = CRANK.read_text("utf-8") + f"\n[exercise.questions.quarter]\n{question}"
    path = tmp_path / "case.toml"
    path.write_text(text, "utf-8")
    value = kp.Exercise(kp.load(path)).questions["quarter"].value
    assert value == pytest.approx(math.sqrt(0.2**2 - 0.06**2), rel=1e-9)  # the crank is upright
    over = 'type = "kinematics"\nover = "crank.angle"\nrange = [0, "360 deg"]\n'
    text = text.replace('type = "inverse_dynamics"\nt_end = 0.2\noutput_step = 0.001\n', over)
    text = text.replace("[drivers.motor]", "[drivers.idle]").replace("at = 0.05", 'at = "90 deg"')
    head, _, tail = text.partition("[drivers.idle]")
    path.write_text(head + "[start]" + tail.partition("[start]")[2], "utf-8")
    assert kp.Exercise(kp.load(path)).questions["quarter"].value == pytest.approx(value, rel=1e-9)


def test_a_relative_tolerance_of_zero_is_refused_with_a_remedy(tmp_path: Path) -> None:
    text = CRANK.read_text("utf-8").replace("piston.x.max", "piston.y.max")
    path = tmp_path / "case.toml"
    path.write_text(text.replace('tolerance = "0.5 mm"', 'tolerance = "1 %"', 1), "utf-8")
    with pytest.raises(kp.ModelError, match="'dead_centre' is 0"):
        kp.Exercise(kp.load(path))
    path.write_text(text, "utf-8")
    assert kp.Exercise(kp.load(path)).questions["dead_centre"].check("0.4")


@pytest.mark.parametrize(
    ("old", "new", "reason"),
    [
        ('measure = "piston.x.max"', "", "measure or quantity is missing"),
        ('measure = "piston.x.max"', 'measure = "piston.x.max"\nquantity = "piston.x"', "both"),
        ("from = 40", "from = 90", "must be larger than from"),
        ('unit = "rpm"', 'unit = "turns"', "unknown unit 'turns'"),
        ("r = { from", "q = { from", "no parameter 'q'"),
        ("piston.x.max", "piston.x.most", "no statistic 'most'"),
        ("piston.x.min", "pistn.x.min", "pistn"),
        ("points = 2", 'points = "two"', "a number"),
        ("hints = [", "hint = [", "hints"),
    ],
)
def test_faults_are_named_with_their_place(old: str, new: str, reason: str, tmp_path: Path) -> None:
    path = tmp_path / "case.toml"
    path.write_text(CRANK.read_text("utf-8").replace(old, new, 1), "utf-8")
    done = kempe("check", path)
    assert done.returncode != 0
    said = done.stdout + done.stderr
    assert reason in said
    assert "line" in said


def test_the_section_survives_writing_and_reading(tmp_path: Path) -> None:
    case = kp.load(PENDULUM)
    for name in ("case.toml", "case.json"):
        case.save(tmp_path / name)
        again = kp.load(tmp_path / name)
        assert again.exercise == case.exercise
        assert again.tree() == case.tree()
    assert case.with_parameters({"m": 3.0}).exercise == case.exercise


def test_the_command_prints_keys_of_variants() -> None:
    told: dict[str, Any] = json.loads(kempe("exercise", PENDULUM, "--json").stdout)
    assert told["variants"][0]["seed"] == 0
    many = json.loads(kempe("exercise", PENDULUM, "--variants", "5", "--json").stdout)["variants"]
    assert [one["seed"] for one in many] == [1, 2, 3, 4, 5]
    again = json.loads(kempe("exercise", PENDULUM, "--seed", "3", "--json").stdout)["variants"]
    assert again == [many[2]]
    known = kp.Exercise(kp.load(PENDULUM), 3)
    assert again[0]["questions"]["lowest"]["value"] == known.questions["lowest"].value
    plain = kempe("exercise", PENDULUM, "--seed", "3").stdout
    assert "Variant 3: m = " in plain
    assert "lowest" in plain
    without = kempe("exercise", CLASSICS / "roberts.toml")
    assert without.returncode != 0
    assert "no section [exercise]" in without.stderr


def test_results_of_other_variants_and_formats_are_refused() -> None:
    one = kp.Exercise(kp.load(CRANK), 4)
    with pytest.raises(kp.ModelError, match="variant 5, not of 4") as caught:
        one.grade({"kempe_result": 1, "seed": 5})
    assert caught.value.hint == "choose its variant with seed 5"
    with pytest.raises(kp.ModelError, match="not a result"):
        one.grade({})
    empty = {"kempe_result": 1, "seed": 4, "answers": {"nearest": {"given": "260 N"}}}
    assert not any(one.grade(empty).values())
    right = {name: {"given": of.shown} for name, of in one.questions.items()}
    assert all(one.grade({"kempe_result": 1, "seed": 4, "answers": right}).values())


def rewritten(tmp_path: Path, *changes: tuple[str, str], more: str = "") -> kp.Case:
    """The exercise of the crank with other texts."""
    text = CRANK.read_text("utf-8")
    for old, new in changes:
        assert old in text
        text = text.replace(old, new, 1)
    path = tmp_path / "case.toml"
    path.write_text(text + more, "utf-8")
    return kp.load(path)


@pytest.mark.parametrize(
    ("tolerance", "within"),
    [
        ("", 0.0026),
        ("tolerance = 0.02", 0.0052),
        ('tolerance = "5 %"', 0.013),
        ('tolerance = "12.5%"', 0.0325),
        ('tolerance = "30"', 0.03),
        ('tolerance = "2 cm"', 0.02),
        ('tolerance = "-3 mm"', 0.003),
    ],
)
def test_a_tolerance_is_a_share_or_a_length(tolerance: str, within: float, tmp_path: Path) -> None:
    """Of 60 mm + 200 mm; 1 % if none is given."""
    case = rewritten(tmp_path, ('tolerance = "0.5 mm"', tolerance))
    one = kp.Exercise(case).questions["dead_centre"]
    assert (one.value, one.within) == pytest.approx((0.26, within), rel=1e-9)
    for side in (-1.0, 1.0):
        assert one.check(260.0 + 999.0 * side * within)
        assert not one.check(260.0 + 1001.0 * side * within)


def test_what_is_no_tolerance_is_refused(tmp_path: Path) -> None:
    with pytest.raises(kp.ModelError) as caught:
        kp.Exercise(rewritten(tmp_path, ('"0.5 mm"', '"few %"')))
    told = "tolerance 'few %'; must be a share, or such as '2 %' or '0.5 N'"
    assert str(caught.value).startswith(f"dead_centre: {told}")
    zero = ('tolerance = "0.5 mm"', 'tolerance = "1 %"')
    with pytest.raises(kp.ModelError, match="no relative tolerance") as caught:
        kp.Exercise(rewritten(tmp_path, ("piston.x.max", "piston.y.max"), zero))
    assert caught.value.hint == 'write a tolerance with a unit, such as "0.5 N"'


def test_texts_hints_and_points_are_those_of_the_variant(tmp_path: Path) -> None:
    more = """
[exercise.questions.last]
text = "How long is {l}?"
quantity = "piston.x"
points = 3.5
hints = ["{r}, or", "{l} and {n}"]
"""
    case = rewritten(tmp_path, ("hints = [", 'hints = ["{r} here", '), more=more)
    for seed in (0, 5):
        one, (r, length, n) = numbers(tmp_path / "case.toml", seed, "r l n")
        shown = f"{1e3 * r:g} mm", f"{1e3 * length:g} mm", f"{n * 30.0 / math.pi:.6g} rpm"
        assert f"A crank of {shown[0]} turns at {shown[2]}," in one.text
        assert one.questions["dead_centre"].hints == (
            f"{shown[0]} here",
            "Crank and rod lie on one line there.",
            "Add both lengths.",
        )
        last = one.questions["last"]
        assert last.text == f"How long is {shown[1]}?"
        assert last.hints == (f"{shown[0]}, or", f"{shown[1]} and {shown[2]}")
        assert (last.value, last.unit) == (pytest.approx(r + length), "m")
    known = case.exercise["questions"]
    points = {name: of.points for name, of in one.questions.items()}
    assert points == {name: of.get("points", 1.0) for name, of in known.items()}
    assert points["dead_centre"] == 1.0 and points["last"] == 3.5


def test_the_seed_is_that_of_the_section_unless_one_is_given(tmp_path: Path) -> None:
    own = rewritten(tmp_path, ("[exercise]\n", "[exercise]\nseed = 4\n"))
    assert kp.Exercise(own).seed == 4
    assert kp.Exercise(own).values == kp.Exercise(kp.load(CRANK), 4).values
    assert kp.Exercise(own, 2).seed == 2
    plain = kp.Exercise(kp.load(CRANK))
    assert (plain.seed, plain.values) == (0, {})
    assert plain.questions["dead_centre"].value == pytest.approx(0.26)
    with pytest.raises(kp.ModelError, match="seed: -1; must be a whole number from 0"):
        kp.Exercise(own, -1)


def test_a_question_without_an_analysis_has_the_last_one(tmp_path: Path) -> None:
    """The crank turns at 300 rpm for 0.2 s, or until 0.3 s in a second analysis."""
    later = '[analyses.later]\ntype = "inverse_dynamics"\nt_end = 0.3\n\n[exercise]\n'
    more = '\n[exercise.questions.at]\ntext = "?"\nquantity = "crank.angle"\nat = {}\n'
    more += '\n[exercise.questions.end]\ntext = "?"\nmeasure = "crank.angle.final"\n'
    named = ('analysis = "turn"\n', "")
    for changes, at, end in (((named,), 0.15, 0.2), ((named, ("[exercise]\n", later)), 0.25, 0.3)):
        found = kp.Exercise(rewritten(tmp_path, *changes, more=more.format(at))).questions
        assert found["at"].value == pytest.approx(10.0 * math.pi * at)
        assert found["end"].value == pytest.approx(10.0 * math.pi * end)
        assert found["end"].unit == "rad"
    own = rewritten(tmp_path, ("[exercise]\n", later), more=more.format(0.15))
    assert kp.Exercise(own).questions["end"].value == pytest.approx(10.0 * math.pi * 0.2)


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("[1, 2]", "the result is not a table"),
        ("{", "the result is not JSON"),
        ("3", "not a table"),
    ],
)
def test_a_result_that_is_no_table_is_refused(text: str, told: str) -> None:
    with pytest.raises(kp.ModelError, match=told):
        read_result(text)


def test_results_are_graded_with_their_points(tmp_path: Path) -> None:
    """The force at the lowest point counts 2 of 4; marks of the file are not used."""
    given = {
        "release": {"given": "1 N", "right": True},
        "lowest": {"given": 0.0},
        "speed": "3",
    }
    one = kp.Exercise(kp.load(PENDULUM), 3)
    given["lowest"] = {"given": one.questions["lowest"].shown, "right": False}
    path = tmp_path / "miller.json"
    content = {"kempe_result": 1, "seed": 3, "name": "Miller", "answers": given}
    path.write_text(json.dumps(content), "utf-8")
    assert read_result(path.read_text("utf-8")) == content
    (told,) = json.loads(kempe("exercise", PENDULUM, "--check", path, "--json").stdout)["results"]
    assert told["right"] == {"release": False, "lowest": True, "speed": False}
    assert (told["points"], told["most"], told["name"], told["seed"]) == (2.0, 4.0, "Miller", 3)
    plain = kempe("exercise", PENDULUM, "--check", path).stdout
    assert "miller.json: Miller, variant 3" in plain
    assert "2 of 4 points" in plain
