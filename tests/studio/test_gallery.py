"""The gallery by mouse and keys: search, families, pictures that move, and the first visit."""

import json
from collections.abc import Iterator
from pathlib import Path

import pytest
from sizes import some
from studio.conftest import opened
from studio.window import Opener, Studio

sync_api = pytest.importorskip("playwright.sync_api", reason="the package playwright is missing")

ROOT = Path(__file__).parents[2]
FAMILIES: dict[str, list[str]] = json.loads(
    (ROOT / "studio" / "build" / "families.json").read_text("utf-8")
)
NAMES = [name for members in FAMILIES.values() for name in members]
#: The number of pixels of the picture of an example that are not empty, and a checksum of all.
PICTURE = """name => {
  const canvas = document.querySelector(`[data-example=${name}] canvas`);
  const copy = new OffscreenCanvas(canvas.width, canvas.height);
  const context = copy.getContext("2d", { willReadFrequently: true });
  context.drawImage(canvas, 0, 0);
  const { data } = context.getImageData(0, 0, canvas.width, canvas.height);
  let [full, sum] = [0, 0];
  for (const [k, one] of data.entries()) {
    if (k % 4 === 3 && one > 0) full += 1;
    sum = (31 * sum + one) | 0;
  }
  return [full, sum];
}"""


class Gallery:
    """The open gallery of a window."""

    def __init__(self, one: Studio) -> None:
        self.one = one
        one.page.locator("#gallery").click()

    def shown(self) -> list[str]:
        found: list[str] = self.one.call(
            "[...document.querySelectorAll('[data-example]')].map(x => x.dataset.example)"
        )
        return found

    def card(self, name: str) -> "sync_api.Locator":
        return self.one.page.locator(f"[data-example={name}]")

    def picture(self, name: str) -> tuple[int, int]:
        """The number of painted pixels, and a checksum of the picture."""
        pixels, checksum = self.one.call(PICTURE, name)
        return pixels, checksum

    def drawn(self, name: str) -> int:
        """The picture, once it is drawn."""
        self.card(name).scroll_into_view_if_needed()
        for _ in range(500):
            pixels, found = self.picture(name)
            if pixels > 300:
                return found
            self.one.page.wait_for_timeout(20)
        pytest.fail(f"{name} has no picture")

    def moves(self, name: str, seconds: float = 20.0) -> bool:
        """Whether the picture changes several times."""
        seen = {self.picture(name)[1]}
        for _ in range(round(seconds * 20)):
            self.one.page.wait_for_timeout(50)
            seen.add(self.picture(name)[1])
            if len(seen) > 3:
                return True
        return False


@pytest.fixture
def gallery(studio: Opener) -> Iterator[Gallery]:
    one = studio()
    yield Gallery(one)
    if one.page.locator("dialog").count():
        one.page.keyboard.press("Escape")


def test_the_gallery_has_sixty_mechanisms_in_thirteen_families(gallery: Gallery) -> None:
    assert gallery.shown() == NAMES
    assert len(NAMES) >= 60
    assert len(FAMILIES) == 13
    for page in ("README.md", "docs/studio.md"):
        assert f" shows {len(NAMES)} mechanisms" in (ROOT / page).read_text("utf-8"), page
    # a card out of view has texts, but no lines
    name, sentence = (
        gallery.card("hart").locator(part).text_content() for part in ("strong", "span")
    )
    assert name == "Hart's inversor"
    assert str(sentence).startswith("Four crossed bars")


def test_a_search_finds_words_of_names_sentences_and_families(gallery: Gallery) -> None:
    field = gallery.one.page.locator("#gallery-search")
    for words, found in {
        "straight": {"hart", "chebyshev", "peaucellier"},
        "LINE straight": {"hart", "roberts"},
        "cam roller": {"cam_roller"},
        "toys": set(FAMILIES["Toys"]),
    }.items():
        field.fill(words)
        assert found <= set(gallery.shown()), words
        assert len(gallery.shown()) < 20
    field.fill("no such thing")
    assert gallery.shown() == []
    assert gallery.one.page.locator("dialog [role=status]").inner_text() == "0 mechanisms"


@pytest.mark.parametrize("family", some(list(FAMILIES), 3))
def test_a_family_is_chosen_by_a_click_and_left_by_another(gallery: Gallery, family: str) -> None:
    chip = gallery.one.page.locator(".families").get_by_role("button", name=family, exact=True)
    chip.click()
    assert gallery.shown() == FAMILIES[family]
    assert chip.get_attribute("aria-pressed") == "true"
    chip.click()
    assert gallery.shown() == NAMES


@pytest.mark.parametrize("name", some(NAMES, 4))
def test_a_picture_is_drawn_and_moves_under_the_pointer(gallery: Gallery, name: str) -> None:
    rest = gallery.drawn(name)
    gallery.card(name).hover()
    assert gallery.moves(name), name
    gallery.one.page.locator("#gallery-search").hover()
    gallery.one.page.wait_for_timeout(150)
    assert gallery.picture(name)[1] == rest


def test_a_picture_moves_with_the_focus(gallery: Gallery) -> None:
    gallery.drawn("four_bar")
    gallery.one.page.locator(".families button").last.focus()
    gallery.one.page.keyboard.press("Tab")
    focused = gallery.one.call("document.activeElement.dataset.example")
    assert focused == NAMES[0]
    assert gallery.moves(focused)
    gallery.one.page.keyboard.press("Enter")
    gallery.one.settle()
    assert gallery.one.page.locator("dialog").count() == 0
    assert "Four-bar" in gallery.one.page.locator("h1").inner_text()


