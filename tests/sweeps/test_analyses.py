"""Every analysis is swept by the core, and its numbers are those of single runs."""

from pathlib import Path
from typing import Any

import kempe as kp
import numpy as np
import pytest
from house.places import ROOT
from kempe.sweeps.numbers import NUMBERS
from kempe.sweeps.plan import Plan
from kempe.sweeps.wanted import read_wanted
from sizes import only_full

#: Statistics of a motion.
STATISTICS = ("max", "min", "mean", "rms", "integral", "final", "t_max", "settling")
FEW = ("four_bar", "slider_crank", "motor_press")
ALL = sorted(path.stem for path in (ROOT / "examples").glob("*.toml"))
KINDS = ("mobility", "equilibrium", "path", "modes", "limits", "configurations")
#: Attributes that are lists, of which the number of entries counts.
COUNTED = ("redundant", "singular", "locked", "loose", "undetermined")
#: Numbers in place of None.
ABSENT = {"lower": -np.inf, "upper": np.inf, "span": np.inf, "turns": np.nan}


def texts_of(case: kp.Case, kind: str, entry: dict[str, Any]) -> list[str]:
    """Some numbers of the result of an analysis."""
    body = next(name for name in case.model.bodies if name != "ground")
    joint = next(iter(case.model.joints))
    names = [f"{body}.angle", f"{joint}.force", f"{body}.alpha"]
    if kind not in NUMBERS or not NUMBERS[kind]:
        return [f"{name}.{of}" for name in names for of in STATISTICS]
    if kind == "equilibrium" and entry.get("over"):
        return ["values[-1]", "stable[0]", f"{body}.angle[-1]", f"{joint}.force[0]", "complete"]
    if kind == "equilibrium":
        return ["stable", "residual", "steps", "complete", *names[:2]]
    if kind == "modes":
        return ["frequency[0]", "damping[-1]", "omega[0]", "stable", "is_equilibrium", "rates[0]"]
    return list(NUMBERS[kind])


def plan_of(case: kp.Case, parameter: str) -> Plan:
    *_, (name, entry) = case.analyses.items()
    texts = texts_of(case, entry["type"], entry)
    wanted = read_wanted(case.model.compile(), entry, texts)
    return Plan(case, name, (parameter,), tuple(wanted))


def compare(case: kp.Case) -> int:
    """Compare rows of the core with rows of single runs; returns how many the core left to them."""
    parameter, value = next(iter(case.model.parameters.items()))
    rows = np.array([[value], [1.01 * value], [1.6 * value]])
    plan, left = plan_of(case, parameter), []
    assert plan.is_native
    expected = plan._singly(rows)
    with pytest.MonkeyPatch.context() as patch:
        alone = Plan._singly
        patch.setattr(Plan, "_singly", lambda of, row: (left.append(row), alone(of, row))[1])
        found = plan.rows(rows, 2)
    np.testing.assert_array_equal(found.values, expected.values)
    np.testing.assert_array_equal(found.marks, expected.marks)
    assert found.reasons == expected.reasons
    return len(left)


def lists(case: kp.Case) -> dict[str, list[Any]]:
    """Lists of analyses, the last of which is swept."""
    body = next(name for name in case.model.bodies if name != "ground")
    over = f"{body}.angle"
    angle = float(case.start()[over])
    brief = kp.Dynamics(t_end=0.05, output_step=0.01)
    ends = {"over": over, "range": (angle, angle + 0.05), "n": 6}
    return {
        "dynamics after dynamics": [brief, kp.Dynamics(t_end=0.1, output_step=0.01, name="on")],
        "dynamics after equilibrium": [kp.Equilibrium(), brief],
        "mobility": [brief, kp.Mobility()],
        "equilibrium": [kp.Equilibrium()],
        "held": [kp.Equilibrium(hold=[over])],
        "modes": [kp.Equilibrium(), kp.Modes()],
        "modes in motion": [brief, kp.Modes()],
        "limits": [kp.Limits(over=over)],
        "kinematics": [kp.Kinematics(**ends)],
        "inverse": [kp.InverseDynamics(**ends)],
        "static": [kp.InverseDynamics(**ends, static=True)],
        "configurations": [kp.Configurations()],
    }


