"""Drivers whose effort has a limit, against closed forms and equations of motion stated here."""

from collections.abc import Callable

import kempe as kp
import numpy as np
import pytest
from scipy.optimize import brentq

EXACT = kp.DOP853(rtol=1e-12, atol=1e-14)
#: Masses in kg, lengths in m and rates in rad/s.
SCALES = [(1.0, 1.0, 1.0), (1e-3, 1e3, 0.1), (1e3, 1e-3, 300.0)]
KINDS = ["block.x", "slide.displacement", "block.P.x", "pin.angle"]


def driven(kind: str, *, mass: float, value: str, limit: float | str, load: str) -> kp.Model:
    """A block on a guide, or a disc on a pin, with a driver and a load; J = mass (1 m)^2."""
    m = kp.Model("drive", gravity=(0, 0))
    m.ground.points(O=(0, 0))
    m.body("block", mass=mass, inertia=mass, points={"P": (0, 0)})
    if kind == "pin.angle":
        m.revolute("pin", "ground.O", "block.P")
    else:
        m.translational("slide", "ground.O", "block.P")
    m.coordinate_driver("drive", kind, value=value, limit=limit)
    m.generalized_force("load", kind, value=load)
    return m


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("scale", SCALES)
def test_a_drive_that_is_braked_and_follows_again(
    kind: str, scale: tuple[float, float, float]
) -> None:
    mass, size, rate = scale
    size = 1.0 if kind == "pin.angle" else size
    unit = mass * size * rate**2
    # in these units: speed 3, limit 5, load -4 t until t = 2, mass 2
    m = driven(
        kind,
        mass=2 * mass,
        value=f"{3 * size * rate!r}*t",
        limit=5 * unit,
        load=f"if(t < {2 / rate!r}, -{4 * unit * rate!r}*t, 0)",
    )
    sol = kp.dynamics(m, kp.assemble(m), t_end=4 / rate, method=EXACT)
    # 4 t = 5; the speed falls by (5 - 4 t)/2, then rises by 5/2
    (saturated,), (follows,) = sol.events["drive.saturated"].t, sol.events["drive.follows"].t
    assert saturated * rate == pytest.approx(1.25, rel=1e-9)
    assert follows * rate == pytest.approx(2.225, rel=1e-9)
    lost = 0.75**3 / 3 + 0.5 * (9 / 16) * 0.225
    assert sol[kind][-1] / size == pytest.approx(12 - lost, rel=1e-9)
    at = sol(np.array([1.0, 2.1, 3.0]) / rate)
    np.testing.assert_allclose(at["drive.effort"] / unit, [4.0, 5.0, 0.0], atol=1e-9)
    speeds = np.array([3.0, 3 - 9 / 16 + 0.25, 3.0])
    np.testing.assert_allclose(
        at["drive.power"] / (unit * size * rate), [12.0, 5 * speeds[1], 0.0], atol=1e-8
    )
    # the works of drive and load are the kinetic energy
    assert abs(sol["energy.balance"]).max() <= 1e-11 * sol["energy.kinetic"].max()
    assert sol["drift.balance"].max() <= 1e-12


def truth(
    mass: float,
    law: tuple[float, float],
    load: tuple[float, float, float],
    limit: float,
    end: float,
) -> tuple[list[tuple[str, float]], float, float]:
    """Events, last position and last effort for x = A sin w t and the load B sin(u t + p)."""
    (a, w), (b, u, p) = law, load
    x, v = (lambda t: a * np.sin(w * t)), (lambda t: a * w * np.cos(w * t))
    need = lambda t: -mass * a * w * w * np.sin(w * t) - b * np.sin(u * t + p)  # noqa: E731

    def moved(since: float, t: float, sense: float) -> tuple[float, float]:
        """The change of the speed without the drive's law, and of the place without the speed."""
        phase, now = u * since + p, u * t + p
        speed = -b / u * (np.cos(now) - np.cos(phase))
        place = -b / u * ((np.sin(now) - np.sin(phase)) / u - np.cos(phase) * (t - since))
        pushed = sense * limit * (t - since)
        return (speed + pushed) / mass, (place + pushed * (t - since) / 2) / mass

    def first(f: Callable[[float], float], since: float) -> float | None:
        grid = np.linspace(since, end, 4001)
        values = np.array([f(t) for t in grid])
        ends = np.flatnonzero((values[:-1] > 0) & (values[1:] <= 0))
        return None if not len(ends) else brentq(f, grid[ends[0]], grid[ends[0] + 1], xtol=1e-15)

    events: list[tuple[str, float]] = []
    since, lag, sense = 0.0, 0.0, 0.0
    while True:
        if sense == 0.0:
            t = first(lambda t: limit - abs(need(t)), since)
            if t is None:
                return events, x(end) + lag, need(end)
            events.append(("saturated", t))
            since, sense = t, float(np.sign(need(t)))
            begun, speed = x(t) + lag, v(t)
            continue
        behind = lambda t: sense * (v(t) - speed - moved(since, t, sense)[0])  # noqa: E731, B023
        t = first(behind, since + 1e-7 * end)
        last = end if t is None else t
        place = begun + speed * (last - since) + moved(since, last, sense)[1]
        if t is None:
            return events, place, sense * limit
        begun, speed, since, lag = place, v(t), t, place - x(t)
        sense = float(np.sign(need(t))) if abs(need(t)) > limit else 0.0
        events.extend([("follows", t)] if sense == 0.0 else [])


