"""Equal cranks whose lengths differ by little more than rounding."""

import kempe as kp
import numpy as np
import pytest
from scipy.integrate import solve_ivp

#: The first change point is passed at 0.63 s.
START, BEFORE, AFTER = 1.2, 0.6, 3.0


def cranks(number: int, mismatch: float) -> kp.Model:
    """Equal cranks on one rod, the first longer by a part; with three, a joint is redundant."""
    m = kp.Model("cranks", gravity=(0, -9.81), redundancy="allow")
    m.ground.points(**{f"A{k}": (2 * k, 0) for k in range(number)})
    pins = {f"B{k}": (2 * k, 0) for k in range(number)}
    m.body("rod", mass=1, inertia=1, points=pins)
    for k in range(number):
        length = 1 + mismatch if k == 0 else 1
        m.bar(f"crank{k}", mass=1, length=length, ends=("A", "B"))
        m.revolute(f"A{k}", f"ground.A{k}", f"crank{k}.A")
        m.revolute(f"B{k}", f"crank{k}.B", f"rod.B{k}")
    return m


def motion(number: int, mismatch: float, end: float = AFTER) -> kp.Solution:
    m = cranks(number, mismatch)
    guess = {f"crank{k}.angle": START for k in range(number)} | {"rod.angle": 0}
    start = kp.assemble(m, set={"crank0.angle": START}, guess=guess)
    return kp.dynamics(m, start, t_end=end, output_step=0.1)


def pendulum(number: int, end: float) -> float:
    """The angle at the end: the rod moves on a circle, so that this is a pendulum."""
    pull = -9.81 * (number / 2 + 1) / (number / 3 + 1)
    law = lambda _, y: (y[1], pull * np.cos(y[0]))  # noqa: E731
    return float(solve_ivp(law, (0, end), (START, 0), rtol=1e-12, atol=1e-12).y[0, -1])


@pytest.mark.parametrize("mismatch", [0, 1e-11, 1e-10, 1e-9, 1e-8])
def test_lengths_within_the_tolerance_of_assembly_move_as_equal_ones(mismatch: float) -> None:
    sol = motion(3, mismatch, BEFORE)
    found = [sol[f"crank{k}"].angle[-1] for k in range(3)]
    assert found == pytest.approx([pendulum(3, BEFORE)] * 3, abs=1e-6)


@pytest.mark.parametrize("mismatch", [0, 1e-12])
def test_rounding_does_not_stop_a_run_at_a_change_point(mismatch: float) -> None:
    assert motion(3, mismatch)["crank0"].angle[-1] == pytest.approx(pendulum(3, AFTER), abs=1e-5)


@pytest.mark.parametrize(("number", "mismatch"), [(2, 1e-10), (3, 1e-9), (3, 1e-8)])
def test_motions_too_near_to_be_told_apart_are_named(number: int, mismatch: float) -> None:
    with pytest.raises(kp.SingularityError, match="without meeting") as caught:
        motion(number, mismatch)
    text = str(caught.value)
    most = float(text.split("less than ")[1].split(" m", maxsplit=1)[0])
    assert mismatch / 3 < most < mismatch * 100, text
    assert "make the lengths exact" in text


def test_lengths_beyond_the_tolerance_do_not_assemble() -> None:
    with pytest.raises(kp.AssemblyError, match="open by"):
        motion(3, 1e-6)
