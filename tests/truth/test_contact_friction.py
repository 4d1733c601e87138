"""Contacts whose friction slides and sticks, against closed forms."""

from typing import Any

import kempe as kp
import numpy as np
import pytest

G = 9.81
#: Masses and sizes.
SCALES = [(1.0, 1.0), (1e-3, 1e3), (1e3, 1e-3)]
#: Small tolerances.
FINE = kp.DOP853(rtol=1e-10, atol=1e-12)
KINDS = ["rigid", "compliant"]


def law(kind: str, mass: float, size: float) -> dict[str, Any]:
    """Fields of a rigid contact, or of one that its weight presses in by 1e-4 of the size."""
    if kind == "rigid":
        return {"restitution": 0.0}
    return {"stiffness": f"{1e4 * mass * G / size} N/m", "exponent": 1, "damping": 0.02}


def depth(kind: str, angle: float, size: float) -> float:
    return 0.0 if kind == "rigid" else 1e-4 * size * np.cos(angle)


def slope(size: float, angle: float, gravity: float = G) -> kp.Model:
    """A line along x, and gravity that is turned by an angle; uphill is +x."""
    m = kp.Model("slope", gravity=(-gravity * np.sin(angle), -gravity * np.cos(angle)))
    m.ground.curves(floor={"line": ((1e3 * size, 0), (-1e3 * size, 0))})
    return m


def disc(
    kind: str, scale: tuple[float, float], angle: float, mu: float, speed: float, spin: float
) -> tuple[kp.Model, kp.State]:
    """A disc on a slope, with a speed along the slope and the speed of its rim."""
    mass, size = scale
    m = slope(size, angle)
    m.body("disc", mass=mass, inertia=0.5 * mass * size**2, points={"C": (0, 0)})
    m.contact("touch", "disc.C", "ground.floor", radius=size, friction=mu, **law(kind, mass, size))
    start = {"x": 0, "y": size - depth(kind, angle, size), "angle": 0}
    start |= {"vx": speed, "vy": 0, "omega": -spin / size}
    return m, kp.assemble(m, set={f"disc.{name}": x for name, x in start.items()})


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("scale", SCALES)
def test_a_disc_that_slips_begins_to_roll(kind: str, scale: tuple[float, float]) -> None:
    mu, size = 0.2, scale[1]
    speed = 3 * np.sqrt(size)
    m, start = disc(kind, scale, 0.0, mu, speed, 0.0)
    rolls = speed / (3 * mu * G)
    sol = kp.dynamics(m, start, t_end=2 * rolls)
    assert sol.events["touch.stick"].t == pytest.approx([rolls], rel=1e-8)
    assert len(sol.events["touch.slip"].t) == 0
    assert sol["disc.vx"][-1] == pytest.approx(2 / 3 * speed, rel=1e-8)
    assert sol["disc.omega"][-1] * size == pytest.approx(-2 / 3 * speed, rel=1e-8)
    weight = scale[0] * G
    # the force on the ground along growing u, which is -x
    assert sol["touch.tangential"][0] == pytest.approx(-mu * weight, rel=1e-6)
    assert sol["touch.tangential"][-1] == pytest.approx(0.0, abs=1e-8 * weight)
    assert sol["touch.sliding"][0] == pytest.approx(-speed, rel=1e-12)
    assert sol["touch.sticking"][[0, -1]] == pytest.approx([0, 1])
    assert sol["touch"].force(on="disc")[0] == pytest.approx([-mu * weight, weight], rel=1e-6)
    lost = scale[0] * speed**2 / 6
    assert sol.energy.dissipated[-1] == pytest.approx(lost, rel=1e-7)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("scale", SCALES)
@pytest.mark.parametrize("mu", [0.9 / 3, 1.1 / 3])
def test_a_disc_rolls_down_or_slips(kind: str, scale: tuple[float, float], mu: float) -> None:
    """It slips where tan(angle) > 3 mu."""
    angle = np.radians(45)
    m, start = disc(kind, scale, angle, mu, 0.0, 0.0)
    t_end = np.sqrt(scale[1])
    sol = kp.dynamics(m, start, t_end=t_end)
    sticks = np.tan(angle) < 3 * mu
    a = 2 / 3 * G * np.sin(angle) if sticks else G * (np.sin(angle) - mu * np.cos(angle))
    assert sol["disc.vx"][-1] == pytest.approx(-a * t_end, rel=1e-7)
    assert set(sol["touch.sticking"]) == {float(sticks)}
    assert len(sol.events["touch.slip"].t) == len(sol.events["touch.stick"].t) == 0


