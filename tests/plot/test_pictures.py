"""A dozen small pictures of figures, frames and studies stay as they are to the eye.

``KEMPE_WRITE=1`` writes them anew. Look at them before you commit them.
"""

import os
import re
from collections.abc import Callable
from io import BytesIO
from pathlib import Path

import kempe as kp
import matplotlib as mpl
import numpy as np
import pytest
from kempe import plot
from kempe.draw.frame import Frame
from matplotlib.figure import Figure
from PIL import Image
from plot.conftest import ROOT

FOLDER = Path(__file__).parent / "pictures"
DOTS_PER_INCH = 60
#: Pictures are compared in squares of so many pixels. A line that moves by less changes little.
SQUARE = 4
#: Largest difference of a square, and of the mean over the picture, of 255.
WORST, MEAN = 30.0, 1.0

#: Solution and page; "frame 0" is the first frame.
PICTURES = {
    "four_bar_mechanism": ("flagship", "mechanism"),
    "four_bar_reactions": ("flagship", "reactions_D"),
    "four_bar_energy": ("flagship", "energy"),
    "four_bar_torque": ("flagship", "torque_spring"),
    "four_bar_frame": ("flagship", "frame 40"),
    "six_bar_angle": ("six_bar", "angle"),
    "six_bar_energy": ("six_bar", "energy"),
    "six_bar_motion": ("six_bar", "motion"),
    "slider_crank_slider": ("crank", "slider"),
    "slider_crank_frame": ("crank", "frame 0"),
    "planetary_frame": ("planetary", "frame 10"),
    "excavator_frame": ("excavator", "frame 100"),
    "squeezer_initial": ("squeezer", "initial"),
    "squeezer_reactions": ("squeezer", "reactions"),
}


def pinned(python: str = "3.11") -> str:
    """The version of Matplotlib with which the pictures are made."""
    text = (ROOT / "constraints.txt").read_text(encoding="utf-8")
    found = re.search(rf'^matplotlib==(\S+) ; python_version >= "{python}"', text, re.MULTILINE)
    assert found
    return found[1]


def grey(figure: Figure) -> Image.Image:
    file = BytesIO()
    with plot.style.applied():
        plot.style.lay_out(figure)
        figure.set_dpi(DOTS_PER_INCH)
        figure.savefig(file, format="png", dpi=DOTS_PER_INCH)
    return Image.open(file).convert("L")


def squares(picture: Image.Image) -> np.ndarray:
    """Mean brightness of squares of the picture."""
    values = np.asarray(picture, dtype=np.float64)
    high, wide = (size // SQUARE for size in values.shape)
    return (
        values[: high * SQUARE, : wide * SQUARE]
        .reshape(high, SQUARE, wide, SQUARE)
        .mean(axis=(1, 3))
    )


def unlike(one: Image.Image, other: Image.Image) -> str:
    """The visible difference of two pictures; empty if there is none."""
    if max(abs(a - b) for a, b in zip(one.size, other.size, strict=True)) > SQUARE:
        return f"size {one.size}, not {other.size}"
    a, b = squares(one), squares(other)
    high, wide = np.minimum(a.shape, b.shape)
    off = np.abs(a[:high, :wide] - b[:high, :wide])
    if off.max() <= WORST and off.mean() <= MEAN:
        return ""
    row, column = np.unravel_index(int(off.argmax()), off.shape)
    at = (SQUARE * int(column), SQUARE * int(row))
    return f"differs by {off.max():.0f} at pixel {at}, on average by {off.mean():.2f} of 255"


def drawn(solution: kp.Solution, name: str) -> Figure:
    if not name.startswith("frame "):
        return plot.select(plot.pages(solution), [name])[0].figure()
    frame = Frame(kp.scene(solution), DOTS_PER_INCH)
    frame.put(int(name.removeprefix("frame ")))
    return frame.figure


def check(name: str, picture: Image.Image) -> None:
    path = FOLDER / f"{name}.png"
    if os.environ.get("KEMPE_WRITE"):
        FOLDER.mkdir(exist_ok=True)
        picture.save(path, optimize=True)
    if mpl.__version__ != pinned():
        pytest.skip(f"pictures are made with Matplotlib {pinned()}, this is {mpl.__version__}")
    with Image.open(path) as expected:
        told = unlike(picture, expected.convert("L"))
    assert not told, f"{path.name} {told}; if this is intended, run with KEMPE_WRITE=1"


@pytest.mark.parametrize("name", PICTURES)
def test_a_picture_is_the_same_to_the_eye(name: str, request: pytest.FixtureRequest) -> None:
    fixture, page = PICTURES[name]
    check(name, grey(drawn(request.getfixturevalue(fixture), page)))


def change_nothing(figure: Figure) -> None:
    figure.axes[0].title.set_color("#111111")


def shift_a_curve(figure: Figure) -> None:
    line = figure.axes[0].lines[0]
    line.set_ydata(0.5 * np.asarray(line.get_ydata()))


def hide_an_axis(figure: Figure) -> None:
    figure.axes[0].yaxis.set_visible(False)


def drop_a_panel(figure: Figure) -> None:
    figure.axes[-1].remove()


@pytest.mark.parametrize(
    ("change", "seen"),
    [(change_nothing, False), (shift_a_curve, True), (hide_an_axis, True), (drop_a_panel, True)],
)
def test_the_eye_sees_changes(
    six_bar: kp.Solution, change: Callable[[Figure], None], seen: bool
) -> None:
    before, after = (drawn(six_bar, "angle") for _ in range(2))
    change(after)
    assert bool(unlike(grey(before), grey(after))) == seen
