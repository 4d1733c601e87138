"""Rods that slide where rigid bodies have no motion, several, or forces without bound.

A rod with its mass centre at c = (x, y) from the end that slides has the normal force N = -b / A,
with A = (1 + (x² + σ μ x y) / k²) / m, b = -g + ω² y, the sign σ of the sliding and the radius of
gyration k. It has no solution for A < 0 and b < 0, and several for A < 0 and b > 0.
"""

from __future__ import annotations

import itertools
import warnings
from typing import Any, Literal

import kempe as kp
import numpy as np
import pytest
from scipy.integrate import solve_ivp

G = 9.81
#: Mass and length.
SCALES = [(1.0, 1.0), (1e-3, 1e3), (1e3, 1e-3)]


def rod(
    mu: float,
    angle: float,
    spin: float = 0.0,
    speed: float = 1.0,
    scale: tuple[float, float] = (1.0, 1.0),
    e: float = 0.0,
) -> tuple[kp.Model, kp.State]:
    """A rod on its end P. Speeds are in units of √(g L), the spin in √(g / L)."""
    mass, size = scale
    m = kp.Model("rod", gravity=(0, -G))
    m.ground.curves(floor={"line": ((900 * size, 0), (-900 * size, 0))})
    m.bar("rod", mass=mass, length=size, ends=("P", "Q"))
    m.contact("touch", "rod.P", "ground.floor", friction=mu, restitution=e)
    at = {"rod.angle": angle, "rod.omega": spin * np.sqrt(G / size), "rod.P.x": 0, "rod.P.y": 0}
    at |= {"rod.P.vx": speed * np.sqrt(G * size), "rod.P.vy": 0}
    return m, kp.assemble(m, set=at)


def run(model: kp.Model, start: kp.State, **options: Any) -> tuple[kp.Solution, list[str]]:
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        sol = kp.dynamics(model, start, **options)
    return sol, [str(one.message) for one in told]


@pytest.mark.parametrize("scale", SCALES)
@pytest.mark.parametrize("law", ["poisson", "newton"])
def test_an_impact_without_collision_stops_the_end(
    scale: tuple[float, float], law: Literal["poisson", "newton"]
) -> None:
    """Impulses at the end keep the moment of momentum about it."""
    mass, size = scale
    lean, time = 0.9, np.sqrt(size / G)
    m, start = rod(1.5, np.pi - lean, spin=0.4, scale=scale)
    sol, told = run(m, start, t_end=0.1 * time, jam="impact", restitution_law=law)
    x, y = -0.5 * size * np.cos(lean), 0.5 * size * np.sin(lean)
    vx, omega = np.sqrt(G * size), 0.4 / time
    momentum = mass * np.array([vx - omega * y, omega * x])
    about_end = x * momentum[1] - y * momentum[0] + mass * size**2 / 12 * omega
    after = about_end / (mass * size**2 / 3)
    now = sol(0.0)
    assert now["rod.omega"] == pytest.approx(after, rel=1e-11)
    assert [now["rod.P.vx"] / vx, now["rod.P.vy"] / vx] == pytest.approx([0, 0], abs=1e-12)
    event = sol.events["touch.paradox"]
    impulse = mass * after * np.array([-y, x]) - momentum
    assert event.t == pytest.approx([0])
    assert event.impulse("touch", on="rod")[0] == pytest.approx(impulse, rel=1e-10)
    energy = sol.energy.kinetic + sol.energy.potential
    before = 0.5 * (momentum @ momentum) / mass + mass * size**2 / 24 * omega**2
    lost = before - mass * size**2 / 6 * after**2
    assert sol.energy.total[0] - energy[1] == pytest.approx(lost, rel=1e-6)
    assert any("paradox" in text and "touch" in text for text in told)


