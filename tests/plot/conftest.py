"""The flagship as it is shipped, and other mechanisms that a figure must bear."""

from pathlib import Path

import kempe as kp
import pytest
from kempe import plot

ROOT = Path(__file__).parents[2]
NAMES = ["<script>alert(1)</script>", "$x_1$", "a\"quote' $", "smile 😀🦾", "n" * 199]


@pytest.fixture(scope="session")
def flagship() -> kp.Solution:
    return kp.load(ROOT / "examples" / "four_bar.toml").run()[0]


@pytest.fixture(scope="session")
def flagship_pages(flagship: kp.Solution) -> list[plot.Page]:
    return plot.pages(flagship)


@pytest.fixture(scope="session")
def six_bar() -> kp.Solution:
    return kp.load(ROOT / "examples" / "six_bar.toml").run()[0]


@pytest.fixture(scope="session")
def crank() -> kp.Solution:
    """The slider-crank."""
    return kp.load(ROOT / "examples" / "slider_crank.toml").run()[0]


@pytest.fixture(scope="session")
def squeezer() -> kp.Solution:
    return kp.load(ROOT / "examples" / "squeezer.toml").run()[0]


@pytest.fixture(scope="session")
def planetary() -> kp.Solution:
    return kp.load(ROOT / "examples" / "planetary_gear.toml").run()[0]


@pytest.fixture(scope="session")
def excavator() -> kp.Solution:
    return kp.load(ROOT / "examples" / "excavator.toml").run()[0]


def pendulum(length: float = 1.0, t_end: float = 2.0, output_step: float = 0.01) -> kp.Solution:
    m = kp.Model("pendulum", gravity=(0, -9.81))
    m.ground.points(O=(0, 0))
    m.bar("rod", mass=2, length=length, ends=("O", "P"))
    m.revolute("O", "ground.O", "rod.O")
    start = kp.assemble(m, set={"rod.angle": 0.0})
    return kp.dynamics(m, start, t_end=t_end, output_step=output_step)


def chain(names: list[str]) -> kp.Solution:
    m = kp.Model("chain $of$ <b>", gravity=(0, -9.81))
    m.ground.points(O=(0, 0))
    end = "ground.O"
    for k, name in enumerate(names):
        m.body(name, mass=1, inertia=0.1, points={"P": (-0.5, 0), "Q": (0.5, 0.1 * (k % 2))})
        m.revolute(f"J{name}", end, f"{name}.P")
        end = f"{name}.Q"
    return kp.dynamics(m, kp.assemble(m, set={}), t_end=0.3, output_step=0.01)


def driven() -> kp.Solution:
    m = kp.Model("crank", gravity=(0, -9.81))
    m.ground.points(A=(0, 0))
    m.bar("a", mass=1e-4, length=0.003, ends=("A", "B"))
    m.revolute("A", "ground.A", "a.A")
    m.coordinate_driver("motor", "a.angle", value="1 + 10*t")
    return kp.dynamics(m, kp.assemble(m, set={}), t_end=0.5, output_step=0.01)
