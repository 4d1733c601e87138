"""The limits that docs/scope.md states are those of the code."""

import re
from importlib import import_module

import kempe as kp
import pytest
from house.places import ROOT
from kempe.draw import sampling

SCENE = import_module("kempe.draw.scene")  # kempe.draw.scene is the function
PAGE = (ROOT / "docs" / "scope.md").read_text("utf-8")


DRIVERS = ("shoulder", "elbow")


def stated(pattern: str) -> int:
    """The number that the page states at a place; `10⁶` and `600 000` are numbers too."""
    found = re.search(pattern, " ".join(PAGE.split()))
    assert found, pattern
    text = found[1].replace(" ", "")
    return 10 ** "⁰¹²³⁴⁵⁶⁷⁸⁹".index(text[2:]) if text[-1] in "⁶⁷" else int(text)


def arm() -> kp.Model:
    m = kp.Model("arm", parameters={"L": 1})
    m.ground.points(O=(0, 0))
    m.bar("upper", mass=1, length="L", ends=("O", "A"))
    m.bar("lower", mass=1, length=1, ends=("A", "P"))
    m.revolute("O", "ground.O", "upper.O")
    m.revolute("A", "upper.A", "lower.A")
    m.coordinate_driver("shoulder", "O.angle", value="t")
    m.coordinate_driver("elbow", "A.angle", value="t")
    return m


def test_a_page_has_at_most_so_many_instants_numbers_and_events() -> None:
    assert stated(r"A page has at most (\d+) instants") == sampling.MOST_FRAMES
    assert stated(r"about ([\d ]+) numbers") == sampling._MOST_NUMBERS
    assert stated(r"An animation shows at most (\d+) events") == SCENE._MOST_EVENTS


def test_the_start_report_of_a_large_model_is_short() -> None:
    most = stated(r"Above (\d+) coordinates")

    def report(bodies: int) -> str:
        m = kp.Model("bodies")
        for k in range(bodies):
            m.body(f"b{k}", mass=1, inertia=1)
        return str(kp.assemble(m).report)

    assert "b0.omega" in report(most // 3)
    assert "b0.omega" not in report(most // 3 + 1)


def test_a_motion_beyond_the_largest_number_of_values_is_refused() -> None:
    m, most = arm(), stated(r"A motion has at most (10.) values")
    with pytest.raises(kp.ModelError, match=r"1 ?000 ?000|1000000"):
        kp.kinematics(m, kp.assemble(m), over="shoulder", range=(0, 1), n=most + 1)


def test_a_region_beyond_the_largest_number_of_values_is_refused() -> None:
    m, most = arm(), stated(r"a region (\d+) per quantity")
    ranges = ((0, 1), (0, 1))
    with pytest.raises(kp.ModelError, match=str(most)):
        kp.reachable(m, kp.assemble(m), of="lower.P", over=DRIVERS, ranges=ranges, n=most + 1)


def test_a_sweep_beyond_the_largest_number_of_variants_is_refused() -> None:
    most = stated(r"a sweep (10.) variants")
    case = kp.Case(arm(), analyses=[kp.Kinematics(t_end=1)])
    with pytest.raises(kp.ModelError, match=r"10 ?000 ?000|10000000"):
        kp.sweep(case, {"L": [1, 2]}, ["A.angle.max"], design="random", n=most + 1)
