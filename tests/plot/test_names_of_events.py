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
