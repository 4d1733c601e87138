"""Problems of design: the values of variables that are best within limits."""

from kempe.sweeps.problems.optimum import Candidate, Optimum
from kempe.sweeps.problems.path import Path
from kempe.sweeps.problems.run import optimize

__all__ = ["Candidate", "Optimum", "Path", "optimize"]
