"""Reports of mechanisms with beams."""

import kempe as kp
import pytest
from kempe.lab_report.write import page
from lab_report.pages import Page


def test_a_beam_is_one_body_of_a_report() -> None:
    m = kp.Model("clamped", gravity=(0, -9.81))
    m.ground.points(O=(0, 0))
    section = kp.Section.rectangle(height=0.01, width=0.01)
    fields = {"young": 1e9, "density": 1e3, "elements": 2, "points": {"P": "50 %"}}
    m.beam("rod", length=1, section=section, shear=False, **fields)
    m.weld("clamp", "ground.O", "rod.A")
    m.body("load", mass=1, inertia=1, points={"O": (0, 0)})
    m.weld("hook", "rod.B", "load.O")
    case = kp.Case(m, None, [kp.Dynamics(t_end=0.01)])
    text = page(case, None, None)
    found = Page(text)
    bodies = [[cell.text for cell in row[:3]] for row in found.table("Bodies").rows]
    assert bodies == [["1", "rod", "beam"], ["2", "load", "body"]]
    start = case.start()
    coordinates = found.table("Coordinates q")
    assert [row[0].text for row in coordinates.rows] == ["rod", "rod.B", "rod.P", "load"]
    for name in ("rod.B", "load"):
        expected = [start[f"{name}.{of}"] for of in ("x", "y", "angle")]
        assert coordinates.values(name)[:3] == pytest.approx(expected, abs=1e-11)
    assert "beam: " in text
