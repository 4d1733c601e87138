"""``kp.gradient``: names, order, units, tables and refusals."""

import csv
import pickle
from pathlib import Path

import kempe as kp
import numpy as np
import pytest

MEASURES = ["pin.max", "rod.angle.final", "rod.omega.min"]
VARIABLES = ["length", "rod.angle", "stiffness", "mass", "unused"]


def found(case: kp.Case, measures: list[str] = MEASURES) -> kp.Gradient:
    return kp.gradient(case, measures, VARIABLES, analysis="swing")


def test_names_and_values_are_in_the_order_given(case: kp.Case) -> None:
    g = found(case)
    assert list(g.measures) == MEASURES and list(g.variables) == VARIABLES
    assert g.variables == {
        "length": 1.0, "rod.angle": 0.5, "stiffness": 40.0, "mass": 2.0, "unused": 3.0
    }  # fmt: skip
    run = case.run()["swing"]
    assert g.measures["pin.max"] == run.measure("pin").max
    assert g.measures["rod.angle.final"] == run["rod.angle"][-1]
    assert g.jacobian.shape == (3, 5) and not g.jacobian.flags.writeable
    for k, measure in enumerate(MEASURES):
        for of, variable in enumerate(VARIABLES):
            assert g[measure, variable] == g.jacobian[k, of]


def test_the_order_of_variables_does_not_matter(case: kp.Case) -> None:
    g = found(case)
    other = kp.gradient(case, MEASURES[::-1], VARIABLES[::-1], analysis="swing")
    for measure in MEASURES:
        for variable in VARIABLES:
            assert g[measure, variable] == pytest.approx(other[measure, variable], rel=1e-13)


def test_slopes_agree_with_differences_of_sweeps(case: kp.Case) -> None:
    g = found(case, ["pin.max", "pin.final", "rod.angle.final"])
    assert not g.remarks
    for variable, x in g.variables.items():
        d = 1e-4 * x
        levels = [x - d, x + d]
        swept = kp.sweep(case, {variable: levels}, list(g.measures), analysis="swing")
        for measure, value in g.measures.items():
            slope = np.diff(swept[measure])[0] / (2 * d)
            assert g[measure, variable] == pytest.approx(slope, rel=1e-5, abs=1e-6 * abs(value / x))


def test_a_variable_without_effect_has_slope_zero(case: kp.Case) -> None:
    g = found(case)
    assert not g.remarks
    assert np.array_equal(g.jacobian[:, VARIABLES.index("unused")], np.zeros(3))


def test_units_are_those_of_measures_and_variables(case: kp.Case) -> None:
    g = found(case)
    assert g.units["pin.max"] == "N" and g.units["stiffness"] == ""
    assert g.unit("pin.max", "length") == "N/m"
    assert g.unit("pin.max", "stiffness") == "N/[stiffness]"
    assert g.unit("rod.omega.min", "mass") == "rad/s/kg"
    assert g.unit("rod.angle.final", "rod.angle") == "1"
    with kp.units("mm", "deg", "kN"):
        one = next(one for one in g.slopes() if one.variable == "length")
        assert one.unit.unit == "kN/mm"
        assert one.value == pytest.approx(g["pin.max", "length"] * 1e-6, rel=1e-15)


def test_tables_have_numbers_and_units(case: kp.Case) -> None:
    pandas = pytest.importorskip("pandas")
    g = found(case)
    assert isinstance(g.table, pandas.DataFrame)
    assert g.table.loc["pin.max", "mass"] == g["pin.max", "mass"]
    assert g.table.attrs["units"]["length"] == "m"
    share = g["pin.max", "mass"] * 2.0 / g.measures["pin.max"]
    assert g.relative.loc["pin.max", "mass"] == pytest.approx(share, rel=1e-15)
    with kp.units("mm"):
        assert g.table.attrs["units"]["length"] == "mm"
        assert g.table.loc["pin.max", "length"] == g["pin.max", "length"] / 1e3


