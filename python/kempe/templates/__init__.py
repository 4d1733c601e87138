"""The examples of the source tree, for ``kempe new``; ``python -m kempe._generate`` copies them."""

from __future__ import annotations

from pathlib import Path

from kempe.base import files
from kempe.base.names import one_of

#: A program is stored as text, so that it is not a module of the package.
_TEXT = ".txt"


def _files() -> dict[str, str]:
    found = (path.name.removesuffix(_TEXT) for path in Path(__file__).parent.iterdir())
    return {Path(name).stem: name for name in sorted(found) if not name.startswith("__")}


#: The name of each example and the file that ``kempe new`` writes.
FILES = _files()
NAMES = tuple(FILES)


def stored(file: str) -> str:
    """The name under which the package stores a file of an example."""
    return file + _TEXT if file.endswith(".py") else file


def template(name: str) -> str:
    """The text of an example: a case (TOML with comments) or a program (Python).

    Args:
        name: one of ``NAMES``.

    Raises:
        ModelError: there is no such example.
    """
    one_of("example", name, NAMES)
    return files.read_text(Path(__file__).with_name(stored(FILES[name])))


def title(name: str) -> str:
    """The title of an example, on one line.

    Args:
        name: one of ``NAMES``.
    """
    text = template(name)
    if FILES[name].endswith(".py"):
        return text.split('"""', 2)[1].splitlines()[0].rstrip(".")
    from kempe.case import parsed

    return parsed(text, "toml", name).model.title
