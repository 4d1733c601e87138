"""What people type and expect: decimal commas, names in any script, enter, pictures of a case."""

import unicodedata
from pathlib import Path

import pytest
from studio.window import Opener, Studio

SKETCH = """<svg xmlns="http://www.w3.org/2000/svg" width="300" height="200">
<path d="M0 0H300L0 200Z" fill="teal"/></svg>"""


def new(one: Studio) -> None:
    one.page.locator("#new").click()
    one.settle()


def typed(one: Studio, field: str, text: str) -> None:
    one.page.get_by_label(field, exact=True).first.fill(text)
    one.page.get_by_label(field, exact=True).first.press("Enter")
    one.settle()


def test_decimal_commas_are_understood_where_a_number_is_typed(studio: Opener) -> None:
    one = studio()
    typed(one, "L1", "10,5")
    assert one.tree()["parameters"]["L1"] == 10.5
    typed(one, "L1", "10500,25 mm")
    assert one.tree()["parameters"]["L1"] == "10500.25 mm"
    typed(one, "L1", "min(10,11)")  # a formula
    assert one.tree()["parameters"]["L1"] == "min(10,11)"
    typed(one, "L1", "1,000")  # a thousand or one?
    assert one.page.locator("#tab-text").inner_text() != "Text"
    typed(one, "L1", "10,5")
    typed(one, "Gravity", "0; -9,5")
    assert one.tree()["gravity"] == [0, -9.5]


def test_numbers_are_written_as_people_write_them(studio: Opener) -> None:
    one = studio()
    for text in ("1e300", "2.5e-7", "0.25", "1200000"):
        typed(one, "k", text)
        found = next(line for line in one.toml().splitlines() if line.startswith("k = "))
        assert float(found.split()[2]) == float(text)
        assert len(found.split()[2]) <= len(text)
        assert one.page.get_by_label("k", exact=True).input_value() == found.split()[2]


def test_names_have_letters_of_any_script(studio: Opener) -> None:
    one = studio()
    one.page.locator(".contents button").filter(has_text="crank").first.click()
    one.page.locator("#entry-name").fill(unicodedata.normalize("NFD", "Größe_曲柄"))
    one.page.locator("#entry-name").press("Enter")
    one.settle()
    tree = one.tree()
    assert "Größe_曲柄" in tree["bodies"]  # composed
    assert tree["joints"]["A"]["j"] == "Größe_曲柄.A"
    assert tree["start"]["set"] == {"Größe_曲柄.angle": "70*deg"}
    one.page.locator("#entry-name").fill("Kurbel")
    one.page.locator("#entry-name").press("Enter")
    one.settle()
    assert one.tree()["joints"]["A"]["j"] == "Kurbel.A"


def test_enter_after_digits_places_the_end(studio: Opener) -> None:
    one = studio()
    new(one)
    one.tool("bar")
    one.click(-0.4, 0.0)
    one.page.mouse.move(*one.screen(0.1, 0.005))
    one.page.keyboard.type("0,3")
    one.page.keyboard.press("Enter")
    one.settle()
    ends = list(one.tree()["bodies"]["bar1"]["through"].values())
    assert ends == [[-0.4, 0], [pytest.approx(-0.1), pytest.approx(0, abs=1e-9)]]


def test_an_empty_sheet_is_not_ready(studio: Opener) -> None:
    one = studio()
    assert one.page.locator("#readiness").count() == 1
    new(one)
    assert one.page.locator("#readiness").count() == 0


def test_a_picture_is_moved_and_turned_and_belongs_to_its_case(
    studio: Opener, tmp_path: Path
) -> None:
    one = studio()
    path = tmp_path / "sketch.svg"
    path.write_text(SKETCH, encoding="utf-8")
    with one.page.expect_file_chooser() as chooser:
        one.page.locator("#picture").click()
    chooser.value.set_files(path)
    one.page.get_by_role("button", name="Scale by two points").click()
    one.click(-5.0, 5.0)
    assert "second" in one.message()
    one.click(5.0, 5.0)
    assert "point" not in one.message()  # its message ends
    one.page.keyboard.press("Escape")
    text = one.toml()
    before = one.page.locator("#sheet").screenshot()
    one.page.get_by_role("button", name="Move", exact=True).click()
    one.page.mouse.move(*one.screen(-3, -3))
    one.page.mouse.down()
    one.page.mouse.move(*one.screen(4, 2), steps=4)
    one.page.mouse.up()
    one.page.keyboard.press("Escape")
    one.settle()
    moved = one.page.locator("#sheet").screenshot()
    assert moved != before
    assert one.toml() == text
    one.page.get_by_role("slider", name="Rotation").fill("36")
    one.settle()
    assert one.page.locator("#sheet").screenshot() != moved
    new(one)
    assert one.page.get_by_role("slider", name="Rotation").count() == 0
    one.page.keyboard.press("Control+z")
    one.settle()
    assert one.page.get_by_role("slider", name="Rotation").count() == 1
    one.page.get_by_role("button", name="Remove the picture").click()
