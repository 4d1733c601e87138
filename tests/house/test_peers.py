"""Each row of the comparison with other programs names a test of the studio that exists."""

import re

from house.places import ROOT

ROWS = [
    [cell.strip() for cell in line.strip().strip("|").split("|")]
    for line in (ROOT / "docs" / "peers.md").read_text("utf-8").splitlines()
    if line.startswith("|")
]
HEAD, _, *FEATURES = ROWS


def test_each_row_names_a_test_that_exists() -> None:
    assert len(FEATURES) >= 20
    for feature, named, *_ in FEATURES:
        found = re.fullmatch(r"`(\w+\.py)::(\w+)`", named)
        assert found, feature
        source = (ROOT / "tests" / "studio" / found[1]).read_text("utf-8")
        assert f"\ndef {found[2]}(" in source, named


def test_each_cell_is_yes_no_or_empty() -> None:
    for row in FEATURES:
        assert len(row) == len(HEAD), row
        assert set(row[2:]) <= {"yes", "no", ""}, row
