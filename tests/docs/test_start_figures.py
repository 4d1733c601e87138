"""The pictures of the start page are those that its runs draw today."""

from pathlib import Path

import matplotlib as mpl
import pytest
from docs.pages import links
from PIL import Image
from plot.test_pictures import pinned, unlike

from tools import start_figures


def test_the_pictures_of_the_start_page_are_up_to_date(tmp_path: Path) -> None:
    shown = {link for link in links(start_figures.PAGE.read_text("utf-8")) if "images/" in link}
    assert shown == {
        f"images/start/{name}" for name in (*start_figures.DRAWN, start_figures.PLAYER)
    }
    if mpl.__version__ != pinned():
        pytest.skip(f"figures are made with Matplotlib {pinned()}, this is {mpl.__version__}")
    start_figures.run(tmp_path)
    for name, image in start_figures.pictures(tmp_path).items():
        with Image.open(start_figures.FOLDER / name) as kept:
            told = unlike(image.convert("L"), kept.convert("L"))
        assert not told, f"{name} {told}; run tools/start_figures.py"
