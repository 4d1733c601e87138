"""What a designer reads from a motion: curves, angles, ratios, motors, flywheels, pin loads.

All functions take a ``Solution`` of ``kinematics``, ``inverse_dynamics`` or ``dynamics``. They
return plain results with arrays in SI units and rad. Their figures are in ``kp.plot``.

Kinematics:
    coupler_curve           path of a point: length, area, cusps
    transmission_angle      angle between coupler and output link
    velocity_ratio, mechanical_advantage
    toggles                 instants at which the output reverses
    instant_centre          centre of the velocities of two bodies, and centrodes
    velocity_polygon, acceleration_polygon
"""

from kempe.design.centres import InstantCentre, instant_centre
from kempe.design.coupler_curve import CouplerCurve, coupler_curve
from kempe.design.locate import Limits
from kempe.design.polygons import Polygon, Side, acceleration_polygon, velocity_polygon
from kempe.design.transmission import (
    Toggle,
    TransmissionAngle,
    mechanical_advantage,
    toggles,
    transmission_angle,
    velocity_ratio,
)

__all__ = [
    "CouplerCurve",
    "InstantCentre",
    "Limits",
    "Polygon",
    "Side",
    "Toggle",
    "TransmissionAngle",
    "acceleration_polygon",
    "coupler_curve",
    "instant_centre",
    "mechanical_advantage",
    "toggles",
    "transmission_angle",
    "velocity_polygon",
    "velocity_ratio",
]
