"""Convex curves, their places and their distances by own programs, for contacts."""

from typing import Any

import numpy as np
from scipy.optimize import brentq, minimize, minimize_scalar

G = 9.81
TURN = 2 * np.pi
#: Masses and sizes.
SCALES = [(1.0, 1.0), (1e-3, 1e3), (1e3, 1e-3)]
#: Half axes of ellipses.
ROUND, THIN = (0.5, 0.3), (0.7, 0.1)
EGG = "0.3 + 0.05*cos(u) + 0.01*cos(2*u)"
TRIANGLE = [(-0.3, -0.2), (0.4, -0.1), (-0.1, 0.35)]
POSES = ["x", "y", "angle"]
RATES = ["vx", "vy", "omega"]


def ellipse(half: tuple[float, float], size: float = 1.0, sign: int = 1) -> dict[str, Any]:
    a, b = half
    x, y = f"{a * size!r}*cos(u)", f"{sign * b * size!r}*sin(u)"
    return {"x": x, "y": y, "range": [0, "2*pi"], "periodic": True}


def on_ellipse(half: tuple[float, float], u: Any) -> Any:
    return np.array([half[0] * np.cos(u), half[1] * np.sin(u)])


def on_egg(u: Any) -> Any:
    return (0.3 + 0.05 * np.cos(u) + 0.01 * np.cos(2 * u)) * np.array([np.cos(u), np.sin(u)])


def placed(pose: Any, points: Any) -> Any:
    x, y, angle = pose
    c, s = np.cos(angle), np.sin(angle)
    return np.array([x + c * points[0] - s * points[1], y + s * points[0] + c * points[1]])


def posed(body: str, pose: Any, rates: Any = (0, 0, 0)) -> dict[str, float]:
    values = [*pose, *rates]
    return {f"{body}.{k}": float(v) for k, v in zip(POSES + RATES, values, strict=True)}


def sides(corners: Any) -> list[Any]:
    """The sides of a polygon as functions of 0 to 1."""
    ends = np.array(corners, dtype=float)
    both = zip(ends, np.roll(ends, -1, axis=0), strict=True)
    return [lambda t, p=p, q=q: p[:, None] + np.outer(q - p, np.atleast_1d(t)) for p, q in both]


def separation(parts_i: Any, parts_j: Any) -> float:
    """The largest distance between two parallel lines that part two convex bodies, from many
    points of both. Negative if the bodies overlap."""
    i, j = np.hstack(parts_i), np.hstack(parts_j)

    def apart(theta: float) -> float:
        n = np.array([np.cos(theta), np.sin(theta)])
        return float((n @ i).min() - (n @ j).max())

    step = TURN / 720
    all_around = [apart(step * k) for k in range(720)]
    best = step * int(np.argmax(all_around))
    found = minimize_scalar(
        lambda theta: -apart(theta), bounds=(best - step, best + step), options={"xatol": 1e-10}
    )
    return float(-found.fun)


def extreme(half: Any, pose: Any, theta: float) -> Any:
    """The place of an ellipse that is farthest in a direction."""
    own = np.array(half) * [np.cos(theta - pose[2]), np.sin(theta - pose[2])]
    return placed(pose, np.array(half) * own / np.hypot(*own))


def touch(i: Any, j: Any) -> tuple[float, float]:
    """The direction of the normal away from ellipse j, and the gap."""

    def both(theta: float) -> Any:
        n = np.array([np.cos(theta), np.sin(theta)])
        d = extreme(*i, theta + np.pi) - extreme(*j, theta)
        return n @ d, n[0] * d[1] - n[1] * d[0]

    best = max(np.linspace(0, TURN, 2000), key=lambda theta: both(theta)[0])
    theta = brentq(lambda theta: both(theta)[1], best - 0.01, best + 0.01, xtol=1e-15)
    return theta, both(theta)[0]


def distance(i: Any, j: Any) -> float:
    """The distance of two curves (function, range), by a minimum over both parameters."""

    def squared(places: Any) -> float:
        d = i[0](places[0]) - j[0](places[1])
        return float(np.sum(d**2))

    us, ws = np.linspace(*i[1], 200), np.linspace(*j[1], 200)
    p, q = (of[0](places).reshape(2, -1) for of, places in ((i, us), (j, ws)))
    far = np.hypot(p[0][:, None] - q[0], p[1][:, None] - q[1])
    k, n = np.unravel_index(far.argmin(), far.shape)
    found = minimize(
        squared,
        [us[k], ws[n]],
        bounds=[i[1], j[1]],
        method="L-BFGS-B",
        options={"ftol": 0, "gtol": 1e-14},
    )
    return float(np.sqrt(found.fun))


def roughly_apart(i: Any, j: Any) -> float:
    """As `separation`, over some directions only: at most that, and less by 1e-3 at most."""
    theta = np.linspace(0, TURN, 360, endpoint=False)
    n = np.array([np.cos(theta), np.sin(theta)]).T
    return float(((n @ i).min(axis=1) - (n @ j).max(axis=1)).max())
