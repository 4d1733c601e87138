"""Experiments of a fit: a case with measured data, and the residuals of both."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from kempe.base.arrays import Floats
from kempe.errors import ModelError
from kempe.model.measure_infos import measure_info
from kempe.results.solution import Solution
from kempe.results.variable import TIME
from kempe.sweeps.fits.data import Data
from kempe.sweeps.numbers import driven_model
from kempe.sweeps.plan import NoSlopesError, Plan, chosen, without_later
from kempe.sweeps.variables import changed
from kempe.sweeps.wanted import MOTIONS

if TYPE_CHECKING:
    from kempe.case import Case

#: Relative change of a parameter for a slope that the core does not give.
_CHANGE = 1e-4


@dataclass(frozen=True)
class Experiment:
    """A case with data.

    Attributes:
        case: the case.
        plan: its analysis, and the parameters that it has.
        places: the places of these parameters among all.
        data: the data.
        expressions: the expressions of the quantities.
        units: their SI units.
        unit_of_t: the SI unit of the times, or of the values over which the motion goes.
    """

    case: Case
    plan: Plan
    places: tuple[int, ...]
    data: Data
    expressions: Mapping[str, str]
    units: Mapping[str, str]
    unit_of_t: str

    def apart(self, values: Floats) -> dict[str, tuple[Floats, Floats]]:
        """Model minus data of each quantity, and its derivatives by all parameters.

        Raises:
            KempeError: the run fails, or ends before the data.
        """
        row = values[list(self.places)]
        times = np.unique(np.concatenate(list(self.data.t.values())))
        try:
            texts = list(self.expressions.values())
            found, slopes = self.plan.slopes_at(texts, times, row)
        except NoSlopesError:
            found, slopes = self._differences(times, row)
        apart = {}
        for k, name in enumerate(self.data.values):
            at = np.searchsorted(times, self.data.t[name])
            of_all = np.zeros((len(at), len(values)))
            of_all[:, list(self.places)] = slopes[at, k]
            apart[name] = found[at, k] - self.data.values[name], of_all
        return apart

    def curve(self, values: Floats, name: str, times: Floats) -> Floats:
        """A quantity of the model at times.

        Raises:
            KempeError: the run fails, or the times are outside of it.
        """
        return self._read(times, values[list(self.places)], [self.expressions[name]])[:, 0]

    def _differences(self, times: Floats, row: Floats) -> tuple[Floats, Floats]:
        """Values, and slopes as central differences of runs."""
        texts = list(self.expressions.values())
        slopes = np.empty((len(times), len(texts), len(row)))
        for k, x in enumerate(row):
            step = _CHANGE * (abs(x) or 1.0)
            pair = [row + sign * step * np.eye(len(row))[k] for sign in (1.0, -1.0)]
            up, down = (self._read(times, of, texts) for of in pair)
            slopes[:, :, k] = (up - down) / (2.0 * step)
        return self._read(times, row, texts), slopes

    def _read(self, times: Floats, row: Floats, texts: Sequence[str]) -> Floats:
        solution = self.plan.run(row)
        assert isinstance(solution, Solution)
        motion = solution(times)
        return np.column_stack([motion[text] for text in texts])


def experiment(case: Case, data: Data, names: Sequence[str], analysis: str | None) -> Experiment:
    """A case with data, checked.

    Raises:
        ModelError: the analysis is not a motion, a quantity is unknown, or a unit does not fit.
    """
    name = chosen(case, analysis)
    own = without_later(case, name)
    entry = own.analyses[name]
    if entry["type"] not in MOTIONS:
        told = f"analyses.{name}: {entry['type']} is not a motion, which data need"
        raise ModelError(told, hint='name another one: analysis="NAME"')
    model, of_t = own.model.compile(), TIME
    if entry.get("over") is not None:
        model, of_t = driven_model(model, entry["over"])
    known = own.model.compile().parameters
    places = tuple(k for k, each in enumerate(names) if "." in each or each in known)
    infos = {
        quantity: model.measures.get(quantity) or measure_info(model, quantity)
        for quantity in data.values
    }
    for quantity, info in infos.items():
        if info.is_of_run:
            raise ModelError(
                f"columns.{quantity}: it is a quantity of a whole run",
                hint="fit a quantity of each instant, such as an angle or a force",
            )
    units = {quantity: info.unit for quantity, info in infos.items()}
    data.check(units, of_t.unit)
    plan = Plan(own, name, tuple(names[k] for k in places), ())
    plan.check()
    expressions = {quantity: info.expression for quantity, info in infos.items()}
    return Experiment(case, plan, places, data, expressions, units, of_t.unit)


def experiments(
    case: Case, data: Any, names: Sequence[str], analysis: str | None
) -> list[Experiment]:
    """The experiments of a request: data of the case, or pairs of cases or settings with data.

    Raises:
        ModelError: ``data`` has another form.
    """
    from kempe.case import Case

    pairs = [(case, data)] if isinstance(data, Data) else data
    form = "must be a kp.Data, or a list of (case, kp.Data) or ({'L': 0.3}, kp.Data)"
    if not isinstance(pairs, list | tuple) or not pairs:
        raise ModelError(f"data: {data!r}; {form}")
    found = []
    for pair in pairs:
        if not isinstance(pair, list | tuple) or len(pair) != 2 or not isinstance(pair[1], Data):
            raise ModelError(f"data: {pair!r}; {form}")
        own, of = pair
        if isinstance(own, Mapping):
            for both in (name for name in own if name in names):
                raise ModelError(
                    f"data: an experiment sets {both} to {own[both]!r}, but the fit finds {both}",
                    hint=f"leave {both} out of the settings, or out of the parameters",
                )
            own = changed(case, own)
        if not isinstance(own, Case):
            raise ModelError(f"data: {own!r} is not a case; {form}")
        found.append(experiment(own, of, names, analysis))
    return found
