"""A type of the core has a name of its own: the same name in another file is another concept."""

import re
from collections import defaultdict

from house.places import ROOT
from house.rust_source import code_only

#: Names of several types: one of each analysis, or of modules that do not use each other.
KNOWN = {
    # one for each analysis
    "Failure", "Outcome", "Reason",
    # private parsers and printers, and their trees
    "Binding", "Node", "Reader",
    # the model over lanes, with and without vector registers
    "Wide",
    # terms of mechanics or of files, and the same words in numerics or in printed equations
    "At", "Block", "Bodies", "Entry", "Field", "Form", "Function", "Group", "Motion",
    "Pair", "Part", "Place", "Record", "Source", "Start", "Stepper", "Symbol", "Table", "Terms",
    "Variable", "Words",
}  # fmt: skip


def type_names(text: str) -> list[str]:
    """Names of the structs, enums and traits of a file, without those of unit tests."""
    code = code_only(text).partition("#[cfg(test)]\nmod ")[0]
    return re.findall(r"(?m)^\s*(?:pub(?:\([^)]*\))?\s+)?(?:struct|enum|trait)\s+([A-Z]\w*)", code)


def test_a_type_has_a_name_of_its_own() -> None:
    places = defaultdict(list)
    for path in (ROOT / "core" / "src").rglob("*.rs"):
        for name in type_names(path.read_text(encoding="utf-8")):
            places[name].append(str(path.relative_to(ROOT)))
    twice = {name: own for name, own in places.items() if len(own) > 1}
    assert not {name: own for name, own in twice.items() if name not in KNOWN}
    assert set(twice) >= KNOWN, "an exception that is not needed any more"


def test_a_name_is_found() -> None:
    text = 'pub(super) struct A;\nenum B { C }\n// struct D\n"struct E";\ntrait F {}\n'
    tests = "#[cfg(test)]\nmod tests { struct G; }\n"
    assert type_names(text + tests) == ["A", "B", "F"]
