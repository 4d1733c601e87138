"""The documentation is correct: every block runs, every link has a target."""

import shutil
from pathlib import Path

import kempe as kp
import pytest
from docs.comparison import agrees
from docs.pages import PAGES, anchors, blocks, links
from docs.reader import Reader
from docs.test_tutorial_figures import check_figures
from house.places import ROOT
from kempe import _compact, _core, _reference
from sizes import only_full

from tools import tutorial_figures

#: Languages of blocks. The tests do not run `sh` blocks, which contain installations and `./test`.
LANGUAGES = {"python", "console", "text", "toml", "json", "sh", "math", ""}


#: Pages whose runs take five seconds and more. What they show is tested in tests/cams, tests/fits,
#: tests/sweeps, tests/design_problems, tests/lab_report and tests/truth.
LONG = {
    "docs/beams.md",
    "docs/optimization.md",
    "docs/report.md",
    "docs/sweeps.md",
    "docs/tutorials/filling_machine.md",
    "docs/tutorials/geneva_drive.md",
    "docs/tutorials/gripper.md",
    "docs/tutorials/spring_choice.md",
    "docs/tutorials/test_rig.md",
}


def page_name(page: Path) -> str:
    return page.relative_to(ROOT).as_posix()


def sized(page: Path) -> object:
    """A page, to be run only in full size if its runs take long."""
    return pytest.param(page, marks=only_full) if page_name(page) in LONG else page


@pytest.mark.parametrize("page", [sized(page) for page in PAGES], ids=page_name)
def test_the_blocks_of_a_page_run(
    page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    shutil.copytree(ROOT / "examples", tmp_path / "examples")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("NO_COLOR", "1")
    reader = Reader(page)
    for block in blocks(page.read_text("utf-8")):
        assert block.language in LANGUAGES, f"{page.name}, line {block.line}"
        reader.follow(block)
    if page.parent == tutorial_figures.PAGES and page.stem in tutorial_figures.tutorials():
        check_figures(page.stem, tmp_path)


@pytest.mark.parametrize("page", PAGES, ids=page_name)
def test_links_have_targets(page: Path) -> None:
    for link in links(page.read_text("utf-8")):
        name, _, anchor = link.partition("#")
        target = page.parent / name if name else page
        assert target.exists(), link
        assert not anchor or anchor in anchors(target), link


def test_every_page_is_in_the_index() -> None:
    index = set(links((ROOT / "docs" / "README.md").read_text("utf-8")))
    docs = ROOT / "docs"
    pages = {page.relative_to(docs) for page in docs.rglob("*.md")} - {Path("README.md")}
    # a page also counts as listed if the README of its folder is listed
    listed = {page for page in pages if {page.as_posix(), f"{page.parent}/README.md"} & index}
    assert pages == listed


def test_the_reference_matches_the_catalogue() -> None:
    for target, text in (
        (_reference.TARGET, _reference.page),
        (_reference.ELEMENTS, _reference.elements),
        (_compact.INDEX, _compact.index),
        (_compact.TARGET, _compact.page),
    ):
        assert text(_core.catalogue()) == target.read_text("utf-8"), "run python -m kempe._generate"


@pytest.mark.parametrize(
    ("shown", "output", "same"),
    [
        ("a  1.0000 m", "a 1.0001 m", True),
        ("a 1.000 m", "a 1.01 m", False),
        ("short by 3.516 m", "short by 3.518 m", False),
        ("24932.1 N", "24932.2 N", True),
        ("24932.1 N", "24932.5 N", False),
        ("1501 outputs", "1502 outputs", False),
        ("4.36e-07 m", "4.37e-07 m", False),
        ("a 1 m", "b 1 m", False),
        ("-1", "1", False),
        ("≈1328 steps", "≈1331 steps", True),
        ("≈1328 steps", "≈1400 steps", False),
        ("1328 steps", "1331 steps", False),
        ("1e-3", "0.001", True),
        ("first\n…\nlast", "first\n2\n3\nlast", True),
        ("first\n…\nlast", "first\nlast", True),
        ("first\n…\nlast", "first\n2\n3", False),
        ("in … s", "in 0.3 s", True),
        ("in … s", "in 0.3 ms\n", False),
        ("joint D2 at 2", "joint D3 at 2", False),
        ("(a+b)", "(a+b)", True),
    ],
)
def test_outputs_are_compared(shown: str, output: str, same: bool) -> None:
    assert agrees(shown, output) is same


def test_the_page_of_errors_quotes_the_hint_of_internal_errors() -> None:
    _core._inject_panic("version")
    try:
        with pytest.raises(kp.InternalError) as caught:
            _core.version()
    finally:
        _core._inject_panic(None)
    page = " ".join((ROOT / "docs" / "errors.md").read_text("utf-8").split())
    assert caught.value.hint
    assert f'"{caught.value.hint}"' in page


def test_every_class_of_errors_has_its_heading() -> None:
    classes = {name for name in dir(kp) if name.endswith("Error") and name != "KempeError"}
    page = (ROOT / "docs" / "errors.md").read_text("utf-8")
    assert classes == {name for name in classes if f"\n## {name}\n" in page}
