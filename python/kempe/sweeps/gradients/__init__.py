"""Gradients: the derivatives of measures with respect to the variables of sweeps."""

from kempe.sweeps.gradients.result import Gradient
from kempe.sweeps.gradients.run import gradient

__all__ = ["Gradient", "gradient"]
