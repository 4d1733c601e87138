"""Positions and their derivatives by closed forms: a four-bar and a slider-crank."""

from __future__ import annotations

from collections import defaultdict
from typing import Any

import kempe as kp
import numpy as np

from benchmarks.validation.comparison import Benchmark, Comparison, compared, reference


def four_bar(degrees: str) -> kp.Model:
    """40, 120, 80 and 100 m, the crank driven at 1 rad/s."""
    m = kp.Model("four-bar")
    m.ground.points(A=(0, 0), D=(100, 0))
    m.bar("crank", mass=1, length=40, ends=("A", "B"))
    m.bar("coupler", mass=1, length=120, ends=("B", "C"))
    m.bar("rocker", mass=1, length=80, ends=("D", "C"))
    m.revolute("A", "ground.A", "crank.A")
    m.revolute("B", "crank.B", "coupler.B")
    m.revolute("C", "coupler.C", "rocker.C")
    m.revolute("D", "ground.D", "rocker.D")
    m.coordinate_driver("motor", "crank.angle", value=f"{degrees}*deg + t")
    return m


def four_bar_comparisons(table: dict[str, Any]) -> list[Comparison]:
    """Both assembly modes at all angles of the crank."""
    published, found = defaultdict(list), defaultdict(list)
    for name, values in table.items():
        if "deg " not in name:
            continue
        truth = {key: float(x) for key, x in values.items()}
        guess = {  # nine degrees off; selects the assembly mode
            "coupler.angle": f"{truth['phi2_deg'] + 9}*deg",
            "rocker.angle": f"{truth['phi3_deg'] - 9}*deg",
        }
        state = kp.assemble(four_bar(name.split("deg ")[0]), guess=guess)
        for k, body in ((2, "coupler"), (3, "rocker")):
            motion = state[body]
            ours = {
                f"phi{k}_deg": np.degrees(motion.angle),
                f"dphi{k}/dth": motion.omega,
                f"d2phi{k}/dth2": motion.alpha,
            }
            for (key, x), kind in zip(ours.items(), ("angle", "first", "second"), strict=True):
                published[kind].append(truth[key])
                found[kind].append(x)
    what = {
        "angle": ("four-bar: angles of coupler and rocker", "deg", 1e-10),
        "first": ("four-bar: their first derivatives", "-", 1e-12),
        "second": ("four-bar: their second derivatives", "-", 1e-11),
    }
    return [
        compared(told, unit, published[kind], found[kind], tolerance)
        for kind, (told, unit, tolerance) in what.items()
    ]


def slider_crank(degrees: str) -> kp.Model:
    """Crank 0.1 m, rod 0.3 m, the crank driven at 1 rad/s."""
    m = kp.Model("slider-crank")
    m.ground.points(O=(0, 0))
    m.bar("crank", mass=1, length=0.1, ends=("O", "B"))
    m.bar("rod", mass=1, length=0.3, ends=("B", "C"))
    m.body("slider", mass=1, inertia=0.01, points={"C": (0, 0)})
    m.revolute("O", "ground.O", "crank.O")
    m.revolute("B", "crank.B", "rod.B")
    m.revolute("C", "rod.C", "slider.C")
    m.translational("slide", "ground.O", "slider.C")
    m.coordinate_driver("motor", "crank.angle", value=f"{degrees}*deg + t")
    return m


def slider_crank_comparisons(table: dict[str, Any]) -> list[Comparison]:
    """The slider at all angles of the crank."""
    rows = []
    for degrees in table:
        guess = {"slider.x": 0.3, "rod.angle": 0.0}
        slider = kp.assemble(slider_crank(degrees), guess=guess)["slider"]
        rows.append([slider.x, slider.vx, slider.ax])
    found = np.array(rows)
    names = (("x", "position", 1e-14), ("x'", "first", 1e-14), ("x''", "second", 1e-13))
    return [
        compared(
            f"slider-crank: {told}{' derivative' if k else ' of the slider'}",
            "m",
            [row[key] for row in table.values()],
            found[:, k],
            tolerance,
        )
        for k, (key, told, tolerance) in enumerate(names)
    ]


def benchmark() -> Benchmark:
    """Both linkages."""
    data = reference("closed_forms")
    found = four_bar_comparisons(data["four_bar_position"]["fourbar_Norton_like_40_120_80_100"])
    found += slider_crank_comparisons(data["slider_crank_r0.1_l0.3_x_dx_ddx_by_crank_deg"])
    return Benchmark(
        "Closed forms of linkages",
        "closed_forms.json",
        data["note"],
        "assembly with rough guesses; rates and accelerations of the assembled state, its crank "
        "driven at 1 rad/s",
        tuple(found),
    )
