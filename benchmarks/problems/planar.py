"""A planar mechanism as plain numbers, from which every tool builds its model.

Frames lie at the mass centres; q = (x, y, angle) of each body; body -1 is ground.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import numpy as np

GROUND = -1
Pair = tuple[float, float]


@dataclass(frozen=True)
class Body:
    """Mass (kg), inertia about the centre (kg m²), start q (m, rad) and v."""

    name: str
    mass: float
    inertia: float
    q: tuple[float, float, float]
    v: tuple[float, float, float] = (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class Revolute:
    """Points `s_i` of body i and `s_j` of body j coincide; Phi = point_j - point_i."""

    i: int
    s_i: Pair
    j: int
    s_j: Pair


@dataclass(frozen=True)
class TorsionSpring:
    """Torque -stiffness (angle - free_angle) - damping omega on body j, from ground."""

    j: int
    stiffness: float
    damping: float
    free_angle: float


@dataclass(frozen=True)
class Spring:
    """Between point `s_i` of body i and `s_j` of body j: stiffness (N/m), free length (m)."""

    i: int
    s_i: Pair
    j: int
    s_j: Pair
    stiffness: float
    free_length: float


@dataclass(frozen=True)
class Torque:
    """A constant torque on body j, N m."""

    j: int
    torque: float


@dataclass(frozen=True)
class Motion:
    """The result of a tool: t (n_t) and q (n_t, n_bodies, 3)."""

    t: np.ndarray
    q: np.ndarray


@dataclass(frozen=True)
class Problem:
    """A mechanism, its end time and the reference solution.

    `error` computes the error of a motion; `error_of` describes it.
    """

    name: str
    title: str
    bodies: tuple[Body, ...]
    joints: tuple[Revolute, ...]
    t_end: float
    output_step: float
    error_of: str
    error: Callable[[Motion], float]
    gravity: float = 0.0
    torsion_springs: tuple[TorsionSpring, ...] = ()
    springs: tuple[Spring, ...] = ()
    torques: tuple[Torque, ...] = ()
    #: Further measures of a motion, by name.
    also: Mapping[str, Callable[[Motion], float]] = field(default_factory=dict)
    #: Baumgarte's alpha and beta (1/s), for the tools that need them.
    gains: Pair = (10.0, 200.0)
    #: Fixed steps, s; each divides the output step.
    steps: tuple[float, ...] = (1e-2, 1e-3, 2e-4)

    @property
    def grid(self) -> np.ndarray:
        """Output times, s."""
        return np.arange(round(self.t_end / self.output_step) + 1) * self.output_step

    @property
    def q0(self) -> np.ndarray:
        """Start positions, (3 n_bodies)."""
        return np.array([x for body in self.bodies for x in body.q])

    @property
    def v0(self) -> np.ndarray:
        """Start velocities, (3 n_bodies)."""
        return np.array([x for body in self.bodies for x in body.v])

    def gap(self, motion: Motion) -> float:
        """The largest distance that any joint has opened at any output, m."""
        return max(float(self._opening(joint, motion).max()) for joint in self.joints)

    def _opening(self, joint: Revolute, motion: Motion) -> np.ndarray:
        ends = [
            point(motion.q, body, s) for body, s in ((joint.i, joint.s_i), (joint.j, joint.s_j))
        ]
        return np.asarray(np.hypot(*(ends[1] - ends[0])))


def point(q: np.ndarray, body: int, s: Pair) -> np.ndarray:
    """Global position of a point of a body during a motion, (2, n_t)."""
    if body == GROUND:
        return np.array(s)[:, None] * np.ones(len(q))
    x, y, angle = q[:, body].T
    c, s_ = np.cos(angle), np.sin(angle)
    return np.array([x + c * s[0] - s_ * s[1], y + s_ * s[0] + c * s[1]])
