"""Exudyn: planar rigid bodies, revolutes as constraints at position level, generalized-alpha."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from problems.planar import GROUND, Motion, Pair, Problem

from peers.setting import Setting, affordable, not_installed

NAME = "exudyn"
TRIED = (
    "on flagship, squeezer and N = 1: generalized-alpha at index 3 with spectral radii 0.5, "
    "0.7, 0.9 (shown) and 1, the trapezoidal rule at index 2; dense and sparse factors; "
    "modified and full Newton (full is taken below five bodies, where it was cheaper); its "
    "own tolerances and tighter ones. Its explicit methods take no joints"
)
#: Method, and tolerances of Newton's method (relative, absolute); None: its own 1e-8 and 1e-10.
CURVES: dict[str, dict[str, Any]] = {
    "Exudyn generalized-alpha": {"solver": "GeneralizedAlpha", "newton": None},
    "Exudyn generalized-alpha, tight": {"solver": "GeneralizedAlpha", "newton": (1e-10, 1e-12)},
    "Exudyn trapezoidal index 2": {"solver": "TrapezoidalIndex2", "newton": (1e-10, 1e-12)},
}
#: Bodies from which sparse factors are cheaper.
SPARSE = 10
#: Bodies from which modified Newton is cheaper.
FULL_NEWTON = 5


def missing() -> str | None:
    """The reason if Exudyn cannot be used."""
    return not_installed("exudyn")


def version() -> str:
    """Version of Exudyn."""
    import exudyn

    return str(exudyn.__version__)


def settings(problem: Problem, quick: bool = False) -> list[Setting]:
    """Curves over the steps of the problem."""
    steps = affordable(problem, quick)
    return [Setting(curve, step, CURVES[curve]) for curve in CURVES for step in steps]


def build(problem: Problem, mbs: Any) -> list[int]:
    """Build the mechanism; return one sensor per body."""
    import exudyn as exu
    from exudyn import itemInterface

    ground = mbs.AddObject(itemInterface.ObjectGround())
    nodes, bodies = add_bodies(problem, mbs)

    def markers(*ends: tuple[int, Pair]) -> list[Any]:
        return [
            mbs.AddMarker(
                itemInterface.MarkerBodyPosition(
                    bodyNumber=ground if body == GROUND else bodies[body], localPosition=[*s, 0]
                )
            )
            for body, s in ends
        ]

    for e in problem.joints:
        ends = markers((e.i, e.s_i), (e.j, e.s_j))
        mbs.AddObject(itemInterface.ObjectJointRevolute2D(markerNumbers=ends))
    for s in problem.springs:
        numbers = {"stiffness": s.stiffness, "referenceLength": s.free_length}
        ends = markers((s.i, s.s_i), (s.j, s.s_j))
        mbs.AddObject(itemInterface.ObjectConnectorSpringDamper(markerNumbers=ends, **numbers))
    add_torques(problem, mbs, nodes)
    kind = exu.OutputVariableType.Coordinates
    stored = {"storeInternal": True, "writeToFile": False, "outputVariableType": kind}
    return [mbs.AddSensor(itemInterface.SensorNode(nodeNumber=n, **stored)) for n in nodes]


def add_bodies(problem: Problem, mbs: Any) -> tuple[list[Any], list[Any]]:
    """Bodies with their weights; returns nodes and bodies."""
    from exudyn import itemInterface

    nodes, bodies = [], []
    for body in problem.bodies:
        start = {"referenceCoordinates": list(body.q), "initialVelocities": list(body.v)}
        nodes.append(mbs.AddNode(itemInterface.NodeRigidBody2D(**start)))
        numbers = {"mass": body.mass, "inertia": body.inertia, "nodeNumber": nodes[-1]}
        bodies.append(mbs.AddObject(itemInterface.ObjectRigidBody2D(**numbers)))
        centre = mbs.AddMarker(itemInterface.MarkerBodyMass(bodyNumber=bodies[-1]))
        pull = [0, -problem.gravity, 0]
        mbs.AddLoad(itemInterface.LoadMassProportional(markerNumber=centre, loadVector=pull))
    return nodes, bodies


def add_torques(problem: Problem, mbs: Any, nodes: list[Any]) -> None:
    """Torsion springs and torques, on the third coordinate of their bodies."""
    from exudyn import itemInterface

    def angle(node: Any, coordinate: int = 2) -> Any:
        marker = itemInterface.MarkerNodeCoordinate(nodeNumber=node, coordinate=coordinate)
        return mbs.AddMarker(marker)

    for t in problem.torsion_springs:
        still = mbs.AddNode(itemInterface.NodePointGround())
        ends = [angle(still, 0), angle(nodes[t.j])]
        # coordinates of Exudyn are displacements from the reference
        offset = float(t.free_angle - problem.bodies[t.j].q[2])
        numbers = {"stiffness": t.stiffness, "damping": t.damping, "offset": offset}
        spring = itemInterface.ObjectConnectorCoordinateSpringDamper(markerNumbers=ends, **numbers)
        mbs.AddObject(spring)
    for torque in problem.torques:
        load = {"markerNumber": angle(nodes[torque.j]), "load": torque.torque}
        mbs.AddLoad(itemInterface.LoadCoordinate(**load))


def simulation(problem: Problem, setting: Setting) -> Any:
    """Simulation settings of Exudyn."""
    import exudyn as exu

    asked = exu.SimulationSettings()
    integration = asked.timeIntegration
    integration.numberOfSteps = round(problem.t_end / setting.tolerance)
    integration.endTime = problem.t_end
    integration.generalizedAlpha.spectralRadius = 0.9
    integration.newton.useModifiedNewton = len(problem.bodies) >= FULL_NEWTON
    if tolerances := setting.options["newton"]:
        integration.newton.relativeTolerance, integration.newton.absoluteTolerance = tolerances
    asked.solution.file.write = False
    asked.solution.sensors.writePeriod = problem.output_step
    large = len(problem.bodies) >= SPARSE
    kinds = exu.LinearSolverType
    asked.linearSolver.solverType = kinds.EigenSparse if large else kinds.EXUdense
    return asked


def prepare(problem: Problem, setting: Setting) -> Callable[[], Any]:
    """A run: coordinates on the grid."""
    import exudyn as exu

    container = exu.SystemContainer()
    mbs = container.AddSystem()
    sensors = build(problem, mbs)
    mbs.Assemble()
    asked = simulation(problem, setting)
    kind = getattr(exu.DynamicSolverType, setting.options["solver"])

    def run() -> list[np.ndarray]:
        if not mbs.SolveDynamic(asked, solverType=kind, showHints=False, showCausingItems=False):
            raise RuntimeError("SolveDynamic did not succeed")
        return [np.array(mbs.GetSensorStoredData(sensor)) for sensor in sensors]

    # a run uses the initial state of the container, which must not be deleted before
    run.container = container  # type: ignore[attr-defined]
    return run


def motion(problem: Problem, found: list[np.ndarray]) -> Motion:
    """The motion of a run; rows are (t, x, y, angle), displacements from the start."""
    t = found[0][:, 0]
    start = problem.q0.reshape(-1, 3)
    q = np.stack([rows[:, 1:4] + start[k] for k, rows in enumerate(found)], axis=1)
    return Motion(t, q)
