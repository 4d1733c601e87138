"""An interruption stops a long run quickly, and a kill never leaves an incomplete file."""

import os
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable
from pathlib import Path

import kempe as kp
import numpy as np
import pytest

ROOT = Path(__file__).parents[2]


def four_bar() -> kp.State:
    return kp.load(ROOT / "examples/four_bar.toml").start()


def hanging_chain() -> kp.State:
    """A chain of 300 bars; a step takes a thousand times as long as an output of the four-bar."""
    m = kp.Model("chain", gravity=(0, -9.81))
    m.ground.points(P0=(0, 0))
    for k in range(300):
        m.bar(f"b{k}", mass=1, length=1, ends=(f"P{k}", f"P{k + 1}"))
        m.revolute(f"J{k}", f"b{k - 1}.P{k}" if k else "ground.P0", f"b{k}.P{k}")
    return kp.assemble(m, set={f"b{k}.angle": -0.02 * k for k in range(300)})


@pytest.mark.alone
@pytest.mark.skipif(os.name != "posix", reason="signals as POSIX has them")
@pytest.mark.parametrize(
    ("made", "t_end", "output_step"),
    [
        (four_bar, 1e6, None),
        (four_bar, 1e6, 100.0),
        (four_bar, 1e4, 0.01),
        (hanging_chain, 1e4, None),
        (hanging_chain, 1e4, 0.01),
    ],
)
def test_an_interruption_arrives_within_a_fifth_of_a_second(
    made: Callable[[], kp.State], t_end: float, output_step: float | None
) -> None:
    start = made()
    sent: list[float] = []

    def interrupt() -> None:
        sent.append(time.monotonic())
        signal.raise_signal(signal.SIGINT)

    start.model.compile()
    kp.dynamics(start.model, start, t_end=1e-9)  # later runs begin at once
    timer = threading.Timer(0.5, interrupt)
    timer.start()
    with pytest.raises(KeyboardInterrupt) as caught:
        kp.dynamics(
            start.model,
            start,
            t_end=t_end,
            output_step=output_step,
            method=kp.Auto(rtol=1e-12, atol=1e-15),  # short steps for a long run
            dense_output=False,
        )
    took = time.monotonic() - sent[0]
    solution = caught.value.solution  # type: ignore[attr-defined]
    assert took < 0.2
    assert not solution.success
    assert 1 <= len(solution.t) == len(solution.a) == len(solution.lam)
    assert np.isfinite(solution.q).all()


def interrupted(work: Callable[[], object], after: float = 0.4) -> tuple[float, BaseException]:
    """The time from a signal to the exception of a computation, s, and the exception.

    A computation that holds the interpreter's lock also delays the signal, which counts.
    """
    due = time.monotonic() + after
    threading.Timer(after, signal.raise_signal, [signal.SIGINT]).start()
    with pytest.raises(KeyboardInterrupt) as caught:
        work()
    return time.monotonic() - due, caught.value


@pytest.mark.alone
@pytest.mark.skipif(os.name != "posix", reason="signals as POSIX has them")
@pytest.mark.parametrize("n", [3, 1000])
@pytest.mark.parametrize("analysis", [kp.kinematics, kp.inverse_dynamics])
def test_an_interruption_of_a_driven_motion_keeps_the_motion(
    analysis: Callable[..., kp.Solution], n: int
) -> None:
    m = kp.Model("rod", gravity=(0, -9.81))
    m.ground.points(O=(0, 0))
    m.bar("rod", mass=2, length=1.5, ends=("O", "P"))
    m.revolute("pin", "ground.O", "rod.O")
    start = kp.assemble(m, set={"rod.angle": 0.3})
    took, error = interrupted(lambda: analysis(m, start, over="rod.angle", range=(0, 3e4), n=n))
    assert took < 0.2
    found = error.solution  # type: ignore[attr-defined]
    assert not found.success and found.message == "interrupted"
    assert 1 <= len(found.t) < n
    np.testing.assert_allclose(found["rod.angle"], found.t, rtol=0, atol=1e-9)
    lifted = 2 * 9.81 * 0.75 * np.sin(found.t)  # the work of the driver at unit rate
    np.testing.assert_allclose(found["energy.work"], lifted, rtol=0, atol=1e-6)


def net(n: int) -> kp.Model:
    """Hanging bars whose dense matrices take long."""
    m = kp.Model("net", gravity=(0, -9.81))
    for k in range(n):
        m.ground.points(**{f"A{k}": (k, 0)})
        m.bar(f"b{k}", mass=1, length=1, ends=("O", "P"))
        m.revolute(f"J{k}", f"ground.A{k}", f"b{k}.O")
    return m