def test_only_pictures_in_view_are_drawn(gallery: Gallery) -> None:
    gallery.drawn(NAMES[0])
    gallery.one.page.wait_for_timeout(400)
    assert gallery.picture(NAMES[-1])[0] == 0
    gallery.drawn(NAMES[-1])


@pytest.mark.parametrize("name", ["hart", "gripper", "pendulum"])
def test_a_click_opens_the_case_and_undo_brings_the_former_back(
    gallery: Gallery, name: str
) -> None:
    before = gallery.one.toml()
    gallery.card(name).click()
    gallery.one.settle()
    classic = ROOT / "examples" / "classics" / f"{name}.toml"
    path = classic if classic.exists() else ROOT / "examples" / f"{name}.toml"
    assert gallery.one.toml() == path.read_text("utf-8")
    gallery.one.page.locator("#undo").click()
    gallery.one.settle()
    assert gallery.one.toml() == before


def test_the_pictures_leave_the_sheet_alone(gallery: Gallery) -> None:
    before = gallery.one.state()
    gallery.drawn("hart")
    gallery.card("hart").hover()
    assert gallery.moves("hart")
    assert gallery.one.state() == before


def test_reduced_motion_keeps_the_pictures_still(fresh: Opener) -> None:
    gallery = Gallery(fresh(reduced_motion="reduce"))
    gallery.drawn("hart")
    gallery.card("hart").hover()
    assert not gallery.moves("hart", 1.0)


@pytest.mark.parametrize("width", [320, 640, 1280])
def test_the_gallery_fits_narrow_windows(fresh: Opener, width: int) -> None:
    one = fresh(width=width, height=700)
    gallery = Gallery(one)
    gallery.drawn(NAMES[0])
    wide, inner = one.call(
        "(x => [x.scrollWidth, x.clientWidth])(document.querySelector('dialog'))"
    )
    assert wide <= inner
    cut = one.call(
        "[...document.querySelectorAll('.gallery button')]"
        ".filter(x => x.scrollWidth > x.clientWidth + 1 || x.scrollHeight > x.clientHeight + 1)"
        ".map(x => x.dataset.example)"
    )
    assert cut == []


def positions(one: Studio, count: int) -> list[list[float]]:
    found = []
    for _ in range(count):
        found.append(one.state()["q"])
        one.page.wait_for_timeout(120)
    return found


@pytest.mark.usefixtures("built")
def test_the_first_visit_opens_on_a_mechanism_that_moves(
    browser: "sync_api.Browser",
) -> None:
    one = opened(browser, first=True, viewport={"width": 1280, "height": 800})
    one.wait("document.querySelector('#greeting') !== null")
    assert "Pull at a foot" in one.page.locator("#greeting").inner_text()
    for _ in range(3):  # a busy machine may draw no frame for a while
        one.call("kempe.state().then(state => { window.before = `${state.q}` })")
        one.wait("kempe.state().then(state => `${state.q}` !== window.before)")
    # a foot that is held slows the crank down, until it is let go
    free = one.quantity("crank.omega")
    one.page.keyboard.press("Space")
    one.settle()
    at = [one.quantity(f"left_foot.F.{axis}") for axis in "xy"]
    one.page.mouse.move(*one.screen(*at))
    one.page.mouse.down()
    one.page.mouse.move(*one.screen(at[0], at[1] + 0.001))
    one.page.keyboard.press("Space")
    one.wait(f"kempe.quantity('crank.omega').then(x => Math.abs(x.value) < {0.5 * free})")
    one.page.mouse.up()
    one.wait(f"kempe.quantity('crank.omega').then(x => x.value > {0.7 * free})")
    one.mode("edit")
    assert one.page.locator("#greeting").count() == 0
    one.page.wait_for_timeout(400)
    one.page.reload()
    one.wait("typeof kempe === 'object' && kempe.state().then(state => state !== null)", 20.0)
    one.settle()  # kept work does not move
    assert one.page.locator("#greeting").count() == 0
    again = one.page.context.new_page()
    again.goto(one.page.url)
    two = Studio(again)
    two.wait("typeof kempe === 'object' && kempe.state().then(state => state !== null)", 20.0)
    two.settle()
    assert "Four-bar" in again.locator("h1").inner_text()
    assert one.messages == []
    one.page.context.close()


def test_the_first_visit_by_a_link_shows_the_link(
    studio: Opener, browser: "sync_api.Browser"
) -> None:
    one = studio()
    one.page.locator("#share").click()
    address = one.page.locator("#link").input_value()
    one.page.keyboard.press("Escape")
    two = opened(browser, "#" + address.split("#")[1], first=True)
    two.settle()
    assert two.page.locator("#greeting").count() == 0
    assert two.toml() == one.toml()
    two.page.context.close()


@pytest.mark.usefixtures("built")
def test_with_reduced_motion_the_first_visit_waits_for_play(
    browser: "sync_api.Browser",
) -> None:
    one = opened(browser, first=True, reduced_motion="reduce")
    one.settle()
    assert one.page.locator("#greeting").count() == 1
    first, second = positions(one, 2)
    assert first == second
    one.page.context.close()
