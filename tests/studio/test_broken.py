"""The faults of broken cases are those of the command line, with the same lines and columns."""

import re
import warnings
from itertools import islice
from pathlib import Path
from typing import Any

import kempe as kp
import pytest
from kempe.errors import Problem
from studio.broken import CHANGES, variants
from studio.window import Studio

EXAMPLES = Path(__file__).parents[2] / "examples"
COUNT = 200

#: Path, message, line, column and hint.
Fault = tuple[str, str, int | None, int | None, str]
#: A fault as the command line prints it, with the line of the file between message and hint.
PRINTED = re.compile(
    r"(?:(?P<path>[^ ]+): )?(?P<message>.*) \(line (?P<line>\d+), column (?P<column>\d+)\)\n"
    r" *\d+ \| .*\n *\| *\^+(?:\nhint: (?P<hint>.*))?",
    re.DOTALL,
)


def native(text: str, path: Path) -> list[Fault]:
    """The faults that kempe reports of a file, none for a case that it reads."""
    path.write_text(text, encoding="utf-8")
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", kp.ModelWarning)  # those of negative constants
            kp.load(path)
    except kp.KempeError as error:
        last = str(error).splitlines()[-1]  # perhaps the number of further faults
        more: list[Fault] = [("", last, None, None, "")] if last.startswith("…") else []
        return [*map(parts, error.problems), *more]
    return []


def parts(problem: Problem) -> Fault:
    found = PRINTED.fullmatch(problem.message)
    assert found, problem.message
    assert (found["path"] or "") == problem.path
    assert (int(found["line"]), int(found["column"])) == (problem.line, problem.column)
    place = int(found["line"]), int(found["column"])
    return problem.path, found["message"], *place, found["hint"] or ""


def shown(problem: dict[str, Any]) -> Fault:
    """A fault as the page has it."""
    place = problem["line"], problem["column"]
    return problem["path"], problem["message"], *place, problem["hint"] or ""


@pytest.fixture(scope="module")
def broken(tmp_path_factory: pytest.TempPathFactory) -> list[tuple[str, str, list[Fault]]]:
    """Broken cases with their faults, spread over all examples and changes."""
    path = tmp_path_factory.mktemp("broken") / "case.toml"
    found = [(name, text, native(text, path)) for name, text in variants(EXAMPLES)]
    found = [one for one in found if one[2]]
    return list(islice(found, 0, None, len(found) // COUNT))[:COUNT]


def test_the_broken_cases_are_of_all_kinds(broken: list[tuple[str, str, list[Fault]]]) -> None:
    assert len(broken) == COUNT
    assert {name.split(": ")[1] for name, _, _ in broken} == set(CHANGES)
    assert len({message for _, _, faults in broken for _, message, *_ in faults}) > COUNT / 3
    assert len({line for _, _, faults in broken for _, _, line, *_ in faults}) > COUNT / 4


def test_the_page_reports_the_faults_of_python(
    one: Studio, broken: list[tuple[str, str, list[Fault]]]
) -> None:
    wrong = []
    for name, text, expected in broken:
        found = [shown(problem) for problem in one.load(text)["problems"]]
        if found != expected:
            wrong.append((name, expected, found))
    assert not wrong, (len(wrong), wrong[0])
