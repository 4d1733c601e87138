"""Sharing: the QR code of the link, the frame of a course page, the sheet of paper."""

import functools
import http.server
import io
import random
import re
import shutil
import threading
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from studio.conftest import PAGE
from studio.window import Opener, Studio

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Frame

EXAMPLES = Path(__file__).parents[2] / "examples"
#: The longest link in a code, bytes, as in studio/src/give/code.ts.
MOST = 2900
#: The dark modules of the code, and its side.
MODULES = """() => {
    const svg = document.querySelector("dialog svg.code");
    return [svg.viewBox.baseVal.width, svg.querySelector("path").getAttribute("d")];
}"""


class Quiet(http.server.SimpleHTTPRequestHandler):
    """Serves a folder without a word."""

    def log_message(self, *_: Any) -> None:
        pass


@pytest.fixture
def served(built: None, tmp_path: Path) -> Iterator[tuple[str, Path]]:  # noqa: ARG001
    """The address and the folder of a server with the page."""
    shutil.copy(PAGE, tmp_path / "index.html")
    handler = functools.partial(Quiet, directory=str(tmp_path))
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    yield f"http://127.0.0.1:{server.server_address[1]}", tmp_path
    server.shutdown()
    server.server_close()


def example(name: str) -> str:
    return (EXAMPLES / f"{name}.toml").read_text(encoding="utf-8")


def share(one: Studio) -> None:
    one.page.locator("#share").click()
    one.page.locator("dialog").wait_for()


def close(one: Studio) -> None:
    one.page.keyboard.press("Escape")
    one.page.locator("dialog").wait_for(state="detached")


def link(one: Studio) -> str:
    return one.page.locator("#link").input_value()


def with_link_of(one: Studio, size: int) -> None:
    """Open a case whose link has this size, or at most two bytes less; the dialog is open."""
    letters = random.Random(7)
    bulk = "".join(letters.choices("abcdefghijklmnopqrstuvwxyz0123456789", k=size))
    low, high = 0, size
    while high - low > 1:
        middle = (low + high) // 2
        one.load(f"{example('pendulum')}# {bulk[:middle]}\n")
        share(one)
        low, high = (middle, high) if len(link(one)) <= size else (low, middle)
        close(one)
    one.load(f"{example('pendulum')}# {bulk[:low]}\n")
    share(one)


def picture(one: Studio) -> Any:
    """The code as grey pixels, four for each module."""
    size, path = one.call(MODULES)
    pixels = np.full((int(size), int(size)), 255, dtype=np.uint8)
    for x, y in re.findall(r"M(\d+) (\d+)h1v1h-1z", path):
        pixels[int(y), int(x)] = 0
    return np.kron(pixels, np.ones((4, 4), dtype=np.uint8))


def test_the_code_is_read_by_another_program(studio: Opener) -> None:
    zxing = pytest.importorskip("zxingcpp", reason="the package zxing-cpp is missing")
    one = studio()
    for name in ("pendulum", "four_bar", "slider_crank"):
        one.load(example(name))
        share(one)
        (found,) = zxing.read_barcodes(picture(one))
        assert found.text == link(one)
        close(one)


def test_a_code_has_at_most_2900_bytes(studio: Opener) -> None:
    one = studio()
    with_link_of(one, MOST)
    assert MOST - 2 <= len(link(one)) <= MOST
    assert one.call(MODULES)[0] <= 177 + 8
    close(one)
    with_link_of(one, MOST + 3)
    assert len(link(one)) > MOST
    assert one.page.locator("dialog svg.code").count() == 0
    said = one.page.locator("dialog .problem").all_inner_texts()
    assert any(f"{len(link(one))} bytes" in text and str(MOST) in text for text in said), said
    close(one)


def test_the_largest_code_is_read_by_another_program(studio: Opener) -> None:
    zxing = pytest.importorskip("zxingcpp", reason="the package zxing-cpp is missing")
    one = studio()
    with_link_of(one, MOST)
    (found,) = zxing.read_barcodes(picture(one))
    assert found.text == link(one)
    close(one)


def framed(browser: "Browser", served: tuple[str, Path], text: str) -> tuple[Studio, "Frame"]:
    """A course page with the HTML that the page offers for a case, and its frame."""
    address, folder = served
    one = Studio(browser.new_context().new_page())
    one.page.goto(f"{address}/index.html")
    one.wait("typeof kempe === 'object' && kempe.state().then(state => state !== null)", 20.0)
    one.load(text)
    share(one)
    html = one.page.locator("#frame").input_value()
    one.page.context.close()
    (folder / "course.html").write_text(f"<h1>Lesson</h1>{html}", encoding="utf-8")
    two = Studio(browser.new_context().new_page())
    two.page.on("pageerror", lambda error: two.messages.append(str(error)))
    two.page.goto(f"{address}/course.html")
    return two, two.page.frames[1]


