"""Figures of sweeps, searches, fits, comparisons and syntheses, from few or hand-made numbers."""

from functools import cache
from typing import Any

import kempe as kp
import numpy as np
from fits.test_faults import oscillator
from kempe import plot
from kempe.plot.result_pages import result_pages
from matplotlib.figure import Figure
from plot.test_design_figures import figure_of
from python.test_compare import thrown
from python.test_reachable import arm
from refusals.test_sweeps import pendulum
from sweeps.conftest import flagship


def of_failures(_: Any) -> list[Figure]:
    """Lines over couplers, of which those over 37 do not reach."""
    values = {"L2": [20.0, 24.0, 26.0, 47.0], "k": [1e4, 1e6]}
    found = kp.sweep(flagship(0.02), values, ["pin.max"])
    one = kp.sweep(flagship(0.02), {"L2": values["L2"]}, ["rocker.angle.final"])
    axes = plot.sweep_lines(found, "pin.max"), plot.sweep_lines(one, "rocker.angle.final")
    return [figure_of(one) for one in axes]


def of_constants(_: Any) -> list[Figure]:
    """A torque that is constant, at a speed that is not and at one that is; and none."""
    made = []
    for law, torque in (("t^2/2", -3.0), ("5*t", -3.0), ("5*t", 0.0)):
        m = kp.Model("wheel")
        m.ground.points(O=(0, 0))
        m.body("wheel", mass=1, inertia=2.0, points={"O": (0, 0)})
        m.revolute("O", "ground.O", "wheel.O")
        m.torque("load", "wheel", torque=torque)
        m.coordinate_driver("motor", "wheel.angle", value=law)
        sol = kp.inverse_dynamics(m, kp.assemble(m), t_end=1.0, output_step=0.1)
        made += [figure_of(draw(sol, "motor")) for draw in (plot.effort, plot.torque_speed)]
    return made


def of_reach(_: Any) -> list[Figure]:
    """A long and a short arm, and a tiny one."""
    made = []
    for scale, ranges in ((1.0, ((0.0, 1.5), (0.5, 2.0))), (1e-3, ((0.0, 3.0), (-2.0, 2.0)))):
        m = arm(0.5 * scale, 0.3 * scale)
        start = kp.assemble(m, set={"upper.angle": 0.2, "fore.angle": 1.0})
        over = ("shoulder.angle", "elbow.angle")
        found = kp.reachable(m, start, of="fore.H", over=over, ranges=ranges, n=21)
        made += [page.figure() for page in result_pages(found)]
    return made


@cache
def searched(aims: tuple[str, ...]) -> kp.Optimum:
    """A block whose spring is sought, with a history by hand."""
    m = kp.Model("block", parameters={"k": "300 N/m", "free": "20 mm", "mass": "0.5 kg"})
    m.ground.points(O=(0, 0))
    m.body("block", mass="mass", inertia=1, points={"P": (0, 0)})
    m.translational("guide", "ground.O", "block.P")
    law = "k*(free - guide.displacement) - 4"
    m.generalized_force("spring", "guide.displacement", value=law)
    case = kp.Case(m, None, [kp.Equilibrium(name="rest")])
    between = {"k": (1e4, 2e6, "log"), "free": (-0.05, 0.4)}
    given = list(aims) if len(aims) > 1 else aims[0]
    return kp.optimize(case, between, maximize=given, subject_to="block.x <= 0.2", starts=1, seed=1)


def of_search(_: Any) -> list[Figure]:
    """A history over three decades with a failed run and one beyond a limit; and one at 0."""
    best = searched(("block.x",))
    count = best._table.shape[1]
    made = []
    for objectives in ([0.002, 0.05, np.nan, 2.5, 0.19], [-0.1, 0.05, 0.02, np.nan, np.nan]):
        table = np.zeros((5, count))
        table[:, -2], table[:, -1] = objectives, [0.0, 0.0, np.nan, 0.3, 0.0]
        best.__dict__["_table"] = table
        made.append(plot.optimization(best))
    return made


def of_fit(_: Any) -> list[Figure]:
    """Two experiments with errors that repeat."""
    t = np.linspace(0.1, 4.9, 25)
    error = 0.05 * np.sin(7.0 * np.arange(25))
    made = [
        kp.Data({"t": t, "x [mm]": 1e3 * (np.cos(2 * t) + sign * error)}, columns={"b.x": "x [mm]"})
        for sign in (1.0, -1.0)
    ]
    alone = kp.fit(oscillator(k=3.9), made[0], {"k": (0, None)})
    both = kp.fit(oscillator(k=3.9), [({}, one) for one in made], {"k": (0, None)})
    return [plot.fit(alone), plot.fit(both)]


def of_gradient(_: Any) -> list[Figure]:
    measures = ["O.force.max", "rod.angle.final", "u.max"]
    found = kp.gradient(pendulum(), measures, ["length", "k", "u", "rod.angle"])
    return [plot.gradient(found), plot.gradient(found, ["rod.angle.final"])]


def of_comparison(_: Any) -> list[Figure]:
    """A point that is thrown with another gravity, and a table in millimetres."""
    t = np.linspace(0, 2, 9)
    table = {"t": t, "ball.x [mm]": 3000 * t, "ball.y": 20 * t - 5 * t**2 + 0.1 * np.sin(3 * t)}
    return [
        plot.comparison(kp.compare(thrown(), thrown(9.0))),
        plot.comparison(kp.compare(thrown(), table)),
    ]


def of_slopes(_: Any) -> list[Figure]:
    case = pendulum()
    found = kp.dynamics(case.model, case.start(), t_end=0.4, slopes=["length", "k"])
    return [plot.slopes(found, "rod.angle"), plot.slopes(found, "O.force", ["k"])]


def of_synthesis(_: Any) -> list[Figure]:
    """Five poses of a coupler, two of its candidates; and the curves of four poses."""
    poses = [
        (1.01, 1.62, 0.82), (1.11, 2.02, 0.63), (0.90, 2.25, 0.45),
    ]  # fmt: skip
    found = kp.synthesis.motion(poses, pivots={"O": (0, 0), "D": (3, 0)}, defects="tell")
    more = [*poses, (0.5, 2.3, 0.35)]
    return [plot.synthesis(found), figure_of(plot.burmester(kp.synthesis.burmester(more)))]


OTHERS = {
    "lines with failures": of_failures,
    "constant efforts": of_constants,
    "reachable": of_reach,
    "search": of_search,
    "fit": of_fit,
    "gradient": of_gradient,
    "comparison": of_comparison,
    "slopes": of_slopes,
    "synthesis": of_synthesis,
}
