"""The page of the studio with a case in it.

``tools/build_studio.sh`` builds the page from ``studio/`` and ``bindings/web/``. It is one file
without requests.
"""

from __future__ import annotations

import json
from pathlib import Path

from kempe.errors import FileError
from kempe.files import write_text

#: The built page.
PAGE = Path(__file__).with_name("built") / "page.html"
#: The place in the page for the text of a case.
_SLOT = '<script type="application/json" id="case">null</script>'


def page(text: str | None = None) -> str:
    """The page, which opens a case.

    Args:
        text: the text of the case as TOML; without one, the page opens the four-bar linkage.

    Raises:
        FileError: the page was not built, or cannot be read.
    """
    try:
        built = PAGE.read_text(encoding="utf-8")
    except FileNotFoundError:
        raise FileError(
            "the studio is not built",
            hint="run tools/build_studio.sh in the repository",
        ) from None
    except OSError as error:
        raise FileError(f"{PAGE}: {error.strerror or error}") from error
    if text is None:
        return built
    # "<" could end the script element
    data = json.dumps(text).replace("<", "\\u003c")
    return built.replace(_SLOT, _SLOT.replace("null", data), 1)


def export(folder: Path, text: str | None = None) -> Path:
    """Write the page to ``folder/index.html``, for any static host or a disk.

    Args:
        folder: it is made if it does not exist.
        text: the text of the case that the page opens.

    Returns:
        The path of the file.

    Raises:
        FileError: the page was not built, or the file cannot be written.
    """
    built = page(text)
    target = folder / "index.html"
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise FileError(f"{folder}: {error.strerror or error}") from error
    write_text(target, built)
    return target
