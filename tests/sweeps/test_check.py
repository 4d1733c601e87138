"""``kempe check`` checks the section [sweep] as ``kempe sweep`` does, without a variant."""

import json
from pathlib import Path

import pytest
from kempe.cli.app import run
from sweeps.test_file import written

HEAD = '[sweep]\nmeasures = ["C.force.max"]\n'


def section(head: str, variables: str) -> str:
    return f"\n{head}\n[sweep.variables]\n{variables}\n"


@pytest.mark.parametrize(
    ("head", "variables", "message"),
    [
        (f'{HEAD}design = "sobol"\nn = 5', "L2 = [25, 26]", "sweep.n: 5; a Sobol design"),
        (HEAD, "L2 = { normal = [26, 1] }", "sweep.variables.L2: a grid design needs a list"),
        (f'{HEAD}design = "random"', "L2 = [25, 26]", "sweep.n: missing; a random design"),
        (f"{HEAD}n = 5", "L2 = [25, 26]", "sweep.n: a grid design has as many variants"),
        (
            f'{HEAD}design = "latin"\nn = 5',
            "L2 = { normal = [26, -1] }",
            "sweep.variables.L2.normal: the standard deviation is -1; must be > 0",
        ),
        (
            f'{HEAD}design = "random"\nn = 5',
            "L2 = { uniform = [26, 25] }",
            "sweep.variables.L2.uniform: from 26 to 25; the second must be larger",
        ),
        (
            f'{HEAD}design = "paired"',
            "L2 = [25, 26]\nk = [1e6]",
            "sweep.variables: a paired design needs lists of one length; these have L2 2, k 1",
        ),
        (
            HEAD,
            'k = { from = -1, to = 2, n = 3, scale = "log" }',
            "sweep.variables.k: a logarithmic range from -1 to 2; both must have one sign",
        ),
        (
            '[sweep]\nmeasures = ["C.force.max", "C.force.max"]',
            "L2 = [25]",
            "sweep.measures: one of them is given twice",
        ),
        (
            '[sweep]\nmeasures = ["lowr"]\n[analyses.reach]\ntype = "limits"\nover = "crank.angle"',
            "L2 = [25]",
            "sweep: unknown number of the result of limits 'lowr'",
        ),
    ],
)
def test_faults_of_values_are_found(
    head: str, variables: str, message: str, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    written(folder, section(head, variables))
    assert run(["check", "case.toml"]) == 2
    out, err = capsys.readouterr()
    assert message in err and "OK" not in out
    head = message.partition(":")[0]
    line = next(
        k
        for k, text in enumerate(Path("case.toml").read_text().splitlines(), 1)
        if text.startswith("[sweep]")
    )
    assert err.startswith(f"error: case.toml: {head}")
    assert int(err.partition("(line ")[2].partition(",")[0]) >= line


def test_a_sound_sweep_is_told(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    written(folder)
    assert run(["check", "case.toml"]) == 0
    assert "OK; analyses: release (dynamics); sweep: 4 variants over L2, k" in (
        capsys.readouterr().out
    )
    assert run(["check", "case.toml", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["sweep"] == {"variants": 4, "variables": ["L2", "k"]}
    assert not Path("out").exists()


def test_a_large_grid_is_counted_only(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A design of 6·10⁶ rows and four columns would take 0.2 GB."""
    values = "".join(f"{name} = {{ from = 25, to = 26, n = 50 }}\n" for name in ("L1", "L2", "L3"))
    written(folder, section(HEAD, f"{values}k = {{ from = 1, to = 2, n = 50 }}"))
    assert run(["check", "case.toml"]) == 0
    assert "sweep: 6250000 variants over L1, L2, L3, k" in capsys.readouterr().out


@pytest.mark.filterwarnings("default")
def test_angles_that_look_like_degrees_are_told(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    written(folder, section(HEAD, '"crank.angle" = [60, 70]'))
    assert run(["check", "case.toml"]) == 0
    assert "warning: variables.crank.angle: 60, 70 look like degrees" in capsys.readouterr().err
