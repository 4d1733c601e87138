"""Impacts with friction and impacts of several contacts, against closed forms."""

from typing import Literal

import kempe as kp
import numpy as np
import pytest

G = 9.81
SCALES = [(1.0, 1.0), (1e-3, 1e3), (1e3, 1e-3)]


@pytest.mark.parametrize("scale", SCALES)
@pytest.mark.parametrize("law", ["poisson", "newton"])
@pytest.mark.parametrize("mu", [0.02, 0.2, 0.5])
def test_an_oblique_bounce_of_a_disc(
    scale: tuple[float, float], law: Literal["poisson", "newton"], mu: float
) -> None:
    """The impulse of friction stops the slip of the rim, or is mu times the normal impulse."""
    (mass, size), e, k = scale, 0.6, 0.5
    m = kp.Model("bounce")
    m.ground.curves(floor={"line": ((9 * size, 0), (-9 * size, 0))})
    m.body("disc", mass=mass, inertia=k * mass * size**2, points={"C": (0, 0)})
    m.contact("touch", "disc.C", "ground.floor", radius=size, friction=mu, restitution=e)
    u, v, spin = 1.5 * size, -1.0 * size, 0.4  # per second
    at = {"x": 0, "y": 1.5 * size, "angle": 0, "vx": u, "vy": v, "omega": spin}
    start = kp.assemble(m, set={f"disc.{name}": x for name, x in at.items()})
    sol = kp.dynamics(m, start, t_end=1, restitution_law=law)
    slip = u + spin * size
    normal = -mass * v * (1 + e)
    along = -min(mu * normal, abs(slip) * mass / (1 + 1 / k)) * np.sign(slip)
    after = [u + along / mass, -e * v, spin + along / (k * mass * size)]
    found = [sol[f"disc.{name}"][-1] for name in ("vx", "vy", "omega")]
    assert found == pytest.approx(after, rel=1e-11)
    hit = sol.events["touch.hit"]
    assert hit.t == pytest.approx([0.5], rel=1e-10)
    assert hit.impulse("touch", on="disc")[0] == pytest.approx([along, normal], rel=1e-11)
    assert mu == 0.5 or abs(after[0] + after[2] * size) > 1e-3 * size or mu == 0.2


def cradle(mode: Literal["sequential", "simultaneous"], e: float) -> list[float]:
    m = kp.Model("cradle")
    for k in range(5):
        rim = {"rim": {"circle": (0, 0, 1)}}
        m.body(f"b{k}", mass=1, inertia=1, points={"C": (0, 0)}, curves=rim)
    for k in range(4):
        m.contact(f"c{k}", f"b{k}.C", f"b{k + 1}.rim", radius=1, restitution=e)
    at = {f"b{k}.{name}": 0 for k in range(5) for name in ("y", "angle", "vx", "vy", "omega")}
    at |= {f"b{k}.x": 2 * k for k in range(5)} | {"b0.x": -0.5, "b0.vx": 1}
    sol = kp.dynamics(m, kp.assemble(m, set=at), t_end=1, impacts=mode)
    return [float(sol[f"b{k}.vx"][-1]) for k in range(5)]


def test_a_cradle_in_both_orders() -> None:
    """In rounds, only the last ball leaves. At once, expansion doubles all impulses."""
    assert cradle("sequential", 1.0) == pytest.approx([0, 0, 0, 0, 1], abs=1e-12)
    assert cradle("simultaneous", 1.0) == pytest.approx([-0.6, 0.4, 0.4, 0.4, 0.4], abs=1e-12)
    assert cradle("simultaneous", 0.0) == pytest.approx([0.2] * 5, abs=1e-12)


