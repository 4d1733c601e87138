"""``kp.fit``: values of parameters that agree best with measured data."""

from __future__ import annotations

import warnings
from collections.abc import Collection, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from kempe.base.arguments import explained
from kempe.base.names import one_of
from kempe.errors import ModelError
from kempe.model.values import instance, mapping, refuse
from kempe.sweeps.asked import located
from kempe.sweeps.fits.data import Data
from kempe.sweeps.fits.experiment import experiments
from kempe.sweeps.fits.fitting import Fitting
from kempe.sweeps.fits.result import Fit
from kempe.sweeps.plan import chosen
from kempe.sweeps.problems.search import scipy
from kempe.sweeps.variables import check_names
from kempe.sweeps.wanted import MOTIONS

if TYPE_CHECKING:
    from kempe.case import Case

#: The losses for data with outliers.
LOSSES = ("soft_l1", "huber", "cauchy", "arctan")
#: In a file: no bound.
FREE = "free"


@explained
def fit(
    case: Case,
    data: Data | str | Path | Sequence[tuple[Any, Data]],
    parameters: Mapping[str, Any] | None = None,
    *,
    robust: str | None = None,
    priors: Mapping[str, tuple[float, float]] | None = None,
    analysis: str | None = None,
) -> Fit:
    """Values of parameters with the least squares of model minus data, and how sure they are.

    Args:
        case: the case; its values are the first guess.
        data: the data; a list of (case or settings, data) for several experiments, which share the
            parameters that their cases have; a CSV file for the section ``[fit]`` of the case.
        parameters: ``(least, largest)``, with None for no bound, or None, by the name of a
            parameter, or of a coordinate or rate at the start; by default those of ``[fit]``.
        robust: a loss for data with outliers: "soft_l1", "huber", "cauchy" or "arctan".
        priors: what is known before: (mean, standard deviation) by the name of a parameter.
        analysis: name of the analysis; the last one of the case by default.

    Raises:
        ModelError: an argument is invalid, SciPy is not installed, or the case itself fails.
        FileError: the file of the data cannot be read.
    """
    from kempe.case import Case

    instance(case, Case, "a case, as kp.load(path) returns")
    section = case.fit
    if isinstance(data, str | Path):
        data = data_of(case, data)
    bounds = bounds_of(parameters or section.get("parameters"))
    check_names_in(case, data, bounds)
    robust = robust or section.get("robust")
    if robust is not None:
        one_of("robust", robust, LOSSES)
    known = _priors(priors, bounds)
    given = experiments(case, data, list(bounds), analysis or section.get("analysis"))
    scipy()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return Fitting(given, bounds, known, robust).result()


def data_of(case: Case, table: Any) -> Data:
    """The data of a table, with the columns of the section ``[fit]``.

    Raises:
        ModelError: the case has no such section, or the table other headers.
    """
    section = case.fit
    if not section:
        raise ModelError("the case has no section [fit]", hint="pass a kp.Data, or declare [fit]")
    return Data(table, _t(case), section["columns"], section.get("sigma"), section.get("shift"))


def _t(case: Case) -> str | None:
    """The header of the times; None for the data of a result at rest, which have none."""
    analysis = case.analyses[chosen(case, case.fit.get("analysis"))]
    found: str | None = case.fit.get("t", "t" if analysis["type"] in MOTIONS else None)
    return found


def check(case: Case) -> str:
    """Check the section ``[fit]`` of a case without data.

    Returns:
        The fit in words.

    Raises:
        ModelError: a parameter or a quantity is invalid. The message has the file and the line.
    """
    section = case.fit
    try:
        bounds = bounds_of(section.get("parameters"))
        headers = {header: [0.0, 1.0] for header in section["columns"].values()}
        table = {str(_t(case)): [0.0, 1.0], **headers}
        columns, sigma, shift = section["columns"], section.get("sigma"), section.get("shift")
        data = Data(table, _t(case), columns, sigma, shift)
        check_names_in(case, data, bounds)
        experiments(case, data, list(bounds), section.get("analysis"))
    except ModelError as error:
        error.args = (located(case, "fit", str(error.args[0])), *error.args[1:])
        raise
    return f"{', '.join(bounds)} to {', '.join(section['columns'])}"


def bounds_of(parameters: Any) -> dict[str, tuple[float, float]]:
    """The bounds of parameters, infinite where there is none.

    Raises:
        ModelError: there are none, or one is invalid.
    """
    form = "{'J': (0, None), 'c': None}"
    given = mapping(parameters or {}, "parameters", form)
    if not given:
        raise ModelError("fit: no parameters", hint=f"pass parameters={form}, or declare [fit]")
    return {name: _bounds(name, of) for name, of in given.items()}


def _bounds(name: str, of: Any) -> tuple[float, float]:
    path = f"parameters.{name}"
    if of is None or of == FREE:
        return -np.inf, np.inf
    if not isinstance(of, list | tuple) or len(of) != 2:
        refuse(path, f"{of!r}; must be None or (least, largest), with None for no bound")
    ends = []
    for end, none in zip(of, (-np.inf, np.inf), strict=True):
        try:
            ends.append(none if end is None or end == FREE else float(end))
        except (TypeError, ValueError):
            refuse(path, f"{end!r} is not a number; numbers are in SI units and rad")
    if not ends[0] < ends[1]:
        refuse(path, f"from {ends[0]:g} to {ends[1]:g}; the second must be larger")
    return ends[0], ends[1]


def check_names_in(case: Case, data: Any, names: Collection[str]) -> None:
    """Refuse a parameter that no case has, and no data as their shift; and times alone.

    Raises:
        ModelError: there is one, or no parameter is one of a case.
    """
    pairs = data if isinstance(data, list | tuple) else [(case, data)]
    found = [pair for pair in pairs if isinstance(pair, list | tuple) and len(pair) == 2]
    shifts = {getattr(of, "shift", None) for _, of in found}
    cases = [own for own, _ in found if hasattr(own, "model")] or [case]
    in_cases = {name for one in cases for name in one.model.parameters}
    if not any(name in in_cases or name not in shifts for name in names):
        hint = "add a parameter of the model or a value at the start"
        raise ModelError("parameters: they are only times of the data", hint=hint)
    for name in names:
        if name not in shifts and ("." in name or name not in in_cases):
            check_names(cases[0], [name])


def _priors(
    priors: Mapping[str, tuple[float, float]] | None, bounds: Mapping[str, Any]
) -> dict[str, tuple[float, float]]:
    given = mapping(priors or {}, "priors", "{'J': (0.005, 0.0002)}")
    for name, pair in given.items():
        one_of("parameter in priors", name, bounds)
        try:
            mean, spread = map(float, pair)
        except (TypeError, ValueError):
            mean = spread = np.nan
        if not (np.isfinite(mean) and 0.0 < spread < np.inf):
            refuse(f"priors.{name}", f"{pair!r}; must be (mean, standard deviation > 0)")
    return {name: (float(mean), float(spread)) for name, (mean, spread) in given.items()}
