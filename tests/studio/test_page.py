"""The page as a whole: layout, links, hostile input, files."""

import base64
import json
import re
import zlib
from pathlib import Path

import pytest
from studio.window import Opener

ROOT = Path(__file__).parents[2]
EXAMPLES = ROOT / "examples"
#: The largest page, bytes compressed, as in studio/build/build.mjs.
MOST = 1_480_000


def link(text: bytes) -> str:
    packed = zlib.compressobj(9, zlib.DEFLATED, -15)
    body = packed.compress(text) + packed.flush()
    return "#m=" + base64.urlsafe_b64encode(body).decode().rstrip("=")


@pytest.mark.parametrize(("width", "height"), [(1280, 800), (390, 844), (844, 390), (1920, 1080)])
def test_nothing_is_cut_at_any_size(studio: Opener, width: int, height: int) -> None:
    one = studio(width, height)
    for mode in ("edit", "move", "live", "read"):
        one.mode(mode)
        size = one.call("[document.scrollingElement.scrollWidth, innerWidth]")
        assert size[0] <= size[1], mode
        box = one.page.locator("#sheet").bounding_box()
        assert box is not None and box["width"] > 200 and box["height"] > 80, mode


def test_every_example_opens_without_a_problem(studio: Opener) -> None:
    one = studio()
    for path in sorted(EXAMPLES.glob("*.toml")):
        found = one.load(path.read_text(encoding="utf-8"))
        assert found["problems"] == [], path.name
        assert found["unassembled"] is None, path.name


def test_the_gallery_opens_an_example(studio: Opener) -> None:
    one = studio()
    one.page.locator("#gallery").click()
    one.page.locator("[data-example=pendulum]").click()
    one.settle()
    assert one.toml() == (EXAMPLES / "pendulum.toml").read_text(encoding="utf-8")


def test_a_link_holds_the_model(studio: Opener, fresh: Opener) -> None:
    one = studio()
    text = (EXAMPLES / "slider_crank.toml").read_text(encoding="utf-8")
    one.load(text)
    one.page.locator("#share").click()
    address = one.page.locator("#link").input_value()
    other = fresh(link="#" + address.split("#")[1])
    assert other.toml() == text


def test_the_licences_of_the_software_in_the_page(studio: Opener) -> None:
    one = studio()
    shown = one.page.locator("#licences").inner_html()
    lock = json.loads((ROOT / "studio" / "package-lock.json").read_text("utf-8"))
    shipped = {
        folder.removeprefix("node_modules/")
        for folder, package in lock["packages"].items()
        if folder and not package.get("dev")
    }
    assert {"preact", "fflate"} <= shipped
    assert [name for name in shipped if not re.search(rf"^{name} \d", shown, re.MULTILINE)] == []
    assert "kurbo" in shown  # a crate in the core


@pytest.mark.parametrize(
    "hostile",
    [
        "#m=%%%",
        "#m=AAAA",
        link(b"kempe = 1\n")[:-3],
        link(bytes(50_000_000))[:60_000],
        "#m=" + 70_000 * "A",
    ],
)
def test_a_hostile_link_gives_a_message(fresh: Opener, hostile: str) -> None:
    one = fresh(link=hostile)
    assert "link" in one.message()
    assert "Four-bar" in one.page.locator("h1").inner_text()


@pytest.mark.parametrize(
    "text",
    [
        'kempe = 1\ntitle = "<img src=x onerror=alert(1)><script>alert(2)</script>"\n',
        'kempe = 1\n[bodies."<b onmouseover=alert(1)>x</b>"]\nmass = 1\ninertia = 1\n',
        "kempe = 1\n[parameters]\na = " + json.dumps("(" * 5000) + "\n",
        "kempe = 1\nx = " + "[" * 5000 + "]" * 5000,
        "\x00\x01\x02",
        "kempe = 1\ntitle = " + json.dumps("x" * 200_000),
        "",
    ],
)
def test_a_hostile_text_gives_a_message_and_the_page_goes_on(studio: Opener, text: str) -> None:
    one = studio()
    one.load(text)
    assert one.call("document.querySelector('#page img, #page b, #page script') === null")
    one.load((EXAMPLES / "pendulum.toml").read_text(encoding="utf-8"))
    assert one.state()["q"]


def test_saved_text_is_that_of_the_page(studio: Opener, tmp_path: Path) -> None:
    one = studio()
    with one.page.expect_download() as download:
        one.page.locator("#save").click()
    path = tmp_path / "saved.toml"
    download.value.save_as(path)
    assert path.read_text(encoding="utf-8") == one.toml()


def test_the_page_is_one_file_and_not_larger_than_agreed() -> None:
    page = Path(__file__).parents[2] / "studio" / "dist" / "index.html"
    if not page.exists():
        pytest.skip("studio/dist/index.html is missing; build it with npm run build in studio/")
    text = page.read_bytes()
    # most of the page has no repetitions; the usual strategy of zlib seeks some at a loss
    pressed = zlib.compressobj(9, zlib.DEFLATED, 31, 9, zlib.Z_FILTERED)
    assert len(pressed.compress(text) + pressed.flush()) <= MOST
    assert b"src=" not in text.split(b"<script", 1)[0]
    assert b'http-equiv="Content-Security-Policy"' in text
