"""Slopes of modes against closed forms and against differences of runs."""

import warnings
from typing import Any

import kempe as kp
import numpy as np
import pytest
from gradients.mechanisms import Random
from gradients.test_random import differences, scales
from gradients.test_truth import SCALES, agrees
from sizes import count

Scale = tuple[float, float, float]
Numbers = dict[str, float]


def chain(numbers: Numbers, count: int, size: float, *, walls: bool = True) -> kp.Case:
    """Masses m0, m1, … on a line, between springs k0, k1, … with dampers c0, c1, …"""
    m = kp.Model("chain", gravity=(0, 0), parameters=numbers)
    m.ground.points(O=(0, 0), E=(size * (count + 1), 0))
    for k in range(count):
        m.body(f"b{k}", mass=f"m{k}", inertia=size**2, points={"P": (0, 0)})
        m.translational(f"g{k}", "ground.O", f"b{k}.P")
    points = ["ground.O", *(f"b{k}.P" for k in range(count)), "ground.E"]
    for k in range(count + 1):
        if walls or 0 < k < count:
            damping = f"c{k}" if f"c{k}" in numbers else 0
            fields = {"stiffness": f"k{k}", "damping": damping, "free_length": size}
            m.spring_damper(f"s{k}", points[k], points[k + 1], **fields)
    start = {f"b{k}.x": size * (k + 1) for k in range(count)}
    return kp.Case(m, {"set": start}, [kp.Modes()])


def matrices(numbers: Numbers, count: int) -> Any:
    """M, C and K of a chain between walls."""
    found = [np.diag([numbers[f"m{k}"] for k in range(count)])]
    for name in "ck":
        A = np.zeros((count + 2, count + 2))
        for k in range(count + 1):
            A[k : k + 2, k : k + 2] += numbers.get(f"{name}{k}", 0.0) * np.array([[1, -1], [-1, 1]])
        found.append(A[1:-1, 1:-1])
    return found


@pytest.mark.parametrize("scale", SCALES)
@pytest.mark.parametrize("damping", [0.0, 0.2])
def test_a_chain(scale: Scale, damping: float) -> None:
    """ds (2 s xᵀMx + xᵀCx) = -xᵀ(s² dM + s dC + dK) x, with the matrices by hand."""
    size, mass, rate = scale
    numbers = {f"m{k}": mass * (1.0 + 0.3 * k) for k in range(3)}
    numbers |= {f"k{k}": mass * rate**2 * (2.0 + 0.7 * k) for k in range(4)}
    if damping:
        numbers |= {f"c{k}": damping * mass * rate * (1.0 + k) for k in range(4)}
    measures = ["frequency[0]", "omega[1]", "damping[2]", "frequency[-1]"]
    g = kp.gradient(chain(numbers, 3, size), measures, list(numbers))
    assert not g.remarks
    M, C, K = matrices(numbers, 3)
    whole = np.block([[np.zeros((3, 3)), np.eye(3)], [-np.linalg.solve(M, [*K])
                     , -np.linalg.solve(M, [*C])]])  # fmt: skip
    all_s = sorted((s for s in np.linalg.eigvals(whole) if s.imag > 0), key=abs)
    for measure, s in zip(measures, [*all_s, all_s[-1]], strict=True):
        x = np.linalg.svd(s**2 * M + s * C + K)[2][-1].conj()
        for name, p in numbers.items():
            dM, dC, dK = matrices(dict.fromkeys(numbers, 0.0) | {name: 1.0}, 3)
            ds = -(x @ (s**2 * dM + s * dC + dK) @ x) / (x @ (2 * s * M + C) @ x)
            of_size = (np.conj(s) * ds).real / abs(s)
            kind = measure.split("[")[0]
            of_ratio = -ds.real / abs(s) + s.real * of_size / abs(s) ** 2
            true = {"frequency": ds.imag / (2 * np.pi), "omega": of_size, "damping": of_ratio}[kind]
            unit = 1.0 if kind == "damping" else abs(s)
            assert g[measure, name] == pytest.approx(true, rel=1e-9, abs=1e-10 * unit / p), name


def pendulum(scale: Scale, *analyses: Any) -> tuple[kp.Case, Numbers]:
    """A damped compound pendulum, and its numbers."""
    size, mass, rate = scale
    numbers = {"m": 2.0 * mass, "J": 0.3 * mass * size**2, "d": 0.7 * size}
    numbers |= {"g": 9.0 * rate**2 * size, "c": 0.4 * mass * size**2 * rate}
    m = kp.Model("pendulum", gravity=(0, "-g"), parameters=numbers)
    m.ground.points(O=(0, 0))
    m.body("rod", mass="m", inertia="J", center=("d", 0), points={"O": (0, 0)})
    m.revolute("O", "ground.O", "rod.O")
    m.torsion_spring("damper", "ground", "rod", stiffness=0, damping="c", free_angle=0)
    start = {"rod.angle": -np.pi / 2 + 0.4, "rod.omega": 0.0}
    return kp.Case(m, {"set": start}, list(analyses)), numbers


