"""Messages of results: the advice that they give works, and their numbers show what they mean."""

import kempe as kp
import numpy as np
import pytest
from kempe.results.settling import settling


def swing() -> kp.Solution:
    m = kp.Model("rod", gravity=(0, -9.81))
    m.ground.points(O=(0, 0))
    m.bar("rod", mass=1, length=1, ends=("O", "P"))
    m.revolute("pin", "ground.O", "rod.O")
    return kp.dynamics(m, kp.assemble(m, set={"rod.angle": 0.5}), t_end=0.1)


def test_the_frame_that_local_means() -> None:
    sol = swing()
    with pytest.raises(kp.ModelError) as caught:
        sol["pin"].force(on="rod", frame="local")
    hint = str(caught.value.hint)
    assert "did you mean 'global'" not in hint
    meant = hint.split("'")[1]
    angle = sol["rod"].angle
    x, y = sol["pin"].force(on="rod", frame="global").T
    own = np.stack(
        [np.cos(angle) * x + np.sin(angle) * y, np.cos(angle) * y - np.sin(angle) * x], 1
    )
    np.testing.assert_allclose(sol["pin"].force(on="rod", frame=meant), own, atol=1e-12)


def open_four_bar(scale: float) -> str:
    m = kp.Model("open")
    m.ground.points(A=(0, 0), D=(3 * scale, 0))
    m.bar("crank", mass=1, length=scale, ends=("A", "B"))
    m.bar("coupler", mass=1, length=scale, ends=("B", "C"))
    m.bar("rocker", mass=1, length=0.9 * scale, ends=("D", "C"))
    for joint, i, j in [
        ("A", "ground", "crank"),
        ("B", "crank", "coupler"),
        ("C", "coupler", "rocker"),
        ("D", "ground", "rocker"),
    ]:
        m.revolute(joint, f"{i}.{joint}", f"{j}.{joint}")
    with pytest.raises(kp.AssemblyError) as caught:
        kp.assemble(m, set={"crank.angle": 0})
    return str(caught.value)


@pytest.mark.parametrize(
    ("scale", "gap"),
    [
        (30, "3.000 m"),
        (2, "0.200 m"),
        (1e-2, "1.000 mm"),
        (1e-5, "1.000 µm"),
        (1e-8, "1.000 nm"),
        (1e-14, "1.000e-15 m"),
    ],
)
def test_a_gap_is_printed_in_a_unit_that_shows_it(scale: float, gap: str) -> None:
    assert f"short by {gap} at joint C" in open_four_bar(scale)


def test_a_residual_of_nothing_is_not_negative() -> None:
    m = kp.Model("free")
    m.body("a", mass=1, inertia=1)
    report = kp.assemble(m).report
    assert report is not None
    assert "-0.0" not in str(report)
    assert all(np.copysign(1.0, row.residual) > 0 for row in report.iterations)


def test_a_coupler_that_translates_does_not_turn() -> None:
    m = kp.Model("parallelogram", gravity=(0, -9.81))
    m.ground.points(A=(0, 0), D=(2, 0))
    m.bar("crank", mass=1, length=1, ends=("A", "B"))
    m.bar("coupler", mass=1, length=2, ends=("B", "C"))
    m.bar("rocker", mass=1, length=1, ends=("D", "C"))
    for joint, i, j in [
        ("A", "ground", "crank"),
        ("B", "crank", "coupler"),
        ("C", "coupler", "rocker"),
        ("D", "ground", "rocker"),
    ]:
        m.revolute(joint, f"{i}.{joint}", f"{j}.{joint}")
    start = kp.assemble(m, set={"crank.angle": 1.0}, guess={"coupler.angle": 0, "rocker.angle": 1})
    sol = kp.dynamics(m, start, t_end=1, output_step=0.01)
    assert 0 < np.abs(sol["coupler"].angle).max() < 1e-8
    assert not settling(sol.t, sol["coupler"].angle).moves
    assert settling(sol.t, sol["crank"].angle).moves
    t = np.linspace(0, 1, 101)
    assert settling(t, 1e-6 * np.exp(-50 * t)).moves
