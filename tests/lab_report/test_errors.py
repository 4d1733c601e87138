"""Bad input to ``kempe report`` gives an error of the closed set, with a remedy."""

from pathlib import Path

import kempe as kp
import pytest
from house.places import ROOT
from kempe.cli import main
from kempe.lab_report.browser import find_browser, print_pdf

FOUR_BAR = str(ROOT / "examples" / "four_bar.toml")


@pytest.fixture(autouse=True)
def _in_a_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


@pytest.fixture
def no_browser(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.delenv("CHROMIUM", raising=False)


@pytest.mark.parametrize(
    ("words", "code", "told"),
    [
        (["missing.toml"], 4, "cannot read missing.toml"),
        (["empty.toml"], 2, "empty.toml contains no analysis; add one, as [analyses.release]"),
        ([FOUR_BAR, "-o", "report.doc"], 4, "must end in .html or .pdf; name it report.html"),
        ([FOUR_BAR, "-o", "empty.toml/report.html", "--t-end", "0.01"], 4, "cannot write"),
        ([FOUR_BAR, "--set", "q=2"], 2, "there is no parameter 'q' to set"),
        (["missing.npz", "--study"], 2, "--study applies to a case"),
        (["broken.npz"], 4, "cannot read broken.npz"),
    ],
)
def test_bad_words_give_a_clear_error(
    words: list[str], code: int, told: str, capsys: pytest.CaptureFixture[str]
) -> None:
    Path("empty.toml").write_text('kempe = 1\n[bodies.a]\ntype = "point_mass"\nmass = 1\n')
    Path("broken.npz").write_bytes(b"no archive")
    assert main(["report", *words]) == code
    error = capsys.readouterr().err
    assert told in " ".join(error.split())
    assert "Traceback" not in error


@pytest.mark.usefixtures("no_browser")
def test_a_pdf_without_a_browser_is_refused_before_the_run(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert main(["report", FOUR_BAR, "--pdf", "-o", "report.html"]) == 4
    error = " ".join(capsys.readouterr().err.split())
    assert "a PDF needs a browser, which was not found; install Chromium" in error
    assert "write the report as .html" in error
    assert not Path("report.html").exists()


@pytest.mark.usefixtures("no_browser")
def test_a_browser_that_is_none_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("CHROMIUM", "nothing-here")
    with pytest.raises(kp.FileError, match="names nothing-here, which is not a program"):
        find_browser()


def test_a_browser_that_fails_leaves_no_file(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("CHROMIUM", "/bin/false")
    with pytest.raises(kp.FileError, match=r"cannot write report\.pdf: /bin/false failed"):
        print_pdf("<p>text</p>", Path("report.pdf"))
    assert not list(Path().iterdir())


def test_something_else_than_a_case_is_refused() -> None:
    model = kp.Model("none")
    with pytest.raises(kp.ModelError, match="is neither a case nor a solution"):
        kp.write_report(model, "report.html")  # type: ignore[arg-type]
    with pytest.raises(kp.ModelError, match="the case contains no analysis"):
        kp.write_report(kp.Case(model), "report.html")
