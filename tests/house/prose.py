"""The prose of a source file: comments, docstrings and messages, without the code."""

import io
import re
import tokenize
from pathlib import Path

#: Comments and strings of Rust, JavaScript and TypeScript; the other alternatives are skipped.
_RUST = re.compile(
    r"""
      (?P<text>//[^\n]*|/\*.*?\*/|\bb?r(?P<hashes>\#*)".*?"(?P=hashes)|"(?:\\.|[^"\\])*")
    | b?'(?:\\(?:u\{\w+\}|x\w\w|.)|[^'\\])'
    """,
    re.VERBOSE | re.DOTALL,
)
#: Comment marks at the beginning of a line, which may occur within a sentence.
_MARKS = re.compile(r"(?m)^[ \t]*(?://[/!]?|\#[:!]?|\*)[ \t]?")
_CODE = re.compile(r"[^\n]+")
_PYTHON_TEXTS = {
    tokenize.COMMENT,
    tokenize.STRING,
    getattr(tokenize, "FSTRING_MIDDLE", tokenize.STRING),
}


def prose(path: Path) -> str:
    """The prose of a file; every other character is a blank, so that lines keep their numbers."""
    text = path.read_text(encoding="utf-8")
    if path.suffix in (".py", ".pyi"):
        text = _python(text)
    elif path.suffix in (".rs", ".js", ".ts", ".tsx"):
        text = _kept(text, [m.span("text") for m in _RUST.finditer(text) if m["text"]])
    return _MARKS.sub(lambda mark: " " * len(mark[0]), text)


def _python(text: str) -> str:
    starts = [0]
    for line in text.splitlines(keepends=True):
        starts.append(starts[-1] + len(line))
    spans = [
        (starts[token.start[0] - 1] + token.start[1], starts[token.end[0] - 1] + token.end[1])
        for token in tokenize.generate_tokens(io.StringIO(text).readline)
        if token.type in _PYTHON_TEXTS
    ]
    return _kept(text, spans)


def _kept(text: str, spans: list[tuple[int, int]]) -> str:
    """The text with everything outside the spans replaced by blanks."""
    parts, last = [], 0
    for begin, end in spans:
        parts += [_blank(text[last:begin]), text[begin:end]]
        last = end
    return "".join([*parts, _blank(text[last:])])


def _blank(code: str) -> str:
    return _CODE.sub(lambda line: " " * len(line[0]), code)
