"""Sweeps: many variants of a case, with statistics of measures of each.

``kp.sweep`` runs them on the threads of one machine, or on the machines of a Dask cluster.
"""

from kempe.sweeps.result import SweepResult
from kempe.sweeps.run import sweep
from kempe.sweeps.scatter import Tolerances, tolerances

__all__ = ["SweepResult", "Tolerances", "sweep", "tolerances"]
