"""The case of the design, short."""

from pathlib import Path

import pytest

FOUR_BAR = Path(__file__).parents[1] / "python" / "four_bar.toml"


@pytest.fixture
def four_bar_file(tmp_path: Path) -> Path:
    """A copy of the case of the design, which ends after half a second."""
    text = FOUR_BAR.read_text(encoding="utf-8").replace("t_end = 15", "t_end = 0.5")
    path = tmp_path / "four_bar.toml"
    path.write_text(text, encoding="utf-8")
    return path
