"""``--units``: the display units of tables, figures and CSV files."""

import csv
import json
from pathlib import Path

import kempe as kp
import pytest
from kempe import plot
from kempe.cli import main

EXAMPLES = Path(__file__).parents[2] / "examples"
SLIDER = EXAMPLES / "slider_crank.toml"


@pytest.fixture(autouse=True)
def _folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def test_figures_have_the_units() -> None:
    assert main(["run", str(SLIDER), "--no-figures", "-q", "-o", "r"]) == 0
    words = ["plot", "r/solution.npz", "--figure", "motion", "--format", "svg"]
    for name, more in (("si", []), ("mm", ["--units", "mm,deg"])):
        assert main([*words, "-o", name, *more]) == 0
    with kp.units("mm", "deg"):
        pages = plot.select(plot.pages(kp.load_solution("r/solution.npz")), ["motion"])
        plot.save(pages, Path("python"), ["svg"])
    (given,), (expected,), (usual,) = (
        list(Path(name).iterdir()) for name in ("mm", "python", "si")
    )
    assert given.read_bytes() == expected.read_bytes() != usual.read_bytes()
    assert kp.units().chosen == ()  # the units of the process are as before


@pytest.mark.parametrize(
    ("units", "told"),
    [
        ("milimetre", "milimetre"),
        ("mm,cm", "measure the same quantity"),
        ("", "names no unit"),
        ("kg/s", "measures no shown quantity"),
    ],
)
@pytest.mark.parametrize("command", ["run", "check", "plot", "animate", "show", "study", "sweep"])
def test_wrong_units_are_refused(
    command: str, units: str, told: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([command, str(SLIDER), "--units", units]) == 2
    out, err = capsys.readouterr()
    assert told in err
    assert out == ""
    assert list(Path().iterdir()) == []


def test_tables_and_csv_have_the_units(capsys: pytest.CaptureFixture[str]) -> None:
    words = [str(SLIDER), "--units", "mm,rpm,deg"]
    assert main(["run", *words, "--no-figures", "-o", "r"]) == 0
    printed = capsys.readouterr().out
    solution = kp.load_solution("r/solution.npz")
    x = float(solution.initial["crank"].x)
    line = next(line for line in printed.splitlines() if line.strip().startswith("crank  "))
    assert "x / mm" in printed
    assert "omega / rpm" in printed
    assert f"{1e3 * x + 0.0:.6g}" in line or x == 0.0
    with Path("r/solution.csv").open(encoding="utf-8", newline="") as file:
        header, first = (row for _, row in zip(range(2), csv.reader(file), strict=False))
    k = next(k for k, name in enumerate(header) if "omega" in name and "rpm" in name)
    body = header[k].split(".")[0]
    expected = float(solution.initial[body].omega) * 60.0 / (2.0 * 3.141592653589793)
    assert float(first[k]) == pytest.approx(expected, rel=1e-12, abs=1e-12)


def test_show_has_the_units(capsys: pytest.CaptureFixture[str]) -> None:
    words = ["show", str(SLIDER), "--multipliers", "--t", "0.5"]
    assert main([*words, "--units", "kN,ms"]) == 0
    first, *lines = capsys.readouterr().out.splitlines()
    assert first == "λ, multipliers, kN and N·m, 8, t = 500 ms"
    assert main([*words, "--json", "--units", "kN,ms"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["t"] == 0.5
    for line, value in zip(lines, found["matrices"][0]["values"], strict=True):
        divisor = 1e3 if "[kN]" in line else 1.0
        number = line.split()[-1].replace("·", "0")
        assert float(number) == pytest.approx(value / divisor, abs=6e-5)


def test_a_study_has_the_units(capsys: pytest.CaptureFixture[str]) -> None:
    kp.load(SLIDER).with_analysis("coasting", t_end=0.02).save("short.toml")
    assert main(["study", "short.toml", "-o", "s", "--units", "um,deg"]) == 0
    assert "position error / µm" in capsys.readouterr().out
    assert "angle_error [deg]" in Path("s/study.csv").read_text(encoding="utf-8")
    assert kp.units().chosen == ()
