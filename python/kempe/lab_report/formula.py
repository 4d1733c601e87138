"""Formulas as MathML, which browsers typeset without a script."""

from __future__ import annotations

import html
import re
from collections.abc import Iterator

from kempe.lab_report.blocks import Formula
from kempe.results.matrices.writing import replace_names

#: Formulas with more signs than this do not fit on a page.
LONGEST = 420
_FUNCTIONS = re.compile(r"(<mi>(?:sin|cos|tan|sinh|cosh|tanh|exp|ln|max|min)</mi>)")
#: Openings and closings of groups in LaTeX, within which a line does not break.
_GROUPS = re.compile(r"\\left|\\right|\\begin|\\end|[{}]")
#: Characters without a meaning, which stand for the names of a formula while it is converted.
_FIRST, _LAST = 0xE000, 0xF8FF
_PLACES = re.compile(f"[{chr(_FIRST)}-{chr(_LAST)}]")


def formula(latex: str, number: str = "") -> Formula:
    """A formula in LaTeX; lines may break before its terms.

    Names are text: they are taken out before the conversion, and put back with escapes for HTML.

    Args:
        latex: the formula.
        number: its number in the literature, such as "6.3.18".
    """
    names: list[str] = []

    def place(name: str) -> str:
        names.append(html.escape(name))
        return f"\\text{{{chr(_FIRST + len(names) - 1)}}}"

    def name(found: re.Match[str]) -> str:
        return names[ord(found[0]) - _FIRST]

    plain = replace_names(latex, place)
    return Formula(tuple(_PLACES.sub(name, _mathml(term)) for term in terms(plain)), number)


def is_readable(latex: str) -> bool:
    """Whether a formula is short enough to be read, and has no branches."""
    if "\\begin{cases}" in latex:
        return False
    return len(re.sub(r"\\[A-Za-z]+|[{}\\\s]", "", latex)) <= LONGEST


def terms(latex: str) -> Iterator[str]:
    """The terms of a sum, each with its sign; one term for anything else."""
    depth, begin, at = 0, 0, 0
    while at < len(latex):
        group = _GROUPS.match(latex, at)
        if group:
            depth += 1 if group[0] in ("\\left", "\\begin", "{") else -1
            at = group.end()
            continue
        if depth == 0 and at > begin and latex.startswith((" + ", " - "), at):
            yield latex[begin:at]
            begin = at + 1
            at += 2
        at += 1
    yield latex[begin:]


def _mathml(latex: str) -> str:
    from latex2mathml.converter import convert

    # an operand before the sign makes it the sign of a sum, with the space around it
    signed = f"{{}} {latex}" if latex.startswith(("+ ", "- ")) else latex
    return _FUNCTIONS.sub(r'\1<mspace width="0.17em"></mspace>', convert(signed))
