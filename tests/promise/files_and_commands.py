"""The file format and the command line as lines of text."""

import inspect
import json
from collections.abc import Iterator
from enum import Enum
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, get_args, get_type_hints

import typer
from command_line import kempe
from house.places import ROOT
from kempe import _core
from kempe.cli import exit_codes
from kempe.cli.app import app

#: Sections of a case whose entries have types, and the parts that such entries contain.
SECTIONS = ("bodies", "shapes", "tables", "joints", "drivers", "forces", "analyses")
SECTIONS += ("methods", "stabilizations")


def file_format() -> list[str]:
    """Keys of a case, and the fields of each type with their values, units and defaults."""
    catalogue, schema = json.loads(_core.catalogue()), json.loads(_core.schema())
    found = [line for section in SECTIONS for line in section_lines(section, catalogue[section])]
    found += [f"functions.{f['name']}({', '.join(f['arguments'])})" for f in catalogue["functions"]]
    found += [f"units.{u['name']} = {u['si']!r} {u['dimension']}" for u in catalogue["units"]]
    known = set(SECTIONS)
    for key, value in schema["properties"].items():
        found += [f"case.{key}"] if key in known else nested(f"case.{key}", value)
    return sorted(found)


def section_lines(section: str, tables: list[dict[str, Any]]) -> list[str]:
    """The types of one section."""
    found = []
    for table in tables:
        found.append(f"{section}.{table['name']}")
        for field in table["fields"]:
            shape = field["shape"]
            values = shape if isinstance(shape, str) else json.dumps(shape, ensure_ascii=False)
            given = "required" if field["required"] else f"default {default(field['default'])}"
            unit = f" [{field['unit']}]" if field["unit"] else ""
            found.append(f"{section}.{table['name']}.{field['name']}: {values}{unit}, {given}")
    return found


def default(value: Any) -> str:
    """The default of a field."""
    return "absent" if isinstance(value, dict) else json.dumps(value, ensure_ascii=False)


def nested(path: str, schema: dict[str, Any]) -> list[str]:
    """A key with its words, and the keys inside it, as the JSON Schema has them."""
    words = schema.get("enum", [schema["const"]] if "const" in schema else [])
    found = [f"{path} = {' or '.join(json.dumps(word) for word in words)}" if words else path]
    required = set(schema.get("required", ()))
    for key, value in schema.get("properties", {}).items():
        inner = nested(f"{path}.{key}", value)
        found += [f"{inner[0]}, required", *inner[1:]] if key in required else inner
    for key in ("additionalProperties", "items"):
        if isinstance(schema.get(key), dict):
            found += nested(f"{path}.*", schema[key])[1:]
    for one in (*schema.get("anyOf", ()), *schema.get("oneOf", ())):
        found += nested(path, one)[1:]
    return list(dict.fromkeys(found))


def command_line() -> list[str]:
    """Commands with their arguments, options and defaults, and the exit codes."""
    root: Any = typer.main.get_command(app)
    codes = {name: code for name, code in vars(exit_codes).items() if name.isupper()}
    found = [f"exit code {code}: {name}" for name, code in codes.items()]
    found += [parameter("kempe", one, []) for one in root.params]
    for name, command in root.commands.items():
        found.append(name)
        words = choices(command.callback)
        found += [parameter(name, one, words.get(one.name, [])) for one in command.params]
    return sorted([*found, *printed_keys()])


def printed_keys() -> list[str]:
    """The keys that commands print with ``--json`` for an example."""
    case = ROOT / "examples" / "pendulum.toml"
    found: set[str] = set()
    with TemporaryDirectory() as folder:
        for command, *words in (["check"], ["run", "--no-figures"], ["show"]):
            done = kempe(command, case, "--json", *words, cwd=Path(folder))
            found |= {f"{command} --json: {key}" for key in keys(json.loads(done.stdout))}
    return sorted(found)


def keys(tree: Any, path: str = "") -> Iterator[str]:
    """The paths of all values in a tree."""
    if isinstance(tree, dict):
        for key, value in tree.items():
            yield from keys(value, f"{path}.{key}" if path else key)
    elif isinstance(tree, list) and tree and isinstance(tree[0], dict):
        for value in tree:
            yield from keys(value, f"{path}[]")
    else:
        yield path


def choices(function: Any) -> dict[str, list[str]]:
    """The words that arguments of a command accept, for those that accept some words only."""
    found = {}
    for name, hint in get_type_hints(function).items():
        kinds = [one for one in (hint, *get_args(hint)) if inspect.isclass(one)]
        words = [str(word.value) for one in kinds if issubclass(one, Enum) for word in one]
        found[name] = words
    return found


def parameter(command: str, one: Any, words: list[str]) -> str:
    """An argument or option of a command."""
    option = one.param_type_name == "option"
    name = ", ".join([*one.opts, *one.secondary_opts]) if option else one.name.upper()
    shown = " or ".join(words) or ("flag" if option and one.is_flag else "value")
    times = ", repeated" if one.multiple or one.nargs != 1 else ""
    given = getattr(one.default, "value", one.default)
    rest = "required" if one.required else f"default {given!r}"
    return f"{command} {name}: {shown}{times}, {rest}"
