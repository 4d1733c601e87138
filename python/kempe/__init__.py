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
    Stepper                 the motion in steps of another program, with inputs in between
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
    compare                 differences to another solution or to a table
    RK45, DOP853, RK4, Radau, GeneralizedAlpha, HHT, Auto
                            methods of integration
    Projection, Baumgarte   stabilizations of the constraints

Results:
    Solution, State, Motion quantities by name, bodies, joints, forces, energies
    show, equations         matrices and equations with the names of the model
    report.summary          peaks, settling times, energy balance
    load_solution           read a saved solution

    synthesis               linkages for poses, points and pairs of angles
    design                  coupler curves, transmission angles, motors, flywheels, pin loads

Show:
    plot                    figures
    animate, player         videos and pages with the motion
    write_report            a report with data, equations, figures, as HTML or PDF
    write_dxf               plates of the links, positions and paths as a drawing
    write_mjcf              a model of MuJoCo
    write_asmt              an assembly of OndselSolver and FreeCAD
    export_fmu              the case as a component of other simulation tools
    units                   units of tables, figures and CSV files

All errors are KempeErrors. ``help`` describes each name, for example ``help(kp.Model)``.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from kempe import _processor, _upwards
from kempe._version import __version__

_processor.load_core()

if TYPE_CHECKING:
    from kempe import design as design
    from kempe import draw as draw
    from kempe import errors as errors
    from kempe import plot as plot
    from kempe import report as report
    from kempe import synthesis as synthesis
    from kempe.analyses.assembly import assemble as assemble
    from kempe.analyses.configurations import ConfigurationsResult as ConfigurationsResult
    from kempe.analyses.configurations import configurations as configurations
    from kempe.analyses.dynamics import AccuracyWarning as AccuracyWarning
    from kempe.analyses.dynamics import dynamics as dynamics
    from kempe.analyses.equilibrium import EquilibriumResult as EquilibriumResult
    from kempe.analyses.equilibrium import PointStiffness as PointStiffness
    from kempe.analyses.equilibrium import equilibrium as equilibrium
    from kempe.analyses.equilibrium import stiffness_at as stiffness_at
    from kempe.analyses.event import Event as Event
    from kempe.analyses.kinematics import inverse_dynamics as inverse_dynamics
    from kempe.analyses.kinematics import kinematics as kinematics
    from kempe.analyses.limits import LimitsResult as LimitsResult
    from kempe.analyses.limits import limits as limits
    from kempe.analyses.mobility import MobilityResult as MobilityResult
    from kempe.analyses.mobility import mobility as mobility
    from kempe.analyses.modes import ModesResult as ModesResult
    from kempe.analyses.modes import modes as modes
    from kempe.analyses.options import DOP853 as DOP853
    from kempe.analyses.options import HHT as HHT
    from kempe.analyses.options import RK4 as RK4
    from kempe.analyses.options import RK45 as RK45
    from kempe.analyses.options import Auto as Auto
    from kempe.analyses.options import Baumgarte as Baumgarte
    from kempe.analyses.options import Configurations as Configurations
    from kempe.analyses.options import Dynamics as Dynamics
    from kempe.analyses.options import Equilibrium as Equilibrium
    from kempe.analyses.options import GeneralizedAlpha as GeneralizedAlpha
    from kempe.analyses.options import InverseDynamics as InverseDynamics
    from kempe.analyses.options import Kinematics as Kinematics
    from kempe.analyses.options import Limits as Limits
    from kempe.analyses.options import Mobility as Mobility
    from kempe.analyses.options import Modes as Modes
    from kempe.analyses.options import NoStabilization as NoStabilization
    from kempe.analyses.options import Projection as Projection
    from kempe.analyses.options import Radau as Radau
    from kempe.analyses.options import Reachable as Reachable
    from kempe.analyses.reachable import ReachableResult as ReachableResult
    from kempe.analyses.reachable import reachable as reachable
    from kempe.analyses.record import AssemblyWarning as AssemblyWarning
    from kempe.analyses.start import Start as Start
    from kempe.asmt.writer import write_asmt as write_asmt
    from kempe.base.display_units import Units as Units
    from kempe.base.display_units import units as units
    from kempe.case import Case as Case
    from kempe.draw.animate import animate as animate
    from kempe.draw.dxf import write_dxf as write_dxf
    from kempe.draw.player import player as player
    from kempe.draw.scene import scene as scene
    from kempe.draw.still import still as still
    from kempe.errors import AssemblyError as AssemblyError
    from kempe.errors import FileError as FileError
    from kempe.errors import IntegrationError as IntegrationError
    from kempe.errors import InternalError as InternalError
    from kempe.errors import KempeError as KempeError
    from kempe.errors import ModelError as ModelError
    from kempe.errors import RedundancyError as RedundancyError
    from kempe.errors import SingularityError as SingularityError
    from kempe.exercise import Exercise as Exercise
    from kempe.fmu.export import export_fmu as export_fmu
    from kempe.lab_report import write_report as write_report
    from kempe.loading import load as load
    from kempe.mjcf.writer import write_mjcf as write_mjcf
    from kempe.model.beams import Section as Section
    from kempe.model.doubts import ModelWarning as ModelWarning
    from kempe.model.functions import Function as Function
    from kempe.model.functions import FunctionWarning as FunctionWarning
    from kempe.model.functions import Sampled as Sampled
    from kempe.model.model import Model as Model
    from kempe.results.archive import load_solution as load_solution
    from kempe.results.assembly_report import AssemblyReport as AssemblyReport
    from kempe.results.energy import Energy as Energy
    from kempe.results.events import EventWarning as EventWarning
    from kempe.results.matrices.equations import equations as equations
    from kempe.results.matrices.labelled import Labelled as Labelled
    from kempe.results.matrices.labelled import show as show
    from kempe.results.matrices.values import Matrices as Matrices
    from kempe.results.motion import Motion as Motion
    from kempe.results.named_results import Results as Results
    from kempe.results.solution import Solution as Solution
    from kempe.results.state import State as State
    from kempe.stepping import SavedStep as SavedStep
    from kempe.stepping import Stepper as Stepper
    from kempe.sweeps import Allocation as Allocation
    from kempe.sweeps import SweepResult as SweepResult
    from kempe.sweeps import Tolerances as Tolerances
    from kempe.sweeps import allocate as allocate
    from kempe.sweeps import sweep as sweep
    from kempe.sweeps import tolerances as tolerances
    from kempe.sweeps.fits import Comparison as Comparison
    from kempe.sweeps.fits import Data as Data
    from kempe.sweeps.fits import Fit as Fit
    from kempe.sweeps.fits import compare as compare
    from kempe.sweeps.fits import fit as fit
    from kempe.sweeps.gradients import Gradient as Gradient
    from kempe.sweeps.gradients import gradient as gradient
    from kempe.sweeps.problems import Optimum as Optimum
    from kempe.sweeps.problems import Path as Path
    from kempe.sweeps.problems import optimize as optimize
    from kempe.sweeps.studies import Study as Study
    from kempe.sweeps.studies import study as study