@pytest.mark.parametrize("kind", KINDS)
def test_friction_oscillator_rests_at_a_known_place(kind: str) -> None:
    """m = k = 1, friction of 1 N: from (12, 6), each half turn shifts the centre by 1 m."""
    m = slope(1.0, 0.0, gravity=1.0)
    m.ground.points(O=(0, 0))
    m.body("bead", mass=1, inertia=1, points={"C": (0, 0)})
    m.contact("touch", "bead.C", "ground.floor", friction=1, **law(kind, 1.0, 1.0))
    m.coordinate_driver("upright", "bead.angle", value=0)
    m.generalized_force("spring", "bead.x", value="-bead.x")
    down = 0.0 if kind == "rigid" else 1e-4 / G
    set_ = {"bead.x": 12, "bead.y": -down, "bead.vx": 6, "bead.vy": 0}
    sol = kp.dynamics(m, kp.assemble(m, set=set_), t_end=30, method=FINE)
    assert sol["bead.x"][-1] == pytest.approx(15 - np.sqrt(205), abs=1e-7)
    assert sol["touch.sticking"][-1] == 1


@pytest.mark.parametrize("scale", SCALES)
@pytest.mark.parametrize("steeper", [-1e-10, 1e-10])
def test_a_block_on_a_slope_at_the_limit(scale: tuple[float, float], steeper: float) -> None:
    """The block slides where tan(angle) exceeds mu. Its lower corner carries more."""
    mass, size = scale
    mu = 0.4
    angle = np.arctan(mu * (1 + steeper))
    m = slope(size, angle)
    points = {"A": (-size, -0.2 * size), "B": (size, -0.2 * size)}
    m.body("block", mass=mass, inertia=mass * size**2, points=points)
    for corner in "AB":
        m.contact(corner, f"block.{corner}", "ground.floor", friction=mu, restitution=0)
    at = {"x": 0, "y": 0.2 * size, "angle": 0, "vx": 0, "vy": 0, "omega": 0}
    start = kp.assemble(m, set={f"block.{name}": x for name, x in at.items()})
    sol = kp.dynamics(m, start, t_end=np.sqrt(size))
    weight = mass * G * np.cos(angle)
    assert sol["A.sticking"][-1] == sol["B.sticking"][-1] == float(steeper < 0)
    assert sol["A.force"][0] + sol["B.force"][0] == pytest.approx(weight)
    assert sol["A.force"][0] - sol["B.force"][0] == pytest.approx(0.2 * weight * np.tan(angle))
    assert len(sol.events["A.slip"].t) == 0  # it slides from the start
    if steeper < 0:
        assert abs(sol["block.vx"][-1]) < 1e-12 * np.sqrt(size)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("mu", [(0.4, 0.4), (0.3, 0.4)])
def test_a_bead_on_a_slope_that_becomes_steeper(kind: str, mu: tuple[float, float]) -> None:
    """A pull of 2 N/s: it slips at 2 t = static m g, then slides with kinetic friction."""
    kinetic, static = mu
    m = slope(1.0, 0.0)
    m.body("bead", mass=0.5, inertia=1, points={"C": (0, 0)})
    m.contact(
        "touch", "bead.C", "ground.floor", friction=kinetic, static=static, **law(kind, 0.5, 1.0)
    )
    m.coordinate_driver("upright", "bead.angle", value=0)
    m.generalized_force("pull", "bead.x", value="2*t")
    at = {"bead.x": 0, "bead.y": -depth(kind, 0, 1), "bead.vx": 0, "bead.vy": 0}
    sol = kp.dynamics(m, kp.assemble(m, set=at), t_end=2)
    slips = static * 0.5 * G / 2
    assert sol.events["touch.slip"].t == pytest.approx([slips], rel=1e-9)
    more = (2**2 - slips**2) / 0.5 - kinetic * G * (2 - slips)
    assert sol["bead.vx"][-1] == pytest.approx(more, rel=1e-8)
    rows = sol.t > slips * (1 + 1e-9)
    assert sol["touch.tangential"][rows][1:] == pytest.approx(-kinetic * 0.5 * G, rel=1e-6)


