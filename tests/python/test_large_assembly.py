"""Assembly of large mechanisms: ladders of squares, time, interruptions, messages."""

import math
import os
import re
import signal
import threading
import time
from collections.abc import Callable

import kempe as kp
import numpy as np
import pytest


def ladder(squares: int) -> kp.Model:
    """Rods on pins 1 m apart with couplers between neighbours: unit squares in a row."""
    m = kp.Model("ladder", gravity=(0, -9.81))
    m.ground.points(**{f"G{k}": (k, 0) for k in range(squares + 1)})
    for k in range(squares + 1):
        m.bar(f"rod{k}", mass=1, length=1, ends=("A", "B"))
        m.revolute(f"P{k}", f"ground.G{k}", f"rod{k}.A")
    for k in range(squares):
        m.bar(f"link{k}", mass=1, length=1, ends=("A", "B"))
        m.revolute(f"L{k}", f"rod{k}.B", f"link{k}.A")
        m.revolute(f"R{k}", f"link{k}.B", f"rod{k + 1}.B")
    return m


def free(bodies: int) -> kp.Model:
    m = kp.Model("free")
    for k in range(bodies):
        m.body(f"b{k}", mass=1, inertia=1)
    return m


@pytest.mark.parametrize("squares", [1, 8, 255, 256, 257, 1000])
def test_a_ladder_assembles_unfolded_and_the_report_says_so(squares: int) -> None:
    start = kp.assemble(ladder(squares), set={"rod0.angle": math.radians(80)})
    for k in range(squares + 1):
        assert start[f"rod{k}"].angle == pytest.approx(math.radians(80), abs=1e-9)
    report = start.report
    assert report is not None
    assert [mode.folded for mode in report.modes] == [False] * squares
    assert report.alternatives == 2**squares - 1
    assert not report.warnings
    lines = str(report).splitlines()
    assert lines.pop().startswith("not set: ")
    assert re.search("right of P1 → L0, unfolded|left of L0 → P1, unfolded", lines[1])
    if squares > 20:
        assert lines[-2] == f"and {squares - 20} more, none of them folded"
        assert lines[-1] == f"other assemblies exist: up to 2^{squares} - 1"
        assert len(lines) == 23
    else:
        assert lines[-1] == f"other assemblies exist: {2**squares - 1}"


def test_a_guess_folds_a_square_and_the_report_says_so() -> None:
    with pytest.warns(kp.AssemblyWarning, match="singular position"):
        start = kp.assemble(
            ladder(2), set={"rod0.angle": 1.4}, guess={"rod1.angle": 3.0, "rod2.angle": 3.0}
        )
    assert start.report is not None
    assert start.report.modes[0].folded
    assert ", folded" in str(start.report)


def seconds(bodies: int) -> float:
    """The shortest of three times to build and to assemble."""

    def once() -> float:
        model = free(bodies)
        begin = time.process_time()
        kp.assemble(model)
        return time.process_time() - begin

    return min(once() for _ in range(3))


def test_the_time_for_free_bodies_is_linear() -> None:
    """16 times as many bodies take 16 times as long; quadratic work would take 256 times."""
    assert seconds(16_000) < 64 * seconds(1_000)


def contradictory() -> tuple[kp.Model, dict[str, float]]:
    """A ladder that does not close, so that many placements are tried."""
    return ladder(3000), {"rod0.angle": 1.4, "rod3000.angle": 0.3}


def many() -> tuple[kp.Model, dict[str, float]]:
    """So many bodies that the signal arrives while the model is compiled or assembled."""
    return free(100_000), {}


@pytest.mark.alone
@pytest.mark.skipif(os.name != "posix", reason="signals as POSIX has them")
@pytest.mark.parametrize("made", [contradictory, many])
def test_an_interruption_of_an_assembly_arrives_within_a_fifth_of_a_second(
    made: Callable[[], tuple[kp.Model, dict[str, float]]],
) -> None:
    model, held = made()
    model.compile()
    sent: list[float] = []

    def interrupt() -> None:
        sent.append(time.monotonic())
        signal.raise_signal(signal.SIGINT)

    timer = threading.Timer(0.1, interrupt)
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        for _ in range(1000):
            kp.assemble(model, set=held)
    assert time.monotonic() - sent[0] < 0.2


