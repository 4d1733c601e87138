"""Numbers of laws that are constant, for files that know no formulas."""

from __future__ import annotations

from typing import Any

import numpy as np

from kempe import _core
from kempe.errors import KempeError, ModelError
from kempe.model.compiled import CompiledModel


def constant(model: CompiledModel, place: str, law: Any) -> float:
    """The value of a law that depends on parameters only, in SI units.

    Raises:
        ModelError: it depends on the time or the motion.
    """
    if isinstance(law, int | float):
        return float(law)
    try:
        used, *_ = _core.measure(model.core, law)
        times = np.array([0.0, 0.7310585786300049])
        values: Any = [] if used else _core.measure_values(model.core, law, times, np.zeros((2, 0)))
    except KempeError:
        values = []
    if len(values) == 0 or values[0] != values[1]:
        raise ModelError(
            f"{place} = {law!r} is not constant, and MJCF has no formulas",
            name=place,
            hint="give it a number or a formula of parameters",
        )
    return float(values[0])