@pytest.mark.parametrize("seed", range(12))
def test_random_drives_against_a_piecewise_solution(seed: int) -> None:
    draw = np.random.default_rng(seed)
    mass, size, w = (10 ** draw.uniform(*ends) for ends in ((-3, 3), (-3, 2), (-1, 1.5)))
    kind = KINDS[seed % 4]
    load = mass * size * w**2 * 10 ** draw.uniform(-1, 1)
    u, p, end = w * draw.uniform(0.3, 3), draw.uniform(-0.2, 0.2), 6 * np.pi / w
    t = np.linspace(0, end, 500)
    most = abs(mass * size * w**2 * np.sin(w * t) + load * np.sin(u * t + p)).max()
    limit = draw.uniform(0.35, 0.9) * most
    m = driven(
        kind,
        mass=mass,
        value=f"{size!r}*sin({w!r}*t)",
        limit=limit,
        load=f"{load!r}*sin({u!r}*t + {p!r})",
    )
    method = [kp.Auto(), kp.RK45(rtol=1e-9), kp.Radau(rtol=1e-9)][seed % 3]
    sol = kp.dynamics(m, kp.assemble(m), t_end=end, method=method)
    events, place, effort = truth(mass, (size, w), (load, u, p), limit, end)
    names = ("saturated", "follows")
    found = [(name, t) for name in names for t in sol.events[f"drive.{name}"].t]
    found.sort(key=lambda event: event[1])
    assert events
    assert [name for name, _ in found] == [name for name, _ in events]
    np.testing.assert_allclose(
        [t for _, t in found], [t for _, t in events], rtol=0, atol=1e-7 * end
    )
    assert sol[kind][-1] == pytest.approx(place, abs=1e-6 * max(size, abs(place)))
    assert sol["drive.effort"][-1] == pytest.approx(effort, abs=1e-5 * limit)


ARM = """
kempe = 1
gravity = [0, -9.81]
[parameters]
T1 = 9
T2 = 3
[bodies.ground]
points = { O = [0, 0] }
[bodies.upper]
type = "bar"
mass = 2
length = 0.4
ends = ["A", "B"]
[bodies.fore]
type = "bar"
mass = 1
length = 0.3
ends = ["B", "C"]
[joints.A]
type = "revolute"
i = "ground.O"
j = "upper.A"
[joints.B]
type = "revolute"
i = "upper.B"
j = "fore.B"
[drivers.shoulder]
type = "coordinate_driver"
coordinate = "A.angle"
value = "0.3 + 1.2*sin(3*t)"
limit = "T1"
[drivers.elbow]
type = "coordinate_driver"
coordinate = "B.angle"
value = "0.5 - sin(5*t)"
limit = "T2 - 0.1*abs(B.omega)"
[analyses.run]
type = "dynamics"
t_end = 4
"""


@pytest.fixture(scope="module")
def arm(tmp_path_factory: pytest.TempPathFactory) -> kp.Case:
    path = tmp_path_factory.mktemp("arm") / "arm.toml"
    path.write_text(ARM, encoding="utf-8")
    return kp.load(path)


@pytest.fixture(scope="module")
def swing(arm: kp.Case) -> kp.Solution:
    return arm.run()["run"]


