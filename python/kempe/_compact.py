"""``docs/llms.txt`` and ``docs/llms-full.txt``: kempe on one page, for language models.

The first file lists the pages, as https://llmstxt.org proposes. The second one contains an example,
all fields of case files, and all public names of Python with their arguments. Both follow from the
catalogue of the core, the signatures and the pages; ``python -m kempe._generate`` writes them.
"""

from __future__ import annotations

import dataclasses
import inspect
import json
import re
from collections.abc import Iterator
from functools import cached_property
from pathlib import Path
from types import ModuleType
from typing import Any

import kempe as kp
from kempe import _reference
from kempe.analyses import options
from kempe.base.deprecation import former_since

#: Classes whose objects users make, as they make options and analyses.
MADE = (
    "Case",
    "Data",
    "Event",
    "Function",
    "Model",
    "Path",
    "Sampled",
    "Start",
    "State",
    "Stepper",
)
PROPERTIES = (property, cached_property)
DOCS = _reference.TARGET.parent
INDEX = DOCS / "llms.txt"
TARGET = DOCS / "llms-full.txt"
#: The example that the page shows.
EXAMPLE = DOCS.parent / "examples" / "pendulum.toml"

SUMMARY = """\
kempe simulates planar mechanisms: linkages, cams, gears, belts, springs, motors, friction, stops
and contacts. A mechanism is a case file (TOML or JSON) that `kempe run` computes, or a model in
Python (`import kempe as kp`)."""

RULES = """\
* Units are SI and angles are in rad. A string is a formula, or a number with a unit: "2*L",
  "250 mm", "30 deg". Within a formula, write `30*deg`. x is to the right, y up, angles are
  counter-clockwise.
* A point is `body.point`; the body `ground` does not move. A joint or force acts between body i and
  body j; `fx`, `fy`, `force` and `torque` of it act on body j.
* A `bar` has its mass centre in the middle and its ends at (-length/2, 0) and (length/2, 0). A
  `body` has mass, inertia about its mass centre, and named points in its own frame.
* Gravity is (0, 0) unless it is given. Nothing is assumed about masses.
* A start needs no complete guess. `set` prescribes quantities, `guess` selects an assembly.
* Quantities are `crank.angle`, `crank.omega`, `crank.B.x`, `joint.fx`, `slide.displacement`,
  `driver.effort`, `spring.length`. `sol["crank.angle"]` is an array over the times `sol.t`.
* What cannot be computed is refused with a `kp.KempeError`, whose message names the place and a
  remedy. Redundant joints are refused unless `redundancy = "allow"`.
* `kempe check FILE` finds faults without a run. `--json` prints results and errors as JSON.
"""


def index(_: str) -> str:
    """The text of ``llms.txt``: the pages with the questions that they answer."""
    parts = [f"# kempe\n\n> {' '.join(SUMMARY.split())}\n\n"]
    parts.append("The whole of it in one file: [llms-full.txt](llms-full.txt)\n")
    for line in (DOCS / "README.md").read_text("utf-8").splitlines():
        section = re.fullmatch(r"\*\*(.+)\*\*", line)
        page = re.fullmatch(r"\| \[(.+?)\]\((.+?)\) \| (.+) \|", line)
        if section:
            parts.append(f"\n## {section[1]}\n\n")
        elif page:
            parts.append(f"- [{title(DOCS / page[2])}]({page[2]}): {page[3]}\n")
    return "".join(parts)


def title(page: Path) -> str:
    """The first heading of a page."""
    found = re.search(r"^# (.+)$", page.read_text("utf-8"), re.M)
    assert found, f"{page} has no heading"
    return found[1]


def page(catalogue: str) -> str:
    """The text of ``llms-full.txt`` for a catalogue (JSON, as ``_core.catalogue()`` gives it)."""
    told = json.loads(catalogue)
    example = EXAMPLE.read_text("utf-8").strip()
    return "\n".join(
        [
            f"# kempe {kp.__version__}\n\n{SUMMARY}\n\n## Rules\n\n{RULES}",
            f"## A case file\n\n```toml\n{example}\n```\n\n`kempe run FILE` computes it.\n",
            f"## The same in Python\n\n```python\n{indented(inspect.getdoc(kp) or '')}```\n",
            "## Fields of case files\n\nA field without `=` is required; `?` means absent.\n",
            *fields(told),
            "\n## Formulas\n",
            ", ".join(f"{f['name']}({', '.join(f['arguments'])})" for f in told["functions"]),
            f"\nUnits: {' '.join(u['name'] for u in told['units'])}\n",
            "## Commands\n",
            *commands(),
            "\n## Names of Python\n",
            *names(),
            "",
        ]
    )


def indented(text: str) -> str:
    """The indented example in a docstring."""
    found = re.search(r"::\n\n((?: {4}.*\n|\n)+)", text)
    assert found, "the docstring of kempe has no example"
    return inspect.cleandoc(found[1]) + "\n"


def fields(told: dict[str, Any]) -> Iterator[str]:
    """A line for each type, with its fields, their kinds of values, units and defaults."""
    for section, (heading, _) in _reference.SECTIONS.items():
        yield f"### {heading}\n"
        for table in told[section]:
            shown = [field(one) for one in table["fields"]]
            yield f"* `{table['name']}`: {first_sentence(table['doc'])} {', '.join(shown)}"
        yield ""


