"""Impacts in runs: velocities and impulses of a whole mechanism, solutions and figures."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import kempe as kp
import numpy as np
import pytest
from kempe import plot
from kempe.base.arrays import Floats

TIGHT = kp.DOP853(rtol=1e-11, atol=1e-13)
LENGTHS = {"crank": 0.4, "coupler": 1.1, "rocker": 0.8}
MASSES = {"crank": 1.5, "coupler": 2.5, "rocker": 0.7}
PINS = {"A": ("ground", "crank"), "B": ("crank", "coupler"), "C": ("coupler", "rocker")}


def four_bar(restitution: float = 0.4) -> kp.Solution:
    """A four-bar linkage under gravity whose rocker hits a stop."""
    m = kp.Model("four-bar linkage with a stop", gravity=(0, -9.81))
    m.ground.points(A=(0, 0), D=(1.0, 0))
    for name, length in LENGTHS.items():
        m.bar(name, mass=MASSES[name], length=length, ends=("P", "Q"))
    m.revolute("A", "ground.A", "crank.P")
    m.revolute("B", "crank.Q", "coupler.P")
    m.revolute("C", "coupler.Q", "rocker.Q")
    m.revolute("D", "ground.D", "rocker.P")
    m.stop("wall", "rocker.angle", upper="118 deg", restitution=restitution)
    start = kp.assemble(
        m,
        set={"crank.angle": "110 deg"},
        guess={"rocker.angle": "60 deg", "coupler.angle": "20 deg"},
    )
    return kp.dynamics(m, start, t_end=1.5, output_step=0.01, method=TIGHT)


@pytest.fixture(scope="module")
def solution() -> kp.Solution:
    return four_bar()


def inertias() -> Floats:
    """The diagonal of the mass matrix: uniform bars with frames at their centres."""
    rows = [(m, m, m * LENGTHS[name] ** 2 / 12.0) for name, m in MASSES.items()]
    return np.array(rows).ravel()


def jacobian(q: Floats) -> Floats:
    """Φ_q of the pins A, B, C and D, written by hand; the angle of the rocker is last."""
    rows = np.zeros((9, 9))
    ends = [("crank", -1, 0, 1), ("crank", 1, 1, -1), ("coupler", -1, 1, 1)]
    ends += [("coupler", 1, 2, -1), ("rocker", 1, 2, 1), ("rocker", -1, 3, 1)]
    for body, end, pin, sign in ends:
        k = list(LENGTHS).index(body)
        angle, half = q[3 * k + 2], 0.5 * end * LENGTHS[body]
        rows[2 * pin : 2 * pin + 2, 3 * k : 3 * k + 2] = sign * np.eye(2)
        rows[2 * pin : 2 * pin + 2, 3 * k + 2] = (
            sign * half * np.array([-np.sin(angle), np.cos(angle)])
        )
    rows[8, 8] = 1.0
    return rows


def test_velocities_and_impulses_of_a_four_bar(solution: kp.Solution) -> None:
    """[M Jᵀ; J 0] (Δv, P) = (0, rates) with J written by hand; the impulse on body j is -P."""
    event = solution.events["wall.hit"]
    assert len(event.t) >= 10
    for k, before in enumerate(event.states):
        if abs(before["rocker.omega"]) < 1e-5:
            continue  # from here on the rocker comes to rest
        rows, mass = jacobian(before.q), inertias()
        right = np.zeros(18)
        right[-1] = -1.4 * before["rocker.omega"]
        matrix = np.block([[np.diag(mass), rows.T], [rows, np.zeros((9, 9))]])
        jump, impulses = np.split(np.linalg.solve(matrix, right), 2)
        after = solution(event.t[k])
        np.testing.assert_allclose(after.v, before.v + jump, rtol=0, atol=1e-10)
        scale = np.abs(impulses).max()
        for pin, (name, (i, j)) in enumerate({**PINS, "D": ("ground", "rocker")}.items()):
            on_j = -impulses[2 * pin : 2 * pin + 2]
            np.testing.assert_allclose(event.impulse(name, on=j)[k], on_j, atol=1e-10 * scale)
            np.testing.assert_allclose(event.impulse(name, on=i)[k], -on_j, atol=1e-10 * scale)


def test_momentum_of_each_body(solution: kp.Solution) -> None:
    """The impulses on the coupler change its momentum."""
    event = solution.events["wall.hit"]
    sums = event.impulse("B", on="coupler") + event.impulse("C", on="coupler")
    for k, before in enumerate(event.states):
        if abs(before["rocker.omega"]) < 1e-5:
            continue
        after = solution(event.t[k])
        change = [
            after["coupler.vx"] - before["coupler.vx"],
            after["coupler.vy"] - before["coupler.vy"],
        ]
        np.testing.assert_allclose(sums[k], MASSES["coupler"] * np.array(change), atol=1e-10)


def test_energy_is_lost_at_impacts_only(solution: kp.Solution) -> None:
    """The dissipated energy is the sum of the kinetic energies that the impacts take."""
    lost = 0.0
    event = solution.events["wall.hit"]
    for k, before in enumerate(event.states):
        after, mass = solution(event.t[k]), inertias()
        lost += 0.5 * mass @ (before.v**2 - after.v**2)
    assert lost > 0.1
    assert solution.energy.dissipated[-1] == pytest.approx(lost, rel=1e-10)
    np.testing.assert_allclose(solution.energy.balance, 0.0, atol=1e-9)


def test_two_states_at_one_time(solution: kp.Solution, tmp_path: Path) -> None:
    t = solution.events["wall.hit"].t[0]
    rows = np.flatnonzero(solution.t == t)
    assert len(rows) == 2
    rate = solution["rocker.omega"][rows]
    assert rate[1] == pytest.approx(-0.4 * rate[0], rel=1e-10)
    assert solution(t)["rocker.omega"] == pytest.approx(rate[1], rel=1e-12)
    path = tmp_path / "solution.kempe"
    solution.save(path)
    kept = kp.load_solution(path)
    np.testing.assert_array_equal(kept.t, solution.t)
    event = kept.events["wall.hit"]
    np.testing.assert_array_equal(
        event.impulse("C", on="rocker"), solution.events["wall.hit"].impulse("C", on="rocker")
    )


def test_figures_do_not_join_a_reaction_across_an_impact(solution: kp.Solution) -> None:
    figure: Any = plot.reactions(solution, "C")
    count = np.sum(np.diff(solution.t) == 0.0)
    assert count == len(solution.events["wall.hit"].t)
    lines = [one for one in figure.lines if len(one.get_xdata()) > len(solution.t) // 2]
    assert lines
    for line in lines:
        assert np.isnan(np.asarray(line.get_ydata(), dtype=float)).sum() == count


def test_a_stop_on_a_driven_coordinate_is_refused() -> None:
    m = kp.Model("driven")
    m.ground.points(O=(0, 0))
    m.bar("crank", mass=1, length=1, ends=("P", "Q"))
    m.revolute("O", "ground.O", "crank.P")
    m.coordinate_driver("motor", "crank.angle", value="t")
    m.stop("wall", "crank.angle", upper=1, restitution=0.5)
    start = kp.assemble(m)
    with pytest.raises(
        kp.AssemblyError, match="wall acts on a coordinate that motor holds"
    ) as caught:
        kp.dynamics(m, start, t_end=2)
    assert "release the driver" in caught.value.hint
    # the remedies
    sol = kp.dynamics(m, start, t_end=2, release=["motor"])
    assert sol["crank.angle"].max() <= 1 + 1e-9


def test_a_start_beyond_a_stop_is_refused() -> None:
    m = kp.Model("beyond", gravity=(0, -9.81))
    m.point_mass("ball", mass=1)
    m.stop("floor", "ball.y", lower=0, restitution=0.5)
    start = kp.assemble(m, set={"ball.x": 0, "ball.y": -0.2})
    with pytest.raises(kp.AssemblyError, match=r"beyond floor .* gap is -2\.000e-1"):
        kp.dynamics(m, start, t_end=1)


def test_an_equilibrium_beyond_a_stop_with_restitution_is_refused() -> None:
    m = kp.Model("pendulum", gravity=(0, -9.81))
    m.ground.points(O=(0, 0))
    m.bar("rod", mass=1, length=1, ends=("P", "Q"))
    m.revolute("O", "ground.O", "rod.P")
    m.stop("wall", "rod.angle", lower="-60 deg", restitution=0.5)
    start = kp.assemble(m, set={"rod.angle": "-30 deg"})
    with pytest.raises(kp.ModelError, match="rest beyond it"):
        kp.equilibrium(m, start)
