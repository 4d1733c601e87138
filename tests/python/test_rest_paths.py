"""Paths of rest positions: progress, and a mechanism that is held."""

import kempe as kp
import numpy as np
import pytest
from kempe import plot

G = 9.81


def hanging(n: int) -> kp.Model:
    """A chain of n bars that is fixed at its first end, with a force at its last."""
    m = kp.Model("chain", gravity=(0, -G), parameters={"load": 0.0})
    m.ground.points(P=(0, 0))
    before = "ground"
    for k in range(n):
        m.bar(f"b{k}", mass=1, length=1, ends=("O", "P"))
        m.revolute(f"j{k}", f"{before}.P", f"b{k}.O")
        before = f"b{k}"
    m.force("push", f"{before}.P", force=["load", 0])
    return m


def test_progress_is_reported_and_may_stop_the_work() -> None:
    m = hanging(40)
    start = kp.assemble(m)
    found = []

    def stop(value: float) -> None:
        found.append(value)
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        kp.equilibrium(m, start, over="load", range=(-1000, 1000), progress=stop)
    assert len(found) == 1
    assert np.isfinite(found[0])


def test_a_path_of_a_mechanism_that_is_held_has_no_page_of_coordinates() -> None:
    m = hanging(1)
    start = kp.assemble(m, set={"b0.angle": np.pi / 2})
    found = kp.equilibrium(m, start, hold=["b0.angle"], over="load", range=(-5, 5))
    assert found.coordinates == ()
    assert [page.name for page in plot.pages(found)] == ["efforts", "rest"]
    # the force pushes the upper end of the bar clockwise; the holder turns it back
    assert np.allclose(found.effort["b0.angle"], found.values, atol=1e-12)
