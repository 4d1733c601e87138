"""The motion of one body and of its points.

r_P = r + A s′, ṙ_P = ṙ + φ̇ B s′, r̈_P = r̈ + φ̈ B s′ - φ̇² A s′ (Haug 2.6.4 to 2.6.8), with B s′ the
vector A s′ turned by 90°.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Generic, TypeVar, cast

import numpy as np

from kempe.base.arguments import explain_methods
from kempe.base.arrays import Floats, pairs, rotated, scalar
from kempe.base.names import entry
from kempe.model.compiled import BodyInfo, Vector
from kempe.model.values import vector

if TYPE_CHECKING:
    from kempe.results.motion import Motion


#: One number for each time: an array (n_t,), in a state a float.
S = TypeVar("S")


@explain_methods
class BodyView(Generic[S]):
    """A body of a motion; all arrays are (n_t,) or (n_t, 2), in SI units and rad.

    In a state, a number is a float and a vector has the shape (2,).

    Attributes:
        info: the body with numerical values.
    """

    def __init__(self, motion: Motion, info: BodyInfo) -> None:
        self._motion = motion
        self.info = info

    @property
    def name(self) -> str:
        """Name of the body."""
        return self.info.name

    @property
    def x(self) -> S:
        """Position of the frame's origin, m."""
        return self._column(self._motion.q, 0)

    @property
    def y(self) -> S:
        """Position of the frame's origin, m."""
        return self._column(self._motion.q, 1)

    @property
    def angle(self) -> S:
        """Angle of the frame, rad, continuous; zero for a point mass, which does not turn."""
        return self._column(self._motion.q, 2)

    @property
    def vx(self) -> S:
        """Velocity of the origin, m/s."""
        return self._column(self._motion.v, 0)

    @property
    def vy(self) -> S:
        """Velocity of the origin, m/s."""
        return self._column(self._motion.v, 1)

    @property
    def omega(self) -> S:
        """Angular velocity, rad/s; zero for a point mass."""
        return self._column(self._motion.v, 2)

    @property
    def ax(self) -> S:
        """Acceleration of the origin, m/s²."""
        return self._acceleration(0)

    @property
    def ay(self) -> S:
        """Acceleration of the origin, m/s²."""
        return self._acceleration(1)

    @property
    def alpha(self) -> S:
        """Angular acceleration, rad/s²; zero for a point mass."""
        return self._acceleration(2)

    @property
    def r(self) -> Floats:
        """Position of the origin, (n_t, 2), m."""
        return pairs(self.x, self.y)

    @property
    def velocity(self) -> Floats:
        """Velocity of the origin, (n_t, 2), m/s."""
        return pairs(self.vx, self.vy)

    @property
    def acceleration(self) -> Floats:
        """Acceleration of the origin, (n_t, 2), m/s²."""
        return pairs(self.ax, self.ay)

    def point(self, name: str) -> PointView:
        """A named point of the body.

        Raises:
            ModelError: the body has no such point.
        """
        return self.at(entry(f"point of {self.name}", name, self.info.points), name)

    def at(self, s: Vector, name: str = "") -> PointView:
        """A point of the body, given by its coordinates in the frame of the body, m.

        Raises:
            ModelError: the coordinates are not two numbers.
        """
        return PointView(cast("BodyView[Floats]", self), vector(s, f"point of {self.name}"), name)

    def _acceleration(self, k: int) -> S:
        return self._column(self._motion.a if k < self.info.count else self._motion.v, k)

    def _column(self, values: Floats, k: int) -> S:
        if k >= self.info.count:  # ground does not move, and a point mass does not turn
            return cast(S, scalar(np.zeros(np.shape(self._motion.t))))
        return cast(S, scalar(values[..., self.info.columns][..., k]))

    def __repr__(self) -> str:
        return f"<body {self.name!r}>"


@explain_methods
class PointView:
    """A point fixed in a body.

    Attributes:
        s: coordinates in the frame of the body, m.
        name: name of the point; empty for a point without a name.
    """

    def __init__(self, body: BodyView[Floats], s: Vector, name: str) -> None:
        self._body = body
        self.s = s
        self.name = name

    @property
    def position(self) -> Floats:
        """Global position, (n_t, 2), m."""
        x, y = rotated(self._body.angle, self.s)
        return pairs(self._body.x + x, self._body.y + y)

    @property
    def velocity(self) -> Floats:
        """Global velocity, (n_t, 2), m/s."""
        x, y = rotated(self._body.angle, self.s)
        omega = self._body.omega
        return pairs(self._body.vx - omega * y, self._body.vy + omega * x)

    @property
    def acceleration(self) -> Floats:
        """Global acceleration, (n_t, 2), m/s²."""
        x, y = rotated(self._body.angle, self.s)
        alpha, square = self._body.alpha, self._body.omega**2
        return pairs(self._body.ax - alpha * y - square * x, self._body.ay + alpha * x - square * y)

    def __repr__(self) -> str:
        return f"<point {self._body.name}.{self.name or self.s}>"
