"""Gears and racks with backlash against closed forms and a motion of the test's own."""

from typing import Any

import kempe as kp
import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp

EXACT = kp.DOP853(rtol=1e-12, atol=1e-14)
#: Masses in kg, sizes in m, rates in 1/s.
SCALES = [(1.0, 1.0, 1.0), (1e-3, 1e-3, 100.0), (1e3, 1e3, 0.01)]


def gears(
    scale: tuple[float, float, float],
    internal: bool = False,
    at: tuple[float, float] = (1, 0),
    e: float = 0.0,
    **fields: Any,
) -> kp.Model:
    """Two wheels of 0.2 and 0.5 m on ground; the second centre is in the direction `at`."""
    mass, size, _ = scale
    m = kp.Model("wheels", gravity=(0, 0), parameters={"b": 1e-3 * size, "e": e})
    radii = (0.2 * size, 0.5 * size)
    d = (radii[1] - radii[0]) if internal else sum(radii)
    place = np.array(at) / np.hypot(*at) * d
    m.ground.points(O=(0, 0), Q=tuple(place))
    for name, inertia, point in (("i", 0.03, "O"), ("j", 0.4, "Q")):
        m.body(name, mass=mass, inertia=inertia * mass * size**2, points={"O": (0, 0)})
        m.revolute(f"pin_{name}", f"ground.{point}", f"{name}.O")
    given: dict[str, Any] = {
        "radii": radii,
        "internal": internal,
        "backlash": "b",
        "restitution": "e",
        **fields,
    }
    # at the start, the teeth are in the middle of their play for any direction of the centres
    angle = np.arctan2(place[1], place[0])
    sigma = -1 if internal else 1
    given.setdefault("offset", -(radii[0] + sigma * radii[1]) * angle)
    m.gear("teeth", "i.O", "j.O", **given)
    return m


DIRECTIONS = [(1, 0), (-1, 0), (-1, -1e-17), (0, -1), (-0.6, 0.8)]


@pytest.mark.parametrize("scale", SCALES)
@pytest.mark.parametrize("internal", [False, True])
@pytest.mark.parametrize("restitution", [0.0, 0.6, 1.0])
def test_a_hit_of_the_flanks(
    scale: tuple[float, float, float], internal: bool, restitution: float
) -> None:
    _, size, rate = scale
    sigma = -1 if internal else 1
    for at in DIRECTIONS:
        m = gears(scale, internal, at, restitution=restitution)
        start = kp.assemble(m, {"i.angle": 0, "j.angle": 0, "i.omega": rate, "j.omega": 0})
        first = 0.5e-3 / 0.2 / rate
        sol = kp.dynamics(m, start, t_end=1.5 * first, method=EXACT)
        (hit,) = sol.events["teeth.hit"].t
        assert hit == pytest.approx(first, rel=1e-10)
        # the pitch speeds r_i ω_i + σ r_j ω_j before and after, with one impulse between the teeth
        inertias = np.array([0.03, 0.4])
        arms = np.array([0.2, sigma * 0.5])
        mobility = arms @ (arms / inertias)
        impulse = (1 + restitution) * 0.2 * rate / mobility
        after = np.array([rate, 0.0]) - impulse * arms / inertias
        assert_allclose(sol["i.omega"][-1], after[0], rtol=1e-9)
        assert_allclose(sol["j.omega"][-1], after[1], rtol=1e-9)
        assert_allclose(sol["teeth.play"][0], 0, atol=1e-12 * size)
        if restitution == 0:
            assert_allclose(sol["teeth.gap"][-1], 0, atol=1e-12 * size)


@pytest.mark.parametrize("scale", SCALES)
def test_teeth_that_stay_in_contact_carry_the_force_of_a_gear(
    scale: tuple[float, float, float],
) -> None:
    mass, size, rate = scale
    torque = mass * size**2 * rate**2
    tangential = {}
    for backlash in ("b", 0):
        m = gears(scale, backlash=backlash, restitution="e" if backlash else 0)
        m.generalized_force("drive", "i.angle", value=2 * torque)
        m.generalized_force("brake", "j.angle", value=3 * torque)
        rest = {"i.angle": 0, "i.omega": 0}
        free = {"j.angle": 0, "j.omega": 0} if backlash else {}
        sol = kp.dynamics(m, kp.assemble(m, {**rest, **free}), t_end=3 / rate, method=EXACT)
        tangential[backlash] = sol["teeth.tangential"][-1]
        assert sol.newton_euler.largest < 1e-9
        assert_allclose(sol.energy.balance, 0, atol=1e-9)
    # J_i α_i = T_i - λ r_i, J_j α_j = T_j - λ r_j, r_i α_i + r_j α_j = 0
    alpha = np.array([2 / 0.03, 3 / 0.4]) * torque / (mass * size**2)
    arms = np.array([0.2, 0.5]) * size
    truth = arms @ alpha / (arms @ (arms / (np.array([0.03, 0.4]) * mass * size**2)))
    assert_allclose(list(tangential.values()), truth, rtol=1e-9)


