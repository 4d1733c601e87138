"""Fits find the true values as often as their intervals promise, and say what is not determined."""

import kempe as kp
import numpy as np
import pytest
from fits.machines import (
    ARM,
    MASS,
    SLIDER,
    TIMES,
    TRUE,
    G,
    angle,
    film,
    four_bar,
    rod,
    slider,
    slider_data,
)  # fmt: skip
from sizes import count

ROD = {"J": (0, None), "c": (0, None), "rod.angle": None}


def within(trials: int) -> tuple[int, int]:
    """Fewest and most hits of 95 %: 950 ± 20 of 1000, else three and a half standard deviations."""
    spread = 20 if trials == 1000 else 3.5 * np.sqrt(trials * 0.95 * 0.05)
    return int(np.ceil(0.95 * trials - spread)), int(min(0.95 * trials + spread, trials))


@pytest.mark.parametrize(("sigma", "most"), [(None, 1000), ({"rod.angle": "0.5 deg"}, 350)])
def test_intervals_of_the_rod_contain_the_truth(sigma: dict[str, str] | None, most: int) -> None:
    case, trials = rod(), count(20, most)
    inside = dict.fromkeys(TRUE, 0)
    for seed in range(trials):
        found = kp.fit(case, angle(film(seed), sigma=sigma), ROD)
        assert found.success and not found.undetermined and not found.remarks
        for name, value in TRUE.items():
            low, high = found.intervals[name]
            inside[name] += low <= value <= high
    least, largest = within(trials)
    assert all(least <= hits <= largest for hits in inside.values()), inside


def test_intervals_of_a_linkage_contain_the_truth() -> None:
    """k and c of a four-bar linkage from its angle with 1 % noise."""
    case, trials = four_bar(), count(20, 1000)
    times = np.linspace(0, 0.5, 60)
    exact = case.run()["dynamics"](times)["rocker.angle"]
    noise = 0.01 * (exact.max() - exact.min())
    away = case.with_parameters({"k": 800, "c": 14})
    inside = {"k": 0, "c": 0}
    for seed in range(trials):
        measured = exact + noise * np.random.default_rng(seed).normal(size=60)
        data = kp.Data({"t": times, "a": measured}, columns={"rocker.angle": "a"})
        found = kp.fit(away, data, {"k": (0, None), "c": (0, None)})
        for name, value in (("k", 1e3), ("c", 10.0)):
            inside[name] += found.intervals[name][0] <= value <= found.intervals[name][1]
    least, largest = within(trials)
    assert all(least <= hits <= largest for hits in inside.values()), inside


def test_standard_errors_are_those_of_least_squares() -> None:
    """Values and errors as SciPy finds them with differences of an independent integration."""
    from scipy.integrate import solve_ivp
    from scipy.optimize import least_squares

    table = film(3)
    measured = np.radians(table["phi [deg]"])

    def apart(x: np.ndarray) -> np.ndarray:
        def rate(_: float, y: list[float]) -> list[float]:
            return [y[1], (-MASS * G * ARM * np.sin(y[0]) - x[1] * y[1]) / (x[0] + MASS * ARM**2)]

        start = [x[2], 0]
        found = solve_ivp(rate, (0, 6), start, t_eval=TIMES, rtol=1e-11, atol=1e-13)
        return found.y[0] - measured

    other = least_squares(apart, list(TRUE.values()), x_scale=list(TRUE.values()), diff_step=1e-5)
    spread = other.fun @ other.fun / (len(TIMES) - 3)
    errors = np.sqrt(np.diag(np.linalg.inv(other.jac.T @ other.jac)) * spread)
    found = kp.fit(rod(), angle(table), ROD)
    assert list(found.values.values()) == pytest.approx(other.x, rel=1e-6)
    assert list(found.standard_errors.values()) == pytest.approx(errors, rel=1e-3)
    assert found.sigma["rod.angle"] == pytest.approx(np.sqrt(spread), rel=1e-6)
    assert found.residuals["rod.angle"] == pytest.approx(other.fun, abs=1e-6)


