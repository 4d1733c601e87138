"""All English texts of the studio and the player are in texts.ts and playerTexts.ts."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
STUDIO = ROOT / "studio"
ASSETS = ROOT / "python" / "kempe" / "draw" / "assets"
#: What people read in the elements of a source: attributes with words, and words between tags.
ATTRIBUTE = re.compile(r'\b(?:aria-label|title|placeholder|label|alt)="([^"]*[A-Za-z]{2}[^"]*)"')
BETWEEN = re.compile(r"<[a-z][^<>]*>([^<>{}]*[A-Za-z]{2}[^<>{}]*)</")
COMPONENTS = sorted((STUDIO / "src").rglob("*.tsx"))


def words(path: Path) -> list[str]:
    source = path.read_text(encoding="utf-8")
    found = [*ATTRIBUTE.findall(source), *BETWEEN.findall(source)]
    return [one for one in found if "{{words." not in one and one != "null"]


@pytest.mark.parametrize("path", COMPONENTS, ids=lambda path: path.name)
def test_a_component_has_no_texts_of_its_own(path: Path) -> None:
    assert words(path) == []


def test_a_page_has_no_texts_of_its_own() -> None:
    assert len(COMPONENTS) > 20
    for name in ("index.html", "player.html"):
        assert words(STUDIO / name) == []
    made = words(ASSETS / "player.html")
    assert "Save the drawing as PNG" in made and "one frame; ten with shift" in made


def test_errors_have_texts_of_the_file() -> None:
    for path in (STUDIO / "src").rglob("*.ts"):
        assert not re.search(r'Error\(["`]', path.read_text(encoding="utf-8")), path


def test_the_player_has_only_its_own_part_of_the_texts() -> None:
    texts = (STUDIO / "src" / "texts.ts").read_text(encoding="utf-8")
    script = (ASSETS / "player.js").read_text(encoding="utf-8")
    assert "Plot over time" in script
    for other in ("Assembly modes", "Link, QR code, course page, paper", "needs JavaScript"):
        assert other in texts
        assert other not in script
