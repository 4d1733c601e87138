"""Hostile names of everything are text on every page and in every format: no tag, no attribute."""

import warnings
import xml.etree.ElementTree as ET
from pathlib import Path
from typing import Any

import kempe as kp
import pytest
from browser.conftest import Opener, sync_api
from browser.hostile import ATTRIBUTE, HARM, TAG, folder, long, name, text, tree
from kempe.lab_report.write import page as report
from kempe.lab_report.write import store


@pytest.fixture(scope="module")
def case(tmp_path_factory: pytest.TempPathFactory) -> kp.Case:
    path = tmp_path_factory.mktemp("hostile") / "case.json"
    path.write_text(text(), encoding="utf-8")
    return kp.load(path)


@pytest.fixture(scope="module")
def results(case: kp.Case) -> kp.Results:
    return case.run()


@pytest.fixture(scope="module")
def solution(results: kp.Results) -> kp.Solution:
    found = results[0]
    assert isinstance(found, kp.Solution)
    return found


@pytest.fixture(scope="module")
def reported(case: kp.Case) -> str:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)  # names too long for the room of a figure
        return report(case, None, text())


def look(browser: "sync_api.Browser", path: Path) -> tuple[list[str], str]:
    """The harm in a page, and its text; the page must request nothing else."""
    context = browser.new_context()
    requests: list[str] = []
    context.on("request", lambda request: requests.append(request.url))
    page = context.new_page()
    page.goto(path.as_uri())
    found, told = page.evaluate(HARM), page.evaluate("document.documentElement.textContent")
    context.close()
    assert requests == [path.as_uri()]
    return found, told


def names_of(given: dict[str, Any]) -> list[str]:
    """The names of everything in a case."""
    groups = ("joints", "drivers", "forces", "measures", "analyses")
    bodies = {key: of for key, of in given["bodies"].items() if key != "ground"}
    events = given["analyses"][folder("run")]["events"]
    return [key for of in (bodies, events, *(given[group] for group in groups)) for key in of]


def test_harm_is_found(browser: "sync_api.Browser") -> None:
    page = browser.new_page()
    page.set_content(f"<p>{name('body')}</p>")
    assert page.evaluate(HARM) == ["tag in p"]
    page.set_content(f'<p title="{name("body")}"></p>')
    assert page.evaluate(HARM) == ["tag in p"]
    page.set_content(f"<p>{long('force')}</p>")
    assert page.evaluate(HARM) == ["tag in p", "link /x"]
    page.set_content(f"<p title='{folder('run')}'></p>")
    assert page.evaluate(HARM) == ["attribute of p"]
    page.close()


def test_names_are_text_in_a_report(
    reported: str, browser: "sync_api.Browser", tmp_path: Path
) -> None:
    path = tmp_path / "report.html"
    store(reported, path)
    found, told = look(browser, path)
    assert found == []
    missing = [one for one in names_of(tree()) if one not in told]
    assert missing == []
    # formulas contain the names of points as they are
    assert f"{name('crank')}.{name('B')}" in told


def test_names_are_text_in_a_printed_report(
    reported: str, tmp_path: Path, browser: "sync_api.Browser"
) -> None:
    assert browser.is_connected()
    path = tmp_path / "report.pdf"
    store(reported, path)
    printed = path.read_bytes()
    assert printed.startswith(b"%PDF")
    assert b"/URI" not in printed  # a link that leads out of the document
    store('<a href="http://localhost/x">x</a>', path)
    assert b"/URI" in path.read_bytes()


@pytest.mark.parametrize("still", [False, True])
def test_names_are_text_in_the_player(solution: kp.Solution, opened: Opener, still: bool) -> None:
    watched = opened(solution.final if still else solution, 1200, 800)
    assert watched.page.evaluate(HARM) == []
    for option in watched.page.locator(".plot .subject option").all():
        watched.page.locator(".plot .subject").first.select_option(label=option.inner_text())
        watched.settle()
        assert watched.page.evaluate(HARM) == []
    assert still or name("crank") in watched.page.evaluate("document.documentElement.textContent")


def test_names_are_text_in_pictures(
    solution: kp.Solution, browser: "sync_api.Browser", tmp_path: Path
) -> None:
    chosen = [one for one in kp.plot.pages(solution) if one.name in ("mechanism", "initial")]
    chosen += [one for one in kp.plot.pages(solution) if one.name.startswith("measure_")][:1]
    for path in kp.plot.save(chosen, tmp_path, "svg"):
        ET.fromstring(path.read_text("utf-8"))  # it is well-formed
        assert look(browser, path)[0] == []


def test_names_are_text_in_notebooks(
    case: kp.Case, solution: kp.Solution, browser: "sync_api.Browser"
) -> None:
    start = case.start()
    matrix = kp.show(case.model, start, "Phi_q")
    shown = [one._repr_html_() for one in (case, case.model, start, solution, matrix)]
    page = browser.new_page()
    page.set_content("".join(shown))
    assert page.evaluate(HARM) == []
    assert name("pin A") in page.evaluate("document.body.textContent")
    page.close()
    assert not any(f"<{TAG}" in one or f" {ATTRIBUTE}=1>" in one for one in shown)
