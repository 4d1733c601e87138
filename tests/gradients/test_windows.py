"""Slopes of N windows of equal links, the N-four-bar, against elliptic functions.

All uprights turn by one angle, and the bars between them only move along. With the angle x from the
lowest position, uprights have the energy (N + 1) (m L² x'²/6 - m g L cos(x)/2), and bars that of N
points, N (m L² x'²/2 - m g L cos(x)). The motion is that of a pendulum, x'' = -w² sin(x), with
w² = (3 g / 2 L) (3 N + 1)/(4 N + 1).
"""

import kempe as kp
import numpy as np
import pytest
from scipy.optimize import brentq
from scipy.special import ellipeinc, ellipj, ellipk, ellipkinc
from sizes import count

EXACT = kp.DOP853(rtol=1e-12, atol=1e-14)
SIZES = [1, 2, 5, 40] if count(1, 2) == 1 else list(range(1, 41))
SCALES = [(1.0, 1.0, 1.0), (1e-3, 1e3, 30.0)]


def windows(n: int, scale: tuple[float, float, float]) -> tuple[kp.Model, float]:
    """The model, and the rate w of small swings."""
    size, mass, rate = scale
    g = 9.0 * rate**2 * size
    m = kp.Model("windows", gravity=(0, "-g"), parameters={"g": g, "L": size, "m": mass})
    m.ground.points(**{f"P{k}": (f"{k}*L", 0) for k in range(n + 1)})
    for k in range(n + 1):
        m.bar(f"up{k}", mass="m", length="L", ends=("O", "A"))
        m.revolute(f"O{k}", f"ground.P{k}", f"up{k}.O")
    for k in range(n):
        m.bar(f"bar{k}", mass="m", length="L", ends=("A", "B"))
        m.revolute(f"A{k}", f"up{k}.A", f"bar{k}.A")
        m.revolute(f"B{k}", f"bar{k}.B", f"up{k + 1}.A")
    return m, float(np.sqrt(1.5 * g / size * (3 * n + 1) / (4 * n + 1)))


def run(m: kp.Model, n: int, start: tuple[float, float], end: float) -> kp.Gradient:
    angle, rate = start
    guess = {f"up{k}.angle": angle for k in range(1, n + 1)} | {
        f"bar{k}.angle": 0.0 for k in range(n)
    }
    begin = {"set": {"up0.angle": angle, "up0.omega": rate}, "guess": guess}
    case = kp.Case(m, begin, [kp.Dynamics(t_end=end, output_step=end / 3, method=EXACT)])
    last = f"up{n}"
    return kp.gradient(case, [f"{last}.angle.final", f"{last}.omega.final"], ["g", "L", "m"])


def agrees(g: kp.Gradient, x: float, v: float, by_g: tuple[float, float], rel: float) -> None:
    """The motion depends on g/L only."""
    angle, omega = list(g.measures)
    assert g.measures[angle] == pytest.approx(x - np.pi / 2, rel=rel)
    assert g.measures[omega] == pytest.approx(v, rel=rel)
    ratio = g.variables["g"] / g.variables["L"]
    for measure, true in zip((angle, omega), by_g, strict=True):
        assert g[measure, "g"] == pytest.approx(true, rel=rel)
        assert g[measure, "L"] == pytest.approx(-true * ratio, rel=rel)
        assert abs(g[measure, "m"]) * g.variables["m"] <= rel * abs(true) * g.variables["g"]
    assert not g.remarks


@pytest.mark.parametrize("scale", SCALES)
@pytest.mark.parametrize("n", SIZES)
def test_a_swing(n: int, scale: tuple[float, float, float]) -> None:
    """From rest at 65° from the lowest position: sin(x/2) = k cd(w t, k)."""
    m, w = windows(n, scale)
    swing, end = np.radians(65.0), 1.3 / scale[2]
    k = np.sin(swing / 2)
    found = run(m, n, (swing - np.pi / 2, 0.0), end)
    u = w * end
    sn, _, dn, _ = ellipj(u + ellipk(k**2), k**2)  # cd(u) = sn(u + K)
    x = 2 * np.arcsin(k * sn)
    v = np.sign(np.sin(u)) * 0.0 + 2 * k * w * ellipj(u + ellipk(k**2), k**2)[1]
    assert dn > 0
    # x is a function of w t: dx/dg = x' t w'/w, with w'/w = 1/(2 g); and dv/dg likewise
    part = 1 / (2 * found.variables["g"])
    by_g = v * end * part, (v - w**2 * np.sin(x) * end) * part
    agrees(found, x, v, by_g, 1e-8)


@pytest.mark.parametrize("scale", SCALES)
@pytest.mark.parametrize("n", SIZES)
def test_a_fall_from_the_top(n: int, scale: tuple[float, float, float]) -> None:
    """From the top with the rate -r: t = (2/r) F(y | -4 w²/r²) and y half the angle."""
    m, w = windows(n, scale)
    rate = scale[2]
    end = 0.35 / rate
    found = run(m, n, (np.pi / 2, -rate), end)
    mu = -4 * w**2 / rate**2

    def late(y: float) -> float:
        return float(ellipkinc(y, mu)) - rate * end / 2

    y = float(brentq(late, 0.0, 1.5, xtol=1e-15, rtol=1e-15))
    root = np.sqrt(1 - mu * np.sin(y) ** 2)
    whole, part = ellipeinc(y, mu), ellipkinc(y, mu)
    by_mu = whole / (2 * mu * (1 - mu)) - part / (2 * mu) - np.sin(2 * y) / (4 * (1 - mu) * root)
    dmu = mu / found.variables["g"]  # mu is proportional to g
    dy = -by_mu * root * dmu
    x, v = np.pi - 2 * y, -rate * root
    dv = rate * (np.sin(y) ** 2 * dmu + mu * np.sin(2 * y) * dy) / (2 * root)
    agrees(found, x, v, (-2 * dy, dv), 1e-8)
