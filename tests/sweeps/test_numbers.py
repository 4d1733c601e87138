"""Measures of analyses that are not motions, and of motions over a driven quantity."""

from pathlib import Path
from typing import Any

import kempe as kp
import numpy as np
import pytest
from house.places import ROOT


def case_of(*analyses: Any) -> kp.Case:
    case = kp.load(ROOT / "examples" / "four_bar.toml")
    return kp.Case(case.model, case.tree()["start"], list(analyses))


def test_limits_without_an_end_are_infinite() -> None:
    """With a coupler of 26 m the crank turns fully; with one of 36 m it has two limits."""
    case = case_of(kp.Limits(over="crank.angle"))
    found = kp.sweep(case, {"L2": [26.0, 36.0]}, ["lower", "upper", "span", "turns"])
    assert not found.reasons
    assert [found[name][0] for name in ("lower", "upper", "span")] == [-np.inf, np.inf, np.inf]
    exact = found.run(1)
    assert found["lower"][1] == exact.lower and found["upper"][1] == exact.upper
    assert found["turns"][0] >= 1 and np.isnan(found["turns"][1])
    assert found.units["lower"] == "rad"


def test_infinite_limits_are_drawn() -> None:
    """A slide of any length has no limit; the axis of a length has a scale by its values."""
    m = kp.Model("slide", parameters={"mass": 1.0})
    m.ground.points(O=(0, 0))
    m.body("block", mass="mass", inertia=1, points={"P": (0, 0)})
    m.translational("slide", "ground.O", "block.P")
    case = kp.Case(m, {"set": {"slide.displacement": 0.1}}, [kp.Limits(over="slide.displacement")])
    found = kp.sweep(case, {"mass": [1.0, 2.0]}, ["upper", "start"])
    assert found["upper"].tolist() == [np.inf] * 2 and found.units["upper"] == "m"
    assert kp.plot.sweep_lines(found, "upper").get_ylabel() == "upper / m"
    for page in kp.plot.sweep_pages(found):
        page.draw()


def test_the_driver_of_a_motion_over_a_quantity_has_an_effort() -> None:
    case = case_of(kp.InverseDynamics(over="crank.angle", range=(1, 1.5), n=20))
    texts = ["over.effort.max", "over.effort.t_max", "over.effort.frequency"]
    found = kp.sweep(case, {"L2": [26.0, 27.0]}, texts)
    assert not found.reasons
    efforts = found.run(1)["over.effort"]
    assert found["over.effort.max"][1] == pytest.approx(efforts.max(), rel=1e-6)
    units = [found.units[text] for text in texts]
    assert units == ["N*m", "rad", "1/rad"]
    with pytest.raises(kp.ModelError, match=r"unknown name 'over\.effort'"):
        kp.sweep(case_of(kp.Dynamics(t_end=0.1)), {"L2": [26.0]}, ["over.effort.max"])


def test_the_section_of_a_file_may_name_this_effort(tmp_path: Path) -> None:
    file = tmp_path / "over.toml"
    case_of(kp.InverseDynamics(over="crank.angle", range=(1, 1.5), n=20)).save(file)
    section = '[sweep]\nvariables = { L2 = [26.0, 27.0] }\nmeasures = ["over.effort.max"]\n'
    file.write_text(file.read_text() + "\n" + section)
    assert not kp.sweep(kp.load(file), {"L2": [26.0]}, ["over.effort.max"]).reasons
    case_of(kp.Dynamics(t_end=0.1)).save(file)
    file.write_text(file.read_text() + "\n" + section)
    with pytest.raises(kp.ModelError, match=r"unknown name 'over"):
        kp.load(file)


def test_an_equilibrium_has_positions_and_efforts() -> None:
    case = case_of(kp.Equilibrium(hold=["crank.angle"]))
    case.model.measures(lean="rocker.angle - coupler.angle", pin="C.force")
    texts = ["rocker.angle", "effort.crank.angle", "lean", "pin"]
    found = kp.sweep(case, {"k": [1e5, 1e6]}, texts)
    assert not found.reasons
    result = found.run(1)
    state = result.state
    assert found["rocker.angle"][1] == pytest.approx(state["rocker.angle"], rel=1e-14)
    assert found["effort.crank.angle"][1] == result.effort["crank.angle"]
    assert found["lean"][1] == pytest.approx(state["rocker.angle"] - state["coupler.angle"])
    assert found["pin"][1] == pytest.approx(np.hypot(*state.constraint("C").force(on="rocker")))
    assert [found.units[text] for text in texts] == ["rad", "N*m", "rad", "N"]


def test_a_point_of_a_path_of_equilibria_has_a_number() -> None:
    case = case_of(kp.Equilibrium(over="k", range=(1e6, 2e6)))
    found = kp.sweep(case, {"L2": [26.0]}, ["rocker.angle[-1]", "stable[0]", "values[-1]"])
    assert not found.reasons
    assert found["rocker.angle[-1]"][0] == pytest.approx(found.run(0).state["rocker.angle"])
    assert found["values[-1]"][0] == pytest.approx(2e6)
    vague = kp.sweep(case, {"L2": [26.0]}, ["rocker.angle"]).reasons[0]
    assert vague.endswith("values; name one of them, such as rocker.angle[0]")
    absent = kp.sweep(case, {"L2": [26.0]}, ["folds[5]"]).reasons[0]
    assert absent == "folds[5]: the result has 0 values of folds"


def test_configurations_are_counted() -> None:
    case = case_of(kp.Configurations(set={"crank.angle": 1.0}))
    found = kp.sweep(case, {"L2": [26.0]}, ["count", "complete"])
    assert (found["count"][0], found["complete"][0]) == (2, 1)


def test_redundant_joints_are_counted() -> None:
    found = kp.sweep(case_of(kp.Mobility()), {"L2": [26.0]}, ["redundant", "degrees_of_freedom"])
    assert (found["redundant"][0], found["degrees_of_freedom"][0]) == (0, 1)


@pytest.mark.parametrize(
    ("analysis", "text", "message"),
    [
        (kp.Limits(over="crank.angle"), "lowr", "result of limits 'lowr'; did you mean 'lower'"),
        (kp.Configurations(set={"crank.angle": 1}), "index", "number of the result of config"),
        (kp.Equilibrium(), "rocker.angel", "did you mean 'rocker.angle'"),
        (kp.Equilibrium(), "effort.crank.angle", "unknown effort 'crank.angle'"),
        (kp.Equilibrium(), "effort['crank.angle']", "write effort.crank.angle"),
        (kp.Equilibrium(), "energy.total", "a quantity of a whole run"),
        (kp.Modes(), "rocker.angle", "number of the result of modes"),
    ],
)
def test_numbers_that_a_result_lacks_are_refused(analysis: Any, text: str, message: str) -> None:
    with pytest.raises(kp.ModelError, match=message.replace("[", r"\[")):
        kp.sweep(case_of(analysis), {"L2": [26.0]}, [text])


def test_a_complex_eigenvalue_is_not_one_number() -> None:
    case = case_of(kp.Equilibrium(), kp.Modes())
    found = kp.sweep(case, {"k": [1e6]}, ["eigenvalues[0]"])
    assert found.reasons[0] == "eigenvalues[0] is not one real number"
