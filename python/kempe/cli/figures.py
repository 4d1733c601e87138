"""Functions for all commands that write figures."""

from __future__ import annotations

from typing import Annotated

import typer

from kempe.errors import ModelError

IndexBase = Annotated[
    int, typer.Option("--index-base", min=0, max=1, help="Number of the first body: 1 or 0.")
]


def formats(text: str) -> list[str]:
    """``png,svg`` → ["png", "svg"], each once.

    Raises:
        ModelError: it is empty or names a format that there is not.
    """
    from kempe.names import one_of
    from kempe.plot.style import FORMATS

    words = [word.strip().lower() for word in text.split(",") if word.strip()]
    if not words:
        raise ModelError(f"--format {text}: must be some of {','.join(FORMATS)}")
    return [one_of("format", word, FORMATS) for word in dict.fromkeys(words)]
