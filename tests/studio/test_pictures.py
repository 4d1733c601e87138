"""Pictures behind the drawing, and outlines from SVG files."""

import base64
import re
from pathlib import Path

import pytest
from studio.window import Studio

EXAMPLES = Path(__file__).parents[2] / "examples"
#: A blue picture of one pixel, which the browser enlarges.
BLUE = base64.b64decode(
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNkYPj/HwADAgH/p2MDhAAAAABJRU5ErkJggg=="
)
PLATE = """<svg xmlns="http://www.w3.org/2000/svg" width="200mm" viewBox="0 0 400 200">
<path d="M0 0H400V200H0Z"/></svg>"""


def give(one: Studio, button: str, path: Path) -> None:
    with one.page.expect_file_chooser() as chooser:
        one.page.locator(button).click()
    chooser.value.set_files(path)
    one.page.wait_for_timeout(300)
    one.settle()


def nothing_selected(one: Studio) -> None:
    one.page.locator("#sheet").focus()
    one.page.keyboard.press("Escape")


def blue(one: Studio) -> tuple[float, float]:
    """From where to where the sheet is blue along the x axis, m."""
    found = one.call(
        """async () => {
          const sheet = document.querySelector("#sheet");
          const { left, top, width } = sheet.getBoundingClientRect();
          const [ox, oy] = await kempe.screen([0, 0.013]);
          const [ex] = await kempe.screen([1, 0.013]);
          const copy = new OffscreenCanvas(sheet.width, sheet.height);
          const context = copy.getContext("2d", { willReadFrequently: true });
          context.drawImage(sheet, 0, 0);
          const row = context.getImageData(0, oy - top, width, 1).data;
          const at = [];
          for (let x = 0; x < width; x += 1)
            if (row[4 * x + 3] > 60 && row[4 * x + 2] > row[4 * x] + 40) at.push(x);
          const metres = (x) => (x + left - ox) / (ex - ox);
          return at.length ? [metres(at[0]), metres(at.at(-1) + 1)] : [0, 0];
        }"""
    )
    return found[0], found[1]


def test_a_picture_is_scaled_by_two_clicks_and_stays_out_of_the_case(
    one: Studio, tmp_path: Path
) -> None:
    one.load("kempe = 1\n[bodies.ground]\npoints = {}\n")
    text = one.toml()
    nothing_selected(one)
    path = tmp_path / "blue.png"
    path.write_bytes(BLUE)
    give(one, "#picture", path)
    left, right = blue(one)
    assert right - left > 0.5
    one.page.get_by_role("button", name="Scale by two points").click()
    one.click(-0.3, 0.0)
    one.click(0.1, 0.0)
    one.page.get_by_label("Their distance / m").fill("0.2")
    one.page.get_by_role("button", name="Apply").click()
    one.settle()
    # half as large, about the first click
    assert blue(one) == pytest.approx(((left - 0.3) / 2, (right - 0.3) / 2), abs=0.02)
    assert one.toml() == text
    one.page.get_by_role("button", name="Remove the picture").click()
    one.settle()
    assert blue(one) == (0, 0)


def test_a_file_that_is_no_picture_gives_a_message(one: Studio, tmp_path: Path) -> None:
    one.load("kempe = 1\n")
    nothing_selected(one)
    path = tmp_path / "no.png"
    path.write_bytes(b"no picture")
    give(one, "#picture", path)
    assert "not a picture" in one.message()


def test_an_svg_file_becomes_the_outline_of_a_body(one: Studio, tmp_path: Path) -> None:
    one.load((EXAMPLES / "pendulum.toml").read_text(encoding="utf-8"))
    nothing_selected(one)
    one.page.get_by_role("button", name="rod").first.click()
    path = tmp_path / "plate.svg"
    path.write_text(PLATE, encoding="utf-8")
    give(one, "#outline", path)
    written = one.tree()["bodies"]["rod"]["outline"]["path"]
    numbers = [float(x) for x in re.findall(r"-?[\d.]+", written)]
    # 200 mm by 100 mm, y upwards, with its middle at that of the rod
    assert numbers == pytest.approx([-0.1, 0.05, 0.1, -0.05, -0.1])
    assert re.findall("[A-Z]", written) == ["M", "H", "V", "H", "Z"]
    path.write_text("<svg><rect width='3'/></svg>", encoding="utf-8")
    before = one.toml()
    give(one, "#outline", path)
    assert "no path that can be read" in one.message()
    assert one.toml() == before
