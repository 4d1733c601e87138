"""Printing of a page as PDF by a browser."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from kempe.base import files
from kempe.errors import FileError

#: The variable that names the browser, and the names of browsers that print without a window.
VARIABLE = "CHROMIUM"
_NAMES = (
    "chromium",
    "chromium-browser",
    "google-chrome",
    "google-chrome-stable",
    "chrome",
    "msedge",
    "microsoft-edge",
)
_PLACES = {
    "darwin": (
        "/Applications/Google Chrome.app/Contents/MacOS/Google Chrome",
        "/Applications/Chromium.app/Contents/MacOS/Chromium",
        "/Applications/Microsoft Edge.app/Contents/MacOS/Microsoft Edge",
    ),
    "win32": (
        r"C:\Program Files\Google\Chrome\Application\chrome.exe",
        r"C:\Program Files (x86)\Microsoft\Edge\Application\msedge.exe",
    ),
}
_REMEDY = (
    "install Chromium, Chrome or Edge (Debian, Ubuntu: apt install chromium), or set "
    f"${VARIABLE} to one; or write the report as .html and print it from any browser"
)
_FLAGS = (
    "--headless=new",
    "--disable-gpu",
    "--disable-quic",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--no-first-run",
    "--no-pdf-header-footer",
)
#: Longest time that printing may take, s.
_LONGEST = 120.0


def find_browser() -> str:
    """The browser that ``$CHROMIUM`` names, or a browser of the system.

    Raises:
        FileError: there is no browser.
    """
    named = os.environ.get(VARIABLE)
    if named:
        found = shutil.which(named)
        if found is None:
            told = f"${VARIABLE} names {named}, which is not a program"
            raise FileError(f"a PDF needs a browser, and {told}", name=named, hint=_REMEDY)
        return found
    places = (place for place in _PLACES.get(sys.platform, ()) if Path(place).is_file())
    known = next((path for path in map(shutil.which, _NAMES) if path), None) or next(places, None)
    if known is None:
        raise FileError("a PDF needs a browser, which was not found", hint=_REMEDY)
    return known


def print_pdf(page: str, path: Path) -> None:
    """Print a page to a file, whole or not at all.

    Raises:
        FileError: there is no browser, it fails, or the file cannot be written.
    """
    browser = find_browser()
    with files.writing(path) as file, tempfile.TemporaryDirectory(prefix="kempe") as folder:
        source, printed = Path(folder) / "report.html", Path(folder) / "report.pdf"
        source.write_text(page, encoding="utf-8")
        command = [
            browser,
            *_FLAGS,
            *_for_root(),
            f"--user-data-dir={folder}/profile",
            f"--print-to-pdf={printed}",
            source.as_uri(),
        ]
        try:
            done = subprocess.run(command, capture_output=True, timeout=_LONGEST, check=False)
        except (OSError, subprocess.TimeoutExpired) as error:
            raise _failed(path, browser, str(error)) from error
        if done.returncode or not printed.is_file():
            words = done.stderr.decode("utf-8", errors="replace").strip().splitlines()
            raise _failed(path, browser, words[-1] if words else "without a message")
        file.write(printed.read_bytes())


def _for_root() -> tuple[str, ...]:
    """The sandbox of Chromium does not work for root, as in containers."""
    is_root = hasattr(os, "geteuid") and os.geteuid() == 0
    return ("--no-sandbox",) if is_root else ()


def _failed(path: Path, browser: str, why: str) -> FileError:
    return FileError(f"cannot write {path}: {browser} failed: {why}", name=str(path), hint=_REMEDY)
