"""The reasons of rows that failed: one line each, without places in files, with gaps in metres."""

from __future__ import annotations

import re
from decimal import Decimal
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from kempe.model.model import Model

#: A line of a file in a message, and the line with carets below it.
_EXCERPT = re.compile(r"^ +\d* \| ")
#: A place in a file, which a worker of a cluster does not have.
_PLACE = re.compile(r" \(line \d+(, column \d+)?\)")
#: The first line of several problems, after the name of the file.
_COUNT = re.compile(r"^\d+ problems$")
#: A gap in a smaller unit than m.
_GAP = re.compile(r"\bby (\d+\.\d+) (mm|µm|nm)\b")
_POWERS = {"mm": -3, "µm": -6, "nm": -9}


def reason(message: str, origin: str = "") -> str:
    """The message of an error as the reason of a row.

    Args:
        message: the message.
        origin: the name of the file of the model, which messages begin with; may be empty.
    """
    text = message.removeprefix(f"{origin}: ") if origin else message
    kept = [_PLACE.sub("", line.strip()) for line in text.splitlines() if not _EXCERPT.match(line)]
    return _GAP.sub(_in_metres, "; ".join(line for line in kept if not _COUNT.match(line)))


def origin_of(model: Model) -> str:
    """The name of the file of a model; empty if it was built in Python."""
    source = model._source
    place = source[0].place("kempe") if source else None
    return place[0] if place else ""


def _in_metres(gap: re.Match[str]) -> str:
    """``by 57.595 mm`` as ``by 0.057595 m``, with all digits."""
    return f"by {Decimal(gap[1]).scaleb(_POWERS[gap[2]]):f} m"
