"""Exercises: keys against closed forms, answers with units, variants, the command, the file."""

import json
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import kempe as kp
import pytest
from command_line import kempe

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
    with pytest.raises(kp.ModelError, match="variant 5, not of 4"):
        one.grade({"kempe_result": 1, "seed": 5})
    with pytest.raises(kp.ModelError, match="not a result"):
        one.grade({})
    empty = {"kempe_result": 1, "seed": 4, "answers": {"nearest": {"given": "260 N"}}}
    assert not any(one.grade(empty).values())
    right = {name: {"given": of.shown} for name, of in one.questions.items()}
    assert all(one.grade({"kempe_result": 1, "seed": 4, "answers": right}).values())
