"""Force and torque of one force element on its bodies, in total and by part."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Generic, Literal, cast

import numpy as np

from kempe.base.arguments import explain_methods
from kempe.base.arrays import Floats, fixed, scalar
from kempe.base.names import one_of
from kempe.model.compiled import ForceInfo
from kempe.results.views.body import S
from kempe.results.views.frames import checked_body, checked_frame

if TYPE_CHECKING:
    from kempe.results.motion import Motion

#: A force element has no frame of its own.
_FRAMES = ("global", "body")


@explain_methods
class ForceView(Generic[S]):
    """A force element of a motion.

    Each part has its own ``<part>_torque(on=…)`` and ``<part>_force(on=…)``, such as
    ``stiffness_torque`` and ``damping_torque`` of a torsion spring. Each first-order state is an
    attribute, such as ``current`` of a motor, (n_t,), and so is each result, such as ``load`` of
    friction or ``gap`` of a stop.

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

    @property
    def unique(self) -> bool:
        """Whether the force is unique.

        Contacts and friction at rest may share a load in several ways. One of them is then given.
        The first and last state of a phase of the motion are examined.
        """
        return not self.choice

    @property
    def choice(self) -> str:
        """Which of the possible forces is given; empty if it is unique."""
        return self._motion.choices.get(self.name, "")

    def force(
        self,
        *,
        on: str,
        frame: Literal["global", "body"] = "global",
        part: str | None = None,
    ) -> Floats:
        """Force on a body, (n_t, 2), N.

        Args:
            on: a body on which the element acts.
            frame: "global" or "body" (axes of this body).
            part: name of one part; the sum of all parts by default.

        Raises:
            ModelError: ``on``, ``frame`` or ``part`` has another value.
        """
        return fixed(self._action(on, frame, part)[..., :2])

    def torque(self, *, on: str, part: str | None = None) -> S:
        """Torque on a body, (n_t,), N·m, counter-clockwise.

        The torque is about the point at which the force acts, ``place(on=…)``. It is zero for a
        spring-damper, an actuator and a contact, whose forces act at their points.

        Args:
            on: the body; one of those that the element connects.
            part: name of one part; the sum of all parts by default.

        Raises:
            ModelError: ``on`` or ``part`` has another value.
        """
        return cast(S, scalar(self._action(on, "global", part)[..., 2]))

    def place(self, *, on: str) -> Floats:
        """The point of a body at which the force acts, (n_t, 2), global, m.

        It is point i or j of a spring-damper or actuator, point j of a bushing or force, the
        point of contact of a contact, and point j of the joint for friction. Torques, motors,
        stops and generalized forces have no point; it is then the origin of the frame of the body.

        Args:
            on: a body on which the element acts.

        Raises:
            ModelError: ``on`` is another body.
        """
        return self._motion.action_place(self.name, checked_body(self.info, on))

    @property
    def power(self) -> S:
        """Power of its forces and torques on its bodies, (n_t,), W; negative for a damper."""
        total = np.zeros(np.shape(self._motion.t))
        for on in dict.fromkeys(self.info.bodies):
            fx, fy, torque = np.moveaxis(self._action(on, "global", None), -1, 0)
            body = self._motion.body(on)
            x, y = np.moveaxis(self.place(on=on) - body.r, -1, 0)
            about_origin = torque + x * fy - y * fx
            total = total + fx * body.vx + fy * body.vy + about_origin * body.omega
        return cast(S, scalar(total))

    @property
    def energy(self) -> S:
        """Stored energy, (n_t,), J; zero for a spring whose law depends on time or state."""
        return cast(S, scalar(self._motion.force_energy(self.name)[..., 0]))

    @property
    def dissipated(self) -> Floats:
        """Energy dissipated since the start, (n_t,), J; available only for a solution.

        Raises:
            ModelError: the motion is not a solution with an interpolant.
        """
        return self._motion.dissipated(self.name)

    def _action(self, on: str, frame: str, part: str | None) -> Floats:
        if part is not None:
            one_of(f"part of {self.name}", part, self.parts)
        body, axes = checked_body(self.info, on), checked_frame(frame, _FRAMES)
        return self._motion.action(self.name, body, part, axes)

    @property
    def states(self) -> tuple[str, ...]:
        """Names of the first-order states."""
        return tuple(name for name, _ in self.info.states)

    def state(self, name: str) -> S:
        """A first-order state by name, (n_t,), in its SI unit.

        Raises:
            ModelError: the element has no such state.
        """
        one_of(f"state of {self.name}", name, self.states)
        values = self._motion.z[..., self.info.places][..., self.states.index(name)]
        return cast(S, scalar(values))

    def __getattr__(self, name: str) -> Any:  # an array for a state, a function for a part
        if name.startswith("_") or name == "info":
            raise AttributeError(name)  # while a copy is made
        if name in self.states:
            return self.state(name)
        if name in (results := [known for known, _ in self.info.results]):
            values = self._motion.force_results(self.name)[..., results.index(name)]
            return cast(S, scalar(values))
        part, _, what = name.rpartition("_")
        if what not in ("force", "torque") or part not in self.info.parts:
            states = f"; its states: {', '.join(self.states)}" if self.states else ""
            parts = ", ".join(self.parts)
            raise AttributeError(f"{self!r} has no {name!r}; its parts: {parts}{states}")
        whole = self.force if what == "force" else self.torque

        def of_part(*, on: str, **frame: Any) -> Any:
            return whole(on=on, part=part, **frame)

        return of_part

    def __dir__(self) -> list[str]:
        made = [f"{part}_{what}" for part in self.parts for what in ("force", "torque")]
        results = (name for name, _ in self.info.results)
        return [*super().__dir__(), *made, *self.states, *results]

    def __repr__(self) -> str:
        return f"<{self.info.type} {self.name!r}: {self.info.i} - {self.info.j}>"
