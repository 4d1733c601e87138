"""Cases of cams: the follower moves by its law, forces are those by hand, and it lifts off."""

from collections.abc import Callable

import kempe as kp
import numpy as np
import pytest
from cams.machines import SIZES, lift_of, moved, oscillating, programme, translating, turn_of
from sizes import FULL, some

MAKERS: dict[str, Callable[[float], kp.design.Cam]] = {
    "roller": lambda size: translating(size=size, offset=0.004 * size),
    "knife, clockwise": lambda size: translating("knife", size, direction="cw"),
    "flat": lambda size: translating("flat", size),
    "groove": lambda size: translating(size=size, closure="groove"),
    "conjugate": lambda size: oscillating(size=size, closure="conjugate"),
    "rocker": lambda size: oscillating(size=size),
    "rocker at the left, clockwise": lambda size: oscillating(
        size=size, pivot=(-0.08 * size, 0.01 * size), direction="cw"
    ),
    "flat rocker": lambda size: oscillating("flat", size),
    "flat rocker, clockwise": lambda size: oscillating("flat", size, direction="cw"),
}
CASES = [(name, size) for name in MAKERS for size in (1.0, 1e-3, 1e3)]
#: One of each kind, at some size; assembly of flat faces on curves of many points takes seconds.
USUAL = [(name, (1e-3, 1.0, 1e3)[k % 3]) for k, name in enumerate(MAKERS)]


@pytest.mark.parametrize(("name", "size"), CASES if FULL else USUAL[:7])
def test_a_simulated_follower_moves_by_its_law(name: str, size: float) -> None:
    cam = MAKERS[name](size)
    motion = turn_of(cam.case)
    lift = np.radians(15) if cam.follower.arm is not None else 0.01 * size
    angle = np.abs(motion["cam.angle"])
    for order, (found, near) in enumerate(
        zip(moved(cam, motion), (1e-10, 1e-8, 1e-4), strict=True)
    ):
        wanted = lift_of(angle, lift, order)
        assert np.abs(found - wanted).max() < near * lift


def test_a_harmonic_law_moves_too_although_its_acceleration_jumps() -> None:
    cam = translating(programme=programme(0.01, "harmonic", "modified_trapezoid"))
    motion = turn_of(cam.case)
    s, v, _ = moved(cam, motion)
    angle = motion["cam.angle"]
    assert np.abs(s - cam.programme.at(angle)).max() < 1e-12
    assert np.abs(v - cam.programme.at(angle, 1)).max() < 1e-6


@pytest.mark.parametrize("size", SIZES)
def test_force_and_torque_are_those_of_the_law(size: float) -> None:
    """N cos α = m(g + s''ω²) + k s + F, and the torque is s' times it."""
    speed = 60.0
    spring = (1500.0, 30.0 * size)
    cam = translating(size=size, mass=0.25, spring=spring, speed=speed)
    motion = turn_of(cam.case)
    angle = motion["cam.angle"]
    s, v, a = (lift_of(angle, 0.01 * size, order) for order in range(3))
    press = 0.25 * (9.81 + a * speed**2) + spring[0] * s + spring[1]
    alpha = np.arctan(v / (0.038 * size + s))
    assert motion["contact.normal"] * np.cos(alpha) == pytest.approx(press, rel=1e-4)
    torque = press * v
    assert np.abs(motion["drive.effort"] - torque).max() < 1e-4 * np.abs(torque).max()


TOLD: list[Callable[[], kp.design.Cam]] = [
    lambda: translating(closure="groove", mass=0.25, speed=60, spring=(1500, 30)),
    lambda: oscillating("knife", mass=0.3, speed=40, spring=(10, 3), direction="cw"),
    lambda: oscillating("knife", mass=0.3, speed=40, spring=(10, 3)),
    lambda: translating("knife", mass=0.25, spring=(1500, 30), speed=60),
]


@pytest.mark.parametrize("make", TOLD if FULL else TOLD[:3])
def test_a_knife_and_a_groove_tell_the_force_along_the_motion(
    make: Callable[[], kp.design.Cam],
) -> None:
    cam = make()
    motion = turn_of(cam.case)
    lift = np.radians(15) if cam.follower.arm is not None else 0.01
    s, _, a = (lift_of(np.abs(motion["cam.angle"]), lift, order) for order in range(3))
    stiffness, force = cam.drive.spring
    if cam.follower.arm is None:
        wanted = 0.25 * (9.81 + a * 3600) + stiffness * s + force
    else:
        weight = 0.3 * 9.81 * 0.035 * np.cos(motion["follower.angle"])  # a lift is clockwise
        torque = 0.3 * 0.07**2 / 3 * a * 1600 + stiffness * s + force - weight
        wanted = torque / 0.07
    assert np.abs(motion["press"] - wanted).max() < 1e-4 * np.abs(wanted).max()


