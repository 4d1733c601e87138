"""Analyses without a motion in *Read*: their findings, and what is drawn."""

from pathlib import Path
from typing import Any

import kempe as kp
import numpy as np
import pytest
from studio.agreement import TOLERANCE
from studio.window import Studio

EXAMPLES = Path(__file__).parents[2] / "examples"


def example(name: str) -> str:
    """An example without its analyses."""
    text = (EXAMPLES / f"{name}.toml").read_text(encoding="utf-8")
    return text.partition("[analyses")[0]


def python(tmp_path: Path, text: str) -> dict[str, Any]:
    """The results of a case by the name of the analysis."""
    path = tmp_path / "case.toml"
    path.write_text(text, encoding="utf-8")
    return dict(kp.load(path).each())


def chosen(one: Studio, name: str) -> dict[str, str]:
    """Choose an analysis, press *Run*, and read the panel."""
    one.page.locator("#analysis").select_option(name)
    one.page.locator("#run").click()
    one.settle()
    rows = one.page.locator("#findings .facts > div")
    names, texts = rows.locator("dt").all_inner_texts(), rows.locator("dd").all_inner_texts()
    return dict(zip(names, texts, strict=True))


def opened(one: Studio, text: str) -> None:
    assert one.load(text) == {"problems": [], "unassembled": None}
    one.mode("read")


def angle(one: Studio, body: int) -> float:
    """The angle of a body as it is drawn."""
    found: float = one.call("kempe.state()")["q"][3 * body + 2]
    return found


FOUR_BAR = (
    example("four_bar")
    + """
[analyses.rest]
type = "equilibrium"
[analyses.small]
type = "modes"
[analyses.ends]
type = "limits"
over = "rocker.angle"
[analyses.count]
type = "mobility"
[analyses.all]
type = "configurations"
from = "start"
"""
)


def test_an_equilibrium_is_drawn_with_its_stability(one: Studio, tmp_path: Path) -> None:
    rest = python(tmp_path, FOUR_BAR)["rest"]
    opened(one, FOUR_BAR)
    found = chosen(one, "rest")
    assert found["stability"] == "stable"
    assert float(found["stiffness along crank.angle"].split()[0]) == pytest.approx(
        float(rest.eigenvalues[0]), rel=1e-3
    )
    assert angle(one, 2) == pytest.approx(float(rest.state["rocker.angle"]), rel=TOLERANCE)
    assert one.page.locator("#position").count() == 0
    one.mode("edit")  # which shows the start again
    assert angle(one, 0) == pytest.approx(np.radians(70), rel=TOLERANCE)
    one.mode("read")
    assert angle(one, 2) == pytest.approx(float(rest.state["rocker.angle"]), rel=TOLERANCE)


def test_efforts_at_rest_have_their_units(one: Studio, tmp_path: Path) -> None:
    text = """kempe = 1
gravity = [0, -9.81]
[bodies.ground]
points = { A = [0, 0] }
[bodies.rod]
type = "bar"
mass = 2
length = 1
ends = ["A", "B"]
[joints.A]
type = "revolute"
i = "ground.A"
j = "rod.A"
[drivers.motor]
type = "coordinate_driver"
coordinate = "rod.angle"
value = "0"
[analyses.rest]
type = "equilibrium"
"""
    opened(one, text)
    found = chosen(one, "rest")
    assert found == {"stability": "held: no freedom is left", "motor.effort": "9.810 N·m"}
    rest = python(tmp_path, text)["rest"]
    facts = {fact["name"]: fact for fact in one.call("kempe.run('rest')")["facts"]}
    assert facts["motor.effort"]["value"] == pytest.approx(rest.effort["motor"], rel=TOLERANCE)


def test_both_limits_have_reasons_and_positions(one: Studio, tmp_path: Path) -> None:
    ends = python(tmp_path, FOUR_BAR)["ends"]
    opened(one, FOUR_BAR)
    found = chosen(one, "ends")
    for name, value in (("lower", ends.lower), ("upper", ends.upper)):
        shown = found[f"{name} limit of rocker.angle"]
        assert shown == f"{np.degrees(value):.4g}°"
    assert "dead point" in found["its reason"]
    for place, value in (("lower limit", ends.lower), ("upper limit", ends.upper)):
        one.page.locator("#position").select_option(label=place)
        one.settle()
        assert angle(one, 2) == pytest.approx(value, rel=TOLERANCE)


def test_configurations_are_counted_and_drawn(one: Studio, tmp_path: Path) -> None:
    listed = python(tmp_path, FOUR_BAR)["all"]
    opened(one, FOUR_BAR)
    assert chosen(one, "all") == {"configurations": "2", "complete": "yes"}
    angles = [float(state["rocker.angle"]) for state in listed]
    assert angle(one, 2) == pytest.approx(angles[0], rel=TOLERANCE)
    one.page.locator("#position").select_option("1")
    one.settle()
    assert angle(one, 2) == pytest.approx(angles[1], rel=TOLERANCE)


