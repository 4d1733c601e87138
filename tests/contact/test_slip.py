"""Wheels that slip on a line and belts that slip, stretch or hang loose.

They are compared with closed forms and with motions of the tests' own.
"""

from collections.abc import Callable
from typing import Any

import kempe as kp
import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp

EXACT = kp.DOP853(rtol=1e-11, atol=1e-13)
#: Masses in kg, sizes in m, rates in 1/s.
SCALES = [(1.0, 1.0, 1.0), (1e-3, 1e-3, 100.0), (1e3, 1e3, 0.01)]
Scale = tuple[float, float, float]


def at_rest(m: kp.Model, **rates: float) -> kp.State:
    """The start with all angles at zero and the given rates, such as `a_omega`."""
    given = {name.replace("_", "."): value for name, value in rates.items()}
    turning = {f"{name}.{of}": 0.0 for name in ("a", "b", "w") for of in ("angle", "omega")}
    known = {name: x for name, x in turning.items() if name.split(".")[0] in m.bodies}
    return kp.assemble(m, known | given)


def slopes(scale: Scale, friction: float, tilt: float, side: float = 1.0, **more: Any) -> kp.Model:
    """A disc on a line that falls to the right at the angle `tilt`."""
    mass, size, rate = scale
    m = kp.Model("slope", gravity=(0, -size * rate**2))
    m.ground.points(O=(0, 0))
    m.body("w", mass=mass, inertia=0.5 * mass * size**2, points={"C": (0, 0)})
    axis = -tilt if side > 0 else np.pi - tilt
    fields = {"radius": side * size, "axis": axis, "friction": friction, **more}
    m.rolling("road", "ground.O", "w.C", **fields)
    return m


@pytest.mark.parametrize("scale", SCALES)
@pytest.mark.parametrize("side", [1.0, -1.0])
@pytest.mark.parametrize("tilt", [0.1, 0.4, 0.8])
def test_a_disc_on_a_slope_slips_where_its_tangent_is_above_three_coefficients(
    scale: Scale, side: float, tilt: float
) -> None:
    mass, size, rate = scale
    friction, end = 0.1, 2 / rate
    m = slopes(scale, friction, tilt, side)
    start = {"w.x": np.sin(tilt) * size, "w.vx": 0.0, "w.angle": 0.0, "w.omega": 0.0}
    sol = kp.dynamics(m, kp.assemble(m, start), t_end=end, method=EXACT)
    g, slips = size * rate**2, np.tan(tilt) > 3 * friction
    force = friction * np.cos(tilt) if slips else np.sin(tilt) / 3
    moved = 0.5 * g * (np.sin(tilt) - force) * end**2
    assert_allclose(sol["w.x"][-1] - sol["w.x"][0], moved * np.cos(tilt), rtol=1e-10)
    assert_allclose(sol["w.angle"][-1], -force * rate**2 * end**2, rtol=1e-10)
    along = side * force * mass * g
    assert_allclose(sol["road.tangential"], along, rtol=1e-10)
    assert_allclose(sol["road.sticking"], 0.0 if slips else 1.0)
    slid = side * (moved - force * size * rate**2 * end**2) if slips else 0.0
    assert_allclose(sol["road.slipped"][-1] - sol["road.slipped"][0], slid, atol=1e-9 * size)
    # the reaction has the friction: it balances the weight and the acceleration
    on_wheel = sol["road"].force(on="w", frame="global")
    assert_allclose(on_wheel[:, 1], mass * (g + sol["w.ay"]), rtol=1e-9)
    assert_allclose(on_wheel[:, 0], mass * sol["w.ax"], rtol=1e-9, atol=1e-9 * mass * g)


@pytest.mark.parametrize("scale", SCALES)
def test_a_wheel_rolls_up_to_static_and_slides_with_friction(scale: Scale) -> None:
    mass, size, _ = scale
    for tilt, sticks in ((0.55, 1.0), (0.58, 0.0)):
        m = slopes(scale, 0.1, tilt, static=np.tan(0.565) / 3)
        start = kp.assemble(m, {"w.x": 0.0, "w.vx": 0.0, "w.angle": 0.0, "w.omega": 0.0})
        assert start["road.sticking"] == sticks
        assert_allclose(start["road.slipped"], 0.0, atol=2 * size)
        rest = start["road.tangential"]
        g = mass * size * scale[2] ** 2
        assert_allclose(rest, (np.sin(tilt) / 3 if sticks else 0.1 * np.cos(tilt)) * g, rtol=1e-10)