def test_expansion_after_an_impact_without_collision() -> None:
    """In expansion, the normal impulse is e times that of compression, and the end sticks."""
    lean, e = 0.9, 0.5
    m, start = rod(1.5, np.pi - lean, e=e)
    sol, _ = run(m, start, t_end=1e-3, jam="impact")
    x, y = -0.5 * np.cos(lean), 0.5 * np.sin(lean)
    response = np.array([[1 + 12 * y * y, -12 * x * y], [-12 * x * y, 1 + 12 * x * x]])
    compression = -np.linalg.solve(response, [np.sqrt(G), 0])
    normal = e * compression[1]
    along = -response[0, 1] / response[0, 0] * normal
    rate = response[1] @ [along, normal]
    now = sol(0.0)
    assert [now["rod.P.vx"], now["rod.P.vy"]] == pytest.approx([0, rate], abs=1e-11)
    impulse = sol.events["touch.paradox"].impulse("touch", on="rod")[0]
    assert impulse == pytest.approx(compression + np.array([along, normal]), rel=1e-10)


def test_what_is_known_about_random_rods() -> None:
    """The formula decides whether a run warns, ends or needs an impact."""
    random, seen = np.random.default_rng(5), set()
    for k in range(60):
        mu, angle = random.uniform(0.3, 4), random.uniform(0.2, np.pi - 0.2)
        spin, sense = random.normal() * 2, random.choice([-1, 1])
        x, y = 0.5 * np.cos(angle), 0.5 * np.sin(angle)
        a, b = 1 + 12 * (x * x + sense * mu * x * y), -1 + spin**2 * y
        m, start = rod(mu, angle, spin, float(sense), SCALES[k % 3])
        options: dict[str, Any] = {"t_end": 1e-6 * np.sqrt(SCALES[k % 3][1] / G)}
        if abs(a) < 0.05 or abs(b) < 0.05:
            continue
        kind = (a > 0, b > 0)
        seen.add(kind)
        if kind == (False, False):
            with pytest.raises(kp.SingularityError, match=r"paradox.*contact touch.*jam = "):
                kp.dynamics(m, start, **options)
            sol, _ = run(m, start, **options, jam="impact")
            assert len(sol.events["touch.paradox"].t) == 1
            continue
        sol, told = run(m, start, **options)
        assert any("not unique" in text for text in told) == (kind == (False, True)), (k, told)
        normal = 0 if b > 0 else -b / a * SCALES[k % 3][0] * G
        assert sol["touch.force"][0] == pytest.approx(normal, rel=1e-8)
    assert len(seen) == 4


def test_several_motions_are_told() -> None:
    """A rod that turns fast can leave the floor or press on it."""
    # the mass centre is above the end: it hangs below it only where the end slides on a ceiling
    for mu, several in ((0.5, False), (2.0, True)):
        m = kp.Model("ceiling", gravity=(0, -G))
        m.ground.curves(ceiling={"line": ((-9, 0), (9, 0))})
        m.bar("rod", mass=1, length=1, ends=("P", "Q"))
        m.contact("touch", "rod.P", "ground.ceiling", friction=mu, restitution=0)
        at = {"rod.angle": -0.9, "rod.omega": 0, "rod.P.x": 0, "rod.P.y": 0}
        start = kp.assemble(m, set=at | {"rod.P.vx": -1, "rod.P.vy": 0})
        sol, told = run(m, start, t_end=1e-3)
        assert any("not unique" in text and "touch" in text for text in told) == several
        assert sol["touch.force"][0] == 0


