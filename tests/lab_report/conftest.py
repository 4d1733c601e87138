"""Reports of examples, each written once."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import kempe as kp
import pytest
from house.places import ROOT
from kempe.lab_report.write import page
from lab_report.pages import Page


@dataclass(frozen=True)
class Reported:
    """A case with its results, and its report."""

    case: kp.Case
    results: kp.Results
    page: Page
    text: str


@cache
def _reported(name: str) -> Reported:
    file: Path = ROOT / "examples" / f"{name}.toml"
    case = kp.load(file)
    with_study = name == "four_bar"
    text = page(case, kp.study(case) if with_study else None, file.read_text("utf-8"))
    return Reported(case, case.run(), Page(text), text)


@pytest.fixture(scope="session")
def reported() -> Callable[[str], Reported]:
    """The report of an example by its name; that of the four-bar has a study."""
    return _reported
