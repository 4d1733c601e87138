"""The figure of the page on sweeps is the one that its command draws today."""

import matplotlib as mpl
import pytest
from docs.pages import links
from PIL import Image
from plot.test_pictures import pinned, unlike
from sizes import only_full

from tools import sweep_figures


@only_full  # its sweep takes a minute and a half
def test_the_figure_of_the_page_is_up_to_date() -> None:
    shown = links(sweep_figures.PAGE.read_text("utf-8"))
    assert f"images/sweeps/{sweep_figures.TARGET.name}" in shown
    if mpl.__version__ != pinned():
        pytest.skip(f"figures are made with Matplotlib {pinned()}, this is {mpl.__version__}")
    with Image.open(sweep_figures.TARGET) as kept:
        told = unlike(sweep_figures.picture().convert("L"), kept.convert("L"))
    assert not told, f"{sweep_figures.TARGET.name} {told}; run tools/sweep_figures.py"
