"""Views of a motion: one body, joint or force."""

from kempe.views.body import BodyView, PointView
from kempe.views.constraint import ConstraintView
from kempe.views.force import ForceView

__all__ = ["BodyView", "ConstraintView", "ForceView", "PointView"]
