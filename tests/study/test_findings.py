"""The numbers in findings and tables of a study, from outcomes that are written by hand."""

import csv
import json
import math
import re
from dataclasses import FrozenInstanceError
from pathlib import Path

import kempe as kp
import numpy as np
import pytest
from house.places import ROOT
from kempe.sweeps.studies import Outcome, Variant, variants
from kempe.sweeps.studies.findings import growth
from kempe.sweeps.studies.run import Study


def outcome(variant: Variant, **numbers: float) -> Outcome:
    given = {
        "angle_error": 1.25e-4,
        "position_error": 3.5e-3,
        "residual": 7.5e-6,
        "residual_at": 0.75,
        "imbalance": 4.5e-5,
        "steps": 300,
        "evaluations": 2100,
        "seconds": 0.0125,
    }
    return Outcome(variant, None, None, "", **{**given, **numbers})  # type: ignore[arg-type]


def lost(variant: Variant) -> Outcome:
    nan = math.nan
    return Outcome(variant, None, 0.0625, "it broke", nan, nan, nan, nan, nan, 12, 48, 0.8)


PARTS = (("first", 0.2), ("later", 0.8))
REFERENCE = outcome(Variant("reference", 10, 200, "RK45", 1e-11), position_error=0.0, evaluations=1)


def told(*outcomes: Outcome) -> list[str]:
    return Study("rig", "run", (REFERENCE, *outcomes)).findings()


@pytest.mark.parametrize(
    ("residual", "words"),
    [
        (2.5, "2.5 m"),
        (1.0, "1 m"),
        (0.0025, "2.5 mm"),
        (0.001, "1 mm"),
        (2.5e-4, "250 µm"),
        (1e-6, "1 µm"),
        (2.5e-7, "250 nm"),
        (2.5e-12, "0.0025 nm"),
    ],
)
def test_an_opening_has_its_length_and_its_steps(residual: float, words: str) -> None:
    one = outcome(Variant("stabilization", 1, 20, "RK45", 1e-3), residual=residual, steps=234)
    two = outcome(Variant("stabilization", 0, 0, "RK45", 1e-3), residual=3.0, steps=77)
    other = outcome(Variant("stabilization", 5, 5, "RK45", 1e-6), residual=4e-3, steps=9)
    assert told(two, one, other)[:2] == [
        "With RK45 at rtol 0.001 the constraints open by up to: "
        f"α = 1, β = 20 {words} in 234 steps; α = β = 0 3 m in 77 steps.",
        "With RK45 at rtol 1e-06 the constraints open by up to: α = β = 5 4 mm in 9 steps.",
    ]


def test_the_sweep_gives_its_ends_its_best_and_its_power() -> None:
    """Steps 100, 200, 800 at β = 100, 200, 400: above 200 they grow as β² (800/200 at 400/200)."""
    found = [
        outcome(
            Variant("beta", 10, beta, "RK45", 1e-6),
            steps=steps,
            residual=residual,
            position_error=error,
        )
        for beta, steps, residual, error in (
            (100.0, 100, 2e-3, 5e-3),
            (200.0, 200, 3e-6, 4e-6),
            (400.0, 800, 6e-9, 6e-5),
        )
    ]
    assert told(*found)[:2] == [
        "From β = 100 to 400 at the same tolerance the steps change from 100 to 800 and the "
        "residual from 2 mm to 6 nm; the smallest position error, 4 µm, is that of β = 200.",
        "Above β = 200 the steps grow as β^2.00: stability sets the step.",
    ]
    flat = [*found[:2], outcome(found[2].variant, steps=283)]
    assert told(*flat)[1] == (
        "Above β = 200 the steps grow as β^0.50: accuracy still sets the step."
    )
    assert not [one for one in told(found[0]) if "From β" in one]
    # Below 200 /s accuracy sets the steps: only from there on is the power taken, to the last one.
    low, *high = (
        outcome(Variant("beta", 10, beta, "RK45", 1e-6), steps=steps)
        for beta, steps in ((199.0, 7), (200.0, 100), (300.0, 500), (800.0, 800))
    )
    assert told(low, *high)[1].startswith("Above β = 200 the steps grow as β^1.50:")


