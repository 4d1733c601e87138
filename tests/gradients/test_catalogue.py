"""Slopes of each element of the catalogue by each of its numbers, against differences."""

import re
import warnings
import zlib
from typing import Any

import kempe as kp
import numpy as np
import pytest
from gradients.catalogue_belts import BELTS
from gradients.catalogue_contacts import CONTACTS, bouncing_pin
from gradients.catalogue_forces import FORCES
from gradients.catalogue_joints import JOINTS, Made, Maker, Units, slide_on_a_bar, slipping_wheel
from gradients.test_random import differences
from kempe.model.catalogue import declared
from sizes import count

EXACT = kp.DOP853(rtol=1e-12, atol=1e-14)
#: Relative changes of a variable: for smooth motions, and those that keep the order of changes.
STEPS = (1e-3, 2e-3, 4e-3), (2e-5, 4e-5, 8e-5)
#: Largest error of a slope, as a part of its scale, and that of most slopes.
MOST, USUAL = 1e-5, 1e-7
ALL = [*JOINTS, *BELTS, *FORCES, *CONTACTS]
#: Numbers on which nothing depends: axes of a revolute joint turn the frame of its reaction, and
#: of a pin without friction only the clearance moves its body. The static
#: coefficient has no effect on a wheel that only slides.
STILL = {slide_on_a_bar: {"a", "b"}, bouncing_pin: {"R"}, slipping_wheel: {"mus"}}
#: Numbers that cannot change a little, and a threshold.
FIXED = {"teeth", "rest_speed"}
NUMBERS = ["number", "law", "pair", "triple", "law_pair", "laws", "terms"]
#: What analyses without forces cannot tell, and what a position of rest has not.
DYNAMIC = re.compile("force|torque|effort|power|energy|tangential|normal|load|dissipated|f[xy]$")
AT_REST = re.compile(r"\.(angle|x|y)$")


def start_of(maker: Maker, seed: int) -> int:
    return zlib.crc32(f"{maker.__name__} {seed}".encode())


def made(maker: Maker, seed: int) -> Made:
    return maker(Units(start_of(maker, seed)))


def request(of: Made, kind: str, rate: float) -> tuple[kp.Case, list[str]]:
    """A case with one analysis, and the measures that it has."""
    output = {"t_end": of.end / rate, "output_step": of.end / rate / 20}
    run: Any
    measures = of.measures
    if kind == "dynamics":
        run = kp.Dynamics(method=EXACT, **output)
    elif kind == "inverse_dynamics":
        run = kp.InverseDynamics(**output)
    elif kind == "kinematics":
        run = kp.Kinematics(**output)
        measures = [one for one in measures if not DYNAMIC.search(one.rsplit(".", 1)[0])]
    else:
        run = kp.Equilibrium()
        known = (one.rsplit(".", 1)[0] for one in measures)
        measures = [one for one in known if AT_REST.search(one)]
    return kp.Case(of.model, {"set": of.start, "guess": of.guess}, [run]), measures


def compared(of: Made, kind: str, rate: float) -> tuple[kp.Gradient, Any, Any]:
    """The slopes, their errors as parts of their scales, and whether the differences settle."""
    case, measures = request(of, kind, rate)
    variables = [*of.model.parameters, *(of.start if kind == "dynamics" else ())]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        g = kp.gradient(case, measures, variables)
        given = np.array([abs(x) or 1.0 for x in g.variables.values()])
        error, doubt = np.full(g.jacobian.shape, np.inf), np.full(g.jacobian.shape, np.inf)
        for steps in STEPS[::-1] if of.changes else STEPS:
            true, unsettled = differences(case, g, steps)
            known = np.where(np.isnan(g.jacobian), true, g.jacobian)
            change = np.nanmax(np.abs(known) * given, axis=1, keepdims=True)
            scale = (np.abs(list(g.measures.values()))[:, None] + change) / given
            better = unsettled / scale < doubt
            error = np.where(better, np.abs(g.jacobian - true) / scale, error)
            doubt = np.where(better, unsettled / scale, doubt)
            if not (doubt > USUAL / 10).any() and not (error > USUAL).any():
                break
    return g, error, doubt


def words(entry: Any) -> set[str]:
    """The words of all texts in a field."""
    if isinstance(entry, dict):
        entry = list(entry.values())
    if isinstance(entry, list | tuple):
        return {word for one in entry for word in words(one)}
    return set(re.findall(r"[a-zA-Z_]\w*", entry)) if isinstance(entry, str) else set()


@pytest.mark.parametrize("seed", range(count(1, 12)))
@pytest.mark.parametrize("maker", ALL)
def test_slopes_of_an_element(maker: Maker, seed: int) -> None:
    of, rate = made(maker, seed), Units(start_of(maker, seed)).rate
    for kind in of.analyses:
        g, error, doubt = compared(of, kind, rate)
        assert not g.remarks, kind
        # where differences do not settle, or a value is constant, they say nothing
        settled = doubt < MOST / 10
        wrong = settled & ~(error < MOST)
        names = list(g.measures), list(g.variables)
        told = {(names[0][k], names[1][j], error[k, j]) for k, j in np.argwhere(wrong).tolist()}
        assert not told, kind
        assert settled.mean() > 0.8
        if seed > 0:
            continue  # other draws may not reach a stop or tighten a cord
        assert (error[settled] < USUAL).mean() > 0.9
        if kind == "dynamics":
            still = {name for name, of in zip(names[1], g.jacobian.T, strict=True) if not of.any()}
            assert still == STILL.get(maker, set())


def test_every_number_of_every_element_is_a_variable() -> None:
    covered = set()
    for maker in ALL:
        for seed in range(8):
            of = made(maker, seed)
            tree = kp.Case(of.model, {"set": of.start}, [kp.Modes()]).tree()
            for group in ("joints", "drivers", "forces"):
                for entry in tree.get(group, {}).values():
                    names = {
                        name for name in entry if words(entry[name]) & set(of.model.parameters)
                    }
                    covered |= {(entry["type"], name) for name in names}
    every = {
        (kind, one["name"])
        for group in ("joints", "drivers", "forces")
        for kind, entry in declared(group).items()
        for one in entry["fields"]
        if one["shape"] in NUMBERS and one["name"] not in FIXED
    }
    without = {kind for group in ("joints", "drivers", "forces") for kind in declared(group)}
    assert every <= covered
    assert without - {kind for kind, _ in every} == {"point_on_curve"}  # its curve has the numbers
