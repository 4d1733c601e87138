"""Moving the sheet, pulling and scaling a picture by keys alone."""

import base64
from pathlib import Path

import pytest
from studio.window import Opener, Studio

ROOT = Path(__file__).parents[2]
PIXEL = base64.b64decode(
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9awAAAABJRU5ErkJggg=="
)


def test_shift_and_arrows_move_the_sheet_in_every_mode(studio: Opener) -> None:
    one = studio()
    for mode in ("edit", "move", "live", "read"):
        one.mode(mode)
        one.page.keyboard.press("Space")
        one.settle()
        one.page.locator("#sheet").focus()
        x, y = one.screen(0, 0)
        one.page.keyboard.press("Shift+ArrowRight")
        one.page.keyboard.press("Shift+ArrowUp")
        assert one.screen(0, 0) == pytest.approx((x - 60, y + 60))
        one.page.keyboard.press("Shift+ArrowLeft")
        one.page.keyboard.press("Shift+ArrowDown")
        assert one.screen(0, 0) == pytest.approx((x, y))


def test_arrows_pull_a_body_in_live_and_escape_lets_go(studio: Opener) -> None:
    one = studio()
    text = (ROOT / "examples" / "pendulum.toml").read_text(encoding="utf-8")
    one.load(text.replace("gravity = [0, -9.81]", "gravity = [0, 0]"))
    one.mode("live")
    one.page.wait_for_timeout(300)
    assert one.quantity("rod.omega") == 0
    one.page.locator("#sheet").focus()
    for _ in range(5):
        one.page.keyboard.press("ArrowRight")
    one.wait("kempe.quantity('rod.omega').then(({ value }) => value > 0.02)")
    assert "rod" in one.message()
    one.page.keyboard.press("Escape")
    one.page.wait_for_timeout(100)
    released = one.quantity("rod.omega")
    one.page.wait_for_timeout(400)
    assert one.quantity("rod.omega") == pytest.approx(released, rel=1e-6)  # nothing turns it


def begin_scaling(one: Studio, path: Path) -> None:
    """Open a picture and begin to scale it with a key."""
    path.write_bytes(PIXEL)
    with one.page.expect_file_chooser() as chooser:
        one.page.locator("#picture").click()
    chooser.value.set_files(path)
    one.wait(
        "[...document.querySelectorAll('button')].some(b => b.innerText === 'Scale by two points')"
    )
    one.page.get_by_role("button", name="Scale by two points").focus()
    one.page.keyboard.press("Enter")


def test_a_picture_is_scaled_by_keys(studio: Opener, tmp_path: Path) -> None:
    one = studio()
    begin_scaling(one, tmp_path / "sketch.png")
    one.page.keyboard.press("ArrowRight")
    one.page.keyboard.press("Space")
    assert "second" in one.message()
    for _ in range(4):
        one.page.keyboard.press("ArrowUp")
    one.page.keyboard.press("Space")
    one.settle()
    one.page.keyboard.type("0.5")  # the field for the distance has the focus
    assert one.page.get_by_label("Their distance / m").input_value() == "0.5"
    one.page.keyboard.press("Enter")
    one.settle()
    assert one.page.get_by_label("Their distance / m").count() == 0


def test_escape_ends_the_scaling(studio: Opener, tmp_path: Path) -> None:
    one = studio()
    begin_scaling(one, tmp_path / "sketch.png")
    one.page.keyboard.press("Escape")
    one.page.keyboard.press("ArrowUp")
    one.page.keyboard.press("Space")
    assert "second" not in one.message()
