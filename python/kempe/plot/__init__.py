"""Figures of solutions, drawn with matplotlib; one file for each.

Every function takes ``ax=``, draws in a figure of its own without it, and returns the axes. Time
axes are compressed after ``cut=``, which ``transient(solution)`` finds.
"""

from kempe.plot.body_motion import accelerations, positions, velocities
from kempe.plot.configuration import configuration
from kempe.plot.energy import energy, energy_balance
from kempe.plot.measures import measure
from kempe.plot.mechanism import mechanism
from kempe.plot.mode_shapes import mode_shape
from kempe.plot.page import Page, save, select
from kempe.plot.pages import pages
from kempe.plot.reactions import all_reactions, reactions
from kempe.plot.residual import residual
from kempe.plot.rest import path, rest_position
from kempe.plot.time_axis import transient
from kempe.plot.torques import torques

__all__ = [
    "Page",
    "accelerations",
    "all_reactions",
    "configuration",
    "energy",
    "energy_balance",
    "measure",
    "mechanism",
    "mode_shape",
    "pages",
    "path",
    "positions",
    "reactions",
    "residual",
    "rest_position",
    "save",
    "select",
    "torques",
    "transient",
    "velocities",
]
