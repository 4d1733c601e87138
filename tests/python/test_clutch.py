"""Clutches and brakes against closed forms."""

import kempe as kp
import numpy as np
import pytest
from scipy.optimize import brentq

EXACT = kp.DOP853(rtol=1e-12, atol=1e-14)
#: Inertias in kg·m² and rates in rad/s.
SCALES = [(1.0, 1.0), (1e-6, 300.0), (1e4, 0.1)]


def shafts(numbers: dict[str, float], **clutch: object) -> kp.Model:
    """Two discs on one axis with a clutch between them."""
    m = kp.Model("shafts", gravity=(0, 0), parameters=numbers)
    m.ground.points(O=(0, 0))
    for name in ("i", "j"):
        m.body(name, mass=1.0, inertia=f"J_{name}", points={"O": (0, 0)})
        m.revolute(f"pin_{name}", "ground.O", f"{name}.O")
    m.clutch("clutch", "i", "j", capacity="T", **clutch)
    return m


@pytest.mark.parametrize("one_way", [False, True])
@pytest.mark.parametrize("scale", SCALES)
def test_two_shafts_synchronise(scale: tuple[float, float], one_way: bool) -> None:
    inertia, rate = scale
    numbers = {"J_i": 2.0 * inertia, "J_j": 3.0 * inertia, "T": inertia * rate**2}
    m = shafts(numbers, one_way=one_way)
    start = kp.assemble(m, set={"i.omega": rate, "j.omega": 0.0})
    sol = kp.dynamics(m, t_end=3.0 / rate, start=start, method=EXACT)
    # (1/2 + 1/3) T t = rate
    (t,) = sol.events["clutch.stick"].t
    assert t == pytest.approx(rate / (5 / 6 * rate**2), rel=1e-11)
    assert sol.events["clutch.slip"].t.size == 0
    np.testing.assert_allclose(sol["j.omega"][-1], 2 / 5 * rate, rtol=1e-11)
    np.testing.assert_allclose(sol["i.omega"][-1], 2 / 5 * rate, rtol=1e-11)
    heat = 0.5 * (2 * 3 / 5) * inertia * rate**2
    np.testing.assert_allclose(sol.dissipated("clutch")[-1], heat, rtol=1e-10)
    assert sol["clutch.torque"][0] == pytest.approx(numbers["T"])
    assert sol["clutch.sticking"][-1] == 1.0


@pytest.mark.parametrize("scale", SCALES)
def test_a_brake_holds_up_to_its_capacity(scale: tuple[float, float]) -> None:
    inertia, rate = scale
    m = kp.Model("brake", gravity=(0, 0), parameters={"J": inertia, "T": inertia * rate**2})
    m.ground.points(O=(0, 0))
    m.body("drum", mass=1.0, inertia="J", points={"O": (0, 0)})
    m.revolute("pin", "ground.O", "drum.O")
    m.clutch("brake", "ground", "drum", capacity="T")
    m.generalized_force("load", "drum.angle", value=f"0.5 * T * t * {rate}")
    start = kp.assemble(m, set={"drum.omega": 0.0})
    sol = kp.dynamics(m, t_end=4.0 / rate, start=start, method=EXACT)
    (t,) = sol.events["brake.slip"].t
    assert t == pytest.approx(2.0 / rate, rel=1e-10)
    # J ω' = T (t/2 - 1)
    s = 4.0
    np.testing.assert_allclose(sol["drum.omega"][-1], rate * (s**2 / 4 - s + 1), rtol=1e-9)
    np.testing.assert_allclose(sol["brake.torque"][-1], -inertia * rate**2, rtol=1e-12)


@pytest.mark.parametrize("scale", SCALES)
def test_a_freewheel_lets_the_driven_side_run_ahead(scale: tuple[float, float]) -> None:
    inertia, rate = scale
    numbers = {"J_i": inertia, "J_j": inertia, "T": 1e3 * inertia * rate**2, "w": rate}
    m = shafts(numbers, one_way=True)
    # the drive has the speed w (x + 2 sin x), x = w t
    m.coordinate_driver("drive", "i.angle", value="(w*t)^2/2 + 2 - 2*cos(w*t)")
    start = kp.assemble(m, set={"j.omega": 0.0})
    sol = kp.dynamics(m, t_end=8.0 / rate, start=start, method=EXACT, output_step=0.01 / rate)
    # the drive slows down from cos x = -1/2 on; it catches up at that speed
    ahead = 2 * np.pi / 3
    top = ahead + np.sqrt(3.0)
    assert sol.events["clutch.slip"].t[0] == pytest.approx(ahead / rate, rel=1e-9)
    again = sol.events["clutch.stick"].t[-1] * rate
    assert again + 2 * np.sin(again) == pytest.approx(top, rel=1e-9) and again > ahead + 1
    x = sol.t * rate
    free = (x > ahead) & (x < again)
    np.testing.assert_allclose(sol["j.omega"][free], top * rate, rtol=1e-9)
    np.testing.assert_allclose(
        sol["j.omega"][~free], rate * (x + 2 * np.sin(x))[~free], rtol=1e-8, atol=1e-9 * rate
    )
    torque = sol["clutch.torque"]
    assert (torque >= -1e-9 * inertia * rate**2).all()
    pushes = (x < ahead - 0.01) | (x > again + 0.01)
    np.testing.assert_allclose(
        torque[pushes], (inertia * rate**2 * (1 + 2 * np.cos(x)))[pushes], rtol=1e-7
    )
    np.testing.assert_allclose(torque[free], 0.0, atol=1e-11 * inertia * rate**2)


