"""Frequencies and shapes against closed forms."""

import time
from pathlib import Path

import kempe as kp
import numpy as np
import pytest
from house.places import ROOT
from modes.minimal_models import FourBar, G

from examples.n_four_bar import windows


def pendulum(spring: float = 0.0, damping: float = 0.0) -> kp.Model:
    m = kp.Model("pendulum", gravity=(0, -G))
    m.ground.points(A=(0, 0))
    m.bar("rod", mass=2, length=1.5, ends=("A", "B"))
    m.revolute("A", "ground.A", "rod.A")
    m.torsion_spring("spring", "ground", "rod", stiffness=spring, damping=damping)
    return m


def test_a_pendulum() -> None:
    m = pendulum()
    found = kp.modes(m, kp.assemble(m, set={"rod.angle": "-90*deg"}))
    omega = np.sqrt(1.5 * G / 1.5)
    assert found.omega[0] == pytest.approx(omega, rel=1e-14)
    assert found.frequency[0] == pytest.approx(omega / (2 * np.pi), rel=1e-14)
    assert found.damping[0] == 0.0
    assert found.is_equilibrium
    assert found.eigenvalues.shape == (1,)
    # rod.x, rod.y, rod.angle: the centre moves to the right
    np.testing.assert_allclose(found.shapes, [[0.75, 0, 1]], atol=1e-15)


def test_an_inverted_pendulum_has_two_real_modes() -> None:
    m = pendulum()
    found = kp.modes(m, kp.assemble(m, set={"rod.angle": "90*deg"}))
    rate = np.sqrt(G)
    np.testing.assert_allclose(found.eigenvalues, [-rate, rate], rtol=1e-14)
    np.testing.assert_allclose(found.frequency, 0.0)
    np.testing.assert_allclose(found.damping, [1.0, -1.0])
    assert not found.stable


@pytest.mark.parametrize("damping", [0.9, 40.0])
def test_a_damped_pendulum(damping: float) -> None:
    m = pendulum(damping=damping)
    found = kp.modes(m, kp.assemble(m, set={"rod.angle": "-90*deg"}))
    j = 2 * 1.5**2 / 3
    half, square = damping / (2 * j), G
    if half**2 < square:
        expected = np.array([-half + 1j * np.sqrt(square - half**2)])
    else:
        root = np.sqrt(half**2 - square)
        expected = np.array([-half + root, -half - root], dtype=complex)
    np.testing.assert_allclose(found.eigenvalues, expected, rtol=1e-12)
    np.testing.assert_allclose(found.damping, -expected.real / np.abs(expected), rtol=1e-12)
    assert len(found.eigenvalues) == 1 + (half**2 > square)


def test_a_double_pendulum() -> None:
    m = kp.Model("double pendulum", gravity=(0, -G))
    m.ground.points(O=(0, 0))
    for name in ("one", "two"):
        m.bar(name, mass=2, length=1.5, ends=("A", "B"))
    m.revolute("O", "ground.O", "one.A")
    m.revolute("P", "one.B", "two.A")
    found = kp.modes(m, kp.assemble(m, set={"one.angle": "-90*deg", "two.angle": "-90*deg"}))
    # uniform bars: [8 3; 3 2] m L² / 6 and diag(3, 1) m g L / 2
    mass = np.array([[8, 3], [3, 2]]) * 2 * 1.5**2 / 6
    stiffness = np.diag([3, 1]) * 2 * G * 1.5 / 2
    np.testing.assert_allclose(found.mass_matrix, mass, rtol=1e-13)
    np.testing.assert_allclose(found.stiffness_matrix, stiffness, atol=1e-13)
    # det(K - ω² M) = 0: 7 x² / 36 - 7 x / 6 + 3 / 4 = 0 for x = ω² L / g, so x = 3 ± 6/√7
    squares = (3 + np.array([-6, 6]) / np.sqrt(7)) * G / 1.5
    np.testing.assert_allclose(found.omega, np.sqrt(squares), rtol=1e-13)
    angles = found.shapes[:, [2, 5]]
    for square, shape in zip(squares, angles, strict=True):
        np.testing.assert_allclose((stiffness - square * mass) @ shape, 0, atol=1e-12 * square)
    assert angles[0, 0] * angles[0, 1] > 0 > angles[1, 0] * angles[1, 1]


