"""Figures of solutions, drawn with matplotlib; one file for each."""

from kempe.plot.linkage import linkage

__all__ = ["linkage"]
