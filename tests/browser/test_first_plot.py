"""The first plot of the player: the driven motion in degrees, or all angles."""

from typing import Any

import kempe as kp
import pytest
from house.places import ROOT


@pytest.mark.parametrize(
    ("example", "quantity", "subject", "unit"),
    [
        ("quick_return", "Angle", "crank", "°"),
        ("crane_trolley", "x", "trolley", "m"),
        ("four_bar", "Angle", "All", "°"),
    ],
)
def test_the_first_plot_shows_the_driven_motion(
    example: str, quantity: str, subject: str, unit: str, opened: Any
) -> None:
    sol = kp.load(ROOT / "examples" / f"{example}.toml").run()[0]
    watched = opened(sol, 1280, 800)
    plot = watched.page.locator(".plot").first
    for name, told in (("quantity", quantity), ("subject", subject)):
        chosen = plot.locator(f".{name}").evaluate("e => e.selectedOptions[0].textContent")
        assert told.casefold() in chosen.casefold(), chosen
    assert all(value.endswith(unit) for value in watched.values().values())
