"""The search of a fit, and the standard errors of its values."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from kempe.base.arrays import Floats
from kempe.errors import InternalError, KempeError
from kempe.sweeps.fits.experiment import Experiment
from kempe.sweeps.fits.result import Fit, remarks_on
from kempe.sweeps.fits.undetermined import determined
from kempe.sweeps.problems.search import scipy
from kempe.sweeps.variables import present

#: Relative change of values at which a search ends; most runs of a search; rounds for sigma.
_SMALL, _MOST, _ROUNDS = 1e-9, 300, 6
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
        self.sigma: dict[str, float] = {}
        self.sizes: dict[str, int] = {}
        known: dict[str, list[float]] = {}
        for one in given:
            for name, of in one.data.values.items():
                self.sizes[name] = self.sizes.get(name, 0) + len(of)
                known.setdefault(name, []).append(float(np.std(of)) or 1.0)
            for name, sigma in one.data.sigma.items():
                self.sigma[name] = sigma
        self.given_sigma = set(self.sigma)
        self.sigma |= {name: max(of) for name, of in known.items() if name not in self.sigma}
        self._seen: tuple[bytes, dict[str, tuple[Floats, Floats]] | None] | None = None

    def start(self) -> Floats:
        """The values of the cases, within the bounds."""
        found: dict[str, float] = {}
        for one in self.given:
            found = {**present(one.case, one.plan.names), **found}
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
        rows = [(of / self.sigma[name], by / self.sigma[name]) for name, (of, by) in found.items()]
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
            size = max(size, 1e-12 * float(np.abs(of).max(initial=0.0)), 1e-300)
            changed |= abs(size / self.sigma[name] - 1.0) > 1e-3
            self.sigma[name] = size
        return changed

    def result(self) -> Fit:
        """The fit.

        Raises:
            KempeError: the case itself fails.
        """
        values = self.start()
        self.apart(values)  # an error of the first run is raised
        for _ in range(_ROUNDS):
            found = self._searched(values)
            values = found.x
            several = len(self.sizes) > 1 or bool(self.robust) or bool(self.priors)
            if not self._estimate(values) or not several:
                break
        return self._told(values, found.status > 0)

    def _told(self, values: Floats, success: bool) -> Fit:
        scaled, raw = self.scaled(values), self._at(values)
        assert scaled is not None and raw is not None
        residuals, jacobian = scaled
        known = determined(self.names, values, jacobian)
        covariance = known.covariance
        if self.robust:
            covariance = self._robust(residuals, jacobian, known.free)
        errors = np.sqrt(np.diag(covariance))
        with np.errstate(invalid="ignore"):
            correlation = covariance / np.outer(errors, errors)
        correlation[known.free, :] = correlation[:, known.free] = np.nan
        named = dict(zip(self.names, values.tolist(), strict=True))
        freedom = max(1, len(residuals) - len(self.names))
        width = _quantile(freedom, exact=self.given_sigma == set(self.sizes)) * errors
        intervals = {}
        for k, (name, (least, largest)) in enumerate(self.bounds.items()):
            low, high = values[k] - width[k], values[k] + width[k]
            intervals[name] = (float(max(low, least)), float(min(high, largest)))
        parts = {name: of / self.sigma[name] for name, (of, _) in raw.items()}
        is_given = self.given_sigma == set(self.sizes)
        remarks = remarks_on(named, self.bounds, parts, (is_given, len(self.names)))
        rest = ({name: of for name, (of, _) in raw.items()}, self.sigma, remarks)
        return Fit(
            self.given,
            named,
            (errors, correlation, intervals),
            known.texts,
            rest,
            (success, self.runs),
        )

    def _robust(self, residuals: Floats, jacobian: Floats, free: Any) -> Floats:
        """The covariance of a robust fit: the weights of SciPy's loss (Huber's sandwich)."""
        weights = _weights(str(self.robust), residuals**2)
        whole = determined(
            self.names, np.ones(len(self.names)), jacobian * np.sqrt(weights)[:, None]
        )
        inner = (jacobian * (weights * residuals)[:, None]).T
        bread = np.where(np.isfinite(whole.covariance), whole.covariance, 0.0)
        count = len(residuals) / max(1, len(residuals) - len(self.names))
        found = bread @ (inner @ inner.T) @ bread * count
        found[free, free] = np.inf
        return np.asarray(found)


def _weights(loss: str, square: Floats) -> Floats:
    """The derivative of a loss of SciPy by the square of a residual."""
    if loss == "soft_l1":
        return np.asarray((1.0 + square) ** -0.5)
    if loss == "huber":
        return np.where(square <= 1.0, 1.0, np.maximum(square, 1.0) ** -0.5)
    return 1.0 / (1.0 + (square if loss == "cauchy" else square**2))


def _quantile(freedom: int, *, exact: bool) -> float:
    """The half width of an interval in standard errors: normal, or Student's t."""
    from scipy import stats

    share = 0.5 + _PROBABILITY / 2.0
    return float(stats.norm.ppf(share) if exact else stats.t.ppf(share, freedom))