@pytest.mark.parametrize("scale", SCALES)
def test_a_ball_that_is_thrown_along_a_lane_rolls_after_a_time(scale: Scale) -> None:
    mass, size, rate = scale
    m = slopes(scale, 0.2, 0.0)
    speed = 2 * size * rate
    start = kp.assemble(m, {"w.x": 0.0, "w.vx": speed, "w.angle": 0.0, "w.omega": 0.0})
    sol = kp.dynamics(m, start, t_end=10 / rate, method=EXACT)
    assert_allclose(sol.events["road.stick"].t, [speed / (3 * 0.2 * size * rate**2)], rtol=1e-10)
    assert_allclose(sol["w.vx"][-1], 2 / 3 * speed, rtol=1e-10)
    lost = 0.5 * mass * speed**2 / 3
    assert_allclose(sol.energy.dissipated[-1], lost, rtol=1e-9)


def stick_and_slip(
    driven: Callable[[float], float], most: Callable[[float], float], response: float, end: float
) -> tuple[float, list[float]]:
    """∫ F dt of the friction F between two parts at rest, and the times of its changes.

    Their relative acceleration is F × response - driven(t). |F| is at most most(t).
    """
    t, sliding, impulse, times = 0.0, 0.0, 0.0, [0.0]
    sense = 0.0
    while t < end - 1e-12:
        if sense == 0.0:

            def slips(t: float, _: Any) -> float:
                return float(most(t) - abs(driven(t)) / response)

            def force(t: float, _: Any) -> float:
                return driven(t) / response
        else:

            def slips(_: float, y: Any, sense: float = sense) -> float:
                return float(sense * y[1])

            def force(t: float, _: Any, sense: float = sense) -> float:
                return -sense * most(t)

        slips.terminal, slips.direction = True, -1  # type: ignore[attr-defined]

        def rates(t: float, y: Any, force: Any = force) -> list[float]:
            return [force(t, y), force(t, y) * response - driven(t)]

        nudge = 1e-9 * end
        found = solve_ivp(
            rates, (t, end), (impulse, sliding), "DOP853", None, False, slips,
            rtol=1e-11, atol=1e-13, max_step=end / 200, first_step=nudge,
        )  # fmt: skip
        t, (impulse, sliding) = found.t[-1], found.y[:, -1]
        if not found.t_events[0].size:
            break
        times.append(t)
        if sense == 0.0:
            sense = -np.sign(driven(t))
        else:
            sliding = 0.0
            stays = abs(driven(t)) / response <= most(t)
            sense = 0.0 if stays else -np.sign(driven(t))
        if sense:
            step = 1e-7 * end
            push = -sense * most(t)
            impulse, sliding, t = (
                impulse + push * step,
                sliding + (push * response - driven(t)) * step,
                t + step,
            )
    return impulse, times[1:]


@pytest.mark.parametrize("scale", SCALES)
@pytest.mark.parametrize("reach", [0.35, 0.8])
def test_a_wheel_on_a_plate_that_shakes_in_both_directions(scale: Scale, reach: float) -> None:
    """The plate shakes along and across its line, so that the normal force varies."""
    mass, size, rate = scale
    m = kp.Model("plate", gravity=(0, -size * rate**2), parameters={"s": size, "w": rate})
    m.body("a", mass=mass, inertia=mass * size**2, points={"O": (0, 0)})
    m.body("w", mass=mass, inertia=0.4 * mass * size**2, points={"C": (0, 0)})
    m.rolling("road", "a.O", "w.C", radius="s", friction=0.15)
    m.coordinate_driver("turn", "a.angle", value=0)
    m.coordinate_driver("along", "a.x", value=f"{reach}*s*sin(w*t) - {reach}*s*w*t")
    m.coordinate_driver("up", "a.y", value="0.2*s*cos(1.7*w*t)")
    start = kp.assemble(m, {"w.x": 0.0, "w.vx": 0.0, "w.angle": 0.0, "w.omega": 0.0})
    end = 12 / rate
    sol = kp.dynamics(m, start, t_end=end, method=EXACT)

    def driven(t: float) -> float:
        return float(-reach * size * rate**2 * np.sin(rate * t))

    def most(t: float) -> float:
        return float(0.15 * mass * size * rate**2 * (1 - 0.2 * 1.7**2 * np.cos(1.7 * rate * t)))

    response = (1 + 1 / 0.4) / mass
    impulse, times = stick_and_slip(driven, most, response, end)
    assert len(times) > 3
    found = np.sort(np.concatenate([sol.events["road.stick"].t, sol.events["road.slip"].t]))
    # reversals without sticking are not events, but the own motion counts them
    for t in found:
        assert np.min(np.abs(np.array(times) - t)) < 2e-6 * end
    assert_allclose(sol["w.vx"][-1], impulse / mass, rtol=2e-6)
    assert_allclose(sol["w.omega"][-1], impulse / (0.4 * mass * size), rtol=2e-6)


