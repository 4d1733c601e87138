"""Doubts about valid cases, and numbers that are zero or have no meaning."""

import json
import re
from pathlib import Path

import kempe as kp
import pytest
from command_line import kempe
from house.places import ROOT

FOUR_BAR = (ROOT / "examples" / "four_bar.toml").read_text("utf-8")


@pytest.mark.parametrize("field", ["stiffness", "damping"])
@pytest.mark.parametrize("value", ["-1e-3", "-k", "-1e3"])
def test_a_negative_constant_is_a_warning(field: str, value: str, tmp_path: Path) -> None:
    old = {"stiffness": '"k"', "damping": '"c"'}[field]
    text = FOUR_BAR.replace(f"{field} = {old}", f'{field} = "{value}"')
    text = re.sub("t_end = .*", "t_end = 0.01", text)
    (tmp_path / "case.toml").write_text(text)
    commands: list[tuple[str, ...]] = [
        ("check",),
        ("run", "--no-figures"),
        ("show",),
        ("sweep", "--over", "L1=10:11:2", "--measure", "crank.omega.max"),
    ]
    for command, *options in commands:
        ran = kempe(command, "case.toml", *options, cwd=tmp_path)
        assert ran.returncode == 0 or field == "damping", ran.stderr
        told = f"warning: forces.spring.{field} is negative"
        assert ran.stderr.count(told) == 1, (command, ran.stderr)
    with pytest.warns(kp.ModelWarning, match=f"spring.{field} is negative") as warned:
        state = kp.load(tmp_path / "case.toml").start()
        kp.modes(state.model, state)
    assert len(warned) == 1
    (tmp_path / "case.toml").write_text(FOUR_BAR)
    plain = kempe("check", "case.toml", cwd=tmp_path)
    assert "negative" not in plain.stderr and "no gravity" not in plain.stdout


def test_a_case_without_gravity_says_so(tmp_path: Path) -> None:
    (tmp_path / "case.toml").write_text(FOUR_BAR.replace("gravity = [0, -9.81]", ""))
    told = "no gravity: nothing falls"
    assert told in kempe("check", "case.toml", cwd=tmp_path).stdout
    assert told in str(kp.load(tmp_path / "case.toml").start())


def test_a_driven_motion_does_not_settle(tmp_path: Path) -> None:
    for name, settles in (("wiper", False), ("pendulum", True)):
        words = ("run", ROOT / "examples" / f"{name}.toml", "--no-figures", "--json")
        told = json.loads(kempe(*words, cwd=tmp_path).stdout)
        found = (
            next(iter(told["analyses"].values()))
            if isinstance(told.get("analyses"), dict)
            else told
        )
        assert bool(json.dumps(found).count('"moves"')) is settles, name


def test_rounding_errors_are_zero_in_tables() -> None:
    from kempe.cli.findings import _rounded

    for scale in (1e-3, 1.0, 1e3):
        assert _rounded(1.5e-32 * scale, scale) == 0.0
        assert _rounded(-1e-12 * scale, scale) == -1e-12 * scale
        assert _rounded(0.0, 0.0) == 0.0