# ``import kempe`` is fast, because each public name is imported on first use. A new public name
# needs one line in ``_HOME`` and one in the block for type checkers.
#: Public name → module of kempe that defines it; "" if the name itself is a module.
_HOME = {
    "Allocation": "sweeps",
    "AssemblyError": "errors",
    "AssemblyReport": "results.assembly_report",
    "AccuracyWarning": "analyses.dynamics",
    "AssemblyWarning": "analyses.record",
    "Auto": "analyses.options",
    "Baumgarte": "analyses.options",
    "Case": "case",
    "Comparison": "sweeps.fits",
    "Configurations": "analyses.options",
    "ConfigurationsResult": "analyses.configurations",
    "DOP853": "analyses.options",
    "Data": "sweeps.fits",
    "Dynamics": "analyses.options",
    "Energy": "results.energy",
    "Equilibrium": "analyses.options",
    "EquilibriumResult": "analyses.equilibrium",
    "Event": "analyses.event",
    "Exercise": "exercise",
    "EventWarning": "results.events",
    "FileError": "errors",
    "Function": "model.functions",
    "FunctionWarning": "model.functions",
    "Fit": "sweeps.fits",
    "GeneralizedAlpha": "analyses.options",
    "Gradient": "sweeps.gradients",
    "HHT": "analyses.options",
    "IntegrationError": "errors",
    "InternalError": "errors",
    "InverseDynamics": "analyses.options",
    "KempeError": "errors",
    "Kinematics": "analyses.options",
    "Labelled": "results.matrices.labelled",
    "Limits": "analyses.options",
    "LimitsResult": "analyses.limits",
    "Reachable": "analyses.options",
    "ReachableResult": "analyses.reachable",
    "Matrices": "results.matrices.values",
    "Mobility": "analyses.options",
    "MobilityResult": "analyses.mobility",
    "Model": "model.model",
    "ModelError": "errors",
    "ModelWarning": "model.doubts",
    "Modes": "analyses.options",
    "ModesResult": "analyses.modes",
    "Motion": "results.motion",
    "NoStabilization": "analyses.options",
    "Optimum": "sweeps.problems",
    "Path": "sweeps.problems",
    "PointStiffness": "analyses.equilibrium",
    "Projection": "analyses.options",
    "RK4": "analyses.options",
    "RK45": "analyses.options",
    "Radau": "analyses.options",
    "RedundancyError": "errors",
    "Results": "results.named_results",
    "Sampled": "model.functions",
    "SavedStep": "stepping",
    "SingularityError": "errors",
    "Solution": "results.solution",
    "Section": "model.beams",
    "Start": "analyses.start",
    "State": "results.state",
    "Stepper": "stepping",
    "Study": "sweeps.studies",
    "SweepResult": "sweeps",
    "Tolerances": "sweeps",
    "Units": "base.display_units",
    "allocate": "sweeps",
    "animate": "draw.animate",
    "assemble": "analyses.assembly",
    "compare": "sweeps.fits",
    "configurations": "analyses.configurations",
    "design": "",
    "draw": "",
    "dynamics": "analyses.dynamics",
    "equations": "results.matrices.equations",
    "equilibrium": "analyses.equilibrium",
    "errors": "",
    "export_fmu": "fmu.export",
    "fit": "sweeps.fits",
    "gradient": "sweeps.gradients",
    "inverse_dynamics": "analyses.kinematics",
    "kinematics": "analyses.kinematics",
    "limits": "analyses.limits",
    "reachable": "analyses.reachable",
    "load": "loading",
    "load_solution": "results.archive",
    "modes": "analyses.modes",
    "mobility": "analyses.mobility",
    "optimize": "sweeps.problems",
    "player": "draw.player",
    "plot": "",
    "report": "",
    "scene": "draw.scene",
    "show": "results.matrices.labelled",
    "stiffness_at": "analyses.equilibrium",
    "still": "draw.still",
    "study": "sweeps.studies",
    "sweep": "sweeps",
    "synthesis": "",
    "tolerances": "sweeps",
    "units": "base.display_units",
    "write_asmt": "asmt.writer",
    "write_dxf": "draw.dxf",
    "write_mjcf": "mjcf.writer",
    "write_report": "lab_report",
}

