"""Tolerances: the scatter of a measure that follows from the scatter of parameters."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from kempe.base.arguments import explained
from kempe.base.arrays import Floats
from kempe.base.names import few
from kempe.errors import ModelError
from kempe.model.values import mapping, numbers, refuse
from kempe.sweeps.asked import plan_of
from kempe.sweeps.gradients.run import gradient, in_analyses, numbers_and_slopes
from kempe.sweeps.plan import Plan
from kempe.sweeps.problems.asked import limits_of, units_of, with_units
from kempe.sweeps.problems.columns import Part
from kempe.sweeps.problems.formulas import Limit, Parameters
from kempe.sweeps.result import SweepResult
from kempe.sweeps.run import sweep
from kempe.sweeps.sobol import Share, shares
from kempe.sweeps.variables import present

if TYPE_CHECKING:
    from kempe.case import Case

#: Number of standard deviations to both sides of the nominal value for the central difference.
_STEP = 0.5
#: Number of standard deviations of the worst case, and of ``allocate``.
_WORST = 3.0


@dataclass(frozen=True, repr=False)
class Tolerances:
    """The scatter of a measure.

    Attributes:
        measure: its text, such as ``pin.max``.
        unit: its SI unit.
        nominal: its value in the unchanged case.
        mean: mean of the variants.
        deviation: standard deviation of the variants.
        first_order: the standard deviation from exact slopes: √Σ (slope × deviation)².
        slopes: derivative of the measure with respect to each variable, in SI units.
        contributions: share of each variable in ``first_order`` squared; they sum to 1.
        sample: the variants.
        worst_case: least and largest value where every variable is off by three standard
            deviations in the direction of its slope; NaN if the mechanism fails there.
        yield_: share of the variants that satisfy all limits, NaN without limits; variants that
            fail satisfy none.
        sobol: the shares of the variables in the variance by name, as (first, total, first_error,
            total_error): by the variable alone and with all interactions; empty without ``sobol=``.
    """

    measure: str
    unit: str
    nominal: float
    mean: float
    deviation: float
    first_order: float
    slopes: Mapping[str, float]
    contributions: Mapping[str, float]
    sample: SweepResult
    worst_case: tuple[float, float] = (np.nan, np.nan)
    yield_: float = np.nan
    sobol: Mapping[str, Share] = field(default_factory=dict)

    @property
    def remark(self) -> str:
        """The remark on the measure in the variants; see ``SweepResult.remarks``; often empty."""
        return self.sample.remarks.get(self.measure, "")

    def __repr__(self) -> str:
        name = f"{self.measure}, {self.remark}" if self.remark else self.measure
        shares = ", ".join(f"{name} {100.0 * x:.3g} %" for name, x in self.contributions.items())
        return (
            f"<Tolerances of {name}: {self.mean:.6g} ± {self.deviation:.3g} {self.unit}, "
            f"first order ± {self.first_order:.3g}; {shares}>"
        )


@explained
def tolerances(
    case: Case,
    deviations: Mapping[str, float],
    measure: str,
    *,
    n: int = 1000,
    seed: int | None = None,
    analysis: str | None = None,
    subject_to: str | Sequence[str] = (),
    sobol: int | None = None,
    **options: Any,
) -> Tolerances:
    """The scatter of a measure: by random variants, and to first order.

    Every variable has a normal distribution about its value in the case. The first-order estimate
    uses exact slopes, or central differences over one standard deviation where there are none. If
    the two estimates differ, the measure is not linear within the tolerances.

    Args:
        case: the case.
        deviations: standard deviations by the name of a parameter or start value, SI units:
            ``{"L2": 0.05}``.
        measure: a statistic of a measure or quantity, such as ``"pin.max"``.
        n: number of random variants.
        seed: as for ``kp.sweep``.
        analysis: as for ``kp.sweep``.
        subject_to: limits as for ``kp.optimize``, for the yield.
        sobol: number of base points for Sobol indices by SALib, a power of two such as 256; they
            take sobol × (number of variables + 2) runs.
        **options: ``workers``, ``scheduler``, ``out`` and ``progress`` of ``kp.sweep``, for the
            random variants.

    Raises:
        ModelError: a name or number is invalid, a value at the start is not a number, or the case
            itself or a variant for a slope fails; the message has its reason.
    """
    given = _given(case, deviations, "deviations", "{'L2': 0.05}")
    middle = present(case, given)  # the sweep refuses unknown names
    spread = {name: {"normal": [middle[name], x]} for name, x in given.items()}
    read = limits_of(case, subject_to, analysis)
    for text in (text for one in read for text in one.room.names if ":" in text or "(" in text):
        told = f"subject_to: {text}: the limits of a yield are those of one analysis and load case"
        raise ModelError(told, hint="leave it out, or name its analysis: analysis='NAME'")
    measures = list(dict.fromkeys([measure, *(name for one in read for name in one.room.columns)]))
    plan = plan_of(case, {"measures": measures, "analysis": analysis}, given)
    of_all = Part(plan, tuple(one.text for one in plan.wanted), "", 0)
    limits = with_units(read, units_of([of_all], of_all.parameters))
    sample = sweep(
        case, spread, measures, design="random", n=n, seed=seed, analysis=analysis, **options
    )
    widths = np.array([float(x) for x in given.values()])
    nominal, slopes = _exact(plan, middle)
    if not np.isfinite(slopes).all():
        nominal, slopes = _slopes(case, middle, widths, (measure, analysis))
    corners = _corners(plan, middle, slopes, widths)
    held = _share(sample, plan, limits) if limits else np.nan
    first = replace(plan, wanted=plan.wanted[:1])
    indices = {} if sobol is None else shares(first, middle, widths.tolist(), sobol, seed or 0)
    return _told(sample, (nominal, slopes, widths), (corners, held, indices))


def _given(case: Case, values: Mapping[str, float], name: str, form: str) -> dict[str, float | str]:
    """Numbers by the name of a variable of a case, at least one.

    Raises:
        ModelError: there is none, one is not a number, or the case is none.
    """
    present(case, ())
    if not mapping(values, name, form):
        refuse(name, f"there are none; give one: {form}")
    return numbers(values, name)


def _told(
    sample: SweepResult,
    first: tuple[float, Floats, Floats],
    rest: tuple[tuple[float, float], float, Mapping[str, Share]],
) -> Tolerances:
    """The scatter of the first measure of a sample.

    Args:
        sample: the random variants.
        first: the value of the case, the slopes, and the standard deviations of the variables.
        rest: the worst case, the yield and the Sobol indices.

    Raises:
        ModelError: fewer than two variants succeed.
    """
    (nominal, slopes, widths), names = first, [one.name for one in sample.variables]
    variances = (slopes * widths) ** 2
    total = float(variances.sum())
    parts = variances / total if total > 0.0 else np.zeros(len(widths))
    measure = sample.measures[0]
    found = sample[measure][sample.succeeded]
    if len(found) < 2:
        raise ModelError(
            "fewer than two random variants succeed; a variant within the tolerances fails: "
            f"{next(iter(sample.reasons.values()), 'its measure has no value')}",
            hint="take smaller deviations",
        )
    return Tolerances(
        measure,
        sample.units[measure],
        nominal,
        float(found.mean()),
        float(found.std(ddof=1)),
        float(np.sqrt(total)),
        dict(zip(names, slopes.tolist(), strict=True)),
        dict(zip(names, parts.tolist(), strict=True)),
        sample,
        *rest,
    )


def _exact(plan: Plan, middle: Mapping[str, float]) -> tuple[float, Floats]:
    """The first measure in the case itself, and its exact slopes; NaN where there are none.

    Raises:
        KempeError: the run fails.
    """
    row = np.array(list(middle.values()))
    own = replace(plan, wanted=plan.wanted[:1])
    values, slopes, _ = numbers_and_slopes(own, row)
    slopes[:, list(in_analyses(own, row))] = np.nan
    return float(values[0]), slopes[0]


def _corners(
    plan: Plan, middle: Mapping[str, float], slopes: Floats, widths: Floats
) -> tuple[float, float]:
    """The first measure where all variables are off in the direction of its slopes, or against."""
    row, off = np.array(list(middle.values())), _WORST * widths * np.sign(slopes)
    values = plan.rows(np.array([row - off, row + off]), 2).values[:, 0]
    return float(values[0]), float(values[1])


def _share(sample: SweepResult, plan: Plan, limits: Sequence[Limit]) -> float:
    """The share of the variants that satisfy all limits."""
    parameters, columns = Parameters(plan), sample.measures
    names = [name for one in limits for name in one.room.names if name not in columns]
    none, good = np.zeros(len(sample.variables)), 0
    rows = zip(sample._design, sample._values, sample.succeeded, strict=True)
    for row, values in ((row, values) for row, values, succeeded in rows if succeeded):
        known = {name: (float(x), none) for name, x in zip(columns, values, strict=True)}
        known |= parameters.at(row, names)
        good += all(one.room.at(known)[0] >= 0.0 for one in limits)  # not with NaN
    return good / len(sample)


def _slopes(
    case: Case, middle: Mapping[str, float], widths: Floats, asked: tuple[str, str | None]
) -> tuple[float, Floats]:
    """The measure in the case itself, and its slopes over the variables."""
    measure, analysis = asked
    levels = np.tile(np.array(list(middle.values())), (2 * len(widths) + 1, 1))
    for k, width in enumerate(widths):
        levels[2 * k + 1, k] -= _STEP * width
        levels[2 * k + 2, k] += _STEP * width
    lists = {name: levels[:, k].tolist() for k, name in enumerate(middle)}
    near = sweep(case, lists, [measure], design="paired", analysis=analysis)
    if near.reasons:
        raise ModelError(
            f"a variant within the tolerances fails: {next(iter(near.reasons.values()))}",
            hint="take smaller deviations, or sweep to see which variants fail",
        )
    values = near[measure]
    slopes: Floats = (values[2::2] - values[1::2]) / (2.0 * _STEP * widths)
    return float(values[0]), slopes


@dataclass(frozen=True, repr=False)
class Allocation:
    """The cheapest tolerances with which a measure keeps a limit.

    Attributes:
        measure: its text.
        nominal: its value in the case.
        limit: the limit.
        deviations: the standard deviations by name, in SI units and rad; infinite for a variable
            that does not change the measure.
        cost: the sum of cost / deviation.
        slopes: derivative of the measure with respect to each variable, in SI units.
    """

    measure: str
    nominal: float
    limit: float
    deviations: Mapping[str, float]
    cost: float
    slopes: Mapping[str, float]

    def __repr__(self) -> str:
        told = ", ".join(f"{name} ± {x:.4g}" for name, x in self.deviations.items())
        return (
            f"<Allocation of {self.measure} = {self.nominal:.6g} within {self.limit:.6g}: {told}>"
        )


@explained
def allocate(
    case: Case,
    measure: str,
    limit: float,
    costs: Mapping[str, float],
    *,
    analysis: str | None = None,
) -> Allocation:
    """The cheapest tolerances that keep three standard deviations of a measure within its limit.

    A tolerance with the standard deviation σ costs c/σ. To first order, the variance of the measure
    is Σ (slope × σ)², so that σ³ is proportional to c/slope².

    Args:
        case: the case.
        measure: a statistic of a measure or quantity, such as ``"pin.max"``.
        limit: the limit, above or below the value of the case, in SI units.
        costs: c by the name of a parameter or start value.
        analysis: as for ``kp.sweep``.

    Raises:
        ModelError: an argument is invalid, or the value of the case is the limit already.
    """
    given = _given(case, costs, "costs", "{'L2': 1}")
    try:
        limit = float(limit)
    except (TypeError, ValueError):
        limit = np.nan
    if not np.isfinite(limit):
        refuse("limit", "it is not a finite number; numbers are in SI units and rad")
    found = gradient(case, [measure], list(given), analysis=analysis)
    prices, slopes = np.array([float(x) for x in given.values()]), found.jacobian[0]
    for name, price, slope in zip(given, prices, slopes, strict=True):
        if not price > 0.0:
            refuse(f"costs.{name}", f"{price:g}; must be > 0")
        if not np.isfinite(slope):
            told = found.remarks.get((measure, name), "it has no slope")
            raise ModelError(f"costs.{name}: {told}", hint="leave this variable out")
    nominal = next(iter(found.measures.values()))
    room = abs(limit - nominal)
    if not room > 0.0:
        raise ModelError(
            f"limit: {limit:g} is the value of the case, so that no tolerance is left",
            hint="change the case first, for example by kp.optimize",
        )
    moves = slopes != 0.0
    shapes = np.where(moves, np.cbrt(prices / np.where(moves, slopes, 1.0) ** 2), np.inf)
    spread = float(np.linalg.norm(slopes * np.where(moves, shapes, 0.0)))
    if not spread:
        raise ModelError(f"{measure} does not depend on {few(given)}", hint="name other variables")
    deviations = shapes * room / (_WORST * spread)
    return Allocation(
        measure,
        nominal,
        limit,
        dict(zip(given, deviations.tolist(), strict=True)),
        float((prices / deviations).sum()),
        dict(zip(given, slopes.tolist(), strict=True)),
    )
