"""The search of a fit, and the standard errors of its values."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from kempe.base.arrays import Floats
from kempe.base.display_units import display
from kempe.errors import InternalError, KempeError, ModelError
from kempe.sweeps.fits.experiment import Experiment
from kempe.sweeps.fits.profile import Profile
from kempe.sweeps.fits.result import Fit, remarks_on
from kempe.sweeps.fits.undetermined import determined
from kempe.sweeps.problems.search import scipy
from kempe.sweeps.variables import present

#: Relative change of values at which a search ends; most runs of a search; rounds for sigma.
_SMALL, _MOST, _ROUNDS = 1e-9, 300, 6
#: Shifts of the time that are tried before a search, which finds only the nearest agreement.
_SHIFTS = 201
#: What to do about data outside of the run.
_OUTSIDE = "change t_end or range of the analysis, or leave out the data before or after the run"
#: Part of a width by which the ends of an interval differ from linear ones with a remark.
_BENT = 0.1
#: The probability of an interval.
_PROBABILITY = 0.95


class Fitting:
    """The search of a fit."""

    def __init__(
        self,
        given: Sequence[Experiment],
        bounds: Mapping[str, tuple[float, float]],
        priors: Mapping[str, tuple[float, float]],
        robust: str | None,
    ) -> None:
        self.given, self.bounds, self.priors, self.robust = given, bounds, priors, robust
        self.names = list(bounds)
        self.runs = 0
        self._shifts: dict[str, float] = {}
        self.sigma: dict[str, Any] = {}
        self.sizes: dict[str, int] = {}
        known: dict[str, list[float]] = {}
        for one in given:
            for name, of in one.data.values.items():
                self.sizes[name] = self.sizes.get(name, 0) + len(of)
                known.setdefault(name, []).append(float(np.std(of)) or 1.0)
        self.sigma |= {name: max(of) for name, of in known.items()}
        self.scales = dict(self.sigma)
        given_sigma = {name: _given_sigma(given, name) for name in known}
        self.sigma |= {name: of for name, of in given_sigma.items() if of is not None}
        self.given_sigma = {name for name, of in given_sigma.items() if of is not None}
        #: Whether no residual is left over from which errors could follow.
        count = sum(self.sizes.values()) + len(priors)
        self.starved = count <= len(bounds) and self.given_sigma != set(known)
        self._seen: tuple[bytes, dict[str, tuple[Floats, Floats]] | None] | None = None

    def start(self) -> Floats:
        """The values of the cases, within the bounds."""
        found: dict[str, float] = {}
        for one in self.given:
            found = {**present(one.case, one.plan.names), **found}
        found = {**dict.fromkeys(self.names, 0.0), **found, **self._shifts}
        pairs = ((found[name], *self.bounds[name]) for name in self.names)
        return np.array([float(np.clip(x, least, largest)) for x, least, largest in pairs])

    def apart(self, values: Floats) -> dict[str, tuple[Floats, Floats]]:
        """Model minus data by quantity, with derivatives, of all experiments.

        Raises:
            KempeError: a run fails.
        """
        found: dict[str, list[tuple[Floats, Floats]]] = {}
        self.runs += 1
        for one in self.given:
            for name, pair in one.apart(values).items():
                found.setdefault(name, []).append(pair)
        return {
            name: (np.concatenate([a for a, _ in of]), np.concatenate([b for _, b in of]))
            for name, of in found.items()
        }

    def _at(self, values: Floats) -> dict[str, tuple[Floats, Floats]] | None:
        """The same, computed once for a point; None where a run fails."""
        key = values.tobytes()
        if self._seen is None or self._seen[0] != key:
            try:
                self._seen = key, self.apart(values)
            except InternalError:
                raise
            except KempeError:
                self._seen = key, None
        return self._seen[1]

    def scaled(self, values: Floats) -> tuple[Floats, Floats] | None:
        """Residuals in standard deviations with priors, and their derivatives; None if it fails."""
        found = self._at(values)
        if found is None:
            return None
        rows = [
            (of / self.sigma[name], by / np.reshape(self.sigma[name], (-1, 1)))
            for name, (of, by) in found.items()
        ]
        for name, (mean, spread) in self.priors.items():
            k = self.names.index(name)
            rows.append(
                (np.array([(values[k] - mean) / spread]), np.eye(len(values))[k : k + 1] / spread)
            )
        return np.concatenate([a for a, _ in rows]), np.concatenate([b for _, b in rows])

    def _searched(self, values: Floats) -> Any:
        """The least squares from a point."""
        last = self.scaled(values)
        assert last is not None
        known = [last]

        def residuals(at: Floats) -> Floats:
            found = self.scaled(at)
            if found is None:  # a wall
                return np.abs(known[-1][0]) * 10.0 + 1.0
            known[-1] = found
            return found[0]

        def slopes(at: Floats) -> Floats:
            found = self.scaled(at)
            return (known[-1] if found is None else found)[1]

        return scipy().least_squares(
            residuals,
            values,
            jac=slopes,
            bounds=tuple(np.array(list(self.bounds.values())).T),
            x_scale="jac",
            loss=self.robust or "linear",
            ftol=1e-14,
            xtol=_SMALL,
            gtol=1e-14,
            max_nfev=_MOST,
        )

    def _estimate(self, values: Floats) -> bool:
        """Standard deviations from the residuals where none are given; whether they changed."""
        found, changed = self._at(values), False
        assert found is not None
        total = sum(self.sizes.values())
        for name, (of, _) in found.items():
            if name in self.given_sigma:
                continue
            freedom = max(1.0, len(of) * (1.0 - len(self.names) / total))
            if self.robust:
                size = 1.4826 * float(np.median(np.abs(of)))
            else:
                size = float(np.sqrt(of @ of / freedom))
            size = max(size, 1e-14 * self.scales[name])
            changed |= abs(size / self.sigma[name] - 1.0) > 1e-3
            self.sigma[name] = size
        return changed

    def result(self) -> Fit:
        """The fit.

        Raises:
            KempeError: the case itself fails.
        """
        self._reached()
        values = self.start()
        self.apart(values)  # an error of the first run is raised
        for _ in range(_ROUNDS):
            found = self._searched(values)
            values = found.x
            several = len(self.sizes) > 1 or bool(self.robust) or bool(self.priors)
            if self.starved or not self._estimate(values) or not several:
                break
        return self._told(values, found.status > 0)

    def _reached(self) -> None:
        """Bounds of the shifts with which all data are within the runs.

        Raises:
            ModelError: there are none.
        """
        values, bounds = self.start(), dict(self.bounds)
        for one in self.given:
            if not one.is_motion:
                continue
            least, largest = one.reach(values[list(one.places)])
            name = None if one.shift is None else self.names[one.shift]
            own = (0.0, 0.0) if name is None else bounds[name]
            low, high = max(least, own[0]), min(largest, own[1])
            if low > high or (name is not None and low == high):
                raise ModelError(_outside(one, (least, largest), name), hint=_OUTSIDE)
            if name is not None:
                bounds[name] = (low, high)
        self.bounds = bounds
        for k, name in enumerate(self.names):
            with_it = [one for one in self.given if one.shift == k]
            if with_it:
                tried = np.linspace(*bounds[name], _SHIFTS)
                apart = [
                    one.misfits(values[list(one.places)], tried, self.scales) for one in with_it
                ]
                self._shifts[name] = float(tried[np.argmin(np.sum(apart, axis=0))])

    def _told(self, values: Floats, success: bool) -> Fit:
        scaled, raw = self.scaled(values), self._at(values)
        assert scaled is not None and raw is not None
        residuals, jacobian = scaled
        known = determined(self.names, self._magnitudes(), values, jacobian)
        covariance = known.covariance
        if self.robust:
            covariance = covariance * self._robust(residuals)
        if self.starved:
            covariance = np.full_like(covariance, np.inf)
        errors = np.sqrt(np.diag(covariance))
        with np.errstate(invalid="ignore"):
            correlation = covariance / np.outer(errors, errors)
        free = np.isinf(errors)
        correlation[free, :] = correlation[:, free] = np.nan
        named = dict(zip(self.names, values.tolist(), strict=True))
        freedom = max(1, len(residuals) - len(self.names))
        quantile = _quantile(freedom, exact=self.given_sigma == set(self.sizes))
        intervals, bent = self._intervals(values, covariance, quantile)
        parts = {name: of / self.sigma[name] for name, (of, _) in raw.items()}
        is_given = self.given_sigma == set(self.sizes)
        remarks = remarks_on(named, self.bounds, parts, (is_given, len(self.names)))
        remarks += [
            f"the interval of {name} is that of the profile likelihood; a linear one would mislead"
            for name in bent
        ]
        sigma = dict(self.sigma)
        if self.starved:
            sigma |= {name: np.nan for name in sigma if name not in self.given_sigma}
            remarks.append(
                f"{len(residuals)} values for {len(self.names)} parameters leave nothing from "
                "which errors follow: give sigma, or more values"
            )
        rest = ({name: of for name, (of, _) in raw.items()}, sigma, remarks)
        return Fit(
            self.given,
            named,
            (errors, correlation, intervals),
            known.texts,
            rest,
            (success, self.runs),
        )

    def _intervals(
        self, values: Floats, covariance: Floats, quantile: float
    ) -> tuple[dict[str, tuple[float, float]], list[str]]:
        """The intervals within the bounds, and the parameters whose linear ones mislead."""
        ends = np.array(list(self.bounds.values()))
        profile = Profile(self.scaled, values, ends, quantile)
        intervals, bent = {}, []
        for k, name in enumerate(self.names):
            width = quantile * np.sqrt(covariance[k, k])
            pair = np.array([values[k] - width, values[k] + width])
            is_inside = ends[k, 0] < values[k] < ends[k, 1]
            if np.isfinite(width) and width > 0.0 and not self.robust and is_inside:
                along = covariance[:, k] / covariance[k, k]
                along = np.where(np.isfinite(along), along, 0.0)
                linear = np.clip(pair, *ends[k])
                beyond = (linear != pair).any()
                if beyond or any(profile.misleads(k, x, along) for x in linear):
                    exact = [profile.end(k, x) for x in (-width, width)]
                    if not np.allclose(exact, linear, rtol=0.0, atol=_BENT * width):
                        bent.append(name)
                    pair = np.array(exact)
            intervals[name] = (float(max(pair[0], ends[k, 0])), float(min(pair[1], ends[k, 1])))
        return intervals, bent

    def _magnitudes(self) -> Floats:
        """How large the parameters are before the fit; 0 where nothing is known."""
        widths = [largest - least for least, largest in self.bounds.values()]
        return np.maximum(np.abs(self.start()), np.where(np.isfinite(widths), widths, 0.0))

    def _robust(self, residuals: Floats) -> float:
        """The factor of the covariance in a fit with a loss (Huber 1981, section 7.6)."""
        psi, slope = _influence(str(self.robust), residuals)
        count, mean = len(residuals), float(slope.mean())
        freedom = max(1, count - len(self.names))
        spread = float(slope.var()) / max(mean, 1e-300) ** 2
        more = 1.0 + len(self.names) / count * spread  # for few residuals
        return more**2 * float(psi @ psi) / freedom / max(mean, 1e-300) ** 2


def _outside(one: Experiment, room: tuple[float, float], name: str | None) -> str:
    """Data that are outside of the run, in words."""
    first, last = one.times[0], one.times[-1]
    begin, end = first + room[0], last + room[1]
    unit = display(one.unit_of_t)
    ends = [f"{x / unit.divisor:.6g}" for x in (first, last, begin, end)]
    told = f"data: they go from {ends[0]} to {ends[1]} {unit.symbol}".rstrip()
    told = f"{told}, and the run from {ends[2]} to {ends[3]} {unit.symbol}".rstrip()
    return f"{told}, which no {name} within its bounds can join" if name else told


def _given_sigma(given: Sequence[Experiment], name: str) -> Any:
    """The standard deviation of a quantity, for each value if experiments differ; None without.

    Raises:
        ModelError: some experiments have one, and others have none.
    """
    data = [one.data for one in given if name in one.data.values]
    found = {one.sigma.get(name) for one in data}
    if len(found) == 1:
        return found.pop()
    if None in found:
        raise ModelError(
            f"sigma: {name} has a standard deviation in one experiment and none in another",
            hint="give sigma in all experiments, or in none",
        )
    return np.concatenate([np.full(len(one.values[name]), one.sigma[name]) for one in data])


def _influence(loss: str, residuals: Floats) -> tuple[Floats, Floats]:
    """Half the derivative of a loss of SciPy by a residual, and the derivative of this."""
    square = residuals**2
    if loss == "soft_l1":
        weight, slope = (1.0 + square) ** -0.5, (1.0 + square) ** -1.5
    elif loss == "huber":
        inside = square <= 1.0
        weight = np.where(inside, 1.0, np.maximum(square, 1.0) ** -0.5)
        slope = inside.astype(np.float64)
    elif loss == "cauchy":
        weight, slope = 1.0 / (1.0 + square), (1.0 - square) / (1.0 + square) ** 2
    else:
        weight = 1.0 / (1.0 + square**2)
        slope = (1.0 - 3.0 * square**2) * weight**2
    return residuals * weight, slope


def _quantile(freedom: int, *, exact: bool) -> float:
    """The half width of an interval in standard errors: normal, or Student's t."""
    from scipy import stats

    share = 0.5 + _PROBABILITY / 2.0
    return float(stats.norm.ppf(share) if exact else stats.t.ppf(share, freedom))
