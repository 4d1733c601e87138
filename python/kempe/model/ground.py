"""The fixed body of a model."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

from kempe.base.arguments import explain_methods
from kempe.model.values import Outline, Pair, refuse

if TYPE_CHECKING:
    from kempe.model.model import Model


@explain_methods
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

    def outline(self, outline: Outline) -> None:
        """Draw ground as points, circle or path, m: ``m.ground.outline({"circle": (0, 0, 1)})``.

        The outline does not affect any result.

        Raises:
            ModelError: the outline has a value of the wrong kind.
        """
        self._model._ground_outline(outline)

    def __repr__(self) -> str:
        points = self._model.shown().get("bodies", {}).get("ground", {}).get("points", {})
        return f"<ground of {self._model.title!r}: points {', '.join(points) or 'none'}>"


def with_ground(
    bodies: dict[str, Any],
    what: str,
    given: Mapping[str, Any],
    check: Callable[[object, str], dict[str, Any]],
) -> dict[str, Any]:
    """Bodies as in a file, with more named points or curves on ground.

    Args:
        bodies: the bodies so far.
        what: "point" or "curve".
        given: the new points or curves by name.
        check: function that checks them; it receives their path.

    Raises:
        ModelError: a name is taken, or a value is of the wrong kind.
    """
    ground = bodies.get("ground", {})
    key, known = f"{what}s", ground.get(f"{what}s", {})
    for name in given:
        if name in known:
            path = f"bodies.ground.{key}.{name}"
            refuse(path, f"the name is taken by another {what}; choose another")
    checked = check(given, f"bodies.ground.{key}")
    return {"ground": {**ground, key: {**known, **checked}}} | {
        name: body for name, body in bodies.items() if name != "ground"
    }
