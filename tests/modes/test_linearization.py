"""State spaces against complex steps of models in minimal coordinates."""

import kempe as kp
import numpy as np
import pytest
import scipy.signal
from modes.minimal_models import CartPole, FourBar, G, slopes

#: Values of s, 1/s, relative to the fastest eigenvalue.
POINTS = (0.1j, 0.5j, 1j, 2j, 10j, 0.3, 1.7, -0.4 + 0.9j, 3 + 2j, 0.05 + 0.02j)


def agree(
    found: kp.ModesResult, a: np.ndarray, b: np.ndarray, c: np.ndarray, d: np.ndarray
) -> None:
    for own, expected in ((found.A, a), (found.B, b), (found.C, c), (found.D, d)):
        np.testing.assert_allclose(own, expected, rtol=1e-10, atol=1e-11 * np.abs(expected).max())
    expected = np.linalg.eigvals(a)
    for s in found.eigenvalues:
        assert np.abs(expected - s).min() <= 1e-9 * abs(s)
    fastest = np.abs(expected).max()
    for point in POINTS:
        s = point * fastest
        wanted = c @ np.linalg.solve(s * np.eye(len(a)) - a, b) + d
        np.testing.assert_allclose(
            found.transfer(s), wanted, rtol=1e-9, atol=1e-9 * np.abs(wanted).max()
        )


def cart_pole(model: CartPole) -> kp.Model:
    m = kp.Model("cart and pole", gravity=(0, -G), parameters={"F": 0.4, "b": 0.7})
    m.ground.points(O=(0, 0))
    m.body("cart", mass=model.M, inertia=1, points={"C": (0, 0)})
    m.bar("pole", mass=model.m, length=model.L, ends=("A", "B"))
    m.translational("rail", "ground.O", "cart.C")
    m.revolute("pin", "cart.C", "pole.A")
    m.generalized_force("push", "cart.x", value="F - b*cart.vx")
    m.torsion_spring("spring", "ground", "pole", stiffness=model.k)
    return m


@pytest.mark.parametrize("state", [(0.3, 0.7, 0.0, 0.0), (0.3, 2.1, -0.8, 1.9)])
def test_a_cart_and_a_pole(state: tuple[float, ...]) -> None:
    own = CartPole()
    m = cart_pole(own)
    x, angle, v, rate = state
    start = kp.assemble(m, set={"cart.x": x, "pole.angle": angle, "cart.vx": v, "pole.omega": rate})
    found = kp.modes(
        m,
        start,
        inputs=["F", "b", "cart.x", "pole.angle"],
        outputs=["pole.B.x", "pole.B.vy", "pole.alpha", "pin.fx", "pin.fy", "energy.kinetic"],
    )
    assert found.coordinates == ("cart.x", "pole.angle")
    assert found.state_names == ("cart.x", "pole.angle", "cart.vx", "pole.omega")
    at = [x, angle, v, rate, 0.4, 0.7]
    rates = slopes(own.accelerations, at)
    outputs = slopes(own.outputs, at)
    # a torque on the pole is a change of the right side of its equation: by the mass matrix
    h, inertia = own.L / 2.0, own.m * own.L**2 / 3.0
    mass = np.array([[own.M + own.m, -own.m * h * np.sin(angle)], [0.0, inertia]])
    mass[1, 0] = mass[0, 1]
    by_torque = np.linalg.solve(mass, [0.0, 1.0])
    s, c = np.sin(angle), np.cos(angle)
    a = np.vstack([[0, 0, 1, 0], [0, 0, 0, 1], rates[:, :4]])
    b = np.zeros((4, 4))
    b[2:, :2], b[2:, 2], b[2:, 3] = rates[:, 4:], rates[:, 4], by_torque
    d = np.column_stack([outputs[:, 4:], outputs[:, 4], np.zeros(6)])
    d[2, 3] = by_torque[1]
    d[3, 3] = own.m * (by_torque[0] - h * s * by_torque[1])
    d[4, 3] = own.m * h * c * by_torque[1]
    agree(found, a, b, outputs[:, :4], d)
    np.testing.assert_allclose(found.values, np.real(own.outputs(np.array(at))), rtol=1e-12)
    np.testing.assert_allclose(found.mass_matrix, mass, rtol=1e-13)
    np.testing.assert_allclose(found.stiffness_matrix, -mass @ rates[:, :2], atol=1e-12)
    np.testing.assert_allclose(found.damping_matrix, -mass @ rates[:, 2:4], atol=1e-12)


def four_bar(own: FourBar) -> kp.Model:
    m = kp.Model("four-bar", gravity=(0, -G), parameters={"k": own.k, "T": 0})
    m.ground.points(A=(0, 0), D=(own.d, 0))
    lengths = (("crank", "AB", own.a), ("coupler", "BC", own.b), ("rocker", "CD", own.c))
    for (name, ends, length), mass in zip(lengths, own.masses, strict=True):
        m.bar(name, mass=mass, length=length, ends=(ends[0], ends[1]))
    m.revolute("A", "ground.A", "crank.A")
    m.revolute("B", "crank.B", "coupler.B")
    m.revolute("C", "coupler.C", "rocker.C")
    m.revolute("D", "ground.D", "rocker.D")
    m.torsion_spring(
        "spring", "ground", "rocker", stiffness="k", damping=own.damping, free_angle=own.free
    )
    m.torque("motor", "crank", torque="T")
    return m