@pytest.mark.parametrize("sign", [1, -1])
def test_a_freewheel_beside_a_clutch_helps_in_its_direction_only(sign: int) -> None:
    m = kp.Model("pair", gravity=(0, 0), parameters={"T": 1.0})
    m.ground.points(O=(0, 0))
    for name in ("i", "j"):
        m.body(name, mass=1.0, inertia=1.0, points={"O": (0, 0)})
        m.revolute(f"pin_{name}", "ground.O", f"{name}.O")
    m.clutch("plain", "i", "j", capacity="T")
    m.clutch("freewheel", "i", "j", capacity="2 * T", one_way=True)
    m.generalized_force("load", "i.angle", value=f"{sign} * 2 * T * t")
    sol = kp.dynamics(m, kp.assemble(m, set={"i.omega": 0, "j.omega": 0}), t_end=5.0, method=EXACT)
    # the clutches transmit t, up to 3 forward and 1 backward
    most = 3.0 if sign > 0 else 1.0
    assert sol.events["plain.slip"].t == pytest.approx([most], rel=1e-9)
    expected = sign * (most**2 / 2 + most * (5.0 - most))
    assert sol["j.omega"][-1] == pytest.approx(expected, rel=1e-9)
    both = sol["plain.torque"] + sol["freewheel.torque"]
    np.testing.assert_allclose(both, sign * np.minimum(sol.t, most), rtol=1e-9, atol=1e-12)


def test_a_clutch_needs_two_bodies_and_a_capacity() -> None:
    m = kp.Model("faults")
    m.body("disc", mass=1, inertia=1)
    m.clutch("clutch", "ground", "disc", capacity=-1)
    with pytest.raises(kp.ModelError, match=r"clutch\.capacity: must not be negative"):
        m.compile()


#: Capacities that become zero or very small while the brake holds, over that of another brake.
FADING = ["1 - 0.4*s", "max(0, 1 - 0.4*s)", "max(1e-9, 1 - 0.4*s)", "cos(s)", "exp(-20*s)"]


@pytest.mark.parametrize("first", ["fading", "steady"])
@pytest.mark.parametrize("law", FADING)
@pytest.mark.parametrize("scale", SCALES)
def test_one_of_two_brakes_fades_while_both_hold(
    scale: tuple[float, float], law: str, first: str
) -> None:
    """The drum slips where its torque is the sum of both capacities, whatever holds more before."""
    inertia, rate = scale
    most = inertia * rate**2
    m = kp.Model("brakes", gravity=(0, 0), parameters={"w": rate})
    m.ground.points(O=(0, 0))
    m.body("drum", mass=1.0, inertia=inertia, points={"O": (0, 0)})
    m.revolute("pin", "ground.O", "drum.O")
    m.torque("drive", "drum", torque=f"{0.3 * most}*w*t")
    fading = f"{most}*({law.replace('s)', '(w*t))').replace('*s', '*w*t')})"
    for name in sorted(["fading", "steady"], key=lambda name: name != first):
        m.clutch(name, "ground", "drum", capacity=fading if name == "fading" else 2 * most)
    start = kp.assemble(m, set={"drum.omega": 0.0})
    sol = kp.dynamics(m, start, t_end=8.0 / rate, output_step=0.1 / rate, method=EXACT)

    def capacity(s: float) -> float:
        values = {"cos": np.cos(s), "exp": np.exp(-20 * s)}
        own = values.get(law[:3], 1 - 0.4 * s)
        return float(2.0 + max(own, 1e-9 if "1e-9" in law else 0.0))

    slip = brentq(lambda s: 0.3 * s - capacity(s), 1.0, 8.0, xtol=1e-14)
    assert sol.events["steady.slip"].t * rate == pytest.approx([slip], rel=1e-9)
    assert sol.events["fading.slip"].t * rate == pytest.approx([slip], rel=1e-9)
    held = sol.t * rate < slip
    total = sol["fading.torque"] + sol["steady.torque"]
    np.testing.assert_allclose(total[held], -0.3 * most * rate * sol.t[held], atol=1e-9 * most)
    limits = np.array([capacity(s) - 2.0 for s in sol.t[held] * rate])
    assert (abs(sol["fading.torque"][held]) <= most * (limits + 1e-9)).all()


