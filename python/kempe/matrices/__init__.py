"""The matrices of the equations of motion: as arrays, and printed with labels."""

from kempe.matrices.labelled import NAMES, Labelled, show
from kempe.matrices.values import Matrices, matrices

__all__ = ["NAMES", "Labelled", "Matrices", "matrices", "show"]
