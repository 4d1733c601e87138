"""Defects of six-bars whose positions are known to be wrong."""

import kempe as kp
import numpy as np
import pytest
from kempe.synthesis.six_bar.candidate import SixBar
from kempe.synthesis.six_bar.judge import judged
from kempe.synthesis.six_bar.topology import topology
from sizes import some
from synthesis.six_bars import LINKS, Complexes, drawn


def defects(family: str, at: dict[str, Complexes], way: int = 0) -> SixBar:
    """The judgement on a six-bar with these points at its positions."""
    of = topology(family)
    linkage, angles = of.from_points(at)
    pins = tuple(complex(at[name][0]) for name in of.names)
    crank = angles[:, of.crank]
    one = SixBar(pins, 0.0, 0.0, 0.0, False, True, (), crank, {}, of)
    return judged([one], linkage[:1], angles[None], way)[0]


@pytest.mark.parametrize("family", some(list(LINKS), 3))
def test_each_defect_has_its_place(family: str) -> None:
    n = 8
    _, _, at = drawn(family, 1, n, 2.0 * np.pi * (n - 1) / n)
    right = defects(family, at)
    assert right.defects == () and right.turns and right.transmission_angle > 0.0
    assert abs(right.crank_angles[-1] - right.crank_angles[0]) < 2.0 * np.pi
    swapped = {name: z[[0, 1, 2, 5, 3, 4, 6, 7]] for name, z in at.items()}
    assert defects(family, swapped).defects == ("order: at position 5",)
    assert defects(family, at, -1).defects == ("order: at position 3",)
    if family == "stephenson_2":
        return
    # the other closure of the dyad, which a crank that turns fully never reaches
    foot = {"watt_1": "E", "stephenson_1": "E"}.get(family, "G")
    other = {name: z.copy() for name, z in at.items()}
    base, line = at["C"][3], at[foot][min(3, len(at[foot]) - 1)] - at["C"][3]
    unit = line / abs(line)
    other["F"][3] = base + unit * ((at["F"][3] - base) / unit).conjugate()
    turned = (other["F"][3] - base) / (at["F"][3] - base)
    other["P"][3] = base + (at["P"][3] - base) * turned
    assert defects(family, other).defects == ("circuit: at position 4",)


@pytest.mark.parametrize("family", some(list(LINKS), 3))
def test_a_crank_that_reverses_has_a_branch(family: str) -> None:
    for seed in range(60):
        _, _, at = drawn(family, seed, 2, 0.2)
        case = defects(family, at).case
        range_ = kp.limits(case.model, case.start(), over="crank.angle")
        if range_.upper is None:
            continue
        # past the limit, driven by another body
        body = next(b for b in ("arm", "rocker", "coupler") if b in topology(family).bodies)
        value = float(range_.path[f"{body}.angle"][-1])
        first = float(case.start()[f"{body}.angle"])
        ends = (first, value + 0.6 * float(np.sign(value - first)))
        try:
            run = kp.kinematics(case.model, case.start(), over=f"{body}.angle", range=ends)
        except kp.SingularityError as error:
            run = error.solution
        crank = run["crank.angle"]
        top = int(np.argmax(crank))
        if top in (0, len(crank) - 1) or crank[top] - crank[-1] < 0.02:
            continue
        rows = [0, len(crank) - 1]
        places = {}
        for name in at:
            owner = next(b for b, of in topology(family).bodies.items() if name in of)
            x, y = (run[f"{owner}.{name}.{axis}"] for axis in "xy")
            places[name] = (x + 1j * y)[rows]
        assert "branch: at position 2" in defects(family, places).defects
        return
    raise AssertionError("no crank reverses")
