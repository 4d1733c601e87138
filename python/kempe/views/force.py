"""Force and torque of one force element on its bodies, in total and by part."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from kempe.arrays import Floats, fixed
from kempe.compiled import ForceInfo
from kempe.names import unknown
from kempe.views.frames import checked_body, checked_frame

if TYPE_CHECKING:
    from kempe.motion import Motion

#: A force element has no frame of its own.
_FRAMES = ("global", "body")


class ForceView:
    """A force element of a motion.

    Each part has its own ``<part>_torque(on=…)`` and ``<part>_force(on=…)``, such as
    ``stiffness_torque`` and ``damping_torque`` of a torsion spring.

    Attributes:
        info: the element.
    """

    def __init__(self, motion: Motion, info: ForceInfo) -> None:
        self._motion = motion
        self.info = info

    @property
    def name(self) -> str:
        """Name of the force element."""
        return self.info.name

    @property
    def parts(self) -> tuple[str, ...]:
        """Names of the parts."""
        return self.info.parts

    def force(self, *, on: str, frame: str = "global", part: str | None = None) -> Floats:
        """Force on a body, (n_t, 2), N.

        Args:
            on: the body; one of the two that the element connects.
            frame: "global" or "body" (axes of this body).
            part: name of one part; the sum of all parts by default.

        Raises:
            ModelError: ``on``, ``frame`` or ``part`` has another value.
        """
        return fixed(self._action(on, frame, part)[..., :2])

    def torque(self, *, on: str, part: str | None = None) -> Floats:
        """Torque on a body about the origin of its frame, (n_t,), N·m.

        Args:
            on: the body; one of the two that the element connects.
            part: name of one part; the sum of all parts by default.

        Raises:
            ModelError: ``on`` or ``part`` has another value.
        """
        return fixed(self._action(on, "global", part)[..., 2])

    def _action(self, on: str, frame: str, part: str | None) -> Floats:
        if part is not None and part not in self.parts:
            raise unknown(f"part of {self.name}", part, self.parts)
        body, axes = checked_body(self.info, on), checked_frame(frame, _FRAMES)
        return self._motion.action(self.name, body, part, axes)

    def __getattr__(self, name: str) -> Callable[..., Floats]:
        part, _, what = name.rpartition("_")
        if what not in ("force", "torque") or part not in self.info.parts:
            raise AttributeError(f"{self!r} has no {name!r}; its parts: {', '.join(self.parts)}")
        whole = self.force if what == "force" else self.torque

        def of_part(*, on: str, **frame: str) -> Floats:
            return whole(on=on, part=part, **frame)

        return of_part

    def __dir__(self) -> list[str]:
        made = [f"{part}_{what}" for part in self.parts for what in ("force", "torque")]
        return [*super().__dir__(), *made]

    def __repr__(self) -> str:
        return f"<{self.info.type} {self.name!r}: {self.info.i} - {self.info.j}>"
