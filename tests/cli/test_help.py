"""Help texts and the page of the documentation name every option and every choice."""

import re
from enum import Enum
from pathlib import Path
from typing import Any

import pytest
import typer
from kempe.cli import animate, figures, main, show
from kempe.cli.app import app
from kempe.cli.arguments import Method
from rich.text import Text

PAGE = (Path(__file__).parents[2] / "docs" / "command-line.md").read_text(encoding="utf-8")
COMMANDS: dict[str, Any] = typer.main.get_command(app).commands  # type: ignore[attr-defined]


def options(command: str) -> list[str]:
    """The long options of a command."""
    found = [name for option in COMMANDS[command].params for name in option.opts]
    return [name for name in found if name.startswith("--")]


@pytest.mark.parametrize("command", COMMANDS)
def test_short_and_long_help_are_the_same(command: str, capsys: pytest.CaptureFixture[str]) -> None:
    texts = []
    for words in ([command, "-h"], [command, "--help"]):
        assert main(words) == 0
        texts.append(capsys.readouterr().out)
    assert texts[0] == texts[1]
    assert f"kempe {command}" in texts[0]


def test_the_help_of_the_program_names_every_command(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["-h"]) == 0
    told = capsys.readouterr().out
    assert [name for name in COMMANDS if name not in told] == []


@pytest.mark.parametrize("command", COMMANDS)
def test_brackets_in_help_are_printed(command: str) -> None:
    """Rich reads [word] in a help text as markup and prints nothing, unless it is escaped."""
    told = COMMANDS[command]
    options = [getattr(option, "help", None) for option in told.params]
    for text in filter(None, [told.help, told.epilog, *options]):
        assert Text.from_markup(text).plain == text.replace("\\[", "[")


@pytest.mark.parametrize("command", COMMANDS)
def test_every_option_is_documented(command: str) -> None:
    missing = [name for name in options(command) if not re.search(rf"{name}\b", PAGE)]
    assert not missing


CHOICES: list[tuple[str, str, type[Enum]]] = [
    ("run", "--method", Method),
    ("run", "--figures", figures.Which),
    ("run", "--time-axis", figures.Axis),
    ("run", "--animate", animate.Form),
    ("plot", "--time-axis", figures.Axis),
    ("animate", "--format", animate.Form),
    ("show", "--format", show.Form),
]


@pytest.mark.parametrize(("command", "option", "kind"), CHOICES, ids=str)
def test_every_choice_is_documented_and_named_in_errors(
    command: str, option: str, kind: type[Enum], capsys: pytest.CaptureFixture[str]
) -> None:
    names = [str(one.value) for one in kind]
    assert [name for name in names if f"`{name}`" not in PAGE] == []
    assert main([command, "x.toml", option, "nonsense"]) == 2
    told = " ".join(capsys.readouterr().err.replace("│", " ").split())
    assert [name for name in names if f"'{name}'" not in told] == []
