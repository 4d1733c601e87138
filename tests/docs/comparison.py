"""Comparison of the output of a program with the output that a page shows.

Runs of blanks are equivalent. `…` within a line matches any text, and a line with `…` alone
matches any lines. Integers must be equal. Other numbers may differ by one unit of the last digit
shown. After `≈`, a number may differ by 2 %, because numbers of steps depend on rounding.
"""

import re

#: Largest relative difference. A number with few digits must also be right in its last digit.
TOLERANCE = 1e-3
#: Relative tolerance of a number after `≈`.
ABOUT = 2e-2

_TOKEN = re.compile(
    r"(?P<lines>^ *… *\n)|(?P<any>…)|(?P<number>(?<![\w.])[-+]?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?)"
    r"|(?P<blank> +)|(?P<end>\n)|(?P<other>.)",
    re.MULTILINE,
)
_NUMBER = r"([-+]?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?)(?!\d)"
_PATTERN = {"lines": r"(?:.*\n)*?", "any": ".*?", "blank": " +", "end": "\n", "number": _NUMBER}


def pattern(shown: str) -> tuple[re.Pattern[str], list[tuple[float, float]]]:
    """A pattern for the text shown, and its numbers, each with its absolute tolerance."""
    tokens = [(m.lastgroup or "", m[0]) for m in _TOKEN.finditer(shown)]
    parts = [_PATTERN.get(kind, re.escape(text)) for kind, text in tokens]
    numbers = [
        (float(text), ABOUT * abs(float(text)) if before == "≈" else tolerance(text))
        for (_, before), (kind, text) in zip([("", ""), *tokens], tokens, strict=False)
        if kind == "number"
    ]
    return re.compile("".join(parts)), numbers


def tolerance(number: str) -> float:
    """One unit of the last digit of a number, but at most ``TOLERANCE``; 0 for an integer."""
    digits, _, exponent = number.lower().partition("e")
    _, point, decimals = digits.partition(".")
    if not point and not exponent:
        return 0.0
    unit = 10.0 ** (int(exponent or 0) - len(decimals))
    return min(1.000001 * unit, TOLERANCE * abs(float(number)))


def agrees(shown: str, output: str) -> bool:
    """Whether the output of a program agrees with the output shown on a page."""
    expression, numbers = pattern(_trimmed(shown))
    match = expression.fullmatch(_trimmed(output))
    if match is None:
        return False
    return all(
        abs(float(found) - number) <= allowed
        for found, (number, allowed) in zip(match.groups(), numbers, strict=True)
    )


def _trimmed(text: str) -> str:
    lines = [line.rstrip() for line in text.strip("\n").splitlines()]
    return "".join(f"{line}\n" for line in lines)