@pytest.mark.parametrize("scale", SCALES)
@pytest.mark.parametrize("slender", [2.0, 4.0])
def test_a_block_rocks_as_housner_found(scale: tuple[float, float], slender: float) -> None:
    """Each plastic impact on a corner multiplies the rate by 1 - 1.5 sin² alpha."""
    mass, size = scale
    b, h = size, slender * size
    m = kp.Model("rocking", gravity=(0, -G))
    m.ground.curves(floor={"line": ((9 * size, 0), (-9 * size, 0))})
    m.body(
        "block", mass=mass, inertia=mass * (b**2 + h**2) / 3, points={"A": (-b, -h), "B": (b, -h)}
    )
    for corner in "AB":
        m.contact(corner, f"block.{corner}", "ground.floor", friction=2, restitution=0)
    lean = 0.3 * np.arctan(b / h)
    # it leans on corner B
    c, s = np.cos(-lean), np.sin(-lean)
    at = {"x": -(c * b + s * h), "y": -(s * b - c * h), "angle": -lean, "vx": 0, "vy": 0}
    start = kp.assemble(m, set={f"block.{name}": x for name, x in at.items()} | {"block.omega": 0})
    sol = kp.dynamics(m, start, t_end=6 * np.sqrt(size), method=kp.DOP853(rtol=1e-10, atol=1e-12))
    ratio = 1 - 1.5 * (b**2 / (b**2 + h**2))
    hits = sol.events["A.hit"]
    before = hits.states[0]["block.omega"]
    after = sol(hits.t[0])["block.omega"]
    assert after / before == pytest.approx(ratio, rel=1e-9)
    assert sol.events["B.hit"].t.size >= 1
    # the height of the mass centre gives the rate before the first impact
    R = np.hypot(b, h)
    fall = R * np.cos(np.arctan(b / h) - lean) - h
    assert before**2 == pytest.approx(1.5 * G * fall / R**2, rel=1e-8)
    assert np.all(np.diff(sol.energy.total) < 1e-9 * mass * G * size)


@pytest.mark.parametrize("mu", [1.0, 1.3])
def test_a_rod_that_slides_before_the_paradox(mu: float) -> None:
    """N = m g / (1 + 3 cos(cos - mu sin)) of a rod that leans back by tan = 2."""
    sol = kp.dynamics(*rod(mu), t_end=0.001)
    normal = G / (1 + 3 * (0.2 - mu * 0.4))
    assert sol["touch.force"][0] == pytest.approx(normal, rel=1e-9)
    assert sol["touch"].force(on="rod")[0] == pytest.approx([-mu * normal, normal], rel=1e-9)


def test_a_rod_beyond_the_paradox_is_told() -> None:
    with pytest.raises(kp.SingularityError, match=r"paradox.*touch"):
        kp.dynamics(*rod(1.4), t_end=0.001)


def rod(mu: float) -> tuple[kp.Model, kp.State]:
    m = kp.Model("rod", gravity=(0, -G))
    m.ground.curves(floor={"line": ((9, 0), (-9, 0))})
    m.bar("rod", mass=1, length=1, ends=("P", "Q"))
    m.contact("touch", "rod.P", "ground.floor", friction=mu, restitution=0)
    at = {"rod.angle": "pi - atan(2)", "rod.omega": 0, "rod.P.x": 0, "rod.P.y": 0}
    return m, kp.assemble(m, set=at | {"rod.P.vx": 1, "rod.P.vy": 0})


@pytest.mark.parametrize("seed", range(6))
def test_discs_in_a_box_gain_no_energy(seed: int) -> None:
    rng = np.random.default_rng(seed)
    m = kp.Model("box", gravity=(0, -G))
    corners = [(0, 0), (0, 3), (4, 3), (4, 0)]
    sides = zip(corners, corners[1:] + corners[:1], strict=True)
    # the inside is at the right of each wall
    m.ground.curves(**{f"w{k}": {"line": ends} for k, ends in enumerate(sides)})
    at = {}
    for k in range(3):
        r, mass = rng.uniform(0.2, 0.5), 10 ** rng.uniform(-1, 1)
        rim = {"rim": {"circle": (0, 0, r)}}
        m.body(f"d{k}", mass=mass, inertia=0.5 * mass * r**2, points={"C": (0, 0)}, curves=rim)
        law = {"friction": rng.uniform(0, 1), "restitution": rng.choice([0, 0.5, 0.8])}
        for wall in range(4):
            m.contact(f"d{k}w{wall}", f"d{k}.C", f"ground.w{wall}", radius=r, **law)
        for other in range(k):
            m.contact(f"d{k}d{other}", f"d{k}.C", f"d{other}.rim", radius=r, **law)
        speeds = rng.normal(0, 3, 3)
        state = (0.7 + 1.3 * k, rng.uniform(0.6, 2.4), 0, *speeds)
        names = ("x", "y", "angle", "vx", "vy", "omega")
        at |= {f"d{k}.{name}": x for name, x in zip(names, state, strict=True)}
    start = kp.assemble(m, set=at)
    for impacts in ("sequential", "simultaneous"):
        sol = kp.dynamics(m, start, t_end=2, impacts=impacts)
        total = sol.energy.total
        assert np.all(np.diff(total) < 1e-7 * total[0])
        gaps = [sol[f"d{k}w{wall}.gap"] for k in range(3) for wall in range(4)]
        assert np.min(gaps) > -1e-8