def test_a_stack_of_ten_blocks_rests_on_a_slope() -> None:
    """Each block rests with two corners on the block below; the lowest contact carries the most."""
    mu, angle, mass = 0.5, np.radians(15), 2.0
    m = slope(1.0, angle)
    below = "ground.floor"
    for k in range(10):
        name = f"b{k}"
        corners = {"A": (-0.5, -0.1), "B": (0.5, -0.1)}
        top = {"top": {"line": ((0.6, 0.1), (-0.6, 0.1))}}
        m.body(name, mass=mass, inertia=0.3, points=corners, curves=top)
        for corner in "AB":
            m.contact(f"{corner}{k}", f"{name}.{corner}", below, friction=mu, restitution=0)
        below = f"{name}.top"
    at = {f"b{k}.{c}": 0 for k in range(10) for c in ("x", "angle", "vx", "vy", "omega")}
    at |= {f"b{k}.y": 0.1 + 0.2 * k for k in range(10)}
    sol = kp.dynamics(m, kp.assemble(m, set=at), t_end=0.2)
    assert np.ptp(sol["b9.x"]) < 1e-12
    for k in (0, 5, 9):
        above = mass * (10 - k)
        normal = sol[f"A{k}.force"] + sol[f"B{k}.force"]
        along = sol[f"A{k}.tangential"] + sol[f"B{k}.tangential"]
        assert normal == pytest.approx(above * G * np.cos(angle), rel=1e-9)
        # on the lower body along growing u, which is -x: downhill
        assert along == pytest.approx(above * G * np.sin(angle), rel=1e-9)


def test_a_disc_rolls_on_a_ring_and_slips_off() -> None:
    """It rolls on a fixed circle until its friction is used up (energy balance), then slips."""
    mu, R, r, tilt = 0.3, 1.0, 0.25, 0.1
    m = kp.Model("ring", gravity=(0, -G))
    m.ground.curves(ring={"circle": (0, 0, R)})
    m.body("disc", mass=1, inertia=0.5 * r**2, points={"C": (0, 0)})
    m.contact("touch", "disc.C", "ground.ring", radius=r, friction=mu, restitution=0)
    at = {"x": (R + r) * np.sin(tilt), "y": (R + r) * np.cos(tilt), "angle": 0}
    at |= {"vx": 0, "vy": 0, "omega": 0}
    start = kp.assemble(m, set={f"disc.{name}": x for name, x in at.items()})
    sol = kp.dynamics(m, start, t_end=2, method=FINE)
    slip = sol.events["touch.slip"]
    x, y = slip.states[0]["disc.x"], slip.states[0]["disc.y"]
    theta = np.arctan2(x, y)
    # N = m g cos - m v²/(R + r) with v² = 4/3 g (R + r)(cos tilt - cos theta); T = 1/3 m g sin
    normal = np.cos(theta) - 4 / 3 * (np.cos(tilt) - np.cos(theta))
    assert np.sin(theta) / 3 == pytest.approx(mu * normal, rel=1e-7)
    rolled = -(R + r) / r * (theta - tilt)
    assert slip.states[0]["disc.angle"] == pytest.approx(rolled, rel=1e-8)
    assert len(sol.events["touch.release"].t) == 1


@pytest.mark.parametrize("method", [FINE, kp.Radau(rtol=1e-9, atol=1e-11)])
def test_a_spinning_ball_bounces_on_a_soft_floor(method: Any) -> None:
    """Friction keeps the moment about its place, m vx r - J omega, until the ball rolls."""
    mass, r, mu, inertia = 1.0, 0.2, 0.3, 0.016
    m = slope(1.0, 0.0)
    m.body("ball", mass=mass, inertia=inertia, points={"C": (0, 0)})
    law = {"friction": mu, "static": 1.2 * mu, "stiffness": 1e4, "damping": 0.05}
    m.contact("touch", "ball.C", "ground.floor", radius=r, **law)
    at = {"x": 0, "y": 0.5, "angle": 0, "vx": 0.2, "vy": 0, "omega": 40}
    start = kp.assemble(m, set={f"ball.{name}": x for name, x in at.items()})
    sol = kp.dynamics(m, start, t_end=1.5, method=method)
    rolls = (inertia * 40 - mass * r * 0.2) / (inertia + mass * r**2)
    assert sol["ball.omega"][-1] == pytest.approx(rolls, rel=1e-8)
    assert sol["ball.vx"][-1] == pytest.approx(-rolls * r, rel=1e-8)
    assert np.abs(sol.energy.balance).max() < 1e-6
    # it slides in the first touch, from whose beginning on friction acts
    hit, release = sol.events["touch.hit"].t[0], sol.events["touch.release"].t[0]
    pressed = mass * (sol(release)["ball.vy"] - sol(hit)["ball.vy"] + G * (release - hit))
    assert sol(release)["ball.vx"] == pytest.approx(0.2 - mu * pressed / mass, rel=1e-6)
    assert len(sol.events["touch.hit"].t) == 3