#: Former public name → its present name and the version since which it has this name.
_FORMER: dict[str, tuple[str, str]] = {}

__all__ = ["__version__", *_HOME]  # noqa: PLE0604


def __getattr__(name: str) -> Any:
    """Import a public name from its module on first use (PEP 562)."""
    if name in _FORMER:
        from kempe.base.deprecation import announce

        present, since = _FORMER[name]
        announce(f"kempe.{name}", f"kempe.{present}", since)
        return __getattr__(present)
    if name not in _HOME:
        from kempe.base.arguments import missing_attribute

        raise AttributeError(missing_attribute("module 'kempe'", name, __all__))
    home = _HOME[name]
    value = (
        getattr(import_module(f"kempe.{home}"), name) if home else import_module(f"kempe.{name}")
    )
    globals()[name] = value
    return value


# The calls upwards; see _upwards.py.


def _html(of: Any) -> str:
    from kempe.notebook import html

    return html(of)


def _model(compiled: Any) -> Any:
    from kempe.model.model import Model

    return Model.of_compiled(compiled)


def _state(*parts: Any, **more: Any) -> Any:
    from kempe.results.state import State

    return State(*parts, **more)


def _slopes(*parts: Any) -> Any:
    from kempe.sweeps.gradients.along import SlopesAlong

    return SlopesAlong.of(*parts)


_upwards.CALLS.update(html=_html, model=_model, slopes=_slopes, state=_state)


def __dir__() -> list[str]:
    return sorted(__all__)
