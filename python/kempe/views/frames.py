"""On which body and in which frame a force is told."""

from __future__ import annotations

from kempe.compiled import ConstraintInfo, ForceInfo
from kempe.names import one_of

#: Global axes; axes of the body named by ``on=``; axes of the joint on that body (Haug 6.6.8).
FRAMES = ("global", "body", "joint")


def checked_body(element: ConstraintInfo | ForceInfo, on: str) -> str:
    """The body ``on`` if the element acts on it.

    Raises:
        ModelError: it does not.
    """
    return one_of(f"body in on= for {element.name}", on, dict.fromkeys([element.i, element.j]))


def checked_frame(frame: str, allowed: tuple[str, ...] = FRAMES) -> str:
    """The frame if there is one of that name.

    Raises:
        ModelError: there is not.
    """
    return one_of("frame", frame, allowed)
