"""Unknown time shifts, data of results at rest, data outside of a run, and skew intervals."""

import kempe as kp
import numpy as np
import pytest


def oscillator(mass: float, rate: float, size: float, ends: kp.Dynamics | None = None) -> kp.Case:
    m = kp.Model("oscillator", gravity=(0, 0), parameters={"k": mass * rate**2, "mass": mass})
    m.ground.points(O=(0, 0))
    m.body("b", mass="mass", inertia=mass, points={"P": (0, 0)})
    m.translational("guide", "ground.O", "b.P")
    m.generalized_force("spring", "guide.displacement", value="-k*guide.displacement")
    run = ends or kp.Dynamics(t_end=10 / rate, output_step=0.01 / rate)
    return kp.Case(m, {"set": {"b.x": size, "b.vx": 0}}, [run])


SCALES = [(1.0, 1.0, 1.0), (1e3, 30.0, 1e-3), (1e-3, 0.03, 1e3)]


@pytest.mark.parametrize(("mass", "rate", "size"), SCALES)
def test_an_unknown_shift(mass: float, rate: float, size: float) -> None:
    """x = size cos(ω t), recorded by a clock that starts late; intervals contain the truth."""
    late, true = 0.7 / rate, 1.1 * rate
    t = np.linspace(0, 8 / rate, 80)
    noise = 0.01 * size * np.random.default_rng(1).normal(size=len(t))
    x = size * np.cos(true * (t + late)) + noise
    data = kp.Data({"t": t, "x": x}, columns={"b.x": "x"}, sigma={"b.x": 0.01 * size}, shift="t0")
    fit = kp.fit(oscillator(mass, rate, size), data, {"k": (0, None), "t0": None})
    for name, value in {"k": mass * true**2, "t0": late}.items():
        low, high = fit.intervals[name]
        assert low < value < high and fit.values[name] == pytest.approx(value, rel=0.02)
    phase = np.sin(true * (t + late))
    slopes = -np.column_stack([phase * (t + late) / (2 * mass * true), phase * true]) / 0.01
    exact = np.sqrt(np.diag(np.linalg.inv(slopes.T @ slopes)))
    assert list(fit.standard_errors.values()) == pytest.approx(exact, rel=0.02)
    assert not fit.undetermined and fit.case.model.parameters["k"] == fit.values["k"]


def test_a_shift_of_most_of_a_period() -> None:
    """Downhill from a shift of 0, the search would end half a period away."""
    t = np.linspace(0, 3, 40)
    data = kp.Data({"t": t, "x": np.cos(1.05 * (t + 5.0))}, columns={"b.x": "x"}, shift="t0")
    fit = kp.fit(oscillator(1, 1, 1), data, {"k": (0, None), "t0": None})
    assert dict(fit.values) == pytest.approx({"k": 1.05**2, "t0": 5.0}, rel=1e-6)


def test_two_recordings_with_shifts_of_their_own() -> None:
    case, t = oscillator(1, 1, 1), np.linspace(0, 6, 50)
    pairs = []
    for name, late in (("t0", 0.3), ("t1", 2.1)):
        table = {"t": t, "x": np.cos(1.2 * (t + late))}
        pairs.append(({}, kp.Data(table, columns={"b.x": "x"}, shift=name)))
    fit = kp.fit(case, pairs, {"k": (0.5, 4), "t0": (0, 1), "t1": (0, 3)})
    assert dict(fit.values) == pytest.approx({"k": 1.44, "t0": 0.3, "t1": 2.1}, rel=1e-6)


