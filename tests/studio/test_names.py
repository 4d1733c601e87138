"""Hostile names of everything are text in the studio, its pictures, and pages that it saves."""

import json
import xml.etree.ElementTree as ET
from pathlib import Path

import kempe as kp
import pytest
from browser.hostile import HARM, TAG, name, tree
from kempe.studio.page import read
from studio.conftest import PAGE
from studio.window import Opener, Studio


@pytest.fixture(scope="module")
def text(tmp_path_factory: pytest.TempPathFactory) -> str:
    """The case as TOML."""
    path = tmp_path_factory.mktemp("hostile") / "case.json"
    path.write_text(json.dumps(tree()), encoding="utf-8")
    return kp.load(path).text()


def harm(one: Studio) -> list[str]:
    one.settle()
    found: list[str] = one.call(HARM)
    return found


def given(one: Studio, button: str, path: Path) -> Path:
    with one.page.expect_download() as download:
        one.page.locator(button).click()
    download.value.save_as(path)
    return path


def test_names_are_text_in_every_mode(one: Studio, text: str) -> None:
    one.load(text)
    for mode in ("edit", "move", "live", "read"):
        one.mode(mode)
        assert harm(one) == []
        one.page.locator("#tab-text").click()
        assert harm(one) == []
        one.page.locator("#tab-main").click()
    assert name("crank") in one.call("document.body.textContent")
    one.mode("edit")


def test_names_are_text_in_the_properties_of_everything(one: Studio, text: str) -> None:
    one.load(text)
    seen = 0
    links = one.page.locator(".contents button")
    for k in range(links.count()):
        links.nth(k).click()
        assert harm(one) == []
        if one.page.locator(".crumb button").count():
            seen += 1
            one.page.locator(".crumb button").first.click()
            one.settle()
    assert seen >= 10


def test_names_are_text_in_pictures_and_saved_pages(
    one: Studio, fresh: Opener, text: str, tmp_path: Path
) -> None:
    one.load(text)
    drawn = given(one, "button[title='Save the drawing as SVG']", tmp_path / "drawing.svg")
    one.mode("read")
    plots = given(one, "button[title='Save the plots as SVG']", tmp_path / "plots.svg")
    for path in (drawn, plots):
        root = ET.parse(path).getroot()
        assert not [part.tag for part in root.iter() if TAG in part.tag or "harm" in part.attrib]
        assert "\"'><" in "".join(root.itertext())  # names are shortened in drawings
    one.page.locator("#share").click()
    saved = given(one, "button:text-is('Save as a page')", tmp_path / "page.html")
    one.page.keyboard.press("Escape")
    one.mode("edit")
    exported = read(PAGE).export(tmp_path / "exported", text)
    for path in (saved, exported):
        other = fresh(page=path)
        assert harm(other) == []
        assert other.toml() == text


def test_names_are_text_in_messages(one: Studio, text: str) -> None:
    one.page.locator("#tab-text").click()
    for wrong in (("mass = 1", "mass = -1"), (".angle", ".angel"), ("torsion_spring", "torsion")):
        assert wrong[0] in text
        one.load(text.replace(*wrong))
        assert harm(one) == []
        assert one.message().strip()
