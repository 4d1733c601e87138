"""Broken cases, made of the examples in a systematic way."""

import re
from collections.abc import Callable, Iterator
from pathlib import Path

#: A line that gives a value, and its parts.
ENTRY = re.compile(r"^(?P<key>[A-Za-z_]\w*)(?P<is>\s*=\s*)(?P<value>.+?)(?P<rest>\s*(#.*)?)$")
#: A change of a line; None leaves the line as it is, an empty list removes it.
Change = Callable[[str], list[str] | None]


def _value(new: str, wanted: str = ".") -> Change:
    """Another value for entries whose value looks like this."""

    def change(line: str) -> list[str] | None:
        found = ENTRY.match(line)
        if not found or not re.match(wanted, found["value"]):
            return None
        return [found["key"] + found["is"] + new + found["rest"]]

    return change


def _text(old: str, new: str) -> Change:
    """Another text where this one is."""

    def change(line: str) -> list[str] | None:
        after = re.sub(old, new, line, count=1)
        return [after] if after != line else None

    return change


CHANGES: dict[str, Change] = {
    "removed line": lambda line: [] if line.strip() else None,
    "line twice": lambda line: [line, line] if ENTRY.match(line) else None,
    "misspelt key": _text(r"^(\w+)(\w)(\s*=)", r"\1\2\2\3"),
    "misspelt table": _text(r"^\[(\w)(\w)", r"[\2\1"),
    "misspelt type": _text(r'(type = "\w+)\w"', r'\1"'),
    "unknown key": lambda line: [line, "colour = 3"] if line.startswith("[") else None,
    "unknown body": _text(r'((?:\bi|\bj) = ")(\w+)', r"\1no_\2"),
    "unknown point": _text(r'((?:\bi|\bj) = "\w+\.)(\w+)', r"\1no_\2"),
    "no quote": _text('"', ""),
    "no bracket": _text(r"\]", ""),
    "comma for a full stop": _text(r"(\d)\.(\d)", r"\1,\2"),
    "wrong unit": _value('"3 K"', r"[\d\"]"),
    "unit of another kind": _value('"3 kg*m^2/s"', r"[\d\"]"),
    "open formula": _value('"2*(1 + "', r"[\d\"]"),
    "unknown name": _value('"2*lenght"', r"[\d\"]"),
    "flag": _value("true"),
    "list": _value("[1, 2, 3]"),
    "table": _value("{ a = 1 }"),
    "empty text": _value('""'),
    "negative": _value("-5", r"\d"),
    "infinite": _value("inf", r"\d"),
}


def variants(folder: Path) -> Iterator[tuple[str, str]]:
    """Changed examples by name. Each change is made at another line of each example."""
    for k, path in enumerate(sorted(folder.glob("*.toml"))):
        lines = path.read_text(encoding="utf-8").splitlines()
        for n, (kind, change) in enumerate(CHANGES.items()):
            places = [at for at, line in enumerate(lines) if change(line) is not None]
            if not places:
                continue
            at = places[(7 * k + 3 * n) % len(places)]
            text = [*lines[:at], *(change(lines[at]) or []), *lines[at + 1 :]]
            yield f"{path.stem}, line {at + 1}: {kind}", "\n".join(text) + "\n"
