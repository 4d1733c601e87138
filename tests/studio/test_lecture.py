"""A page that the studio saves: it opens with the case, computes, and can save pages itself."""

from pathlib import Path

import kempe as kp
import pytest
from studio.window import Opener, Studio

EXAMPLES = Path(__file__).parents[2] / "examples"


def saved(one: Studio, path: Path) -> Path:
    one.page.locator("#share").click()
    with one.page.expect_download() as download:
        one.page.get_by_role("button", name="Save as a page").click()
    assert download.value.suggested_filename.endswith(".html")
    download.value.save_as(path)
    one.page.keyboard.press("Escape")
    return path


def test_a_saved_page_opens_with_the_case_and_computes(fresh: Opener, tmp_path: Path) -> None:
    case = EXAMPLES / "slider_crank.toml"
    text = case.read_text(encoding="utf-8") + "# </script><script>alert(1)</script>\n"
    one = fresh(accept_downloads=True)
    one.load(text)
    one.mode("read")  # what is drawn in the page by now is not saved
    first = saved(one, tmp_path / "first.html")
    two = fresh(page=first, accept_downloads=True)
    assert two.toml() == text
    assert two.page.locator("#mode-edit").get_attribute("aria-checked") == "true"
    angle = kp.load(case).start()["rod.angle"]
    assert two.quantity("rod.angle") == pytest.approx(angle, abs=1e-12)
    assert saved(two, tmp_path / "second.html").read_bytes() == first.read_bytes()
