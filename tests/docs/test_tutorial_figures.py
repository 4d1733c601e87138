"""The figures of the tutorials are those that their pages draw today."""

from pathlib import Path

import matplotlib as mpl
from docs.pages import links
from PIL import Image
from plot.test_pictures import pinned, unlike

from tools import tutorial_figures


def check_figures(name: str, folder: Path) -> None:
    """Compare the figures of a tutorial with those that its page has written to a folder."""
    page = (tutorial_figures.PAGES / f"{name}.md").read_text("utf-8")
    drawn = tutorial_figures.written(folder)
    assert {f"../images/tutorials/{file}" for file in drawn} == {
        link for link in links(page) if link.startswith("../images/tutorials/")
    }
    if mpl.__version__ != pinned():
        return
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
