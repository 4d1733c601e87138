"""Planar multibody mechanics: assembly, kinematics, dynamics and joint reactions.

A first example, a pendulum that is released from rest::

    import kempe as kp

    m = kp.Model("pendulum", gravity=(0, -9.81), parameters={"L": 1})
    m.ground.points(A=(0, 0))
    m.bar("rod", mass=2, length="L", ends=("A", "B"))
    m.revolute("A", "ground.A", "rod.A")

    start = kp.assemble(m, set={"rod.angle": "-30*deg"})
    sol = kp.dynamics(m, start, t_end=2, output_step=0.01)

    sol["rod.angle"]  # rad, at the times sol.t
    sol.joint("A").force(on="rod")  # N, (n_t, 2)
    sol(0.5)["rod.B.x"]  # m, at any time
    kp.animate(sol, "pendulum.html")

Numbers are in SI units and angles in rad. A string is a formula, such as "2*L" or "30 deg".

Build:
    Model                   bodies, joints, drivers and forces
    Sampled                 a controller that is evaluated at a fixed sampling period
    load, Case              files with a model, a start and analyses

Compute:
    assemble                a state in which all joints are closed
    dynamics                the motion from a state
    kinematics              the motion that drivers determine
    inverse_dynamics        the driven motion with driver efforts and joint reactions
    equilibrium             equilibrium positions, their stability, paths over a parameter
    stiffness_at            the stiffness of the mechanism at a point
    modes                   frequencies, damping, mode shapes and state space about a state
    limits                  the range of a driver, or whether it makes a full turn
    reachable               the region that a point reaches over two quantities
    mobility                freedoms, redundant joints, singular positions, four-bar loops
    configurations          all positions in which the mechanism closes
    study                   comparison of methods and stabilizations
    RK45, DOP853, RK4, Radau, GeneralizedAlpha, HHT, Auto
                            methods of integration
    Projection, Baumgarte   stabilizations of the constraints

Results:
    Solution, State, Motion quantities by name, bodies, joints, forces, energies
    show, equations         matrices and equations with the names of the model
    report.summary          peaks, settling times, energy balance
    load_solution           read a saved solution

    design                  coupler curves, transmission angles, motors, flywheels, pin loads

Show:
    plot                    figures
    animate, player         videos and pages with the motion
    write_report            a report with data, equations, figures, as HTML or PDF
    units                   units of tables, figures and CSV files

All errors are KempeErrors. ``help`` describes each name, for example ``help(kp.Model)``.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from kempe import _processor
from kempe._version import __version__

_processor.load_core()

if TYPE_CHECKING:
    from kempe import design as design
    from kempe import draw as draw
    from kempe import errors as errors
    from kempe import plot as plot
    from kempe import report as report
    from kempe.analyses import AccuracyWarning as AccuracyWarning
    from kempe.analyses import assemble as assemble
    from kempe.analyses import dynamics as dynamics
    from kempe.archive import load_solution as load_solution
    from kempe.assembly_report import AssemblyReport as AssemblyReport
    from kempe.case import Case as Case
    from kempe.case import Results as Results
    from kempe.case import load as load
    from kempe.closures import ConfigurationsResult as ConfigurationsResult
    from kempe.closures import configurations as configurations
    from kempe.display_units import Units as Units
    from kempe.display_units import units as units
    from kempe.draw.animate import animate as animate
    from kempe.draw.player import player as player
    from kempe.draw.scene import scene as scene
    from kempe.draw.still import still as still
    from kempe.driven import inverse_dynamics as inverse_dynamics
    from kempe.driven import kinematics as kinematics
    from kempe.energy import Energy as Energy
    from kempe.errors import AssemblyError as AssemblyError
    from kempe.errors import FileError as FileError
    from kempe.errors import IntegrationError as IntegrationError
    from kempe.errors import InternalError as InternalError
    from kempe.errors import KempeError as KempeError
    from kempe.errors import ModelError as ModelError
    from kempe.errors import RedundancyError as RedundancyError
    from kempe.errors import SingularityError as SingularityError
    from kempe.event import Event as Event
    from kempe.events import EventWarning as EventWarning
    from kempe.freedom import MobilityResult as MobilityResult
    from kempe.freedom import mobility as mobility
    from kempe.functions import FunctionWarning as FunctionWarning
    from kempe.functions import Sampled as Sampled
    from kempe.lab_report import write_report as write_report
    from kempe.linearization import ModesResult as ModesResult
    from kempe.linearization import modes as modes
    from kempe.matrices import Labelled as Labelled
    from kempe.matrices import Matrices as Matrices
    from kempe.matrices import show as show
    from kempe.model import Model as Model
    from kempe.motion import Motion as Motion
    from kempe.options import DOP853 as DOP853
    from kempe.options import HHT as HHT
    from kempe.options import RK4 as RK4
    from kempe.options import RK45 as RK45
    from kempe.options import Auto as Auto
    from kempe.options import Baumgarte as Baumgarte
    from kempe.options import Configurations as Configurations
    from kempe.options import Dynamics as Dynamics
    from kempe.options import Equilibrium as Equilibrium
    from kempe.options import GeneralizedAlpha as GeneralizedAlpha
    from kempe.options import InverseDynamics as InverseDynamics
    from kempe.options import Kinematics as Kinematics
    from kempe.options import Limits as Limits
    from kempe.options import Mobility as Mobility
    from kempe.options import Modes as Modes
    from kempe.options import NoStabilization as NoStabilization
    from kempe.options import Projection as Projection
    from kempe.options import Radau as Radau
    from kempe.options import Reachable as Reachable
    from kempe.reach import LimitsResult as LimitsResult
    from kempe.reach import limits as limits
    from kempe.record import AssemblyWarning as AssemblyWarning
    from kempe.region import ReachableResult as ReachableResult
    from kempe.region import reachable as reachable
    from kempe.solution import Solution as Solution
    from kempe.start import Start as Start
    from kempe.state import State as State
    from kempe.statics import EquilibriumResult as EquilibriumResult
    from kempe.statics import PointStiffness as PointStiffness
    from kempe.statics import equilibrium as equilibrium
    from kempe.statics import stiffness_at as stiffness_at
    from kempe.studies import Study as Study
    from kempe.studies import study as study
    from kempe.sweeps import SweepResult as SweepResult
    from kempe.sweeps import Tolerances as Tolerances
    from kempe.sweeps import sweep as sweep
    from kempe.sweeps import tolerances as tolerances
    from kempe.symbolic import equations as equations

# ``import kempe`` is fast, because each public name is imported on first use. A new public name
# needs one line in ``_HOME`` and one in the block for type checkers.
#: Public name → module of kempe that defines it; "" if the name itself is a module.
_HOME = {
    "AssemblyError": "errors",
    "AssemblyReport": "assembly_report",
    "AccuracyWarning": "analyses",
    "AssemblyWarning": "record",
    "Auto": "options",
    "Baumgarte": "options",
    "Case": "case",
    "Configurations": "options",
    "ConfigurationsResult": "closures",
    "DOP853": "options",
    "Dynamics": "options",
    "Energy": "energy",
    "Equilibrium": "options",
    "EquilibriumResult": "statics",
    "Event": "event",
    "EventWarning": "events",
    "FileError": "errors",
    "FunctionWarning": "functions",
    "GeneralizedAlpha": "options",
    "HHT": "options",
    "IntegrationError": "errors",
    "InternalError": "errors",
    "InverseDynamics": "options",
    "KempeError": "errors",
    "Kinematics": "options",
    "Labelled": "matrices",
    "Limits": "options",
    "LimitsResult": "reach",
    "Reachable": "options",
    "ReachableResult": "region",
    "Matrices": "matrices",
    "Mobility": "options",
    "MobilityResult": "freedom",
    "Model": "model",
    "ModelError": "errors",
    "Modes": "options",
    "ModesResult": "linearization",
    "Motion": "motion",
    "NoStabilization": "options",
    "PointStiffness": "statics",
    "Projection": "options",
    "RK4": "options",
    "RK45": "options",
    "Radau": "options",
    "RedundancyError": "errors",
    "Results": "case",
    "Sampled": "functions",
    "SingularityError": "errors",
    "Solution": "solution",
    "Start": "start",
    "State": "state",
    "Study": "studies",
    "SweepResult": "sweeps",
    "Tolerances": "sweeps",
    "Units": "display_units",
    "animate": "draw.animate",
    "assemble": "analyses",
    "configurations": "closures",
    "design": "",
    "draw": "",
    "dynamics": "analyses",
    "equations": "symbolic",
    "equilibrium": "statics",
    "errors": "",
    "inverse_dynamics": "driven",
    "kinematics": "driven",
    "limits": "reach",
    "reachable": "region",
    "load": "case",
    "load_solution": "archive",
    "modes": "linearization",
    "mobility": "freedom",
    "player": "draw.player",
    "plot": "",
    "report": "",
    "scene": "draw.scene",
    "show": "matrices",
    "stiffness_at": "statics",
    "still": "draw.still",
    "study": "studies",
    "sweep": "sweeps",
    "tolerances": "sweeps",
    "units": "display_units",
    "write_report": "lab_report",
}

__all__ = ["__version__", *_HOME]  # noqa: PLE0604


def __getattr__(name: str) -> Any:
    """Import a public name from its module on first use (PEP 562)."""
    if name not in _HOME:
        raise AttributeError(f"module 'kempe' has no attribute {name!r}")
    home = _HOME[name]
    value = (
        getattr(import_module(f"kempe.{home}"), name) if home else import_module(f"kempe.{name}")
    )
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted(__all__)