def test_weak_and_strong_gains_are_compared_at_each_step() -> None:
    strong = [Variant("step", 10, 200, "RK4", h) for h in (1e-3, 2e-3)]
    weak = [Variant("step", 1, 20, "RK4", h) for h in (1e-3, 2e-3)]
    found = told(
        outcome(strong[0], position_error=4e-3),
        outcome(weak[0], position_error=2e-6),
        outcome(strong[1], position_error=4e-3),
        outcome(weak[1], position_error=2.0),
    )
    assert found[:3] == [
        "With constant steps of 0.001 s, α = 1, β = 20 beats α = 10, β = 200: position error 2 µm "
        "against 4 mm.",
        "With constant steps of 0.002 s, α = 1, β = 20 loses to α = 10, β = 200: position error "
        "2 m against 4 mm.",
        "No constant step of the study diverges.",
    ]
    for one, other in (
        (lost(strong[0]), outcome(weak[0])),
        (outcome(strong[0]), lost(weak[0])),
        (lost(strong[0]), lost(weak[0])),
    ):
        assert not [words for words in told(one, other) if words.startswith("With constant")]


def test_a_divergence_gives_time_gains_and_growth() -> None:
    """α = β = 200 /s with 0.02 s: both roots are z = -4, so 1 - 4 + 8 - 32/3 + 32/3 = 5."""
    assert growth(200.0, 200.0, 0.02) == pytest.approx(5.0)
    # α = 0: z = ± i β h, |1 - x²/2 + x⁴/24 + i (x - x³/6)| at x = 3.
    assert growth(0.0, 300.0, 0.01) == pytest.approx(abs(1 - 4.5 + 81 / 24 + 1j * (3 - 4.5)))
    # Real roots z = -α h ± h √(α² - β²) = -1, -9: the larger factor is that of -9.
    assert growth(5.0, 3.0, 1.0) == pytest.approx(1 - 9 + 40.5 - 121.5 + 6561 / 24)
    found = told(lost(Variant("step", 200, 200, "RK4", 0.02)))
    assert found[0] == (
        "RK4 h = 0.02 s with α = β = 200 diverges at t = 0.0625 s: it broke; with β h = 4 the "
        "stabilization multiplies the opening of the joints by 5 in each step."
    )
    assert "No constant step of the study diverges." not in found
    other = told(lost(Variant("tolerance", 10, 200, "RK45", 1e-3)))
    assert other[0] == ("RK45 rtol 0.001 with α = 10, β = 200 diverges at t = 0.0625 s: it broke.")
    third = told(lost(Variant("tolerance", 0, 0, "DOP853", 1e-3, projected=True)))
    assert third[0] == "DOP853 rtol 0.001 with projection diverges at t = 0.0625 s: it broke."


def test_the_observed_order_is_the_slope() -> None:
    for order in (1.0, 2.5, 4.0):
        found = told(
            *(
                outcome(Variant("step", 10, 200, "RK4", h), position_error=0.7 * (100 * h) ** order)
                for h in (1e-3, 2e-3, 5e-3)
            )
        )
        words = f"RK4 with α = 10, β = 200 converges with order {order:.1f} in the step."
        assert words in found
    # A variant that diverged is left out.
    with_lost = told(
        lost(Variant("step", 10, 200, "RK4", 0.02)),
        *(
            outcome(Variant("step", 10, 200, "RK4", h), position_error=(100 * h) ** 3)
            for h in (1e-3, 2e-3, 5e-3)
        ),
    )
    assert "RK4 with α = 10, β = 200 converges with order 3.0 in the step." in with_lost
    # Errors under 1e-9 m have no meaning; two that are left make no slope.
    few = [(1e-3, 9e-10), (2e-3, 1e-6), (5e-3, 1e-4)]
    found = told(*(outcome(Variant("step", 10, 200, "RK4", h), position_error=e) for h, e in few))
    assert not [one for one in found if "converges" in one]


