"""Friction through the public interface: at rest, in a prescribed motion, in files, and refused."""

from pathlib import Path

import kempe as kp
import numpy as np
import pytest

G = 9.81


def pendulum(**friction: object) -> kp.Model:
    m = kp.Model("pendulum", gravity=(0, -G))
    m.ground.points(O=(0, 0))
    m.bar("rod", mass=2, length=1, ends=("O", "P"))
    m.revolute("pin", "ground.O", "rod.O")
    m.friction("rub", "pin", radius=0.05, **friction)
    return m


def block(**friction: object) -> kp.Model:
    m = kp.Model("block", gravity=(0, -G), parameters={"mu": 0.3})
    m.ground.points(O=(0, 0))
    m.body("block", mass=2, inertia=0.1, points={"P": (0, 0)})
    m.translational("slide", "ground.O", "block.P")
    m.friction("rub", "slide", **friction)
    return m


def test_modes_of_a_hanging_pendulum() -> None:
    """Around rest, tanh(v/v0) is v/v0: a damper of kinetic × weight × radius² / v0."""
    m = pendulum(kinetic=0.3, static=0.5, stribeck=0.1, velocity=0.4, viscous=3)
    rest = kp.equilibrium(m, kp.assemble(m, guess={"rod.angle": -1.4})).state
    assert rest["rod.angle"] == pytest.approx(-np.pi / 2, abs=1e-9)
    inertia, stiffness = 2 / 3, 2 * G * 0.5
    damping = (0.5 * 2 * G / 0.4 + 3) * 0.05**2
    expected = np.roots([inertia, damping, stiffness])
    found = kp.modes(m, rest).eigenvalues[0]
    assert found.real == pytest.approx(expected[0].real, rel=1e-9)
    assert abs(found.imag) == pytest.approx(abs(expected[0].imag), rel=1e-9)


@pytest.mark.parametrize("fields", [{}, {"velocity": 0.02}])
def test_effort_of_a_driven_block(fields: dict[str, float]) -> None:
    m = block(kinetic=0.3, viscous=1.5, **fields)
    m.coordinate_driver("drive", "slide.displacement", value="0.2*sin(3*t)")
    sol = kp.inverse_dynamics(m, kp.assemble(m), t_end=1, output_step=0.01)
    v, a = 0.6 * np.cos(3 * sol.t), -1.8 * np.sin(3 * sol.t)
    sense = np.tanh(v / 0.02) if fields else np.sign(v)
    friction = 0.3 * 2 * G * sense + 1.5 * v
    assert np.allclose(sol["drive.effort"], 2 * a + friction, atol=1e-9)
    assert np.allclose(sol["rub.force"], -friction, atol=1e-9)
    assert np.allclose(sol["rub.load"], 2 * G, atol=1e-9)
    assert np.allclose(sol["rub.power"], -friction * v, atol=1e-9)
    assert np.all(sol["rub.sticking"] == 0)


def test_results_of_a_block_that_sticks_and_slips() -> None:
    m = block(kinetic=0.3, static=0.5)
    m.generalized_force("pull", "slide.displacement", value="20*t")
    start = kp.assemble(m, set={"slide.displacement": 0, "slide.rate": 0})
    sol = kp.dynamics(m, start, t_end=1, output_step=0.01)
    slip = 0.5 * 2 * G / 20
    before, after = sol.t < slip - 1e-9, sol.t > slip + 1e-9
    assert sol.events["rub.slip"].t == pytest.approx([slip], abs=1e-9)
    assert len(sol.events["rub.stick"].t) == 0
    assert np.allclose(sol["rub.force"][before], -20 * sol.t[before], atol=1e-9)
    assert np.allclose(sol["rub.force"][after], -0.3 * 2 * G, atol=1e-9)
    assert np.all(sol["rub.sticking"][before] == 1) and np.all(sol["rub.sticking"][after] == 0)
    assert np.allclose(sol["rub.load"], 2 * G, atol=1e-9)
    assert np.abs(sol.energy.balance).max() < 1e-6


def test_a_file_keeps_friction(tmp_path: Path) -> None:
    m = block(kinetic="mu", static="2*mu", stribeck="100 mm/s", guide=0.4, load="5 + t")
    case = kp.Case(m)
    case.save(tmp_path / "case.toml")
    again = kp.load(tmp_path / "case.toml").model
    start = {"slide.displacement": 0, "slide.rate": 1}
    ends = [kp.dynamics(one, kp.assemble(one, set=start), t_end=0.2).q[-1] for one in (m, again)]
    assert np.array_equal(*ends)


def test_a_joint_that_does_not_rub_is_refused() -> None:
    m = block(kinetic=0.3)
    m.body("lid", mass=1, inertia=1, points={"Q": (0, 0)})
    m.weld("glue", "block.P", "lid.Q")
    m.friction("more", "glue", kinetic=0.2)
    with pytest.raises(kp.ModelError, match="revolute, translational, pin_in_slot"):
        kp.assemble(m)


def test_the_paradox_names_the_joint() -> None:
    m = kp.Model("rod", gravity=(0, -G))
    m.ground.points(O=(0, 0))
    m.bar("rod", mass=1, length=1, ends=("P", "Q"))
    m.pin_in_slot("line", "ground.O", "rod.P")
    m.friction("rub", "line", kinetic=1.4)
    lean = {"rod.angle": "pi - atan(2)", "rod.omega": 0, "rod.P.x": 0, "rod.P.vx": 1}
    with pytest.raises(kp.SingularityError, match="friction paradox") as found:
        kp.dynamics(m, kp.assemble(m, set=lean), t_end=0.01)
    assert found.value.name == "line"


def test_two_pins_on_one_axis_are_refused() -> None:
    m = kp.Model("twice", gravity=(0, -G), redundancy="allow")
    m.ground.points(O=(0, 0))
    m.bar("rod", mass=2, length=1, ends=("O", "P"))
    m.revolute("front", "ground.O", "rod.O")
    m.revolute("back", "ground.O", "rod.O")
    m.friction("rub", "front", kinetic=0.3, radius=0.05, velocity=0.1)
    start = kp.assemble(m, set={"rod.angle": 0.2, "rod.omega": 0})
    with pytest.raises(kp.RedundancyError, match=r"rub.*front.*back") as found:
        kp.dynamics(m, start, t_end=0.1)
    assert found.value.hint is not None and "load" in found.value.hint


@pytest.mark.parametrize("law", ["-2*sign(rod.omega)", "if(rod.omega > 0, -2, 2)"])
def test_a_law_that_sticks_is_refused_with_friction_as_remedy(law: str) -> None:
    m = kp.Model("pendulum", gravity=(0, -G))
    m.ground.points(O=(0, 0))
    m.bar("rod", mass=1, length=1, ends=("O", "P"))
    m.revolute("pin", "ground.O", "rod.O")
    m.torque("brake", "rod", torque=law)
    start = kp.assemble(m, set={"rod.angle": 0, "rod.omega": 0})
    with pytest.raises(kp.IntegrationError, match="brake switches back and forth") as found:
        kp.dynamics(m, start, t_end=20)
    assert found.value.hint is not None and "friction" in found.value.hint
