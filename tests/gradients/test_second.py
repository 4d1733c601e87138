"""Second derivatives against closed forms, which are differentiated with fifty digits."""

from collections.abc import Callable
from typing import Any

import kempe as kp
import numpy as np
import pytest
from gradients.test_truth import SCALES
from mpmath import mp, mpf

#: Half the distance of the second differences, as a part of a number; errors are about 1e-24.
STEP = mpf("1e-12")


def hessian(f: Callable[..., Any], numbers: dict[str, float]) -> Any:
    """The second derivatives of a closed form by second differences with fifty digits."""
    names, found = list(numbers), np.zeros((len(numbers), len(numbers)))
    with mp.workdps(50):
        at = {name: mpf(x) for name, x in numbers.items()}
        steps = {name: STEP * (abs(x) or 1) for name, x in at.items()}
        for i, a in enumerate(names):
            for j, b in enumerate(names):
                total = mpf(0)
                for p in (1, -1):
                    for q in (1, -1):
                        moved = dict(at)
                        moved[a] += p * steps[a]
                        moved[b] += q * steps[b]
                        total += p * q * f(**moved)
                found[i, j] = total / (4 * steps[a] * steps[b])
    return found


def agrees(g: kp.Gradient, measure: str, f: Callable[..., Any], numbers: dict[str, float]) -> None:
    k, true = list(g.measures).index(measure), hessian(f, numbers)
    assert g.hessian is not None
    found = g.hessian[k]
    with mp.workdps(50):
        value = float(f(**{name: mpf(x) for name, x in numbers.items()}))
    assert g.measures[measure] == pytest.approx(value, rel=1e-10)
    sizes = np.array([abs(x) or 1.0 for x in numbers.values()])
    scale = np.abs(true * sizes * sizes[:, None]).max() / (sizes * sizes[:, None])
    assert (np.abs(found - true) <= 1e-8 * scale).all(), (measure, (found - true) / scale)
    assert (found == found.T).all()
    assert not g.remarks


def four_bar(scale: tuple[float, float, float], **more: float) -> tuple[kp.Model, dict[str, float]]:
    size, mass, rate = scale
    numbers = {"L1": 4.0 * size, "L2": size, "L3": 3.5 * size, "L4": 2.5 * size, **more}
    m = kp.Model("four-bar", gravity=(0, -9.0 * rate**2 * size), parameters=numbers)
    m.ground.points(O=(0, 0), D=("L1", 0))
    m.bar("crank", mass=mass, length="L2", ends=("O", "A"))
    m.bar("coupler", mass=2 * mass, length="L3", ends=("A", "B"))
    m.bar("rocker", mass=3 * mass, length="L4", ends=("D", "B"))
    m.revolute("O", "ground.O", "crank.O")
    m.revolute("A", "crank.A", "coupler.A")
    m.revolute("B", "coupler.B", "rocker.B")
    m.revolute("D", "rocker.D", "ground.D")
    return m, numbers


def rocker(angle: Any, **of: Any) -> Any:
    """The angle of the rocker from the triangle A, B, D."""
    x, y = of["L2"] * mp.cos(angle) - of["L1"], of["L2"] * mp.sin(angle)
    way = mp.sqrt(x**2 + y**2)
    inner = mp.acos((way**2 + of["L4"] ** 2 - of["L3"] ** 2) / (2 * way * of["L4"]))
    return mp.atan2(y, x) - inner


def turning(w: Any, angle: Any, **of: Any) -> Any:
    """The rate of the rocker: both rods carry the same velocity along the coupler."""
    theta = rocker(angle, **of)
    x = of["L1"] + of["L4"] * mp.cos(theta) - of["L2"] * mp.cos(angle)
    y = of["L4"] * mp.sin(theta) - of["L2"] * mp.sin(angle)
    moves = of["L2"] * (y * mp.cos(angle) - x * mp.sin(angle))
    return w * moves / (of["L4"] * (y * mp.cos(theta) - x * mp.sin(theta)))


GUESS = {"coupler.angle": 0.9, "rocker.angle": 1.6}


@pytest.mark.parametrize("scale", SCALES)
def test_a_four_bar_that_a_driver_moves(scale: tuple[float, float, float]) -> None:
    rate = scale[2]
    m, numbers = four_bar(scale, w=2.0 * rate, a=0.7)
    m.coordinate_driver("motor", "crank.angle", value="a + w*t")
    end = 0.4 / rate
    case = kp.Case(m, {"guess": GUESS}, [kp.Kinematics(t_end=end, output_step=end / 4)])
    measures = ["rocker.angle.final", "rocker.omega.final"]
    g = kp.gradient(case, measures, list(numbers), second=True)

    def angle(w: Any, a: Any, **of: Any) -> Any:
        return rocker(a + w * mpf(end), **of)

    def speed(w: Any, a: Any, **of: Any) -> Any:
        return turning(w, a + w * mpf(end), **of)

    agrees(g, "rocker.angle.final", angle, numbers)
    agrees(g, "rocker.omega.final", speed, numbers)


@pytest.mark.parametrize("scale", SCALES)
def test_an_assembled_position_that_a_holder_keeps(scale: tuple[float, float, float]) -> None:
    m, numbers = four_bar(scale)
    start = {"set": {"crank.angle": 0.9}, "guess": GUESS}
    case = kp.Case(m, start, [kp.Equilibrium(hold=["crank.angle"])])
    numbers |= {"crank.angle": 0.9}
    g = kp.gradient(case, ["rocker.angle", "rocker.B.y"], list(numbers), second=True)

    def angle(**of: Any) -> Any:
        return rocker(of.pop("crank.angle"), **of)

    agrees(g, "rocker.angle", angle, numbers)
    agrees(g, "rocker.B.y", lambda **of: of["L4"] * mp.sin(angle(**of)), numbers)


