"""Matrices and equations of a mechanism as one shows them: with the names of rows and columns."""

from kempe.labelled.formulas import Equations, equations
from kempe.labelled.matrix import NAMES, Labelled, show
from kempe.labelled.newton import Iterations, iterations

__all__ = ["NAMES", "Equations", "Iterations", "Labelled", "equations", "iterations", "show"]
