"""The figures of the tutorials are those that their pages draw today."""

import matplotlib as mpl
import pytest
from docs.pages import links
from PIL import Image
from plot.test_pictures import pinned, unlike
from sizes import FULL

from tools import tutorial_figures

#: Their runs take ten seconds and more.
LONG = ("geneva_drive", "gripper", "spring_choice")
NAMES = [name for name in tutorial_figures.tutorials() if FULL or name not in LONG]


@pytest.mark.parametrize("name", NAMES)
def test_the_figures_of_a_tutorial_are_up_to_date(name: str) -> None:
    page = (tutorial_figures.PAGES / f"{name}.md").read_text("utf-8")
    drawn = tutorial_figures.pictures(name)
    assert {f"../images/tutorials/{file}" for file in drawn} == {
        link for link in links(page) if link.startswith("../images/tutorials/")
    }
    if mpl.__version__ != pinned():
        pytest.skip(f"figures are made with Matplotlib {pinned()}, this is {mpl.__version__}")
    for file, image in drawn.items():
        path = tutorial_figures.FOLDER / file
        assert path.stat().st_size < 40_000
        with Image.open(path) as kept:
            told = unlike(image.convert("L"), kept.convert("L"))
        assert not told, f"{file} {told}; run tools/tutorial_figures.py {name}"


def test_every_figure_belongs_to_a_tutorial() -> None:
    names = tutorial_figures.tutorials()
    figures = [path.stem for path in tutorial_figures.FOLDER.iterdir()]
    of = {name: [f for f in figures if f == name or f.startswith(f"{name}_")] for name in names}
    assert all(of.values())
    assert sorted(figures) == sorted(figure for found in of.values() for figure in found)
