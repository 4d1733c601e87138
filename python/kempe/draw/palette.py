"""The colours and the texts that figures, frames and pages have in common."""

from __future__ import annotations

#: Okabe & Ito (2008), distinguishable with any colour vision, the darker ones first.
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000")
GROUND = "#444444"
#: Longest name in a drawing, in characters.
LONGEST_NAME = 24

#: The colours of the display list on white paper; the page has its own list.
_ROLES = {
    "paper": "#FFFFFF",
    "ink": "#000000",
    "ground": GROUND,
    "force": "#7A3DB8",
    "drive": "#1F2A44",
    "reaction": "#C2184B",
    "quiet": "#555555",
}


def colour(number: int) -> str:
    """Colour of the k-th moving body, from 1."""
    return COLOURS[(number - 1) % len(COLOURS)]


def rgb(role: str, tint: float = 0.0) -> tuple[float, float, float]:
    """Red, green and blue of a colour of the display list, mixed with a share of white.

    Args:
        role: such as ``ground`` or ``body 2``.
        tint: share of white.
    """
    kind, _, number = role.partition(" ")
    text = _ROLES[kind] if not number else colour(int(number)) if int(number) else GROUND
    red, green, blue = (int(text[k : k + 2], 16) / 255.0 for k in (1, 3, 5))
    return tuple(part + (1.0 - part) * tint for part in (red, green, blue))  # type: ignore[return-value]


def verbatim(text: str) -> str:
    """Text that matplotlib shows unchanged, not as mathematics."""
    return text.replace("$", r"\$")


def one_line(name: str, longest: int = LONGEST_NAME) -> str:
    """A name on one line, its middle left out if it is too long."""
    text = " ".join(name.split())
    if len(text) <= longest:
        return text
    half = (longest - 1) // 2
    return f"{text[:half]}…{text[-half:]}"
