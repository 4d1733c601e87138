"""Every example has its page in the gallery, and pages and drawings are those of today."""

import matplotlib as mpl
import pytest
from house.places import ROOT
from PIL import Image
from plot.test_pictures import pinned, unlike
from sizes import some

from tools import gallery

NAMES = gallery.names()
#: Tests that compare examples with formulas, published results or another program.
MECHANICS = (
    *sorted((ROOT / "tests" / "truth").glob("*.py")),
    *sorted((ROOT / "core" / "tests" / "truth").glob("*.rs")),
    ROOT / "tests" / "docs" / "test_examples.py",
    ROOT / "tests" / "python" / "test_curves.py",
)


def test_every_example_has_a_page_and_every_page_an_example() -> None:
    examples = sorted(path.stem for path in (ROOT / "examples").glob("*.toml"))
    assert sorted(NAMES) == examples
    assert len(NAMES) >= 30
    assert sorted(path.stem for path in gallery.PAGES.glob("*.md")) == ["README", *examples]
    for folder in (gallery.PICTURES, gallery.PICTURES / "small"):
        assert sorted(path.stem for path in folder.glob("*.png")) == examples


def test_the_mechanics_of_every_example_are_tested() -> None:
    tests = "\n".join(path.read_text("utf-8") for path in MECHANICS)
    untested = [name for name in NAMES if f'"{name}"' not in tests and f"{name}.toml" not in tests]
    assert untested == []


def test_the_first_page_is_up_to_date() -> None:
    written = (gallery.PAGES / "README.md").read_text("utf-8")
    assert written == gallery.sheet(), "run tools/gallery.py"


@pytest.mark.parametrize("name", NAMES)
def test_a_page_is_up_to_date(name: str) -> None:
    written = (gallery.PAGES / f"{name}.md").read_text("utf-8")
    assert written == gallery.page(name), f"run tools/gallery.py {name}"
    assert 15 < len(gallery.paragraph(name).split()) < 120


@pytest.mark.parametrize("name", some(NAMES, 10))
def test_a_drawing_is_up_to_date(name: str) -> None:
    if mpl.__version__ != pinned():
        pytest.skip(f"figures are made with Matplotlib {pinned()}, this is {mpl.__version__}")
    large, small = gallery.drawings(name)
    for image, path in (
        (large, gallery.PICTURES / f"{name}.png"),
        (small, gallery.PICTURES / "small" / f"{name}.png"),
    ):
        assert path.stat().st_size < 60_000
        with Image.open(path) as kept:
            told = unlike(image.convert("L"), kept.convert("L"))
        assert not told, f"{path.name} {told}; run tools/gallery.py {name}"


def test_a_player_holds_the_example() -> None:
    made = gallery.player("hoecken")
    assert gallery.title("hoecken") in made
    assert len(made) < 400_000
