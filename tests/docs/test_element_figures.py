"""Each page of an element has its figure, which shows what the drawing code draws today."""

import io

import matplotlib as mpl
import pytest
from docs.pages import links
from house.places import ROOT
from PIL import Image
from plot.test_pictures import pinned, unlike

from tools import element_figures

NAMES = element_figures.elements()


def test_all_elements_have_figures() -> None:
    assert {path.stem for path in element_figures.FOLDER.glob("*.png")} == set(NAMES)
    assert set(element_figures.MODELS) <= set(NAMES)


@pytest.mark.parametrize("name", NAMES)
def test_a_figure_is_up_to_date(name: str) -> None:
    path = element_figures.FOLDER / f"{name}.png"
    page = ROOT / "docs" / "elements" / f"{name}.md"
    assert f"../images/elements/{name}.png" in links(page.read_text("utf-8"))
    assert path.stat().st_size < 20_000
    if mpl.__version__ != pinned():
        pytest.skip(f"figures are made with Matplotlib {pinned()}, this is {mpl.__version__}")
    drawn = io.BytesIO()
    element_figures.picture(name).save(drawn, format="png")
    with Image.open(path) as kept, Image.open(drawn) as now:
        told = unlike(now.convert("L"), kept.convert("L"))
    assert not told, f"{name}.png {told}; run tools/element_figures.py {name}"


def test_another_drawing_is_seen() -> None:
    one, other = (element_figures.picture(name).convert("L") for name in ("gear", "belt"))
    assert unlike(one, other)
