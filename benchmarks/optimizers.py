"""The same two searches by kempe, SciPy by hand, pylinkage and Exudyn: runs, seconds, result.

    .venv/bin/python -m pip install pylinkage==1.3.0 exudyn scipy
    .venv/bin/python benchmarks/optimizers.py             # ten minutes; writes the page
    .venv/bin/python benchmarks/optimizers.py --page      # the page from the stored results

Both searches have an optimum that is known, with a residual of 0. In `path`, a four-bar linkage
draws twelve points at given angles of its crank; five lengths are sought. In `swing`, a pendulum
with a torsion spring has a given lowest angle, a given speed and a given angle after 1 s;
stiffness and damping are sought. All begin from the same values within the same bounds. The tools
take turns.
"""

from __future__ import annotations

import argparse
import json
import statistics
import time
from collections.abc import Callable, Mapping
from contextlib import redirect_stdout
from io import StringIO
from pathlib import Path
from typing import Any

import kempe as kp
import numpy as np
from optimizers_page import page
from scipy import optimize
from scipy.integrate import solve_ivp

ROOT = Path(__file__).parents[1]
RESULTS, PAGE = Path(__file__).with_suffix(".json"), ROOT / "docs" / "optimizers.md"
REPEATS = 3
Values = Mapping[str, float]
#: An objective over a vector of values.
Objective = Callable[[np.ndarray], Any]

LENGTHS = {"r2": 1.5, "r3": 3.0, "r4": 3.5, "rcx": 1.2, "rcy": 1.0}
LENGTHS_START = {"r2": 1.4, "r3": 3.3, "r4": 3.4, "rcx": 1.5, "rcy": 0.7}
GROUND, ANGLES = 4.0, 0.3 + 0.5 * np.arange(12)
SPRING, SPRING_START = {"k": 4.0, "c": 0.3}, {"k": 10.0, "c": 1.0}
GRAVITY, T_END, STEP = 9.81, 1.0, 1e-3


class Counted:
    """An objective that counts its calls."""

    def __init__(self, of: Callable[..., Any]) -> None:
        self.of, self.calls = of, 0

    def __call__(self, *given: Any, **named: Any) -> Any:
        """The objective."""
        self.calls += 1
        return self.of(*given, **named)


def bounds_of(exact: Values) -> dict[str, tuple[float, float]]:
    """Bounds from half to twice the right values; a fifth to five times those of the spring."""
    wide = 5.0 if exact is SPRING else 2.0
    return {name: (x / wide, x * wide) for name, x in exact.items()}


def places(x: np.ndarray) -> np.ndarray:
    """The coupler point at all angles, (12, 2), by hand; NaN where the linkage does not close."""
    r2, r3, r4, rcx, rcy = x
    pin = r2 * np.exp(1j * ANGLES)
    across = GROUND - pin
    with np.errstate(invalid="ignore"):
        cosine = (r3**2 + abs(across) ** 2 - r4**2) / (2 * r3 * abs(across))
        turn = across / abs(across) * np.exp(1j * np.arccos(cosine))
    found = pin + (rcx + 1j * rcy) * turn
    return np.stack([found.real, found.imag], axis=1)


POINTS = places(np.array(list(LENGTHS.values())))


def linkage() -> kp.Case:
    """The four-bar linkage of kempe."""
    m = kp.Model("four-bar linkage", parameters=LENGTHS_START)
    m.ground.points(A=(0, 0), D=(GROUND, 0))
    m.bar("crank", mass=1, length="r2", ends=("A", "B"))
    coupler = {"B": (0, 0), "C": ("r3", 0), "P": ("rcx", "rcy")}
    m.body("coupler", mass=1, inertia=1, points=coupler)
    m.bar("rocker", mass=1, length="r4", ends=("D", "C"))
    for name, i, j in (("A", "ground", "crank"), ("B", "crank", "coupler"),
                       ("C", "coupler", "rocker"), ("D", "ground", "rocker")):  # fmt: skip
        m.revolute(name, f"{i}.{name}", f"{j}.{name}")
    turn = kp.Kinematics(over="crank.angle", range=(ANGLES[0], ANGLES[-1]), n=12)
    guess = {"coupler.angle": 0.8, "rocker.angle": 1.8}
    return kp.Case(m, {"set": {"crank.angle": ANGLES[0]}, "guess": guess}, [turn])