def drive(scale: Scale, at: tuple[float, float] = (1, 0), **fields: Any) -> kp.Model:
    """Pulleys of 0.1 and 0.25 m, 0.8 m apart in the direction `at`, and a torque of 20 t N·m."""
    mass, size, rate = scale
    torque = mass * size**2 * rate**2
    m = kp.Model("drive", parameters={"T": torque, "w": rate})
    m.ground.points(O=(0, 0), Q=(0.8 * size * at[0], 0.8 * size * at[1]))
    for name, inertia, point in (("a", 0.02, "O"), ("b", 0.1, "Q")):
        m.body(name, mass=mass, inertia=inertia * mass * size**2, points={"C": (0, 0)})
        m.revolute(f"pin_{name}", f"ground.{point}", f"{name}.C")
    m.belt("belt", "a.C", "b.C", radii=(0.1 * size, 0.25 * size), **fields)
    m.torque("drive", j="a", torque="20*T*w*t")
    return m


#: Centres in several directions, with θ at its branch cut.
DIRECTIONS = [(1.0, 0.0), (0.0, -1.0), (-0.6, 0.8), (-1.0, 0.0)]


@pytest.mark.parametrize("scale", SCALES)
@pytest.mark.parametrize("crossed", [False, True])
def test_a_belt_slips_at_the_ratio_of_euler_and_eytelwein(scale: Scale, crossed: bool) -> None:
    mass, size, rate = scale
    force = mass * size * rate**2
    sine = (0.1 + (0.25 if crossed else -0.25)) / 0.8
    wrap = np.pi + 2 * (np.arcsin(sine) if crossed else -abs(np.arcsin(sine)))
    ratio = np.exp(0.2 * wrap)
    most = 200 * (ratio - 1) / (ratio + 1)
    both = 0.02 + 0.1 * 0.4**2
    for at in DIRECTIONS:
        m = drive(scale, at, preload=100 * force, friction=0.2, crossed=crossed)
        sol = kp.dynamics(m, at_rest(m), t_end=1.5 / rate, method=EXACT)
        # λ r = T - J α while the belt does not slip
        slips = most * 0.1 / (20 * (1 - 0.02 / both)) / rate
        assert_allclose(sol.events["belt.slip"].t, [slips], rtol=1e-9)
        assert_allclose(sol["belt.tight"][-1] / sol["belt.loose"][-1], ratio, rtol=1e-10)
        assert_allclose(sol["belt.tight"] + sol["belt.loose"], 200 * force, rtol=1e-10)
        assert_allclose(sol["belt.tangential"][-1], most * force, rtol=1e-10)
        sense = -1 if crossed else 1
        end, left = sol.t[-1], sol.t[-1] - slips
        omega_b = sense * (5 * 0.4 * 2 * slips**2 / both * rate**3 + 2.5 * most * left * rate**2)
        assert_allclose(sol["b.omega"][-1], omega_b, rtol=1e-9)
        omega_a = (10 * (end**2 - slips**2) * rate**3 - most * 0.1 * left * rate**2) / 0.02
        omega_a += 10 * slips**2 * rate**3 / both
        assert_allclose(sol["a.omega"][-1], omega_a, rtol=1e-9)
        sliding = size * (0.1 * omega_a - sense * 0.25 * omega_b)
        assert_allclose(sol["belt.sliding"][-1], sliding, rtol=1e-9)
        # the pins carry both strands, along the line of centres and across it
        pull = np.array(
            [200 * np.sqrt(1 - sine**2), -most * sine] @ np.array([at, (-at[1], at[0])])
        )
        on_wheel = sol["pin_a"].force(on="a", frame="global")[-1]
        assert_allclose(-on_wheel, pull * force, rtol=1e-9, atol=1e-9 * force)
        assert sol.summary["newton_euler"] < 1e-12


