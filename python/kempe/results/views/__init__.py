"""Views of a motion: one body, joint or force."""

from kempe.results.views.body import BodyView, PointView
from kempe.results.views.constraint import ConstraintView
from kempe.results.views.force import ForceView

__all__ = ["BodyView", "ConstraintView", "ForceView", "PointView"]
