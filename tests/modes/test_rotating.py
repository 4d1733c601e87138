"""Small motions in a frame that rotates with the mechanism, against closed forms and a table."""

import kempe as kp
import numpy as np
import pytest

#: Masses in kg, lengths in m and rates in rad/s.
SCALES = [(1.0, 1.0, 1.0), (1e-3, 1e3, 300.0), (1e3, 1e-3, 0.1)]


def hub(
    rate: float, start: float = 0.7, weight: float = 0.0, **points: tuple[float, float]
) -> kp.Model:
    m = kp.Model("rotor", gravity=(0, -weight))
    m.ground.points(O=(0.3, -0.2))
    m.body("hub", mass=1, inertia=1, points={"O": (0, 0), **points})
    m.revolute("axle", "ground.O", "hub.O")
    m.coordinate_driver("drive", "hub.angle", value=f"{start!r} + {rate!r}*t")
    return m


@pytest.mark.parametrize("scale", SCALES)
def test_a_mass_on_a_radial_slide(scale: tuple[float, float, float]) -> None:
    mass, size, rate = scale
    m = hub(rate, A=(size, 0))
    m.body("block", mass=2 * mass, inertia=mass * size**2, points={"P": (0, 0)})
    m.translational("slide", "hub.O", "block.P")
    # at rest at the radius 1.5: k (1.5 - 1) = 2 (1.5) in units of mass, size and rate
    stiffness = 6 * mass * rate**2
    m.spring_damper("spring", "hub.O", "block.P", stiffness=stiffness, free_length=size)
    start = kp.assemble(m, set={"slide.displacement": 1.5 * size, "slide.rate": 0})
    found = kp.modes(m, start, rotating=True)
    assert found.is_equilibrium
    np.testing.assert_allclose(found.omega, np.sqrt(3 - 1) * rate, rtol=1e-9)


@pytest.mark.parametrize("scale", SCALES)
def test_a_mass_on_springs_has_the_sum_and_the_difference(
    scale: tuple[float, float, float],
) -> None:
    mass, size, rate = scale
    m = hub(rate)
    m.body("disc", mass=mass, inertia=mass * size**2, points={"C": (0, 0)})
    k = 9 * mass * rate**2
    turn = 4 * mass * size**2 * rate**2
    m.bushing("mount", "hub.O", "disc.C", stiffness=[k, k, turn], damping=[0, 0, 0])
    at = {"disc.x": 0.3, "disc.y": -0.2, "disc.angle": 0.7}
    start = kp.assemble(m, set={**at, "disc.omega": rate, "disc.vx": 0, "disc.vy": 0})
    found = kp.modes(m, start, rotating=True)
    assert found.is_equilibrium
    np.testing.assert_allclose(np.sort(found.omega), np.array([2, 2, 4]) * rate, rtol=1e-9)


@pytest.mark.parametrize("offset", [0.1, 0.5])
@pytest.mark.parametrize("scale", SCALES)
def test_a_hinged_blade(scale: tuple[float, float, float], offset: float) -> None:
    mass, size, rate = scale
    m = hub(rate, H=(offset * size, 0))
    m.bar("blade", mass=mass, length=size, ends=("H", "T"))
    m.revolute("hinge", "hub.H", "blade.H")
    start = kp.assemble(m, set={"hinge.angle": 0, "hinge.omega": 0})
    found = kp.modes(m, start, rotating=True)
    np.testing.assert_allclose(found.omega, rate * np.sqrt(1.5 * offset), rtol=1e-9)
    # angles have the same changes in both frames
    fixed = kp.modes(m, start)
    np.testing.assert_allclose(fixed.omega, found.omega, rtol=1e-9)


#: Out-of-plane frequencies of a rotating cantilever without hub, in units of √(EI/(ρA L⁴)), for its
#: rate in these units: A. D. Wright, C. E. Smith, R. W. Thresher, J. L. C. Wang, Journal of Applied
#: Mechanics 49 (1982) 197. In the plane, ω² is less by the square of the rate.
WRIGHT = {1.0: (3.6816, 22.1810), 2.0: (4.1373, 22.6149), 5.0: (6.4495, 25.4461)}


@pytest.mark.parametrize("rate", WRIGHT)
def test_a_rotating_beam(rate: float) -> None:
    size, stiffness, mass = 2.0, 30.0, 0.4
    unit = float(np.sqrt(stiffness / (mass * size**4)))
    m = hub(rate * unit, start=0.4)
    m.beam(
        "blade",
        length=size,
        ends=("A", "B"),
        EA=1e6,
        EI=stiffness,
        mass_per_length=mass,
        shear=False,
        inextensible=True,
        elements=12,
    )
    m.weld("root", "hub.O", "blade.A")
    found = kp.modes(m, kp.assemble(m), rotating=True)
    assert found.is_equilibrium
    expected = np.sqrt(np.array(WRIGHT[rate]) ** 2 - rate**2)
    np.testing.assert_allclose(np.sort(found.omega)[:2] / unit, expected, rtol=3e-4)


def test_what_does_not_rotate_uniformly_is_refused() -> None:
    def rotor(weight: float) -> kp.Model:
        m = hub(2.0, weight=weight, H=(0.3, 0))
        m.bar("blade", mass=1, length=1, ends=("H", "T"))
        m.revolute("hinge", "hub.H", "blade.H")
        return m

    m = rotor(0.0)
    bent = kp.assemble(m, set={"hinge.angle": 0.4, "hinge.omega": 0})
    with pytest.raises(kp.AssemblyError, match="blade accelerates in it"):
        kp.modes(m, bent, rotating=True)
    moving = kp.assemble(m, set={"hinge.angle": 0, "hinge.omega": 0.5})
    with pytest.raises(kp.AssemblyError, match=r"(hub|blade) moves in it"):
        kp.modes(m, moving, rotating=True)
    heavy = rotor(9.81)
    straight = kp.assemble(heavy, set={"hinge.angle": 0, "hinge.omega": 0})
    with pytest.raises(kp.AssemblyError, match="gravity changes its direction"):
        kp.modes(heavy, straight, rotating=True)
