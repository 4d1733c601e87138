"""Templates: commented cases to start from."""

from __future__ import annotations

from pathlib import Path

from kempe import files
from kempe.names import one_of

NAMES = ("four_bar", "slider_crank", "pendulum")


def template(name: str) -> str:
    """The text of a case, TOML with comments.

    Args:
        name: one of ``NAMES``.

    Raises:
        ModelError: there is no such case.
    """
    one_of("example", name, NAMES)
    return files.read_text(Path(__file__).with_name(f"{name}.toml"))