def test_a_message_has_a_hundred_problems_and_the_number_of_others() -> None:
    m = kp.Model("many")
    m.ground.points(A=(0, 0))
    for k in range(250):
        m.revolute(f"J{k}", "ground.A", f"nobody{k}.A")
    with pytest.raises(kp.ModelError) as caught:
        m.compile()
    lines = str(caught.value).splitlines()
    assert len(caught.value.problems) == 100
    assert lines[-1] == "… and 150 more problems"
    assert len(lines) == 101


def four_bar(stiffness: float) -> tuple[kp.Model, kp.State]:
    m = kp.Model("four-bar", gravity=(0, -9.81))
    m.ground.points(A=(0, 0), D=(20, 0))
    for name, mass, length in (("crank", 3, 10), ("coupler", 5, 26), ("rocker", 4, 18)):
        m.bar(name, mass=mass, length=length, ends=("P", "Q"))
    m.revolute("A", "ground.A", "crank.P")
    m.revolute("B", "crank.Q", "coupler.P")
    m.revolute("C", "coupler.Q", "rocker.P")
    m.revolute("D", "rocker.Q", "ground.D")
    m.torsion_spring("spring", "ground", "rocker", stiffness=stiffness, free_angle="270*deg")
    guess = {"coupler.angle": "14*deg", "rocker.angle": "240*deg"}
    return m, kp.assemble(m, set={"crank.angle": "70*deg"}, guess=guess)


def test_joints_that_come_apart_at_once_name_a_remedy_that_works() -> None:
    options = {"method": kp.RK45(), "stabilization": kp.Baumgarte()}
    with pytest.raises(kp.IntegrationError, match="come apart") as caught:
        kp.dynamics(*four_bar(1e30), t_end=1, **options)  # type: ignore[arg-type]
    found = re.search(r"is open by (\S+) m, more than (\S+) m", str(caught.value))
    assert found is not None
    assert found[1] != found[2]
    assert float(found[1]) > float(found[2])
    assert "check the size of the forces" in str(caught.value)
    assert kp.dynamics(*four_bar(1e6), t_end=0.1, **options).success  # type: ignore[arg-type]


def cart(mass: float, inertia: float) -> tuple[kp.Model, kp.State]:
    """A bob that is pinned to a cart on a rail."""
    m = kp.Model("cart", gravity=(0, -9.81))
    m.ground.points(O=(0, 0))
    m.body("cart", mass=mass, inertia=1e-8, points={"P": (0, 0)})
    m.body("bob", mass=1, inertia=inertia, points={"P": (0, 1)})
    m.translational("slide", "ground.O", "cart.P")
    m.revolute("pin", "cart.P", "bob.P")
    return m, kp.assemble(m, set={"bob.angle": 0.3, "cart.x": 0})


def test_a_bob_without_inertia_on_a_massless_cart_names_remedies_that_work() -> None:
    with pytest.raises(kp.SingularityError) as caught:
        kp.dynamics(*cart(0, 0), t_end=1)
    message = str(caught.value)
    assert "no inertia resists cart.x" in message
    assert "set its mass, or hold it with a joint or driver" in message
    assert "no joint" not in message
    assert kp.dynamics(*cart(0, 1e-3), t_end=1).success
    assert kp.dynamics(*cart(1e-8, 0), t_end=1).success
    assert kp.dynamics(*cart(1e-3, 0), t_end=1).success


def test_a_free_body_without_inertia_has_no_joint() -> None:
    m = kp.Model("free")
    m.body("bob", mass=1, inertia=0)
    m.torque("push", "bob", torque=1)
    with pytest.raises(kp.SingularityError, match="no joint prevents its rotation; set"):
        kp.dynamics(m, kp.assemble(m), t_end=1)
    assert np.isfinite(kp.assemble(m).q).all()
