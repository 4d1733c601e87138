"""Cases from files: those of kempe, and those of other tools."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from kempe import foreign
from kempe.base import files
from kempe.base.arguments import explained
from kempe.case import FORMATS, Case, format_of, parsed
from kempe.errors import FileError
from kempe.mjcf.reader import read as read_mjcf
from kempe.model.values import Number

#: Readers of formats in Python.
_READERS = {"mjcf": read_mjcf}
#: Endings that `kempe convert` writes by other functions.
_OTHERS = (".asmt", ".dxf", ".fmu", ".xml")


@explained
def load(
    path: Path | str,
    *,
    parameters: Mapping[str, Number] | None = None,
    partial: bool = False,
    form: str | None = None,
) -> Case:
    """Read a case from a file of kempe or of another tool.

    The ending of the name gives the format: ``.toml`` and ``.json`` are those of kempe, and
    docs/exchange.md lists the others. Without a known ending, the first lines of the file decide.

    Args:
        path: the file.
        parameters: other values for some of its parameters.
        partial: whether what has no equal in kempe is left out of a file of another tool and listed
            in ``case.unread``; otherwise it is an error.
        form: the format in place of the ending, such as "asmt".

    Raises:
        FileError: the file cannot be read, is not a case, or contains what has no equal in kempe;
            the error contains all ``problems``.
        ModelError: the model is invalid; the error contains all ``problems``, each with line and
            column.
    """
    own = f".{form}" if form else files.checked_path(path, "read").suffix.lower()
    if own not in FORMATS:
        chosen = form or foreign.format_of(path)
        if chosen is not None:
            return _other(path, chosen, parameters, partial)
    chosen = FORMATS[own] if own in FORMATS else format_of(path, "read")
    return parsed(files.read_text(path), chosen, str(path), parameters, Path(path).parent)


def _other(
    path: Path | str, form: str, parameters: Mapping[str, Number] | None, partial: bool
) -> Case:
    """The case of another tool."""
    found = foreign.read(path, form, partial, _READERS.get(form))
    try:
        case = parsed(found.case, "json", None, parameters, Path(path).parent)
    except FileError as error:
        error.args = (f"{path}: {error.args[0]}", *error.args[1:])
        raise
    case.unread, case.recorded = found.unread, found.recorded
    return case


def convert(
    path: Path | str, to: Path | str, form: str | None, out: str | None, *, partial: bool
) -> tuple[str, ...]:
    """Write the case in a file in another format; returns what was left out.

    Args:
        path: the file to read.
        to: the file to write.
        form: format of the file to read; its ending or its content if None.
        out: format of the file to write; its ending if None.
        partial: whether what has no equal in kempe is left out.

    Raises:
        FileError, ModelError: as in ``load``, or the file cannot be written in this format.
    """
    case = load(path, partial=partial, form=form)
    ending = f".{out}" if out else files.checked_path(to, "write").suffix.lower()
    if ending not in FORMATS:
        known = ", ".join(name.removeprefix(".") for name in (*FORMATS, *_OTHERS))
        raise FileError(f"cannot write {to}: its format must be one of {known}", name=str(to))
    case.save(to, form=FORMATS[ending])
    return case.unread