@pytest.mark.parametrize("scale", SCALES)
def test_sliding_towards_a_paradox(scale: tuple[float, float]) -> None:
    """The normal force grows without bound within a finite time, which the equations give."""
    mu, angle, spin, speed, size = 3.63, 0.25, 1.44, -1.8, scale[1]
    time = np.sqrt(size / G)
    m, start = rod(mu, angle, spin, speed, scale)

    def pivot(y: np.ndarray) -> float:
        c, s = 0.5 * np.cos(y[0]), 0.5 * np.sin(y[0])
        return float(1 + 12 * (c * c - mu * c * s))

    def rates(_: float, y: np.ndarray) -> list[float]:
        c, s = 0.5 * np.cos(y[0]), 0.5 * np.sin(y[0])
        normal = (1 - y[1] ** 2 * s) / pivot(y)
        turn = -12 * normal * (c - mu * s)
        along = mu * normal + turn * s + y[1] ** 2 * c
        return [y[1], turn, along]

    def ends(_: float, y: np.ndarray) -> float:
        return pivot(y) - 1e-4

    ends.terminal = True  # type: ignore[attr-defined]
    own = solve_ivp(rates, (0, 5), [angle, spin, speed], events=ends, rtol=1e-10, atol=1e-12)
    assert own.status == 1
    assert own.y[2, -1] < -0.05
    with pytest.raises(kp.SingularityError, match=r"paradox.*contact touch") as failed:
        kp.dynamics(m, start, t_end=3 * time)
    assert failed.value.t == pytest.approx(own.t[-1] * time, rel=2e-4)
    sol, _ = run(m, start, t_end=3 * time, jam="impact")
    event = sol.events["touch.paradox"]
    assert event.t[0] == pytest.approx(own.t[-1] * time, rel=2e-4)
    energy = sol.energy.kinetic + sol.energy.potential
    assert np.max(np.diff(energy)) < 1e-7 * np.max(np.abs(energy))
    after = sol(event.t[0])
    assert abs(after["rod.P.vx"]) < 1e-9 * np.sqrt(G * size)


def test_many_sliding_contacts_are_not_examined() -> None:
    m = kp.Model("bricks", gravity=(0, -G))
    m.ground.curves(floor={"line": ((90, 0), (-90, 0))})
    at: dict[str, Any] = {}
    for k in range(13):
        m.body(f"b{k}", mass=1, inertia=1, points={"C": (0, 0)})
        m.contact(f"c{k}", f"b{k}.C", "ground.floor", radius=1, friction=0.1, restitution=0)
        at |= {f"b{k}.x": 3 * k, f"b{k}.y": 1, f"b{k}.angle": 0, f"b{k}.vx": 1, f"b{k}.vy": 0}
        at[f"b{k}.omega"] = 0
    sol = kp.dynamics(m, kp.assemble(m, set=at), t_end=0.01)
    assert ["not examined" in text for text in sol.statistics["notes"]] == [True]


def test_a_stepper_reports_a_paradox_at_its_start() -> None:
    """Once, although the start belongs to no step; its motion is that of a run."""
    m, start = rod(1.5, np.pi - 0.9, spin=0.4)
    options = kp.Dynamics(t_end=1, jam="impact")
    names = {name: start[name] for name in ("rod.x", "rod.y", "rod.angle")}
    rates = {name: start[name] for name in ("rod.vx", "rod.vy", "rod.omega")}
    case = kp.Case(m, {"set": names | rates}, [options])
    stepper = kp.Stepper(case)
    with pytest.warns(kp.AccuracyWarning, match=r"paradox.*touch"):
        stepper.step(0.01)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        stepper.step(0.01)
    sol, _ = run(m, start, t_end=0.02, jam="impact")
    assert stepper.state["rod.omega"] == pytest.approx(sol["rod.omega"][-1], rel=1e-9)


def test_a_jam_among_many_closed_contacts_is_named_with_a_remedy() -> None:
    """Combinations of at most six contacts are tried."""
    m, _ = rod(1.5, np.pi - 0.9)
    at: dict[str, Any] = {"rod.angle": np.pi - 0.9, "rod.omega": 0, "rod.P.x": 0, "rod.P.y": 0}
    at |= {"rod.P.vx": 1, "rod.P.vy": 0}
    for k in range(6):
        m.body(f"b{k}", mass=1, inertia=1, points={"C": (0, 0)})
        m.contact(f"c{k}", f"b{k}.C", "ground.floor", radius=1, restitution=0)
        place = {"x": 3 * k + 2, "y": 1, "angle": 0, "vx": 0, "vy": 0, "omega": 0}
        at |= {f"b{k}.{name}": x for name, x in place.items()}
    start = kp.assemble(m, set=at)
    with pytest.raises(kp.SingularityError, match=r"contacts touch, c0.*more than 6.*stiffness"):
        kp.dynamics(m, start, t_end=1e-3, jam="impact")