def cases_of(name: str) -> dict[str, kp.Case]:
    case = kp.load(ROOT / "examples" / f"{name}.toml")
    return {key: kp.Case(case.model, case._start, of) for key, of in lists(case).items()}


@pytest.mark.parametrize("name", FEW)
def test_the_core_computes_every_analysis(name: str) -> None:
    """Values, marks and reasons equal those of single runs to the last bit."""
    for key, case in cases_of(name).items():
        assert compare(case) == 0, key


@only_full
@pytest.mark.parametrize("name", ALL)
def test_every_example(name: str) -> None:
    case = kp.load(ROOT / "examples" / f"{name}.toml")
    if not case.model.parameters or name == "pantograph":  # which has two drivers
        return
    for of in cases_of(name).values():
        compare(of)


def of_kind(kind: str) -> kp.Case:
    """The flagship with an analysis of a kind."""
    case = kp.load(ROOT / "examples" / "four_bar.toml")
    analyses: dict[str, Any] = {
        "mobility": kp.Mobility(),
        "equilibrium": kp.Equilibrium(),
        "path": kp.Equilibrium(over="k", range=(1e6, 2e6)),
        "modes": kp.Modes(outputs=["rocker.angle"]),
        "limits": kp.Limits(over="crank.angle"),
        "configurations": kp.Configurations(set={"crank.angle": 2.0}),
    }
    return kp.Case(case.model, case._start, [analyses[kind]])


def last_of(result: Any, name: str) -> Any:
    """The last number of an attribute of a result; None if it is not one real number."""
    value = len(result) if name == "count" else getattr(result, name)
    if value is None or name in COUNTED:
        return ABSENT[name] if value is None else len(value)
    if np.ndim(value) == 0:
        return float(value)
    last = np.ravel(value[-1]) if np.size(value) else np.empty(0)
    return float(last[0].real) if last.size == 1 and last[0].imag == 0 else None


@pytest.mark.parametrize("kind", KINDS)
def test_numbers_are_the_attributes_of_results(kind: str) -> None:
    case = of_kind(kind)
    for name in NUMBERS[next(iter(case.analyses.values()))["type"]]:
        listed = np.ndim(getattr(kp.sweep(case, {"L2": [26.0]}, [name]).run(0), name, 0)) > 0
        text = f"{name}[-1]" if listed and name not in COUNTED else name
        found = kp.sweep(case, {"L2": [26.0, 36.0]}, [text])
        for k in range(2):
            expected = last_of(found.run(k), name)
            if expected is None:
                assert text in found.reasons[k] or f"values of {name}" in found.reasons[k]
            else:
                np.testing.assert_array_equal(found[text][k], expected)


def test_the_number_of_threads_changes_nothing() -> None:
    case, given = of_kind("limits"), {"L2": np.linspace(26, 36, 9)}
    one, many = (kp.sweep(case, given, ["lower", "upper"], workers=n) for n in (1, 3))
    np.testing.assert_array_equal(one["upper"], many["upper"])
    assert np.isinf(one["upper"][0]) and np.isfinite(one["upper"][-1])


def test_a_sweep_of_equilibria_resumes(tmp_path: Path) -> None:
    case, given = of_kind("equilibrium"), {"k": np.linspace(1e6, 2e6, 5)}
    first = kp.sweep(case, given, ["rocker.angle"], out=tmp_path / "sweep.db")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Plan, "rows", None)
        again = kp.sweep(case, given, ["rocker.angle"], out=tmp_path / "sweep.db")
    np.testing.assert_array_equal(first["rocker.angle"], again["rocker.angle"])
