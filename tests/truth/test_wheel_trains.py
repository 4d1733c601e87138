"""Closed trains of wheels: which can be built, by counting pitches; phases and speeds."""

import math
import re
from fractions import Fraction

import kempe as kp
import numpy as np
import pytest

pytestmark = pytest.mark.filterwarnings("ignore::kempe.AssemblyWarning")
TURN = 2 * math.pi


def planetary(teeth, n, module, mass, offset=0.0):
    """A sun and a ring on ground with n planets of two wheels each.

    Sun z_s meshes with wheel z_a of a planet, the ring z_r with its wheel z_b.
    """
    z_s, z_a, z_b, z_r = teeth
    m = kp.Model(f"{teeth} {n}", redundancy="allow")
    arm = module * (z_s + z_a) / 2
    places = [TURN * k / n for k in range(n)]
    pins = {f"P{k}": (arm * math.cos(a), arm * math.sin(a)) for k, a in enumerate(places)}
    inertia = mass * arm**2
    m.ground.points(O=(0, 0))
    m.body("sun", mass=mass, inertia=inertia, points={"O": (0, 0)})
    m.body("carrier", mass=mass, inertia=inertia, points={"O": (0, 0), **pins})
    m.revolute("S", "ground.O", "sun.O")
    m.revolute("C", "ground.O", "carrier.O")
    for k in range(n):
        m.body(f"p{k}", mass=mass, inertia=inertia, points={"P": (0, 0)})
        m.revolute(f"P{k}", f"carrier.P{k}", f"p{k}.P")
        m.gear(f"s{k}", "sun.O", f"p{k}.P", teeth=(z_s, z_a), module=module)
        last = offset if k == n - 1 else 0.0
        m.gear(
            f"r{k}",
            "ground.O",
            f"p{k}.P",
            teeth=(z_r, z_b),
            module=module,
            internal=True,
            offset=last,
        )
    m.torque("motor", "sun", torque=mass * arm**2)
    return m


def planets_fit(teeth, n):
    """Whether one of the z_a meshes of each planet with the sun also meshes with the ring.

    The carrier turns the place of planet k by k/n turns, seen from the sun and the ring.
    """
    z_s, z_a, z_b, z_r = teeth
    fits = []
    for k in range(1, n):
        own = [Fraction(z_s * k, n * z_a) + Fraction(tooth, z_a) for tooth in range(z_a)]
        ring = [z_b * turned + Fraction(z_r * k, n) for turned in own]
        fits.append(any(x.denominator == 1 for x in ring))
    return all(fits)


def ring(kind, sizes, unit, gaps, **fields):
    """Wheels on ground around a polygon whose sides are the distances of their centres."""
    n = len(sizes)
    sides = [unit * (sizes[k] + sizes[(k + 1) % n]) / 2 * gaps for k in range(n)]
    low, high = max(sides) / 2, sum(sides)
    for _ in range(200):  # the radius of the circle around the polygon
        middle = (low + high) / 2
        around = sum(2 * math.asin(side / (2 * middle)) for side in sides)
        low, high = (middle, high) if around > TURN else (low, middle)
    steps = np.cumsum([0.0] + [2 * math.asin(side / (2 * high)) for side in sides[:-1]])
    centres = [(high * math.cos(a), high * math.sin(a)) for a in steps]
    m = kp.Model(f"{kind} {sizes}", redundancy="allow")
    m.ground.points(**{f"O{k}": at for k, at in enumerate(centres)})
    for k in range(n):
        m.body(f"w{k}", mass=1, inertia=unit**2, points={"C": (0, 0)})
        m.revolute(f"O{k}", f"ground.O{k}", f"w{k}.C")
    for k in range(n):
        j = (k + 1) % n
        own = {name: values[k] for name, values in fields.items()}
        size = {"radii": (unit * sizes[k] / 2, unit * sizes[j] / 2)}
        if kind == "teeth":
            size = {"teeth": (sizes[k], sizes[j]), "module": unit}
        of = m.belt if kind == "belt" else m.gear
        of(f"g{k}", f"w{k}.C", f"w{j}.C", **size, **own)
    return m, centres