def test_an_arm_with_two_limited_drives(swing: kp.Solution) -> None:
    # Lagrange's equations of two uniform bars
    at = swing(np.linspace(0, 4, 81))
    a, b, wa, wb = (at[name] for name in ("upper.angle", "fore.angle", "upper.omega", "fore.omega"))
    mixed = 1 * 0.4 * 0.3 / 2
    first = (2 / 3 + 1) * 0.16 * at["upper.alpha"] + 9.81 * (1 + 1) * 0.4 * np.cos(a)
    first += mixed * (np.cos(a - b) * at["fore.alpha"] + np.sin(a - b) * wb**2)
    second = 0.03 * at["fore.alpha"] + 9.81 * 0.15 * np.cos(b)
    second += mixed * (np.cos(a - b) * at["upper.alpha"] - np.sin(a - b) * wa**2)
    np.testing.assert_allclose(at["shoulder.effort"] - at["elbow.effort"], first, atol=1e-12)
    np.testing.assert_allclose(at["elbow.effort"], second, atol=1e-12)
    np.testing.assert_array_equal(at["elbow.torque"], at["elbow.effort"])
    # each drive is within its limit, and at it between its events
    limits = {"shoulder": 9 + 0 * wa, "elbow": 3 - 0.1 * abs(wb - wa)}
    laws = {"shoulder": 3.6 * np.cos(3 * at.t), "elbow": -5 * np.cos(5 * at.t)}
    for name, rate in (("shoulder", wa), ("elbow", wb - wa)):
        effort, slip = at[f"{name}.effort"], rate - laws[name]
        assert (abs(effort) <= limits[name] + 1e-10).all()
        begins, ends = (swing.events[f"{name}.{word}"].t for word in ("saturated", "follows"))
        inside = np.zeros(len(at.t), bool)
        for begin, end in zip(begins, [*ends, 5.0], strict=False):
            inside |= (at.t > begin + 1e-9) & (at.t < end - 1e-9)
        assert inside.any()
        assert not inside.all()
        np.testing.assert_allclose(abs(effort)[inside], limits[name][inside], rtol=1e-10)
        assert (effort * slip < 0)[inside].all()
        np.testing.assert_allclose(slip[~inside], 0, atol=1e-8)


def test_other_analyses_hold_the_law_with_any_effort(arm: kp.Case) -> None:
    start = kp.assemble(arm.model)
    moved = kp.kinematics(arm.model, start, t_end=4)
    with pytest.warns(kp.EventWarning) as told:
        needed = kp.inverse_dynamics(arm.model, start, t_end=4)
    for sol in (moved, needed):
        law = 0.3 + 1.2 * np.sin(3 * sol.t)
        np.testing.assert_allclose(sol["upper.angle"], law, rtol=0, atol=1e-12)
    efforts = {name: abs(needed[f"{name}.effort"]) for name in ("shoulder", "elbow")}
    k = efforts["shoulder"].argmax()
    assert efforts["shoulder"][k] > 12
    needs = f"shoulder needs {efforts['shoulder'][k]:.6g} N·m at t = {needed.t[k]:.6g} s"
    assert needs in str(told[0].message)
    beyond = [name for name in efforts if (efforts[name] > needed[f"{name}.limit"]).any()]
    assert len(told) == len(beyond)


PARTS = ("fx", "fy", "force", "torque")


def pushed(coordinate: str, law: str | None, sense: float = 1.0) -> kp.Model:
    """An arm with a limited driver, or with the force that its limit is."""
    m = kp.Model("arm", gravity=(0, -9.81), parameters={"L": 2.5})
    m.ground.points(O=(0, 0), S=(0.1, 0.6))
    m.bar("upper", mass=2, length=0.4, ends=("A", "B"))
    m.bar("fore", mass=1, length=0.3, ends=("B", "C"))
    m.revolute("A", "ground.O", "upper.A")
    m.revolute("B", "upper.B", "fore.B")
    m.spring_damper("gap", "upper.B", "ground.S", stiffness=20, free_length=0.3)
    if law is None:
        m.generalized_force("drive", coordinate, value=f"{sense}*L")
    else:
        m.coordinate_driver("drive", coordinate, value=law, limit="L")
    return m