UNDETERMINED: list[tuple[dict[str, float], list[str], str]] = [
    ({}, ["m", "c", "k", "F"], r"only .*/.* and .*/.* and .*/.* are determined, not m, c, k, F"),
    ({"c": 0.0}, ["m", "k", "F"], r"only m/k and m/F are determined"),
    ({"k2": 20.0, "k": 30.0}, ["k", "k2"], r"only k \+ 1 k2 is determined"),
    ({"c2": 0.5, "c": 1.0}, ["c", "c2"], r"only c \+ 1 c2 is determined"),
    ({"m2": 0.5, "m": 1.5}, ["m", "m2"], r"only m \+ 1 m2 is determined"),
    ({"preload": 1.0, "F": 5.0}, ["F", "preload"], r"only F - 1 preload is determined"),
    ({"free": 0.02, "F": 3.0}, ["F", "free"], r"only F \+ 50 free is determined"),
    ({"free": 0.02, "F": 3.0}, ["free", "F", "c"], r"only free \+ 0.02 F is determined"),
    ({"k2": 20.0, "k": 30.0, "c2": 0.5, "c": 1.0}, ["k", "k2", "c", "c2"],
     r"only k \+ 1 k2 is determined; only c \+ 1 c2 is determined"),
    ({"m2": 0.5, "m": 0.5, "extra": 1.0}, ["m", "m2", "extra"], r"extra has no effect on the data"),
]  # fmt: skip


@pytest.mark.parametrize(("given", "names", "told"), UNDETERMINED)
def test_an_undetermined_combination_is_named(
    given: dict[str, float], names: list[str], told: str
) -> None:
    import re

    start = {name: 1.03 * x for name, x in given.items()} | {"x0": 0.1}
    data = slider_data(5)
    found = kp.fit(
        slider(**(given if "c" in given and not given["c"] else start)), data, dict.fromkeys(names)
    )
    text = "; ".join(found.undetermined)
    assert re.search(told, text), text
    lost = [name for name in names if name in text]
    assert all(found.standard_errors[name] == np.inf for name in lost), found
    assert all(np.isfinite(found.standard_errors[name]) for name in set(names) - set(lost))


@pytest.mark.parametrize(
    "names",
    [["m"], ["k"], ["c", "k"], ["m", "c"], ["k", "F"], ["c", "k", "F"], ["m", "c", "F"],
     ["x0", "k"], ["x0", "c", "k", "F"], ["m", "x0", "c", "free"]],
)  # fmt: skip
def test_nothing_is_named_where_all_is_determined(names: list[str]) -> None:
    true = {**SLIDER, "x0": 0.1, "free": 0.0}
    away = {name: 1.05 * true[name] for name in names}
    found = kp.fit(slider(**away), slider_data(7), dict.fromkeys(names))
    assert found.undetermined == () and found.success
    for name in names:
        error = found.standard_errors[name]
        assert abs(found.values[name] - true[name]) < 4.5 * error, (name, found)
        assert error < 0.01 * max(abs(true[name]), 0.01)


def test_a_prior_decides_what_data_do_not() -> None:
    found = kp.fit(
        slider(k2=18.0, k=30.0), slider_data(5), {"k": None, "k2": None}, priors={"k2": (20, 0.1)}
    )
    assert found.undetermined == ()
    assert found.values["k2"] == pytest.approx(20, abs=1e-3)
    assert found.standard_errors["k2"] == pytest.approx(0.1, rel=1e-2)
    assert found.values["k"] == pytest.approx(30, abs=0.2)