def ring_fits(sizes, centres):
    """Whether the phases around a ring add up to whole pitches. An odd number of wheels locks."""
    n = len(sizes)
    if n % 2:
        return True
    total = 0.0
    for k in range(n):
        (x, y), (u, v) = centres[k], centres[(k + 1) % n]
        total += (-1) ** k * (sizes[k] + sizes[(k + 1) % n]) * math.atan2(v - y, u - x) / TURN
    return abs(total - round(total)) < 1e-6


def phases(state, names, sigma):
    """The phase of each pair of wheels, in pitches of teeth."""
    out = []
    for (i, j), (z_i, z_j) in names:
        d = np.subtract(*[[state[f"{b}.x"], state[f"{b}.y"]] for b in (j, i)])
        theta = math.atan2(d[1], d[0])
        turned = z_i * (state[f"{i}.angle"] - theta) + sigma * z_j * (state[f"{j}.angle"] - theta)
        out.append(turned / TURN)
    return np.array(out)


def built(m, **options):
    """The state, or the gear and the offset that close the train according to the message."""
    try:
        return kp.assemble(m, **options), None
    except kp.AssemblyError as error:
        found = re.search(r"the phase of (\w+) is off by.*offset = ([-+.e\d]+)", str(error), re.S)
        assert found, str(error)
        return None, (found[1], float(found[2]))


def logarithmic(rng):
    return 10.0 ** rng.uniform(-3, 3)


# the last three contain planets with two wheels that mesh in thousands of places around the centre
@pytest.mark.parametrize("seed", [*range(10), 16, 36, 38])
def test_planets_close_if_and_only_if_their_teeth_meet(seed):
    rng = np.random.default_rng([1, seed])
    seen = set()
    for _ in range(10):
        z_s, z_a = rng.integers(12, 40, 2)
        z_b = z_a if rng.random() < 0.6 else rng.integers(10, 30)
        teeth = tuple(int(z) for z in (z_s, z_a, z_b, z_s + z_a + z_b))
        n = int(rng.integers(3, 8))
        module, mass = logarithmic(rng), logarithmic(rng)
        m = planetary(teeth, n, module, mass)
        state, remedy = built(m)
        fits = planets_fit(teeth, n)
        assert (state is not None) == fits, (teeth, n, module, remedy)
        seen.add(fits)
        if state is None:
            continue
        assert kp.mobility(m, state).degrees_of_freedom == 1
        pairs = [(("sun", f"p{k}"), teeth[:2]) for k in range(n)]
        whole = phases(state, pairs, 1)
        assert np.abs(whole - np.round(whole)).max() < 1e-6
        # Willis: ω_carrier (1 + z_r z_a/(z_s z_b)) = ω_sun
        z_s, z_a, z_b, z_r = teeth
        carrier = 1 / (1 + z_r * z_a / (z_s * z_b))
        moving = kp.assemble(m, set={"sun.omega": 3.0})
        assert moving["carrier.omega"] == pytest.approx(3 * carrier, rel=1e-9)
        assert moving["p1.omega"] == pytest.approx(3 * carrier * (1 - z_r / z_b), rel=1e-9)
    assert seen == {True, False}


