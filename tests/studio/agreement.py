"""Comparison of runs in the page with those of the native core."""

import kempe as kp
import numpy as np

#: The module and the native core round sines and powers differently.
TOLERANCE = 1e-9


def coordinates(case: kp.Case) -> list[str]:
    bodies = {name: body for name, body in case.tree()["bodies"].items() if name != "ground"}
    return [
        f"{name}.{quantity}"
        for name, body in bodies.items()
        for quantity in ("x", "y", "angle")
        if not (quantity == "angle" and body.get("type") == "point_mass")
    ]


def sizes(names: list[str], rows: np.ndarray) -> np.ndarray:
    """The size of each quantity: the largest length of the motion, or a radian or the angle."""
    peaks = np.abs(rows).max(axis=1)
    angles = np.array([name.endswith(".angle") for name in names])
    return np.where(angles, np.maximum(peaks, 1.0), peaks[~angles].max() or 1.0)
