"""The display list of a scene. The core makes it; figures, frames and the page paint it."""

from __future__ import annotations

from typing import Any

import numpy as np

from kempe.base.arrays import Floats
from kempe.draw.items import Frame, Item
from kempe.draw.palette import one_line
from kempe.draw.placing import View
from kempe.draw.scene import Scene
from kempe.model.drawing import display_list


class Display:
    """A display list that is being assembled.

    Args:
        scene: the scene.
        view: the scale and the edges for which names are laid out.
        taken: boxes that names must not cover, (n, 4), points of print.
    """

    def __init__(self, scene: Scene, view: View, taken: Floats | None = None) -> None:
        self.scene, self.view = scene, view
        self._asked: dict[str, Any] = {"items": [], "names": []}
        if taken is not None:
            self._asked["taken"] = taken.tolist()

    @property
    def first(self) -> Floats:
        """Poses of all bodies at the first instant, ground first, (n_bodies, 3)."""
        poses = [[0.0] * 3, *self.scene["frames"]["poses"][0]]
        return np.nan_to_num(np.array(poses, dtype=np.float64))

    def draw_mechanism(self) -> None:
        """Bodies, the symbols of all elements, supports, and points without a symbol."""
        self._asked["mechanism"] = True

    def add(self, found: list[Item]) -> None:
        """Add items over the mechanism."""
        self._asked["items"] += found

    def add_dimensions(self) -> None:
        """A dimension line beside each bar, and between two pins on ground."""
        self._asked["dimensions"] = True

    def add_gravity(self) -> None:
        """An arrow in the corner with the most room."""
        self._asked["gravity"] = True

    def number_bodies(self, index_base: int = 1, *, names: bool = False) -> None:
        """Write a number in a circle on each body, and its name beside it.

        Args:
            index_base: number of the first body.
            names: whether to write names.
        """
        self._asked["numbers"] = {"first": index_base, "names": names}

    def name_joints(self) -> None:
        """Write the names of joints and contacts, one text for each place, and of free points."""
        self._asked["joints"] = True

    def name_elements(self) -> None:
        """Write the names of forces and drivers beside their symbols."""
        self._asked["elements"] = True

    def name(self, role: str, words: str, frame: Frame) -> None:
        """Write a name near the origin of a frame or half-way along it, where there is room."""
        name = {"of": words, "words": one_line(words), "role": role, "frame": frame}
        self._asked["names"].append(name)

    def finish(self) -> list[Item]:
        """The display list in the order of painting, with the names in their places."""
        frames = np.array(self.scene["frames"]["poses"], dtype=np.float64)
        poses = frames.reshape(len(frames), -1, 3)
        return display_list(self.scene, poses, self.view.plain(), self._asked)


def display(
    scene: Scene, view: View, *, labels: bool = True, taken: Floats | None = None
) -> list[Item]:
    """The display list of frames and of the page.

    Args:
        scene: the scene.
        view: the visible area.
        labels: whether to write numbers and names.
        taken: boxes that names must not cover, (n, 4), points of print.
    """
    made = Display(scene, view, taken)
    made.draw_mechanism()
    if labels:
        made.number_bodies()
        made.name_joints()
        made.name_elements()
    return made.finish()
