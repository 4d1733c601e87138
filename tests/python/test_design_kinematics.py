"""Kinematic design against closed forms: paths, transmission, ratios, centres, polygons."""

import kempe as kp
import numpy as np
import pytest
from kempe import design
from python.test_kinematics import L, R, piston, slider_crank, started
from scipy.optimize import brentq
from scipy.special import ellipe

TURN = (0.0, 2.0 * np.pi)
#: Crank, coupler, rocker and ground of a crank-rocker, m, and the coupler point.
A, B, C, G, P = 0.12, 0.40, 0.30, 0.40, (0.05, 0.2)


def four_bar() -> kp.Model:
    """A crank-rocker."""
    m = kp.Model("four-bar")
    m.ground.points(O=(0, 0), D=(G, 0))
    m.body("crank", mass=1, inertia=0.01, points={"O": (0, 0), "A": (A, 0)})
    m.body("coupler", mass=1, inertia=0.01, points={"A": (0, 0), "B": (B, 0), "P": P})
    m.body("rocker", mass=1, inertia=0.01, points={"B": (0, 0), "D": (C, 0)})
    m.revolute("O", "ground.O", "crank.O")
    m.revolute("A", "crank.A", "coupler.A")
    m.revolute("B", "coupler.B", "rocker.B")
    m.revolute("D", "rocker.D", "ground.D")
    m.coordinate_driver("motor", "crank.angle", value="5*t")
    return m


@pytest.fixture(scope="module")
def crank_rocker() -> kp.Solution:
    m = four_bar()
    start = kp.assemble(m, guess={"coupler.angle": "50 deg", "rocker.angle": "-90 deg"})
    return kp.kinematics(m, start, over="crank.angle", range=TURN, n=73)


@pytest.fixture(scope="module")
def engine() -> kp.Solution:
    m = slider_crank()
    return kp.kinematics(m, started(m), over="crank.angle", range=TURN, n=73)


