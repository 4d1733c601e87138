"""The key figures: bands without false wedges, six reactions at most, paths and efforts."""

import kempe as kp
import numpy as np
import pytest
from kempe.plot import style
from kempe.plot.design_pages import free_points
from kempe.plot.envelope import draw_envelope, logarithmic
from matplotlib.collections import PolyCollection
from motions import results
from sizes import FULL


@pytest.mark.parametrize("scale", [1e-12, 1.0, 1e3])
def test_a_band_has_no_false_wedges_beside_zeros(scale: float) -> None:
    """Where the least value is 0, the band reaches the lower edge; beside it, it does not."""
    t = np.linspace(0.0, 1.0, 2000)
    y = scale * (1.0 + 0.5 * np.sin(400.0 * t))
    y[1000:1003] = 0.0
    with style.on(None) as axes:
        draw_envelope(axes, t, y, "y", style.line(0))
        logarithmic(axes, [y])
        axes.figure.canvas.draw()
        (band,) = [one for one in axes.collections if isinstance(one, PolyCollection)]
        (path,) = band.get_paths()
        assert np.isfinite(path.vertices).all() and (path.vertices[:, 1] > 0.0).all()
        far = np.abs(path.vertices[:, 0] - 0.5) > 0.01
        assert path.vertices[far, 1].min() == pytest.approx(0.5 * scale, rel=0.05)
        assert path.vertices[~far, 1].min() < 1e-200


def figure_of(example: str) -> tuple[kp.Solution, object]:
    sol = results(example)[0]
    assert isinstance(sol, kp.Solution)
    (page,) = [page for page in kp.plot.pages(sol) if page.name == "reactions"]
    return sol, page.figure()


def test_the_key_figure_has_the_six_largest_reactions() -> None:
    sol, figure = figure_of("jansen_leg")
    (axes,) = figure.axes  # type: ignore[attr-defined]
    peaks = {
        name: np.hypot(*sol.constraint(name).force(on=sol.constraint(name).info.j).T).max()
        for name in sol.compiled.joints
    }
    largest = sorted(peaks, key=lambda name: peaks[name], reverse=True)[:6]
    labels = [str(line.get_label()).partition(":")[0] for line in axes.get_lines()]
    assert sorted(labels) == sorted(largest)
    assert labels == [name for name in peaks if name in largest]
    assert axes.get_title(loc="left") == f"The 6 largest of {len(peaks)} reactions"
    assert axes.get_xscale() == "linear"  # the leg never rests
    colours = [line.get_color() for line in axes.get_lines()]
    assert len(set(colours)) == 6
    assert len(kp.plot.all_reactions(sol).get_lines()) == len(peaks)


def test_the_key_figure_is_compressed_after_the_action() -> None:
    _, figure = figure_of("four_bar")
    (axes,) = figure.axes  # type: ignore[attr-defined]
    assert axes.get_xscale() == "function"
    assert "compressed after 2.5 s" in axes.get_xlabel()


@pytest.mark.parametrize(
    ("example", "design"),
    [
        ("jansen_leg", ["path_foot.F", "effort_motor"]),
        ("crane_trolley", ["effort_drive"]),  # the trolley moves on a line
        *[("geneva_drive", ["effort_motor"])] * FULL,  # its run takes seconds
        ("four_bar", []),  # without a driver
    ],
)
def test_runs_with_drivers_have_paths_and_efforts(example: str, design: list[str]) -> None:
    sol = results(example)[0]
    assert isinstance(sol, kp.Solution)
    key = [page.about for page in kp.plot.pages(sol) if page.key]
    assert [name for name in key if not name.startswith("measure_")] == [
        *("mechanism", "residual", "energy", "reactions", "motion"),
        *design,
    ]


def test_paths_are_those_of_points_that_no_pin_on_ground_guides() -> None:
    """A pin and a slide on ground guide a body; a pin in a slot does not. Joints have no path."""
    m = kp.Model("three bodies")
    m.ground.points(O=(0, 0), S=(3, 0))
    for name in ("turning", "sliding", "riding"):
        m.body(name, mass=1, inertia=1, points={"A": (0, 0), "B": (1, 0), "C": (0, 0)})
    m.revolute("pin", "ground.O", "turning.A")
    m.translational("slide", "ground.S", "sliding.A", axes=(0, 0))
    m.pin_in_slot("slot", "ground.S", "riding.A", axis="90 deg")
    m.revolute("tip", "turning.B", "sliding.B")
    compiled = m.compile()
    assert free_points(compiled) == ["riding.B"]
    assert free_points(compiled, guided=False) == ["riding.B"]
    m.body("loose", mass=1, inertia=1, points={"D": (0.1, 0), "E": (0, 2)})
    tree = m.tree()
    tree["bodies"]["turning"]["points"] |= {"F": [0.5, 0.5]}
    compiled = kp.Model.from_tree(tree).compile()
    assert free_points(compiled) == ["turning.F", "riding.B", "loose.D", "loose.E"]
    assert free_points(compiled, guided=False) == ["riding.B", "loose.D", "loose.E"]


@pytest.mark.parametrize("mass", [1e-3, 1.0, 1e3])
def test_a_rounding_error_among_reactions_is_written_as_zero(mass: float) -> None:
    """Only the pin of the pendulum carries; the other one holds a ring without weight or motion."""
    m = kp.Model("pair", gravity=(0, -9.81))
    m.bar("rod", mass=mass, length=1.0, ends=("A", "B"))
    m.bar("other", mass=1e-14 * mass, length=1.0, ends=("A", "B"))
    for name, x in (("rod", 0.0), ("other", 3.0)):
        m.ground.points(**{f"O_{name}": (x, 0.0)})
        m.revolute(f"pin_{name}", f"ground.O_{name}", f"{name}.A")
    axes = kp.plot.all_reactions(kp.dynamics(m, kp.assemble(m), t_end=1.0))
    labels = [str(line.get_label()) for line in axes.get_lines()]
    assert labels[1] in ("pin_other: 0 N", "pin_other: 0 kN", "pin_other: 0 mN")
