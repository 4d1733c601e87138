"""Words of other programs and textbooks, and the names that kempe has for them.

Messages suggest the names; ``docs/synonyms.md`` lists the same words for the search.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping, Sequence
from difflib import get_close_matches
from functools import cache
from pathlib import Path
from typing import Literal, TypeAlias

#: What a word may name.
Kind: TypeAlias = Literal["names", "arguments"]


@cache
def table(kind: Kind) -> Mapping[str, Sequence[str]]:
    """The names for each word: of elements, functions and attributes, or of arguments."""
    text = Path(__file__).with_suffix(".json").read_text(encoding="utf-8")
    found: Mapping[str, Sequence[str]] = json.loads(text)[kind]
    return found


def suggested(word: str, known: Iterable[str], kind: Kind) -> tuple[str, ...]:
    """The known names that a word may mean; empty if there is none."""
    names = [name for name in known if not name.startswith("_")]
    words = table(kind)
    meant = tuple(name for name in words.get(word, words.get(word.lower(), ())) if name in names)
    if meant:
        return meant
    plain = {name.replace("_", "").casefold(): name for name in names}
    near = get_close_matches(word.replace("_", "").casefold(), plain, n=1)
    return (plain[near[0]],) if near else ()


def question(names: tuple[str, ...]) -> str:
    """``did you mean 'stop' or 'contact'?``."""
    return f"did you mean {' or '.join(map(repr, names))}?"
