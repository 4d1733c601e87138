"""What the results of analyses call themselves, and their tables, by hand."""

import kempe as kp
import numpy as np
import pytest
from python.test_rest_paths import tilted

SIZES = [1e-2, 1.0, 40.0]


def pendulums(count: int, size: float = 1.0) -> tuple[kp.Model, kp.State]:
    """Point masses on light rods, each on a pin of its own, that hang at rest."""
    m = kp.Model("pendulums", gravity=(0, -9.81))
    for k in range(count):
        m.ground.points(**{f"O{k}": (k, 0)})
        m.body(f"b{k}", mass=2, inertia=0, points={"O": (0, (k + 1) * size)})
        m.revolute(f"j{k}", f"ground.O{k}", f"b{k}.O")
    return m, kp.assemble(m)


def crank_of(size: float) -> kp.Model:
    """A crank of 1, a rod of 2 and a slide, times a size."""
    m = kp.Model("crank")
    m.ground.points(O=(0, 0))
    m.bar("crank", mass=1, length=size, ends=("O", "A"))
    m.bar("rod", mass=1, length=2 * size, ends=("A", "B"))
    m.body("slide", mass=1, inertia=1, points={"B": (0, 0)})
    m.revolute("O", "ground.O", "crank.O")
    m.revolute("A", "crank.A", "rod.A")
    m.revolute("B", "rod.B", "slide.B")
    m.translational("S", "ground.O", "slide.B", axes=(0, 0))
    return m


@pytest.mark.parametrize("size", SIZES)
def test_modes(size: float) -> None:
    for count, words in ((0, "0 modes"), (1, "1 mode"), (3, "3 modes")):
        m, start = pendulums(count, size)
        if not count:
            m.body("held", mass=1, inertia=1, points={"O": (0, 0)})
            m.ground.points(O=(0, 0))
            m.weld("weld", "ground.O", "held.O")
            start = kp.assemble(m)
        found = kp.modes(m, start)
        assert repr(found) == f"<ModesResult: {words} at t = 0 s>"
        expected = sorted(np.sqrt(9.81 / ((k + 1) * size)) for k in range(count))
        np.testing.assert_allclose(sorted(found.omega), expected, rtol=1e-9)
    # one period of the first shape: cosines of even phases; closing the pins adds the third power
    shape = found.shape(0)
    angles = np.array([[s[f"b{k}.angle"] for k in range(3)] for s in shape.states(6)])
    moved = angles[:, np.abs(angles).max(axis=0).argmax()]
    phases = np.arange(6) * np.pi / 3
    np.testing.assert_allclose(moved, moved[0] * np.cos(phases), atol=abs(moved[0]) ** 3)
    assert abs(moved[0]) > 1e-3


@pytest.mark.parametrize("size", SIZES)
def test_rests(size: float) -> None:
    m, start = tilted(1.0, size, 0.5)
    most = 9.81 * size / 2
    name = "<EquilibriumResult of 'tilted': "
    assert repr(kp.equilibrium(m, start)) == f"{name}stable>"
    upwards = kp.assemble(m, set={"rod.angle": 0.5 + np.pi / 2})
    upright = kp.equilibrium(m, upwards)
    assert repr(upright) == f"{name}not stable>"
    assert "not stable" in upright.report() and "stable" in kp.equilibrium(m, start).report()
    held = kp.equilibrium(m, start, hold=["rod.angle"])
    assert "held: no freedom is left" in held.report()
    tree = m.tree()
    tree["gravity"] = [0, 0]
    loose = kp.Model.from_tree(tree)
    nowhere = kp.equilibrium(loose, kp.assemble(loose, set={"rod.angle": 0.3}))
    assert "indifferent: it can move without any force" in nowhere.report()
    for end, folds in ((0.5, 0), (1.5, 1)):
        path = kp.equilibrium(m, start, over="p", range=(0, end * most))
        assert repr(path) == f"{name}{len(path.values)} points over p, {folds} folds>"
    table = {column.name: column for column in path.tables()["equilibrium"]}
    np.testing.assert_array_equal(table["p"].values, path.values)
    angle = table["rod.angle"].values
    np.testing.assert_allclose(most * np.cos(angle - 0.5), path.values, atol=1e-9 * most)
    eigenvalues = table["eigenvalue_1"].values
    np.testing.assert_allclose(eigenvalues, -most * np.sin(angle - 0.5), atol=1e-6 * most)
    np.testing.assert_array_equal(table["stable"].values, eigenvalues > 0.0)


@pytest.mark.parametrize("size", SIZES)
def test_configurations(size: float) -> None:
    """A rod of 2 between a crank pin at 1 and a slide: two places of the slide."""
    m = crank_of(size)
    found = kp.configurations(m, set={"crank.angle": 0.4})
    assert repr(found) == "<ConfigurationsResult: 2 configurations; there are no others>"
    table = {column.name: column.values for column in found.tables()["configurations"]}
    assert table["configuration"].tolist() == [1.0, 2.0]
    half = np.sqrt(4.0 - np.sin(0.4) ** 2)
    expected = [size * (np.cos(0.4) + sign * half) for sign in (-1, 1)]
    np.testing.assert_allclose(sorted(table["slide.x"]), expected, rtol=1e-9)
    limits = kp.limits(m, kp.assemble(m, set={"crank.angle": 0.4}), over="slide.x")
    assert repr(limits) == f"<LimitsResult {limits.report()[0]}>"


def test_mobility() -> None:
    m, start = pendulums(1)
    assert repr(kp.mobility(m, start)) == "<MobilityResult: 1 degree of freedom>"
    m, start = pendulums(2)
    assert repr(kp.mobility(m, start)) == "<MobilityResult: 2 degrees of freedom>"
    m = kp.Model("door", redundancy="allow")
    m.ground.points(A=(0, 0), B=(0, 1))
    m.body("door", mass=10, inertia=1, points={"A": (0, 0), "B": (0, 1)})
    m.translational("low", "ground.A", "door.A")
    m.translational("high", "ground.B", "door.B")
    found = kp.mobility(m, kp.assemble(m))
    assert len(found.redundant) == 2
    assert repr(found) == "<MobilityResult: 1 degree of freedom, 2 redundant>"


@pytest.mark.parametrize("count", [1, 2])
def test_mobility_with_drivers(count: int) -> None:
    m, _ = pendulums(3)
    for k in range(count):
        m.coordinate_driver(f"motor{k}", f"b{k}.angle", value="0.1*t")
    free = f"{3 - count} degree{'s' * (3 - count != 1)} of freedom"
    counts = f"9 coordinates - {6 + count} equations = {3 - count} by Grübler"
    drivers = f"3 without its driver{'s' * (count != 1)}"
    told = kp.mobility(m, kp.assemble(m)).report()
    assert told == [f"{counts}; rank {6 + count}: {free}, {drivers}"]


@pytest.mark.parametrize("count", [19, 20, 21, 23])
def test_twenty_modes_are_listed(count: int) -> None:
    m, start = pendulums(count)
    told = kp.modes(m, start).report()
    omega = np.sqrt(9.81 / np.arange(count, 0, -1.0))
    listed = [
        f"mode {k + 1}: {w / (2 * np.pi):.6g} Hz, ω = {w:.6g} rad/s, damping ratio 0"
        for k, w in enumerate(omega[:20])
    ]
    more = [f"and {count - 20} more modes"] if count > 20 else []
    assert told[0].startswith(f"{count} independent coordinates: ")
    assert told[1:] == [*listed, *more]