def path_by_kempe() -> tuple[int, list[float]]:
    """``kp.optimize`` with a path."""
    path = kp.Path(POINTS, of="coupler.P", angles=ANGLES)
    best = kp.optimize(linkage(), bounds_of(LENGTHS), minimize=path)
    return best.runs, list(best.values.values())


def residuals_of_path(x: np.ndarray) -> np.ndarray:
    """Differences from the points; a large number where the linkage does not close."""
    return np.nan_to_num((places(x) - POINTS).ravel(), nan=1e3)


def by_least_squares(of: Objective, start: Values, exact: Values) -> tuple[int, list[float]]:
    """``least_squares`` of SciPy, whose slopes are differences."""
    counted = Counted(of)
    bounds = np.transpose(list(bounds_of(exact).values()))
    found = optimize.least_squares(counted, list(start.values()), bounds=bounds, x_scale="jac",
                                   xtol=1e-12, ftol=1e-12, gtol=1e-12)  # fmt: skip
    return counted.calls, list(found.x)


def by_evolution(of: Objective, exact: Values) -> tuple[int, list[float]]:
    """``differential_evolution`` of SciPy."""
    counted = Counted(lambda x: float((of(x) ** 2).sum()))
    found = optimize.differential_evolution(counted, list(bounds_of(exact).values()), rng=0)
    return counted.calls, list(found.x)


def pylinkage_of_path() -> tuple[Any, Callable[..., float]]:
    """The linkage of pylinkage, and the sum of the squared distances."""
    import pylinkage as pl

    frame, end = pl.Ground(0.0, 0.0), pl.Ground(GROUND, 0.0)
    step = float(ANGLES[1] - ANGLES[0])
    crank = pl.Crank(frame, LENGTHS_START["r2"], step, float(ANGLES[0]) - step)  # steps come first
    rocker = pl.RRRDyad(crank.output, end, LENGTHS_START["r3"], LENGTHS_START["r4"], x=3.0, y=3.0)
    radius, angle = polar(list(LENGTHS_START.values()))[3:]
    point = pl.FixedDyad(crank.output, rocker, radius, angle)
    made = pl.Linkage([frame, end, crank, rocker, point])
    begin = made.get_coords()

    def squares(linkage: Any, dimensions: Any, *_: Any) -> float:
        linkage.set_coords(begin)
        linkage.set_constraints(dimensions)
        try:
            steps = [found[-1] for found in linkage.step(iterations=len(ANGLES), dt=1)]
        except pl.UnbuildableError:
            return 1e6
        return float(((np.array(steps, dtype=float) - POINTS) ** 2).sum())

    return made, squares


def polar(x: Any) -> list[float]:
    """The dimensions of pylinkage: the point of the coupler in polar coordinates."""
    r2, r3, r4, rcx, rcy = map(float, x)
    return [r2, r3, r4, float(np.hypot(rcx, rcy)), float(np.arctan2(rcy, rcx))]


def lengths_of(dimensions: Any) -> list[float]:
    """The lengths from the dimensions of pylinkage."""
    r2, r3, r4, radius, angle = map(float, dimensions)
    return [r2, r3, r4, radius * float(np.cos(angle)), radius * float(np.sin(angle))]


def path_by_pylinkage(name: str, **options: Any) -> tuple[int, list[float]]:
    """An optimiser of pylinkage; the bounds are those of the point's polar coordinates."""
    import pylinkage.optimization as of

    made, squares = pylinkage_of_path()
    counted = Counted(squares)
    limits = list(bounds_of(LENGTHS).values())
    low, high = ([pair[k] for pair in limits[:3]] for k in (0, 1))
    bounds = ([*low, 0.5, 0.2], [*high, 3.2, 1.4])
    if "x0" in options:
        options["x0"] = polar(LENGTHS_START.values())
    if "center" in options:
        options["center"] = polar(LENGTHS_START.values())
    found = getattr(of, name)(
        counted, made, bounds=bounds, order_relation=min, verbose=False, **options
    )
    return counted.calls, lengths_of(found[0].dimensions)


