"""Names say what a thing is: no drawers for odds and ends, nobody who manages."""

import re

from house.places import ROOT, sources

EMPTY_WORDS = {"util", "utils", "helper", "helpers", "common", "misc", "stuff", "tools"}
GRAND_NAMES = re.compile(r"\b(?:struct|enum|trait|class)\s+\w*(?:Manager|System|Context|Engine)\b")


def test_no_file_or_folder_has_an_empty_name() -> None:
    names = [path.relative_to(ROOT) for path in sources(".rs", ".py")]
    inside = {path for path in names if path.parts[0] != "tools"}
    assert not [
        path for path in inside if EMPTY_WORDS & {part.partition(".")[0] for part in path.parts}
    ]


def test_no_type_has_a_grand_name() -> None:
    text = {path: path.read_text(encoding="utf-8") for path in sources(".rs", ".py")}
    assert not [path for path, code in text.items() if GRAND_NAMES.search(code)]


def test_a_grand_name_is_seen() -> None:
    assert GRAND_NAMES.search("pub struct " + "SolverManager;")
    assert not GRAND_NAMES.search("pub struct Systematic;")
