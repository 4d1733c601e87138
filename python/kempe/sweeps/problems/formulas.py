"""Formulas of the columns of a sweep and of parameters, with their derivatives."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from kempe import _core
from kempe.base.arrays import Floats
from kempe.base.names import few
from kempe.errors import KempeError, ModelError
from kempe.model.compiled import CompiledModel
from kempe.model.measure_infos import parameter_unit
from kempe.model.values import refuse
from kempe.sweeps.plan import Plan

#: A comparison at the top of a formula.
_COMPARISON = re.compile(r"<=|>=|==|=|<|>")
#: A quoted name, or one that must be quoted: ``fall:C.force.max``, ``frequency[0]``.
_NAME = re.compile(r"`[^`]*`|(?<![\w.])([A-Za-z_]\w*:)?[A-Za-z_][\w.]*(\[-?\d+\])?")
#: A formula over all load cases.
_WORST = re.compile(r"(?<![\w.`])worst\s*\(")

#: The unit of a column or a parameter, by its name.
Units = Callable[[str], str]


@dataclass(frozen=True)
class Formula:
    """A formula.

    Attributes:
        text: as the user wrote it.
        of: the text for the core.
        names: the columns and parameters in it, and the texts of ``worst``.
        unit: its SI unit; empty if it is not known.
        worst: the formulas that ``worst`` takes in each load case, by these texts.
    """

    text: str
    of: str
    names: tuple[str, ...]
    unit: str
    worst: Mapping[str, Formula] = field(default_factory=dict)

    def at(self, slopes: Mapping[str, tuple[float, Floats]]) -> tuple[float, Floats]:
        """The value, and the derivatives by the variables, from those of its names."""
        known = [slopes[name] for name in self.names]
        value, partial = _core.formula_value(self.of, list(self.names), [x for x, _ in known])
        width = len(next(iter(slopes.values()))[1])
        parts = (p * of for p, (_, of) in zip(partial, known, strict=True))
        return value, sum(parts, np.zeros(width))

    def size(self, slopes: Mapping[str, tuple[float, Floats]]) -> float:
        """The sum of the magnitudes of its terms, to first order; not 0 where they cancel."""
        values = [slopes[name][0] for name in self.names]
        _, partial = _core.formula_value(self.of, list(self.names), values)
        return sum(abs(p * x) for p, x in zip(partial, values, strict=True) if np.isfinite(p))

    @property
    def columns(self) -> list[str]:
        """The names that are columns, not parameters."""
        own = (name for name in self.names if name not in self.worst)
        return [name for name in own if set(".[:") & set(name)]


def read_formula(model: CompiledModel, text: str, columns: Iterable[str]) -> Formula:
    """A formula; its unit is not known yet.

    Args:
        model: the model, whose parameters the formula may contain.
        text: the text.
        columns: names without a point that are columns, such as ``lower`` of limits.

    Raises:
        ModelError: the text is not a formula.
    """
    if not isinstance(text, str) or not text.strip():
        refuse("formula", f"{text!r}; must be a text such as 'C.force.max'")
    written, worst = _without_worst(model, text.strip(), columns)
    written = _NAME.sub(lambda of: f"`{of[0]}`" if of[1] or of[2] else of[0], written)
    others = {*columns, *worst}
    names = [_checked(name, model, others) for name in _core.formula_names(written)]
    return Formula(text, written, tuple(names), "", worst)


def _without_worst(
    model: CompiledModel, text: str, columns: Iterable[str]
) -> tuple[str, dict[str, Formula]]:
    """A text with a name in place of each ``worst(…)``, and the formulas within these."""
    worst: dict[str, Formula] = {}
    while (found := _WORST.search(text)) is not None:
        depth, end = 1, found.end()
        while depth and end < len(text):
            depth += {"(": 1, ")": -1}.get(text[end], 0)
            end += 1
        inner = text[found.end() : end - 1].strip().strip("\"'")
        if depth or _WORST.search(inner):
            refuse(
                "formula", f"{text!r}; write worst(C.force.max) or worst(C.force.max - 3*weight)"
            )
        name = f"worst({inner})".replace("`", "")
        worst[name] = read_formula(model, inner, columns)
        text = f"{text[: found.start()]}`{name}`{text[end:]}"
    return text, worst


def with_unit(formula: Formula, unit: Units) -> Formula:
    """The formula with its unit.

    Raises:
        ModelError: its units contradict each other.
    """
    worst = {name: with_unit(of, unit) for name, of in formula.worst.items()}
    units = [worst[name].unit if name in worst else unit(name) for name in formula.names]
    try:
        found = _core.formula_unit(formula.of, list(formula.names), units)
    except KempeError as error:
        told = ", ".join(
            f"{name} is in {of}" for name, of in zip(formula.names, units, strict=True) if of
        )
        raise ModelError(f"{formula.text!r}: {error.args[0]}; {told}", hint=error.hint) from error
    single = formula.names and formula.of.strip(" `") == formula.names[0]
    of = units[0] if single else _divided(found)
    return replace(formula, unit="" if of == "SI" else of, worst=worst)


def _divided(unit: str) -> str:
    """A unit with divisions in place of negative powers: ``m/s``, not ``m*s^-1``."""
    parts = [part.split("^-") for part in unit.split("*")]
    above = "*".join(part[0] for part in parts if len(part) == 1)
    below = (
        "/" + part[0] + (f"^{part[1]}" if part[1] != "1" else "") for part in parts if part[1:]
    )
    return (above or "1") + "".join(below) if "^-" in unit else unit


def _checked(name: str, model: CompiledModel, columns: set[str]) -> str:
    """The name of a column or a parameter.

    Raises:
        ModelError: it is neither.
    """
    if name in model.parameters or name in columns:
        return name
    if not set(".[:") & set(name):
        hint = f"parameters are {few(model.parameters)}" if model.parameters else None
        told = f"{name!r} is neither a parameter nor a column such as C.force.max"
        raise ModelError(told, name=name, hint=hint)
    return name


@dataclass(frozen=True)
class Limit:
    """A comparison that the best values must satisfy: ``room`` is at least 0.

    Attributes:
        text: as the user wrote it.
        room: the larger side minus the smaller one.
        sides: both sides, the smaller one first.
    """

    text: str
    room: Formula
    sides: tuple[Formula, Formula]


def read_limit(model: CompiledModel, text: str, columns: Sequence[str]) -> Limit:
    """A limit such as ``"C.force.max <= 2e4"``; its unit is not known yet.

    Raises:
        ModelError: it is not a comparison of two formulas.
    """
    form = "must be a comparison such as 'C.force.max <= 2e4'"
    if not isinstance(text, str):
        refuse("subject_to", f"{text!r}; {form}")
    found = [m for m in _COMPARISON.finditer(text) if _is_outside(text, m.start())]
    if len(found) != 1:
        refuse("subject_to", f"{text!r}; {form}")
    (sign,) = found
    if "=" in sign[0] and len(sign[0].strip("<>")) == len(sign[0]):
        raise ModelError(
            f"subject_to: {text!r} is an equation",
            hint="write two comparisons for a band, or target={'C.force.max': 2e4} for a value",
        )
    left, right = text[: sign.start()].strip(), text[sign.end() :].strip()
    small, large = (left, right) if sign[0].startswith("<") else (right, left)
    sides = [read_formula(model, side, columns) for side in (small, large)]
    whole = f"({_plain(sides[1])}) - ({_plain(sides[0])})"
    names = tuple(dict.fromkeys(name for side in sides for name in side.names))
    if not names:
        refuse("subject_to", f"{text!r} has no column and no parameter")
    worst = {**sides[0].worst, **sides[1].worst}
    return Limit(text, Formula(text, whole, names, "", worst), (sides[0], sides[1]))


def _plain(side: Formula) -> str:
    """The side of a limit; a number with a unit, which stands alone, in SI units and rad."""
    if side.names:
        return side.of
    return repr(float(_core.formula_value(side.of, [], [])[0]))


def _is_outside(text: str, place: int) -> bool:
    """Whether a place is neither within parentheses nor within backticks."""
    before = text[:place]
    return before.count("(") == before.count(")") and before.count("`") % 2 == 0


class Parameters:
    """The parameters of a case in formulas: variables, numbers, and formulas of these.

    Args:
        plan: the plan, whose variables may be parameters.
    """

    def __init__(self, plan: Plan) -> None:
        self._plan = plan
        self._model = plan.case.model.compile()

    def unit(self, name: str) -> str:
        """The SI unit; empty if it is not known."""
        return parameter_unit(self._model, name)

    def at(self, row: Floats, names: Iterable[str]) -> dict[str, tuple[float, Floats]]:
        """Values and derivatives by the variables."""
        found: dict[str, tuple[float, Floats]] = {}
        for name in names:
            self._add(found, name, row)
        return found

    def _add(self, found: dict[str, tuple[float, Floats]], name: str, row: Floats) -> None:
        if name in found:
            return
        if name in self._plan.names:
            k = self._plan.names.index(name)
            found[name] = float(row[k]), np.eye(len(row))[k]
        elif (formula := self._formulas.get(name)) is not None:
            for each in formula.names:
                self._add(found, each, row)
            found[name] = formula.at(found)
        else:
            found[name] = self._model.parameters[name], np.zeros(len(row))

    @cached_property
    def _formulas(self) -> dict[str, Formula]:
        """The parameters that depend on others."""
        written = self._plan.case.model.shown().get("parameters", {})
        texts = {name: text for name, text in written.items() if isinstance(text, str)}
        read = {name: read_formula(self._model, text, ()) for name, text in texts.items()}
        return {name: formula for name, formula in read.items() if formula.names}
