"""All paths in ARCHITECTURE.md exist."""

import re
from pathlib import Path

import pytest
from house.places import ROOT

#: A word in backticks is a path when it has a slash or one of these endings.
ENDINGS = (".rs", ".py", ".pyi", ".md", ".toml", ".sh", ".json", ".txt", ".html", ".js")


def paths_in(text: str) -> list[str]:
    prose = re.sub(r"^```.*?^```", "", text, flags=re.DOTALL | re.MULTILINE)
    words = re.findall(r"`([^`\s]+)`", prose)
    return [word for word in words if "://" not in word and ("/" in word or word.endswith(ENDINGS))]


def missing(text: str, root: Path) -> list[str]:
    """Paths that do not exist; `core/src/integrate/*.rs` must match a file."""
    return [
        path for path in paths_in(text) if not any(root.glob(path.rstrip("/").removeprefix("./")))
    ]


def test_every_path_in_the_architecture_exists() -> None:
    text = (ROOT / "ARCHITECTURE.md").read_text(encoding="utf-8")
    assert paths_in(text), "ARCHITECTURE.md contains no path"
    assert missing(text, ROOT) == []


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
