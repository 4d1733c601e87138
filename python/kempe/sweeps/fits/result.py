"""The result of a fit: values, how sure they are, and what remains."""

from __future__ import annotations

import csv
import io
from collections.abc import Mapping, Sequence
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np

from kempe.base import files
from kempe.base.arguments import explain_methods
from kempe.base.arrays import Floats, fixed
from kempe.sweeps.variables import changed

if TYPE_CHECKING:
    from kempe.case import Case
    from kempe.sweeps.fits.experiment import Experiment


@explain_methods
class Fit:
    """Values of parameters that agree best with data.

    Attributes:
        values: the values by name, in SI units and rad.
        standard_errors: their standard errors; infinite for those that are not determined.
        intervals: intervals that contain the true values with 95 %, within the bounds.
        correlation: the correlation of the errors, (n, n), in the order of ``values``; NaN for
            those that are not determined.
        undetermined: what the data cannot determine, in words; empty if all is determined.
        residuals: model minus data by quantity, of all experiments one after the other.
        sigma: standard deviation of the measured values by quantity: as given, or from the
            residuals; NaN if none are left over for it, and an array in the order of residuals if
            experiments differ.
        case: the case with the values; of several experiments the first.
        cases: the case of each experiment.
        remarks: what speaks against the model, such as residuals with structure.
        success: whether the search ended by itself.
        runs: number of runs of each experiment.
        units: SI units of parameters and quantities; empty for an unknown one.
    """

    def __init__(  # noqa: PLR0917 - only the search makes it
        self,
        experiments: Sequence[Experiment],
        values: Mapping[str, float],
        found: tuple[Floats, Floats, Mapping[str, tuple[float, float]]],
        undetermined: Sequence[str],
        rest: tuple[Mapping[str, Floats], Mapping[str, Any], Sequence[str]],
        how: tuple[bool, int],
    ) -> None:
        errors, correlation, intervals = found
        self._experiments = tuple(experiments)
        self.values = MappingProxyType(dict(values))
        self.standard_errors = MappingProxyType(dict(zip(values, errors.tolist(), strict=True)))
        self.intervals = MappingProxyType(dict(intervals))
        self.correlation = fixed(correlation)
        self.undetermined = tuple(undetermined)
        residuals, sigma, remarks = rest
        self.residuals = MappingProxyType({name: fixed(of) for name, of in residuals.items()})
        self.sigma = MappingProxyType(dict(sigma))
        self.remarks = tuple(remarks)
        self.success, self.runs = how
        self.cases: tuple[Case, ...] = tuple(_changed(one, values) for one in experiments)
        self.case = self.cases[0]
        units = {name: of for one in experiments for name, of in one.units.items()}
        for one in experiments:
            units |= {name: one.plan.unit_of(name) for name in one.plan.names}
        self.units = MappingProxyType(units)

    def to_csv(self, path: Path | str) -> None:
        """Write data, model and residuals as CSV in SI units and rad, a row for each value.

        Raises:
            FileError: the file cannot be written; an existing file is not changed.
        """
        text = io.StringIO()
        write = csv.writer(text, lineterminator="\n").writerow
        write(["experiment", "quantity", "t", "data", "model", "residual"])
        begins = dict.fromkeys(self.residuals, 0)
        for k, one in enumerate(self._experiments):
            for name, data in one.data.values.items():
                begin = begins[name]
                begins[name] += len(data)
                apart = self.residuals[name][begin : begins[name]]
                for t, value, of in zip(one.data.t[name], data, apart, strict=True):
                    write([k, name, *(f"{x:.17g}" for x in (t, value, value + of, of))])
        files.write_text(path, text.getvalue())

    def __repr__(self) -> str:
        pairs = zip(self.values.items(), self.standard_errors.values(), strict=True)
        told = ", ".join(f"{name} = {x:.6g} ± {error:.2g}" for (name, x), error in pairs)
        return "; ".join([f"<Fit: {told}", *self.undetermined, *self.remarks]) + ">"


def _changed(one: Experiment, values: Mapping[str, float]) -> Case:
    """The case of an experiment with the values of its parameters."""
    return changed(one.case, {name: values[name] for name in one.plan.names})


def remarks_on(
    values: Mapping[str, float],
    bounds: Mapping[str, tuple[float, float]],
    scaled: Mapping[str, Floats],
    known: tuple[bool, int],
) -> list[str]:
    """What speaks against a model: active bounds, large residuals, residuals with structure.

    Args:
        values: the values.
        bounds: their bounds.
        scaled: the residuals in standard deviations.
        known: whether the standard deviations were given; the number of parameters.
    """
    told = []
    for name, x in values.items():
        least, largest = bounds[name]
        size = largest - least if np.isfinite(largest - least) else max(abs(x), 1e-300)
        for end in (least, largest):
            if abs(x - end) <= 1e-6 * size:
                told.append(f"{name} is at its bound {end:g}, so that its interval is one-sided")
    is_given, count = known
    freedom = max(1, sum(len(of) for of in scaled.values()) - count)
    excess = sum(float(of @ of) for of in scaled.values()) / freedom
    if is_given and excess > 1.0 + 4.0 * np.sqrt(2.0 / freedom):
        told.append(
            f"the model does not explain the data: the residuals are {np.sqrt(excess):.3g} times "
            "as large as sigma"
        )
    return told + [text for name, of in scaled.items() if (text := _structure(name, of))]


def _structure(name: str, residuals: Floats) -> str:
    """Whether the signs of residuals change more rarely than by chance (Wald and Wolfowitz)."""
    signs = np.sign(residuals[residuals != 0.0])
    up, down = int((signs > 0.0).sum()), int((signs < 0.0).sum())
    n = up + down
    if min(up, down) < 5:
        return ""
    runs = 1 + int((np.diff(signs) != 0.0).sum())
    mean = 1.0 + 2.0 * up * down / n
    deviation = np.sqrt((mean - 1.0) * (mean - 2.0) / (n - 1.0))
    if runs > mean - 4.0 * deviation:
        return ""
    return (
        f"the residuals of {name} have structure: their signs change {runs - 1} times, by chance "
        f"about {mean - 1.0:.0f} times; something is missing in the model"
    )
