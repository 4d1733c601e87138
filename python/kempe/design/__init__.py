"""Results of a motion for designers: curves, angles, ratios, motors, flywheels, pin loads.

All functions take a ``Solution`` of ``kinematics``, ``inverse_dynamics`` or ``dynamics``. They
return plain results with arrays in SI units and rad. Their figures are in ``kp.plot``.

Kinematics:
    coupler_curve           path of a point: length, area, cusps
    transmission_angle      angle between coupler and output link
    velocity_ratio, mechanical_advantage
    toggles                 instants at which the output reverses
    instant_centre          centre of the velocities of two bodies, and centrodes
    velocity_polygon, acceleration_polygon

Dynamics:
    duty                    efforts, powers and work of a driver or motor
    flywheel                inertia for a given fluctuation of the speed
    shaking                 shaking force and moment on ground

Making:
    balance                 counterweights for the shaking force
    cam                     profile of a cam for a programme of its follower
    read_programme          the programme in a CSV file
    gear_train              tooth numbers for a ratio

Pin loads:
    pin_load, pin_loads     force of a joint in the frame of a body, and its extremes
    pin_table, write_pin_loads
    free_body               all forces on a body at an instant
    load_cases, export_load_cases
"""

from kempe.base.arguments import explain_functions
from kempe.design.balance import Balance, Counterweight, balance
from kempe.design.cams import Cam, cam, read_programme
from kempe.design.centres import InstantCentre, instant_centre
from kempe.design.coupler_curve import CouplerCurve, coupler_curve
from kempe.design.duty import Duty, Flywheel, duty, flywheel
from kempe.design.free_body import FreeBody, free_body
from kempe.design.gear_train import GearTrain, gear_train
from kempe.design.locate import Limits
from kempe.design.pin_loads import (
    PinLoad,
    export_load_cases,
    load_cases,
    pin_load,
    pin_loads,
    pin_table,
    write_pin_loads,
)
from kempe.design.polygons import Polygon, Side, acceleration_polygon, velocity_polygon
from kempe.design.shaking import Shaking, shaking
from kempe.design.transmission import (
    Toggle,
    TransmissionAngle,
    mechanical_advantage,
    toggles,
    transmission_angle,
    velocity_ratio,
)
from kempe.design.wrenches import Inertia, Load

__all__ = [
    "Balance",
    "Cam",
    "Counterweight",
    "CouplerCurve",
    "Duty",
    "Flywheel",
    "FreeBody",
    "GearTrain",
    "Inertia",
    "InstantCentre",
    "Limits",
    "Load",
    "PinLoad",
    "Polygon",
    "Shaking",
    "Side",
    "Toggle",
    "TransmissionAngle",
    "acceleration_polygon",
    "balance",
    "cam",
    "coupler_curve",
    "duty",
    "export_load_cases",
    "flywheel",
    "free_body",
    "gear_train",
    "instant_centre",
    "load_cases",
    "mechanical_advantage",
    "pin_load",
    "pin_loads",
    "pin_table",
    "read_programme",
    "shaking",
    "toggles",
    "transmission_angle",
    "velocity_polygon",
    "velocity_ratio",
    "write_pin_loads",
]

explain_functions(globals())
