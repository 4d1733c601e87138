"""The refusals of a package: the statements that refuse, and what each says to the user.

``KEMPE_WRITE=1`` writes the texts anew. Read the difference: each text names the argument at fault,
and its remedy.
"""

import ast
import os
import re
from collections.abc import Callable, Iterator, Mapping
from difflib import unified_diff
from pathlib import Path

import kempe
import kempe as kp

SOURCES = Path(kempe.__file__).parent
#: Functions that refuse an argument, whose name is in their own arguments.
REFUSE = {"refuse", "one_of", "instance", "vector", "mapping", "checked_body"}

#: A number with so many digits is random.
DIGITS = re.compile(r"-?\d+\.\d{7,}")


def statements(of: str) -> dict[tuple[str, int], str]:
    """Statements of a file or folder that refuse: file and each line, and the whole statement."""
    found = {}
    own = SOURCES / of
    for path in [own] if own.is_file() else sorted(own.rglob("*.py")):
        text = path.read_text("utf-8")
        file = path.relative_to(SOURCES).as_posix()
        for node in ast.walk(ast.parse(text)):
            if _refuses(node):
                told = f"{file}: {' '.join((ast.get_source_segment(text, node) or '').split())}"
                found |= {(file, k): told for k in range(node.lineno, node.end_lineno + 1)}
    return found


def _refuses(node: ast.AST) -> bool:
    if isinstance(node, ast.Raise):
        return isinstance(node.exc, ast.Call)
    return isinstance(node, ast.Call) and ast.unparse(node.func) in REFUSE


def check(
    file: Path, calls: Mapping[str, Callable[[], object]], known: Mapping[tuple[str, int], str]
) -> None:
    """Compare the texts of all refused calls with a file; each known statement is among them."""
    met, lines = set(), []
    for name, text, error in texts(calls):
        met |= places(error)
        lines.append(f"{name}\n    {text}\n")
    if os.environ.get("KEMPE_WRITE"):
        file.write_text("".join(lines), "utf-8")
    before = file.read_text("utf-8").splitlines(keepends=True)
    assert not (told := "".join(unified_diff(before, "".join(lines).splitlines(True)))), told
    assert "    accepted\n" not in "".join(lines)
    refused = {told for place, told in known.items() if place in met}
    left = "\n".join(sorted(set(known.values()) - refused))
    assert not left, f"no call meets these refusals:\n{left}"


def texts(calls: Mapping[str, Callable[[], object]]) -> Iterator[tuple[str, str, Exception]]:
    """Of each call: its name, the text of its refusal, and the refusal itself."""
    for name, call in calls.items():
        try:
            call()
        except (kp.KempeError, IndexError) as error:
            place = "".join(f" [{one.path}]" for one in getattr(error, "problems", ()))
            about = f" <{error.name}>" if getattr(error, "name", None) else ""
            yield (
                name,
                f"{type(error).__name__}{place}{about}: {DIGITS.sub('#', str(error))}",
                error,
            )
        else:
            yield name, "accepted", AssertionError()


def places(error: BaseException) -> set[tuple[str, int]]:
    """The files of kempe and the lines through which an error went."""
    found, step = set(), error.__traceback__
    while step is not None:
        path = Path(step.tb_frame.f_code.co_filename)
        if path.is_relative_to(SOURCES):
            found.add((path.relative_to(SOURCES).as_posix(), step.tb_lineno))
        step = step.tb_next
    return found
