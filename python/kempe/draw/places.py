"""Which points of a motion are one place in a drawing."""

from __future__ import annotations

import numpy as np

from kempe.arrays import Floats


class Places:
    """Paths of points, those of one place once.

    Args:
        near: paths that are always so near are one place, m.
    """

    def __init__(self, near: float) -> None:
        self._near = near
        self._paths: Floats | None = None

    def index(self, path: Floats) -> int:
        """The number of the place of a path, (n_t, 2); a new one if there is none yet."""
        if self._paths is None:
            self._paths = path[None]
            return 0
        apart = np.abs(self._paths - path).max(axis=(1, 2))
        k = int(np.argmin(apart))
        if apart[k] < self._near:
            return k
        self._paths = np.concatenate([self._paths, path[None]])
        return len(self._paths) - 1

    def is_new(self, path: Floats) -> bool:
        """Whether a path has a place of its own; it is then taken."""
        before = 0 if self._paths is None else len(self._paths)
        return self.index(path) == before