@pytest.mark.parametrize("scale", SCALES)
def test_a_compound_pendulum_at_rest(scale: Scale) -> None:
    case, numbers = pendulum(scale, kp.Equilibrium(name="rest"), kp.Modes(name="modes"))
    g = kp.gradient(case, ["frequency[0]", "omega[0]", "damping[0]"], list(numbers))

    def omega(**of: Any) -> Any:
        inertia = of["J"] + of["m"] * of["d"] ** 2
        return np.sqrt(of["m"] * of["g"] * of["d"] / inertia) + 0 * of["c"]

    def ratio(**of: Any) -> Any:
        return of["c"] / (2 * (of["J"] + of["m"] * of["d"] ** 2) * omega(**of))

    def frequency(**of: Any) -> Any:
        return omega(**of) * np.sqrt(1 - ratio(**of) ** 2) / (2 * np.pi)

    agrees(g, "omega[0]", omega, numbers, 1e-9)
    agrees(g, "damping[0]", ratio, numbers, 1e-9)
    agrees(g, "frequency[0]", frequency, numbers, 1e-9)


@pytest.mark.parametrize("scale", SCALES)
def test_a_state_that_is_no_equilibrium(scale: Scale) -> None:
    """The stiffness changes with the angle of the start, and so does the acceleration."""
    case, numbers = pendulum(scale, kp.Modes())
    numbers |= {"rod.angle": -np.pi / 2 + 0.4}
    g = kp.gradient(case, ["omega[0]", "acceleration[0]", "rates[0]"], [*numbers, "rod.omega"])

    def stiffness(of: Any) -> Any:
        return -of["m"] * of["g"] * of["d"] * np.sin(of["rod.angle"])

    def omega(**of: Any) -> Any:
        return np.sqrt(stiffness(of) / (of["J"] + of["m"] * of["d"] ** 2))

    def acceleration(**of: Any) -> Any:
        return stiffness(of) / np.tan(of["rod.angle"]) / (of["J"] + of["m"] * of["d"] ** 2)

    agrees(g, "omega[0]", omega, numbers, 1e-9)
    agrees(g, "acceleration[0]", acceleration, numbers, 1e-9)
    assert g["rates[0]", "rod.omega"] == pytest.approx(1.0, rel=1e-14)
    assert g["omega[0]", "rod.omega"] == 0.0


def linkage(scale: Scale, *analyses: Any) -> tuple[kp.Case, list[str]]:
    """A four-bar with springs and a tail: its linearization moves with its position."""
    size, mass, rate = scale
    force = mass * size * rate**2
    numbers = {"a": 0.3 * size, "b": 0.9 * size, "c": 0.7 * size, "d": size, "e": 0.05 * size}
    numbers |= {"m": 3.0 * mass, "g": 9.8 * size * rate**2, "kt": 4 * force * size}
    numbers |= {"ct": 0.3 * force * size / rate, "kl": 6 * force / size, "free": 0.45 * size}
    m = kp.Model("linkage", gravity=(0, "-g"), parameters=numbers)
    m.ground.points(A=(0, 0), D=("d", 0), Q=("0.4*d", "1.2*d"))
    m.bar("crank", mass="m", length="a", ends=("A", "B"))
    points = {"B": (0, 0), "C": ("b", 0)}
    m.body("coupler", mass="m/2", inertia="0.1*m*b^2", center=("0.4*b", "e"), points=points)
    m.bar("rocker", mass="m", length="c", ends=("D", "C"))
    m.bar("tail", mass="m/3", length="a", ends=("B", "T"))
    ends = ("A", "ground", "crank"), ("B", "crank", "coupler"), ("C", "coupler", "rocker")
    for name, i, j in (*ends, ("D", "ground", "rocker")):
        m.revolute(name, f"{i}.{name}", f"{j}.{name}")
    m.revolute("T", "coupler.B", "tail.B")
    m.torsion_spring("ts", "ground", "rocker", stiffness="kt", damping="ct", free_angle=1)
    m.torsion_spring("tt", "coupler", "tail", stiffness="kt/7", damping="ct/20", free_angle=0.3)
    m.spring_damper("sl", "ground.Q", "coupler.C", stiffness="kl", free_length="free")
    names = ("crank.angle", "crank.omega", "tail.angle", "tail.omega")
    start = dict(zip(names, (1.0, 0.0, -1.0, 0.0), strict=True))
    guess = {"rocker.angle": 1.4}
    return kp.Case(m, {"set": start, "guess": guess}, list(analyses)), [*numbers, *start]


