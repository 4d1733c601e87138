"""Arguments that the commands share: the case and the changes to it."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from enum import Enum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from kempe.errors import FileError, ModelError

if TYPE_CHECKING:
    from kempe.case import Case
    from kempe.results.state import State

#: In place of a file: standard input.
STDIN = "-"


class Method(str, Enum):
    """The methods of integration; must agree with the classes in ``kempe.analyses.options``."""

    auto = "auto"
    rk45 = "rk45"
    dop853 = "dop853"
    rk4 = "rk4"
    generalized_alpha = "generalized_alpha"
    hht = "hht"
    radau = "radau"


File = Annotated[
    Path,
    typer.Argument(metavar="FILE", help="Case file (TOML or JSON); - reads standard input."),
]
Settings = Annotated[
    list[str] | None,
    typer.Option(
        "--set",
        metavar="NAME=VALUE",
        help="Set a parameter (k=2e6) or a coordinate or rate at the start (crank.angle=80*deg); "
        "can be repeated.",
    ),
]
EndTime = Annotated[
    str | None, typer.Option("--t-end", metavar="SECONDS", help="End time of the last analysis, s.")
]
MethodName = Annotated[
    Method | None, typer.Option("--method", help="Method of integration of all analyses.")
]
RelativeTolerance = Annotated[
    float | None, typer.Option("--rtol", help="Relative tolerance of a step.")
]
AbsoluteTolerance = Annotated[
    float | None, typer.Option("--atol", help="Absolute tolerance of a step.")
]
Step = Annotated[
    float | None,
    typer.Option(
        "--step", metavar="SECONDS", help="Constant step, s, without control of the error."
    ),
]
Units = Annotated[
    str | None,
    typer.Option(
        "--units",
        metavar="UNIT,…",
        help="Units of tables, figures and CSV files, such as mm,deg,rpm; JSON and npz files are "
        "in SI units and rad.",
    ),
]
Folder = Annotated[
    Path | None,
    typer.Option("--output", "-o", help="Folder for results; default out/<FILE>/<COMMAND>."),
]
AsJson = Annotated[bool, typer.Option("--json", help="Print only the result, as JSON.")]


@dataclass(frozen=True)
class Changes:
    """The changes of the command line to a case.

    Attributes:
        settings: the texts NAME=VALUE.
        t_end: end of the last analysis, a number or a formula.
        method: method of integration; None keeps that of each analysis.
        rtol: relative tolerance; None keeps it.
        atol: absolute tolerance; None keeps it.
        step: constant step, s; None keeps it.
    """

    settings: list[str] | None = None
    t_end: str | None = None
    method: Method | None = None
    rtol: float | None = None
    atol: float | None = None
    step: float | None = None

    def __bool__(self) -> bool:
        return any(vars(self).values())

    def applied(self, case: Case) -> Case:
        """The case with the changes of its analyses."""
        for name in _having("method", case):
            old = case.analyses[name].get("method", {"type": Method.auto.value})
            method = self._method(old)
            if method is not None:
                case = case.with_analysis(name, method=method)
        ending = _having("t_end", case)
        if self.t_end is not None and ending:
            case = case.with_analysis(ending[-1], t_end=number_or_formula(self.t_end))
        return case

    def of_type(self, case: Case, kind: str) -> Case:
        """The case with the analyses of one type; if it has none, one from the start is added."""
        from kempe.analyses.option import Analysis

        end = {} if self.t_end is None else {"t_end": number_or_formula(self.t_end)}
        fields = next(each.shapes for each in Analysis.__subclasses__() if each.kind == kind)
        return case.of_type(kind, {key: end[key] for key in end if key in fields})

    def _method(self, old: dict[str, Any]) -> dict[str, Any] | None:
        """The changed method of an analysis; None if it does not change.

        Another method keeps the tolerances if it has tolerances.
        """
        names = ("rtol", "atol", "step")
        given = {name: getattr(self, name) for name in names if getattr(self, name) is not None}
        if self.method is None:
            return {**old, **given} if given else None
        if self.method.value == old["type"]:
            return {**old, **given}
        known = _fields(self.method)
        kept = {key: old[key] for key in old if key in ("rtol", "atol") and key in known}
        return {"type": self.method.value, **kept, **given}


def _having(field: str, case: Case) -> list[str]:
    """The names of the analyses that have a field."""
    from kempe.analyses.option import Analysis

    kinds = {each.kind for each in Analysis.__subclasses__() if field in each.shapes}
    return [name for name, entry in case.analyses.items() if entry["type"] in kinds]


def _fields(method: Method) -> set[str]:
    from kempe.analyses.option import Option

    for kind in Option.__subclasses__():
        if kind.kind == method.value:
            return set(kind.shapes)
    return set()


@contextmanager
def shown_in(names: str | None) -> Iterator[None]:
    """Show numbers in display units in the block.

    Args:
        names: the argument of ``--units``; None for SI units.

    Raises:
        ModelError: a unit is unknown.
    """
    from kempe.base.display_units import units

    with units("SI" if names is None else names):
        yield


def read_case(file: Path, changes: Changes, kind: str | None = None) -> Case:
    """The case from a file or from standard input, with the changes of the command line.

    Args:
        file: the file.
        changes: the changes.
        kind: type of the analyses to which the case is reduced; all if None.
    """
    from kempe.case import parsed
    from kempe.loading import load

    pairs = dict(map(setting, changes.settings or []))
    start = {name: value for name, value in pairs.items() if "." in name}
    parameters = {name: value for name, value in pairs.items() if "." not in name}
    if str(file) == STDIN:
        text = _standard_input()
        form = "json" if text.lstrip().startswith("{") else "toml"
        case = parsed(text, form, "standard input", parameters)
    else:
        case = load(file, parameters=parameters)
    _refuse_fields(case, start)
    case = case.with_start(start) if start else case
    return changes.applied(case if kind is None else changes.of_type(case, kind))


def _refuse_fields(case: Case, start: dict[str, float | str]) -> None:
    """Refuse a field of an element, such as ``rod.mass``, with the remedy."""
    tree = case.model.tree()
    for path, value in start.items():
        name, _, field = path.rpartition(".")
        for section in ("bodies", "joints", "drivers", "forces"):
            if field in tree.get(section, {}).get(name, {}):
                raise ModelError(
                    f"--set {path}: a field of {section}.{name} cannot be set",
                    hint=f'make it a parameter: {field} = "p" in the file, with p in [parameters], '
                    f"then --set p={value}",
                )


def _standard_input() -> str:
    from kempe.base import files

    if sys.stdin is None:
        raise FileError("cannot read standard input: it is closed", hint="name a file")
    return files.decoded(sys.stdin.buffer.read(files.LARGEST_TEXT + 1), "standard input")


def stem(file: Path) -> str:
    """The name of a case in the names of files."""
    return "stdin" if str(file) == STDIN else file.stem


def setting(text: str) -> tuple[str, float | str]:
    """``k=2e6`` → ("k", 2e6); a value that is not a number is a formula.

    Raises:
        ModelError: the name or the value is missing.
    """
    name, _, value = (part.strip() for part in text.partition("="))
    if not name or not value:
        raise ModelError(f"--set {text}: must be NAME=VALUE, such as --set k=2e6")
    return name, number_or_formula(value)


def number_or_formula(text: str) -> float | str:
    """The number in a word of the command line, or the word if it is not a number."""
    try:
        return float(text)
    except ValueError:
        return text


def assembled(case: Case) -> State:
    """The assembled mechanism; its warnings are printed with the report."""
    import warnings

    from kempe.analyses.record import AssemblyWarning

    with warnings.catch_warnings():
        warnings.simplefilter("ignore", AssemblyWarning)
        return case.start()