@pytest.mark.parametrize("n", [1, 2, 3])
def test_errors_need_more_values_than_parameters(n: int) -> None:
    """A prior counts as a value; with a given sigma any number of values is enough."""
    names, remedy = dict.fromkeys(["k", "x0"]), "give sigma, or more values"
    start = slider(k=50.5, x0=0.11)
    for priors, rows in ((None, n), ({"x0": (0.1, 0.01)}, n + 1)):
        if rows < 2:
            continue
        found = kp.fit(start, slider_data(4, n=n), names, priors=priors)
        told = f"{rows} values for 2 parameters leave nothing from which errors follow: {remedy}"
        assert (told in found.remarks) == (rows == 2), found.remarks
        is_known = rows > 2
        assert np.isfinite(list(found.standard_errors.values())).tolist() == [is_known] * 2
        assert np.isfinite(found.sigma["guide.displacement"]) == is_known
    if n >= 2:
        data = slider_data(4, n=n)
        data = kp.Data(
            {"t": data.t["guide.displacement"], "x": data.values["guide.displacement"]},
            columns={"guide.displacement": "x"},
            sigma={"guide.displacement": 1e-4},
        )
        found = kp.fit(start, data, names)
        assert np.isfinite(list(found.standard_errors.values())).all()
        assert not [text for text in found.remarks if remedy in text]


def test_several_experiments_share_parameters() -> None:
    """With an added mass, mass and stiffness are determined, not only their ratio."""
    data = slider_data(1)
    heavy = slider(m2=1.0)
    times = np.linspace(0.05, 3.9, 60)
    exact = heavy.run()["dynamics"](times)["guide.displacement"]
    other = kp.Data({"t": times, "x": exact + 1e-4 * np.random.default_rng(2).normal(size=60)},
                    columns={"guide.displacement": "x"})  # fmt: skip
    free = dict.fromkeys(["m", "c", "k", "F"])
    assert kp.fit(slider(), data, free).undetermined
    found = kp.fit(slider(m=1.9), [({}, data), ({"m2": 1.0}, other)], free)
    assert found.undetermined == () and len(found.cases) == 2
    for name, value in SLIDER.items():
        assert abs(found.values[name] - value) < 4.5 * found.standard_errors[name], found
    assert len(found.residuals["guide.displacement"]) == 140
    assert found.cases[1].model.parameters["m2"] == 1.0


def test_outliers_and_robust_losses() -> None:
    table = film(0)
    table["phi [deg]"][::9] += 25.0
    plain = kp.fit(rod(), angle(table), ROD)
    found = kp.fit(rod(), angle(table), ROD, robust="cauchy")
    for name, value in TRUE.items():
        assert abs(found.values[name] - value) < 4.5 * found.standard_errors[name]
        assert found.standard_errors[name] < plain.standard_errors[name]


def test_a_model_that_lacks_something_is_told() -> None:
    found = kp.fit(rod(), angle(film(1)), {"J": (0, None), "rod.angle": None})  # no damping
    assert any("have structure" in text for text in found.remarks)
    found = kp.fit(rod(), angle(film(1), sigma={"rod.angle": "0.1 deg"}), ROD)
    assert any("does not explain the data" in text for text in found.remarks)
    found = kp.fit(rod(), angle(film(1)), {**ROD, "c": (0.003, 0.01)})
    assert any("c is at its bound 0.003" in text for text in found.remarks)
    assert found.intervals["c"][0] == 0.003


def test_a_motion_without_slopes_is_fitted_by_differences() -> None:
    """The steps of generalized-alpha have no slopes."""
    run = kp.Dynamics(t_end=4, method=kp.GeneralizedAlpha(step=2e-3))
    case = slider(k=48)._with(analyses=kp.Case(slider().model, None, [run]).analyses)
    found = kp.fit(case, slider_data(3), dict.fromkeys(["c", "k", "F"]))
    for name in ("c", "k", "F"):
        assert abs(found.values[name] - SLIDER[name]) < 4.5 * found.standard_errors[name], found
    assert found.undetermined == ()