@pytest.mark.parametrize("scale", [SCALES[0], SCALES[3]])
@pytest.mark.parametrize("rests", [True, False])
def test_a_linkage_against_differences(scale: Scale, rests: bool) -> None:
    before = [kp.Equilibrium(name="rest")] if rests else []
    case, names = linkage(scale, *before, kp.Modes(outputs=["C.force", "rocker.angle"]))
    measures = ["frequency[0]", "damping[0]", "omega[1]", "values[0]", "values[1]"]
    g = kp.gradient(case, measures, names)
    assert not g.remarks
    found, error = differences(case, g)
    values = np.array(list(g.variables.values()))
    units = np.abs(np.array(list(g.measures.values())))[:, None] / np.where(values, abs(values), 1)
    assert (np.abs(g.jacobian - found) / units).max() < 1e-8
    assert (error / units).max() < 1e-8


NUMBERS = {"r": 0.2, "l": 0.35, "g": 9.81, "k": 30.0, "m": 2.0, "e": 0.1, "c": 0.4}


def wheels(m: kp.Model, kind: str) -> None:
    """Two wheels with a weight beside their axes, with a belt or in mesh."""
    m.ground.points(O=(0, 0), C=("r + l", 0))
    for name, end, mass in (("first", "O", "m"), ("other", "C", 1)):
        m.body(name, mass=mass, inertia=0.1, center=("e", 0), points={end: (0, 0)})
        m.revolute(end, f"ground.{end}", f"{name}.{end}")
    getattr(m, kind)("pair", "first.O", "other.C", radii=("r", "l/2" if kind == "belt" else "l"))
    m.torsion_spring("coil", "ground", "other", stiffness="k", damping="c", free_angle=0.2)


def bead(m: kp.Model) -> None:
    """A body that slides along a curve, whose contact has a coordinate of its own."""
    m.ground.curves(bowl={"x": "u", "y": "u^2/l + e*u^3", "range": [-2, 2]})
    m.body("bead", mass="m", inertia=0.1, center=("e", "r"), points={"P": (0, 0)})
    m.point_on_curve("contact", "bead.P", "ground.bowl")
    m.torsion_spring("coil", "ground", "bead", stiffness="k", damping="c", free_angle=0.2)


def slot(m: kp.Model) -> None:
    """A slot and a rod of fixed length, with a bushing and an actuator."""
    m.ground.points(O=(0, 0), C=(0.5, 0.2))
    m.bar("bar", mass="m", length=0.8, ends=("O", "A"))
    points = {"C": (0, 0), "D": (0.6, "e")}
    m.body("plate", mass=1, inertia=0.2, center=(0.3, "e"), points=points)
    m.revolute("O", "ground.O", "bar.O")
    m.pin_in_slot("C", "bar.O", "plate.C", axis=0.1)
    m.distance("d", "bar.A", "plate.D", length="l")
    fields: dict[str, Any] = {"stiffness": ("k", "2*k", "r"), "damping": ("c", "c", 0.1)}
    m.bushing("pad", "ground.O", "plate.D", **fields)
    m.actuator("push", "ground.C", "plate.D", force="m*cos(length) - k*(length - r) - c*rate")


@pytest.mark.parametrize(
    ("build", "start"),
    [
        (lambda m: wheels(m, "belt"), {"set": {"first.angle": 0.3}}),
        (lambda m: wheels(m, "gear"), {"set": {"first.angle": 0.3}}),
        (bead, {"set": {"bead.x": 0.4, "bead.angle": 0.1}}),
        (slot, {"guess": {"bar.angle": 0.3, "plate.angle": 0.2}}),
    ],
)
def test_modes_of_other_elements(build: Any, start: dict[str, Any]) -> None:
    m = kp.Model("mechanism", gravity=(0, "-g"), parameters=NUMBERS)
    build(m)
    case = kp.Case(m, start, [kp.Equilibrium(name="rest"), kp.Modes()])
    g = kp.gradient(case, ["omega[0]", "damping[0]", "omega[-1]"], list(NUMBERS))
    assert not g.remarks
    found, _ = differences(case, g)
    assert (np.abs(g.jacobian - found) <= 1e-8 * scales(g)).all()


