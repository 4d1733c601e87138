"""Texts and lines of the page can be read in light and in dark colours."""

from typing import Any

import numpy as np
from draw.mechanisms import moving

TEXTS = ("text", "soft", "accent", "reactions", "force", "velocities", "accelerations")


def test_the_colours_of_text_and_lines_can_be_read(opened: Any) -> None:
    solution = moving()
    for scheme in ("light", "dark"):
        watched = opened(solution, 1280, 720, color_scheme=scheme)

        def read(name: str, page: Any = watched.page) -> str:
            told: str = page.evaluate(
                "n => getComputedStyle(document.documentElement).getPropertyValue('--' + n).trim()",
                name,
            )
            return told

        for name in TEXTS:  # WCAG 2.2, 1.4.3
            assert contrast(read(name), read("panel")) >= 4.5, (scheme, name)
        for k in range(1, 8):  # WCAG 2.2, 1.4.11
            assert contrast(read(f"body-{k}"), read("panel")) >= 3.0, (scheme, k)


def contrast(one: str, other: str) -> float:
    """Ratio of the relative luminances of two #rrggbb colours (WCAG 2.2)."""
    bright, dark = sorted((luminance(one), luminance(other)), reverse=True)
    return (bright + 0.05) / (dark + 0.05)


def luminance(colour: str) -> float:
    parts = [int(colour[k : k + 2], 16) / 255 for k in (1, 3, 5)]
    linear = [p / 12.92 if p <= 0.04045 else ((p + 0.055) / 1.055) ** 2.4 for p in parts]
    return float(np.dot([0.2126, 0.7152, 0.0722], linear))