@pytest.mark.parametrize("scale", SCALES)
@pytest.mark.parametrize(("fields", "free"), [({"preload": 30.0}, 30.0), ({"slack": 0.004}, -80.0)])
def test_elastic_strands_against_an_own_motion(
    scale: Scale, fields: dict[str, float], free: float
) -> None:
    """The load is so large that a strand hangs loose for part of the time."""
    mass, size, rate = scale
    force, stiffness = mass * size * rate**2, 2e4
    given = {name: x * (force if name == "preload" else size) for name, x in fields.items()}
    m = drive(scale, stiffness=stiffness * force / size, **given)
    end = 1 / rate
    sol = kp.dynamics(m, at_rest(m), t_end=end, method=EXACT)

    def strands(y: np.ndarray) -> np.ndarray:
        phi = 0.1 * y[0] - 0.25 * y[1]
        return np.maximum(0, free + stiffness * np.array([phi, -phi]))

    def rates(t: float, y: np.ndarray) -> list[float]:
        first, second = strands(y)
        turning = (20 * t - 0.1 * (first - second)) / 0.02, 0.25 * (first - second) / 0.1
        return [y[2], y[3], *turning]

    own = solve_ivp(rates, (0, 1), np.zeros(4), rtol=1e-10, atol=1e-12, max_step=1e-3)
    last = own.y[:, -1]
    assert_allclose([sol["a.angle"][-1], sol["b.angle"][-1]], last[:2], rtol=1e-7)
    assert_allclose(sol["b.omega"][-1], last[3] * rate, rtol=1e-6)
    assert_allclose(sol["belt.tight"][-1], max(strands(last)) * force, rtol=1e-5)
    assert_allclose(sol["belt.loose"][-1], min(strands(last)) * force, atol=1e-5 * 100 * force)
    assert (sol["belt.loose"] == 0).any()
    assert sol.summary["energy"]["largest_imbalance"] < 1e-8


@pytest.mark.parametrize("scale", SCALES)
def test_a_loose_belt_pulls_at_the_end_of_its_slack(scale: Scale) -> None:
    _, size, rate = scale
    m = drive(scale, slack=0.004 * size)
    sol = kp.dynamics(m, at_rest(m), t_end=1 / rate, method=EXACT)
    # the slack is 0.1 m × 10 T w t³/(3 J); after the impact, both turn together
    hit = (0.04 * 3 * 0.02 / 10) ** (1 / 3)
    assert_allclose(sol.events["belt.hit"].t, [hit / rate], rtol=1e-9)
    both = 0.02 + 0.1 * 0.4**2
    assert_allclose(sol["a.omega"][-1], 10 / both * rate, rtol=1e-9)
    assert_allclose(sol["b.omega"][-1], 0.4 * 10 / both * rate, rtol=1e-9)


def test_a_planet_on_a_belt_that_slips_passes_the_branch_of_the_direction() -> None:
    """An arm turns with constant speed; the belt of a fixed pulley carries its wheel along."""
    m = kp.Model("planet", parameters={"w": 3})
    m.ground.points(O=(0, 0))
    m.body("arm", points={"O": (0, 0), "Q": (0.8, 0)}, mass=1, inertia=1)
    m.body("b", mass=1, inertia=0.1, points={"C": (0, 0)})
    m.revolute("O", "ground.O", "arm.O")
    m.revolute("Q", "arm.Q", "b.C")
    m.coordinate_driver("turn", "arm.angle", value="w*t")
    m.belt("belt", "ground.O", "b.C", radii=(0.1, 0.25), preload=2, friction=0.3)
    start = kp.assemble(m, {"b.angle": 0, "b.omega": 0})
    sol = kp.dynamics(m, start, t_end=8, method=EXACT)
    # without slip, 0.1 (0 - w) - 0.25 (ω - w) = 0
    end = 3 * (1 - 0.1 / 0.25)
    wrap = np.pi - 2 * np.arcsin(0.15 / 0.8)
    most = 4 * np.tanh(0.15 * wrap)
    assert_allclose(sol.events["belt.stick"].t, [end / (0.25 * most / 0.1)], rtol=1e-9)
    assert_allclose(sol["b.omega"][-1], end, rtol=1e-9)
    assert not sol.events["belt.slip"].t.size


REFUSED = [
    ({"preload": 10}, "belt.preload: needs friction or stiffness", {"friction": 0.2}),
    ({"friction": 0.3}, "belt.friction: needs preload", {"preload": 3}),
    ({"preload": 1, "stiffness": 1, "friction": 1}, "not together with stiffness", None),
    ({"stiffness": 1, "preload": 1, "slack": 1}, "not together with preload", None),
    ({"slack": -1}, "belt.slack: must be > 0", None),
]