@pytest.mark.parametrize("n", [1, 4, 40, 300])
def test_hanging_windows(n: int) -> None:
    """All windows hang as one crank: ω² = 3 g (3 n + 1) / (2 L (4 n + 1)); 901 bodies in 5 s."""
    model = windows(n).compile()
    hints = {f"coupler{k}.angle": 0.0 for k in range(n)}
    hints |= {f"crank{k}.angle": -np.pi / 2 for k in range(n + 1)}
    start = kp.assemble(model, set={"crank0.angle": -np.pi / 2}, guess=hints)
    begun = time.perf_counter()
    found = kp.modes(model, start)
    assert time.perf_counter() - begun < 5.0
    square = 3 * 9.81 * (3 * n + 1) / (2 * (4 * n + 1))
    assert len(found.eigenvalues) == 1
    assert found.omega[0] ** 2 == pytest.approx(square, rel=1e-10)
    assert found.omega[0] ** 2 == pytest.approx(square, rel=1e-12)


def test_a_bead_on_a_parabola() -> None:
    """The contact has a coordinate of its own without mass: y = a x², ω² = 2 a g."""
    m = kp.Model("bead", gravity=(0, -G))
    m.ground.curves(bowl={"x": "u", "y": "0.8*u^2", "range": [-2, 2]})
    m.point_mass("bead", mass=3)
    m.point_on_curve("contact", "bead.P", "ground.bowl")
    found = kp.modes(m, kp.assemble(m, set={"bead.x": 0}))
    assert found.coordinates == ("bead.x",)
    assert found.omega[0] == pytest.approx(np.sqrt(1.6 * G), rel=1e-12)


def test_a_redundant_parallelogram() -> None:
    """A third crank repeats a constraint; the frequency is that of all links."""
    m = kp.Model("parallelogram", gravity=(0, -G), redundancy="allow")
    m.ground.points(**{f"P{k}": (k, 0) for k in range(3)})
    for k in range(3):
        m.bar(f"crank{k}", mass=1, length=1, ends=("A", "B"))
    m.bar("coupler", mass=2, length=2, ends=("A", "B"), points={"M": (0, 0)})
    for k, end in enumerate("AMB"):
        m.revolute(f"A{k}", f"ground.P{k}", f"crank{k}.A")
        m.revolute(f"B{k}", f"crank{k}.B", f"coupler.{end}")
    hints = {f"crank{k}.angle": -np.pi / 2 for k in range(3)} | {"coupler.angle": 0.0}
    found = kp.modes(m, kp.assemble(m, set={"crank0.angle": -np.pi / 2}, guess=hints))
    assert found.omega[0] ** 2 == pytest.approx(G * (1.5 + 2) / (1 + 2), rel=1e-12)


def test_a_driver_holds_its_coordinate() -> None:
    m = kp.Model("held", gravity=(0, -G))
    m.ground.points(O=(0, 0))
    for name in ("one", "two"):
        m.bar(name, mass=2, length=1.5, ends=("A", "B"))
    m.revolute("O", "ground.O", "one.A")
    m.revolute("P", "one.B", "two.A")
    m.coordinate_driver("hold", "one.angle", value=0.3)
    start = kp.assemble(m, set={"two.angle": "-90*deg"})
    found = kp.modes(m, start)
    assert found.coordinates == ("two.angle",)
    assert found.omega[0] == pytest.approx(np.sqrt(G), rel=1e-13)


def test_a_cart_that_rolls_freely() -> None:
    m = kp.Model("cart")
    m.ground.points(O=(0, 0))
    m.body("cart", mass=2, inertia=1, points={"C": (0, 0)})
    m.translational("rail", "ground.O", "cart.C")
    found = kp.modes(m, kp.assemble(m))
    np.testing.assert_array_equal(found.eigenvalues, [0, 0])
    assert found.damping.tolist() == [0.0, 0.0]
    assert "moves freely" in str(found)


