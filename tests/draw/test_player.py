"""The page: whole in one file, with no way out and no way in."""

import base64
import hashlib
import json
import re
from html.parser import HTMLParser
from importlib import resources
from pathlib import Path

import kempe as kp
import pytest
from draw.mechanisms import HOSTILE
from kempe.draw.frame import frame_items
from kempe.draw.numbers import rounded_all
from kempe.draw.player import MODULES, page

ASSETS = resources.files("kempe.draw") / "assets"


class Reader(HTMLParser):
    """Elements with their attributes, and the text of scripts, style and title."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.elements: list[tuple[str, dict[str, str | None]]] = []
        self.texts: list[tuple[str, str]] = []
        self._within = ""
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.elements.append((tag, dict(attrs)))
        self._within = tag

    def handle_data(self, data: str) -> None:
        if self._within in ("script", "style", "title"):
            self.texts.append((self._within, data))
        self._within = ""

    def count(self, tag: str) -> int:
        return sum(name == tag for name, _ in self.elements)


@pytest.fixture(scope="module")
def hostile_page(hostile: kp.Solution) -> Reader:
    return Reader(page(kp.scene(hostile, frames=3)))


def test_the_page_is_one_file_with_its_scene_inside(four_bar: kp.Solution, tmp_path: Path) -> None:
    path = kp.player(four_bar, tmp_path / "animation.html")
    assert path == tmp_path / "animation.html"
    read = Reader(path.read_text(encoding="utf-8"))
    data = next(text for tag, text in read.texts if tag == "script")
    shown = kp.scene(four_bar)
    assert json.loads(data) == {**shown, "display": rounded_all(frame_items(shown))}


def test_nothing_is_fetched(four_bar: kp.Solution) -> None:
    text = page(kp.scene(four_bar, frames=3))
    assert not re.findall(r"\b(?:https?|wss?|ftp|file):|//[a-z0-9-]+\.", text)
    for tag, attributes in Reader(text).elements:
        assert "src" not in attributes, tag
        assert attributes.get("href", "data:,") == "data:,"
    assert "url(" not in text
    assert "@import" not in text


def test_the_policy_allows_this_script_and_style_alone(hostile_page: Reader) -> None:
    policy = next(a["content"] for _, a in hostile_page.elements if "http-equiv" in a)
    assert policy is not None
    rules = dict(rule.strip().split(" ", 1) for rule in policy.split(";"))
    assert rules["default-src"] == "'none'"
    assert rules["base-uri"] == rules["form-action"] == "'none'"
    for tag, rule in (("script", "script-src"), ("style", "style-src")):
        text = [text for name, text in hostile_page.texts if name == tag][-1]
        digest = base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()
        assert rules[rule] == f"'sha256-{digest}'"
    assert not [
        name
        for _, a in hostile_page.elements
        for name in a
        if name.startswith("on") or name == "style"
    ]


def test_names_stay_data(hostile_page: Reader, four_bar: kp.Solution) -> None:
    plain = Reader(page(kp.scene(four_bar, frames=3)))
    assert [tag for tag, _ in hostile_page.elements] == [tag for tag, _ in plain.elements]
    data = next(text for tag, text in hostile_page.texts if tag == "script")
    assert not set("<>&\u2028\u2029") & set(data)
    assert data.isascii()
    told = json.loads(data)
    assert told["title"] == HOSTILE["title"]
    assert [joint["name"] for joint in told["joints"]] == [HOSTILE[name] for name in "ABCD"]
    title = "".join(text for tag, text in hostile_page.texts if tag == "title")
    assert title == HOSTILE["title"]


def test_the_modules_are_those_of_the_folder_in_an_order_that_works() -> None:
    texts = {name: (ASSETS / f"{name}.js").read_text(encoding="utf-8") for name in MODULES}
    assert {f"{name}.js" for name in MODULES} == {
        entry.name for entry in ASSETS.iterdir() if entry.name.endswith(".js")
    }
    for place, name in enumerate(MODULES):
        assert set(re.findall(r'from "\./(\w+)\.js"', texts[name])) <= set(MODULES[:place]), name


def test_modules_share_no_name() -> None:
    defined = re.compile(r"^(?:export )?(?:const|let|class|function) (\w+)", re.MULTILINE)
    names = [
        name
        for module in MODULES
        for name in defined.findall((ASSETS / f"{module}.js").read_text(encoding="utf-8"))
    ]
    assert len(names) > 50
    assert sorted(names) == sorted(set(names))


def test_no_script_puts_text_in_as_html_or_runs_it() -> None:
    for name in MODULES:
        text = (ASSETS / f"{name}.js").read_text(encoding="utf-8")
        for danger in (
            "innerHTML",
            "outerHTML",
            "insertAdjacentHTML",
            "document.write",
            "eval(",
            "new Function",
            "fetch(",
            "XMLHttpRequest",
            "WebSocket",
            "import(",
        ):
            assert danger not in text, (name, danger)


def test_a_page_that_cannot_be_written_leaves_the_old_one(
    four_bar: kp.Solution, tmp_path: Path
) -> None:
    (tmp_path / "file").write_text("kept", encoding="utf-8")
    with pytest.raises(kp.FileError):
        kp.player(four_bar, tmp_path / "file" / "animation.html")
    assert (tmp_path / "file").read_text(encoding="utf-8") == "kept"