def test_the_cheapest_variant_within_a_bound() -> None:
    found = told(
        outcome(Variant("tolerance", 10, 200, "RK45", 1e-3), position_error=1e-3, evaluations=70),
        outcome(Variant("tolerance", 1, 20, "RK45", 1e-4), position_error=9e-4, evaluations=90),
        outcome(Variant("tolerance", 1, 20, "RK45", 1e-6), position_error=1.1e-6, evaluations=300),
        outcome(Variant("tolerance", 1, 20, "DOP853", 1e-9), position_error=1e-6, evaluations=400),
        outcome(Variant("tolerance", 1, 20, "DOP853", 1e-3), position_error=2e-3, evaluations=5),
    )
    start = "The cheapest variant with every position within"
    assert [one for one in found if one.startswith(start)] == [
        f"{start} 1 mm is α = 10, β = 200, RK45 rtol 0.001: 70 evaluations.",
        f"{start} 1 µm is α = 1, β = 20, DOP853 rtol 1e-09: 400 evaluations.",
    ]


def test_tables_have_the_numbers_of_the_outcomes(tmp_path: Path) -> None:
    """In Markdown, CSV and JSON: the time in ms in the first, SI units in the others."""
    made = outcome(Variant("step", 10, 200, "RK4", 2e-3))
    broken = lost(Variant("tolerance", 10, 20, "RK45", 1e-4))
    projected = outcome(Variant("tolerance", 0, 0, "DOP853", 1e-7, projected=True))
    study = Study("rig", "run", (REFERENCE, made, broken, projected))
    written = study.save(tmp_path)
    lines = written[0].read_text(encoding="utf-8").splitlines()
    heads = [line for line in lines if line.startswith("| variant")]
    assert heads[0] == (
        "| variant | angle error / rad | position error / m | residual / m | energy error | steps "
        "| evaluations | time / ms |"
    )
    assert (
        "| α = 10, β = 200, RK4 h = 0.002 s | 0.00013 | 0.0035 | 7.5e-06 | 4.5e-05 | 300 | 2100 "
        "| 12.5 |" in lines
    )
    assert (
        "| α = 10, β = 20, RK45 rtol 0.0001 | diverged at t = 0.0625 s: it broke |  |  |  | 12 "
        "| 48 | 800 |" in lines
    )
    text = written[2].read_text(encoding="utf-8")
    assert "α = 10, β = 20" in text
    rows = json.loads(text)["variants"]
    common = {
        "angle_error": 1.25e-4,
        "position_error": 3.5e-3,
        "residual": 7.5e-6,
        "residual_at": 0.75,
        "energy_error": 4.5e-5,
        "steps": 300,
        "evaluations": 2100,
        "seconds": 0.0125,
        "diverged_at": None,
        "reason": "",
    }
    assert rows[1] == {
        **{"group": "step", "alpha": 10, "beta": 200, "scheme": "RK4", "projected": False},
        **{"rtol": None, "step": 2e-3},
        **common,
    }
    assert rows[3] == {
        **{"group": "tolerance", "alpha": 0, "beta": 0, "scheme": "DOP853", "projected": True},
        **{"rtol": 1e-7, "step": None},
        **common,
    }
    assert (rows[2]["diverged_at"], rows[2]["reason"]) == (0.0625, "it broke")
    assert rows[2]["angle_error"] is rows[2]["residual_at"] is None
    table = list(csv.DictReader(written[1].read_text(encoding="utf-8").splitlines()))
    for row, record in zip(table, rows, strict=True):
        assert row == {key: "" if one is None else str(one) for key, one in record.items()}


