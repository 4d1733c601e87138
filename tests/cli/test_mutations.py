"""Mutations of a case file: every field of the flagship is broken in a dozen ways.

There is no panic and no hang, and every error gives line, column and key.
"""

import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import kempe as kp
import pytest
from sizes import FULL

EXAMPLE = Path(__file__).parents[2] / "examples" / "four_bar.toml"

#: Replacements of a value.
VALUES = {
    "wrong type": "true",
    "negative": "-1",
    "nan": "nan",
    "infinite": "-inf",
    "huge": "1e308",
    "too huge": "1e999",
    "empty": '""',
    "unknown": '"nosuch.thing"',
    "formula of itself": '"L1 +"',
    "list": "[1, 2, 3]",
    "table": "{ a = 1 }",
    "date": "2026-01-01",
}
WAYS = ["deleted", "renamed", "twice", *VALUES]
#: Each field is broken in every third way, beginning with another one; in all ways in full size.
PART = 1 if FULL else 3

#: Limit of the processor time of one mutant from reading to the end of the simulation, s.
PATIENCE = 5.0


@dataclass(frozen=True)
class Raw:
    """The text of a value in the file."""

    text: str


def paths(tree: Any, above: tuple[str | int, ...] = ()) -> Iterator[tuple[str | int, ...]]:
    """Every field, table and list entry."""
    entries = tree.items() if isinstance(tree, dict) else enumerate(tree)
    for key, value in entries:
        yield (*above, key)
        if isinstance(value, dict | list):
            yield from paths(value, (*above, key))


def value_text(value: Any) -> str:
    if isinstance(value, Raw):
        return value.text
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{quoted(k)} = {value_text(v)}" for k, v in value.items()) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(map(value_text, value)) + "]"
    return quoted(value) if isinstance(value, str) else repr(value)


def quoted(text: str) -> str:
    return f'"{text}"'


def toml(tree: dict[str, Any]) -> str:
    """The tree as TOML text: a section for each entry, a line for each field."""
    plain = [(k, v) for k, v in tree.items() if not isinstance(v, dict)]
    lines = [f"{key} = {value_text(value)}" for key, value in plain]
    for section, fields in ((k, v) for k, v in tree.items() if isinstance(v, dict)):
        if section in ("parameters", "start"):
            entries = {section: fields}
        else:
            entries = {f'{section}."{name}"': entry for name, entry in fields.items()}
        for head, entry in entries.items():
            if isinstance(entry, dict):
                lines.append(f"[{head}]")
                lines += [f'"{key}" = {value_text(value)}' for key, value in entry.items()]
            else:
                lines += [f"[{section}]", f"{head.rpartition('.')[2]} = {value_text(entry)}"]
    return "\n".join(lines) + "\n"


def mutant(path: tuple[str | int, ...], way: str) -> str | None:
    """The text of the flagship with one broken field; None if the mutation does not apply."""
    tree = kp.load(EXAMPLE).tree()
    holder: Any = tree
    for key in path[:-1]:
        holder = holder[key]
    last = path[-1]
    if way in VALUES:
        holder[last] = Raw(VALUES[way])
        return toml(tree)
    if isinstance(holder, list):
        if way != "deleted":
            return None
        del holder[last]
        return toml(tree)
    items = list(holder.items())
    holder.clear()
    for key, value in items:
        if key != last or way == "twice":
            holder[key] = value
        elif way == "renamed":
            holder[f"{key}x"] = value
    if way == "twice":
        text = toml(tree)
        target = next(
            (ln for ln in text.splitlines() if ln.startswith((f'"{last}" =', f"{last} ="))), ""
        )
        return text.replace(target, f"{target}\n{target}", 1) if target else None
    return toml(tree)


ALL = list(paths(kp.load(EXAMPLE).tree()))


def answered(text: str, folder: Path) -> kp.KempeError | None:
    """The result of reading, assembling and simulating some steps."""
    file = folder / "mutant.toml"
    file.write_text(text, encoding="utf-8")
    begin = time.process_time()
    try:
        case = kp.load(file)
        for name in case.analyses:
            case = case.with_analysis(name, max_steps=50, t_end=0.02)
        case.run()
    except kp.KempeError as error:
        return error
    finally:
        assert time.process_time() - begin < PATIENCE
    return None


def test_the_text_that_is_mutated_is_the_flagship(tmp_path: Path) -> None:
    assert answered(toml(kp.load(EXAMPLE).tree()), tmp_path) is None
    assert len(ALL) > 80


@pytest.mark.filterwarnings("ignore::kempe.AssemblyWarning")
@pytest.mark.filterwarnings("ignore::kempe.ModelWarning")
def test_every_mutant_runs_or_is_refused(tmp_path: Path) -> None:
    refused, placed, unplaced = 0, 0, []
    for k, path in enumerate(ALL):
        for way in WAYS[k % PART :: PART]:
            text = mutant(path, way)
            if text is None:
                continue
            error = answered(text, tmp_path)
            assert not isinstance(error, kp.InternalError), (path, way, error)
            if error is None or not isinstance(error, kp.FileError | kp.ModelError):
                continue  # valid, or an error of mechanics
            for problem in error.problems or (None,):
                refused += 1
                if problem is not None and problem.line and problem.column and key_told(problem):
                    placed += 1
                else:
                    unplaced.append((path, way, str(error)))
    assert refused > 500 / PART
    assert placed >= 0.99 * refused, (placed, refused, unplaced[:20])


def key_told(problem: kp.errors.Problem) -> bool:
    """Whether the message gives the position in the model, or the unreadable key."""
    keys = [key for key in problem.path.split(".") if key]
    return any(key in problem.message for key in keys) or problem.message.startswith("key '")


@pytest.mark.parametrize("way", ["deleted", "renamed", "nan", "unknown", "list", "table"])
def test_a_broken_mass_is_refused_at_its_position(way: str, tmp_path: Path) -> None:
    text = mutant(("bodies", "coupler", "mass"), way)
    assert text is not None
    error = answered(text, tmp_path)
    assert isinstance(error, kp.FileError | kp.ModelError)
    lines = text.splitlines()
    at = [lines[p.line - 1] for p in error.problems if p.line]
    assert any("mass" in line or "coupler" in line for line in at), str(error)
    assert "mass" in str(error)