@pytest.mark.parametrize("first", ["slide", "brake"])
@pytest.mark.parametrize("size", [1e-3, 1.0, 1e3])
def test_friction_of_a_slide_fades_while_a_brake_holds_its_pinion(size: float, first: str) -> None:
    mass, g = 2.0, 9.81
    m = kp.Model("rack", gravity=(0, 0))
    m.ground.points(O=(0, 0), W=(0, size))
    m.body("rack", mass=mass, inertia=mass * size**2, points={"P": (0, 0)})
    m.body("wheel", mass=mass, inertia=mass * size**2, points={"W": (0, 0)})
    m.translational("slide", "ground.O", "rack.P")
    m.revolute("shaft", "ground.W", "wheel.W")
    m.rack("teeth", "rack.P", "wheel.W", radius=size)
    weight, w = mass * g, np.sqrt(g / size)
    m.generalized_force("push", "rack.x", value=f"{0.3 * weight * w}*t")
    for name in sorted(["slide", "brake"], key=lambda name: name != first):
        if name == "slide":
            m.friction("rubs", "slide", kinetic=0.5, load=f"{2 * weight}*(1 - {0.4 * w}*t)")
        else:
            m.clutch("brake", "ground", "wheel", capacity=2 * weight * size)
    start = kp.assemble(m, set={"rack.vx": 0.0, "wheel.angle": 0.0})
    sol = kp.dynamics(m, start, t_end=8 / w, method=EXACT)
    assert sol.events["brake.slip"].t * w == pytest.approx([2 / 0.3], rel=1e-9)
    # half of the force above that of the brake acts on the rack
    past = 8 - 2 / 0.3
    assert sol["rack.vx"][-1] == pytest.approx(0.3 * g / w * past**2 / 4, rel=1e-8)


@pytest.mark.parametrize("scale", SCALES)
def test_a_brake_fades_beside_a_free_wheel_without_load(scale: tuple[float, float]) -> None:
    """The drum comes to rest, and stays there when the brake has no capacity any more."""
    inertia, rate = scale
    most = inertia * rate**2
    m = kp.Model("brakes", gravity=(0, 0))
    m.ground.points(O=(0, 0))
    m.body("drum", mass=1.0, inertia=inertia, points={"O": (0, 0)})
    m.revolute("pin", "ground.O", "drum.O")
    m.clutch("brake", "ground", "drum", capacity=f"{most}*(1 - {0.3 * rate}*t)")
    m.clutch("sprag", "ground", "drum", capacity=0.7 * most, one_way=True)
    m.clutch("small", "ground", "drum", capacity=f"{0.1 * most}*(1 - {0.4 * rate}*t)", one_way=True)
    start = kp.assemble(m, set={"drum.omega": 0.5 * rate, "drum.angle": 0.0})
    sol = kp.dynamics(m, start, t_end=6.0 / rate, method=EXACT)
    # 0.5 = t - 0.15 t²
    stop = (1 - np.sqrt(1 - 0.3)) / 0.3
    assert sol.events["brake.stick"].t * rate == pytest.approx([stop], rel=1e-9)
    assert sol["drum.omega"][-1] == pytest.approx(0.0, abs=1e-12 * rate)
    assert sol["drum.angle"][-1] == pytest.approx(0.5 * stop - stop**2 / 2 + 0.05 * stop**3)


@pytest.mark.parametrize("inertia, rate", SCALES)
def test_the_power_of_a_brake_that_holds_in_the_end(inertia: float, rate: float) -> None:
    m = kp.Model("brake", gravity=(0, 0))
    m.ground.points(O=(0, 0))
    m.body("wheel", mass=1.0, inertia=inertia, points={"O": (0, 0)})
    m.revolute("pin", "ground.O", "wheel.O")
    torque = inertia * rate**2
    m.clutch("brake", "ground", "wheel", capacity=torque)
    m.measures(lost="brake.power")
    start = kp.assemble(m, {"wheel.angle": 0, "wheel.omega": 2 * rate})
    lost = kp.dynamics(m, start, t_end=5 / rate).measure("lost")
    energy = inertia * (2 * rate) ** 2 / 2
    assert [lost.min, lost.max, lost.final] == pytest.approx([-2 * torque * rate, 0, 0])
    assert lost.integral == pytest.approx(-energy, rel=1e-9)
