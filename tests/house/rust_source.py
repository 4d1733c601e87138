"""A small parser for Rust files: functions and used modules."""

import re
from dataclasses import dataclass

_NOT_CODE = re.compile(
    r"""
      //[^\n]*                                 # comment
    | /\*.*?\*/                                # block comment
    | \bb?r(?P<hashes>\#*)".*?"(?P=hashes)     # raw string
    | \bb?"(?:\\.|[^"\\])*"                    # byte string
    | "(?:\\.|[^"\\])*"                        # string
    | b?'(?:\\(?:u\{\w+\}|x\w\w|.)|[^'\\])'    # character, not a lifetime
    """,
    re.DOTALL | re.VERBOSE,
)
_PATH_START = re.compile(r"(?<![\w:$])(crate|super|self)\s*::\s*")
_GROUP_ITEM = re.compile(r"\s*((?:\w+\s*::\s*)*\w+|\*)")


@dataclass(frozen=True)
class Function:
    """A function with a body: name and number of lines from `fn` to the closing brace."""

    name: str
    lines: int


def code_only(text: str) -> str:
    """The text with blanks instead of comments, strings and characters."""
    return _NOT_CODE.sub(lambda match: re.sub(r"[^\n]", " ", match.group()), text)


def functions(text: str) -> list[Function]:
    """All functions with a body, including nested functions and those of traits."""
    code = code_only(text)
    found = []
    for match in re.finditer(r"\bfn\s+(\w+)", code):
        start = re.compile(r"[{;]").search(_without_brackets(code, match.end()))
        if start and start.group() == "{":
            begin = match.end() + start.start()
            end = closing_brace(code, begin)
            found.append(Function(match[1], code.count("\n", match.start(), end) + 1))
    return found


def _without_brackets(code: str, begin: int) -> str:
    """The rest of the code without `[f64; N]`, whose semicolon does not end a signature."""
    head = code[begin : begin + 4000]
    return re.sub(r"\[[^\[\]{}]*\]", lambda match: " " * len(match.group()), head)


def closing_brace(code: str, begin: int) -> int:
    """Index of the brace that closes the one at ``begin``."""
    depth = 0
    for at in range(begin, len(code)):
        depth += {"{": 1, "}": -1}.get(code[at], 0)
        if depth == 0:
            return at
    raise ValueError("a brace is not closed")


def modules_named(text: str, module: tuple[str, ...]) -> set[str]:
    """First names under the crate root of all paths `crate::…`, `super::…`, `self::…` in a file.

    Args:
        text: the Rust source.
        module: path of the file's module under the crate root, such as ("math", "dual").
    """
    code = code_only(text)
    inner = _inline_modules(code)
    named = set()
    for match in _PATH_START.finditer(code):
        nested = [name for begin, end, name in inner if begin < match.start() < end]
        base, rest = _resolve((*module, *nested), match[1], match.end(), code)
        named |= {base[0]} if base else _heads(code, rest)
    return named


def _resolve(
    here: tuple[str, ...], word: str, after: int, code: str
) -> tuple[tuple[str, ...], int]:
    """The module of leading `crate`, `self` and `super`, and the index of their end."""
    if word == "crate":
        return (), after
    base = here[:-1] if word == "super" else here
    while match := re.compile(r"super\s*::\s*").match(code, after):
        base, after = base[:-1], match.end()
    return base, after


def _heads(code: str, at: int) -> set[str]:
    """First names of `a::b`, or of each item of `{a::b, c}`, at the crate root."""
    if code[at] != "{":
        match = _GROUP_ITEM.match(code, at)
        is_macro = match and code[match.end() : match.end() + 1] == "!"
        return {_head(match[1])} if match and not is_macro else set()
    group = code[at + 1 : closing_brace(code, at)]
    while "{" in group:  # only the heads matter: a::{b, c} → a
        group = re.sub(r"::\s*\{[^{}]*\}", "", group)
    return {_head(item[1]) for item in map(_GROUP_ITEM.match, group.split(",")) if item}


def _head(path: str) -> str:
    return path.split("::", maxsplit=1)[0].strip()


def _inline_modules(code: str) -> list[tuple[int, int, str]]:
    spans = []
    for match in re.finditer(r"\bmod\s+(\w+)\s*\{", code):
        spans.append((match.end() - 1, closing_brace(code, match.end() - 1), match[1]))
    return spans
