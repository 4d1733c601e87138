"""Fits: values of parameters that agree best with measured data, and how sure they are."""

from kempe.sweeps.fits.comparison import Comparison, compare
from kempe.sweeps.fits.data import Data
from kempe.sweeps.fits.result import Fit
from kempe.sweeps.fits.run import fit

__all__ = ["Comparison", "Data", "Fit", "compare", "fit"]
