"""Names of events in figures over time do not lie on each other."""

from itertools import combinations

import kempe as kp
import numpy as np
import pytest
from kempe.plot.marks import mark_events
from matplotlib.figure import Figure
from matplotlib.text import Annotation


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e3])
@pytest.mark.parametrize("apart", [1e-4, 0.01, 0.3])
def test_names_of_events_that_are_close_share_a_label(size: float, apart: float) -> None:
    m = kp.Model("ball", gravity=(0, -9.81))
    m.point_mass("ball", mass=size)
    start = kp.assemble(m, set={"ball.x": 0, "ball.y": 5 * size})
    events = {"first": f"ball.y < {size}", "second": f"ball.y < {size * (1 - apart)}"}
    sol = kp.dynamics(m, start, t_end=1.1 * size**0.5, events=events)
    figure = Figure()
    unit = 1e-3 if size < 0.01 else 1.0  # of the axis of short motions
    figure.subplots().plot(sol.t / unit, sol["ball.y"])
    mark_events(figure, sol)
    figure.draw_without_rendering()
    (axes,) = figure.axes
    labels = [child for child in axes.get_children() if isinstance(child, Annotation)]
    boxes = [label.get_window_extent() for label in labels]
    assert not any(a.overlaps(b) for a, b in combinations(boxes, 2))
    texts = [label.get_text() for label in labels]
    assert texts == (["first", "second"] if apart > 0.1 else ["first, second"])
    assert len([line for line in axes.lines if np.ptp(line.get_xdata()) == 0]) == 2


@pytest.mark.parametrize("t", [0.1, 0.5, 1.0])
@pytest.mark.parametrize("high", [False, True])
def test_a_name_covers_no_curve_and_stays_in_the_axes(t: float, high: bool) -> None:
    """A curve that is high at the event, or low, and has a peak to the right of it."""
    m = kp.Model("ball")
    m.point_mass("ball", mass=1.0)
    start = kp.assemble(m, set={"ball.vx": 1.0})
    sol = kp.dynamics(m, start, t_end=1.0, events={"passing": f"ball.x - {t - 1e-9}"})
    figure = Figure(figsize=(6.3, 3.0))
    axes = figure.subplots()
    x = np.linspace(0.0, 1.0, 1001)
    y = np.exp(-(((x - t - 0.03) / 0.02) ** 2)) if high else np.where(x > t, 1.0, 0.9)
    axes.plot(x, y)
    axes.set_xlim(0.0, 1.0)
    mark_events(figure, sol)
    figure.draw_without_rendering()
    (label,) = [child for child in axes.get_children() if isinstance(child, Annotation)]
    box, inside = label.get_window_extent(), axes.get_window_extent()
    assert inside.x0 <= box.x0 and box.x1 <= inside.x1 + 1.0 and inside.y0 <= box.y0
    assert not any(box.contains(*at) for at in axes.transData.transform(np.column_stack([x, y])))