def test_a_parameter_of_the_second_model_only() -> None:
    """x = L/k + (1 - L/k) cos √k t in the second one, with a load L."""
    first, second = oscillator(1, 1, 1), oscillator(1, 1, 1)
    tree = second.model.tree()
    tree["parameters"]["load"] = 0.1
    tree["forces"]["pull"] = {"type": "force", "j": "b.P", "force": ["load", 0]}
    start = {"set": {"b.x": 1, "b.vx": 0}}
    second = kp.Case(kp.Model.from_tree(tree), start, [kp.Dynamics(t_end=7)])
    t, rate = np.linspace(0, 6, 40), np.sqrt(1.44)
    pairs = []
    for case, rest in ((first, 0.0), (second, 0.3 / 1.44)):
        table = {"t": t, "x": rest + (1 - rest) * np.cos(rate * t)}
        pairs.append((case, kp.Data(table, columns={"b.x": "x"})))
    fit = kp.fit(first, pairs, {"k": (0.5, 4), "load": (0, 1)})
    assert dict(fit.values) == pytest.approx({"k": 1.44, "load": 0.3}, rel=1e-5)


def test_frequencies_of_modes() -> None:
    """f = √(k/m) / 2π with two masses; repeated measurements; the errors in closed form."""
    m = oscillator(2, 10, 0.1).model
    case = kp.Case(m, None, [kp.Modes(name="modes")])
    k, sigma = 300.0, 1e-3
    pairs = []
    for mass in (2.0, 5.0):
        f = np.sqrt(k / mass) / (2 * np.pi)
        rows = f + sigma * np.array([0.4, -0.7, 0.3])
        data = kp.Data({"f [Hz]": rows}, t=None, columns={"frequency[0]": "f"},
                       sigma={"frequency[0]": sigma})  # fmt: skip
        pairs.append(({"mass": mass}, data))
    fit = kp.fit(case, pairs, {"k": (0, None)})
    slopes = np.repeat([np.sqrt(k / mass) / (4 * np.pi * k) for mass in (2.0, 5.0)], 3)
    assert fit.values["k"] == pytest.approx(k, rel=1e-6)
    assert fit.standard_errors["k"] == pytest.approx(sigma / np.linalg.norm(slopes), rel=1e-5)
    both = kp.fit(case, pairs[0][1], {"k": (0, None), "mass": (0, None)})
    assert both.undetermined == ("only k/mass is determined",)


def test_places_at_rest() -> None:
    """A weight on a spring: k from its place at rest."""
    model = kp.Model("weight", gravity=(10, 0), parameters={"k": 50.0})
    model.ground.points(O=(0, 0))
    model.body("b", mass=2, inertia=1, points={"P": (0, 0)})
    model.translational("guide", "ground.O", "b.P")
    model.generalized_force("spring", "guide.displacement", value="-k*guide.displacement")
    case = kp.Case(model, None, [kp.Equilibrium()])
    data = kp.Data({"x [mm]": [199, 201]}, t=None, columns={"b.x": "x"}, sigma={"b.x": "1 mm"})
    fit = kp.fit(case, data, {"k": (1, None)})
    assert fit.values["k"] == pytest.approx(100, rel=1e-4)
    assert fit.standard_errors["k"] == pytest.approx(1e-3 / np.sqrt(2) * 100**2 / 20, rel=1e-3)


def test_an_interval_that_is_not_linear() -> None:
    """cos(t √(k/m)) depends on 1/m; the sum of squares at the ends of the interval is exact."""
    t = np.array([0.5, 0.8])
    x = np.cos(t) + np.array([0.01, -0.01])
    case = oscillator(1, 1, 1)
    data = kp.Data({"t": t, "x": x}, columns={"b.x": "x"}, sigma={"b.x": 0.05})
    fit = kp.fit(case, data, {"mass": (0.05, None)})

    def squares(mass: float) -> float:
        return float((((np.cos(t / np.sqrt(mass)) - x) / 0.05) ** 2).sum())

    low, high = fit.intervals["mass"]
    assert any("the interval of mass is that of the profile" in text for text in fit.remarks)
    for end in (low, high):
        excess = squares(end) - squares(fit.values["mass"])
        assert excess == pytest.approx(1.96**2, rel=2e-2)
    assert high - fit.values["mass"] > 1.3 * (fit.values["mass"] - low)
    precise = kp.Data({"t": t, "x": x}, columns={"b.x": "x"}, sigma={"b.x": 1e-3})
    assert not any("profile" in text for text in kp.fit(case, precise, {"mass": None}).remarks)


