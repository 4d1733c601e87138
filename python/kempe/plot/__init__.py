"""Figures of solutions, drawn with matplotlib; one file for each figure.

Every function takes ``ax=`` and returns the axes. Without ``ax=`` it draws in a new figure. Time
axes are compressed after ``cut=``; ``transient(solution)`` returns a suitable time.
"""

from kempe.base.arguments import explain_functions
from kempe.plot.body_motion import accelerations, positions, velocities
from kempe.plot.cam import cam
from kempe.plot.centres import instant_centres
from kempe.plot.comparisons import comparison
from kempe.plot.configuration import configuration
from kempe.plot.coupler_curves import coupler_curve
from kempe.plot.efforts import effort, torque_speed
from kempe.plot.energy import energy, energy_balance
from kempe.plot.equilibrium import path, rest_position
from kempe.plot.fits import fit
from kempe.plot.free_body import draw_free_body, free_body
from kempe.plot.gradients import gradient
from kempe.plot.measures import measure
from kempe.plot.mechanism import mechanism
from kempe.plot.modes import mode_shape
from kempe.plot.optimization import optimization
from kempe.plot.page import Page, save, select
from kempe.plot.pages import pages
from kempe.plot.pin_loads import pin_load
from kempe.plot.polygons import acceleration_polygon, velocity_polygon
from kempe.plot.reactions import all_reactions, reactions
from kempe.plot.residual import residual
from kempe.plot.shaking import shaking_force
from kempe.plot.slopes import slopes
from kempe.plot.sweep_pages import sweep_pages
from kempe.plot.sweep_scatter import sweep_scatter
from kempe.plot.sweeps import sweep_contributions, sweep_histogram, sweep_lines, sweep_map
from kempe.plot.synthesis import burmester, synthesis
from kempe.plot.time_axis import transient
from kempe.plot.torques import torques
from kempe.plot.transmission import transmission_angle

__all__ = [
    "Page",
    "acceleration_polygon",
    "accelerations",
    "all_reactions",
    "burmester",
    "cam",
    "comparison",
    "configuration",
    "coupler_curve",
    "draw_free_body",
    "effort",
    "energy",
    "energy_balance",
    "fit",
    "free_body",
    "gradient",
    "instant_centres",
    "measure",
    "mechanism",
    "mode_shape",
    "optimization",
    "pages",
    "path",
    "pin_load",
    "positions",
    "reactions",
    "residual",
    "rest_position",
    "save",
    "select",
    "shaking_force",
    "slopes",
    "sweep_contributions",
    "sweep_histogram",
    "sweep_lines",
    "sweep_map",
    "sweep_pages",
    "sweep_scatter",
    "synthesis",
    "torque_speed",
    "torques",
    "transient",
    "transmission_angle",
    "velocities",
    "velocity_polygon",
]

explain_functions(globals())
