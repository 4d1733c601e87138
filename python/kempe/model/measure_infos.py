"""The measures of a compiled model: their expressions, units and quantities."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

from kempe import _core

if TYPE_CHECKING:
    from kempe.model.compiled import CompiledModel


@dataclass(frozen=True)
class MeasureInfo:
    """A measure of a model.

    Attributes:
        name: name of the measure.
        expression: the expression, as written.
        quantities: names of the quantities that it uses, each once.
        unit: its SI unit; "1" for a number, "SI" if it does not follow from the expression.
        is_of_run: whether it uses energies or balances of a run, which exist at the outputs only.
        solves: whether it needs accelerations or multipliers.
    """

    name: str
    expression: str
    quantities: tuple[str, ...]
    unit: str
    is_of_run: bool
    solves: bool


def measure_infos(model: CompiledModel) -> Iterator[MeasureInfo]:
    """The measures of a compiled model, in the order of the file."""
    for name, expression in model.tree.get("measures", {}).items():
        yield measure_info(model, expression, name)


def measure_info(model: CompiledModel, expression: str, name: str = "") -> MeasureInfo:
    """An expression of quantities as a measure; its name is the expression by default.

    Raises:
        ModelError: the expression is invalid or contains an unknown name.
    """
    used, unit, is_of_run, solves = _core.measure(model.core, expression)
    return MeasureInfo(name or expression, expression, tuple(used), unit, is_of_run, solves)


def parameter_unit(model: CompiledModel, name: str) -> str:
    """The SI unit of a parameter that is written with one; "SI" for a parameter without a unit."""
    return str(_core.measure(model.core, f"`{name}`")[1])
