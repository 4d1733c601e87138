"""``kempe exercise``: the key of an exercise, its variants, and the grades of results."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
from rich.text import Text

from kempe.cli.arguments import AsJson, Changes, File, read_case
from kempe.cli.console import answers, figure, heading, table
from kempe.cli.failure import document

if TYPE_CHECKING:
    from rich.console import Console

    from kempe.exercise import Exercise

EXAMPLES = """Examples:

  kempe exercise crank.toml

  kempe exercise crank.toml --variants 30

  kempe exercise crank.toml --check miller.json --check weber.json
"""


def exercise(
    file: File,
    seed: Annotated[
        int | None,
        typer.Option(help="The variant; that of the file by default, 0 for the file's numbers."),
    ] = None,
    variants: Annotated[
        int, typer.Option(min=1, help="Number of variants, from the seed or from 1 on.")
    ] = 1,
    check: Annotated[
        list[Path] | None,
        typer.Option("--check", metavar="RESULT", help="A result of the studio; can be repeated."),
    ] = None,
    as_json: AsJson = False,
) -> None:
    """Print the key of an exercise: all answers with their tolerances, or grade results."""
    from kempe.exercise import Exercise

    with document(as_json) as content:
        case = read_case(file, Changes())
        console = answers(silent=as_json)
        if check:
            content["results"] = [_graded(case, path, console) for path in check]
            return
        first = (1 if variants > 1 else None) if seed is None else seed
        seeds = [first] if first is None else range(first, first + variants)
        content["variants"] = [_told(Exercise(case, one), console) for one in seeds]


def _told(one: Exercise, console: Console) -> dict[str, Any]:
    """Print the key of a variant."""
    values = ", ".join(f"{name} = {text}" for name, text in one.shown.items())
    heading(console, f"Variant {one.seed}{f': {values}' if values else ''}")
    rows = [
        [of.name, figure(of.shown), of.unit, _tolerance(of.within, of.value), figure(of.points)]
        for of in one.questions.values()
    ]
    table(console, ["question", "answer", "unit", "tolerance", "points"], rows)
    return {
        "seed": one.seed,
        "parameters": dict(one.values),
        "questions": {
            of.name: {
                "text": of.text,
                "value": of.value,
                "unit": of.unit,
                "within": of.within,
                "points": of.points,
            }
            for of in one.questions.values()
        },
    }


def _tolerance(within: float, value: float) -> str:
    return f"±{figure(100.0 * within / abs(value))} %" if value else f"±{figure(within)} SI"


def _graded(case: Any, path: Path, console: Console) -> dict[str, Any]:
    """Print the grades of a result."""
    from kempe.base import files
    from kempe.exercise import Exercise, read_result

    result = read_result(files.read_text(path))
    given = result.get("seed", 0)
    one = Exercise(case, given if isinstance(given, int) else 0)
    right = one.grade(result)
    points = sum(one.questions[name].points for name, is_right in right.items() if is_right)
    most = sum(of.points for of in one.questions.values())
    name = str(result.get("name", ""))
    heading(console, f"{path.name}: {name or 'no name'}, variant {one.seed}")
    rows = [[key, "right" if is_right else "wrong"] for key, is_right in right.items()]
    table(console, ["question", "answer"], rows)
    console.print(Text(f"{figure(points)} of {figure(most)} points"))
    return {
        "file": str(path),
        "name": name,
        "seed": one.seed,
        "right": right,
        "points": points,
        "most": most,
    }
