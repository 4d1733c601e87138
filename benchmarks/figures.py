"""Figures of error against CPU time, and of cost against N."""

from __future__ import annotations

from pathlib import Path

import matplotlib as mpl
import matplotlib.pyplot as plt
from matplotlib.axes import Axes
from matplotlib.ticker import NullFormatter
from peers import kempe_itself
from record import Record

mpl.use("Agg")

#: Colours for colour-blind readers (Okabe and Ito), and markers for print.
STYLE = {
    "kempe": ("#000000", "o"),
    "mujoco": ("#0072B2", "s"),
    "exudyn": ("#D55E00", "^"),
    "casadi": ("#009E73", "D"),
    "numba": ("#CC79A7", "v"),
    "scipy": ("#E69F00", "P"),
}
TITLES = {
    "mujoco": "MuJoCo",
    "exudyn": "Exudyn",
    "casadi": "CasADi",
    "numba": "Numba",
    "scipy": "SciPy",
}
#: Larger errors are not plotted.
WORST = 1.0


def front(records: list[Record]) -> list[Record]:
    """The records that no other record beats in both time and error, ordered by time."""
    found: list[Record] = []
    for r in sorted(records, key=lambda r: (r.seconds, r.error)):
        if not found or r.error < found[-1].error:
            found.append(r)
    return found


def line(axes: Axes, records: list[Record], tool: str, name: str, dash: str) -> None:
    """One curve with its name at its end."""
    colour, marker = STYLE[tool]
    x, y = [1e3 * r.seconds for r in records], [r.error for r in records]
    looks = {"marker": marker, "markersize": 5, "linewidth": 1.4}
    filled = colour if dash == "-" else "white"
    axes.plot(x, y, dash, color=colour, markerfacecolor=filled, label=name, **looks)


def work_precision(records: list[Record], title: str, error_of: str, path: Path) -> None:
    """One curve for each curve of kempe, and the best of all settings for each peer."""
    figure, axes = plt.subplots(figsize=(8.6, 4.8), layout="constrained")
    what, _, unit = error_of.rpartition(", ")
    good = [r for r in records if r.good and 0 < r.error <= WORST]
    mine = [r for r in good if r.tool == "kempe"]
    for curve, dash in ((kempe_itself.BAUMGARTE, "--"), (kempe_itself.PROJECTION, "-")):
        own = sorted((r for r in mine if r.curve == curve), key=lambda r: r.tolerance)
        if own:
            line(axes, own, "kempe", curve, dash)
    for tool, name in TITLES.items():
        best = front([r for r in good if r.tool == tool])
        if best:
            line(axes, best, tool, name, "-")
    for r in mine:
        if r.curve == kempe_itself.DEFAULT:
            axes.plot(
                1e3 * r.seconds,
                r.error,
                "*",
                color="#F0E442",
                markeredgecolor="black",
                markersize=13,
                label="kempe, defaults",
                zorder=5,
            )
    axes.set(
        xscale="log",
        yscale="log",
        xlabel="CPU time / ms",
        ylabel=f"error of {what} / {unit}",
        title=title,
    )
    axes.grid(which="major", color="0.88")
    figure.legend(fontsize=8, loc="outside right upper")
    save(figure, path)


def cost(records: list[Record], path: Path, accepted: float) -> None:
    """CPU seconds per simulated second against N, at the cheapest accepted setting."""
    figure, axes = plt.subplots(figsize=(8.6, 4.4), layout="constrained")
    for tool, (colour, marker) in STYLE.items():
        points = []
        for n in sorted({windows(r) for r in records}):
            mine = [r for r in records if windows(r) == n and r.tool == tool and r.good]
            enough = [r for r in mine if r.error <= accepted]
            if enough:
                points.append((n, min(r.seconds for r in enough)))
        if points:
            name = TITLES.get(tool, "kempe")
            axes.plot(*zip(*points, strict=True), color=colour, marker=marker, label=name)
    axes.set(
        xscale="log",
        yscale="log",
        xlabel="windows N / 1",
        ylabel="CPU time for 1 s of motion / s",
        title=f"N-four-bar, cheapest setting with an error of B0 below {accepted:g} m",
    )
    axes.xaxis.set_minor_formatter(NullFormatter())
    axes.grid(which="major", color="0.88")
    figure.legend(fontsize=8, loc="outside right upper")
    save(figure, path)


def windows(record: Record) -> int:
    """N of a record of the N-four-bar."""
    return int(record.problem.rsplit("_", 1)[1])


def save(figure: plt.Figure, path: Path) -> None:
    """Write the figure without a date, so that equal numbers give equal files."""
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, dpi=130, metadata={"Software": None})
    plt.close(figure)