def test_rattling_under_a_torque_that_alternates() -> None:
    """A torque swings the driving wheel, and the driven one rattles as in the own motion."""
    m = gears(SCALES[0], restitution=1, backlash=0.02)
    m.generalized_force("drive", "i.angle", value="0.6*sin(7*t)")
    start = kp.assemble(m, {"i.angle": 0, "j.angle": 0, "i.omega": 0, "j.omega": 0})
    sol = kp.dynamics(m, start, t_end=3.0, output_step=0.01, method=EXACT)
    inertias, arms = np.array([0.03, 0.4]), np.array([0.2, 0.5])

    def slopes(t: float, y: Any) -> Any:
        return [*y[2:], 0.6 * np.sin(7 * t) / inertias[0], 0.0]

    def limit(sign: float) -> Any:
        def margin(_: float, y: Any) -> Any:
            return 0.01 - sign * (arms @ y[:2])

        margin.terminal, margin.direction = True, -1
        return margin

    t, y, hits = 0.0, np.zeros(4), []
    while t < 3.0:
        options: Any = {"rtol": 1e-12, "atol": 1e-14, "events": [limit(1), limit(-1)]}
        part = solve_ivp(slopes, (t, 3.0), y, method="DOP853", **options)
        t, y = part.t[-1], part.y[:, -1]
        if part.status == 1:
            hits.append(t)
            impulse = 2 * (arms @ y[2:]) / (arms @ (arms / inertias))
            y[2:] -= impulse * arms / inertias
    assert len(hits) > 5
    assert_allclose(sol.events["teeth.hit"].t, hits, rtol=0, atol=1e-8)
    assert_allclose(sol["j.angle"][-1], y[1], rtol=0, atol=1e-8)
    assert np.abs(sol["teeth.play"]).max() <= 0.01 + 1e-12


@pytest.mark.parametrize("scale", SCALES)
def test_a_planet_carrier_turns_through_the_branch_of_the_direction(
    scale: tuple[float, float, float],
) -> None:
    """An arm with a loose planet turns twice about a fixed wheel: the planet hits once.

    In the frame of the arm, the planet has the speed ω_j - ω, and the fixed wheel -ω.
    """
    mass, size, rate = scale
    m = kp.Model("planet", gravity=(0, 0))
    m.ground.points(O=(0, 0))
    m.body("sun", mass=mass, inertia=mass * size**2, points={"O": (0, 0)})
    m.weld("fixed", "ground.O", "sun.O")
    m.body("arm", mass=0, inertia=0, points={"O": (0, 0), "Q": (0.7 * size, 0)})
    m.revolute("centre", "ground.O", "arm.O")
    m.body("planet", mass=mass, inertia=0.4 * mass * size**2, points={"O": (0, 0)})
    m.revolute("pin", "arm.Q", "planet.O")
    m.gear("teeth", "sun.O", "planet.O", radii=(0.2 * size, 0.5 * size), backlash=1e-3 * size)
    m.coordinate_driver("turn", "arm.angle", value=f"{rate} * t")
    start = kp.assemble(m, {"planet.angle": 0, "planet.omega": 0})
    sol = kp.dynamics(m, start, t_end=4 * np.pi / rate, method=EXACT)
    # the pitch speed is -0.2 ω + 0.5 (ω_j - ω): the flanks meet after b/2 / (0.7 ω)
    (hit,) = sol.events["teeth.hit"].t
    assert hit == pytest.approx(0.5e-3 / 0.7 / rate, rel=1e-9)
    assert_allclose(sol["planet.omega"][-1], 1.4 * rate, rtol=1e-9)
    assert_allclose(sol["teeth.gap"][-1], 0, atol=1e-11 * size)