def test_a_document_has_a_table_for_each_group_and_the_findings(tmp_path: Path) -> None:
    weak = outcome(Variant("stabilization", 1, 20, "RK45", 1e-3), steps=234)
    split = Outcome(**{**vars(lost(Variant("step", 0, 0, "RK4", 0.5))), "reason": "|Φ| grows"})
    study = Study("rig|2", "run", (REFERENCE, weak, split))
    written = study.save(tmp_path)
    assert [path.name for path in written] == ["study.md", "study.csv", "study.json"]
    head, *parts = written[0].read_text(encoding="utf-8").split("\n\n## ")
    assert head == (
        "# Study of run: rig|2\n\n"
        "Errors are the largest differences of any body from the most accurate run\n"
        f"({REFERENCE.variant.name}) over all output times; the residual is the largest |Φ|."
    )
    columns = "angle error / rad | position error / m | residual / m | energy error | steps"
    table = f"| variant | {columns} | evaluations | time / ms |\n| --- |{' ---: |' * 7}\n| "
    for part, one in zip(parts[1:3], (weak, split), strict=True):
        title, _, rest = part.partition("\n\n")
        assert title[0].isupper() and rest.startswith(table + one.variant.name)
        assert rest.count("\n") == 2
    assert r": \|Φ\| grows |" in parts[2]
    told = study.findings()
    assert parts[3] == "\n".join(["Findings", "", *(f"- {one}" for one in told), ""])
    content = json.loads(written[2].read_text(encoding="utf-8"))
    assert (content["title"], content["analysis"]) == ("rig|2", "run")
    assert content["findings"] == told and len(content["variants"]) == 3


def test_tables_and_findings_have_the_display_units(tmp_path: Path) -> None:
    """1.25e-4 rad = 0.00716°, 3.5 mm, 7.5 µm, 12.5 ms, 62.5 ms; JSON is in SI units."""
    made = outcome(Variant("stabilization", 10, 200, "RK4", 2e-3))
    broken = lost(Variant("tolerance", 10, 20, "RK45", 1e-4))
    good = outcome(Variant("tolerance", 10, 20, "RK45", 1e-9), position_error=1e-7)
    study = Study("rig", "run", (REFERENCE, made, broken, good))
    study.save(tmp_path / "si")
    with kp.units("mm", "deg", "us"):
        study.save(tmp_path / "own")
        found = study.findings()
    lines = (tmp_path / "own" / "study.md").read_text(encoding="utf-8").splitlines()
    assert (
        "| variant | angle error / ° | position error / mm | residual / mm | energy error | steps "
        "| evaluations | time / µs |" in lines
    )
    assert (
        "| α = 10, β = 200, RK4 h = 0.002 s | 0.0072 | 3.5 | 0.0075 | 4.5e-05 | 300 | 2100 "
        "| 1.25e+04 |" in lines
    )
    assert "diverged at t = 6.25e+04 µs: it broke" in "".join(lines)
    assert found[0].endswith("α = 10, β = 200 0.0075 mm in 300 steps.")
    assert "diverges at t = 6.25e+04 µs: it broke." in found[1]
    assert "every position within 0.001 mm is" in found[-1]
    assert "every position within 1 mm is" in found[-2]
    si, own = (
        list(csv.DictReader((tmp_path / n / "study.csv").read_text("utf-8").splitlines()))
        for n in ("si", "own")
    )
    converted = {
        "angle_error": ("deg", math.pi / 180.0),
        "position_error": ("mm", 1e-3),
        "residual": ("mm", 1e-3),
        **dict.fromkeys(("step", "diverged_at", "residual_at", "seconds"), ("us", 1e-6)),
    }
    for one, other in zip(si, own, strict=True):
        for name, value in one.items():
            unit, factor = converted.get(name, ("", 1.0))
            there = other[f"{name} [{unit}]" if unit else name]
            assert there == value or float(there) == pytest.approx(float(value) / factor)
    rows = [json.loads((tmp_path / n / "study.json").read_text("utf-8")) for n in ("si", "own")]
    assert rows[0]["variants"] == rows[1]["variants"]


def test_outcomes_cannot_change() -> None:
    for one, name in ((REFERENCE, "steps"), (REFERENCE.variant, "alpha")):
        with pytest.raises(FrozenInstanceError):
            setattr(one, name, 1)


