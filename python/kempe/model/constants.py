"""Numbers of laws that are constant, for files of other tools."""

from __future__ import annotations

from typing import Any

import numpy as np

from kempe import _core
from kempe.errors import KempeError, ModelError
from kempe.model.compiled import CompiledModel


def constant(model: CompiledModel, place: str, law: Any, form: str) -> float:
    """The value of a law that depends on parameters only, in SI units.

    Args:
        model: the model with its parameters.
        place: the element and the field, for messages.
        law: a number or a formula.
        form: the format that needs a number, for messages.

    Raises:
        ModelError: it depends on the time or the motion.
    """
    value = value_of(model, law)
    if value is None:
        raise ModelError(
            f"{place} = {law!r} is not constant, and {form} needs a number here",
            name=place,
            hint="give it a number or a formula of parameters",
        )
    return value


def value_of(model: CompiledModel, law: Any) -> float | None:
    """The value of a law that depends on parameters only, in SI units; None for other laws."""
    if isinstance(law, int | float):
        return float(law)
    try:
        used, *_ = _core.measure(model.core, law)
        times = np.array([0.0, 0.7310585786300049])
        values: Any = [] if used else _core.measure_values(model.core, law, times, np.zeros((2, 0)))
    except KempeError:
        return None
    return float(values[0]) if len(values) and values[0] == values[1] else None
