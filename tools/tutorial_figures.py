"""The figures of the tutorials, which their pages draw themselves.

Run ``.venv/bin/python tools/tutorial_figures.py``; it executes ``docs/tutorials/NAME.md`` and
copies the pictures that the page writes to ``docs/images/tutorials/``. Names on the command line
choose some tutorials.
"""

from __future__ import annotations

import contextlib
import io
import os
import re
import shutil
import sys
import tempfile
from pathlib import Path
from typing import Any

import matplotlib as mpl
from PIL import Image

ROOT = Path(__file__).parents[1]
PAGES = ROOT / "docs" / "tutorials"
FOLDER = ROOT / "docs" / "images" / "tutorials"
#: A file that the page shows, after its name.
_FILE = r"Write this as `([\w.]+)`:\n\n```toml\n(.*?)^```"
#: Colours of a figure.
COLOURS = 64


def tutorials() -> list[str]:
    """The names of the tutorials that write pictures."""
    return sorted(page.stem for page in PAGES.glob("*.md") if '.png"' in page.read_text("utf-8"))


def pictures(name: str) -> dict[str, Image.Image]:
    """The pictures that a tutorial writes, with few colours, by file name."""
    text = (PAGES / f"{name}.md").read_text("utf-8")
    names: dict[str, Any] = {}
    before = Path.cwd()
    with tempfile.TemporaryDirectory() as folder:
        shutil.copytree(ROOT / "examples", Path(folder) / "examples")
        for file, content in re.findall(_FILE, text, re.S | re.M):
            Path(folder, file).write_text(content, "utf-8")
        os.chdir(folder)
        try:
            with contextlib.redirect_stdout(io.StringIO()), mpl.rc_context():
                mpl.use("agg")
                for code in re.findall(r"^```python\n(.*?)^```", text, re.S | re.M):
                    exec(compile(code, f"{name}.md", "exec"), names)
        finally:
            os.chdir(before)
        return written(Path(folder))


def written(folder: Path) -> dict[str, Image.Image]:
    """The pictures in a folder, with few colours, by file name."""
    found = {}
    for path in sorted(folder.glob("*.png")):
        with Image.open(path) as image:
            found[path.name] = image.convert("RGB").quantize(COLOURS)
    return found


def main() -> None:
    """Write the figures."""
    FOLDER.mkdir(exist_ok=True)
    for name in sys.argv[1:] or tutorials():
        for file, image in pictures(name).items():
            image.save(FOLDER / file, optimize=True)


if __name__ == "__main__":
    main()
