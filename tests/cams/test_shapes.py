"""Profile, pressure angle, curvature and limits against closed forms."""

import kempe as kp
import numpy as np
import pytest
from cams.machines import SIZES, lift_of, oscillating, programme, translating


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("offset", [0.0, 0.006, -0.004])
@pytest.mark.parametrize("direction", ["ccw", "cw"])
def test_a_translating_roller(size: float, offset: float, direction: str) -> None:
    """Textbook: tan α = (s' - e)/(d + s); κ of the pitch curve from x' y'' - y' x''."""
    cam = translating(size=size, offset=offset * size, direction=direction)
    e = (offset if direction == "ccw" else -offset) * size
    angle, lift, prime = cam.angle, 0.01 * size, 0.038 * size
    s, v, a = (lift_of(angle, lift, order) for order in range(3))
    d = np.sqrt(prime**2 - e**2) + s
    assert np.tan(cam.pressure_angle) == pytest.approx((v - e) / d, abs=1e-12)
    along = d**2 + (v - e) ** 2
    radius = along**1.5 / (along + (v - e) * v - d * a) - 0.008 * size
    assert cam.radius_of_curvature == pytest.approx(radius, rel=1e-9)
    assert cam.curvature == pytest.approx(1 / radius, rel=1e-9)
    x, y = cam.pitch.T
    assert np.hypot(x, y) == pytest.approx(np.hypot(d, e), rel=1e-12)
    assert np.hypot(*(cam.pitch - cam.profile).T) == pytest.approx(0.008 * size, rel=1e-9)


@pytest.mark.parametrize("size", SIZES)
def test_a_flat_face(size: float) -> None:
    """ρ = R + s + s''; the contact is at the distance s' from the guide."""
    cam = translating("flat", size)
    s, v, a = (lift_of(cam.angle, 0.01 * size, order) for order in range(3))
    assert cam.radius_of_curvature == pytest.approx(0.03 * size + s + a, rel=1e-12)
    assert np.abs(cam.pressure_angle).max() < 1e-12
    assert np.hypot(*cam.profile.T) == pytest.approx(np.hypot(0.03 * size + s, v), rel=1e-12)


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("pivot", [(0.08, 0.01), (-0.08, 0.01)])
def test_an_oscillating_roller(size: float, pivot: tuple[float, float]) -> None:
    """Pressure angle by the instant centre of cam and follower; curvature by differences.

    The centre I divides the line from the shaft to the pivot M so that ω IO = ψ' ω IM. The normal
    passes through I and the roller's centre Q, the velocity of Q is normal to MQ.
    """
    pivot = (pivot[0] * size, pivot[1] * size)
    cam = oscillating(size=size, pivot=pivot)
    left = pivot[0] < 0
    angle = cam.angle
    s, v = (lift_of(angle, np.radians(15), order) for order in range(2))
    m, arm, prime = complex(*pivot), 0.07 * size, 0.038 * size
    far = abs(m)
    start = np.arccos((far**2 + arm**2 - prime**2) / (2 * far * arm))
    turn = 1.0 if left else -1.0
    q = m + arm * np.exp(1j * (np.angle(-m) + turn * (start + s)))
    ratio = turn * v
    centre = -ratio * m / (1 - ratio)
    normal = q - centre
    normal *= np.sign((np.conj(q) * normal).real) / np.abs(normal)
    velocity = turn * 1j * (q - m) / arm
    assert cam.pressure_angle == pytest.approx(np.angle(normal / velocity), abs=1e-9)
    pitch = q * np.exp(-1j * angle)
    assert cam.pitch == pytest.approx(np.column_stack([pitch.real, pitch.imag]), abs=1e-12 * size)
    for place in (0.4, 1.2, 2.0, 3.1, 5.0):
        at = cam.at(np.array([place - 1e-4, place, place + 1e-4])).pitch
        first, second = (at[2] - at[0]) / 2e-4, (at[2] - 2 * at[1] + at[0]) / 1e-8
        curvature = -(np.conj(first) * second).imag / abs(first) ** 3
        own = cam.at(np.array([place]))
        assert own.radius[0] == pytest.approx(1 / curvature - 0.008 * size, rel=1e-5)


