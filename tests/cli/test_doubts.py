"""Doubts about valid cases, and numbers that are zero or have no meaning."""

import json
from pathlib import Path

import pytest
from command_line import kempe
from house.places import ROOT

FOUR_BAR = (ROOT / "examples" / "four_bar.toml").read_text("utf-8")


@pytest.mark.parametrize("field", ["stiffness", "damping"])
@pytest.mark.parametrize("value", ["-1e-3", "-k", "-1e3"])
def test_a_negative_constant_is_a_warning(field: str, value: str, tmp_path: Path) -> None:
    old = {"stiffness": '"k"', "damping": '"c"'}[field]
    text = FOUR_BAR.replace(f"{field} = {old}", f'{field} = "{value}"')
    (tmp_path / "case.toml").write_text(text)
    ran = kempe("check", "case.toml", cwd=tmp_path)
    assert ran.returncode == 0 or field == "damping"
    assert f"warning: forces.spring.{field} is negative" in ran.stdout
    (tmp_path / "case.toml").write_text(FOUR_BAR)
    plain = kempe("check", "case.toml", cwd=tmp_path).stdout
    assert "negative" not in plain and "no gravity" not in plain


def test_a_case_without_gravity_says_so(tmp_path: Path) -> None:
    (tmp_path / "case.toml").write_text(FOUR_BAR.replace("gravity = [0, -9.81]", ""))
    assert "no gravity: nothing falls" in kempe("check", "case.toml", cwd=tmp_path).stdout


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
