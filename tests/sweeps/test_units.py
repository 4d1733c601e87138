"""Tables, figures and files of a sweep in the units of ``--units`` and ``kp.units``."""

import csv
import json
import sys
from pathlib import Path

import kempe as kp
import numpy as np
import pytest
from kempe.cli.app import run

MEASURES = ["rod.P.x.min", "O.force.max", "rod.omega.min", "rod.omega.t_min"]
VALUES = {"length": [0.5, 1.0], "rod.angle": [0.0, 0.5]}


def rod() -> kp.Case:
    m = kp.Model("rod", gravity=(0, -9.81), parameters={"length": "1 m"})
    m.ground.points(O=(0, 0))
    m.bar("rod", mass=2, length="length", ends=("O", "P"))
    m.revolute("O", "ground.O", "rod.O")
    start = {"set": {"rod.angle": 0}}
    return kp.Case(m, start, [kp.Dynamics(t_end=1, output_step=0.01, name="fall")])


@pytest.fixture(scope="module")
def result() -> kp.SweepResult:
    return kp.sweep(rod(), VALUES, MEASURES)


#: Divisors of the columns for mm, deg and rpm.
DIVISORS = [1e-3, np.pi / 180, 1e-3, 1.0, np.pi / 30, 1.0]
LABELS = [
    "length [mm]",
    "rod.angle [deg]",
    "rod.P.x.min [mm]",
    "O.force.max [N]",
    "rod.omega.min [rpm]",
    "rod.omega.t_min [s]",
]


def read(path: Path) -> tuple[list[str], np.ndarray]:
    with path.open(encoding="utf-8") as file:
        head, *rows = csv.reader(file)
    return head, np.array([[float(x) for x in row[:-1]] for row in rows])


@pytest.mark.usefixtures("folder")
def test_the_command_shows_the_units(
    result: kp.SweepResult, capsys: pytest.CaptureFixture[str]
) -> None:
    case = rod()
    sweep = {"variables": VALUES, "measures": MEASURES}
    kp.Case(case.model, case._start, case.analyses, sweep).save("rod.toml")
    assert run(["sweep", "rod.toml", "--units", "mm,deg,rpm"]) == 0
    lines = capsys.readouterr().out.splitlines()
    printed = {line.split()[0]: line.split()[1:] for line in lines if line.startswith("  r")}
    for name, unit, divisor in (("rod.P.x.min", "mm", 1e-3), ("rod.omega.min", "rpm", np.pi / 30)):
        *numbers, told = printed[name]
        assert told == unit
        values = result[name] / divisor
        expected = [values.min(), values.mean(), values.max()]
        np.testing.assert_allclose([float(x) for x in numbers], expected, rtol=1e-5)
    head, rows = read(Path("out/rod/sweep/sweep.csv"))
    assert head == [*LABELS, "reason"]
    exact = np.column_stack([result[name] for name in result.columns]) / DIVISORS
    np.testing.assert_allclose(rows, exact, rtol=1e-14)
    assert kp.units().chosen == ()
    assert run(["sweep", "rod.toml", "--units", "mm", "--json"]) == 0  # resumes
    assert json.loads(capsys.readouterr().out)["variants"] == 4


def test_si_units_need_no_remark(folder: Path, result: kp.SweepResult) -> None:
    result.to_csv(folder / "si.csv")
    head, rows = read(folder / "si.csv")
    assert head == [*result.columns, "reason"]
    np.testing.assert_array_equal(rows, np.column_stack([result[x] for x in result.columns]))


def test_the_table_has_the_units(result: kp.SweepResult, monkeypatch: pytest.MonkeyPatch) -> None:
    plain = result.table
    assert plain.attrs["units"]["length"] == "m" and result.table is plain
    with kp.units("mm", "deg", "rpm"):
        table = result.table
        monkeypatch.setitem(sys.modules, "pandas", None)
        array = kp.sweep(rod(), VALUES, MEASURES).table
    units = [label.partition("[")[2][:-1] for label in LABELS]
    assert list(table.attrs["units"].values()) == units
    assert list(array.dtype.metadata["units"].values()) == units
    for name, divisor in zip(result.columns, DIVISORS, strict=True):
        np.testing.assert_array_equal(table[name], result[name] / divisor)
        np.testing.assert_array_equal(array[name], result[name] / divisor)
    assert result.table is plain


def test_axes_of_figures_have_the_units(result: kp.SweepResult) -> None:
    with kp.units("mm", "deg"):
        lines = kp.plot.sweep_lines(result, "rod.P.x.min")
        cells = kp.plot.sweep_map(result, "rod.P.x.min")
        scatter = kp.plot.sweep_scatter(result, ["length", "rod.angle"])
    assert (lines.get_xlabel(), lines.get_ylabel()) == ("length / mm", "rod.P.x.min / mm")
    np.testing.assert_allclose(lines.get_lines()[0].get_xdata(), [500, 1000])
    legend = lines.get_legend()
    assert legend is not None and legend.get_title().get_text() == "rod.angle / °"
    assert [text.get_text() for text in legend.get_texts()] == ["0", "28.65"]
    assert (cells.get_xlabel(), cells.get_ylabel()) == ("length / mm", "rod.angle / °")
    assert cells.get_xlim() == pytest.approx((250, 1250))
    assert scatter.axes[2].get_xlabel() == "length / mm"
    assert scatter.axes[2].get_ylabel() == "rod.angle / °"
    np.testing.assert_allclose(scatter.axes[2].get_lines()[0].get_xdata(), 1e3 * result["length"])


def test_points_of_a_map_have_the_units() -> None:
    spread = {"length": {"uniform": [0.5, 1.0]}, "rod.angle": {"uniform": [0.0, 1.0]}}
    found = kp.sweep(rod(), spread, ["rod.omega.min"], design="random", n=5)
    with kp.units("mm"):
        points = kp.plot.sweep_map(found, "rod.omega.min").collections[0]
    np.testing.assert_allclose(points.get_offsets()[:, 0], 1e3 * found["length"])