def swing_by_hand(x: np.ndarray) -> np.ndarray:
    """Lowest angle, fastest fall and last angle, by RK45 on the equation of motion."""
    k, c = x

    def rates(_: float, y: np.ndarray) -> list[float]:
        torque = -k * (y[0] + np.pi / 2) - c * y[1] - GRAVITY / 2 * np.cos(y[0])
        return [y[1], 3 * torque]

    def turns(_: float, y: np.ndarray) -> float:
        return float(y[1])

    def slows(t: float, y: np.ndarray) -> float:
        return rates(t, y)[1]

    turns.direction = slows.direction = 1  # type: ignore[attr-defined]
    run = solve_ivp(rates, (0, T_END), [0.0, 0.0], events=[turns, slows], rtol=1e-8, atol=1e-10)
    last = run.y[:, -1]
    least = [
        min([*found[:, j], last[j]], default=0.0) if len(found) else last[j]
        for j, found in enumerate(run.y_events)
    ]
    return np.array([*least, last[0]])


AIMS = swing_by_hand(np.array(list(SPRING.values())))


def residuals_of_swing(x: np.ndarray) -> np.ndarray:
    """Relative deviations from the aims."""
    return (swing_by_hand(x) - AIMS) / AIMS


def swing_by_kempe() -> tuple[int, list[float]]:
    """``kp.optimize`` with targets."""
    m = kp.Model("pendulum", gravity=(0, -GRAVITY), parameters=SPRING_START)
    m.ground.points(O=(0, 0))
    m.bar("rod", mass=1, length=1, ends=("O", "E"))
    m.revolute("O", "ground.O", "rod.O")
    law = {"stiffness": "k", "damping": "c", "free_angle": -np.pi / 2}
    m.torsion_spring("spring", "ground", "rod", **law)
    case = kp.Case(m, {"set": {"rod.angle": 0.0}}, [kp.Dynamics(t_end=T_END, output_step=0.02)])
    names = ("rod.angle.min", "rod.omega.min", "rod.angle.final")
    aims = dict(zip(names, AIMS.tolist(), strict=True))
    best = kp.optimize(case, bounds_of(SPRING), target=aims)
    return best.runs, list(best.values.values())


def swing_by_exudyn(values: Values) -> float:
    """The sum of the squared deviations, by a planar rigid body of Exudyn."""
    import exudyn as exu
    from exudyn import itemInterface

    container = exu.SystemContainer()
    mbs = container.AddSystem()
    ground = mbs.AddObject(itemInterface.ObjectGround())
    node = mbs.AddNode(itemInterface.NodeRigidBody2D(referenceCoordinates=[0.5, 0, 0]))
    rod = mbs.AddObject(itemInterface.ObjectRigidBody2D(mass=1, inertia=1 / 12, nodeNumber=node))
    ends = [
        mbs.AddMarker(itemInterface.MarkerBodyPosition(bodyNumber=body, localPosition=at))
        for body, at in ((ground, [0, 0, 0]), (rod, [-0.5, 0, 0]))
    ]
    mbs.AddObject(itemInterface.ObjectJointRevolute2D(markerNumbers=ends))
    centre = mbs.AddMarker(itemInterface.MarkerBodyMass(bodyNumber=rod))
    mbs.AddLoad(
        itemInterface.LoadMassProportional(markerNumber=centre, loadVector=[0, -GRAVITY, 0])
    )
    still = mbs.AddNode(itemInterface.NodePointGround())
    angles = [
        mbs.AddMarker(itemInterface.MarkerNodeCoordinate(nodeNumber=of, coordinate=place))
        for of, place in ((still, 0), (node, 2))
    ]
    law = {"stiffness": values["k"], "damping": values["c"], "offset": -np.pi / 2}
    mbs.AddObject(itemInterface.ObjectConnectorCoordinateSpringDamper(markerNumbers=angles, **law))
    kinds = exu.OutputVariableType
    stored = {"nodeNumber": node, "storeInternal": True, "writeToFile": False}
    sensors = [
        mbs.AddSensor(itemInterface.SensorNode(**stored, outputVariableType=kind))
        for kind in (kinds.Coordinates, kinds.Coordinates_t)
    ]
    mbs.Assemble()
    asked = exu.SimulationSettings()
    asked.timeIntegration.numberOfSteps, asked.timeIntegration.endTime = round(T_END / STEP), T_END
    asked.solution.file.write = False
    asked.solution.sensors.writePeriod = STEP
    mbs.SolveDynamic(asked, showHints=False, showCausingItems=False)
    angle, speed = (np.array(mbs.GetSensorStoredData(of))[:, 3] for of in sensors)
    found = np.array([angle.min(), speed.min(), angle[-1]])
    return float((((found - AIMS) / AIMS) ** 2).sum())