def test_tables_without_pandas(case: kp.Case, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(__import__("sys").modules, "pandas", None)
    g = found(case)
    assert g.table["measure"].tolist() == MEASURES
    assert g.table["mass"][0] == g["pin.max", "mass"]
    assert g.table.dtype.metadata["units"]["pin.max"] == "N"


def test_a_measure_that_is_zero_has_no_relative_slopes(case: kp.Case) -> None:
    case = case.with_start({"rod.angle": 0.0}).with_analysis("swing", t_end=1e-9, output_step=1e-9)
    g = kp.gradient(case, ["rod.angle.max"], ["rod.angle"], analysis="swing")
    (one,) = g.slopes()
    assert g.measures["rod.angle.max"] == 0.0 and np.isnan(one.relative)


def test_ranks(case: kp.Case) -> None:
    sizes = [abs(one.relative) for one in found(case).ranked("pin.max")]
    assert sizes == sorted(sizes, reverse=True)


def test_a_file_of_all_slopes(case: kp.Case, tmp_path: Path) -> None:
    g = found(case)
    g.to_csv(tmp_path / "gradient.csv")
    with (tmp_path / "gradient.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 15
    first = rows[0]
    assert (first["measure"], first["variable"], first["unit"]) == ("pin.max", "length", "N/m")
    assert float(first["slope"]) == g["pin.max", "length"]
    assert first["remark"] == ""


def test_it_is_shown_and_copied(case: kp.Case) -> None:
    g = found(case)
    assert repr(g).startswith("<Gradient of pin.max = ") and "over length, rod.angle" in repr(g)
    assert "N/[stiffness]" in g._repr_html_()
    same = pickle.loads(pickle.dumps(g))
    assert np.array_equal(same.jacobian, g.jacobian) and same.remarks == g.remarks
    assert dict(same.measures) == dict(g.measures)


def test_unknown_pairs_are_refused(case: kp.Case) -> None:
    g = found(case)
    with pytest.raises(KeyError, match=r"unknown measure 'pin\.mx'") as caught:
        g["pin.mx", "mass"]
    assert "pin.max" in str(caught.value.hint)
    with pytest.raises(KeyError, match="unknown variable 'masses'"):
        g["pin.max", "masses"]
    with pytest.raises(kp.ModelError, match="not a measure and a variable") as told:
        g["pin.max"]
    assert told.value.hint == "write g['pin.max', 'length']"


@pytest.mark.parametrize(
    ("measures", "variables", "options", "message"),
    [
        (["pin.max"], ["masss"], {}, "unknown variable 'masss'"),
        (["pin.max"], ["rod.foo"], {}, "unknown coordinate 'foo'"),
        (["pin.mx"], ["mass"], {}, "unknown statistic in measures"),
        (["lower"], ["mass"], {"analysis": "ringing"}, "unknown number of the result of modes"),
        (["pin.max"], "mass", {}, r"variables: 'mass'; must be a list of names; write \['mass'\]"),
        ("pin.max", ["mass"], {}, "measures: 'pin.max'; must be a list of names"),
        (["pin.max"], [], {}, "gradient: no variables"),
        ([], ["mass"], {}, "gradient: no measures"),
        (["pin.max"], ["mass", "mass"], {}, "variables: one of them is given twice"),
        (["pin.max", "pin.max"], ["mass"], {}, "measures: one of them is given twice"),
        (["pin.max"], ["mass"], {"analysis": "swng"}, "unknown analysis 'swng'"),
        (["pin.max"], ["mass"], {"second": True}, "swing is of type dynamics, whose second"),
    ],
)
def test_invalid_requests(
    measures: list[str], variables: list[str], options: dict[str, object], message: str,
    case: kp.Case,
) -> None:  # fmt: skip
    with pytest.raises(kp.ModelError, match=message):
        kp.gradient(case, measures, variables, **{"analysis": "swing"} | options)  # type: ignore[arg-type]


def test_what_has_no_derivatives_yet_says_so(case: kp.Case) -> None:
    g = kp.gradient(case, ["energy.balance.max", "pin.max"], ["mass"], analysis="swing")
    assert g.measures["energy.balance.max"] == case.run()["swing"]["energy.balance"].max()
    assert np.isnan(g["energy.balance.max", "mass"]) and np.isfinite(g["pin.max", "mass"])
    assert set(g.remarks) == {("energy.balance.max", "mass")}
    assert "1 remark>" in repr(g)


def test_a_method_without_slopes_is_refused_by_name(case: kp.Case) -> None:
    case = case.with_analysis("swing", method={"type": "generalized_alpha", "step": 0.01})
    g = kp.gradient(case, ["rod.angle.final"], ["mass"], analysis="swing")
    told = g.remarks["rod.angle.final", "mass"]
    assert "generalized_alpha" in told and "choose method auto or radau" in told
    assert np.isnan(g.jacobian).all() and np.isfinite(g.measures["rod.angle.final"])


def test_teeth_are_refused_by_name() -> None:
    m = kp.Model("two gears", gravity=(0, 0), parameters={"z": 20, "m": "2 mm"})
    m.ground.points(O=(0, 0), P=(0.05, 0))
    m.body("a", mass=1, inertia=1e-3, points={"O": (0, 0)})
    m.body("b", mass=1, inertia=1e-3, points={"P": (0, 0)})
    m.revolute("A", "ground.O", "a.O")
    m.revolute("B", "ground.P", "b.P")
    m.gear("mesh", "a.O", "b.P", teeth=("z", 30), module="m")
    m.torque("drive", "a", torque=1)
    case = kp.Case(m, None, [kp.Dynamics(t_end=0.1, output_step=0.1, name="run")])
    with pytest.raises(kp.ModelError, match=r"variables\.z: .*whole numbers") as caught:
        kp.gradient(case, ["b.omega.final"], ["z"])
    assert "leave this variable out" in str(caught.value.hint)


def test_a_coordinate_that_others_determine_is_refused(case: kp.Case) -> None:
    case.model.point_mass("bob", mass=1, at=(1, 0))
    case.model.revolute("P", "rod.P", "bob.P")
    with pytest.raises(kp.ModelError, match=r"variables\.bob\.x: .*contradict") as caught:
        kp.gradient(case, ["pin.max"], ["bob.x"], analysis="swing")
    assert "sweep" in str(caught.value.hint)


def test_python_functions_are_refused_by_name(case: kp.Case) -> None:
    case.model.torque("brake", "rod", torque=lambda _, state: -0.1 * state["rod.omega"])
    with pytest.raises(kp.ModelError, match=r"forces\.brake\.torque is a Python function") as told:
        kp.gradient(case, ["pin.max"], ["mass"], analysis="swing")
    assert "or give its derivatives: kp.Function(f, slopes=g)" in str(told.value.hint)


def test_variables_in_the_formulas_of_an_analysis_have_a_remark(case: kp.Case) -> None:
    """The end of such a run moves."""
    case = case.with_analysis("swing", t_end="0.01*stiffness*length", output_step=0.01)
    g = kp.gradient(case, ["rod.angle.final"], ["stiffness", "mass"], analysis="swing")
    assert np.isnan(g["rod.angle.final", "stiffness"])
    told = g.remarks["rod.angle.final", "stiffness"]
    assert told.startswith("swing.t_end depends on it")
    same = kp.gradient(
        case.with_analysis("swing", t_end=0.4), ["rod.angle.final"], ["mass"], analysis="swing"
    )
    assert g["rod.angle.final", "mass"] == pytest.approx(same["rod.angle.final", "mass"], rel=1e-9)


def test_variables_that_depend_on_each_other_are_held() -> None:
    """As in a sweep, a variable that is given does not follow its formula."""
    parameters = {"m": 2.0, "k": "20*m"}
    m = kp.Model("rod", gravity=(0, -9.81), parameters=parameters)
    m.ground.points(O=(0, 0))
    m.bar("rod", mass="m", length=1, ends=("O", "P"))
    m.revolute("O", "ground.O", "rod.O")
    m.torsion_spring("spring", "ground", "rod", stiffness="k", free_angle=0)
    case = kp.Case(m, {"set": {"rod.angle": 0}}, [kp.Equilibrium()])
    alone = kp.gradient(case, ["rod.angle"], ["m"])
    both = kp.gradient(case, ["rod.angle"], ["m", "k"])
    assert abs(alone["rod.angle", "m"]) < 1e-12  # spring and weight grow together
    chained = both["rod.angle", "m"] + 20 * both["rod.angle", "k"]
    assert chained == pytest.approx(0, abs=1e-12) and both["rod.angle", "m"] < -0.01


def test_redundant_joints_and_their_numbers() -> None:
    m = kp.Model("beam", gravity=(0, -9.81), parameters={"a": 1.0}, redundancy="allow")
    m.ground.points(A=(0, 0), B=(1, 0), C=(2, 0))
    m.body("beam", mass=1, inertia=1, points={"A": (0, 0), "B": (1, 0), "C": (2, 0)})
    for name in "ABC":
        m.bar(f"l{name}", mass=1, length="a", ends=("O", "P"))
        m.revolute(f"g{name}", f"ground.{name}", f"l{name}.O")
        m.revolute(f"p{name}", f"l{name}.P", f"beam.{name}")
    run = kp.Dynamics(t_end=0.1, output_step=0.1, name="run")
    case = kp.Case(m, {"set": {"lA.angle": 1.0}}, [run])
    g = kp.gradient(case, ["beam.x.final"], ["a"])
    assert g.measures["beam.x.final"] == case.run()["run"]["beam.x"][-1]
    assert np.isnan(g["beam.x.final", "a"]) and ("beam.x.final", "a") in g.remarks


def test_the_error_of_a_run_that_fails_is_its_own(case: kp.Case) -> None:
    case.model.torque("brake", "rod", torque="sqrt(0.2 - t)")  # no number after 0.2 s
    with pytest.raises(kp.IntegrationError) as told:
        case.run()
    with pytest.raises(kp.IntegrationError) as caught:
        kp.gradient(case, ["rod.angle.final"], ["mass"], analysis="swing")
    assert caught.value.args[0] == told.value.args[0]