@pytest.mark.parametrize(("fields", "message", "remedy"), REFUSED)
def test_fields_that_do_not_fit(
    fields: dict[str, float], message: str, remedy: dict[str, float] | None
) -> None:
    with pytest.raises(kp.ModelError, match=message):
        kp.assemble(drive(SCALES[0], **fields))
    if remedy:
        kp.assemble(drive(SCALES[0], **fields, **remedy))


@pytest.mark.parametrize(
    ("fields", "message"),
    [
        ({"friction": -1}, "road.friction: must not be negative"),
        ({"friction": 0.2, "static": 0.1}, "road.static: must not be below friction"),
        ({"friction": None, "static": 0.1}, "road.static: needs friction"),
    ],
)
def test_coefficients_that_do_not_fit(fields: dict[str, Any], message: str) -> None:
    with pytest.raises(kp.ModelError, match=message):
        kp.assemble(slopes(SCALES[0], fields.pop("friction"), 0.1, **fields))


@pytest.mark.parametrize("scale", SCALES)
@pytest.mark.parametrize("fields", [{"stiffness": 1e4}, {"stiffness": 5e3, "preload": 200}])
def test_an_elastic_belt_counts_the_turns_of_nearly_equal_wheels(
    scale: Scale, fields: dict[str, float]
) -> None:
    """Its stretch is many times the change of the equation by a turn of the line of centres."""
    mass, size, rate = scale
    force = mass * size * rate**2
    units = {"stiffness": force / size, "preload": force}
    given = {name: x * units[name] for name, x in fields.items()}
    ends = []
    for other in (0.1, 0.1 * (1 + 1e-6)):
        m = kp.Model("drive")
        m.body("frame", mass=mass, inertia=mass * size**2, points={"A": (0, 0), "B": (0, size / 2)})
        m.ground.points(A=(0, 0))
        m.revolute("O", "ground.A", "frame.A")
        m.coordinate_driver("turn", "frame.angle", value=f"{20 * rate!r}*t")
        for name, point in (("a", "A"), ("b", "B")):
            m.body(name, mass=mass, inertia=0.02 * mass * size**2, points={"C": (0, 0)})
            m.revolute(point, f"frame.{point}", f"{name}.C")
        radii = (0.1 * size, other * size)
        m.belt("belt", "a.C", "b.C", radii=radii, offset=np.pi / 2 * (radii[1] - radii[0]), **given)
        m.torque("drive", j="a", torque=2 * force * size)
        sol = kp.dynamics(m, at_rest(m), t_end=0.5 / rate, method=EXACT)
        ends.append([sol["a.angle"][-1], sol["b.angle"][-1], sol["belt.tight"][-1] / force])
        # 2 x'' = 100 T x: half of the torque stretches the strands, around which the wheels swing
        both = sol["a.angle"][-1] + sol["b.angle"][-1]
        assert_allclose(both, 0.5 * 100 * 0.25, rtol=1e-4)
    assert_allclose(*ends, rtol=1e-3)


def test_belts_that_cannot_act() -> None:
    def made(radii: tuple[float, float], carried: bool = True, **fields: Any) -> kp.Model:
        m = kp.Model("belt")
        m.ground.points(O=(0, 0), Q=(0.5, 0), R=(0.5, 0))
        for name, point in (("a", "O"), ("b", "Q")):
            m.body(name, mass=1, inertia=1, points={"C": (0, 0), "D": (0, 0)})
            m.revolute(f"pin_{name}", f"ground.{point}", f"{name}.{'C' if carried else 'D'}")
        m.belt("belt", "a.C", "b.C", radii=radii, **fields)
        return m

    with pytest.raises(kp.ModelError, match="half a turn of the line of centres; other"):
        kp.assemble(made((0.1, 0.1005), slack=0.002))
    kp.assemble(made((0.1, 0.1005), slack=0.002, stiffness=1e5))
    kp.assemble(made((0.1, 0.1005), slack=0.0015))
    with pytest.raises(kp.KempeError, match="neither wheel lies within the other"):
        kp.assemble(made((0.1, 0.7), preload=8, friction=0.4))
    with pytest.raises(kp.ModelError, match=r"belt\.stiffness: an elastic belt needs both wheels"):
        kp.assemble(made((0.1, 0.2), carried=False, stiffness=1e4))
