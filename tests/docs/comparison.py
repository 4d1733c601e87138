"""Whether a program said what a page shows.

Numbers are compared with a tolerance, runs of blanks are alike, `…` within a line stands for
any text, and a line of `…` alone for any lines. A number behind `≈` may differ more: counts of
steps depend on the last digits of everything.
"""

import re

#: Relative: pages show six digits, and the last ones depend on the platform.
TOLERANCE = 1e-3
ABOUT = 2e-2

_TOKEN = re.compile(
    r"(?P<lines>^ *… *\n)|(?P<any>…)|(?P<number>(?<![\w.])[-+]?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?)"
    r"|(?P<blank> +)|(?P<end>\n)|(?P<other>.)",
    re.MULTILINE,
)
_NUMBER = r"([-+]?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?)(?!\d)"
_PATTERN = {"lines": r"(?:.*\n)*?", "any": ".*?", "blank": " +", "end": "\n", "number": _NUMBER}


def pattern(shown: str) -> tuple[re.Pattern[str], list[tuple[float, float]]]:
    """A pattern for what is shown, and the numbers in it, each with its tolerance."""
    tokens = [(m.lastgroup or "", m[0]) for m in _TOKEN.finditer(shown)]
    parts = [_PATTERN.get(kind, re.escape(text)) for kind, text in tokens]
    numbers = [
        (float(text), ABOUT if before == "≈" else TOLERANCE)
        for (_, before), (kind, text) in zip([("", ""), *tokens], tokens, strict=False)
        if kind == "number"
    ]
    return re.compile("".join(parts)), numbers


def agrees(shown: str, said: str) -> bool:
    """Whether what was said is what is shown."""
    wanted, numbers = pattern(_trimmed(shown))
    match = wanted.fullmatch(_trimmed(said))
    if match is None:
        return False
    return all(
        abs(float(found) - number) <= tolerance * abs(number)
        for found, (number, tolerance) in zip(match.groups(), numbers, strict=True)
    )


def _trimmed(text: str) -> str:
    lines = [line.rstrip() for line in text.strip("\n").splitlines()]
    return "".join(f"{line}\n" for line in lines)
