"""The report of an analysis as one file: HTML, or PDF printed by a browser."""

from __future__ import annotations

import datetime
import re
from collections.abc import Mapping
from importlib import resources
from pathlib import Path
from typing import TYPE_CHECKING, Any

from kempe._version import __version__
from kempe.base import files
from kempe.base.arguments import explained
from kempe.case import Case
from kempe.errors import FileError, ModelError
from kempe.lab_report import subject as subjects
from kempe.lab_report.blocks import Listing, Section
from kempe.lab_report.browser import find_browser, print_pdf
from kempe.lab_report.data import data, mechanism
from kempe.lab_report.initial import initial
from kempe.lab_report.joints import joints
from kempe.lab_report.method import method
from kempe.lab_report.motion import motion
from kempe.lab_report.other import of_study, other
from kempe.lab_report.subject import Subject
from kempe.lab_report.summary import at_a_glance
from kempe.results.solution import Solution

if TYPE_CHECKING:
    from markupsafe import Markup

    from kempe.results.result import Result
    from kempe.sweeps.studies import Study

#: Endings of the name of a report.
ENDINGS = (".html", ".pdf")
_SUBSCRIPT = re.compile(r"Φ_(\w)")


@explained
def write_report(
    case: Case | Solution,
    path: Path | str,
    *,
    study: Study | None = None,
    listing: str | None = None,
) -> Path:
    """Write the report of an analysis: model, equations, start, method, results, accuracy.

    The page is one file that needs no network. A PDF is printed from it by Chromium, Chrome or
    Edge, which ``$CHROMIUM`` may name. Numbers have the display units (``kp.units``).

    Args:
        case: a case, whose analyses are run; or a solution, which is not computed again.
        path: the file; its ending, .html or .pdf, selects the format.
        study: a study of an analysis of the case, ``kp.study(case)``, which is included.
        listing: the text of the model file; by default the case as ``case.save`` writes it.

    Returns:
        The path.

    Raises:
        ModelError: the case has no analysis, or is neither a case nor a solution.
        FileError: the file cannot be written, or there is no browser for a PDF.
        KempeError: an analysis fails.
    """
    target = checked(path)
    store(page(case, study, listing), target)
    return target


def checked(path: Path | str) -> Path:
    """The path of a report; an unusable path is reported before an analysis is run.

    Raises:
        FileError: the ending is another one, or there is no browser for a PDF.
    """
    target = files.checked_path(path, "write")
    if target.suffix.lower() not in ENDINGS:
        raise FileError(
            f"cannot write {path}: the name must end in {' or '.join(ENDINGS)}",
            name=str(path),
            hint="name it report.html",
        )
    if target.suffix.lower() == ".pdf":
        find_browser()
    return target


def store(text: str, path: Path) -> None:
    """Write the text of a page, as HTML or as PDF by the ending of the name.

    Raises:
        FileError: the file cannot be written.
    """
    if path.suffix.lower() == ".pdf":
        print_pdf(text, path)
    else:
        files.write_text(path, text)


def page(case: Case | Solution, study: Study | None, listing: str | None) -> str:
    """The text of the page; see ``write_report``."""
    if isinstance(case, Case):
        return typeset(subjects.of_case(case, listing, study))
    if isinstance(case, Solution):
        return typeset(subjects.of_solution(case, listing, study))
    raise ModelError(f"{case!r} is neither a case nor a solution", hint="kp.load reads a case")


def typeset(found: Subject) -> str:
    """The page of a subject."""
    from jinja2 import Environment, PackageLoader

    environment = Environment(
        loader=PackageLoader("kempe.lab_report", "assets"),
        autoescape=True,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters["subscripts"] = subscripts
    style = (resources.files("kempe.lab_report") / "assets" / "report.css").read_text("utf-8")
    about: Mapping[str, Any] = {
        "title": found.model.title or "Linkage",
        "date": datetime.datetime.now(datetime.timezone.utc).date().isoformat(),
        "version": __version__,
        "style": style,
        "sections": _sections(found),
    }
    return environment.get_template("report.html").render(about)


def subscripts(text: str) -> Markup:
    """A text as HTML, with the letter after ``Φ_`` as a subscript."""
    from markupsafe import Markup, escape

    return Markup(_SUBSCRIPT.sub(r"Φ<sub>\1</sub>", str(escape(text))))


def _sections(found: Subject) -> list[Section]:
    """All sections that have content."""
    sections = [
        at_a_glance(found),
        mechanism(found),
        data(found),
        joints(found),
        initial(found),
        method(found),
        *(_result(name, result) for name, result in found.results.items()),
        of_study(found.study),
        Section("Model file", [Listing(found.listing)]),
    ]
    return [kept for section in sections if (kept := section.kept()) is not None]


def _result(name: str, result: Solution | Result) -> Section:
    return motion(name, result) if isinstance(result, Solution) else other(name, result)
