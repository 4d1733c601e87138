"""Questions about a mechanism with answers, and variants with random numbers."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np

from kempe import _core
from kempe.base.arguments import explain_methods
from kempe.errors import KempeError, ModelError
from kempe.model.measure_infos import measure_info
from kempe.model.values import instance, refuse
from kempe.sweeps.asked import plan_of

if TYPE_CHECKING:
    from kempe.case import Case

#: The relative tolerance of a question without one.
TOLERANCE = 0.01
#: Answers below this, in SI units, are zeros with rounding errors.
ZERO = 1e-12
#: The format of files of results.
RESULT_FORMAT = 1


@dataclass(frozen=True)
class Question:
    """A question of an exercise with its answer.

    Attributes:
        name: its name in the file.
        text: what is asked, with the values of the variant.
        value: the answer in SI units and rad.
        unit: the unit of an answer without one.
        within: the largest error of a right answer, in SI units and rad.
        points: what a right answer counts.
        hints: the hints, with the values of the variant.
    """

    name: str
    text: str
    value: float
    unit: str
    within: float
    points: float
    hints: tuple[str, ...]

    @property
    def shown(self) -> float:
        """The answer in its unit."""
        return self.value / _factor(self.unit, self.name)

    def read(self, answer: float | str) -> float:
        """An answer in SI units: a number in the unit of the question, or a text such as "3 kN".

        Raises:
            ModelError: it is not a number, or in another unit.
        """
        factor = _factor(self.unit, self.name)
        if not isinstance(answer, str):
            return float(answer) * factor
        try:
            own = _core.formula_unit(answer, [], [])
            value = float(_core.formula_value(answer, [], [])[0])
        except KempeError as error:
            refuse(self.name, f"{answer!r}: {error.args[0]}")
        if own in ("", "1"):
            return value * factor
        if self.unit in ("", "1") or _core.formula_unit(f"1 {self.unit}", [], []) != own:
            refuse(self.name, f"{answer!r} is in {own}; must be in {self.unit or '1'}")
        return value

    def check(self, answer: float | str) -> bool:
        """Whether an answer is correct; see ``read``."""
        return abs(self.read(answer) - self.value) <= self.within


@explain_methods
class Exercise:
    """The exercise of a case.

    Args:
        case: a case with a section ``[exercise]``.
        seed: of the random parameters; 0 for the values of the file. By default that of the
            section, or 0.

    Attributes:
        case: the case with the values of this variant.
        seed: the seed.
        text: what the questions are about, with the values of the variant.
        values: the random parameters in SI units and rad.
        shown: the random parameters with their units, for people.

    Raises:
        ModelError: the case has no exercise, or a question is faulty.
    """

    def __init__(self, case: Case, seed: int | None = None) -> None:
        from kempe.case import Case

        instance(case, Case, "a case, as kp.load(path) returns")
        section = case.exercise
        if not section:
            hint = "write [exercise] with questions, such as those of kempe new exercise_crank"
            raise ModelError("the case has no section [exercise]", hint=hint)
        self.seed = int(section.get("seed", 0) if seed is None else seed)
        if self.seed < 0:
            refuse("seed", f"{seed}; must be a whole number from 0")
        texts = [str(section.get("text", ""))]
        for question in section["questions"].values():
            texts += [question["text"], *question.get("hints", ())]
        drawn, filled = case._core().variant(self.seed, texts)
        self.values: Mapping[str, float] = MappingProxyType({name: x for name, x, _ in drawn})
        self.shown: Mapping[str, str] = MappingProxyType({name: text for name, _, text in drawn})
        self.case = case.with_parameters(self.values) if self.values else case
        self._section, self._texts = section, iter(filled)
        self.text = next(self._texts)
        questions = section["questions"].items()
        made = {name: self._question(name, given) for name, given in questions}
        self.questions: Mapping[str, Question] = MappingProxyType(made)

    def _question(self, name: str, given: Mapping[str, Any]) -> Question:
        text = next(self._texts)
        hints = tuple(next(self._texts) for _ in given.get("hints", ()))
        try:
            value, unit = self._answer(given)
        except KempeError as error:
            error.args = (f"question '{name}': {error.args[0]}", *error.args[1:])
            raise
        unit = str(given.get("unit", unit))
        within = _within(given.get("tolerance", TOLERANCE), value, unit, name)
        return Question(name, text, value, unit, within, float(given.get("points", 1.0)), hints)

    def _answer(self, given: Mapping[str, Any]) -> tuple[float, str]:
        """The answer to a question and its SI unit."""
        case, name = self.case, self._section.get("analysis")
        if "quantity" in given and "at" not in given:
            quantity = given["quantity"]
            state = case.start()
            return float(state[quantity]), measure_info(case.model.compile(), quantity).unit
        column = given.get("measure", f"{given.get('quantity')}.final")
        if "at" in given:
            name = name or list(case.analyses)[-1]
            analysis = case.analyses[name]
            over = analysis.get("over")
            end = {"range": [analysis["range"][0], given["at"]]} if over else {"t_end": given["at"]}
            case = case.with_analysis(name, **end)
        plan = plan_of(case, {"measures": [column], "analysis": name}, ())
        (value, _) = plan.read(np.zeros(0))[0]
        if not np.isfinite(value):
            raise ModelError(f"{column} has no value")
        return value, plan.wanted[0].unit

    def grade(self, result: Mapping[str, Any]) -> dict[str, bool]:
        """Whether the answers of a result are right, by question.

        The file that the studio writes is a result. Its answers are checked again; its own marks
        are not used. A question without an answer, or whose answer cannot be read, counts as wrong.

        Args:
            result: the content of the file.

        Raises:
            ModelError: it is not a result, or belongs to another variant.
        """
        if result.get("kempe_result") != RESULT_FORMAT:
            raise ModelError("this is not a result of an exercise of this version of kempe")
        if result.get("seed") != self.seed:
            told = f"the result is of the variant {result.get('seed')}, not of {self.seed}"
            raise ModelError(told, hint=f"choose its variant with seed {result.get('seed')}")
        answers = result.get("answers", {})
        return {name: self._is_right(name, answers.get(name)) for name in self.questions}

    def _is_right(self, name: str, answer: Any) -> bool:
        given = answer.get("given") if isinstance(answer, Mapping) else None
        if not isinstance(given, str | float | int):
            return False
        try:
            return self.questions[name].check(given)
        except KempeError:
            return False


def read_result(text: str) -> Mapping[str, Any]:
    """The content of a file that the studio has written.

    Raises:
        ModelError: it is not JSON with a table.
    """
    try:
        found = json.loads(text)
    except ValueError as error:
        raise ModelError(f"the result is not JSON: {error}") from error
    if not isinstance(found, dict):
        raise ModelError("the result is not a table")
    return found


def _factor(unit: str, name: str) -> float:
    """The SI value of a unit."""
    if unit in ("", "1"):
        return 1.0
    try:
        return float(_core.formula_value(f"1 {unit}", [], [])[0])
    except KempeError as error:
        refuse(name, f"unit {unit!r}: {error.args[0]}")


def _within(tolerance: float | str, value: float, unit: str, name: str) -> float:
    """The largest error of a right answer."""
    text = str(tolerance).strip()
    if isinstance(tolerance, str) and not text.endswith("%"):
        return abs(Question(name, "", 0.0, unit, 0.0, 0.0, ()).read(text))
    try:
        share = float(text[:-1]) / 100.0 if text.endswith("%") else float(tolerance)
    except ValueError:
        refuse(name, f"tolerance {tolerance!r}; must be a share, or such as '2 %' or '0.5 N'")
    if abs(value) < ZERO:
        told = f"the answer to '{name}' is 0, which has no relative tolerance"
        raise ModelError(told, hint='write a tolerance with a unit, such as "0.5 N"')
    return share * abs(value)