def algebraic(theta: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Crank pin and rocker pin of the open crank-rocker as complex numbers."""
    a = A * np.exp(1j * theta)
    d = G - a
    size = np.abs(d)
    along = (B**2 - C**2 + size**2) / (2 * size)
    return a, a + d / size * (along + 1j * np.sqrt(B**2 - along**2))


# --- coupler curves -------------------------------------------------------------------------------


def test_the_path_of_a_trammel_is_an_ellipse() -> None:
    m = kp.Model("trammel")
    m.ground.points(O=(0, 0))
    m.body("rod", mass=1, inertia=0.01, points={"A": (0, 0), "B": (0.5, 0), "P": (0.2, 0)})
    m.body("sx", mass=1, inertia=0.01, points={"A": (0, 0)})
    m.body("sy", mass=1, inertia=0.01, points={"B": (0, 0)})
    m.revolute("A", "sx.A", "rod.A")
    m.revolute("B", "sy.B", "rod.B")
    m.translational("X", "ground.O", "sx.A", axes=(0, 0))
    m.translational("Y", "ground.O", "sy.B", axes=(np.pi / 2, np.pi / 2))
    m.coordinate_driver("d", "rod.angle", value="t")
    start = kp.assemble(m, guess={"rod.angle": 0.3, "sx.x": 0.4, "rod.x": 0.4})
    for ends, sign in (((0.3, 0.3 + 2 * np.pi), -1), ((0.3, 0.3 - 2 * np.pi), 1)):
        found = design.coupler_curve(kp.kinematics(m, start, over="d", range=ends), "rod.P")
        assert found.closed
        assert not len(found.cusps)
        assert found.length == pytest.approx(4 * 0.3 * ellipe(1 - (0.2 / 0.3) ** 2), rel=1e-13)
        assert found.area == pytest.approx(sign * np.pi * 0.3 * 0.2, rel=1e-13)
    half = design.coupler_curve(kp.kinematics(m, start, over="d", range=(0.0, np.pi)), "rod.P")
    assert not half.closed
    assert half.area is None
    assert half.length == pytest.approx(2 * 0.3 * ellipe(1 - (0.2 / 0.3) ** 2), rel=1e-12)


def test_length_and_area_of_a_coupler_curve(crank_rocker: kp.Solution) -> None:
    theta = np.linspace(0, 2 * np.pi, 4096, endpoint=False)
    a, b = algebraic(theta)
    p = a + (b - a) / B * complex(*P)
    # derivatives by theta from the Fourier series, which converges to rounding
    dp = np.fft.ifft(1j * np.fft.fftfreq(4096, 1 / 4096) * np.fft.fft(p))
    length = np.abs(dp).mean() * 2 * np.pi
    area = 0.5 * (np.conj(p) * dp).imag.mean() * 2 * np.pi
    for place in ("coupler.P", ("coupler", P)):
        found = design.coupler_curve(crank_rocker, place)
        assert found.closed
        assert found.length == pytest.approx(length, rel=1e-12)
        assert found.area == pytest.approx(area, rel=1e-12)
    assert found.position[0] == pytest.approx([p[0].real, p[0].imag], abs=1e-13)


def test_the_same_path_over_time_and_from_dynamics_has_the_same_length(
    crank_rocker: kp.Solution,
) -> None:
    m = four_bar()
    length = design.coupler_curve(crank_rocker, "coupler.P").length
    start = kp.assemble(m, guess={"coupler.angle": "50 deg", "rocker.angle": "-90 deg"})
    over_time = kp.kinematics(m, start, t_end="2*pi/5", output_step=0.1)
    found = design.coupler_curve(over_time, "coupler.P")
    assert found.length == pytest.approx(length, rel=1e-12)
    assert found.closed
    back = kp.kinematics(m, over_time.final, t_end="4*pi/5", output_step=0.1)
    assert design.coupler_curve(back, "coupler.P").length == pytest.approx(length, rel=1e-12)


@pytest.mark.parametrize("share", [1.0, 0.5])
def test_a_cycloid_has_cusps_on_the_rim_only(share: float) -> None:
    """A wheel that rolls on a line: the point at share r of the centre."""
    r = 0.25
    m = kp.Model("wheel")
    m.ground.points(O=(0, 0))
    m.body("wheel", mass=1, inertia=0.01, points={"C": (0, 0), "P": (share * r, 0)})
    m.rolling("roll", "ground.O", "wheel.C", radius=r)
    m.coordinate_driver("d", "wheel.angle", value="-t")
    start = kp.assemble(m, guess={"wheel.y": r})
    sol = kp.kinematics(m, start, over="wheel.angle", range=(-0.4, -0.4 - 4 * np.pi))
    found = design.coupler_curve(sol, "wheel.P")
    # P is at the contact where the angle is -π/2 - 2 k π
    cusps = [-0.5 * np.pi, -2.5 * np.pi] if share == 1.0 else []
    assert list(found.cusps) == pytest.approx(cusps, abs=1e-12)
    if cusps:
        assert found.cusp_positions[:, 1] == pytest.approx([0.0, 0.0], abs=1e-15)
        assert found.length == pytest.approx(16 * r, rel=1e-12)  # two arches of 8 r
    else:  # a curtate cycloid, by the complete elliptic integral
        k = 4 * share / (1 + share) ** 2
        assert found.length == pytest.approx(8 * r * (1 + share) * ellipe(k), rel=1e-12)
    assert not found.closed


def test_a_point_that_does_not_move_or_is_not_there_is_refused(crank_rocker: kp.Solution) -> None:
    with pytest.raises(kp.ModelError, match="does not move"):
        design.coupler_curve(crank_rocker, "crank.O")
    with pytest.raises(kp.ModelError, match=r"unknown point of coupler 'Q'"):
        design.coupler_curve(crank_rocker, "coupler.Q")
    with pytest.raises(kp.ModelError, match="is not a point"):
        design.coupler_curve(crank_rocker, 3)  # type: ignore[arg-type]


# --- transmission ---------------------------------------------------------------------------------


def test_the_transmission_angle_of_a_slider_crank(engine: kp.Solution) -> None:
    found = design.transmission_angle(engine, "B")
    assert found.angle == pytest.approx(np.arccos(R / L * np.sin(found.t)), abs=2e-12)
    assert found.limits.least.value == pytest.approx(np.arccos(R / L), abs=2e-12)
    assert found.limits.least.t == pytest.approx(np.pi / 2, abs=1e-6)
    assert found.limits.largest.value == pytest.approx(np.arccos(-R / L), abs=2e-12)
    assert found.worst.value == pytest.approx(np.arccos(R / L), abs=2e-12)
    assert found.transmission.min() == pytest.approx(found.worst.value, abs=1e-5)


def test_the_transmission_angle_of_a_four_bar(crank_rocker: kp.Solution) -> None:
    found = design.transmission_angle(crank_rocker, "B")
    diagonal = A**2 + G**2 - 2 * A * G * np.cos(found.t)
    cosine = (B**2 + C**2 - diagonal) / (2 * B * C)
    assert found.angle == pytest.approx(np.arccos(cosine), abs=2e-12)
    assert np.sin(found.deviation) == pytest.approx(-cosine, abs=2e-12)  # positive beyond π/2
    assert found.deviation.min() < 0.0 < found.deviation.max()
    assert np.sin(found.transmission) == pytest.approx(np.sqrt(1.0 - cosine**2), abs=2e-12)
    least, most = (np.arccos((B**2 + C**2 - d**2) / (2 * B * C)) for d in (G - A, G + A))
    assert found.limits.least.value == pytest.approx(least, abs=2e-12)
    assert found.limits.largest.value == pytest.approx(most, abs=2e-12)
    with_lines = design.transmission_angle(crank_rocker, "B", lines={"coupler": "coupler.P"})
    beside = found.angle - np.arctan2(P[1], B - P[0])  # P is on the side of the rocker
    assert np.abs(with_lines.angle - np.abs(beside)).max() < 1e-12 or np.abs(
        with_lines.angle - (found.angle + np.arctan2(P[1], B - P[0]))
    ).max() == pytest.approx(0.0, abs=1e-12)


def test_a_link_without_a_unique_line_is_refused() -> None:
    sol = kp.load("examples/six_bar.toml").run()[0]
    joints = [name for name, info in sol.compiled.joints.items() if "plate" in (info.i, info.j)]
    with pytest.raises(kp.ModelError, match=r"plate has 2 other joints .* not unique"):
        design.transmission_angle(sol, joints[0])
    with pytest.raises(kp.ModelError, match="does not connect"):
        design.transmission_angle(sol, joints[0], lines={"nobody": "plate.X"})


def test_velocity_ratio_and_mechanical_advantage(engine: kp.Solution) -> None:
    _, first, _ = piston(engine.t)
    ratio = design.velocity_ratio(engine, "piston.x", "crank.angle")
    assert ratio == pytest.approx(first, abs=1e-14)
    advantage = design.mechanical_advantage(engine, "piston.vx", "crank.omega")
    inner = np.abs(np.sin(engine.t)) > 1e-9
    assert advantage[inner] == pytest.approx(1 / first[inner], rel=1e-10)
    assert np.isinf(advantage[~inner]).all()
    static = -10.0 * first  # torque that balances 10 N on the piston
    assert 10.0 / advantage[inner] == pytest.approx(-static[inner], rel=1e-10)


def test_a_mechanism_at_rest_has_no_ratio() -> None:
    m = slider_crank()
    m = kp.Model.from_tree({**m.tree(), "drivers": {"motor": {**m.tree()["drivers"]["motor"]}}})
    tree = m.tree()
    tree["drivers"]["motor"]["value"] = "0.2 + cycloidal(t)"
    m = kp.Model.from_tree(tree)
    sol = kp.kinematics(m, started(m), t_end=1.0)
    with pytest.raises(kp.ModelError, match="both stand still at t = 0 s"):
        design.velocity_ratio(sol, "piston.x", "crank.angle")
    with pytest.raises(kp.ModelError, match="at rest against each other at t = 0 s"):
        design.instant_centre(sol, "ground", "rod")


def test_toggle_positions_of_a_crank_rocker(crank_rocker: kp.Solution) -> None:
    found = design.toggles(crank_rocker, "rocker.angle")
    # coupler and crank in line: triangles with the sides B ± A, C, G
    outer = np.arccos(((B + A) ** 2 + G**2 - C**2) / (2 * (B + A) * G))
    inner = np.pi + np.arccos(((B - A) ** 2 + G**2 - C**2) / (2 * (B - A) * G))
    assert [one.t for one in found] == pytest.approx([outer, inner], abs=1e-11)
    assert [one.in_line for one in found] == [(("crank", "coupler"),)] * 2
    assert found[0].value == pytest.approx(float(crank_rocker(outer)["rocker.angle"]), abs=1e-13)
    with pytest.raises(kp.ModelError, match="does not move"):
        design.toggles(crank_rocker, "crank.O.x")


def test_toggles_at_outputs_and_at_the_ends_of_a_motion(engine: kp.Solution) -> None:
    """The dead points of a piston, at which its rate is a rounding error or zero."""
    found = design.toggles(engine, "piston.x")
    assert [one.t for one in found] == pytest.approx([0.0, np.pi, 2 * np.pi], abs=1e-11)
    assert [one.value for one in found] == pytest.approx([R + L, L - R, R + L], abs=1e-13)
    assert all(("crank", "rod") in one.in_line for one in found)


# --- instantaneous centres ------------------------------------------------------------------------


def test_the_centre_of_the_rod_of_a_slider_crank(engine: kp.Solution) -> None:
    found = design.instant_centre(engine, "ground", "rod")
    x = piston(engine.t)[0]
    expected = np.column_stack([x, x * np.tan(engine.t)])
    finite = ~found.at_infinity
    assert found.position[finite] == pytest.approx(expected[finite], rel=1e-11, abs=1e-12)
    # at 90° and 270° the rod only shifts
    assert engine.t[~finite] == pytest.approx([np.pi / 2, 3 * np.pi / 2])
    assert np.isinf(found.position[~finite]).all()
    assert np.abs(found.direction[~finite]) == pytest.approx(np.array([[0, 1]] * 2), abs=1e-12)
    same = design.instant_centre(engine, "rod", "ground")
    assert same.position[finite] == pytest.approx(found.position[finite], rel=1e-12)


def test_a_slide_has_its_centre_at_infinity_across_its_axis(engine: kp.Solution) -> None:
    state = engine(1.0)
    found = design.instant_centre(state, "ground", "piston")
    assert found.at_infinity
    assert np.abs(found.direction) == pytest.approx([0, 1], abs=1e-12)


def test_the_centres_of_three_bodies_are_in_line(crank_rocker: kp.Solution) -> None:
    """Aronhold and Kennedy, for all triples of bodies."""
    bodies = ["ground", "crank", "coupler", "rocker"]
    motion = crank_rocker(np.linspace(0.1, 6.0, 40))
    for k in range(4):
        i, j, m = (name for n, name in enumerate(bodies) if n != k)
        p, q, r = (
            design.instant_centre(motion, *pair).position for pair in ((i, j), (j, m), (i, m))
        )
        a, b = q - p, r - p
        area = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
        assert np.abs(area / (np.hypot(*a.T) * np.hypot(*b.T) + 1e-3)).max() < 1e-11


def test_centrodes_roll_on_each_other(crank_rocker: kp.Solution) -> None:
    motion = crank_rocker(np.linspace(0.5, 1.5, 11))
    found = design.instant_centre(motion, "ground", "coupler")
    for body in ("ground", "coupler"):
        view, own = motion.body(body), found.seen_from(body)
        cos, sin = np.cos(view.angle), np.sin(view.angle)
        back = np.column_stack(
            [cos * own[:, 0] - sin * own[:, 1], sin * own[:, 0] + cos * own[:, 1]]
        )
        assert back + view.r == pytest.approx(found.position, rel=1e-11)


# --- polygons -------------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", ["velocity", "acceleration"])
@pytest.mark.parametrize("example", ["quick_return", "six_bar", "jansen_leg", "toggle_press"])
def test_the_sides_of_a_polygon_lead_from_image_to_image(kind: str, example: str) -> None:
    """Relative vectors follow from ω and α, images from the points: both must fit."""
    sol = kp.load(f"examples/{example}.toml").run()[0]
    t = float(sol.t[len(sol.t) // 3])
    polygon = getattr(design, f"{kind}_polygon")(sol, t)
    scale = max(np.hypot(*image) for image in polygon.images.values())
    ends = {}
    for side in polygon.sides:
        if side.part == "absolute":
            assert side.vector == pytest.approx(polygon.images[side.name], abs=1e-12 * scale)
        else:
            ends[side.name, side.body] = side.end  # the last of several parts
    assert ends
    for (name, _), end in ends.items():
        to = max((p for p in polygon.images if name.startswith(p)), key=len)
        assert end == pytest.approx(polygon.images[to], abs=1e-9 * scale), name


def test_coriolis_acceleration_of_a_quick_return() -> None:
    sol = kp.load("examples/quick_return.toml").run()[0]
    state = sol(float(sol.t[40]))
    polygon = design.acceleration_polygon(state)
    side = next(side for side in polygon.sides if side.part == "coriolis")
    size = 2 * abs(state["lever.omega"] * state["slot.rate"])
    assert np.hypot(*side.vector) == pytest.approx(size, rel=1e-12)
    with pytest.raises(kp.ModelError, match="one instant only"):
        design.velocity_polygon(state, 99.0)


def test_the_polygon_of_a_four_bar_by_the_law_of_sines(crank_rocker: kp.Solution) -> None:
    theta = 1.1
    a, b = algebraic(np.array(theta))
    polygon = design.velocity_polygon(crank_rocker, theta)
    assert set(polygon.images) == {"o", "A", "B", "P"}
    across_rocker = 1j * (b - G) / C
    va = 1j * a
    # v_B along its direction has the same component along the coupler as v_A
    along = (b - a) / B
    size = (np.conj(along) * va).real / (np.conj(along) * across_rocker).real
    assert polygon.images["B"] @ [1, 1j] == pytest.approx(size * across_rocker, abs=1e-13)
    root = brentq(lambda s: ((s * across_rocker - va) * np.conj(along)).real, -9, 9, xtol=1e-15)
    assert size == pytest.approx(root, abs=1e-12)