def test_many_free_links() -> None:
    """A hanging chain of equal bars has the modes of its mass and stiffness matrix by hand."""
    n = 60
    m = kp.Model("chain", gravity=(0, -G))
    m.ground.points(O=(0, 0))
    for k in range(n):
        m.bar(f"l{k}", mass=1, length=0.1, ends=("P", "Q"))
        m.revolute(f"j{k}", "ground.O" if k == 0 else f"l{k - 1}.Q", f"l{k}.P")
    found = kp.modes(m, kp.assemble(m, set={f"l{k}.angle": -np.pi / 2 for k in range(n)}))
    below = np.arange(n, 0, -1) - 1.0
    mass = 0.01 * (np.minimum.outer(below, below) + 0.5 - np.eye(n) * (0.5 - 1 / 3))
    stiffness = np.diag(0.1 * G * (below + 0.5))
    np.testing.assert_allclose(found.mass_matrix, mass, rtol=1e-11)
    np.testing.assert_allclose(found.stiffness_matrix, stiffness, atol=1e-11)
    squares = np.sort(np.linalg.eigvals(np.linalg.solve(mass, stiffness)).real)
    np.testing.assert_allclose(found.omega**2, squares, rtol=1e-8)


def flagship() -> tuple[kp.Model, kp.State]:
    """The flagship at rest, by the minimal model; the crank is released there."""
    m = kp.load(ROOT / "examples" / "four_bar.toml").model
    angle = FourBar().rest(np.radians(70))
    hints = {"coupler.angle": "14*deg", "rocker.angle": "240*deg"}
    return m, kp.assemble(m, set={"crank.angle": angle}, guess=hints)


def test_the_flagship_decays_as_its_mode() -> None:
    """A release by 1e-3 rad: the period and the decrement of the rates on the way through rest."""
    m, rest = flagship()
    found = kp.modes(m, rest)
    assert found.is_equilibrium and found.stable and len(found.eigenvalues) == 1
    level = rest["crank.angle"]
    hints = {"coupler.angle": rest["coupler.angle"], "rocker.angle": rest["rocker.angle"]}
    start = kp.assemble(m, set={"crank.angle": level + 1e-3}, guess=hints)
    sol = kp.dynamics(
        m,
        start,
        t_end=8 * 2 * np.pi / found.eigenvalues[0].imag,
        method=kp.DOP853(rtol=1e-12, atol=1e-14),
        events={"through": kp.Event(f"crank.angle - {level!r}", direction="falling")},
    )
    through = sol.events["through"]
    rates = np.array([state["crank.omega"] for state in through.states])
    assert len(rates) == 8
    times, rates = through.t[3:], rates[3:]
    rate = 2 * np.pi * (len(times) - 1) / (times[-1] - times[0])
    decay = np.log(rates[0] / rates[-1]) / (times[-1] - times[0])
    assert found.frequency[0] == pytest.approx(rate / (2 * np.pi), rel=1e-4)
    assert found.damping[0] == pytest.approx(decay / np.hypot(decay, rate), rel=1e-4)


def test_a_singular_position_is_refused() -> None:
    m = windows(1)
    hints = {"coupler0.angle": 0.0, "crank0.angle": 0.0, "crank1.angle": 0.0}
    with pytest.warns(kp.AssemblyWarning, match="singular"):
        flat = kp.assemble(m, set={"crank0.angle": 0}, guess=hints)
    with pytest.raises(kp.SingularityError, match="depend on each other"):
        kp.modes(m, flat)


