"""Which texts of a figure lie on each other or leave the paper."""

from itertools import combinations

from kempe.plot import style
from matplotlib.axis import Axis
from matplotlib.figure import Figure
from matplotlib.text import Text
from matplotlib.transforms import Bbox

#: Boxes of texts have some air; touching by less than this, in pixels, does not count.
SLACK = 1.0


def boxes(figure: Figure) -> list[tuple[str, Bbox]]:
    """Every text that is seen, with the place where it is drawn."""
    with style.applied():
        figure.draw_without_rendering()
        hidden = unseen(figure)
        return [
            (text.get_text(), Text.get_window_extent(text))
            for text in figure.findobj(Text)
            if text.get_visible() and text.get_text().strip() and text not in hidden
        ]


def unseen(figure: Figure) -> set[Text]:
    """Numbers of ticks outside of the limits, which are kept but not drawn."""
    found = set()
    for axis in figure.findobj(Axis):
        low, high = sorted(axis.get_view_interval())
        slack = 1e-9 * (high - low)
        for tick in axis.get_major_ticks():
            if not low - slack <= tick.get_loc() <= high + slack:
                found |= {tick.label1, tick.label2}
    return found


def faults(figure: Figure) -> tuple[list[tuple[str, str]], list[str]]:
    """Texts that lie on each other, and texts that leave the paper, from one drawing."""
    found = boxes(figure)
    return overlaps(figure, found), cut_off(figure, found)


def overlaps(figure: Figure, found: list[tuple[str, Bbox]] | None = None) -> list[tuple[str, str]]:
    return [
        (one, other)
        for (one, a), (other, b) in combinations(found or boxes(figure), 2)
        if min(a.x1, b.x1) - max(a.x0, b.x0) > SLACK and min(a.y1, b.y1) - max(a.y0, b.y0) > SLACK
    ]


def cut_off(figure: Figure, found: list[tuple[str, Bbox]] | None = None) -> list[str]:
    """Texts that leave the paper."""
    width, height = figure.bbox.size
    return [
        text
        for text, box in found or boxes(figure)
        if box.x0 < -SLACK or box.y0 < -SLACK or box.x1 > width + SLACK or box.y1 > height + SLACK
    ]
