"""Tolerances: the scatter of a measure that follows from the scatter of parameters."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from kempe.base.arguments import explained
from kempe.base.arrays import Floats
from kempe.errors import ModelError
from kempe.model.values import mapping, numbers
from kempe.sweeps.result import SweepResult
from kempe.sweeps.run import sweep
from kempe.sweeps.variables import present

if TYPE_CHECKING:
    from kempe.case import Case

#: Number of standard deviations to both sides of the nominal value for the central difference.
_STEP = 0.5


@dataclass(frozen=True, repr=False)
class Tolerances:
    """The scatter of a measure.

    Attributes:
        measure: its text, such as ``pin.max``.
        unit: its SI unit.
        nominal: its value in the unchanged case.
        mean: mean of the variants.
        deviation: standard deviation of the variants.
        first_order: the standard deviation from slopes: √Σ (slope × deviation)².
        slopes: derivative of the measure with respect to each variable, in SI units.
        contributions: share of each variable in ``first_order`` squared; they sum to 1.
        sample: the variants.
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
    **options: Any,
) -> Tolerances:
    """The scatter of a measure: by random variants, and to first order.

    Every variable has a normal distribution about its value in the case. The first-order estimate
    uses slopes from central differences over one standard deviation. If the two estimates differ,
    the measure is not linear within the tolerances.

    Args:
        case: the case.
        deviations: standard deviations by the name of a parameter or start value, SI units:
            ``{"L2": 0.05}``.
        measure: a statistic of a measure or quantity, such as ``"pin.max"``.
        n: number of random variants.
        seed: as for ``kp.sweep``.
        analysis: as for ``kp.sweep``.
        **options: ``workers``, ``scheduler``, ``out`` and ``progress`` of ``kp.sweep``, for the
            random variants.

    Raises:
        ModelError: a name or number is invalid, a value at the start is not a number, or the case
            itself or a variant for a slope fails; the message has its reason.
    """
    given = numbers(mapping(deviations, "deviations", "{'L2': 0.05}"), "deviations")
    middle = present(case, given)  # the sweep refuses unknown names
    spread = {name: {"normal": [middle[name], x]} for name, x in given.items()}
    sample = sweep(
        case, spread, [measure], design="random", n=n, seed=seed, analysis=analysis, **options
    )
    widths = np.array([float(x) for x in given.values()])
    nominal, slopes = _slopes(case, middle, widths, (measure, analysis))
    variances = (slopes * widths) ** 2
    total = float(variances.sum())
    shares = variances / total if total > 0.0 else np.zeros(len(widths))
    found = sample[measure][sample.succeeded]
    if len(found) < 2:
        raise ModelError("fewer than two random variants succeed", hint="take smaller deviations")
    return Tolerances(
        measure,
        sample.units[measure],
        nominal,
        float(found.mean()),
        float(found.std(ddof=1)),
        float(np.sqrt(total)),
        dict(zip(given, slopes.tolist(), strict=True)),
        dict(zip(given, shares.tolist(), strict=True)),
        sample,
    )


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