def swing_by_exudyn_with(name: str, **options: Any) -> tuple[int, list[float]]:
    """An optimiser of Exudyn."""
    from exudyn import processing

    counted = Counted(swing_by_exudyn)
    call = getattr(processing, name)
    best = call(counted, bounds_of(SPRING), showProgress=False, **options)[0]
    return counted.calls, [float(best[key]) for key in SPRING]


Way = Callable[[], tuple[int, list[float]]]
WAYS: dict[str, dict[str, Way]] = {
    "path": {
        "kempe": path_by_kempe,
        "SciPy by hand, least_squares": lambda: by_least_squares(
            residuals_of_path, LENGTHS_START, LENGTHS
        ),
        "SciPy by hand, differential_evolution": lambda: by_evolution(residuals_of_path, LENGTHS),
        "pylinkage, minimize_linkage (Nelder-Mead)": lambda: path_by_pylinkage(
            "minimize_linkage", x0=True, maxiter=5000, tol=1e-10
        ),
        "pylinkage, particle_swarm_optimization": lambda: path_by_pylinkage(
            "particle_swarm_optimization", center=True
        ),
        "pylinkage, differential_evolution_optimization": lambda: path_by_pylinkage(
            "differential_evolution_optimization", seed=0
        ),
    },
    "swing": {
        "kempe": swing_by_kempe,
        "SciPy by hand, least_squares": lambda: by_least_squares(
            residuals_of_swing, SPRING_START, SPRING
        ),
        "SciPy by hand, differential_evolution": lambda: by_evolution(residuals_of_swing, SPRING),
        "Exudyn, GeneticOptimization": lambda: swing_by_exudyn_with(
            "GeneticOptimization", randomizerInitialization=0
        ),
        "Exudyn, Minimize (Nelder-Mead)": lambda: swing_by_exudyn_with(
            "Minimize", initialGuess=list(SPRING_START.values()), tol=1e-10,
            storeFunctionValues=False,
        ),
    },
}  # fmt: skip


def measured(problem: str, repeats: int) -> dict[str, dict[str, float]]:
    """Runs, median seconds and the largest relative error of a value, of each way."""
    exact = list((LENGTHS if problem == "path" else SPRING).values())
    seconds: dict[str, list[float]] = {who: [] for who in WAYS[problem]}
    found: dict[str, tuple[int, list[float]]] = {}
    for _ in range(repeats):
        for who, way in WAYS[problem].items():
            begin = time.perf_counter()
            with redirect_stdout(StringIO()):
                found[who] = way()
            seconds[who].append(time.perf_counter() - begin)
    return {
        who: {
            "runs": runs,
            "seconds": statistics.median(seconds[who]),
            "error": max(abs(x / of - 1) for x, of in zip(values, exact, strict=True)),
        }
        for who, (runs, values) in found.items()
    }


def main() -> None:
    """Measure and write the page, or write it alone."""
    from importlib.metadata import version

    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--page", action="store_true", help="from the stored results")
    parser.add_argument("--repeats", type=int, default=REPEATS, help="of each search")
    parser.add_argument("--only", choices=WAYS, help="print the measurements of one problem")
    words = parser.parse_args()
    if words.only:
        print(json.dumps(measured(words.only, words.repeats), indent=1))
        return
    if not words.page:
        versions = {name: version(name) for name in ("scipy", "pylinkage", "exudyn")}
        problems = {name: measured(name, words.repeats) for name in WAYS}
        found = {"versions": versions, "problems": problems}
        RESULTS.write_text(json.dumps(found, indent=1) + "\n", encoding="utf-8")
    PAGE.write_text(page(json.loads(RESULTS.read_text("utf-8"))), encoding="utf-8")


if __name__ == "__main__":
    main()
