"""Fields of the panel: formulas, units, and tables in the notation of the file."""

import json
import math
from pathlib import Path

import kempe as kp
import pytest
from studio.test_palette import CASE
from studio.window import Opener, Studio

PLATE = """kempe = 1

[parameters]
L = 0.3
rho = "2700 kg/m^3"

[bodies.plate]
mass = 1
inertia = 1
through = { A = [0, 0], B = [0.4, 0] }

[analyses.run]
type = "dynamics"
t_end = 1
"""


def choose(one: Studio, name: str) -> None:
    one.page.locator("#sheet").focus()
    one.page.keyboard.press("Escape")
    one.page.locator(".contents button").filter(has_text=name).first.click()


def fill(one: Studio, label: str, text: str) -> None:
    field = one.page.get_by_label(label, exact=True)
    field.fill(text)
    field.press("Enter")
    one.settle()


def test_the_mass_follows_from_shapes_that_are_typed(one: Studio, tmp_path: Path) -> None:
    one.load(PLATE)
    choose(one, "plate")
    shape = '{ type = "plate", width = "2*L", height = "50 mm", density = "rho", thickness = 0.01 }'
    fill(one, "shapes", f"[{shape}]")
    assert one.page.locator(".field .problem").count() > 0  # the mass is given twice
    for name in ("mass", "inertia"):
        fill(one, name, "")
    assert one.page.locator(".field .problem").count() == 0
    (found,) = one.tree()["bodies"]["plate"]["shapes"]
    assert found["width"] == "2*L"
    path = tmp_path / "plate.toml"
    path.write_text(one.toml(), encoding="utf-8")
    assert kp.load(path).model.bodies["plate"].mass == pytest.approx(2700 * 0.6 * 0.05 * 0.01)


def test_a_fault_in_a_table_is_shown_and_changes_nothing(one: Studio) -> None:
    before = PLATE.replace("mass = 1\ninertia = 1\n", "")
    one.load(before)
    choose(one, "plate")
    fill(one, "shapes", "[{ type = 'plate', width = 1 ")
    assert "array" in one.message() or "expected" in one.message()
    assert one.toml() == before
    fill(one, "shapes", "[{ type = 'plate', breadth = 1 }]")
    shown = one.page.locator(".field .problem").all_inner_texts()
    assert any("breadth" in text for text in shown), shown
    assert any("missing" in text for text in shown), shown


@pytest.mark.parametrize(
    ("field", "text", "value"),
    [
        ("method", '{ type = "rk4", step = "1 ms" }', {"type": "rk4", "step": "1 ms"}),
        ("method", "rk45", {"type": "rk45"}),
        (
            "stabilization",
            '{ type = "projection", tolerance = 1e-9 }',
            {"type": "projection", "tolerance": 1e-9},
        ),
        ("events", '{ turned = "plate.angle > 1" }', {"turned": "plate.angle > 1"}),
        ("parameters", "{ L = 0.5 }", {"L": 0.5}),
    ],
)
def test_tables_of_an_analysis_are_typed(one: Studio, field: str, text: str, value: object) -> None:
    one.load(PLATE)
    one.page.locator("#sheet").focus()
    one.page.keyboard.press("Escape")
    one.call("document.querySelectorAll('details').forEach(one => { one.open = true; })")
    fill(one, field, text)
    assert one.tree()["analyses"]["run"][field] == value


def test_a_curve_is_added_to_a_body_and_changed(one: Studio) -> None:
    one.load(CASE)
    choose(one, "left")
    one.page.locator("#add-curve").click()
    one.settle()
    field = one.page.get_by_label("curves", exact=True)
    shown = field.input_value()
    assert shown == "{ curve1 = { circle = [0, 0, 0.2236] } }"
    fill(one, "curves", shown.replace("0.2236", '"120 mm"'))
    assert one.tree()["bodies"]["left"]["curves"] == {"curve1": {"circle": [0, 0, "120 mm"]}}


@pytest.mark.parametrize(
    ("text", "length"), [("800 mm", 0.8), ("0.5*2", 1.0), ("L + 0.1", 0.4), ("0.25", 0.25)]
)
def test_the_length_of_a_bar_may_have_a_unit_or_be_a_formula(
    one: Studio, text: str, length: float
) -> None:
    one.load(CASE + "\n[parameters]\nL = '300 mm'\n")
    choose(one, "left")
    fill(one, "length", text)
    ends = list(one.tree()["bodies"]["left"]["through"].values())
    assert math.dist(*ends) == pytest.approx(length, rel=1e-9)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("2 kg", "must be in m"),
        ("0.5 + nothing", "unknown name 'nothing'"),
        ("-1", "greater than 0"),
        ("", "greater than 0"),
        ("one metre", "operator"),
    ],
)
def test_a_length_that_is_none_gives_a_message(studio: Opener, text: str, message: str) -> None:
    one = studio()
    one.load(CASE)
    choose(one, "left")
    fill(one, "length", text)
    assert message in one.message()
    assert one.toml() == CASE
    if not text:
        return
    one.tool("bar")
    one.click(-0.2, 0.0)
    one.page.locator("#typed-length").fill(text)
    one.click(0.1, 0.0)
    assert message in one.message()
    assert one.toml() == CASE
    one.page.locator("#typed-length").fill("200 mm")
    one.click(0.3, 0.0)
    assert list(one.tree()["bodies"]["bar1"]["through"].values()) == [[-0.2, 0.0], [0.0, 0.0]]


def test_a_formula_is_read_for_the_line_that_is_drawn(studio: Opener) -> None:
    one = studio()
    one.load(CASE)
    one.tool("bar")
    one.click(-0.2, 0.0)
    one.page.keyboard.type("0.1*2")
    one.page.wait_for_timeout(500)
    one.settle()
    one.click(0.4, 0.0)
    assert list(one.tree()["bodies"]["bar1"]["through"].values()) == [[-0.2, 0.0], [0.0, 0.0]]


def test_the_status_line_has_line_and_column(one: Studio) -> None:
    one.load("kempe = 1\ntitle = 3\n")
    assert "line 2, column 9" in one.page.locator("#message .link").all_inner_texts()
    problem = one.load("kempe = 1\nx = [1,\n")["problems"][0]
    line = f"line {problem['line']}, column {problem['column']}"
    assert line in one.message(), json.dumps(problem)