@pytest.mark.parametrize("kind", ["teeth", "radii", "belt"])
def test_rings_of_wheels(kind):
    rng = np.random.default_rng([2, len(kind)])
    seen = set()
    for _ in range(count_of(kind)):
        n, unit = int(rng.integers(4, 11)), logarithmic(rng)
        like = rng.random() < 0.5
        sizes = [int(z) for z in rng.integers(20, 41, n)]
        sizes = [sizes[k % 2] for k in range(n)] if like else sizes
        fields, gaps = {}, 1.0
        if kind == "belt":
            gaps, fields = 2.5, {"crossed": [bool(x) for x in rng.random(n) < 0.5]}
        m, centres = ring(kind, sizes, unit, gaps, **fields)
        state, remedy = built(m)
        fits = kind != "teeth" or ring_fits(sizes, centres)
        assert (state is not None) == fits, (sizes, remedy)
        seen.add((fits, n % 2))
        if state is None:
            name, offset = remedy
            offsets = [offset if name == f"g{k}" else 0.0 for k in range(n)]
            again, _ = ring(kind, sizes, unit, gaps, offset=offsets)
            state = kp.assemble(again)
            m = again
        reversals = sum(fields.get("crossed", [True] * n))
        assert kp.mobility(m, state).degrees_of_freedom == (reversals % 2 == 0)
        if reversals % 2 == 0:
            moving = kp.assemble(m, from_state=state, set={"w0.omega": 2.0})
            assert np.array_equal(moving.q, state.q)
            ratio = 2.0 * sizes[0] / np.array(sizes)
            speeds = np.abs([moving[f"w{k}.omega"] for k in range(n)])
            assert speeds == pytest.approx(ratio, rel=1e-9)
    assert len(seen) > 1


def count_of(kind):
    return 40 if kind == "teeth" else 30


def test_twenty_sixteen_fifty_two_with_three_planets_runs():
    teeth = (20, 16, 16, 52)
    m = planetary(teeth, 3, 0.002, 0.3)
    start = kp.assemble(m)
    arm = 0.002 * 18
    torque = inertia = 0.3 * arm**2
    carrier, planet = 1 / (1 + 52 / 20), 1 / (1 + 52 / 20) * (1 - 52 / 16)
    total = inertia + (inertia + 3 * 0.3 * arm**2) * carrier**2 + 3 * inertia * planet**2
    sol = kp.dynamics(m, start, t_end=2)
    assert sol["sun.omega"][-1] == pytest.approx(torque / total * 2, rel=1e-6)
    assert sol.drift.position.max() < 1e-9


def test_wheels_without_teeth_mesh_as_drawn():
    m = kp.Model("geared five-bar")
    m.ground.points(A=(0, 0), D=(3, 0))
    for name, point in (("c1", "A"), ("c2", "D")):
        m.body(name, mass=1, inertia=1, points={point: (0, 0)})
        m.revolute(point, f"ground.{point}", f"{name}.{point}")
    m.gear("G", "c1.A", "c2.D", radii=(1.5, 1.5))
    drawn = {"c1.angle": "60 deg", "c2.angle": "100 deg"}
    start = kp.assemble(m, set={**drawn, "c1.omega": 1})
    assert np.rad2deg([start["c1.angle"], start["c2.angle"]]) == pytest.approx([60, 100])
    sol = kp.dynamics(m, start, t_end=3)
    assert sol["c1.angle"] + sol["c2.angle"] == pytest.approx(np.deg2rad(160), abs=1e-9)
    assert sol.drift.position.max() < 1e-9
    over = kp.kinematics(m, start, over="c1.angle", range=[start["c1.angle"], 5], n=20)
    assert over["c2.angle"] == pytest.approx(np.deg2rad(160) - over["c1.angle"], abs=1e-9)
    # the phase of the drawing remains
    again = kp.assemble(m, from_state=sol.final, set={"c1.angle": "10 deg"})
    assert np.rad2deg(again["c2.angle"]) == pytest.approx(150)


def test_teeth_keep_whole_pitches_from_a_drawing():
    m = kp.Model("two gears")
    m.ground.points(A=(0, 0), D=(0.036, 0))
    for name, point in (("one", "A"), ("two", "D")):
        m.body(name, mass=1, inertia=1, points={point: (0, 0)})
        m.revolute(point, f"ground.{point}", f"{name}.{point}")
    m.gear("G", "one.A", "two.D", teeth=(20, 16), module="2 mm")
    start = kp.assemble(m, set={"one.angle": 0, "two.angle": "45 deg"})  # two teeth
    assert np.rad2deg(start["two.angle"]) == pytest.approx(45)
    with pytest.raises(kp.AssemblyError, match=r"phase of G is off by 3\.142 mm, 0\.5 of a pitch"):
        kp.assemble(m, set={"one.angle": 0, "two.angle": "56.25 deg"})
