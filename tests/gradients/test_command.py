"""``kempe gradient``: the printed table, the file and the figure."""

import csv
import json
from pathlib import Path

import kempe as kp
import pytest
from gradients.conftest import written
from kempe.cli.app import run


def rows() -> list[dict[str, str]]:
    with Path("out/rod/gradient/gradient.csv").open(encoding="utf-8") as file:
        return list(csv.DictReader(file))


def test_the_gradient_of_a_file(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    g = kp.gradient(kp.load(written(folder)))
    assert run(["gradient", "rod.toml"]) == 0
    told = capsys.readouterr().out
    assert f"pin.max = {g.measures['pin.max']:.6g} N" in told
    assert f"{g['pin.max', 'length']:.6g}" in told and "N/[stiffness]" in told
    assert float(rows()[1]["slope"]) == g["pin.max", "length"]
    figures = sorted(path.name for path in Path("out/rod/gradient/figures").iterdir())
    assert figures == ["00_gradient.png", "00_gradient.svg"]


def test_options_replace_the_section(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    written(folder, "")
    words = ["--measure", "pin.max", "--over", "mass", "--over", "rod.angle", "--analysis", "swing"]
    assert run(["gradient", "rod.toml", *words, "--json", "--set", "mass=3"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["variables"] == {"mass": 3.0, "rod.angle": 0.5}
    g = kp.gradient(
        kp.load("rod.toml", parameters={"mass": 3}), ["pin.max"], ["mass", "rod.angle"],
        analysis="swing",
    )  # fmt: skip
    assert found["gradient"]["pin.max"]["mass"] == g["pin.max", "mass"]
    assert found["remarks"] == []


def test_units_convert_the_table_and_the_file(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    g = kp.gradient(kp.load(written(folder)))
    assert run(["gradient", "rod.toml", "--units", "mm,kN"]) == 0
    assert "kN/mm" in capsys.readouterr().out
    assert rows()[1]["unit"] == "kN/mm"
    assert float(rows()[1]["slope"]) == pytest.approx(g["pin.max", "length"] * 1e-6, rel=1e-15)


def test_remarks_are_printed(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    written(folder, "")
    words = ["--measure", "energy.balance.max", "--over", "mass", "--analysis", "swing"]
    assert run(["gradient", "rod.toml", *words]) == 0
    told = capsys.readouterr().out
    assert "mass *" in told and "* mass: a balance is an error of the integration" in told
    assert rows()[0]["slope"] == "" and "a balance is an error" in rows()[0]["remark"]


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ([], "gradient: no variables"),
        (["--over", "masss", "--measure", "pin.max"], "unknown variable 'masss'"),
        (["--over", "mass", "--measure", "pin"], "write pin.max"),
    ],
)
def test_faulty_words_are_refused(
    words: list[str], message: str, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    written(folder, "")
    assert run(["gradient", "rod.toml", *words, "--analysis", "swing"]) == 2
    assert message in capsys.readouterr().err
