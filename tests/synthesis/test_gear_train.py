"""Tooth numbers against all combinations, and simulated ratios."""

import itertools
from fractions import Fraction

import kempe as kp
import numpy as np
import pytest


def speeds(train: kp.design.GearTrain) -> float:
    motion = train.case.run()["motion"]
    first, last = ("sun", "carrier") if train.kind == "planetary" else ("input", "output")
    return float(motion[f"{first}.omega"][-1] / motion[f"{last}.omega"][-1])


@pytest.mark.parametrize("ratio", [-3.5, -1.0, -np.pi, 2.25, -0.3, 7.3])
def test_simple_trains(ratio: float) -> None:
    train = kp.design.gear_train(ratio, teeth=(17, 60))
    pairs = itertools.product(range(17, 61), repeat=2)
    best = min(abs(b / a - abs(ratio)) for a, b in pairs)
    assert abs(abs(train.ratio) - abs(ratio)) == pytest.approx(best, abs=1e-12)
    assert speeds(train) == pytest.approx(train.ratio, rel=1e-9)
    assert ("idler" in train.teeth) == (ratio > 0.0)


@pytest.mark.parametrize("ratio", [np.pi, 12.0, 0.2])
def test_compound_trains_are_the_best_of_all(ratio: float) -> None:
    train = kp.design.gear_train(ratio, "compound", (17, 29))
    counts = range(17, 30)
    quads = itertools.product(counts, repeat=4)
    best = min(abs(b * d / (a * c) - ratio) for a, b, c, d in quads)
    assert abs(train.ratio - ratio) == pytest.approx(best, abs=1e-12)
    wheels = train.teeth
    exact = Fraction(wheels["first"] * wheels["output"], wheels["input"] * wheels["second"])
    assert train.ratio == pytest.approx(float(exact), rel=1e-15)
    assert speeds(train) == pytest.approx(train.ratio, rel=1e-9)


@pytest.mark.parametrize(("ratio", "planets"), [(3.6, 3), (4.2, 4), (5.0, 3), (3.1234, 5)])
def test_planetary_trains_can_be_assembled(ratio: float, planets: int) -> None:
    train = kp.design.gear_train(ratio, "planetary", planets=planets)
    sun, planet, ring = (train.teeth[name] for name in ("sun", "planet", "ring"))
    assert ring == sun + 2 * planet
    assert (sun + ring) % planets == 0
    assert (sun + planet) * np.sin(np.pi / planets) > planet + 2
    assert train.ratio == pytest.approx(1.0 + ring / sun, rel=1e-15)
    assert abs(train.error) < 2e-2
    assert speeds(train) == pytest.approx(train.ratio, rel=1e-9)


@pytest.mark.parametrize(
    ("ratio", "options", "message"),
    [
        (0.0, {}, "other than 0"),
        (2.0, {"kind": "bevel"}, "kind"),
        (-2.0, {"kind": "compound"}, "impossible"),
        (0.5, {"kind": "planetary"}, "impossible"),
        (2.0, {"teeth": (50, 20)}, "teeth"),
        (4.0, {"kind": "planetary", "teeth": (17, 18), "planets": 9}, "no planetary train"),
    ],
)
def test_wrong_requests_are_explained(ratio: float, options: dict, message: str) -> None:
    with pytest.raises(kp.ModelError, match=message):
        kp.design.gear_train(ratio, **options)
