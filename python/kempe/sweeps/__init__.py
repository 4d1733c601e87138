"""Sweeps: many variants of a case, with statistics of measures of each.

``kp.sweep`` runs them on the threads of one machine, or on the machines of a Dask cluster.
``kp.gradient`` differentiates the same numbers with respect to the same variables.
"""

from kempe.sweeps.gradients import Gradient, gradient
from kempe.sweeps.result import SweepResult
from kempe.sweeps.run import sweep
from kempe.sweeps.scatter import Allocation, Tolerances, allocate, tolerances

__all__ = [
    "Allocation",
    "Gradient",
    "SweepResult",
    "Tolerances",
    "allocate",
    "gradient",
    "sweep",
    "tolerances",
]