def test_faults_are_named() -> None:
    m = pendulum(spring=3)
    rest = kp.assemble(m, set={"rod.angle": "-90*deg"})
    with pytest.raises(kp.ModelError, match=r"rod\.omega.*not a position quantity"):
        kp.modes(m, rest, inputs=["rod.omega"])
    with pytest.raises(kp.ModelError, match=r"rod\.angl"):
        kp.modes(m, rest, outputs=["rod.angl"])
    with pytest.raises(kp.ModelError, match="inputs"):
        kp.modes(m, rest, inputs="rod.angle")
    with pytest.raises(kp.ModelError, match="n: 0"):
        kp.modes(m, rest, n=0)
    for name in ("energy.balance", "drift.balance", "spring.dissipated", "energy.total"):
        with pytest.raises(kp.ModelError, match=f"'{name}' depends on the run"):
            kp.modes(m, rest, outputs=[name])
    with pytest.raises(kp.ModelError, match=r"energy\.work"):
        kp.modes(m, rest, outputs=["energy.work"])
    with pytest.raises(kp.AssemblyError, match="open by"):
        kp.modes(m, kp.State(m, 0, [1, 0, 0], [0, 0, 0]))
    with pytest.raises(kp.ModelError, match="no derivative"):
        still = kp.Model("weightless")
        still.ground.points(A=(0, 0))
        still.bar("rod", mass=2, length=1.5, ends=("A", "B"))
        still.revolute("A", "ground.A", "rod.A")
        kp.modes(still, kp.assemble(still), outputs=["A.force"])


def test_parameters_as_inputs() -> None:
    m = kp.Model("pendulum", gravity=(0, -G), parameters={"L": 1.5, "T": 0, "twice": "2*T"})
    m.ground.points(A=(0, 0))
    m.bar("rod", mass=2, length="L", ends=("A", "B"))
    m.revolute("A", "ground.A", "rod.A")
    m.torque("motor", "rod", torque="twice")
    rest = kp.assemble(m, set={"rod.angle": "-90*deg"})
    found = kp.modes(m, rest, inputs=["T", "twice"])
    np.testing.assert_allclose(found.B[1], np.array([2, 1]) / 1.5, rtol=1e-14)
    with pytest.raises(kp.ModelError, match="'L' changes the geometry"):
        kp.modes(m, rest, inputs=["L"])


def test_a_state_of_a_motion() -> None:
    m = pendulum(damping=0.1)
    sol = kp.dynamics(m, kp.assemble(m, set={"rod.angle": 0}), t_end=1)
    found = kp.modes(m, sol(0.4))
    slope = G * np.sin(sol(0.4)["rod.angle"])
    assert found.A[1, 0] == pytest.approx(slope, rel=1e-10)
    assert "moves at this state" in str(found)


def test_files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The analysis in a case, its tables and figures, and the shape as a film."""
    from kempe.cli import app

    case = kp.Case(
        pendulum(damping=0.4),
        {"set": {"rod.angle": "-90*deg"}},
        [kp.Modes(outputs=["rod.angle"], inputs=["rod.angle"], name="small")],
    )
    monkeypatch.chdir(tmp_path)
    case.save("pendulum.toml")
    assert app.run(["run", "pendulum.toml"]) == 0
    folder = next(path.parent for path in Path("out").rglob("modes.csv"))
    rows = np.genfromtxt(folder / "modes.csv", delimiter=",", skip_header=1)
    again = kp.load("pendulum.toml").run()["small"]
    np.testing.assert_array_equal(rows[1:3], again.eigenvalues.view(float))
    assert list(folder.rglob("*mode_1.png"))
    assert app.run(["modes", "pendulum.toml", "--figures", "none"]) == 0
    kp.animate(again.shape(0), "swing.gif", size=(160, 120), fps=5)
    assert Path("swing.gif").stat().st_size > 500


@pytest.mark.parametrize("n", [6, 7])
def test_a_report_names_six_independent_coordinates(n: int) -> None:
    m = kp.Model("rods", gravity=(0, -9.81))
    m.ground.points(O=(0, 0))
    for k in range(n):
        m.bar(f"r{k}", mass=1, length=1, ends=("O", "P"))
        m.revolute(f"p{k}", "ground.O", f"r{k}.O")
    found = kp.modes(m, kp.assemble(m, set={f"r{k}.angle": -np.pi / 2 for k in range(n)}))
    heading = found.report()[0]
    assert heading.startswith(f"{n} independent coordinates: ")
    named = heading.partition(": ")[2]
    assert named == ", ".join(found.coordinates[:6]) + (", …" if n > 6 else "")
