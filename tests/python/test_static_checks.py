"""``kempe check`` refuses what ``kempe run`` refuses, at the same place."""

from pathlib import Path

import kempe as kp
import pytest
from command_line import kempe
from kempe.cli import main

FOUR_BAR = (Path(__file__).parents[2] / "examples" / "four_bar.toml").read_text("utf-8")
MODEL = FOUR_BAR.split("[analyses.release]", maxsplit=1)[0]
BAUMGARTE = 'stabilization = { type = "baumgarte" }'


@pytest.mark.parametrize(
    ("fields", "path", "remedy"),
    [
        (f'method = {{ type = "radau" }}\n{BAUMGARTE}', "stabilization", ('"radau"', '"dop853"')),
        (
            f'method = {{ type = "radau" }}\n{BAUMGARTE}',
            "stabilization",
            ('"baumgarte"', '"projection"'),
        ),
        (f'method = {{ type = "radau" }}\n{BAUMGARTE}', "stabilization", ('"baumgarte"', '"none"')),
        ("output_step = 1e-9", "output_step", ("1e-9", "1e-4")),
        ('method = { type = "rk45", first_step = 3 }', "method.first_step", ("3 }", "0.2 }")),
        ('method = { type = "rk4", step = 1e-9 }', "method.step", ("1e-9", "1e-3")),
        ('method = { type = "rk4", step = 1e-3 }\nmax_steps = 9', "method.step", ("= 9", "= 1000")),
    ],
)
def test_check_and_run_refuse_it_and_the_remedy_works(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    fields: str,
    path: str,
    remedy: tuple[str, str],
) -> None:
    monkeypatch.chdir(tmp_path)
    text = f'{MODEL}[analyses.a]\ntype = "dynamics"\nt_end = 0.2\n{fields}\n'
    Path("case.toml").write_text(text, "utf-8")
    key = path.split(".", maxsplit=1)[0]
    line = 1 + next(k for k, row in enumerate(text.split("\n")) if row.startswith(key))
    told = []
    for command in ("check", "run"):
        assert main([command, "case.toml"]) == 2
        told.append(capsys.readouterr().err)
    assert told[0] == told[1]
    assert f"case.toml: analyses.a.{path}: " in told[0]
    assert f"(line {line}, column" in told[0]
    assert not Path("out").exists()
    Path("case.toml").write_text(text.replace(*remedy), "utf-8")
    assert main(["run", "case.toml", "--no-figures", "--quiet"]) == 0


def test_a_json_case_gets_advice_in_json(tmp_path: Path) -> None:
    path = tmp_path / "case.json"
    path.write_text('{"kempe": 1, "joints": {"A": {}}}', "utf-8")
    with pytest.raises(kp.FileError, match='write "type": "revolute"'):
        kp.load(path)
    path = tmp_path / "case.toml"
    path.write_text("kempe = 1\n[joints.A]\n", "utf-8")
    with pytest.raises(kp.FileError, match='write type = "revolute"'):
        kp.load(path)


def test_names_with_controls_of_direction_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "case.toml"
    path.write_text('kempe = 1\n[bodies."a\u202eb"]\nmass = 1\ninertia = 1\n', "utf-8")
    with pytest.raises(kp.FileError, match=r"must not contain U\+202E"):
        kp.load(path)
    m = kp.Model("x")
    m.body("a\u2066", mass=1, inertia=1)
    with pytest.raises(kp.ModelError, match=r"must not contain U\+2066"):
        m.compile()


@pytest.mark.parametrize("gravity", ["", "gravity = [0, -9.81]\n"])
@pytest.mark.parametrize("suffix", [".toml", ".json"])
def test_a_tree_is_that_of_the_saved_case(tmp_path: Path, gravity: str, suffix: str) -> None:
    path, again = tmp_path / "case.toml", tmp_path / f"again{suffix}"
    bar = 'a = { type = "bar", mass = 1, length = 1, ends = ["A", "B"] }'
    body = f"ground.points = {{ O = [0, 0] }}\n{bar}"
    path.write_text(f"kempe = 1\n{gravity}[bodies]\n{body}\n", "utf-8")
    case = kp.load(path)
    case.save(again)
    assert kp.load(again).tree() == case.tree()
    m = kp.Model("python", gravity=(0, -1))
    m.bar("a", mass=1, length=1, ends=("A", "B"), points={"C": (0, 1)})
    kp.Case(m).save(again)
    assert kp.load(again).tree() == kp.Case(m).tree()


@pytest.mark.parametrize("pair", ['["50 deg", "90 deg"]', '[0.9, "90 deg"]', '["50 deg", "pi/2"]'])
@pytest.mark.parametrize("kind", ["kinematics", "inverse_dynamics"])
def test_check_accepts_a_range_with_units(tmp_path: Path, kind: str, pair: str) -> None:
    text = f'{MODEL}[analyses.a]\ntype = "{kind}"\nover = "crank.angle"\nrange = {pair}\nn = 3\n'
    path = tmp_path / "case.toml"
    path.write_text(text, "utf-8")
    assert main(["check", str(path)]) == 0


#: Values of ``over`` that no analysis has, with a part of the remedy.
OVER = {
    "a rate": ('over = "crank.omega"', "name 'crank.angle'"),
    "a rate of a joint": ('over = "A.omega"', "name 'A.angle'"),
    "misspelt": ('over = "crank.angl"', "did you mean 'crank.angle'"),
    "no body": ('over = "motor"', "write the name of one"),
}


@pytest.mark.parametrize("kind", ["limits", "kinematics", "inverse_dynamics"])
@pytest.mark.parametrize("name", [*OVER, "none"])
def test_check_refuses_what_a_later_analysis_refuses(kind: str, name: str, tmp_path: Path) -> None:
    over, remedy = OVER.get(name, ("", "name a driver or a position quantity"))
    if kind != "limits" and not over:
        pytest.skip("these analyses may have a time instead")
    ranged = "" if kind == "limits" else "\nrange = [0, 1]"
    text = FOUR_BAR.replace("t_end = 15", "t_end = 0.02")
    text += f'\n[analyses.later]\ntype = "{kind}"\n{over}{ranged}\n'
    (tmp_path / "case.toml").write_text(text)
    told = [kempe(word, "case.toml", cwd=tmp_path) for word in ("run", "check")]
    assert [one.returncode for one in told] == [2, 2]
    assert told[0].stderr == told[1].stderr
    assert "analyses.later.over: " in told[1].stderr and remedy in told[1].stderr
    cured = text.replace(over, 'over = "crank.angle"') if over else text + 'over = "crank.angle"\n'
    (tmp_path / "case.toml").write_text(cured)
    assert kempe("check", "case.toml", cwd=tmp_path).returncode == 0