def field(declared: dict[str, Any]) -> str:
    """A field with its kind of value, its unit and its default."""
    shape = declared["shape"]
    words = shape["words"] if isinstance(shape, dict) and "words" in shape else []
    kind = "|".join(words) or (shape if isinstance(shape, str) else shape["options"])
    unit = f" {declared['unit']}" if declared["unit"] else ""
    given = "" if declared["required"] else f" = {_reference.default(declared).strip('`')}"
    return f"{declared['name']} ({kind}{unit}){given.replace('–', '?')}"


def first_sentence(text: str) -> str:
    """The first sentence of a description."""
    whole = " ".join(text.split())
    end = re.search(r"\.(?= [A-Z])|\.$", whole)
    return whole[: end.end()] if end else f"{whole}."


def commands() -> Iterator[str]:
    """The commands of the command line with their first lines."""
    import typer

    from kempe.cli.app import app

    of_run = ""
    for name, command in typer.main.get_command(app).commands.items():  # type: ignore[attr-defined]
        files = [one.name.upper() for one in command.params if one.param_type_name == "argument"]
        given = " ".join(one.opts[0] for one in command.params if one.opts[0].startswith("--"))
        shown = "Options as for `run`." if given == of_run else given
        of_run = of_run or given
        about = first_sentence(command.help or "")
        yield f"* `kempe {' '.join([name, *files])}`: {about} {shown}".rstrip()


def names() -> Iterator[str]:
    """The public functions and classes of Python with their arguments."""
    for name in sorted(kp.__all__, key=str.lower):
        value = getattr(kp, name)
        if isinstance(value, ModuleType):
            for inner in getattr(value, "__all__", ()):
                yield from entry(f"kp.{name}.{inner}", getattr(value, inner))
        elif callable(value):
            yield from entry(f"kp.{name}", value)


def entry(name: str, value: Any) -> Iterator[str]:
    """A public name with its arguments and the first sentence of its docstring, and its members."""
    about = first_sentence((inspect.getdoc(value) or "").partition("\n\n")[0])
    returned = inspect.isclass(value) and not is_made(value)
    yield f"* `{name if returned else call(name, value)}`: {about}"
    if not inspect.isclass(value):
        return
    found = sorted(attributes(value))
    if found:
        yield f"  * attributes: {', '.join(found)}"
    for method in methods(value):
        yield f"  * `.{method}`"


def is_made(kind: type[Any]) -> bool:
    """Whether users make objects of a class; other objects come from functions of kempe."""
    return kind.__module__ == options.__name__ or any(kind is getattr(kp, name) for name in MADE)


def own(kind: type[Any]) -> bool:
    """Whether a class is defined in kempe."""
    return kind.__module__.partition(".")[0] == "kempe"


def attributes(kind: type[Any]) -> set[str]:
    """The fields, properties and documented attributes of a class, also inherited ones."""
    found = (
        {one.name for one in dataclasses.fields(kind)} if dataclasses.is_dataclass(kind) else set()
    )
    for base in filter(own, kind.__mro__):
        text = inspect.cleandoc(vars(base).get("__doc__") or "")
        section = re.search(r"^Attributes:\n((?: .*\n|\n)*)", f"{text}\n", re.M)
        lines = re.findall(r"^ {4}((?:\w+, )*\w+):", section[1], re.M) if section else []
        found |= {name for line in lines for name in line.split(", ")}
        found |= {name for name, one in vars(base).items() if isinstance(one, PROPERTIES)}
    return {name for name in found if not name.startswith("_")}


def methods(kind: type[Any]) -> Iterator[str]:
    """The public methods of a class with their arguments, also inherited ones."""
    for name in dir(kind):
        owner = next(base for base in kind.__mro__ if name in vars(base))
        static = inspect.getattr_static(kind, name)
        method = static.__func__ if isinstance(static, classmethod | staticmethod) else static
        if not name.startswith("_") and own(owner) and callable(method):
            yield call(name, method)


def call(name: str, function: Any) -> str:
    """``name(arguments)`` with defaults and without types; ``self`` and ``cls`` are left out."""
    given = inspect.signature(function).parameters.values()
    shown = [one for one in given if one.name not in ("self", "cls")]
    parts: list[str] = []
    star = any(one.kind is one.VAR_POSITIONAL for one in shown)
    for one in shown:
        if one.kind is one.KEYWORD_ONLY and not star:
            parts, star = [*parts, "*"], True
        mark = {"VAR_POSITIONAL": "*", "VAR_KEYWORD": "**"}.get(one.kind.name, "")
        value = "" if one.default is one.empty else f"={default(one.default)}"
        parts.append(f"{mark}{one.name}{value}")
    since = former_since(function)
    return f"{name}({', '.join(parts)}){f', former since {since}' if since else ''}"


def default(value: Any) -> str:
    """A default as text, the same in each process."""
    text = value.__name__ if inspect.isroutine(value) else repr(value)
    assert " at 0x" not in text, f"a default without a stable text: {text}"
    return text
