"""The figure of ``docs/sweeps.md``, which its first command writes.

Run ``.venv/bin/python tools/sweep_figures.py``.
"""

from __future__ import annotations

import re
import shlex
import tempfile
from pathlib import Path

from kempe.cli.app import run
from PIL import Image

ROOT = Path(__file__).parents[1]
PAGE = ROOT / "docs" / "sweeps.md"
TARGET = ROOT / "docs" / "images" / "sweeps" / "map.png"
#: Width of the figure, pixels, and its colours.
WIDTH, COLOURS = 900, 256


def picture() -> Image.Image:
    """The figure that the command of the page writes today, with few colours."""
    found = re.search(r"^\$ \./kempe (sweep .*)$", PAGE.read_text("utf-8"), re.M)
    assert found is not None
    words = shlex.split(found[1].replace("examples/", f"{ROOT}/examples/"))
    with tempfile.TemporaryDirectory() as folder:
        if run([*words, "--output", folder]):
            raise RuntimeError("the command of the page failed")
        with Image.open(Path(folder) / "figures" / "00_map_C_force_max.png") as image:
            size = WIDTH, round(WIDTH * image.height / image.width)
            small = image.convert("RGB").resize(size, Image.Resampling.LANCZOS)
    return small.quantize(COLOURS)


def main() -> None:
    """Draw the figure anew."""
    TARGET.parent.mkdir(parents=True, exist_ok=True)
    picture().save(TARGET, optimize=True)


if __name__ == "__main__":
    main()