@pytest.mark.parametrize("scale", SCALES)
def test_a_rod_at_rest_on_a_spring(scale: tuple[float, float, float]) -> None:
    size, mass, rate = scale
    numbers = {"m": 2 * mass, "L": size, "g": 9.0 * rate**2 * size}
    numbers |= {"k": 11.0 * mass * (rate * size) ** 2, "free": 0.0}
    m = kp.Model("rod", gravity=(0, "-g"), parameters=numbers)
    m.ground.points(O=(0, 0))
    m.bar("rod", mass="m", length="L", ends=("O", "P"))
    m.revolute("O", "ground.O", "rod.O")
    m.torsion_spring("spring", "ground", "rod", stiffness="k", free_angle="free")
    case = kp.Case(m, {"set": {"rod.angle": -0.4}}, [kp.Equilibrium()])
    g = kp.gradient(case, ["rod.angle", "spring.torque"], list(numbers), second=True)

    def angle(**of: Any) -> Any:
        load = of["m"] * of["g"] * of["L"] / 2
        return mp.findroot(lambda x: of["k"] * (x - of["free"]) + load * mp.cos(x), -0.5)

    agrees(g, "rod.angle", angle, numbers)
    agrees(g, "spring.torque", lambda **of: -of["k"] * (angle(**of) - of["free"]), numbers)


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e3])
def test_numbers_that_are_zero_without_a_unit(size: float) -> None:
    """The place of a pin: its magnitude follows from the mechanism."""
    m = kp.Model("rod", gravity=(0, -9.0), parameters={"e": 0.0, "f": 0.0, "L": size})
    m.ground.points(O=("e", "f"), G=(0.3 * size, 1.1 * size))
    m.bar("rod", mass=1, length="L", ends=("O", "P"))
    m.revolute("O", "ground.O", "rod.O")
    m.spring_damper("s", "ground.G", "rod.P", stiffness=200 / size, free_length=0.3 * size)
    case = kp.Case(m, {"set": {"rod.angle": 0.3}}, [kp.Equilibrium()])
    numbers = {"e": 0.0, "f": 0.0, "L": size}
    g = kp.gradient(case, ["rod.angle", "s.length"], list(numbers), second=True)
    assert not g.remarks and g.hessian is not None

    def slopes(**of: Any) -> list[Any]:
        """Those of the potential, divided by its unit, by the angle: zero at rest."""
        x, y = 0.3 * size - of["e"], 1.1 * size - of["f"]

        def potential(a: Any) -> Any:
            u, v = of["L"] * mp.cos(a), of["L"] * mp.sin(a)
            length = mp.sqrt((u - x) ** 2 + (v - y) ** 2)
            return 100 * (length / size - 0.3) ** 2 * size + 4.5 * v

        angle = mp.findroot(lambda a: mp.diff(potential, a), float(g.measures["rod.angle"]))
        u, v = of["L"] * mp.cos(angle), of["L"] * mp.sin(angle)
        return [angle, mp.sqrt((u - x) ** 2 + (v - y) ** 2)]

    step, names = mpf("1e-6"), list(numbers)
    for k in range(2):
        for i, j in ((0, 0), (0, 1), (1, 2)):

            def at(p: int, q: int, i: int = i, j: int = j, k: int = k) -> Any:
                moved = {name: mpf(x) for name, x in numbers.items()}
                moved[names[i]] += p * step * size
                moved[names[j]] += q * step * size
                return slopes(**moved)[k]

            with mp.workdps(50):
                found = float((at(1, 1) - at(1, -1) - at(-1, 1) + at(-1, -1)) / (4 * step**2))
            assert g.hessian[k, i, j] * size**2 == pytest.approx(found, rel=1e-7)


def test_where_there_is_no_second_derivative() -> None:
    m, _ = four_bar((1.0, 1.0, 1.0), a=0.5)
    m.coordinate_driver("motor", "crank.angle", value="a*sin(t)")
    runs = [kp.Kinematics(t_end=2.0, output_step=0.1, name="turn"), kp.InverseDynamics(t_end=3.0)]
    case = kp.Case(m, {"guess": GUESS}, runs)
    with pytest.raises(kp.ModelError, match="inverse_dynamics, whose second derivatives are not"):
        kp.gradient(case, ["O.force.max"], ["a"], second=True)
    # a third power of a magnitude has a second derivative that jumps
    g = kp.gradient(
        case, ["abs(crank.angle - 0.5*sin(2)).final"], ["a"], analysis="turn", second=True
    )
    assert g.hessian is not None and np.isnan(g.hessian).all() and g.remarks
    plain = kp.gradient(case, ["crank.angle.final"], ["a"], analysis="turn")
    assert plain.hessian is None


@pytest.mark.parametrize("scale", SCALES[:2])
def test_the_largest_angle_of_a_rocker(scale: tuple[float, float, float]) -> None:
    """There, crank and coupler lie on one line, one over the other."""
    m, numbers = four_bar(scale)
    start = {"set": {"crank.angle": 2.2}, "guess": GUESS}
    turn = kp.Kinematics(over="crank.angle", range=(2.2, 4.7), n=20)
    g = kp.gradient(kp.Case(m, start, [turn]), ["rocker.angle.max"], list(numbers), second=True)

    def largest(**of: Any) -> Any:
        way = of["L3"] - of["L2"]
        inner = (of["L1"] ** 2 + of["L4"] ** 2 - way**2) / (2 * of["L1"] * of["L4"])
        return mp.pi - mp.acos(inner)

    agrees(g, "rocker.angle.max", largest, numbers)
