"""Fits whose data say less than they seem to: few values, several errors, values of zero."""

import kempe as kp
import numpy as np
import pytest
from sizes import FULL, count

TIMES = np.linspace(0.1, 4.9, 60)


def oscillator(**parameters: float) -> kp.Case:
    """A mass on a spring, whose motion is cos 2t with k = 4 N/m."""
    m = kp.Model("oscillator", parameters={"k": 4.0, "c": 0.0, "idle": 1.0, **parameters})
    m.ground.points(O=(0, 0))
    m.body("b", mass=1, inertia=1, points={"P": (0, 0)})
    m.translational("guide", "ground.O", "b.P")
    m.spring_damper("s", "ground.O", "b.P", stiffness="k", damping="c", free_length=0)
    run = kp.Dynamics(t_end=5, output_step=0.05)
    return kp.Case(m, {"set": {"b.x": 1.0, "b.vx": 0.0}}, [run])


def measured(noise: float, seed: int, t: np.ndarray = TIMES, **more: object) -> kp.Data:
    x = np.cos(2 * t) + noise * np.random.default_rng(seed).normal(size=len(t))
    return kp.Data({"t": t, "x": x}, columns={"b.x": "x"}, **more)  # type: ignore[arg-type]


def slope_of_k() -> np.ndarray:
    """The derivative of cos √k t by k, at k = 4."""
    return -TIMES / 4 * np.sin(2 * TIMES)


@pytest.mark.parametrize("order", [(0, 1), (1, 0)])
def test_experiments_have_their_own_sigma(order: tuple[int, int]) -> None:
    noises = [1e-3, 1e-1]
    pairs = [({}, measured(noises[k], k, sigma={"b.x": noises[k]})) for k in order]
    found = kp.fit(oscillator(), pairs, {"k": (0, None)})
    weight = sum(slope_of_k() @ slope_of_k() / noise**2 for noise in noises)
    assert found.standard_errors["k"] == pytest.approx(weight**-0.5, rel=1e-3)
    assert abs(found.values["k"] - 4) < 4 * weight**-0.5
    assert found.remarks == ()
    assert found.sigma["b.x"] == pytest.approx(np.repeat([noises[k] for k in order], 60))
    kp.plot.fit(found)


def test_a_quantity_has_sigma_in_all_experiments_or_in_none() -> None:
    pairs = [({}, measured(0.01, 0, sigma={"b.x": 0.01})), ({}, measured(0.01, 1))]
    with pytest.raises(kp.ModelError, match=r"sigma: b\.x has .* in one experiment and none"):
        kp.fit(oscillator(), pairs, {"k": (0, None)})


def test_a_setting_that_is_fitted_is_refused() -> None:
    with pytest.raises(kp.ModelError, match=r"sets k to 9\.0, but the fit finds k"):
        kp.fit(oscillator(), [({"k": 9.0}, measured(0.01, 0))], {"k": (0, None)})


@pytest.mark.parametrize("n", [1, 2])
def test_no_errors_follow_from_as_many_values_as_parameters(n: int) -> None:
    data = measured(0.01, 0, TIMES[3 : 3 + n])
    found = kp.fit(oscillator(), data, {"k": (0, None), "b.x": (None, 2)})
    assert all(error == np.inf for error in found.standard_errors.values())
    assert dict(found.intervals) == {"k": (0, np.inf), "b.x": (-np.inf, 2)}
    assert np.isnan(found.sigma["b.x"]) and "give sigma" in found.remarks[-1]
    assert bool(found.undetermined) == (n == 1)
    known = kp.fit(oscillator(), measured(0.01, 0, TIMES[3:5], sigma={"b.x": 0.01}), {"k": None})
    assert np.isfinite(known.standard_errors["k"])


def test_a_value_of_zero_is_no_sign_of_no_effect() -> None:
    """The rate at the start and the damping are exactly zero, and are determined well."""
    exact = oscillator().run()["dynamics"](TIMES)["b.x"]
    data = kp.Data({"t": TIMES, "x": exact}, columns={"b.x": "x"}, sigma={"b.x": 1e-3})
    found = kp.fit(oscillator(), data, {"k": None, "b.vx": None, "c": None})
    assert found.undetermined == () and abs(found.values["b.vx"]) < 1e-12
    assert found.standard_errors["b.vx"] < 1e-3 and found.standard_errors["c"] < 1e-2
    found = kp.fit(oscillator(), data, {"k": None, "idle": None})
    assert found.undetermined == ("idle has no effect on the data",)


#: Functions of the error with and without outliers; each with one of both in the usual size.
ROBUST = [
    (robust, outliers)
    for k, robust in enumerate(("huber", "soft_l1", "cauchy", "arctan"))
    for n, outliers in enumerate((0.0, 0.1))
    if FULL or (k + n) % 2 == 0
]


@pytest.mark.parametrize(("robust", "outliers"), ROBUST)
def test_intervals_of_robust_fits(robust: str, outliers: float) -> None:
    """The truth is in 95 % of the intervals; the bound is that of four deviations of the share."""
    trials, inside, draw = count(30, 300), 0, np.random.default_rng(2)
    for _ in range(trials):
        x = np.cos(2 * TIMES) + 0.01 * draw.normal(size=60)
        x += np.where(draw.random(60) < outliers, 0.1 * draw.normal(size=60), 0)
        found = kp.fit(
            oscillator(), kp.Data({"t": TIMES, "x": x}, columns={"b.x": "x"}), {"k": (0, None)},
            robust=robust,
        )  # fmt: skip
        low, high = found.intervals["k"]
        inside += low <= 4 <= high
    share = 0.93
    assert inside >= share * trials - 3.5 * np.sqrt(share * (1 - share) * trials)


@pytest.mark.parametrize("sigma", [0, -1, np.nan, np.inf, None, True, [0.1] * 60])
def test_a_standard_deviation_is_one_number(sigma: object) -> None:
    with pytest.raises(kp.ModelError, match=r"sigma\.b\.x: .*; must be > 0: one number"):
        measured(0.01, 0, sigma={"b.x": sigma})


@pytest.mark.parametrize("prior", [("a", "b"), (np.nan, 1), (4, 0), (4, np.inf), 4, (1, 2, 3)])
def test_a_prior_is_a_mean_and_a_deviation(prior: object) -> None:
    with pytest.raises(kp.ModelError, match=r"priors\.k: .*; must be \(mean, standard dev"):
        kp.fit(oscillator(), measured(0.01, 0), {"k": None}, priors={"k": prior})  # type: ignore[dict-item]


def test_a_header_that_two_columns_may_be() -> None:
    table = {"t": TIMES, "x [m]": TIMES, "x [mm]": TIMES}
    with pytest.raises(kp.ModelError, match=r"'x' may be 'x \[m\]' or 'x \[mm\]'"):
        kp.Data(table, columns={"b.x": "x"})