def test_equal_eigenvalues_part_or_stay_equal() -> None:
    """Two equal pendulums: with g they remain equal, with one length they part."""
    numbers = {"g": 9.81, "l0": 1.0, "l1": 1.0, "unused": 2.0}
    m = kp.Model("pendulums", gravity=(0, "-g"), parameters=numbers)
    m.ground.points(O=(0, 0))
    for k in range(2):
        m.bar(f"r{k}", mass=1, length=f"l{k}", ends=("O", "P"))
        m.revolute(f"O{k}", "ground.O", f"r{k}.O")
    start = {f"r{k}.angle": -np.pi / 2 for k in range(2)}
    omega = np.sqrt(1.5 * 9.81)
    for name, n in (("omega[0]", None), ("omega[1]", None), ("omega[-1]", 1)):
        g = kp.gradient(kp.Case(m, {"set": start}, [kp.Modes(n=n)]), [name], list(numbers))
        assert g[name, "g"] == pytest.approx(omega / (2 * 9.81), rel=1e-12)
        assert g[name, "unused"] == 0.0
        for length in ("l0", "l1"):
            assert np.isnan(g[name, length])
            assert g.remarks[name, length] == "equal eigenvalues part with this variable"


@pytest.mark.parametrize("scale", SCALES)
def test_a_mode_that_moves_freely(scale: Scale) -> None:
    size, mass, rate = scale
    numbers = {"m0": mass, "m1": 2 * mass, "k1": 3 * mass * rate**2}
    g = kp.gradient(
        chain(numbers, 2, size, walls=False), ["frequency[0]", "omega[-1]"], list(numbers)
    )
    assert np.isnan(g.jacobian[0]).all()
    assert g.remarks["frequency[0]", "m0"] == "the eigenvalue is zero: the mode moves freely"
    agrees(g, "omega[-1]", lambda m0, m1, k1: np.sqrt(k1 * (1 / m0 + 1 / m1)), numbers, 1e-9)


def test_critical_damping_has_no_bound() -> None:
    numbers = {"m0": 1.0, "k0": 0.5, "k1": 0.5, "c0": 2.0}
    g = kp.gradient(chain(numbers, 1, 1.0), ["omega[0]", "damping[0]"], list(numbers))
    assert np.isnan(g.jacobian).all()
    assert all("critical damping" in text for text in g.remarks.values())
    beside = kp.gradient(chain(numbers | {"c0": 2.0 - 1e-6}, 1, 1.0), ["damping[0]"], ["c0"])
    assert beside["damping[0]", "c0"] == pytest.approx(0.5, rel=1e-9)


def test_overdamped_modes() -> None:
    numbers = {"m0": 2.0, "k0": 3.0, "c0": 11.0}
    case = chain(numbers | {"k1": 0.0}, 1, 1.0)
    g = kp.gradient(
        case, ["eigenvalues[0]", "eigenvalues[1]", "damping[0]", "frequency[0]"], list(numbers)
    )
    for name, sign in (("eigenvalues[0]", 1.0), ("eigenvalues[1]", -1.0)):
        agrees(
            g,
            name,
            lambda m0, k0, c0, sign=sign: (-c0 + sign * np.sqrt(c0**2 - 4 * m0 * k0)) / (2 * m0),
            numbers,
            1e-9,
        )
    assert np.array_equal(g.jacobian[2:], np.zeros((2, 3)))


def test_numbers_that_do_not_change_gradually() -> None:
    case, _ = pendulum(SCALES[0], kp.Modes())
    g = kp.gradient(case, ["stable", "is_equilibrium"], ["m"])
    assert np.isnan(g.jacobian).all() and len(g.remarks) == 2


def test_refusals_name_the_reason() -> None:
    case, _ = pendulum(SCALES[0], kp.Modes())
    moving = kp.Case(case.model, {"set": {"rod.angle": -1.0, "rod.omega": 2.0}}, [kp.Modes()])
    g = kp.gradient(moving, ["omega[0]"], ["m"])
    assert g.remarks["omega[0]", "m"] == "the state moves; modes at rest have derivatives"


@pytest.mark.parametrize("seed", range(count(16, 100)))
def test_modes_of_a_random_mechanism(seed: int) -> None:
    """Every second one at an equilibrium, the others where they start, without rates."""
    made = Random(seed)
    if made.driven:
        pytest.skip("no freedom is left")
    made.start |= {name: 0.0 for name in made.start if name.endswith("omega")}
    before = [kp.Equilibrium(name="rest")] if seed % 2 else []
    start = {"set": made.start, "guess": made.guess}
    case = kp.Case(made.case().model, start, [*before, kp.Modes()])
    names = [*made.parameters, *made.start]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        g = kp.gradient(case, ["omega[0]", "omega[-1]", "damping[0]", "frequency[-1]"], names)
        true, doubt = differences(case, g)
    remarked = np.isnan(g.jacobian)
    assert remarked.sum() == len(g.remarks)
    given = np.array([abs(x) or 1.0 for x in g.variables.values()])
    scale = scales(g) + np.array([[0.0], [0.0], [1.0], [0.0]]) / given
    wrong = ~remarked & (doubt < 1e-7 * scale) & ~(np.abs(g.jacobian - true) < 1e-7 * scale)
    assert not wrong.any()
