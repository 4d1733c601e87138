"""Equal cranks on one rod: redundant constraints, and change points that the motion decides."""

import kempe as kp
import numpy as np
import pytest
from singular.equal_cranks import ASTRAY, T_END, cranks, error, outcome, run
from sizes import count

#: All 200 sets take a minute: ``KEMPE_FULL=1``.
SETS = range(count(18, 200))


def test_random_sets_pass_or_stop_with_an_error() -> None:
    found = [outcome(seed) for seed in SETS]
    assert not [why for what, why in found if what == "wrong"]
    assert sum(what == "passed" for what, _ in found) >= 0.95 * len(found)
    assert all(why.startswith("SingularityError") for what, why in found if what == "stopped")


METHODS = {
    "rk45": kp.RK45(rtol=1e-8, atol=1e-10),
    "radau": kp.Radau(rtol=1e-8, atol=1e-10),
    "rk4": kp.RK4(step=2e-3),
}


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("seed", [0, 7, 8])
def test_every_method(method: str, seed: int) -> None:
    of = cranks(seed, number=3)
    assert error(of, run(of, method=METHODS[method])) < ASTRAY


def test_cranks_that_are_released_pass_both_change_points() -> None:
    """Three cranks, released at 1.2 rad: they swing to -π - 1.2 rad and back."""
    m = kp.Model("three cranks", gravity=(0, -9.81), redundancy="allow")
    m.ground.points(G0=(0, 0), G1=(1, 0), G2=(2, 0))
    m.body("rod", mass=1, inertia=1, points={"P0": (0, 0), "P1": (1, 0), "P2": (2, 0)})
    for k in range(3):
        m.bar(f"crank{k}", mass=1, length=0.6, ends=("A", "B"))
        m.revolute(f"A{k}", f"ground.G{k}", f"crank{k}.A")
        m.revolute(f"B{k}", f"crank{k}.B", f"rod.P{k}")
    guess = {"crank1.angle": 1.2, "crank2.angle": 1.2, "rod.angle": 0}
    sol = run_to(m, guess)
    low = sol["crank0"].angle.min()
    assert low == pytest.approx(-np.pi - 1.2, abs=2e-3)
    assert np.abs(sol["rod"].angle).max() < 1e-6
    assert np.abs(sol["crank2"].angle - sol["crank0"].angle).max() < 1e-6
    assert np.abs(sol.energy.balance).max() < 1e-6


def run_to(m: kp.Model, guess: dict[str, float | str]) -> kp.Solution:
    start = kp.assemble(m, set={"crank0.angle": 1.2}, guess=guess)
    return kp.dynamics(m, start, t_end=T_END, output_step=0.01)


@pytest.mark.parametrize("seed", [0, 1, 2])
def test_without_redundancy_the_option_changes_no_digit(seed: int) -> None:
    found = []
    for redundancy in ("allow", "refuse"):
        sol = run(cranks(seed, redundancy, number=2))
        found.append([sol.q, sol.v, sol.a, sol.lam])
    assert all(np.array_equal(a, b) for a, b in zip(*found, strict=True))


def test_rest_in_line_is_refused() -> None:
    of = cranks(0, number=3)
    names = {f"crank{k}.angle": 0.0 for k in range(1, 3)} | {"rod.angle": 0.0}
    with pytest.warns(kp.AssemblyWarning, match="singular position"):
        flat = kp.assemble(of.model, set={"crank0.angle": 0.0}, guess=names)
    with pytest.raises(kp.SingularityError):
        kp.dynamics(of.model, flat, t_end=1)


@pytest.mark.parametrize(("part", "passes"), [(1e-15, True), (1e-12, True), (1e-6, False)])
def test_lengths_that_differ_by_rounding(part: float, passes: bool) -> None:
    m = kp.Model("three cranks", gravity=(0, -9.81), redundancy="allow")
    m.ground.points(G0=(0, 0), G1=(1, 0), G2=(2, 0))
    m.body("rod", mass=1, inertia=1, points={"P0": (0, 0), "P1": (1, 0), "P2": (2, 0)})
    for k, length in enumerate((0.6, 0.6, 0.6 * (1 + part))):
        m.bar(f"crank{k}", mass=1, length=length, ends=("A", "B"))
        m.revolute(f"A{k}", f"ground.G{k}", f"crank{k}.A")
        m.revolute(f"B{k}", f"crank{k}.B", f"rod.P{k}")
    guess: dict[str, float | str] = {"crank1.angle": 1.2, "crank2.angle": 1.2, "rod.angle": 0}
    if not passes:
        with pytest.raises(kp.AssemblyError, match="cannot close"):
            kp.assemble(m, set={"crank0.angle": 1.2}, guess=guess)
        return
    sol = run_to(m, guess)
    assert np.abs(sol["crank2"].angle - sol["crank0"].angle).max() < 1e-6
    assert np.abs(sol.energy.balance).max() < 1e-6
