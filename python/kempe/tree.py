"""The way of a case from nested mappings into the core."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

from kempe import _core
from kempe.errors import FileError, ModelError


def core_case(tree: Mapping[str, Any]) -> _core.Case:
    """The case in the core.

    Raises:
        ModelError: with all that is wrong with its structure. There is no file whose fault it
            could be.
    """
    try:
        return _core.Case(json.dumps(tree, allow_nan=False), "json", None)
    except FileError as error:
        message = str(error.args[0]) if error.args else str(error)
        raise ModelError(
            message, name=error.name, hint=error.hint, problems=error.problems
        ) from None
