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
    level = _core.integrals(t, values)
    assert level is not None
    mean = level[1]
    side = np.sign(values - mean)[np.abs(values - mean) > NOISE * np.abs(values).max(initial=0.0)]
    if np.count_nonzero(np.diff(side)) < CROSSINGS:
        return float("nan")
    span = float(abs(t[-1] - t[0]))
    s = np.abs(t - t[0]) / span - 0.5  # from -1/2 to 1/2
    y = (values - mean) / np.abs(values - mean).max()
    fits = [_fitted(s, y, _spectral_peak(s, y, power)) for power in (2, 0)]
    return min(fits)[1] / (2.0 * np.pi * span)


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


def _fitted(s: Floats, y: Floats, start: float) -> tuple[float, float]:
    """The error of the fit and ω; the start if the iteration moves too far from it."""
    weights = np.cos(np.pi * s) + 1e-3
    sigma, omega = 0.0, start
    error = float("inf")
    for _ in range(_ITERATIONS):
        wave = np.exp(sigma * s)
        cos, sin = wave * np.cos(omega * s), wave * np.sin(omega * s)
        columns = np.column_stack([np.ones_like(s), s, cos, sin])
        found = np.linalg.lstsq(columns * weights[:, None], y * weights, rcond=None)[0]
        error = float(np.linalg.norm(weights * (y - columns @ found)))
        a, b = found[2:]
        slopes = np.column_stack([columns, s * (a * cos + b * sin), s * (b * cos - a * sin)])
        step = np.linalg.lstsq(slopes * weights[:, None], y * weights, rcond=None)[0][4:]
        step = np.clip(step, -_STEP, _STEP)
        sigma, omega = sigma + float(step[0]), omega + float(step[1])
        # a peak of the spectrum is as wide as its decay is fast
        if not abs(omega - start) < 2.0 * np.pi + abs(sigma) or not abs(sigma) < _FASTEST:
            return error, start
        if abs(step[1]) <= _SMALL * omega:
            break
    return error, omega