def among_others(
    scale: tuple[float, float], order: tuple[str, ...], rods: dict[str, dict[str, float]]
) -> tuple[kp.Model, kp.State]:
    """Two rods and a block that slide on one floor."""
    mass, size = scale
    m = kp.Model("several", gravity=(0, -G))
    m.ground.curves(floor={"line": ((900 * size, 0), (-900 * size, 0))})
    rate, at = np.sqrt(G / size), {}
    for k, name in enumerate(order):
        x = 10 * k * size
        if name == "block":
            feet = {"L": (-size, -0.1 * size), "R": (size, -0.1 * size)}
            m.body("block", mass=3 * mass, inertia=mass * size**2, points=feet)
            at |= {"block.x": x, "block.y": 0.1 * size, "block.angle": 0, "block.vx": rate * size}
            contacts = {f"foot_{foot}": (f"block.{foot}", 0.3) for foot in feet}
        else:
            own = rods[name]
            m.bar(name, mass=mass, length=size, ends=("P", "Q"))
            at |= {f"{name}.angle": own["angle"], f"{name}.omega": own["spin"] * rate}
            at |= {f"{name}.P.x": x, f"{name}.P.y": 0}
            at |= {f"{name}.P.vx": own["speed"] * rate * size, f"{name}.P.vy": 0}
            contacts = {f"touch_{name}": (f"{name}.P", own["mu"])}
        for contact, (point, mu) in contacts.items():
            m.contact(contact, point, "ground.floor", friction=mu, restitution=0)
    return m, kp.assemble(m, set=at)


CALM = {"mu": 0.4, "angle": np.pi - 0.9, "spin": 0.4, "speed": 1.0}


@pytest.mark.parametrize("which", ["a", "b"])
@pytest.mark.parametrize("order", list(itertools.permutations(["block", "a", "b"])))
def test_a_paradox_names_its_contact_among_others(order: tuple[str, ...], which: str) -> None:
    """One of the rods has too much friction."""
    for mass, size in SCALES:
        rods = {"a": CALM, "b": CALM, which: CALM | {"mu": 1.5}}
        m, start = among_others((mass, size), order, rods)
        with pytest.raises(kp.SingularityError, match=f"paradox.*contact touch_{which} ") as told:
            kp.dynamics(m, start, t_end=1e-6 * np.sqrt(size / G))
        assert told.value.name == f"touch_{which}"


@pytest.mark.parametrize("which", ["a", "b"])
@pytest.mark.parametrize("order", list(itertools.permutations(["block", "a", "b"]))[1::2])
def test_a_paradox_on_the_way_names_its_contact_among_others(
    order: tuple[str, ...], which: str
) -> None:
    """One of the rods comes to a position in which its force grows without bound."""
    jams = {"mu": 3.63, "angle": 0.25, "spin": 1.44, "speed": -1.8}
    for mass, size in SCALES:
        m, start = rod(scale=(mass, size), **jams)
        time = np.sqrt(size / G)
        with pytest.raises(kp.SingularityError, match="paradox") as alone:
            kp.dynamics(m, start, t_end=3 * time)
        assert alone.value.t is not None
        assert alone.value.t > 0.05 * time
        m, start = among_others((mass, size), order, {"a": CALM, "b": CALM, which: jams})
        with pytest.raises(kp.SingularityError, match=f"paradox.*contact touch_{which} ") as told:
            kp.dynamics(m, start, t_end=3 * time)
        assert told.value.name == f"touch_{which}"
        assert told.value.t == pytest.approx(alone.value.t, rel=1e-4)
        sol, texts = run(m, start, t_end=alone.value.t * (1 + 1e-3), jam="impact")
        assert any(f"paradox (Painlevé) of touch_{which} at" in text for text in texts)
        found = {name: of.t for name, of in sol.events.items() if name.endswith(".paradox")}
        assert [name for name, t in found.items() if t.size] == [f"touch_{which}.paradox"]
        # the impact passes the other bodies by, which go on sliding
        hit = int(np.flatnonzero(np.diff(sol.t) == 0)[0])
        for name in order:
            rates = np.array([sol[f"{name}.{rate}"][hit : hit + 2] for rate in ("vx", "vy")])
            change = np.abs(np.diff(rates)).max() / np.sqrt(G * size)
            assert (change > 1e-3) == (name == which), (name, change)
        assert np.abs(sol.energy.balance).max() < 1e-6