def test_the_contact_wanders_along_a_flat_face() -> None:
    """By s' from the guide; on a rocker at the right by D cos ψ/(1 + ψ') from the pivot."""
    v = lift_of(translating("flat").angle, 0.01, 1)
    assert translating("flat").contact == pytest.approx(v, abs=1e-15)
    assert translating("flat", direction="cw").contact == pytest.approx(-v, abs=1e-15)
    moved = translating("flat", offset=0.004)
    assert moved.contact == pytest.approx(v - 0.004, abs=1e-15)
    rocker = oscillating("flat", direction="ccw")
    far, turn = np.hypot(0.08, 0.01), lift_of(rocker.angle, np.radians(15))
    psi = np.arcsin(0.06 / far) + turn
    along = far * np.cos(psi) / (1 + lift_of(rocker.angle, np.radians(15), 1))
    assert rocker.contact == pytest.approx(along, rel=1e-12)
    with pytest.raises(kp.ModelError, match="follower='flat'"):
        _ = translating().contact


def test_doubtful_sizes_are_remarks_whose_remedies_work() -> None:
    large = translating(base_radius=0.03, roller_radius=0.035)
    assert any("roller of 0.035 m is larger than the base" in text for text in large.remarks)
    assert translating(base_radius=0.036, roller_radius=0.035).remarks == ()
    short = oscillating("flat", arm=0.05)
    (told,) = short.remarks
    needed = float(told.split("up to ")[1].split()[0])
    assert needed == pytest.approx(short.contact.max(), rel=1e-3)
    assert oscillating("flat", arm=needed * 1.001).remarks == ()
    steep = translating(base_radius=0.005)
    assert "take a larger base radius" in steep.remarks[0]
    base = steep.least_base_radius("30 deg")
    larger = translating(base_radius=base * 1.0001).remarks
    assert not any("pressure" in text for text in larger)


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("make", [translating, oscillating])
def test_a_flat_profile_is_the_envelope_of_its_faces(make: object, size: float) -> None:
    """Each face touches the profile: no point of it is beyond, and one is on it."""
    cam = make("flat", size)  # type: ignore[operator]
    z = cam.shape.profile
    for k in range(0, len(z), 37):
        beyond = (np.conj(cam.shape.normal[k]) * (z - z[k])).real
        assert beyond.max() < 1e-12 * size
    steps = np.abs(np.diff(z))
    bent = np.abs(np.diff(np.unwrap(np.angle(np.diff(z)))))
    middle = steps[:-1] + steps[1:] > 1e-4 * size  # elsewhere the differences are rounding errors
    radius = (steps[:-1] + steps[1:]) / 2 / np.maximum(bent, 1e-300)
    assert radius[middle] == pytest.approx(cam.radius_of_curvature[1:-1][middle], rel=2e-2)


@pytest.mark.parametrize("size", SIZES)
def test_the_least_base_circle_of_a_pressure_angle(size: float) -> None:
    cam = translating(size=size, offset=0.004 * size)
    base = cam.least_base_radius(pressure_angle="20 deg")
    angle = np.linspace(0.0, 2.0 * np.pi, 400_001)
    s, v = (lift_of(angle, 0.01 * size, order) for order in range(2))
    e = 0.004 * size
    height = (np.abs(v - e) / np.tan(np.radians(20)) - s).max()
    assert base == pytest.approx(np.hypot(height, e) - 0.008 * size, rel=1e-8)
    other = translating(size=size, offset=e, base_radius=base)
    assert other.largest_pressure_angle == pytest.approx(np.radians(20), rel=1e-8)