@pytest.mark.parametrize("scale", SCALES)
def test_a_rack_with_backlash(scale: tuple[float, float, float]) -> None:
    mass, size, rate = scale
    m = kp.Model("rack", gravity=(0, 0))
    m.ground.points(O=(0, 0), C=(0, 0.1 * size))
    m.body("bar", mass=mass, inertia=mass * size**2, points={"P": (0, 0)})
    m.translational("guide", "ground.O", "bar.P")
    m.body("pinion", mass=mass, inertia=2e-3 * mass * size**2, points={"C": (0, 0)})
    m.revolute("pin", "ground.C", "pinion.C")
    m.rack("teeth", "bar.P", "pinion.C", radius=0.1 * size, backlash=2e-3 * size, restitution=0.5)
    start = kp.assemble(m, {"guide.displacement": 0, "guide.rate": 0, "pinion.omega": rate})
    sol = kp.dynamics(m, start, t_end=0.02 / rate, method=EXACT)
    hit = sol.events["teeth.hit"].t[0]
    assert hit == pytest.approx(0.01 / rate, rel=1e-9)
    # Φ̇ = -v + r ω; one impulse P: m v = P, J (ω' - ω) = -r P
    arms, inverse = np.array([-1.0, 0.1]), np.array([1 / mass, 1 / (2e-3 * mass * size**2)])
    arms[1] *= size
    impulse = 1.5 * arms[1] * rate / (arms @ (arms * inverse))
    assert_allclose(sol["guide.rate"][-1], impulse * inverse[0], rtol=1e-9)
    assert_allclose(sol["pinion.omega"][-1], rate - impulse * arms[1] * inverse[1], rtol=1e-9)


@pytest.mark.parametrize("scale", SCALES)
def test_slopes_of_the_motion_after_a_hit(scale: tuple[float, float, float]) -> None:
    _, size, rate = scale
    start = {"i.angle": 0, "j.angle": 0, "i.omega": rate, "j.omega": 0}
    run = kp.Dynamics(t_end=6e-3 / rate, method=EXACT)
    case = kp.Case(gears(scale, e=0.5), {"set": start}, [run])
    found = kp.gradient(case, ["j.angle.final", "j.omega.final"], ["b", "e", "i.omega"])
    # hit at b/(0.4 ω); then ω_j = -(1 + e) 0.2 ω 0.5 / 0.4 / m with m = 0.2² / 0.03 + 0.5² / 0.4
    per = -0.2 * 0.5 / 0.4 / (0.2**2 / 0.03 + 0.5**2 / 0.4)
    first = 0.5e-3 / 0.2 / rate
    time = 6e-3 / rate - first
    assert_allclose(found["j.omega.final", "e"], per * rate, rtol=1e-8)
    assert_allclose(found["j.omega.final", "i.omega"], 1.5 * per, rtol=1e-8)
    assert_allclose(found["j.omega.final", "b"], 0, atol=1e-7 * rate / size)
    assert_allclose(found["j.angle.final", "e"], per * rate * time, rtol=1e-8)
    shift = first / (1e-3 * size)
    assert_allclose(found["j.angle.final", "b"], -1.5 * per * rate * shift, rtol=1e-8)


@pytest.mark.parametrize(
    ("fields", "field", "words"),
    [
        ({"backlash": -1e-3}, "backlash", "must be > 0"),
        ({"restitution": 1.5}, "restitution", "from 0 to 1"),
        ({"backlash": 0, "restitution": 0.5}, "restitution", "needs backlash"),
        ({"pressure_angle": "20*deg"}, "pressure_angle", "not together with backlash"),
        ({"radii": (0.2, -0.5)}, "radii", "must be > 0"),
    ],
)
def test_impossible_fields(fields: dict[str, Any], field: str, words: str) -> None:
    with pytest.raises(kp.ModelError, match=words) as caught:
        kp.assemble(gears(SCALES[0], **fields), {"i.angle": 0})
    assert f"joints.teeth.{field}" in str(caught.value) and "forces" not in str(caught.value)


def test_the_centres_must_be_at_the_distance_of_the_radii() -> None:
    m = gears(SCALES[0], radii=(0.2, 0.4))
    with pytest.raises(kp.KempeError, match=r"distance of the centres is 0\.7"):
        kp.dynamics(m, kp.assemble(m, {"i.angle": 0, "j.angle": 0}), t_end=0.1)


def test_a_start_beyond_the_play_is_refused() -> None:
    m = gears(SCALES[0])
    start = {"i.angle": 0.01, "j.angle": 0}
    with pytest.raises(kp.KempeError, match="beyond teeth") as caught:
        kp.dynamics(m, kp.assemble(m, start), t_end=0.1)
    assert "choose an offset" in str(caught.value)
    m = gears(SCALES[0], offset=0.01 * 0.2)
    sol = kp.dynamics(m, kp.assemble(m, start), t_end=0.1)
    assert_allclose(sol["teeth.play"], 0, atol=1e-12)
