"""An element lives in its own file: no other source names its struct or its `type`."""

import re
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import pytest
from house.places import CORE, PACKAGE, ROOT

LIST = CORE / "elements" / "mod.rs"
GENERATED = "@generated"

#: Sources that write or read entries of a case, as users do: the spring by which a page pulls at a
#: body, the linkage that a synthesis has found, the files of MuJoCo (those of other tools are in
#: the crate exchange), and the writer of assemblies.
WRITERS = {
    PACKAGE / "asmt" / "writer.py",
    *(ROOT / "bindings" / "web" / "src" / name for name in ("live.rs", "synthesis.rs")),
    *(
        PACKAGE / "mjcf" / f"{name}.py"
        for name in ("settings", "structure", "forces", "trees", "writer")
    ),
}

#: Types whose names, or whose `type`, are also words of mechanics, allowed where they name no type.
WORDS = {
    "Contact",
    "Distance",
    "Friction",
    "GivenConstraint",
    "PointForce",
    "Stop",
    "Torque",
    "Translational",
}

#: Code examples in doc comments and docstrings.
_EXAMPLE = re.compile(
    r"(?ms)^\s*//[/!] ```.*?^\s*//[/!] ```|^(?P<in>[ ]*)```.*?^(?P=in)```|^\s*m\.\w+\(.*?$"
)


@dataclass(frozen=True)
class Element:
    """Struct, `type` in a file, and source of an element."""

    struct: str
    kind: str
    source: Path


def elements() -> list[Element]:
    """The elements in the order of the list, without those of the tests."""
    listed = LIST.read_text(encoding="utf-8")
    listed = re.sub(r"#\[cfg\(feature[^\n]*", "", listed)
    # equations of forces in a phase of a run, which no file can write
    listed = re.sub(r"\bForces \{[^}]*\}", "", listed)
    calls = re.findall(r"(?ms)^(?:constraints|forces)! \{(.*?)^\}", listed)
    groups = {"Joints", "Drivers"}
    # parts of contacts, joints and drivers, and joints with play; a file writes the whole
    groups |= {"ContactFriction", "SlipFriction", "DriveLimit", "Play", "LooseBelt"}
    names = [name for call in calls for name in re.findall(r"\w+", call) if name not in groups]
    return [element(name) for name in names]


def element(struct: str) -> Element:
    for path in (CORE / "elements").rglob("*.rs"):
        declared = re.search(rf'\b{struct}, "(\w+)" \{{', path.read_text(encoding="utf-8"))
        if declared:
            return Element(struct, declared[1], path)
    raise ValueError(f"{struct} is not declared")


def named(text: str, element: Element) -> list[str]:
    """The lines of a source that name an element; examples in comments are skipped."""
    if element.struct not in text and element.kind not in text:
        return []  # most sources
    text = _EXAMPLE.sub(lambda found: "\n" * found[0].count("\n"), text)
    return [line.strip() for line in text.splitlines() if names(line, element)]


def names(line: str, element: Element) -> bool:
    quoted = re.search(rf"""(["'`]){element.kind}\1""", line)
    if element.struct not in WORDS:
        called = re.search(rf"\.{element.kind}\(", line)
        return bool(re.search(rf"\b{element.struct}\b", line) or quoted or called)
    of_type = quoted and re.search(r"(?i)\b(?:type|kind)\b", line)
    # `Enum::Torque` and `Torque(S)` are variants; `joints::Torque`, `Torque<S>` and `Torque::…`
    # name the struct
    struct = re.search(
        rf"\b(?:joints|drivers|forces|elements|Constraint|ForceElement)::(?:\{{[^}}]*)?\b{element.struct}\b"
        rf"|(?<!::)\b{element.struct}(?:<|::|\s*\{{)",
        line,
    )
    return bool(of_type or struct)


@cache
def files() -> list[Path]:
    """The sources that may not name elements, and those of the elements."""
    folders = (CORE, ROOT / "bindings", PACKAGE)
    suffixes = (".rs", ".py", ".pyi", ".js", ".html")
    found = [path for folder in folders for path in folder.rglob("*") if path.suffix in suffixes]
    return sorted(path for path in found if not {"built", "tests"} & set(path.parts))


def others(element: Element) -> list[Path]:
    """The sources that may not name an element."""
    beside = {element.source, LIST, *WRITERS}
    return [path for path in files() if path not in beside]


ELEMENTS = elements()
TEXTS = {
    path: text
    for path in others(ELEMENTS[0]) + [each.source for each in ELEMENTS]
    if GENERATED not in (text := path.read_text(encoding="utf-8")).partition("\n")[0]
}


def test_no_other_file_names_an_element() -> None:
    found = {
        (element.kind, str(path.relative_to(ROOT))): lines
        for element in ELEMENTS
        for path in others(element)
        if path in TEXTS and (lines := named(TEXTS[path], element))
    }
    assert not found


def test_the_list_is_read() -> None:
    assert {"revolute", "coordinate_driver", "torque"} <= {each.kind for each in ELEMENTS}
    assert all(each.source.is_relative_to(CORE / "elements") for each in ELEMENTS)


@pytest.mark.parametrize(
    ("struct", "line"),
    [
        ("Revolute", "use crate::elements::joints::Revolute;"),
        ("Revolute", 'if kind == "revolute" {'),
        ("Revolute", "/// Pins such as [`Revolute`]."),
        ("Revolute", 'm.joints.revolute("A")'),
        ("CoordinateDriver", "Constraint::CoordinateDriver(driver) => driver.value,"),
        ("Torque", "use super::forces::{SpringDamper, Torque};"),
        ("Torque", "let torque = Torque::<f64>::read(source);"),
        ("Torque", 'if info.kind == "torque":'),
        ("Distance", "Constraint::Distance(rod) => rod.length,"),
        ("Distance", 'match kind { "distance" => 1, _ => 2 }'),
    ],
)
def test_a_name_is_found(struct: str, line: str) -> None:
    assert named(line, element(struct))


@pytest.mark.parametrize(
    ("struct", "text"),
    [
        ("Revolute", "/// As with every revolute joint."),
        ("Revolute", "/// ```\n/// use kempe::joints::Revolute;\n/// ```"),
        ("Torque", 'UNITS = {"torque": "N·m"}'),
        ("Translational", "/// Translational stiffness, N/m."),
        ("Torque", "/// Torque about the frame's origin, N·m."),
        ("Distance", "Fixes::Distance(length) => length,"),
    ],
)
def test_a_word_of_mechanics_is_allowed(struct: str, text: str) -> None:
    assert not named(text, element(struct))
