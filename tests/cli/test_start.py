"""The command line without a command: version, help, wrong arguments, errors and exit codes."""

import kempe
import pytest
from kempe import errors
from kempe.cli import app, exit_codes, main


@pytest.mark.parametrize("words", [["--version"], ["-V"], ["-V", "--version"]])
def test_the_version_is_printed(words: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert main(words) == exit_codes.OK
    assert capsys.readouterr() == (f"kempe {kempe.__version__}\n", "")


def test_help_describes_kempe(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["--help"]) == exit_codes.OK
    assert "Planar multibody mechanics" in capsys.readouterr().out


@pytest.mark.parametrize("words", [["--nonsense"], ["nonsense"]])
def test_wrong_arguments_are_bad_input(
    words: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(words) == exit_codes.BAD_INPUT
    output = capsys.readouterr()
    assert output.out == ""
    assert "nonsense" in output.err


@pytest.mark.parametrize(
    ("kind", "code"),
    [
        (errors.ModelError, exit_codes.BAD_INPUT),
        (errors.AssemblyError, exit_codes.MECHANICS),
        (errors.RedundancyError, exit_codes.MECHANICS),
        (errors.SingularityError, exit_codes.MECHANICS),
        (errors.IntegrationError, exit_codes.MECHANICS),
        (errors.FileError, exit_codes.BAD_INPUT),  # it can be read, but it has problems
        (errors.InternalError, exit_codes.INTERNAL),
    ],
)
def test_an_error_is_printed_without_a_traceback(
    kind: type[errors.KempeError],
    code: int,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    problem = errors.Problem("must be [> 0]", "bodies.crank.mass", 7, 8)

    def fail(**_: object) -> None:
        raise kind("it cannot be", hint="change it", problems=(problem,))

    monkeypatch.setattr(app, "app", fail)
    assert main(["run"]) == code
    assert capsys.readouterr() == (
        "",
        "error: it cannot be; change it\n  bodies.crank.mass: must be [> 0] (line 7, column 8)\n",
    )


def test_a_file_error_has_its_own_code() -> None:
    assert app.exit_code(errors.FileError("no such file")) == exit_codes.FILE
