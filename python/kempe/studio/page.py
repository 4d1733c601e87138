"""The page of the studio, and the page with a case in it.

The page is one file without requests. kempe carries one page, which ``tools/release_page.sh``
replaces before a release, so that the studio needs no Node and no WebAssembly toolchain. In a
checkout, ``tools/build_studio.sh`` builds the page of the present sources beside it.
"""

from __future__ import annotations

import gzip
import json
import re
import zlib
from dataclasses import dataclass
from pathlib import Path

from kempe.base.files import write_text
from kempe.errors import FileError

#: The page that kempe carries.
CARRIED = Path(__file__).with_name("page.html.gz")
#: The page that was built in this checkout.
BUILT = Path(__file__).with_name("built") / "page.html"
#: The place in the page for the text of a case.
_SLOT = '<script type="application/json" id="case">null</script>'
#: What the page states about itself; studio/index.html writes it.
_STATED = re.compile(r'<meta name="generator" content="kempe ([\w.+-]+)(?:, sources (\w+))?">')


@dataclass(frozen=True)
class Page:
    """A built page.

    Attributes:
        html: its text; without a case, it opens the four-bar linkage.
        version: the version of kempe.
        sources: the checksum of the sources that it was built from; "unknown" if it was built
            without ``tools/build_studio.sh``.
        changed: the time at which its file was written, s.
    """

    html: str
    version: str
    sources: str
    changed: float

    def opening(self, text: str | None) -> str:
        """The page, which opens a case.

        Args:
            text: the text of the case as TOML, or None for the page itself.
        """
        if text is None:
            return self.html
        # "<" could end the script element
        data = json.dumps(text).replace("<", "\\u003c")
        return self.html.replace(_SLOT, _SLOT.replace("null", data), 1)

    def export(self, folder: Path, text: str | None = None) -> Path:
        """Write the page to ``folder/index.html``, for any static host or a disk.

        Args:
            folder: it is made if it does not exist.
            text: the text of the case that the page opens.

        Returns:
            The path of the file.

        Raises:
            FileError: the file cannot be written.
        """
        target = folder / "index.html"
        try:
            folder.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise FileError(f"{folder}: {error.strerror or error}") from error
        write_text(target, self.opening(text))
        return target


def choose(now: str | None) -> Page:
    """The page of the given sources, or else the one that was written last.

    Args:
        now: the checksum of the present sources; None in an installed kempe.

    Raises:
        FileError: there is no page, or one cannot be read.
    """
    pages = [read(path) for path in (BUILT, CARRIED) if path.is_file()]
    if not pages:
        raise FileError(
            f"the page of the studio is missing: {CARRIED}",
            hint="install kempe again, or build the page in a checkout: kempe studio --build",
        )
    return max(pages, key=lambda page: (page.sources == now, page.changed))


def read(path: Path) -> Page:
    """The page in a file, compressed or not.

    Raises:
        FileError: the file cannot be read, or is damaged.
    """
    try:
        data = path.read_bytes()
        changed = path.stat().st_mtime
        html = (gzip.decompress(data) if path.suffix == ".gz" else data).decode("utf-8")
    except (EOFError, UnicodeDecodeError, gzip.BadGzipFile, zlib.error):
        html = ""
    except OSError as error:
        raise FileError(f"{path}: {error.strerror or error}") from error
    stated = _STATED.search(html)
    if stated is None:
        raise FileError(f"{path} is damaged", hint="install kempe again, or delete the file")
    return Page(html, stated[1], stated[2] or "unknown", changed)