def test_mobility_has_its_counts(one: Studio) -> None:
    opened(one, FOUR_BAR)
    found = chosen(one, "count")
    assert found["degrees of freedom"] == found["Grübler's formula"] == "1"
    assert found["redundant equations"] == "0"
    assert found["loop A-B-C-D"] == "crank-rocker"


SMALL = '\n[analyses.small]\ntype = "modes"\nfrom = "start"\n'
#: Undamped, damped, with many freedoms, and with drivers.
MODES = {
    "four_bar": FOUR_BAR,
    **{name: example(name) + SMALL for name in ("double_pendulum", "squeezer", "trebuchet")},
    "damped": example("double_pendulum")
    + '[forces.damper]\ntype = "torsion_spring"\ni = "first"\nj = "second"\nstiffness = 0\n'
    + "damping = 0.3\n"
    + SMALL,
}


@pytest.mark.parametrize("name", MODES)
def test_modes_are_those_of_python(one: Studio, tmp_path: Path, name: str) -> None:
    small = python(tmp_path, MODES[name])["small"]
    opened(one, MODES[name])
    shown = chosen(one, "small")
    facts = {fact["name"]: fact["value"] for fact in one.call("kempe.run('small')")["facts"]}
    assert len(small.eigenvalues) > 0
    swings = small.eigenvalues.imag > 0
    for end, values in (
        (": frequency", small.frequency[swings]),
        (": damping ratio", small.damping[swings]),
        (" with the rate", np.sort(small.eigenvalues.real[~swings & (small.eigenvalues != 0)])),
    ):
        found = [value for name, value in facts.items() if name.endswith(end)]
        found = sorted(found) if end == " with the rate" else found
        assert found == pytest.approx(values.tolist(), rel=1e-7, abs=1e-9)
        assert len(shown) == len(facts)


ARM = """kempe = 1
gravity = [0, 0]
[bodies.ground]
points = { O = [0, 0] }
[bodies.upper]
type = "bar"
mass = 1
length = 0.7
ends = ["O", "E"]
[bodies.fore]
type = "bar"
mass = 1
length = 0.3
ends = ["E", "H"]
[joints.shoulder]
type = "revolute"
i = "ground.O"
j = "upper.O"
[joints.elbow]
type = "revolute"
i = "upper.E"
j = "fore.E"
[start]
set = { "upper.angle" = 0.2, "fore.angle" = 1.0 }
[analyses.region]
type = "reachable"
of = "fore.H"
over = ["shoulder.angle", "elbow.angle"]
ranges = [[0, "360*deg"], [0, "180*deg"]]
"""

PIXEL = """([x, y]) => {
    const canvas = document.getElementById("sheet");
    const { left, top, width } = canvas.getBoundingClientRect();
    const ratio = canvas.width / width;
    const at = [(x - left) * ratio, (y - top) * ratio];
    const copy = new OffscreenCanvas(1, 1).getContext("2d");
    copy.drawImage(canvas, -at[0], -at[1]);
    return [...copy.getImageData(0, 0, 1, 1).data];
}"""


def test_the_region_of_a_point_is_filled_on_the_sheet(one: Studio, tmp_path: Path) -> None:
    region = python(tmp_path, ARM)["region"]
    opened(one, ARM)
    one.page.get_by_label("Grid").uncheck()
    try:
        found = chosen(one, "region")
        area = found["area that fore.H reaches"]
        assert area == f"{region.area:.4g} m²"
        ran = one.call("kempe.run('region')")
        assert len(ran["outlines"]) == len(region.boundary) == 2
        for outline, expected in zip(ran["outlines"], region.boundary, strict=True):
            np.testing.assert_allclose(outline, expected, atol=TOLERANCE)
        places = [(-0.42, -0.56), (-0.15, -0.2), (-0.97, -0.97)]
        inside, hole, outside = (one.call(PIXEL, list(one.screen(*at))) for at in places)
        assert inside != hole
        assert hole == outside
        one.mode("edit")
        assert one.call(PIXEL, list(one.screen(*places[0]))) == hole
    finally:
        one.page.get_by_label("Grid").check()


def test_a_result_without_a_motion_has_no_values(one: Studio) -> None:
    opened(one, FOUR_BAR)
    chosen(one, "count")
    refused = one.call("kempe.values(['crank.angle']).catch(error => error.message)")
    assert "not a motion" in refused
    assert one.page.locator("#scrub").count() == 0
