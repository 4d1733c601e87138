"""The table of a sweep, its files, replay, tolerances and contributions."""

import csv
import math
import pickle
import sys
from pathlib import Path

import kempe as kp
import numpy as np
import pandas as pd
import pytest
from kempe.sweeps.contributions import contributions


@pytest.fixture
def result(case: kp.Case) -> kp.SweepResult:
    return kp.sweep(case, {"L2": [25, 26, 47], "k": [1e6, 2e6]}, ["pin.max", "rocker.angle.final"])


def test_the_table_has_a_row_for_each_variant(result: kp.SweepResult) -> None:
    table = result.table
    assert list(table.columns) == ["L2", "k", "pin.max", "rocker.angle.final", "reason"]
    assert table["L2"].tolist() == [25, 25, 26, 26, 47, 47]
    assert table["reason"].tolist()[:4] == [""] * 4
    assert "too long" in table["reason"][4]
    assert table["pin.max"].isna().tolist() == [False] * 4 + [True] * 2
    units = {"L2": "", "k": "", "pin.max": "N", "rocker.angle.final": "rad"}
    assert result.units == units


def test_without_pandas_it_is_a_structured_array(
    result: kp.SweepResult, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "pandas", None)
    table = result.table
    assert table.dtype.names == ("L2", "k", "pin.max", "rocker.angle.final", "reason")
    np.testing.assert_array_equal(table["pin.max"], result["pin.max"])
    assert table["reason"][0] == ""


def test_csv_preserves_every_number(result: kp.SweepResult, folder: Path) -> None:
    result.to_csv(folder / "sweep.csv")
    with Path("sweep.csv").open(encoding="utf-8") as file:
        read = [row["pin.max"] for row in csv.DictReader(file)]
    np.testing.assert_array_equal([float(x or "nan") for x in read], result["pin.max"])
    with Path("sweep.csv").open(encoding="utf-8") as file:
        rows = list(csv.reader(file))
    assert rows[1][-1] == "" and "too long" in rows[-1][-1]
    assert rows[-1][2] == ""


def test_parquet_names_what_is_missing(
    result: kp.SweepResult, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    with pytest.raises(kp.ModelError, match="pyarrow is not installed; pip install"):
        result.to_parquet("sweep.parquet")


def test_parquet_preserves_the_table(result: kp.SweepResult, folder: Path) -> None:
    pytest.importorskip("pyarrow", reason="the package pyarrow is missing")
    result.to_parquet("sweep.parquet")
    pd.testing.assert_frame_equal(pd.read_parquet(folder / "sweep.parquet"), result.table)


def test_a_row_is_replayed(result: kp.SweepResult, folder: Path) -> None:
    case = result.case(3)
    assert dict(case.model.parameters)["k"] == 2e6
    assert result.run(3).measure("pin").max == result["pin.max"][3]
    case.save("row.toml")
    assert kp.load("row.toml").run()[0].measure("pin").max == result["pin.max"][3]
    with pytest.raises(IndexError, match="row 6; the sweep has 6"):
        result.case(6)
    assert len(list(folder.iterdir())) == 1


def test_a_result_can_be_pickled(result: kp.SweepResult) -> None:
    assert len(result.table) == 6 and result.succeeded.any()
    copied = pickle.loads(pickle.dumps(result))
    pd.testing.assert_frame_equal(copied.table, result.table)
    assert copied.reasons == result.reasons and copied.units == result.units
    with pytest.raises(ValueError, match="read-only"):
        copied["pin.max"][0] = 0.0
    assert copied.run(3).measure("pin").max == result["pin.max"][3]


def test_tolerances_can_be_pickled() -> None:
    found = kp.tolerances(pendulum(), {"mass": 0.02}, "pin.force.final", n=4)
    assert repr(pickle.loads(pickle.dumps(found))) == repr(found)


def test_an_unknown_column_is_named(result: kp.SweepResult) -> None:
    with pytest.raises(kp.ModelError, match=r"did you mean 'pin\.max'"):
        result["pin.mx"]


def pendulum() -> kp.Case:
    """A rod that hangs at rest: the force in its pin is m g."""
    m = kp.Model("rod", gravity=(0, "-g"), parameters={"mass": 2.0, "g": 9.81, "length": 1.0})
    m.ground.points(O=(0, 0))
    m.bar("rod", mass="mass", length="length", ends=("O", "E"))
    m.revolute("pin", "ground.O", "rod.O")
    start = {"set": {"rod.angle": -np.pi / 2, "rod.omega": 0.0}}
    return kp.Case(m, start, [kp.Dynamics(t_end=0.01, output_step=0.01)])


def test_tolerances_of_a_product_are_those_of_its_formula() -> None:
    found = kp.tolerances(
        pendulum(), {"mass": 0.02, "g": 0.03, "length": 0.1}, "pin.force.final", n=4000, seed=1
    )
    by_mass, by_g = 0.02 * 9.81, 0.03 * 2.0
    exact = math.hypot(by_mass, by_g)
    assert found.nominal == pytest.approx(2 * 9.81, rel=1e-9)
    assert found.slopes["mass"] == pytest.approx(9.81, rel=1e-7)
    assert found.slopes["length"] == pytest.approx(0.0, abs=1e-6)
    assert found.first_order == pytest.approx(exact, rel=1e-7)
    assert found.deviation == pytest.approx(exact, rel=0.04)
    assert found.mean == pytest.approx(2 * 9.81, abs=4 * exact / math.sqrt(4000))
    assert found.contributions["mass"] == pytest.approx((by_mass / exact) ** 2, rel=1e-6)
    assert sum(found.contributions.values()) == pytest.approx(1)
    assert "first order ±" in repr(found)


def test_contributions_are_correlation_ratios() -> None:
    given = {"mass": {"normal": [2, 0.02]}, "g": {"normal": [9.81, 0.03]}}
    result = kp.sweep(pendulum(), given, ["pin.force.final"], design="sobol", n=4096)
    shares = contributions(result, "pin.force.final")
    exact = 0.02 * 9.81, 0.03 * 2.0
    assert shares["mass"] == pytest.approx(
        exact[0] ** 2 / (exact[0] ** 2 + exact[1] ** 2), abs=0.02
    )
    assert shares["g"] == pytest.approx(exact[1] ** 2 / (exact[0] ** 2 + exact[1] ** 2), abs=0.02)


def test_contributions_of_a_grid_are_exact() -> None:
    result = kp.sweep(pendulum(), {"mass": [1, 2], "g": [9.0, 10.0]}, ["pin.force.final"])
    values = np.array([[9.0, 10.0], [18.0, 20.0]])
    of_mass = values.mean(axis=1).var() / values.var()
    assert contributions(result, "pin.force.final")["mass"] == pytest.approx(of_mass, rel=1e-6)


def test_a_tolerance_that_no_variant_survives_is_told(case: kp.Case) -> None:
    with pytest.raises(kp.ModelError, match=r"within the tolerances fails.*too long"):
        kp.tolerances(case, {"L2": 40.0}, "pin.max", n=4)
