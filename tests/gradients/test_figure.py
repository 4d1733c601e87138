"""``kp.plot.gradient``: sorted bars, a panel for each measure, signs of remarks."""

import kempe as kp
import pytest
from matplotlib.patches import Rectangle

MEASURES = ["pin.max", "rod.angle.final", "energy.balance.max"]
VARIABLES = ["length", "stiffness", "mass", "rod.angle"]


@pytest.fixture
def found(case: kp.Case) -> kp.Gradient:
    return kp.gradient(case, MEASURES, VARIABLES, analysis="swing")


def test_bars_are_sorted_with_the_largest_at_the_top(found: kp.Gradient) -> None:
    panels = kp.plot.gradient(found).axes
    assert [axes.get_title("left") for axes in panels] == MEASURES
    assert panels[-1].get_xlabel() == "relative slope / 1"
    for axes in panels[:2]:
        lengths = [abs(bar.get_width()) for bar in axes.patches if isinstance(bar, Rectangle)]
        assert lengths == sorted(lengths)
        names = [label.get_text() for label in axes.get_yticklabels()]
        ranked = [one.variable for one in found.ranked(axes.get_title("left"))]
        assert names == ranked[::-1]


def test_a_missing_slope_has_words_and_a_remark_is_hatched(found: kp.Gradient) -> None:
    found.remarks = {**found.remarks, ("pin.max", "mass"): "one-sided"}
    first, _, last = kp.plot.gradient(found).axes
    assert [text.get_text() for text in last.texts] == ["no derivative"] * 4
    hatched = [bar for bar in first.patches if bar.get_hatch()]
    names = [label.get_text() for label in first.get_yticklabels()]
    assert [names[first.patches.index(bar)] for bar in hatched] == ["mass"]


def test_some_measures(found: kp.Gradient) -> None:
    (axes,) = kp.plot.gradient(found, ["rod.angle.final"]).axes
    assert axes.get_title("left") == "rod.angle.final"
    with pytest.raises(kp.ModelError, match="unknown measure 'pin'"):
        kp.plot.gradient(found, ["pin"])
    with pytest.raises(kp.ModelError, match="from 1 to 4 fit in a figure"):
        kp.plot.gradient(found, [])
    with pytest.raises(kp.ModelError, match="is not a gradient"):
        kp.plot.gradient(found.table)