@pytest.mark.parametrize("size", SIZES)
def test_a_flat_face_is_undercut_at_the_right_radius(size: float) -> None:
    """R + s + s'' = 0 at the least of s + s''."""
    quick = [
        ("rise", "60 deg", 0.02 * size, "cycloidal"),
        ("dwell", "80 deg"),
        ("return", "60 deg", "cycloidal"),
        ("dwell", "160 deg"),
    ]
    x = np.linspace(0.0, 1.0, 1_000_001)
    turn, beta = 2 * np.pi, np.radians(60)
    least = 0.02 * size * -(x - np.sin(turn * x) / turn + turn * np.sin(turn * x) / beta**2).min()
    small = translating("flat", size, programme=quick)
    assert small.least_base_radius() == pytest.approx(least, rel=1e-9)
    assert translating("flat", programme=quick, base_radius=least * 0.9999).undercut
    assert not translating("flat", programme=quick, base_radius=least * 1.0001).undercut
    with pytest.raises(kp.ModelError, match="undercut between 3") as caught:
        _ = small.case
    told = float(str(caught.value).split("at least ")[1].split()[0])
    assert least < told < 1.01 * least
    assert not translating("flat", programme=quick, base_radius=told).undercut


@pytest.mark.parametrize("size", SIZES)
def test_a_roller_is_undercut_at_the_right_radius_and_both_remedies_work(size: float) -> None:
    """On one pitch curve, the limit is its least convex radius of curvature."""
    quick = [
        ("rise", "60 deg", 0.02 * size, "harmonic"),
        ("dwell", "80 deg"),
        ("return", "60 deg", "harmonic"),
        ("dwell", "160 deg"),
    ]
    w, prime = np.pi / np.radians(60), 0.03 * size
    angle = np.linspace(0.0, np.radians(60), 1_000_001)
    s, v = (0.01 * size * f for f in (1 - np.cos(w * angle), w * np.sin(w * angle)))
    a, d = 0.01 * size * w**2 * np.cos(w * angle), prime + s
    pitch = (d**2 + v**2) ** 1.5 / (d**2 + 2 * v**2 - d * a)
    limit = float(pitch[pitch > 0].min())
    assert limit < prime

    def with_roller(radius: float) -> kp.design.Cam:
        base = prime - radius
        return translating(programme=quick, base_radius=base, roller_radius=radius)

    assert with_roller(0.5 * limit).least_radius_of_curvature == pytest.approx(
        0.5 * limit, rel=1e-9
    )
    assert not with_roller(0.9999 * limit).undercut
    large = with_roller(1.0001 * limit)
    assert large.undercut
    told = large.remarks[0]
    base = float(told.split("base_radius of at least ")[1].split()[0])
    same = {"programme": quick, "roller_radius": large.follower.roller}
    assert not translating(base_radius=base, **same).undercut
    roller = float(told.split("roller_radius of at most ")[1].split()[0])
    kept = float(told.split("with base_radius ")[1].split()[0])
    assert not translating(programme=quick, base_radius=kept, roller_radius=roller).undercut
    with pytest.raises(kp.ModelError, match="undercut"):
        large.write_csv("never.csv")


def test_a_roller_that_fits_each_bend_but_not_between_two_walls() -> None:
    """A hollow of the groove's outer wall; a force-closed cam has room there."""
    up = {"type": "polynomial", "start": [0, 0], "end": [0, 0, 0, 0]}
    down = {"type": "polynomial", "start": [0, 0, 0, 0], "end": [0, 0]}
    steep = [
        ("rise", "50 deg", 0.02, up),
        ("dwell", "130 deg"),
        ("return", "50 deg", down),
        ("dwell", "130 deg"),
    ]
    given = {"programme": steep, "base_radius": 0.03, "roller_radius": 0.0145}
    assert not translating(**given).undercut
    groove = translating(closure="groove", **given)
    hollow = -1.0 / groove.shape.bend[groove.shape.bend < 0.0].min()
    assert bool(groove.undercut) == (hollow < 0.035)
    assert groove.undercut


