"""The figures of the pages of elements: a small drawing of one mechanism with each element.

Run ``.venv/bin/python tools/element_figures.py``; it writes ``docs/images/elements/NAME.png``. The
mechanism is the first example of the page ``docs/elements/NAME.md``, or one of ``MODELS`` below
where that of the page shows too little. Names on the command line choose some figures.
"""

from __future__ import annotations

import contextlib
import io
import re
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import kempe as kp
import numpy as np
from kempe.draw.display import display
from kempe.draw.painter import Painting
from kempe.draw.placing import view_around
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from PIL import Image

DOCS = Path(__file__).parents[1] / "docs"
FOLDER = DOCS / "images" / "elements"
#: Inches, dots for each inch, and colours of a figure.
SIZE, DOTS_PER_INCH, COLOURS = (3.6, 2.0), 160, 48
#: Room around a mechanism beside that of frames, as a share of its size.
ROOM = 0.08


def wheel(m: kp.Model, name: str, at: str, radius: float, **fields: Any) -> None:
    """A disc that is seen, on a pin."""
    rim = {"rim": {"circle": (0, 0, radius)}}
    m.body(name, mass=1, inertia=1, points={at: (0, 0)}, curves=rim, **fields)
    m.revolute(at, f"ground.{at}", f"{name}.{at}")


def on_a_wheel(add: Callable[[kp.Model], Any]) -> kp.State:
    """A wheel with a force element."""
    m = kp.Model("wheel")
    m.ground.points(O=(0, 0))
    wheel(m, "wheel", "O", 0.25)
    add(m)
    return kp.assemble(m, set={"wheel.angle": 0.5})


def sleeve() -> kp.State:
    """A beam on two bushings."""
    m = kp.Model("mount")
    m.ground.points(O=(0, 0), Q=(0.6, 0))
    m.bar("beam", mass=2, length=0.6, ends=("P", "R"))
    m.bushing("left", "ground.O", "beam.P", stiffness=(8, 18, 8))
    m.bushing("right", "ground.Q", "beam.R", stiffness=(8, 18, 8))
    return kp.assemble(m, set={"beam.x": 0.302, "beam.y": 0.004, "beam.angle": "1 deg"})


def wire() -> kp.State:
    """A bead on a wire that is drawn as a curve of ground."""
    m = kp.Model("bead on a parabola", gravity=(0, -9.81))
    m.ground.curves(parabola={"x": "u", "y": "u^2/2", "range": (-1.5, 1.5)})
    m.point_mass("bead", mass=2)
    m.constraint("wire", residual=["bead.y - bead.x^2/2"], units=["m"])
    return kp.assemble(m, set={"bead.x": 1})


def coupled() -> kp.State:
    """Two wheels that are seen."""
    m = kp.Model("two coupled wheels")
    m.ground.points(O=(0, 0), P=(1, 0))
    wheel(m, "first", "O", 0.2)
    wheel(m, "second", "P", 0.3)
    m.coupling("ratio", terms={"O.angle": 1, "P.angle": 2})
    m.torque("motor", "first", torque=3)
    return kp.assemble(m)


def rack() -> kp.State:
    """A rack that moves to the left."""
    m = kp.Model("rack and pinion")
    m.ground.points(O=(0, 0), G=(0.45, 0), P=(0, 0.1))
    m.body("rack", mass=3, inertia=0.1, points={"S": (0, 0), "E": (0.45, 0)})
    m.body("pinion", mass=1, inertia=0.02, points={"P": (0, 0)})
    m.translational("guide", "ground.G", "rack.E")
    m.revolute("P", "ground.P", "pinion.P")
    m.rack("R", "rack.S", "pinion.P", radius=0.1)
    return kp.assemble(m, set={"rack.x": 0, "rack.vx": -0.4})


def bush() -> kp.State:
    """A pendulum whose pin and bush are drawn as curves."""
    m = kp.Model("pendulum")
    m.ground.points(O=(0, 0))
    m.ground.curves(bush={"circle": (0, 0, 0.1)})
    pin = {"pin": {"circle": (0, 0, 0.06)}}
    m.body("rod", mass=1, inertia=0.02, points={"P": (0, 0), "E": (0.5, 0)}, curves=pin)
    m.clearance("B", "ground.O", "rod.P", radius=0.1, clearance=0.04, restitution=0.4)
    return kp.assemble(m, set={"rod.x": 0.02, "rod.y": -0.0346, "rod.angle": "-35 deg"})


MODELS: dict[str, Callable[[], kp.State]] = {
    "bushing": sleeve,
    "clearance": bush,
    "clutch": lambda: on_a_wheel(lambda m: m.clutch("brake", "ground", "wheel", capacity=2)),
    "constraint": wire,
    "coupling": coupled,
    "motor": lambda: on_a_wheel(lambda m: m.motor("motor", "wheel", stall_torque=2, free_speed=10)),
    "rack": rack,
    "torque": lambda: on_a_wheel(lambda m: m.torque("motor", "wheel", torque=2)),
    "torsion_spring": lambda: on_a_wheel(
        lambda m: m.torsion_spring("spring", "ground", "wheel", stiffness=8, damping=1)
    ),
}


def of_the_page(name: str) -> kp.State:
    """The start of the first example of a page."""
    text = (DOCS / "elements" / f"{name}.md").read_text("utf-8")
    code = re.search(r"^```python\n(.*?)^```", text, re.S | re.M)
    assert code, f"{name}.md has no example"
    names: dict[str, Any] = {}
    with contextlib.redirect_stdout(io.StringIO()):
        exec(compile(code[1], f"{name}.md", "exec"), names)
    return names["start"] if "start" in names else names["sol"].initial


def elements() -> list[str]:
    """The elements that have a page."""
    pages = sorted((DOCS / "elements").glob("*.md"))
    return [page.stem for page in pages if page.stem != "README"]


def figure(name: str) -> Figure:
    """The mechanism of an element at its start, with rails as long as half a second needs."""
    state = MODELS[name]() if name in MODELS else of_the_page(name)
    scene = kp.scene(kp.dynamics(state.model, state, t_end=0.5, output_step=0.01), frames=30)
    first = {key: rows[:1] for key, rows in scene["frames"].items()}
    low, high = np.array(scene["bounds"]).reshape(2, 2)
    room = ROOM * float((high - low).max())
    view = view_around([*(low - room), *(high + room)], (72 * SIZE[0], 72 * SIZE[1]))
    items = display({**scene, "frames": first}, view)
    left, bottom = view.low
    right, top = view.plane(view.size)
    made = Figure(figsize=SIZE, dpi=DOTS_PER_INCH)
    FigureCanvasAgg(made)
    axes = made.add_axes((0, 0, 1, 1))
    axes.set_axis_off()
    axes.set(xlim=(left, right), ylim=(bottom, top))
    Painting(axes, items, np.array([[0.0] * 3, *scene["frames"]["poses"][0]]))
    return made


def picture(name: str) -> Image.Image:
    """The figure with few colours."""
    file = io.BytesIO()
    figure(name).savefig(file, format="png", dpi=DOTS_PER_INCH)
    return Image.open(file).convert("RGB").quantize(COLOURS)


def main() -> None:
    """Write the figures."""
    FOLDER.mkdir(exist_ok=True)
    for name in sys.argv[1:] or elements():
        picture(name).save(FOLDER / f"{name}.png", optimize=True)


if __name__ == "__main__":
    main()
