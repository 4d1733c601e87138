"""The numbers of the paper are those of its script, and the text has no others."""

import importlib
import re
from pathlib import Path
from types import ModuleType

import pytest
from house.places import ROOT

PAPER = ROOT / "paper"
TEXT = (PAPER / "text.md").read_text("utf-8")
WRITE = "run PYTHONPATH=benchmarks .venv/bin/python -m paper.make"


@pytest.fixture(scope="module")
def make() -> ModuleType:
    return importlib.import_module("paper.make")


def test_the_paper_has_the_numbers_of_the_script(make: ModuleType) -> None:
    assert make.paper() == (PAPER / "paper.md").read_text("utf-8"), WRITE


def test_the_text_has_no_number_of_its_own() -> None:
    body = TEXT.split("\n---\n", 1)[1]
    body = re.sub(r"`[^`]*`|\{\w+\}|\$[^$]*\$", "", body)
    assert re.findall(r"\d[\d.]*", body.replace("Apache-2.0", "")) == []


def test_each_number_of_the_script_is_used(make: ModuleType) -> None:
    unused = set(make.numbers()) - set(re.findall(r"\{(\w+)\}", TEXT))
    assert unused == set()


def test_each_source_is_listed_and_cited() -> None:
    cited = set(re.findall(r"@(\w+)", TEXT.split("\n---\n", 1)[1]))
    assert cited == set(
        re.findall(r"^@\w+\{(\w+),", (PAPER / "paper.bib").read_text("utf-8"), re.M)
    )


def test_the_paper_has_four_pages() -> None:
    """Some 450 words are a page."""
    words = len(re.findall(r"[A-Za-z]+", TEXT))
    assert 1200 < words < 2000


def test_files_that_the_paper_names_exist() -> None:
    names = re.findall(r"`((?:paper|examples)/[\w./]+)`", TEXT)
    assert names and all(Path(ROOT / name).is_file() for name in names)