def test_conjugate_cams_hold_the_follower_on_both_sides() -> None:
    """Both contacts have a constant distance: rollers on a rod, or parallel faces."""
    for cam in (
        translating(closure="conjugate", offset=0.003),
        translating("flat", closure="conjugate", direction="cw"),
        oscillating(closure="conjugate"),
    ):
        assert cam.second is not None
        apart = cam.shape.pitch - cam.second.pitch
        if cam.follower.kind == "flat":
            apart = np.real(np.conj(cam.shape.normal) * apart)
        assert np.ptp(np.abs(apart)) < 1e-12
        assert np.hypot(*cam.conjugate.T).min() == pytest.approx(cam.follower.base, rel=1e-9)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"base_radius": 0.0}, "base_radius: 0 m; must be > 0"),
        ({"base_radius": "30 deg"}, "base_radius"),
        ({"roller_radius": 0.0}, "follower='knife'"),
        ({"offset": 0.05}, r"offset: 0\.05 m.*prime circle of radius 0\.038 m.*larger base"),
        ({"arm": 0.05}, "pivot: an oscillating follower needs"),
        ({"arm": 0.01, "pivot": (0.08, 0.0)}, r"reach of the arm: change arm or pivot"),
        ({"arm": 0.05, "pivot": (0.0, 0.0)}, "must not be at the shaft"),
        ({"arm": 0.05, "pivot": (0.08, 0.0), "offset": 0.01}, "leave it out"),
        ({"closure": "spring"}, "closure"),
        ({"direction": "left"}, "direction"),
        ({"face": 0.01}, "face"),
        ({"speed": -1.0}, "direction='cw'"),
        ({"mass": -1.0}, "mass"),
        ({"spring": 5.0}, "spring"),
        ({"spring": ("5 N", 0.0)}, "spring"),
        ({"spring": (-5.0, 0.0)}, "must not be negative"),
        ({"base_radios": 0.1}, "base_radius"),
    ],
)
def test_wrong_dimensions_are_explained(change: dict, message: str) -> None:
    given = {"base_radius": 0.03, "roller_radius": 0.008, **change}
    lift = "15 deg" if "pivot" in change else 0.01
    with pytest.raises((kp.ModelError, TypeError), match=message):
        kp.design.cam("roller", programme(lift), **given)


def test_other_followers_have_no_roller_and_no_groove() -> None:
    with pytest.raises(kp.ModelError, match="follower='roller'"):
        translating("flat", roller_radius=0.01)
    with pytest.raises(kp.ModelError, match="groove needs follower='roller'"):
        translating("knife", closure="groove")
    with pytest.raises(kp.ModelError, match="closure='groove'"):
        _ = translating().outer
    with pytest.raises(kp.ModelError, match="closure='conjugate'"):
        _ = translating().conjugate
    with pytest.raises(kp.ModelError, match="beyond the line"):
        oscillating("flat", base_radius=0.069)


@pytest.mark.parametrize("size", SIZES)
def test_the_outer_wall_of_a_groove_is_sharpest_in_its_hollow(size: float) -> None:
    """Its radius of curvature there, by differences along the wall, is the least of the groove."""
    steps = [("rise", "40 deg", 0.02 * size, "cycloidal"), ("dwell", "90 deg")]
    steps += [("return", "40 deg", "cycloidal"), ("dwell", "190 deg")]
    cam = translating(size=size, programme=steps, closure="groove")
    angle = np.linspace(0.0, 2 * np.pi, 100_001)
    wall = cam.at(angle).beside(2 * cam.follower.roller)
    first = np.gradient(wall, angle)
    second = np.gradient(first, angle)
    curvature = (np.conj(first) * second).imag / np.abs(first) ** 3
    against = curvature * np.sign(curvature[-2]) < 0.0  # the last dwell is on the base circle
    hollow = 1.0 / np.abs(curvature[against]).max()
    assert hollow < 0.1 * cam.follower.base
    assert cam.least_radius_of_curvature == pytest.approx(hollow, rel=1e-4)