def wait_in(frame: "Frame", condition: str) -> None:
    for _ in range(1000):
        if frame.evaluate(condition):
            return
        frame.page.wait_for_timeout(20)
    raise AssertionError(condition)


@pytest.mark.parametrize("name", ["four_bar", "slider_crank"])
def test_the_frame_of_a_course_page_has_a_drawing_and_a_slider(
    browser: "Browser", served: tuple[str, Path], name: str
) -> None:
    text = example(name)
    course, frame = framed(browser, served, text)
    wait_in(frame, "document.querySelector('#scrub') !== null")
    assert frame.evaluate("kempe.toml()") == text
    for selector in ("header", ".palette", ".side", ".bar", "#message"):
        assert frame.locator(selector).count() == 0, selector
    drawn = "document.querySelector('#sheet').toDataURL()"
    before, begin = frame.evaluate(drawn), frame.evaluate("kempe.state()")
    slider = frame.locator("#scrub").bounding_box()
    assert slider is not None
    course.page.mouse.click(slider["x"] + 0.4 * slider["width"], slider["y"] + 6)
    wait_in(frame, f"kempe.state().then(({{ t }}) => t > {begin['t']} + 0.01)")
    course.page.wait_for_timeout(100)
    assert frame.evaluate(drawn) != before
    assert frame.evaluate("document.scrollingElement.scrollHeight <= innerHeight")
    assert frame.evaluate("document.scrollingElement.scrollWidth <= innerWidth")
    whole = frame.locator("footer a").get_attribute("href")
    assert whole is not None and "#m=" in whole
    assert frame.evaluate("sessionStorage.length") == 0  # the work of a tab is not that of a frame
    assert course.messages == []
    course.page.goto(whole)
    course.wait("typeof kempe === 'object' && kempe.state().then(state => state !== null)", 20.0)
    assert course.toml() == text
    assert course.page.locator("#mode-edit").count() == 1
    course.page.context.close()


def test_a_damaged_link_of_a_frame_says_so(built: None, browser: "Browser") -> None:  # noqa: ARG001
    one = Studio(browser.new_context().new_page())
    one.page.goto(f"{PAGE.as_uri()}#embed=AAAA")
    one.wait("document.querySelector('.embed .problem')?.innerText.includes('damaged')", 20.0)
    one.page.context.close()


CASES = ["four_bar", *(path.stem for path in sorted(EXAMPLES.glob("*.toml"))[:4])]


def printed(one: Studio, landscape: bool = False) -> bytes:
    share(one)
    one.page.wait_for_timeout(100)
    pdf: bytes = one.page.pdf(format="A4", landscape=landscape)
    close(one)
    return pdf


@pytest.mark.parametrize("landscape", [False, True])
def test_a_case_is_printed_on_one_page(fresh: Opener, landscape: bool) -> None:
    one = fresh()
    for name in CASES:
        one.load(example(name))
        pdf = printed(one, landscape)
        assert len(re.findall(rb"/Type\s*/Page\b", pdf)) == 1, name


def test_a_case_with_many_parameters_is_printed_on_one_page(fresh: Opener) -> None:
    one = fresh()
    many = "".join(f"p{k} = {k}\n" for k in range(200))
    one.load(example("four_bar").replace("[parameters]\n", f"[parameters]\n{many}"))
    assert len(re.findall(rb"/Type\s*/Page\b", printed(one))) == 1
    share(one)
    assert "more are in the case" in one.page.locator(".printed").text_content()
    close(one)


def test_the_sheet_has_title_drawing_dimensions_and_link(fresh: Opener) -> None:
    one = fresh()
    share(one)
    one.page.emulate_media(media="print")
    one.page.wait_for_timeout(100)
    sheet = one.page.locator(".printed")
    words = sheet.inner_text()
    assert "Four-bar linkage with a rotational spring-damper" in words
    rows = dict(
        zip(
            sheet.locator("dt").all_inner_texts(),
            sheet.locator("dd").all_inner_texts(),
            strict=True,
        )
    )
    assert rows["L2"].startswith("26")
    assert rows["crank A–B"] == "10.00 m"
    assert rows["ground A–D"] == "20.00 m"
    assert sheet.locator("footer a").get_attribute("href") == link(one)
    image = sheet.locator("img").bounding_box()
    assert image is not None and image["height"] > 200
    assert not one.page.locator("header nav").is_visible()
    assert not one.page.locator("dialog").is_visible()
    one.page.emulate_media(media="screen")
    assert not sheet.is_visible()
    close(one)


def test_the_title_is_in_the_pdf(fresh: Opener) -> None:
    pypdf = pytest.importorskip("pypdf", reason="the package pypdf is missing")
    one = fresh()
    (page,) = pypdf.PdfReader(io.BytesIO(printed(one))).pages
    text = page.extract_text()
    assert "Four-bar linkage with a rotational spring-damper" in text
    assert "L2" in text
