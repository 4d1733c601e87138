"""ARCHITECTURE.md has at most three pages; all paths on the pages about the code exist."""

import re
from pathlib import Path

import pytest
from house.places import ROOT

#: A word in backticks is a path when it has a slash or one of these endings.
ENDINGS = (".rs", ".py", ".pyi", ".md", ".toml", ".sh", ".json", ".txt", ".html", ".js")

PAGES = ("ARCHITECTURE.md", "docs/internals/analyses.md", "docs/internals/decisions.md")
WORDS_ON_A_PAGE = 500


def paths_in(text: str) -> list[str]:
    prose = re.sub(r"^```.*?^```", "", text, flags=re.DOTALL | re.MULTILINE)
    words = re.findall(r"`([^`\s]+)`", prose)
    return [word for word in words if "://" not in word and ("/" in word or word.endswith(ENDINGS))]


def missing(text: str, root: Path) -> list[str]:
    """Paths that do not exist; `core/src/integrate/*.rs` must match a file."""
    return [
        path for path in paths_in(text) if not any(root.glob(path.rstrip("/").removeprefix("./")))
    ]


@pytest.mark.parametrize("page", PAGES)
def test_every_path_on_a_page_about_the_code_exists(page: str) -> None:
    text = (ROOT / page).read_text(encoding="utf-8")
    assert paths_in(text), f"{page} contains no path"
    assert missing(text, ROOT) == []


def test_the_architecture_has_at_most_three_pages() -> None:
    text = (ROOT / "ARCHITECTURE.md").read_text(encoding="utf-8")
    assert len(text.split()) <= 3 * WORDS_ON_A_PAGE


@pytest.mark.parametrize(
    ("text", "gone"),
    [
        ("`a/here.rs` and `./here.md`, in `a/`", []),
        ("`a/gone.rs`, `a/*.rs`, `a/*.py`", ["a/gone.rs", "a/*.py"]),
        (
            "`gone.md`, but `kempe --version`, `Model` and `https://kempe.example/x` are not paths",
            ["gone.md"],
        ),
        ("```\n`a/gone.rs`\n```\n", []),
    ],
)
def test_a_missing_path_is_found(text: str, gone: list[str], tmp_path: Path) -> None:
    (tmp_path / "a").mkdir()
    (tmp_path / "a" / "here.rs").touch()
    (tmp_path / "here.md").touch()
    assert missing(text, tmp_path) == gone