@pytest.mark.parametrize(
    "coordinate", ["fore.x", "fore.C.x", "fore.angle", "B.angle", "gap.length"]
)
def test_a_saturated_drive_is_a_generalized_force(coordinate: str) -> None:
    begin = {"upper.angle": 0.4, "fore.angle": 0.9, "upper.omega": 1.0, "fore.omega": 1.5}
    free = pushed(coordinate, None)
    first = kp.assemble(free, set=begin)
    owner, word = coordinate.rsplit(".", 1)
    rate = {"x": "vx", "angle": "omega", "length": "rate"}[word]
    at, speed = float(first[coordinate]), float(first[f"{owner}.{rate}"])
    m = pushed(coordinate, f"{at!r} + {speed!r}*t + 200*t^2")
    other = "fore" if coordinate == "gap.length" else "upper"
    held = {name: x for name, x in begin.items() if other in name}
    guess = {name: x for name, x in begin.items() if "angle" in name and other not in name}
    start = kp.assemble(m, set=held, guess=guess)
    np.testing.assert_allclose(start.v, first.v, atol=1e-9)
    sol = kp.dynamics(m, start, t_end=0.05)
    assert sol.events["drive.saturated"].t.size == 0
    assert sol.events["drive.follows"].t.size == 0
    expected = kp.dynamics(free, first, t_end=0.05)
    np.testing.assert_allclose(sol.q[-1], expected.q[-1], atol=1e-10)
    for name in PARTS[:2]:
        there = expected[f"drive.{name}"][-1]
        np.testing.assert_allclose(sol[f"drive.{name}"][-1], there, atol=1e-9)
    # columns of sweeps are computed in the core
    measures = [f"drive.{name}.final" for name in ("effort", "power", "limit", *PARTS)]
    case = kp.Case(m, {"set": held, "guess": guess}, [kp.Dynamics(t_end=0.05)])
    row = kp.sweep(case, {"L": [2.5]}, measures).table.iloc[0]
    for measure in measures:
        own = sol[measure.removesuffix(".final")][-1]
        np.testing.assert_allclose(row[measure], own, rtol=1e-9, atol=1e-12)
    assert row["drive.effort.final"] == pytest.approx(2.5)


def test_slopes_through_saturation(arm: kp.Case, swing: kp.Solution) -> None:
    measures = ["upper.angle.final", "fore.angle.final", "shoulder.effort.rms", "A.force.max"]
    found = kp.gradient(arm, measures, ["T1", "T2"])
    assert not found.remarks
    step = 1e-4
    for k, (name, value) in enumerate((("T1", 9.0), ("T2", 3.0))):
        sides = kp.sweep(arm, {name: [value - step, value + step]}, measures).table
        slopes = [(sides[of][1] - sides[of][0]) / (2 * step) for of in measures]
        np.testing.assert_allclose(found.jacobian[:, k], slopes, rtol=2e-6, atol=1e-8)
    np.testing.assert_allclose(found.measures["upper.angle.final"], swing["upper.angle"][-1])


def test_steps_saved_states_and_continued_runs(arm: kp.Case, swing: kp.Solution) -> None:
    stepper = kp.Stepper(arm)
    stepper.step(1.5)
    assert stepper["shoulder.effort"] == pytest.approx(9)
    saved = stepper.save()
    stepper.step(1.0)
    stepper.restore(saved)
    stepper.step(2.5)
    assert stepper["upper.angle"] == pytest.approx(swing["upper.angle"][-1], abs=1e-9)
    half = kp.dynamics(arm.model, kp.assemble(arm.model), t_end=1.5)
    rest = kp.dynamics(arm.model, half.final, t_end=4)
    np.testing.assert_allclose(rest["fore.angle"][-1], swing["fore.angle"][-1], atol=1e-9)


