"""Modules of the studio import each other in one direction."""

import re
from pathlib import Path

from house.places import ROOT
from house.rust_imports import loops

SOURCES = ROOT / "studio" / "src"
#: `from "./x"`, `import "./x"` and `import("./x")`, also of types.
_IMPORT = re.compile(r"""(?:\bfrom|\bimport)\s*\(?\s*"(\.[^"]+)\"""")


def imported(path: Path, text: str) -> set[Path]:
    """The modules of the studio that the text of a module imports."""
    named = {(path.parent / name).resolve() for name in _IMPORT.findall(text)}
    files = {place.with_name(place.name + end) for place in named for end in (".ts", ".tsx")}
    return {file for file in files if file.is_file()}


def graph() -> dict[str, set[str]]:
    """Each module with the modules that it imports, by their paths in the folder of sources."""
    files = [path for path in SOURCES.rglob("*.ts*") if path.name != "virtual.d.ts"]
    return {
        str(path.relative_to(SOURCES)): {
            str(other.relative_to(SOURCES)) for other in imported(path, path.read_text("utf-8"))
        }
        for path in files
    }


def test_no_modules_import_each_other_in_a_loop() -> None:
    found = graph()
    assert "panels/parts.tsx" in found["panels/Case.tsx"]
    assert loops(found) == []


def test_all_forms_of_imports_are_read() -> None:
    text = 'import type { A } from "./parts";\nexport * from "../texts";\nawait import("./Case");\n'
    found = imported(SOURCES / "panels" / "Side.tsx", text)
    assert {path.name for path in found} == {"parts.tsx", "texts.ts", "Case.tsx"}
