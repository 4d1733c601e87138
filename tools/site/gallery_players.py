"""The players of the gallery, which share one script and one style sheet on the site.

A player is one file with its script and its style. On the site, a browser loads these once for all
players, and the site is smaller by some megabytes.
"""

from __future__ import annotations

import atexit
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).parents[2]
PROGRAM = ROOT / "tools" / "gallery.py"
STYLE, SCRIPT = "player.css", "player.js"
_STYLE = re.compile(r"<style>(.*?)</style>", re.S)
_SCRIPT = re.compile(r'<script type="module">(.*?)</script>', re.S)
#: The policy of a player allows its own script and style only, by their checksums.
_POLICY = re.compile(r'<meta http-equiv="Content-Security-Policy"[^>]*>\n?')


def players() -> dict[str, Path]:
    """The files of all players, by their places on the site."""
    if not PROGRAM.is_file():
        return {}
    folder = Path(tempfile.mkdtemp(prefix="kempe-players-"))
    atexit.register(shutil.rmtree, folder)
    paths = [str(ROOT / "python"), os.environ.get("PYTHONPATH", "")]
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(filter(None, paths))}
    subprocess.run([sys.executable, PROGRAM, "--players", folder], env=environment, check=True)
    for path in folder.glob("*.html"):
        _share(path)
    return {f"gallery/players/{path.name}": path for path in folder.iterdir()}


def _share(path: Path) -> None:
    """Move script and style of a player to the files that all players share."""
    text = path.read_text("utf-8")
    style, script = _STYLE.search(text), _SCRIPT.search(text)
    assert style and script, f"{path.name} is not a player"
    path.with_name(STYLE).write_text(style[1], "utf-8")
    # a module cannot be loaded from a file; a function has the scope and the strictness of one
    path.with_name(SCRIPT).write_text(f'(() => {{\n"use strict";\n{script[1]}}})();\n', "utf-8")
    text = text.replace(style[0], f'<link rel="stylesheet" href="{STYLE}">')
    text = text.replace(script[0], f'<script defer src="{SCRIPT}"></script>')
    path.write_text(_POLICY.sub("", text), "utf-8")
