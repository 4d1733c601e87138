"""The frequency of the strongest oscillation of a series.

A straight line with a sinusoid that grows or decays, c + d t + e^(σ t) (A cos ω t + B sin ω t), is
fitted by least squares with the weights of Hann's window. The Gauss–Newton iteration starts at the
largest peak of the spectrum with the window and at that without the window; the better fit is
returned. The frequency of a single sinusoid, decaying or not, is found to rounding accuracy. In a
periodic series with several harmonics, the strongest is found; the window suppresses the others.
"""

from __future__ import annotations

import numpy as np

from kempe import _core
from kempe.base.arrays import Floats

#: A series with fewer crossings of its mean contains no whole oscillation.
CROSSINGS = 3
#: Smaller changes are rounding errors, relative to the largest value.
NOISE = 1e-12
#: Points of the spectrum for each output, and their largest number.
_PADDING, _MOST = 8, 1 << 20
#: Iterations, and the change of ω T that ends them.
_ITERATIONS, _SMALL = 200, 1e-13
#: Largest remaining correction of ω, as a part of it, of a fit that has converged.
CONVERGED = 1e-8
#: Largest change of σ T and ω T in an iteration.
_STEP = 2.0
#: Largest |σ| times the length of the series: e^150 and its square are still numbers.
_FASTEST = 300.0


def dominant_frequency(t: Floats, values: Floats) -> float:
    """The frequency of the strongest oscillation, Hz; NaN if there is no oscillation.

    Args:
        t: (n_t,), s.
        values: (n_t,), at most half an oscillation apart.

    Returns:
        The frequency. NaN if the values cross their mean fewer than three times, so that they
        contain no whole oscillation.
    """
    found = _best(t, values)
    return float("nan") if found is None else found[1] / (2.0 * np.pi * float(abs(t[-1] - t[0])))


def slopes_of_frequency(t: Floats, values: Floats, slopes: Floats) -> Floats | None:
    """The derivatives of the frequency, (n,), from those of the values, (n_t, n), at fixed times.

    At the best fit, the weighted residual is stationary, and stays so as the values change. None
    if there is no oscillation, or if the fit has not converged.
    """
    found = _best(t, values)
    if found is None:
        return None
    (_, omega, sigma), span = found, float(abs(t[-1] - t[0]))
    s, y, size = _scaled(t, values)
    weights = _weights(s) ** 2
    columns, best, slope = _linear(s, y, sigma, omega)
    jacobian, left = np.column_stack([columns, slope]), y - columns @ best
    (_, _, cos, sin), wave = columns.T, columns[:, 2:] @ best[2:]
    curved = np.zeros((len(s), 6, 6))
    curved[:, 2, 4], curved[:, 2, 5] = s * cos, -s * sin
    curved[:, 3, 4], curved[:, 3, 5] = s * sin, s * cos
    curved += curved.transpose(0, 2, 1)
    curved[:, 4, 4], curved[:, 5, 5] = s**2 * wave, -(s**2) * wave
    curved[:, 4, 5] = curved[:, 5, 4] = s * slope[:, 1]
    matrix = jacobian.T @ (weights[:, None] * jacobian) - np.tensordot(weights * left, curved, 1)
    remainder = np.linalg.solve(matrix, jacobian.T @ (weights * left))
    if not abs(remainder[5]) <= CONVERGED * omega:
        return None
    changed = np.linalg.solve(matrix, jacobian.T @ (weights[:, None] * slopes / size))
    return np.asarray(changed[5] / (2.0 * np.pi * span))


def _best(t: Floats, values: Floats) -> tuple[float, float, float] | None:
    """The error, ω and σ of the better fit; None if there is no oscillation."""
    mean = _mean(t, values)
    side = np.sign(values - mean)[np.abs(values - mean) > NOISE * np.abs(values).max(initial=0.0)]
    if np.count_nonzero(np.diff(side)) < CROSSINGS:
        return None
    s, y, _ = _scaled(t, values)
    return min(_fitted(s, y, _spectral_peak(s, y, power)) for power in (2, 0))


def _mean(t: Floats, values: Floats) -> float:
    level = _core.integrals(t, values)
    assert level is not None
    return level[1]


def _scaled(t: Floats, values: Floats) -> tuple[Floats, Floats, float]:
    """The times from -1/2 to 1/2, the values as parts of their largest one, and this one."""
    away = values - _mean(t, values)
    size = float(np.abs(away).max())
    return np.abs(t - t[0]) / float(abs(t[-1] - t[0])) - 0.5, away / size, size


def _weights(s: Floats) -> Floats:
    return np.asarray(np.cos(np.pi * s) + 1e-3)


def _linear(s: Floats, y: Floats, sigma: float, omega: float) -> tuple[Floats, Floats, Floats]:
    """The columns of c, d, A and B, their best values, and the derivatives by σ and ω."""
    wave, weights = np.exp(sigma * s), _weights(s)[:, None]
    cos, sin = wave * np.cos(omega * s), wave * np.sin(omega * s)
    columns = np.column_stack([np.ones_like(s), s, cos, sin])
    found = np.linalg.lstsq(columns * weights, y * weights[:, 0], rcond=None)[0]
    a, b = found[2:]
    slope = np.column_stack([s * (a * cos + b * sin), s * (b * cos - a * sin)])
    return columns, np.asarray(found), slope


def _spectral_peak(s: Floats, y: Floats, power: int) -> float:
    """ω of the largest peak of the spectrum, per unit of s; with Hann's window for power 2."""
    n = len(s)
    uniform = np.linspace(-0.5, 0.5, n)
    level = np.interp(uniform, s, y - np.polynomial.Polynomial.fit(s, y, 1)(s))
    size = min(_PADDING * n, max(_MOST, n))
    spectrum = np.abs(np.fft.rfft(level * np.cos(np.pi * uniform) ** power, size))
    omega = 2.0 * np.pi * np.arange(len(spectrum)) / size * (n - 1)
    slowest = 2.0 * np.pi  # slower oscillations are mixed with the mean
    allowed = omega >= slowest
    return float(omega[allowed][spectrum[allowed].argmax()])


def _fitted(s: Floats, y: Floats, start: float) -> tuple[float, float, float]:
    """The error of the fit, ω and σ; the start if the iteration moves too far from it."""
    weights = _weights(s)
    sigma, omega = 0.0, start
    error = float("inf")
    for _ in range(_ITERATIONS):
        columns, found, slope = _linear(s, y, sigma, omega)
        error = float(np.linalg.norm(weights * (y - columns @ found)))
        slopes = np.column_stack([columns, slope])
        step = np.linalg.lstsq(slopes * weights[:, None], y * weights, rcond=None)[0][4:]
        step = np.clip(step, -_STEP, _STEP)
        sigma, omega = sigma + float(step[0]), omega + float(step[1])
        # a peak of the spectrum is as wide as its decay is fast
        if not abs(omega - start) < 2.0 * np.pi + abs(sigma) or not abs(sigma) < _FASTEST:
            return error, start, 0.0
        if abs(step[1]) <= _SMALL * omega:
            break
    return error, omega, sigma
