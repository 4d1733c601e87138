"""A report in a browser: on a screen, on a phone, and printed."""

import re
from pathlib import Path

import kempe as kp
import pytest
from browser.conftest import sync_api
from house.places import ROOT


@pytest.fixture(scope="module")
def case() -> kp.Case:
    return kp.load(ROOT / "examples" / "pendulum.toml")


def test_a_report_fits_a_screen_and_a_phone_and_loads_nothing(
    case: kp.Case, browser: "sync_api.Browser", tmp_path: Path
) -> None:
    path = kp.write_report(case, tmp_path / "report.html")
    for width, height in ((1280, 800), (390, 844)):
        context = browser.new_context(viewport={"width": width, "height": height})
        messages: list[str] = []
        requests: list[str] = []
        page = context.new_page()
        page.on("console", lambda message, to=messages: to.append(message.text))
        page.on("pageerror", lambda error, to=messages: to.append(str(error)))
        context.on("request", lambda request, to=requests: to.append(request.url))
        page.goto(path.as_uri())
        assert page.evaluate("document.documentElement.scrollWidth") <= width
        assert page.locator("math").first.bounding_box()["height"] > 0
        assert page.locator("figure svg").count() == page.locator("figcaption").count() >= 6
        context.close()
        assert messages == []
        assert requests == [path.as_uri()]


def test_a_report_is_printed_on_numbered_pages(
    case: kp.Case, tmp_path: Path, browser: "sync_api.Browser"
) -> None:
    assert browser.is_connected()  # so that a missing browser is reported in the same way
    printed = kp.write_report(case, tmp_path / "report.pdf").read_bytes()
    assert printed.startswith(b"%PDF")
    pages = len(re.findall(rb"/Type\s*/Page\b", printed))
    assert 5 <= pages <= 20