def wheels(ratio: float) -> kp.Solution:
    """A pair of gears, whose larger one is drawn with 18 teeth times the ratio."""
    m = kp.Model("pair")
    m.ground.points(A=(0, 0), B=(1 + ratio, 0))
    for name in "AB":
        m.body(f"w{name}", mass=1, inertia=1, points={"C": (0, 0)})
        m.revolute(f"p{name}", f"ground.{name}", f"w{name}.C")
    m.gear("g", "wA.C", "wB.C", radii=(1, ratio))
    m.coordinate_driver("drive", "wA.angle", value="t")
    return kp.kinematics(m, kp.assemble(m), t_end=0.1, output_step=0.1)


@pytest.mark.alone
@pytest.mark.skipif(os.name != "posix", reason="signals as POSIX has them")
@pytest.mark.parametrize("name", ["modes", "equilibrium", "mobility", "assemble", "teeth"])
def test_an_interruption_of_a_long_analysis_arrives_within_a_fifth_of_a_second(
    name: str, tmp_path: Path
) -> None:
    if name == "teeth":
        drawn = wheels(3e4)
        page = tmp_path / "pair.html"
        took, _ = interrupted(lambda: [kp.player(drawn, page) for _ in range(1000)])
    else:
        m = net(600)
        start = kp.assemble(m, set={f"b{k}.angle": -0.3 for k in range(600)})
        again = {"assemble": lambda: kp.assemble(m, from_state=start)}
        run = again.get(name, lambda: getattr(kp, name)(m, start))
        took, _ = interrupted(lambda: [run() for _ in range(1000)])
    assert took < 0.2


@pytest.mark.alone
@pytest.mark.skipif(os.name != "posix", reason="signals as POSIX has them")
@pytest.mark.parametrize("count", [1, 9, 18])
def test_an_interruption_of_a_study_arrives_within_a_fifth_of_a_second(
    count: int, tmp_path: Path
) -> None:
    text = (ROOT / "examples/four_bar.toml").read_text("utf-8")
    file = tmp_path / "long.toml"
    file.write_text(text.replace("t_end = 15", "t_end = 60"), "utf-8")
    case = kp.load(file)
    due: list[float] = []
    computed: list[str] = []

    def progress(variant: str) -> None:
        computed.append(variant)
        if len(computed) == count:  # a signal comes shortly after a variant
            due.append(time.monotonic() + 0.02)
            threading.Timer(0.02, signal.raise_signal, [signal.SIGINT]).start()

    with pytest.raises(KeyboardInterrupt):
        kp.study(case, progress=progress)
    assert time.monotonic() - due[0] < 0.2


WRITER = """
import sys
import kempe as kp
case = kp.load(sys.argv[1])
sol = kp.dynamics(case.model, case.start(), t_end=0.5, output_step=0.001)
print("ready", flush=True)
while True:
    sol.save(sys.argv[2])
    sol.to_csv(sys.argv[3])
    case.save(sys.argv[4])
"""


@pytest.mark.parametrize("delay", [0.01, 0.05, 0.13, 0.29])
def test_a_kill_during_a_save_leaves_no_incomplete_file(delay: float, tmp_path: Path) -> None:
    npz, csv, toml = (tmp_path / name for name in ("s.npz", "s.csv", "c.toml"))
    words = [str(ROOT / "examples/four_bar.toml"), str(npz), str(csv), str(toml)]
    with subprocess.Popen(
        [sys.executable, "-c", WRITER, *words], stdout=subprocess.PIPE, text=True
    ) as process:
        assert process.stdout is not None
        assert process.stdout.readline() == "ready\n"
        deadline = time.monotonic() + 30
        while not toml.exists() and time.monotonic() < deadline:
            time.sleep(0.01)
        time.sleep(delay)
        process.kill()
    assert len(kp.load_solution(npz).t) == 501
    assert len(csv.read_text("utf-8").splitlines()) == 502
    assert kp.load(toml).tree() == kp.load(ROOT / "examples/four_bar.toml").tree()


@pytest.mark.parametrize("bad", [float("nan"), float("inf"), -float("inf")])
def test_numbers_that_are_not_finite_are_refused_by_name(bad: float) -> None:
    m = kp.Model("rod", gravity=(0, -9.81))
    m.ground.points(A=(0, 0))
    with pytest.raises(kp.ModelError, match=r"rod\.mass"):
        m.bar("rod", mass=bad, length=1, ends=("A", "B"))
    m.bar("rod", mass=1, length=1, ends=("A", "B"))
    m.revolute("A", "ground.A", "rod.A")
    with pytest.raises(kp.ModelError, match=r"rod\.angle"):
        kp.assemble(m, set={"rod.angle": bad})
    start = kp.assemble(m, set={"rod.angle": 0})
    with pytest.raises(kp.ModelError, match="t_end"):
        kp.dynamics(m, start, t_end=bad)
    with pytest.raises(kp.ModelError, match="rtol"):
        kp.dynamics(m, start, t_end=1, method=kp.RK45(rtol=bad))
