"""Docstrings as Markdown: an indented code block after ``::`` becomes a fenced one."""

from __future__ import annotations

import re
from typing import Any

import griffe

_BLOCK = re.compile(r"^(?P<lead>.*)::\n\n(?P<code>(?: {4,}.*\n?|\n)+)", re.M)


class Docstrings(griffe.Extension):
    """Changes the docstring of every object before it is parsed."""

    def on_object(self, *, obj: griffe.Object, **_: Any) -> None:
        """Fence the code blocks of a docstring."""
        if obj.docstring is not None:
            obj.docstring.value = fenced(obj.docstring.value)


def fenced(text: str) -> str:
    r"""A docstring whose indented code blocks are fenced as Python.

    >>> fenced("Example::\n\n    x = 1\n")
    'Example:\n\n```python\nx = 1\n```\n\n'
    """

    def block(match: re.Match[str]) -> str:
        code = "\n".join(line[4:] for line in match["code"].rstrip().splitlines())
        lead = f"{match['lead']}:\n\n" if match["lead"].strip() else ""
        return f"{lead}```python\n{code}\n```\n\n"

    return _BLOCK.sub(block, text)
