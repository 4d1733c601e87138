"""Modes with friction that sticks: its joints are locked on request."""

import math
from itertools import product
from pathlib import Path

import kempe as kp
import numpy as np
import pytest


def blocks(mass: float, ratio: float, k: float, static: float) -> kp.Model:
    """Two blocks on a table, joined by a spring; the first one has friction."""
    m = kp.Model("blocks", gravity=(0, -9.81))
    m.ground.points(A=(0, 0))
    for name, kg in (("first", mass), ("second", ratio * mass)):
        m.body(name, mass=kg, inertia=kg, points={"O": (0, 0)})
        m.translational(f"slide_{name}", "ground.A", f"{name}.O")
    m.spring_damper("spring", "first.O", "second.O", stiffness=k, free_length=1.0)
    m.friction("rub", "slide_first", static=static, kinetic=0.5 * static)
    return m


@pytest.mark.parametrize(("mass", "ratio"), [*product([1e-3, 1.0, 1e3], [0.1, 3.0])])
@pytest.mark.parametrize("static", [0.01, 0.5])
def test_a_block_that_sticks_is_a_wall(mass: float, ratio: float, static: float) -> None:
    """Locked, the second block has ω² = k/m₂; sliding without force, the pair k (1/m₁ + 1/m₂)."""
    k = 7.0 * mass
    m = blocks(mass, ratio, k, static)
    state = kp.assemble(m, set={"first.x": 0.0, "second.x": 1.0})
    locked = kp.modes(m, state, lock_friction=True)
    assert locked.locked == ("rub",)
    np.testing.assert_allclose(locked.omega, math.sqrt(k / (ratio * mass)), rtol=1e-9)
    assert len(locked.coordinates) == 1
    assert "locked by friction: rub" in locked.report()
    free = kp.modes(m, state)
    assert free.locked == () and len(free.coordinates) == 2


def test_friction_locks_only_where_it_holds_the_load() -> None:
    """The spring pulls with k s; friction holds up to μ_s m g."""
    m = blocks(2.0, 1.0, 100.0, 0.5)
    limit = 0.5 * 2.0 * 9.81 / 100.0
    for share, names in ((0.98, ("rub",)), (1.02, ())):
        state = kp.assemble(m, set={"first.x": 0.0, "second.x": 1.0 + share * limit})
        assert kp.modes(m, state, lock_friction=True).locked == names
    moving = kp.assemble(m, set={"first.x": 0.0, "second.x": 1.0, "first.vx": 1.0})
    assert kp.modes(m, moving, lock_friction=True).locked == ()


def test_a_brake_may_lock_everything_and_the_file_says_so(tmp_path: Path) -> None:
    m = kp.Model("arm", gravity=(0, -9.81))
    m.ground.points(O=(0, 0))
    m.bar("arm", mass=1.0, length=1.0, ends=("O", "P"))
    m.revolute("pin", "ground.O", "arm.O")
    m.friction("brake", "pin", static=1.0, kinetic=1.0, load=50.0, radius=1.0)
    case = kp.Case(m, {"set": {"arm.angle": 0.3}}, [kp.Modes(lock_friction=True)])
    case.save(tmp_path / "arm.toml")
    found = kp.load(tmp_path / "arm.toml").run()[0]
    assert isinstance(found, kp.ModesResult)
    assert found.locked == ("brake",) and found.coordinates == ()
    assert found.report()[1] == "locked by friction: brake"