def test_a_study_has_these_variants() -> None:
    """Three classical gains, four critically damped ones and projection at two tolerances."""
    found = [(v.group, v.alpha, v.beta, v.scheme, v.number) for v in variants()]
    assert found[0] == ("reference", 10.0, 200.0, "RK45", 1e-11)
    gains = [(10, 200), (1, 20), (0, 0), (5, 5), (20, 20), (50, 50), (200, 200), (0, 0)]
    for k, rtol in enumerate((1e-3, 1e-6)):
        part = found[1 + 8 * k : 9 + 8 * k]
        assert part == [("stabilization", *pair, "RK45", rtol) for pair in gains]
    assert found[17:24] == [
        ("beta", 10, beta, "RK45", 1e-6) for beta in (10, 20, 50, 100, 200, 500, 1000)
    ]
    steps = [
        ("step", *g, "RK4", h)
        for h in (1e-3, 2e-3, 5e-3, 0.01, 0.02)
        for g in ((10, 200), (1, 20), (0, 0), (20, 20))
    ]
    assert found[24:44] == steps
    tolerances = [
        ("tolerance", *pair, scheme, 10.0**-k)
        for k in range(3, 10)
        for *pair, scheme in ((10, 200, "RK45"), (1, 20, "RK45"), (0, 0, "RK45"), (0, 0, "DOP853"))
    ]
    assert [one[:4] for one in found[44:]] == [one[:4] for one in tolerances]
    assert [one[4] for one in found[44:]] == pytest.approx([one[4] for one in tolerances])


def test_a_variant_is_the_analysis_that_its_name_says() -> None:
    for way in (*variants(), Variant("beta", 1.0, 1.0, "RK45", 1e-6)):
        entry = way.entry()
        if way.scheme == "RK4":
            assert entry["method"] == {"type": "rk4", "step": way.number}
            assert f"RK4 h = {way.number:g} s" in way.name
        else:
            expected = {"type": way.scheme.lower(), "rtol": way.number, "atol": way.number / 1e3}
            assert entry["method"] == pytest.approx(expected)
            assert f"{way.scheme} rtol {way.number:g}" in way.name
        kind = entry["stabilization"]
        if way.projected:
            assert kind == {"type": "projection"}
            assert way.gains == "projection"
        elif way.alpha == way.beta == 0.0:
            assert kind == {"type": "none"}
            assert way.gains == "α = β = 0"
        else:
            assert kind == {"type": "baumgarte", "alpha": way.alpha, "beta": way.beta}
            numbers = [float(x) for x in re.findall(r"= ([\d.]+)", way.gains)]
            assert numbers == [way.alpha] * (way.alpha == way.beta) or [way.alpha, way.beta]


@pytest.mark.parametrize("name", ["slider_crank", "six_bar"])
def test_outcomes_of_other_mechanisms_are_measured_on_their_solutions(
    name: str, tmp_path: Path
) -> None:
    """Over the last 0.6 s of 0.8 s, with 1500 outputs where the analysis names no output_step."""
    text = (ROOT / "examples" / f"{name}.toml").read_text(encoding="utf-8")
    head = text.partition("[analyses.")[0]
    path = tmp_path / "case.toml"
    first, second = (f'[analyses.{n}]\ntype = "dynamics"\nt_end = {t}\n' for n, t in PARTS)
    path.write_text(head + first + second, encoding="utf-8")
    case = kp.load(path)
    ways = [
        Variant("reference", 0, 0, "DOP853", 1e-11, projected=True),
        Variant("step", 1, 20, "RK4", 5e-3),
    ]
    best, rough = kp.study(case, "later", ways=ways).outcomes
    assert best.solution is not None
    assert rough.solution is not None
    assert np.diff(best.solution.t) == pytest.approx(0.6 / 1500)
    assert (best.solution.t[0], best.solution.t[-1]) == pytest.approx((0.2, 0.8))
    apart = (rough.solution.q - best.solution.q).reshape(len(best.solution.t), -1, 3)
    assert rough.angle_error == pytest.approx(np.abs(apart[..., 2]).max(), rel=1e-12)
    assert rough.position_error == pytest.approx(np.hypot(*apart[..., :2].T).max(), rel=1e-12)
    drift = rough.solution.drift.position
    assert rough.residual == drift.max() > 0.0
    assert rough.residual_at == rough.solution.t[drift.argmax()]
    assert rough.imbalance == np.abs(rough.solution.energy.balance).max() > 0.0
    assert rough.steps == rough.solution.statistics["steps"] == 120
    assert rough.evaluations == rough.solution.nfev
    assert rough.seconds == rough.solution.statistics["seconds"]
