"""Tooth numbers against all combinations, and simulated ratios."""

import itertools
from fractions import Fraction

import kempe as kp
import numpy as np
import pytest
from kempe.design.gear_train import _planetary


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


#: Of each kind: its request, the pairs of wheels that mesh outside, and the shafts of its wheels.
TRAINS = {
    "simple": ((-2.5, "simple"), [("input", "output")], [("input",), ("output",)]),
    "idler": (
        (1.7, "simple"),
        [("input", "idler"), ("idler", "output")],
        [("input",), ("idler",), ("output",)],
    ),
    "compound": (
        (np.pi, "compound", (17, 25)),
        [("input", "first"), ("second", "output")],
        [("input",), ("first", "second"), ("output",)],
    ),
    "planetary": ((4.2, "planetary", (17, 40)), [("sun", "planet")], [("sun",), ("planet",)]),
}


@pytest.mark.parametrize("name", TRAINS)
def test_the_case_has_wheels_of_steel_at_their_distances(name: str) -> None:
    """Discs of the radius z m / 2, 20 mm wide, 7800 kg/m³; the input turns once in 1 s."""
    asked, meshes, shafts = TRAINS[name]
    train = kp.design.gear_train(*asked)  # type: ignore[arg-type]
    radius = {wheel: count * 0.002 / 2 for wheel, count in train.teeth.items()}
    mass = {wheel: 7800 * 0.02 * np.pi * r**2 for wheel, r in radius.items()}
    model = train.case.model.compile()
    assert model.gravity == (0.0, 0.0)
    axles = [f"axle_{wheels[0]}" for wheels in shafts]
    others = [f"mesh_{k}" for k, _ in enumerate(meshes, 1)]
    if name == "planetary":
        axles.insert(1, "axle_carrier")
        others = ["inner", "outer"]
    assert sorted(model.joints) == sorted([*axles, *others])
    motion = train.case.run()["motion"]
    for wheels in shafts:
        body = model.bodies[wheels[0]]
        assert body.mass == pytest.approx(sum(mass[one] for one in wheels), rel=1e-12)
        inertia = sum(mass[one] * radius[one] ** 2 / 2 for one in wheels)
        assert body.inertia == pytest.approx(inertia, rel=1e-12)
        assert body.center == (0.0, 0.0)
    of = {wheel: wheels[0] for wheels in shafts for wheel in wheels}
    for a, b in meshes:
        apart = [motion[f"{of[b]}.{axis}"] - motion[f"{of[a]}.{axis}"] for axis in "xy"]
        assert np.hypot(*apart) == pytest.approx(radius[a] + radius[b], rel=1e-12)
    if name == "planetary":
        carrier = model.bodies["carrier"]  # a tenth as wide as long, of the same sheet
        arm = radius["sun"] + radius["planet"]
        assert carrier.mass == pytest.approx(7800 * 0.02 * 0.02 * arm, rel=1e-12)
        assert carrier.inertia == pytest.approx(carrier.mass * arm**2 / 12, rel=1e-12)
        assert radius["ring"] == pytest.approx(arm + radius["planet"], rel=1e-12)
    first = shafts[0][0]
    assert motion.t[-1] == 1.0 and len(motion.t) == 101
    assert motion[f"{first}.angle"] == pytest.approx(2 * np.pi * motion.t, abs=1e-12)


def test_of_equal_trains_the_one_with_the_fewest_teeth_is_taken() -> None:
    assert dict(kp.design.gear_train(-2.0).teeth) == {"input": 17, "output": 34}
    assert dict(kp.design.gear_train(2.0).teeth) == {"input": 17, "idler": 17, "output": 34}
    train = kp.design.gear_train(6.0, "compound", (17, 60))
    assert train.teeth["input"] == train.teeth["second"] == 17 and train.error == 0.0
    assert sum(train.teeth.values()) == min(
        a + b + c + d
        for a, c in itertools.product(range(17, 25), repeat=2)
        for b, d in itertools.product(range(17, 61), repeat=2)
        if b * d == 6 * a * c
    )
    planetary = kp.design.gear_train(4.0, "planetary", (17, 40), planets=4)
    fitting = [
        (2 * sun + 3 * planet, sun, planet, sun + 2 * planet)
        for sun, planet in itertools.product(range(17, 41), repeat=2)
        if 2 * planet == 2 * sun
        and (2 * sun + 2 * planet) % 4 == 0
        and (sun + planet) * np.sin(np.pi / 4) > planet + 2
    ]
    assert tuple(planetary.teeth.values()) == min(fitting)[1:]
    assert planetary.planets == 4 and kp.design.gear_train(2.0).planets == 0


@pytest.mark.parametrize(
    ("asked", "told"),
    [
        ((-2.5,), "<GearTrain: input 18, output 45; ratio -2.5, error 0>"),
        ((3.005,), "<GearTrain: input 17, idler 17, output 51; ratio 3, error -0.0017>"),
    ],
)
def test_a_train_names_its_wheels(asked: tuple[float, ...], told: str) -> None:
    assert repr(kp.design.gear_train(*asked, teeth=(17, 60))) == told


@pytest.mark.parametrize("planets", [1, 2, 3, 5])
def test_neighbouring_planets_do_not_touch(planets: int) -> None:
    """All trains of the limits: planets mesh in turn, and outer circles of z + 2 stay apart."""
    found = list(_planetary(0.0, 17, 30, planets))
    fitting = [
        (sun, planet)
        for sun, planet in itertools.product(range(17, 31), repeat=2)
        if (2 * sun + 2 * planet) % planets == 0
        and sun + 2 * planet <= 90
        and (planets == 1 or 2 * (sun + planet) * np.sin(np.pi / planets) > 2 * (planet + 2))
    ]
    assert [(one["sun"], one["planet"]) for one, _ in found] == fitting
    assert [one["ring"] for one, _ in found] == [sun + 2 * planet for sun, planet in fitting]
    ratios = [2 * (sun + planet) / sun for sun, planet in fitting]
    assert [ratio for _, ratio in found] == pytest.approx(ratios, rel=1e-15)
