"""The flagship as a file and in Python, and its solution."""

import signal
from collections.abc import Iterator
from pathlib import Path

import kempe as kp
import pytest

FOUR_BAR = Path(__file__).with_name("four_bar.toml")


def build_four_bar() -> kp.Model:
    m = kp.Model(
        "four-bar",
        gravity=(0, -9.81),
        parameters={"L1": 10, "L2": 26, "L3": 18, "k": 1e6, "c": 1e4},
    )
    m.ground.points(A=(0, 0), D=(20, 0))
    m.bar("crank", mass=3, length="L1", ends=("A", "B"))
    m.bar("coupler", mass=5, length="L2", ends=("B", "C"))
    m.bar("rocker", mass=4, length="L3", ends=("C", "D"))
    m.revolute("A", "ground.A", "crank.A")
    m.revolute("B", "crank.B", "coupler.B")
    m.revolute("C", "coupler.C", "rocker.C")
    m.revolute("D", "ground.D", "rocker.D")
    m.torsion_spring("spring", "ground", "rocker", stiffness="k", damping="c", free_angle="270*deg")
    return m


@pytest.fixture
def model() -> kp.Model:
    return build_four_bar()


@pytest.fixture(scope="session")
def start() -> kp.State:
    guess = {"coupler.angle": "14*deg", "rocker.angle": "240*deg"}
    return kp.assemble(build_four_bar(), set={"crank.angle": "70*deg"}, guess=guess)


@pytest.fixture(scope="session")
def solution(start: kp.State) -> kp.Solution:
    return kp.dynamics(build_four_bar(), start, t_end=1, output_step=0.01)


@pytest.fixture
def four_bar_file(tmp_path: Path) -> Path:
    """A copy of the flagship case that ends after half a second."""
    text = FOUR_BAR.read_text(encoding="utf-8").replace("t_end = 15", "t_end = 0.5")
    path = tmp_path / "four_bar.toml"
    path.write_text(text, encoding="utf-8")
    return path


@pytest.fixture(autouse=True, scope="session")
def _interruptible() -> Iterator[None]:
    """Enable interruptions, which a shell disables for background processes."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)
