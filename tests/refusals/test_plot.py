"""Every refusal of ``kp.plot`` is met, and says what it said when a person last read it."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import kempe as kp
import pytest
from kempe import plot
from refusals.test_design import linkage, moved
from refusals.test_sweeps import pendulum, swept
from refusals.told import check, statements

HERE = Path(__file__).parent


class Empty(kp.synthesis.Found):
    """A synthesis without candidates."""

    def __len__(self) -> int:
        return 0


def of(draw: Callable[..., object], *given: Any) -> Callable[[], object]:
    """A figure of something else."""
    return lambda: draw(3, *given)


def lines(variables: Any) -> Callable[[], object]:
    return lambda: plot.sweep_lines(swept(variables)(), "O.force.max")  # type: ignore[arg-type]


def slopes() -> kp.Solution:
    return kp.dynamics(pendulum().model, pendulum().start(), t_end=0.1, slopes=["k"])


MANY = [f"rod.{name}.max" for name in ("x", "y", "vx", "vy", "ax", "ay", "angle", "omega", "alpha")]
CALLS: dict[str, Callable[[], object]] = {
    "positions": of(plot.positions, "rod"),
    "quantity of positions": lambda: plot.positions(moved(), "rod", "speed"),
    "quantity of velocities": lambda: plot.velocities(moved(), "rod", "x"),
    "cam": of(plot.cam),
    "comparison": of(plot.comparison),
    "quantity of a comparison": lambda: plot.comparison(
        kp.compare(moved(), moved(), ["rod.x"]), ["rod.size"]
    ),
    "energy": of(plot.energy),
    "energy of a model": lambda: plot.energy_balance(linkage()),  # type: ignore[arg-type]
    "fit": of(plot.fit),
    "gradient": of(plot.gradient),
    "measures of a gradient": lambda: plot.gradient(kp.gradient(pendulum(), MANY, ["k"]), []),
    "measure": of(plot.measure, "k"),
    "optimization": of(plot.optimization),
    "format": lambda: plot.save([], "figures", "jpg"),
    "page": lambda: plot.save([3], "figures", "png"),  # type: ignore[list-item]
    "name of a figure": lambda: plot.select(plot.pages(moved()), ["energi"]),
    "pages": of(plot.pages),
    "reactions": of(plot.reactions, "A"),
    "quantity of reactions": lambda: plot.reactions(moved(), "A", quantity="forces"),
    "all reactions": of(plot.all_reactions),
    "residual": of(plot.residual),
    "slopes": of(plot.slopes, "rod.x"),
    "slopes of a run without": lambda: plot.slopes(moved(), "rod.x"),
    "variables of slopes": lambda: plot.slopes(slopes(), "rod.x", []),
    "columns of a matrix": lambda: plot.sweep_scatter(swept()(), []),  # type: ignore[arg-type]
    "lines of three": lines({"k": [50.0], "u": [1.0], "length": [1.0]}),
    "lines of many": lines({"k": [50.0], "u": [float(k) for k in range(11)]}),
    "map of one": lambda: plot.sweep_map(swept()(), "O.force.max"),  # type: ignore[arg-type]
    "synthesis": of(plot.synthesis),
    "synthesis of nothing": lambda: plot.synthesis(Empty.__new__(Empty)),
    "burmester": of(plot.burmester),
    "torques": of(plot.torques, "T"),
}


def test_every_refusal_says_what_is_wrong_and_what_to_do(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    check(HERE / "plot.txt", CALLS, statements("plot"))
    assert not list(tmp_path.iterdir())