def placed(m: kp.Model, crank: float, rate: float = 0.0) -> kp.State:
    hints = {"coupler.angle": "14*deg", "rocker.angle": "240*deg"}
    return kp.assemble(m, set={"crank.angle": crank, "crank.omega": rate}, guess=hints)


@pytest.mark.parametrize(("crank", "rate"), [(1.2, 0.0), (1.2, 2.5)])
def test_a_four_bar_with_a_spring(crank: float, rate: float) -> None:
    own = FourBar()
    m = four_bar(own)
    start = placed(m, crank, rate)
    assert start["rocker.angle"] == pytest.approx(float(own.angles(crank)[1]), abs=1e-12)
    outputs = ["rocker.angle", "coupler.y", "coupler.vx", "rocker.alpha"]
    found = kp.modes(m, start, inputs=["T", "k", "crank.angle"], outputs=outputs)
    assert found.coordinates == ("crank.angle",)
    at = [crank, rate, 0.0, own.k]
    rates, seen = slopes(lambda x: [own.acceleration(x)], at), slopes(own.outputs, at)
    a = np.vstack([[0, 1], rates[:, :2]])
    b = np.vstack([np.zeros(3), [*rates[0, 2:], rates[0, 2]]])
    d = np.column_stack([seen[:, 2:], seen[:, 2]])
    agree(found, a, b, seen[:, :2], d)
    one = scipy.signal.StateSpace(found.A, found.B[:, :1], found.C[:1], found.D[:1, :1])
    times = np.linspace(0, 1, 401)
    _, response, _ = scipy.signal.lsim(one, np.zeros_like(times), times, [1.0, 0.0])
    s = found.eigenvalues[0]
    # a free motion from rest, by the roots
    angle = np.real(np.exp(s * times) * (1 + 1j * s.real / s.imag))
    np.testing.assert_allclose(response, found.C[0, 0] * angle, rtol=1e-8, atol=1e-9)


def test_a_pendulum_on_a_driven_cart() -> None:
    """The acceleration of the pivot belongs to the stiffness: θ̈ = -3 (g sin θ + ẍ cos θ) / 2 L."""
    length, rate, t = 1.2, 5.0, 0.3
    m = kp.Model("driven", gravity=(0, -G))
    m.ground.points(O=(0, 0))
    m.body("cart", mass=2, inertia=1, points={"C": (0, 0)})
    m.bar("pole", mass=0.8, length=length, ends=("A", "B"))
    m.translational("rail", "ground.O", "cart.C")
    m.revolute("pin", "cart.C", "pole.A")
    m.coordinate_driver("shaker", "cart.x", value=f"0.4*sin({rate}*t)")
    angle = 0.6  # from the vertical
    start = kp.assemble(m, set={"pole.angle": angle - np.pi / 2, "pole.omega": 1.1}, t=t)
    found = kp.modes(m, start, outputs=["shaker.effort"])
    assert found.coordinates == ("pole.angle",)
    pivot = -0.4 * rate**2 * np.sin(rate * t)
    slope = -1.5 / length * (G * np.cos(angle) - pivot * np.sin(angle))
    np.testing.assert_allclose(found.A, [[0, 1], [slope, 0]], rtol=1e-12, atol=1e-12)

    def effort(x: np.ndarray) -> list[complex]:
        theta, omega = x
        alpha = -1.5 / length * (G * np.sin(theta) + pivot * np.cos(theta))
        swing = 0.5 * length * (np.cos(theta) * alpha - np.sin(theta) * omega**2)
        return [2.8 * pivot + 0.8 * swing]

    np.testing.assert_allclose(found.C, slopes(effort, [angle, 1.1]), rtol=1e-11)
    np.testing.assert_allclose(found.values, np.real(effort(np.array([angle, 1.1]))), rtol=1e-12)


def test_a_motor_with_inductance() -> None:
    j, k, r, inductance = 0.02, 0.3, 1.5, 0.01
    m = kp.Model("motor", parameters={"V": 12, "load": 0.1})
    m.ground.points(O=(0, 0))
    m.body("rotor", mass=1, inertia=j, points={"O": (0, 0)})
    m.revolute("shaft", "ground.O", "rotor.O")
    m.motor("motor", "rotor", voltage="V", resistance=r, inductance=inductance, torque_constant=k)
    m.torque("drag", "rotor", torque="-load*rotor.omega")
    start = kp.assemble(m, set={"rotor.omega": 3})
    found = kp.modes(
        m, start, inputs=["V", "rotor.angle"], outputs=["motor.current", "motor.torque"]
    )
    assert found.state_names == ("rotor.angle", "rotor.omega", "motor.current")
    a = [[0, 1, 0], [0, -0.1 / j, k / j], [0, -k / inductance, -r / inductance]]
    np.testing.assert_allclose(found.A, a, rtol=1e-13)
    np.testing.assert_allclose(found.B, [[0, 0], [0, 1 / j], [1 / inductance, 0]], rtol=1e-13)
    np.testing.assert_allclose(found.C, [[0, 0, 1], [0, 0, k]], rtol=1e-13)
    assert not found.D.any()
    expected = np.linalg.eigvals(np.array(a, dtype=float))
    for s in found.eigenvalues:
        assert np.abs(expected - s).min() < 1e-11 * max(abs(s), 1.0)
