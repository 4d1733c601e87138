"""Reactions and constraint violation of one joint or driver.

F″ = -Cᵀ Aᵀ Φ_rᵀ λ (Haug 6.6.8), T″ by (6.6.9); C is fixed in the body given by ``on=``.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Generic, cast

import numpy as np

from kempe.base.arguments import explain_methods, missing_attribute
from kempe.base.arrays import Floats, fixed, scalar
from kempe.errors import ModelError
from kempe.model.compiled import ConstraintInfo
from kempe.results.views.body import S
from kempe.results.views.frames import (
    FRAMES,
    REACTION_FRAMES,
    ReactionFrame,
    checked_body,
    checked_frame,
)
from kempe.results.views.reaction import Reaction, read

if TYPE_CHECKING:
    from kempe.results.motion import Motion


@explain_methods
class ConstraintView(Generic[S]):
    """A joint or driver of a motion.

    Attributes:
        info: the joint with numerical values.
    """

    def __init__(self, motion: Motion, info: ConstraintInfo) -> None:
        self._motion = motion
        self.info = info

    @property
    def name(self) -> str:
        """Name of the joint or driver."""
        return self.info.name

    def force(
        self, *, on: str, frame: ReactionFrame = "global", about: str | None = None
    ) -> Floats:
        """Force that the joint exerts on a body, (n_t, 2), N; see ``reaction`` for the arguments.

        Raises:
            ModelError: ``on``, ``frame`` or ``about`` has another value.
        """
        if about is None and checked_frame(frame, REACTION_FRAMES) in FRAMES:
            return fixed(self._reaction(on, frame)[..., :2])
        return self.reaction(on=on, frame=frame, about=about).force

    def reaction(
        self, *, on: str, frame: ReactionFrame = "global", about: str | None = None
    ) -> Reaction:
        """Force and torque that the joint exerts on a body, with point, frame and sign.

        Args:
            on: a body on which the joint or driver acts.
            frame: axes of the components: "global"; "body" for the axes of this body; "joint" for
                the axes of the joint on this body; "i" or "j" for the axes of body i or j;
                "radial" for the axis from the point ``about`` to the joint, and the axis to its
                left. The components on two bodies are opposite only in the frames "global", "i"
                and "j".
            about: the point of the body at which the axis of the frame "radial" begins. The default
                is the other joint of a body with two joints, and the mass centre of any other body.

        Raises:
            ModelError: ``on``, ``frame`` or ``about`` has another value, or the joint lies at the
                point ``about``.
        """
        body, axes = checked_body(self.info, on), checked_frame(frame, REACTION_FRAMES)
        if about is not None and axes != "radial":
            hint = 'only the frame "radial" needs it'
            raise ModelError(f"about: {about!r} with frame {axes!r}", name=self.name, hint=hint)
        return read(self._motion, self.info, body, axes, about)

    @property
    def unique(self) -> bool:
        """Whether the reaction is unique.

        If not, redundant constraints share the loads, and the values follow from the multipliers of
        minimum norm. Accepted redundant constraints (``redundancy="allow"``) are examined at the
        outputs; in a long motion, at eleven of them.

        Joints that keep a coordinate only to second order would need infinite forces for a load
        along it. The values leave this load out, so that ``newton_euler`` has it as a residual.

        While drivers hold friction at rest, it may carry any part of the load up to its limit. The
        values are then those without friction; ``interval`` gives the range.

        Contacts and friction at rest may share a load in several ways. One of them is then given,
        and joints that take part are marked too.
        """
        return not self.choice

    @property
    def choice(self) -> str:
        """Which of the possible reactions is given; empty if it is unique."""
        return self._motion.choices.get(self.name, "")

    @property
    def interval(self) -> Floats:
        """The least and the largest effort of a driver, (n_t, 2), N or N·m.

        They differ while the driver holds friction at rest.

        Raises:
            ModelError: the joint has no effort.
        """
        if self.info.group != "drivers":
            hint = "drivers have an interval"
            raise ModelError(f"{self.name} has no effort", name=self.name, hint=hint)
        lam = np.atleast_2d(self._motion.lam)
        ends = [-of[:, self.info.rows][:, 0] for of in self._motion.multiplier_range or (lam, lam)]
        return fixed(np.sort(np.stack(ends, axis=-1), axis=-1))

    def torque(self, *, on: str) -> S:
        """Torque that the joint exerts on a body about the joint point, (n_t,), N·m.

        Raises:
            ModelError: the joint does not connect that body.
        """
        return cast(S, scalar(self._reaction(on, "global")[..., 2]))

    @property
    def residual(self) -> Floats:
        """Constraint violation Φ of the joint, (n_t, m), m or rad."""
        return fixed(self._motion.residuals[0][..., self.info.rows])

    @property
    def residual_rate(self) -> Floats:
        """Φ_q q̇ + Φ_t of the joint, (n_t, m), m/s or rad/s."""
        return fixed(self._motion.residuals[1][..., self.info.rows])

    @property
    def coordinates(self) -> Floats:
        """Internal coordinates of the joint, (n_t, n); none for most joints."""
        return fixed(self._motion.q[..., self.info.columns])

    @property
    def lam(self) -> Floats:
        """Multipliers of the joint, (n_t, m), N or N·m."""
        return fixed(self._motion.lam[..., self.info.rows])

    def __getattr__(self, name: str) -> S:
        """A result of the joint beside its reaction, such as ``normal``, (n_t,)."""
        info = self.__dict__.get("info")
        names = [known for known, _ in info.results] if info else []
        if name not in names:
            known = () if name.startswith("_") else dir(self)
            raise AttributeError(missing_attribute(type(self).__name__, name, known))
        return cast(S, scalar(self._motion.results(self.name)[..., names.index(name)]))

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *(name for name, _ in self.info.results)]

    def _reaction(self, on: str, frame: str) -> Floats:
        body, axes = checked_body(self.info, on), checked_frame(frame)
        return self._motion.reaction(self.name, body, axes)

    def __repr__(self) -> str:
        return f"<{self.info.type} {self.name!r}: {self.info.i} - {self.info.j}>"
