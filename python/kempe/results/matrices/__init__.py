"""The matrices of the equations of motion: as arrays, and printed with labels."""

from kempe.results.matrices.labelled import NAMES, Labelled, show
from kempe.results.matrices.values import Matrices, matrices

__all__ = ["NAMES", "Labelled", "Matrices", "matrices", "show"]
