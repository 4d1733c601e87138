"""A flexible pendulum beside Exudyn: errors at equal numbers of nodes, and seconds.

Run ``.venv/bin/python benchmarks/flexible_pendulum.py`` with Exudyn installed from PyPI. A rod of
1 m hangs on a pin, starts horizontally at rest and falls for 0.6 s. The elements of kempe have four
nodes, ``ObjectBeamGeometricallyExact2D`` of Exudyn has two. The reference is a solution by kempe
with ten elements; both programs approach it.
"""

from __future__ import annotations

import itertools
import time
from typing import Any

import kempe as kp
import numpy as np

LENGTH, EA, GA, EI = 1.0, 2e5, 7e4, 2.0
MASS, INERTIA = 0.5, 5e-6  # kg/m, kg·m
G, END = 9.81, 0.6
#: Damping in proportion to stiffness, s.
DAMPING = 1e-3


def by_kempe(elements: int, tol: float = 1e-6) -> tuple[np.ndarray, float]:
    """Tip position at the end, and seconds of the run."""
    m = kp.Model("pendulum", gravity=(0, -G))
    m.ground.points(O=(0, 0))
    stiffness = {"EA": EA, "GA": GA, "EI": EI}
    masses = {"mass_per_length": MASS, "inertia_per_length": INERTIA}
    given = {"elements": elements, "damping": DAMPING, **stiffness, **masses}
    m.beam("rod", length=LENGTH, **given)
    m.revolute("O", "ground.O", "rod.A")
    start = kp.assemble(m)
    begin = time.perf_counter()
    solution = kp.dynamics(m, start, t_end=END, method=kp.Radau(rtol=tol, atol=tol))
    seconds = time.perf_counter() - begin
    return np.array([solution["rod.B.x"][-1], solution["rod.B.y"][-1]]), seconds


def by_exudyn(elements: int, steps: int = 600) -> tuple[np.ndarray, float]:
    """The same by Exudyn's generalized-alpha method."""
    import exudyn as exu
    from exudyn import itemInterface

    container = exu.SystemContainer()
    mbs: Any = container.AddSystem()
    step = LENGTH / elements
    nodes = [
        mbs.AddNode(itemInterface.NodeRigidBody2D(referenceCoordinates=[k * step, 0, 0]))
        for k in range(elements + 1)
    ]
    for a, b in itertools.pairwise(nodes):
        beam = mbs.AddObject(
            itemInterface.ObjectBeamGeometricallyExact2D(
                nodeNumbers=[a, b],
                length=step,
                massPerLength=MASS,
                crossSectionInertia=INERTIA,
                bendingStiffness=EI,
                axialStiffness=EA,
                shearStiffness=GA,
                bendingDamping=DAMPING * EI,
                axialDamping=DAMPING * EA,
                shearDamping=DAMPING * GA,
            )
        )
        marker = mbs.AddMarker(itemInterface.MarkerBodyMass(bodyNumber=beam))
        mbs.AddLoad(itemInterface.LoadMassProportional(markerNumber=marker, loadVector=[0, -G, 0]))
    ground = mbs.AddNode(itemInterface.NodePointGround())
    fixed = mbs.AddMarker(itemInterface.MarkerNodeCoordinate(nodeNumber=ground, coordinate=0))
    for coordinate in (0, 1):
        own = itemInterface.MarkerNodeCoordinate(nodeNumber=nodes[0], coordinate=coordinate)
        mbs.AddObject(itemInterface.CoordinateConstraint(markerNumbers=[fixed, mbs.AddMarker(own)]))
    mbs.Assemble()
    settings = exu.SimulationSettings()
    settings.timeIntegration.numberOfSteps = steps
    settings.timeIntegration.endTime = END
    settings.timeIntegration.generalizedAlpha.spectralRadius = 0.9
    settings.solution.file.write = False
    settings.linearSolver.solverType = exu.LinearSolverType.EigenSparse
    begin = time.perf_counter()
    mbs.SolveDynamic(settings)
    seconds = time.perf_counter() - begin
    moved = mbs.GetNodeOutput(nodes[-1], exu.OutputVariableType.Position)
    return np.array(moved[:2]), seconds


def main() -> None:
    """Print errors of the tip and seconds over the number of nodes."""
    exact, _ = by_kempe(10, 1e-8)
    print("program   nodes   steps   error (m)   seconds")
    for elements in (1, 2, 4, 8):
        tip, seconds = by_kempe(elements)
        error = np.hypot(*(tip - exact))
        print(f"kempe    {3 * elements + 1:6d}       -   {error:9.1e}   {seconds:7.3f}")
    for elements, steps in ((6, 600), (12, 600), (24, 1200), (48, 2400)):
        tip, seconds = by_exudyn(elements, steps)
        error = np.hypot(*(tip - exact))
        print(f"Exudyn   {elements + 1:6d}  {steps:6d}   {error:9.1e}   {seconds:7.3f}")


if __name__ == "__main__":
    main()
