"""The forces of a scene as its readers find them: from its ends, frames and channels."""

from typing import Any

import numpy as np
from kempe.draw.geometry import placed

Scene = dict[str, Any]


def force_of(scene: Scene, element: str) -> np.ndarray:
    """The force of an element on its body j, (n_t, 2), N."""
    names = [joint["name"] for joint in scene["joints"]]
    if element in names:
        return np.array(scene["frames"]["reactions"], dtype=float)[:, names.index(element)]
    channels = {one["name"]: one["values"] for one in scene["channels"]}
    return np.column_stack([channels[f"{element}.force_{part}"] for part in "xy"])


def place_of(scene: Scene, end: dict[str, Any]) -> np.ndarray:
    """Where an end is, (n_t, 2), m."""
    poses = np.array([[[0, 0, 0], *frame] for frame in scene["frames"]["poses"]], dtype=float)
    return placed(poses[:, end["frame"]], end["point"])


def on_body(scene: Scene, body: str) -> dict[str, tuple[np.ndarray, np.ndarray]]:
    """Force and place of each element that acts on a body."""
    names = [one["name"] for one in scene["bodies"]]
    return {
        end["element"]: (end["sign"] * force_of(scene, end["element"]), place_of(scene, end))
        for end in scene["ends"]
        if names[end["body"]] == body
    }
