"""Checks of the body and the frame of a force."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal, TypeAlias

from kempe.base.names import UnknownNameError, one_of
from kempe.model.compiled import ConstraintInfo, ForceInfo

Frame: TypeAlias = Literal["global", "body", "joint"]
#: Global axes; axes of the body given by ``on=``; axes of the joint on this body (Haug 6.6.8).
FRAMES: tuple[Frame, ...] = ("global", "body", "joint")
ReactionFrame: TypeAlias = Literal["global", "body", "joint", "i", "j", "radial"]
#: Also the axes of body i and of body j, and the direction from the other joint of the body.
REACTION_FRAMES: tuple[ReactionFrame, ...] = (*FRAMES, "i", "j", "radial")


def checked_body(element: ConstraintInfo | ForceInfo, on: str) -> str:
    """The body ``on``, if the element acts on it.

    Raises:
        ModelError: the element does not act on this body.
    """
    return one_of(f"body in on= for {element.name}", on, dict.fromkeys(element.bodies))


def checked_frame(frame: str, allowed: Sequence[str] = FRAMES) -> str:
    """The frame, if the name is valid.

    Raises:
        ModelError: there is no such frame.
    """
    if isinstance(frame, str) and frame in ("local", "ground") and frame not in allowed:
        # "local" resembles "global", its opposite
        meant = "body" if frame == "local" else "global"
        raise UnknownNameError(
            f"unknown frame {frame!r}",
            name=frame,
            hint=f"write {meant!r}; there is {', '.join(allowed)}",
        )
    return one_of("frame", frame, allowed)
