"""The fixed body of a model."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from kempe.values import Pair

if TYPE_CHECKING:
    from kempe.model import Model


class Ground:
    """The fixed body; its frame is the global frame."""

    def __init__(self, model: Model) -> None:
        self._model = model

    def points(self, **points: Pair) -> None:
        """Add named points to ground, m: ``m.ground.points(A=(0, 0), D=("G", 0))``.

        Raises:
            ModelError: the name is taken, or the point does not consist of two numbers or formulas.
        """
        self._model._ground_points(points)

    def curves(self, **curves: Mapping[str, Any]) -> None:
        """Add named curves to ground: ``m.ground.curves(floor={"line": [(0, 0), (1, 0)]})``.

        Raises:
            ModelError: the name is taken, or the curve has a value of the wrong kind.
        """
        self._model._ground_curves(curves)

    def __repr__(self) -> str:
        points = self._model.tree().get("bodies", {}).get("ground", {}).get("points", {})
        return f"<ground of {self._model.title!r}: points {', '.join(points) or 'none'}>"