def lift_off(mass: float, spring: tuple[float, float], lift: float) -> float:
    """m(g + s''ω²) + k s + F = 0 at the first angle."""
    angle = np.linspace(0.0, 2 * np.pi, 2_000_001)
    s, a = lift_of(angle, lift), lift_of(angle, lift, 2)
    slowed = a < -1e-12 * lift
    press = (mass * 9.81 + spring[0] * s + spring[1])[slowed]
    return float(np.sqrt((press / (-a[slowed] * mass)).min()))


@pytest.mark.parametrize("size", SIZES)
def test_the_lift_off_speed_is_that_of_the_spring(size: float) -> None:
    spring = (1500.0, 30.0 * size)
    cam = translating(size=size, mass=0.25, spring=spring)
    assert cam.lift_off_speed == pytest.approx(lift_off(0.25, spring, 0.01 * size), rel=1e-6)


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("direction", ["ccw", "cw"])
def test_the_lift_off_speed_of_a_bar_is_that_of_its_spring(size: float, direction: str) -> None:
    """m L²/3 ω² s'' + k s + T - m g L/2 cos θ = 0; a lift turns the bar clockwise."""
    spring = (10.0 * size, 3.0 * size)
    cam = oscillating(size=size, mass=0.3, spring=spring, direction=direction)
    arm, prime, pivot = 0.07, 0.038, complex(0.08, 0.01)
    start = np.arccos((abs(pivot) ** 2 + arm**2 - prime**2) / (2 * abs(pivot) * arm))
    angle = np.linspace(0.0, 2 * np.pi, 2_000_001)
    s, a = (lift_of(angle, np.radians(15), order) for order in (0, 2))
    theta = np.angle(-pivot) - start - s
    press = spring[0] * s + spring[1] - 0.3 * 9.81 * arm * size / 2 * np.cos(theta)
    slowed = a < -1e-9
    inertia = 0.3 * (arm * size) ** 2 / 3
    wanted = np.sqrt((press[slowed] / (-a[slowed] * inertia)).min())
    assert cam.lift_off_speed == pytest.approx(wanted, rel=1e-6)


@pytest.mark.parametrize("kind", some(["translating", "oscillating"], 1))
def test_the_normal_force_falls_to_zero_at_the_lift_off_speed(kind: str) -> None:
    cam = translating(mass=0.25, spring=(1500, 30))
    if kind == "oscillating":
        cam = oscillating(mass=0.3, spring=(10, 3))
    limit = cam.lift_off_speed
    below, above = (
        turn_of(cam.case.with_parameters({"speed": factor * limit}))["contact.normal"].min()
        for factor in (0.995, 1.005)
    )
    assert above < 0.0 < below
    assert below < 1.0  # N; at rest the force is at least 30 N


def test_a_follower_that_nothing_presses_or_that_cannot_leave() -> None:
    assert translating(gravity=0.0).lift_off_speed == 0.0
    assert translating(closure="groove").lift_off_speed == np.inf
    assert translating(mass=0.0, spring=(0, 1)).lift_off_speed == np.inf


def test_the_case_is_a_file(tmp_path: object) -> None:
    cam = translating(mass=0.25, spring=(1500, 30), speed=60)
    path = tmp_path / "cam.toml"  # type: ignore[operator]
    cam.case.save(path)
    assert kp.load(path).tree() == cam.case.tree()


@pytest.mark.parametrize(
    ("cam", "spring"),
    [
        (lambda **more: translating("knife", direction="cw", **more), (12.0, 3.0)),
        (lambda **more: translating(offset=0.004, **more), (0.0, 3.0)),
        (oscillating, (12.0, 0.0)),
        (lambda **more: oscillating(pivot=(-0.08, 0.01), direction="cw", **more), (12.0, 3.0)),
    ],
)
def test_the_drive_does_the_work_of_the_spring(
    cam: Callable[..., kp.design.Cam], spring: tuple[float, float]
) -> None:
    """Its torque with the spring exceeds that without by (k s + F) s'."""
    free, loaded = cam(mass=0.3), cam(mass=0.3, spring=spring)
    assert not free.case.model.compile().forces
    with_spring, without = turn_of(loaded.case), turn_of(free.case)
    s, v, _ = moved(loaded, with_spring)
    more = with_spring["drive.effort"] - without["drive.effort"]
    work = (spring[0] * s + spring[1]) * v * (-1.0 if loaded.clockwise else 1.0)
    assert np.abs(more - work).max() < 1e-6 * np.abs(work).max()
