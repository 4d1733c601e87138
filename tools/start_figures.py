"""The pictures of ``docs/start.md``: what its runs draw, and the player that the first run writes.

Run ``.venv/bin/python tools/start_figures.py``; it executes the files and the runs of the page, and
writes ``docs/images/start/``. The picture of the player needs Chromium.
"""

from __future__ import annotations

import contextlib
import io
import os
import re
import shlex
import shutil
import tempfile
from pathlib import Path

from kempe.cli import main as kempe
from PIL import Image

ROOT = Path(__file__).parents[1]
PAGE = ROOT / "docs" / "start.md"
FOLDER = ROOT / "docs" / "images" / "start"
#: A file that the page shows, after its name.
_FILE = r"Write this as `([\w.]+)`:\n\n```toml\n(.*?)^```"
#: A run, whose figures are drawn.
_RUN = re.compile(r"^\$ \./kempe (run .*)$", re.M)
#: Picture → file that a run writes; its number depends on the other figures.
DRAWN = {
    "four_bar_drawing.png": "out/four_bar/figures/*_mechanism.png",
    "four_bar_motion.png": "out/four_bar/figures/*_motion.png",
    "swing_motion.png": "out/swing/figures/*_motion.png",
}
PLAYER = "player.png"
#: Size of the window of the player, px, and time of the picture, s.
WINDOW, TIME = {"width": 1280, "height": 760}, 0.5
COLOURS = 64


def run(folder: Path) -> None:
    """Execute the files and the runs of the page in a folder."""
    text = PAGE.read_text("utf-8")
    shutil.copytree(ROOT / "examples", folder / "examples")
    for file, content in re.findall(_FILE, text, re.S | re.M):
        (folder / file).write_text(content, "utf-8")
    before = Path.cwd()
    os.chdir(folder)
    try:
        with contextlib.redirect_stdout(io.StringIO()):
            for command in _RUN.findall(text):
                kempe(shlex.split(command))
    finally:
        os.chdir(before)


def pictures(folder: Path) -> dict[str, Image.Image]:
    """What the runs have drawn, with few colours, by file name."""
    found = {}
    for name, source in DRAWN.items():
        (path,) = folder.glob(source)
        with Image.open(path) as image:
            found[name] = image.convert("RGB").quantize(COLOURS)
    return found


def player(page: Path) -> Image.Image:
    """The player of a page in the middle of the motion."""
    from playwright.sync_api import sync_playwright

    path = (
        os.environ.get("CHROMIUM") or shutil.which("chromium") or shutil.which("chromium-browser")
    )
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=path, args=["--no-sandbox"])
        opened = browser.new_page(viewport=WINDOW)
        opened.goto(page.as_uri())
        opened.evaluate(f"kempe.seek({TIME})")
        opened.evaluate("new Promise(done => setTimeout(done, 500))")
        data = opened.screenshot()
        browser.close()
    with Image.open(io.BytesIO(data)) as image:
        return image.convert("RGB").quantize(4 * COLOURS)


def main() -> None:
    """Write the pictures."""
    FOLDER.mkdir(exist_ok=True)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        run(folder)
        drawn = pictures(folder) | {PLAYER: player(folder / "out/four_bar/animation.html")}
    for file, image in drawn.items():
        image.save(FOLDER / file, optimize=True)


if __name__ == "__main__":
    main()