def three_feet(friction: tuple[float, float, float]) -> kp.Solution:
    """A block on a slope with three feet in a row, of which one repeats the others."""
    m = slope(1.0, np.radians(20))
    m.body("block", mass=2, inertia=1, points={"A": (-1, -0.2), "B": (0, -0.2), "C": (1, -0.2)})
    for foot, mu in zip("ABC", friction, strict=True):
        m.contact(foot, f"block.{foot}", "ground.floor", friction=mu, restitution=0)
    at = {"x": 0, "y": 0.2, "angle": 0, "vx": 0, "vy": 0, "omega": 0}
    start = kp.assemble(m, set={f"block.{name}": x for name, x in at.items()})
    return kp.dynamics(m, start, t_end=0.5)


def test_feet_that_repeat_others_need_the_same_friction() -> None:
    sol = three_feet((0.2, 0.2, 0.2))
    angle = np.radians(20)
    assert sol["block.vx"][-1] == pytest.approx(-0.5 * G * (np.sin(angle) - 0.2 * np.cos(angle)))
    with pytest.raises(kp.RedundancyError, match=r"is not unique.*their friction depends on it"):
        three_feet((0.1, 0.2, 0.3))


def test_other_curves_are_refused_with_a_remedy() -> None:
    def bowl(**law: Any) -> kp.Model:
        m = kp.Model("bowl", gravity=(0, -G))
        m.ground.curves(bowl={"x": "u", "y": "u^2", "range": (-1, 1)})
        m.body("disc", mass=1, inertia=0.005, points={"C": (0, 0)})
        law |= {"radius": 0.1, "friction": 0.3, "side": "left"}
        m.contact("touch", "disc.C", "ground.bowl", **law)
        return m

    with pytest.raises(kp.ModelError, match="lines and circles; on another curve give velocity"):
        kp.assemble(bowl(restitution=0))
    m = bowl(stiffness=1e5, velocity=0.01)
    at = {"disc.x": 0, "disc.y": 0.1, "disc.angle": 0, "disc.vx": 1, "disc.vy": 0, "disc.omega": 0}
    assert kp.dynamics(m, kp.assemble(m, set=at), t_end=0.01)["touch.tangential"][-1] > 0


def test_slopes_stop_at_an_impact_with_friction() -> None:
    m, start = disc("rigid", (1.0, 1.0), 0.0, 0.2, 1.0, 0.0)
    at = {name: float(start[f"disc.{name}"]) for name in ("x", "angle", "vx", "omega")}
    states = {f"disc.{name}": x for name, x in at.items()} | {"disc.y": 1.1, "disc.vy": 0}
    case = kp.Case(m, {"set": states}, [kp.Dynamics(t_end=1.0)])
    found = kp.gradient(case, ["disc.x.final"], ["disc.vx"])
    assert np.isnan(found.jacobian).all()
    assert "impact with friction" in str(found.remarks)


@pytest.mark.parametrize(("static", "moves"), [(0.5, 0.0), (0.3, 1.0)])
def test_friction_may_act_at_rest_only(static: float, moves: float) -> None:
    m = slope(1.0, np.radians(20))
    m.body("block", mass=2, inertia=1, points={"A": (-1, -0.2), "B": (1, -0.2)})
    for foot in "AB":
        m.contact(foot, f"block.{foot}", "ground.floor", friction=0, static=static, restitution=0)
    at = {"x": 0, "y": 0.2, "angle": 0, "vx": 0, "vy": 0, "omega": 0}
    start = kp.assemble(m, set={f"block.{name}": x for name, x in at.items()})
    sol = kp.dynamics(m, start, t_end=0.5)
    fallen = -0.5 * G * np.sin(np.radians(20)) * moves
    assert sol["block.vx"][-1] == pytest.approx(fallen, rel=1e-9, abs=1e-12)