def test_a_stop_a_release_and_a_limit() -> None:
    m = kp.Model("feed", gravity=(0, 0))
    m.ground.points(O=(0, 0))
    m.body("block", mass=2, inertia=1, points={"P": (0, 0)})
    m.translational("s", "ground.O", "block.P")
    feed = {"value": "0.2*sin(2*t)", "limit": 3, "release": "s.displacement < -0.1"}
    m.coordinate_driver("feed", "s.displacement", **feed)
    m.stop("end", "s.displacement", upper=0.1, restitution=0.3)
    sol = kp.dynamics(m, kp.assemble(m), t_end=3)
    # it hits at sin 2 t = 1/2, rests at the stop with the whole limit until the law turns, and
    # then follows with the lag of 0.1 m; there it is released with the speed 0.4 cos 2 t
    assert sol.events["end.hit"].t[0] == pytest.approx(np.pi / 12, rel=1e-10)
    assert sol.events["feed.saturated"].t == pytest.approx([np.pi / 12], rel=1e-10)
    assert sol.events["feed.follows"].t == pytest.approx([np.pi / 4], rel=1e-9)
    assert sol.events["feed.release"].t == pytest.approx([np.pi / 2], rel=1e-9)
    at = sol([0.6, 1.0, 2.0])
    np.testing.assert_allclose(at["feed.effort"], [3, -1.6 * np.sin(2), 0], atol=1e-9)
    falls = [0.1, 0.2 * np.sin(2) - 0.1, -0.1 - 0.4 * (2 - np.pi / 2)]
    np.testing.assert_allclose(at["s.displacement"], falls, atol=1e-9)


@pytest.mark.parametrize(
    ("kind", "limit", "words"),
    [
        ("pin.angle", -3, "drivers.drive.limit: -3; must not be negative"),
        ("pin.angle", "3 N", "must be in N*m"),
        ("block.x", "3 N*m", "must be in N"),
        ("block.x", "3*q", "unknown name 'q'"),
    ],
)
def test_impossible_limits_are_refused(kind: str, limit: float | str, words: str) -> None:
    with pytest.raises(kp.ModelError) as refused:
        driven(kind, mass=1, value="t", limit=limit, load="0").compile()
    assert words in str(refused.value)


def test_a_place_on_a_curve_has_no_limit() -> None:
    m = kp.Model("bead")
    m.ground.curves(wire={"circle": [0, 0, 1]})
    m.body("bead", mass=1, inertia=1, points={"P": (0, 0)})
    m.point_on_curve("slide", "bead.P", "ground.wire")
    m.coordinate_driver("drive", "slide.u", value="t", limit=1)
    with pytest.raises(kp.ModelError, match="no force acts along the place of a joint"):
        kp.assemble(m)


def test_a_law_that_uses_positions_has_no_limit() -> None:
    m = kp.Model("follower")
    m.ground.points(A=(0, 0), B=(1, 0))
    for name in "ab":
        m.body(name, mass=1, inertia=1, points={"O": (0, 0)})
    m.revolute("A", "ground.A", "a.O")
    m.revolute("B", "ground.B", "b.O")
    m.coordinate_driver("drive", "b.angle", value="2*a.angle", limit=5)
    with pytest.raises(kp.ModelError, match="uses positions, so that its effort acts on several"):
        kp.assemble(m)


def test_a_limit_may_depend_on_a_speed_that_a_brake_holds_at_zero() -> None:
    """The sign of the speed then has rounding errors only, and |omega| no bend that matters."""
    m = kp.Model("braked arm", gravity=(0, -115.00630750815647))
    m.ground.points(O=(0, 0))
    at, mass, inertia = 3.6684345656739937, 0.08581509319134406, 8.890295102732253
    ends = {"A": (-5.559662869635875, 0), "E": (5.559662869635875, 0)}
    m.body("b", mass=0.07955769973324336, inertia=11.74194531920777, points=ends)
    m.body("e", mass=mass, inertia=inertia, points={"A": (-at, 0)})
    for name, i, j in (("p", "ground.O", "b.A"), ("p2", "b.E", "e.A")):
        m.revolute(name, i, j)
    limit = "94.32753660502713-22.567646836699343*abs(b.omega)"
    m.coordinate_driver("drv", "b.angle", value="-0.32362861771748697*t", limit=limit)
    m.clutch("br", "ground", "b", capacity=24.819986421923364)
    start = kp.assemble(m, set={"e.angle": -1.3730156874726795, "e.omega": 0})
    sol = kp.dynamics(m, start, t_end=3.4507153234490042)
    held = sol.t > sol.events["br.stick"].t[-1]  # the outer body is then a pendulum
    assert held.sum() > 5 and np.all(np.abs(sol["b.omega"][held]) < 1e-9)
    fall = mass * 115.00630750815647 * at * np.sin(sol["e.angle"][held])
    energy = (inertia + mass * at**2) * sol["e.omega"][held] ** 2 / 2 + fall
    assert np.ptp(energy) < 1e-6 * np.abs(fall).max()
