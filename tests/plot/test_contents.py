"""What figures contain stays as it is: texts, curves, limits, marks and looks.

``KEMPE_WRITE=1`` writes the contents anew. Look at the changes before you commit them.
"""

import json
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import kempe as kp
import matplotlib as mpl
import pytest
from kempe import plot
from kempe.case import parsed
from kempe.plot.result_pages import result_pages
from matplotlib import pyplot
from matplotlib.figure import Figure
from plot.conftest import ROOT
from plot.contents import contents, differences
from plot.other_figures import OTHERS
from plot.test_design_figures import FIGURES, figure_of, rocker, turn
from plot.test_pictures import pinned
from sweeps.test_figures import cloud, grid

__all__ = ["cloud", "grid", "rocker", "turn"]

FILE = Path(__file__).with_name("contents.json")
#: Their curves are rounding errors.
NOISE = ("residual", "energy_balance", "energy", "reactions")


def of_case(name: str, analysis: dict[str, Any]) -> kp.Case:
    tree = kp.load(ROOT / "examples" / f"{name}.toml").tree()
    text = json.dumps({**tree, "analyses": {"one": analysis}})
    return parsed(text, "json", f"{name}.json", {})


def of_result(name: str, analysis: dict[str, Any]) -> Callable[[Any], list[Figure]]:
    return lambda _: [p.figure() for p in result_pages(of_case(name, analysis).run()[0])]


def of_pages(fixture: str) -> Callable[[Any], list[Figure]]:
    def draw(get: Any) -> list[Figure]:
        pages = [p for p in plot.pages(get(fixture)) if not p.name.startswith(NOISE)]
        return [page.figure() for page in pages[:5]]

    return draw


def of_axes(fixture: str, draw: Any) -> Callable[[Any], list[Figure]]:
    return lambda get: [figure_of(draw(get(fixture)))]


DESIGN = ("effort", "transmission", "velocity_polygon", "acceleration_polygon")
DESIGN += ("instant_centres", "duty", "pin_load", "shaking_force")


def of_design(get: Any) -> list[Figure]:
    """One page of each kind."""
    found = {}
    for page in plot.pages(get("turn")):
        kind = next((kind for kind in DESIGN if page.name.startswith(kind)), "")
        found.setdefault(kind, page)
    assert set(DESIGN) <= set(found)
    return [found[kind].figure() for kind in DESIGN]


def of_slide(_: Any) -> list[Figure]:
    """A force drives a slide."""
    m = kp.Model("lift", gravity=(0, -9.81))
    m.ground.points(O=(0, 0))
    m.body("cage", mass=100, inertia=1, points={"P": (0, 0)})
    m.translational("guide", "ground.O", "cage.P", axes=("90 deg", 0))
    m.coordinate_driver("winch", "guide.displacement", value="step5(t, 0, 0, 2, 3)")
    sol = kp.dynamics(m, kp.assemble(m), t_end=2, output_step=0.02)
    return [figure_of(draw(sol, "winch")) for draw in (plot.effort, plot.torque_speed)]


def of_cams(_: Any) -> list[Figure]:
    """A roller with an offset, undercut flat faces, and conjugate cams of a rocker."""
    lift = [("rise", "60 deg", 0.02, "cycloidal"), ("return", "80 deg", "harmonic")]
    pair = [("rise", "100 deg", "15 deg", "modified_trapezoid"), ("return", "120 deg", "poly345")]
    rest = [("dwell", "220 deg")], [("dwell", "140 deg")]
    rocker = {"arm": 0.07, "pivot": (0.08, 0.01), "closure": "conjugate"}
    made = kp.design.cam
    return [
        plot.cam(made("roller", lift + rest[0], base_radius=0.06, roller_radius=0.01, offset=0.01)),
        plot.cam(made("flat", lift + rest[0], base_radius=0.03, direction="cw")),
        plot.cam(made("roller", pair + rest[1], base_radius=0.03, roller_radius=0.012, **rocker)),
    ]


SWEEPS: dict[str, Callable[[Any], list[Figure]]] = {
    "lines": of_axes("grid", lambda of: plot.sweep_lines(of, "pin.max")),
    "map": of_axes("grid", lambda of: plot.sweep_map(of, "pin.max")),
    "map of points": of_axes("cloud", lambda of: plot.sweep_map(of, "pin.max")),
    "histogram": of_axes("cloud", lambda of: plot.sweep_histogram(of, "pin.max")),
    "contributions": of_axes("cloud", lambda of: plot.sweep_contributions(of, "pin.max")),
    "scatter": lambda get: [plot.sweep_scatter(get("cloud"))],
}
RESULTS = {
    "path": of_result("four_bar", {"type": "equilibrium", "over": "L2", "range": [25, 27]}),
    "rest": of_result("four_bar", {"type": "equilibrium"}),
    "modes": of_result("double_pendulum", {"type": "modes"}),
    "limits": of_result("four_bar", {"type": "limits", "over": "crank.angle"}),
    "configurations": of_result("four_bar", {"type": "configurations"}),
}
DRAWN: dict[str, Callable[[Any], list[Figure]]] = {
    **{name: of_axes(of, draw) for name, (of, draw) in FIGURES.items()},
    **SWEEPS,
    **RESULTS,
    "pages of a design": of_design,
    "drive of a slide": of_slide,
    "cams": of_cams,
    **OTHERS,
    "pages of the flagship": of_pages("flagship"),
    "pages of the slider-crank": of_pages("crank"),
}


@pytest.mark.parametrize("name", DRAWN)
def test_the_contents_of_a_figure_are_the_same(name: str, request: pytest.FixtureRequest) -> None:
    found = [contents(figure) for figure in DRAWN[name](request.getfixturevalue)]
    pyplot.close("all")
    kept = json.loads(FILE.read_text("utf-8")) if FILE.exists() else {}
    if os.environ.get("KEMPE_WRITE"):
        kept[name] = found
        lines = (f"{json.dumps(key)}: {json.dumps(kept[key])}" for key in DRAWN if key in kept)
        FILE.write_text("{\n" + ",\n".join(lines) + "\n}\n", "utf-8")
    if mpl.__version__ != pinned():
        pytest.skip(f"contents are those of Matplotlib {pinned()}, this is {mpl.__version__}")
    told = differences(json.loads(json.dumps(found)), kept[name])
    assert not told, "\n".join(["if this is intended, run with KEMPE_WRITE=1", *told[:20]])


def test_differences_are_seen() -> None:
    one = {"a": [1.0, 2.0], "b": ["x", [3.0]], "c": None}
    assert differences(one, one) == []
    assert differences({**one, "a": [1.0, 2.001]}, one) == []
    assert differences({**one, "a": [1.0, 2.1]}, one) == [".a: [1.0, 2.1], not [1.0, 2.0]"]
    assert differences({**one, "b": ["y", [3.0]]}, one) == [".b[0]: 'y', not 'x'"]
    assert differences({**one, "d": 1}, one) == [".d: 1, not None"]
