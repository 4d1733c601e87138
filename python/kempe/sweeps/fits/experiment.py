"""Experiments of a fit: a case with measured data, and the residuals of both."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from kempe.base.arrays import Floats
from kempe.errors import ModelError
from kempe.model.measure_infos import measure_info
from kempe.results.solution import Solution
from kempe.results.variable import TIME
from kempe.sweeps.fits.data import Data
from kempe.sweeps.gradients.run import numbers_and_slopes
from kempe.sweeps.numbers import driven_model
from kempe.sweeps.plan import NoSlopesError, Plan, chosen, without_later
from kempe.sweeps.variables import changed
from kempe.sweeps.wanted import MOTIONS, read_wanted

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
        shift: the place of the shift of the times among all parameters; None without one.
    """

    case: Case
    plan: Plan
    places: tuple[int, ...]
    data: Data
    expressions: Mapping[str, str]
    units: Mapping[str, str]
    unit_of_t: str
    shift: int | None = None

    def apart(self, values: Floats) -> dict[str, tuple[Floats, Floats]]:
        """Model minus data of each quantity, and its derivatives by all parameters.

        Raises:
            KempeError: the run fails, or ends before the data.
        """
        row, times = values[list(self.places)], self.times
        shift = 0.0 if self.shift is None else float(values[self.shift])
        found, slopes = self._at(times + shift, row)
        by_time = np.zeros_like(found) if self.shift is None else self._rates(times + shift, row)
        apart = {}
        for k, name in enumerate(self.data.values):
            at = np.searchsorted(times, self.data.t[name])
            of_all = np.zeros((len(at), len(values)))
            of_all[:, list(self.places)] = slopes[at, k]
            if self.shift is not None:
                of_all[:, self.shift] = by_time[at, k]
            apart[name] = found[at, k] - self.data.values[name], of_all
        return apart

    @property
    def times(self) -> Floats:
        """The times of all data."""
        return np.unique(np.concatenate(list(self.data.t.values())))

    @property
    def is_motion(self) -> bool:
        """Whether the data are those of a motion, not of a result at rest."""
        return not self.plan.wanted

    def reach(self, row: Floats) -> tuple[float, float]:
        """The least and the largest shift with which all data are within the run.

        Raises:
            KempeError: the run fails.
        """
        solution, times = self.plan.run(row), self.times
        assert isinstance(solution, Solution)
        return float(solution.t[0] - times[0]), float(solution.t[-1] - times[-1])

    def misfits(self, row: Floats, shifts: Floats, scales: Mapping[str, float]) -> Floats:
        """The sum of squares of model minus data for shifts of the time, from one run.

        Raises:
            KempeError: the run fails.
        """
        solution = self.plan.run(row)
        assert isinstance(solution, Solution)
        squares = np.zeros(len(shifts))
        for name, data in self.data.values.items():
            times = (self.data.t[name] + shifts[:, None]).ravel()
            ends = float(solution.t[0]), float(solution.t[-1])
            model = solution(np.clip(times, *ends))[self.expressions[name]]
            apart = model.reshape(len(shifts), -1) - data
            squares += ((apart / scales[name]) ** 2).sum(axis=1)
        return squares

    def _at(self, times: Floats, row: Floats) -> tuple[Floats, Floats]:
        """The quantities at times, and their derivatives by the parameters of the experiment."""
        if not self.is_motion:
            values, slopes, _ = numbers_and_slopes(self.plan, row)
            for of in np.flatnonzero(np.isnan(slopes).any(axis=0)):
                step = _CHANGE * (abs(row[of]) or 1.0) * np.eye(len(row))[of]
                up, down = self.plan.rows(np.array([row + step, row - step]), 2).values
                slopes[:, of] = (up - down) / (2.0 * step[of])
            return np.tile(values, (len(times), 1)), np.tile(slopes, (len(times), 1, 1))
        try:
            return self.plan.slopes_at(list(self.expressions.values()), times, row)
        except NoSlopesError:
            return self._differences(times, row)

    def _rates(self, times: Floats, row: Floats) -> Floats:
        """The derivatives of the quantities by the time, from one run."""
        solution = self.plan.run(row)
        assert isinstance(solution, Solution)
        ends = float(solution.t[0]), float(solution.t[-1])
        step = _CHANGE * (ends[1] - ends[0])
        near = [np.clip(times + sign * step, *ends) for sign in (1.0, -1.0)]
        texts = list(self.expressions.values())
        up, down = (np.column_stack([solution(t)[text] for text in texts]) for t in near)
        return np.asarray((up - down) / (near[0] - near[1])[:, None])

    def curve(self, values: Floats, name: str, times: Floats) -> Floats:
        """A quantity of the model at times.

        Raises:
            KempeError: the run fails, or the times are outside of it.
        """
        row = values[list(self.places)]
        if not self.is_motion:
            found = self._at(times, row)[0]
            return found[:, list(self.data.values).index(name)]
        shift = 0.0 if self.shift is None else float(values[self.shift])
        return self._read(times + shift, row, [self.expressions[name]])[:, 0]

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
        ModelError: a quantity is unknown, a unit does not fit, or times are missing or too many.
    """
    name = chosen(case, analysis)
    own = without_later(case, name)
    entry = own.analyses[name]
    known = own.model.compile().parameters
    shift = names.index(data.shift) if data.shift in names else None
    if data.shift is not None and (shift is None or data.shift in known):
        told = (
            "it is a parameter of the case" if data.shift in known else "the fit does not find it"
        )
        raise ModelError(
            f"shift: {data.shift}: {told}",
            hint="give it a name of its own, and add it to the parameters: {'t0': (-0.1, 0.1)}",
        )
    places = tuple(k for k, each in enumerate(names) if "." in each or each in known)
    plan = Plan(own, name, tuple(names[k] for k in places), ())
    plan.check()
    model, of_t = own.model.compile(), TIME
    if entry["type"] not in MOTIONS:
        if data.header_of_t is not None:
            raise ModelError(
                f"analyses.{name}: {entry['type']} is not a motion, and the data have times",
                hint='pass kp.Data(..., t=None), or name a motion: analysis="NAME"',
            )
        read = read_wanted(model, entry, list(data.values))
        units = {one.text: one.unit for one in read}
        data.check(units, "1")
        plan = replace(plan, wanted=tuple(read))
        return Experiment(case, plan, places, data, {one: one for one in units}, units, "1")
    if data.header_of_t is None:
        raise ModelError(
            f"analyses.{name}: {entry['type']} is a motion, and the data have no times",
            hint="name the column of times: kp.Data(..., t='time')",
        )
    if entry.get("over") is not None:
        model, of_t = driven_model(model, entry["over"])
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
    expressions = {quantity: info.expression for quantity, info in infos.items()}
    return Experiment(case, plan, places, data, expressions, units, of_t.unit, shift)


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
