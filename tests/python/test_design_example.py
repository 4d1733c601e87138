"""The example of the design, in Python and as a file."""

from pathlib import Path

import kempe as kp
import numpy as np
import pytest

# Haug's four-bar at 70°, from an independent minimal-coordinate formulation.
Q_START = [
    *(1.7101007166283442, 4.698463103929542, 1.2217304763960306),
    *(16.019504829655535, 12.599667834261764, 0.24892758450469243),
    *(24.30940411302719, 7.901204730332221, 4.213075806186499),
]


def run_the_python_example(t_end: float = 15) -> kp.Solution:
    # fmt: off
    m = kp.Model("four-bar", gravity=(0, -9.81), parameters={"L1": 10, "L2": 26, "L3": 18, "k": 1e6, "c": 1e4})  # noqa: E501
    m.ground.points(A=(0, 0), D=(20, 0))
    m.bar("crank",   mass=3, length="L1", ends=("A", "B"))       # uniform slender bar; frame at its centre, x along it;  # noqa: E501
    m.bar("coupler", mass=5, length="L2", ends=("B", "C"))       # points named at (-L/2, 0) and (L/2, 0)  # noqa: E501
    m.bar("rocker",  mass=4, length="L3", ends=("C", "D"))       # general: m.body(name, mass=, inertia=, points={...})  # noqa: E501
    m.revolute("A", "ground.A", "crank.A")                       # joint(name, i, j): Φ = point_j - point_i  # noqa: E501
    m.revolute("B", "crank.B", "coupler.B")
    m.revolute("C", "coupler.C", "rocker.C")
    m.revolute("D", "ground.D", "rocker.D")
    m.torsion_spring("spring", "ground", "rocker", stiffness="k", damping="c", free_angle="270*deg")

    start = kp.assemble(m, set={"crank.angle": "70*deg"}, guess={"coupler.angle": "14*deg", "rocker.angle": "240*deg"})  # noqa: E501
    sol = kp.dynamics(m, start, t_end=t_end, output_step=0.01,
                      method=kp.RK45(rtol=1e-6, atol=1e-9), stabilization=kp.Baumgarte(alpha=10, beta=200))  # noqa: E501
    # fmt: on
    return sol  # noqa: RET504


@pytest.fixture(scope="module")
def sol() -> kp.Solution:
    return run_the_python_example()


def test_the_start_agrees_with_the_reference(sol: kp.Solution) -> None:
    np.testing.assert_allclose(sol.q[0], Q_START, atol=1e-6)
    assert np.linalg.norm(sol["C"].force(on="coupler")[0]) == pytest.approx(24932.0, rel=1e-3)


def test_it_settles_within_the_known_time(sol: kp.Solution) -> None:
    from kempe.report import summary

    times = {body["body"]: body["time"] for body in summary(sol)["settling"]}
    assert all(2.0 < time < 2.5 for time in times.values())


def test_the_quantities_of_the_example_exist(sol: kp.Solution) -> None:
    n = len(sol.t)
    assert n == 1501
    assert sol["rocker"].angle.shape == (n,)
    assert sol["C"].force(on="coupler", frame="joint").shape == (n, 2)
    spring = sol["spring"]
    parts = spring.stiffness_torque(on="rocker") + spring.damping_torque(on="rocker")
    np.testing.assert_allclose(spring.torque(on="rocker"), parts, atol=1e-6)


def test_the_file_gives_the_same_solution(sol: kp.Solution) -> None:
    case = kp.load(Path(__file__).with_name("four_bar.toml"))
    np.testing.assert_array_equal(case.run()["release"].q, sol.q)


def test_the_last_line_draws_and_animates(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A shorter run has fewer pictures."""
    monkeypatch.chdir(tmp_path)
    sol = run_the_python_example(1)
    kp.plot.positions(sol, "crank")
    kp.animate(sol, "four_bar.mp4")
    assert (tmp_path / "four_bar.mp4").read_bytes()[4:8] == b"ftyp"