def test_a_profile_over_two_parameters() -> None:
    """The ends for mass with k free too, by minimising over k on a fine grid; at most infinite."""
    t = np.linspace(0.3, 3, 12)
    x = 0.2 * t + np.cos(t) + 0.02 * np.random.default_rng(3).normal(size=12)
    case = oscillator(1, 1, 1)
    data = kp.Data({"t": t, "x": x - 0.2 * t}, columns={"b.x": "x"}, sigma={"b.x": 0.1})
    fit = kp.fit(case, data, {"mass": (0.01, None), "b.vx": (-1, 1)})

    def squares(mass: float) -> float:
        rate = 1 / np.sqrt(mass)
        speeds = np.linspace(-1, 1, 4001)[:, None]
        motion = np.cos(rate * t) + speeds / rate * np.sin(rate * t)
        return float((((motion - data.values["b.x"]) / 0.1) ** 2).sum(axis=1).min())

    low, high = fit.intervals["mass"]
    least = squares(fit.values["mass"])
    assert any("the interval of mass" in text for text in fit.remarks)
    for end in (low, high):
        assert squares(end) - least == pytest.approx(1.96**2, rel=3e-2)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"t": [0.0, 11.0]}, r"from 0 to 11 s, and the run from 0 to 10 s.*change t_end"),
        ({"t": [-1.0, 1.0]}, r"from -1 to 1 s, and the run from 0 to 10 s.*leave out the data"),
        ({"shift": "k"}, r"shift: k: it is a parameter of the case"),
        ({"shift": "t1"}, r"shift: t1: the fit does not find it"),
        ({"shift": 3}, r"shift: 3; must be the name"),
    ],
)
def test_wrong_times(change: dict[str, object], message: str) -> None:
    given = {"t": [0.0, 1.0], "shift": None} | change
    with pytest.raises(kp.ModelError, match=message):
        data = kp.Data({"t": given["t"], "x": [1.0, 0.5]}, columns={"b.x": "x"},
                       shift=given["shift"])  # type: ignore[arg-type]  # fmt: skip
        kp.fit(oscillator(1, 1, 1), data, {"k": (0.1, None)})


@pytest.mark.parametrize("rate", [0.03, 1.0, 30.0])
def test_data_that_no_shift_joins_to_the_run(rate: float) -> None:
    """From 3 to 5 of 10 the shift may go from -3 to 5."""
    t = np.array([3.0, 4.0, 5.0]) / rate
    data = kp.Data({"t": t, "x": np.cos(rate * t)}, columns={"b.x": "x"}, shift="t0")
    case = oscillator(1, rate, 1)
    for low, high in ((6.0, 9.0), (-9.0, -4.0)):
        with pytest.raises(kp.ModelError) as caught:
            kp.fit(case, data, {"k": (0, None), "t0": (low / rate, high / rate)})
        ends = [f"{x / rate:.6g}" for x in (3, 5, 0, 10)]
        told = "data: they go from {} to {} s, and the run from {} to {} s, ".format(*ends)
        assert str(caught.value).startswith(f"{told}which no t0 within its bounds can join")
    found = kp.fit(case, data, {"k": (0, None), "t0": (-4.0 / rate, 4.0 / rate)})
    assert found.values["t0"] == pytest.approx(0.0, abs=1e-3 / rate)


def test_times_that_are_missing_or_too_many() -> None:
    case = oscillator(1, 1, 1)
    data = kp.Data({"x": [1.0, 0.5]}, t=None, columns={"b.x": "x"})
    with pytest.raises(kp.ModelError, match="is a motion, and the data have no times"):
        kp.fit(case, data, {"k": (0.1, None)})
    modes = kp.Case(case.model, None, [kp.Modes()])
    timed = kp.Data({"t": [0, 1], "f": [1.0, 0.5]}, columns={"frequency[0]": "f"})
    with pytest.raises(kp.ModelError, match="is not a motion, and the data have times"):
        kp.fit(modes, timed, {"k": (0.1, None)})
