"""The key figures: bands without false wedges, and at most six reactions that can be read."""

import kempe as kp
import numpy as np
import pytest
from house.places import ROOT
from kempe.plot import style
from kempe.plot.envelope import draw_envelope, logarithmic
from matplotlib.collections import PolyCollection


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
    sol = kp.load(ROOT / "examples" / f"{example}.toml").run()[0]
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
