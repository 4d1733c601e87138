"""Tolerances by exact slopes, the yield, the worst case, and the cheapest tolerances."""

import kempe as kp
import numpy as np
import pytest
from scipy.optimize import minimize
from scipy.stats import norm


def rest(force: float = 4.0, stiffness: float = 50.0) -> kp.Case:
    """A mass on a spring under a force: it rests at F/k."""
    parameters = {"F": force, "k": stiffness, "idle": 1.0, "most": f"1.02*{force}/{stiffness}"}
    m = kp.Model("spring", parameters=parameters)
    m.ground.points(O=(0, 0))
    m.body("mass", mass=2, inertia=1, points={"P": (0, 0)})
    m.translational("guide", "ground.O", "mass.P")
    law = "F - k*guide.displacement"
    m.generalized_force("push", "guide.displacement", value=law)
    return kp.Case(m, None, [kp.Equilibrium()])


@pytest.mark.parametrize("scale", [1.0, 1e-6, 1e3])
def test_first_order_and_worst_case(scale: float) -> None:
    force, k, of_f, of_k = 4.0 * scale, 50.0, 0.04 * scale, 0.3
    found = kp.tolerances(rest(force), {"F": of_f, "k": of_k}, "mass.x", n=50)
    slopes = {"F": 1 / k, "k": -force / k**2}
    assert dict(found.slopes) == pytest.approx(slopes, rel=1e-12)  # differences have 1e-5
    assert found.first_order == pytest.approx(np.hypot(of_f / k, force / k**2 * of_k), rel=1e-12)
    worst = [(force + s * 3 * of_f) / (k - s * 3 * of_k) for s in (-1, 1)]
    assert list(found.worst_case) == pytest.approx(worst, rel=1e-12)
    assert np.isnan(found.yield_)


def test_yield() -> None:
    """The share of a normal distribution below a limit, with a formula and a parameter."""
    case, n = rest(), 1500
    ask = {"n": n, "seed": 5}
    found = kp.tolerances(case, {"F": 0.04}, "mass.x", subject_to="mass.x <= most", **ask)
    share = norm.cdf(2.0)  # 2 % are two standard deviations of 1 %
    assert abs(found.yield_ - share) < 4 * np.sqrt(share * (1 - share) / n)
    both = ["mass.x <= most", "mass.x >= 0.99*F/k + 0*most"]
    assert kp.tolerances(case, {"F": 0.04}, "mass.x", subject_to=both, **ask).yield_ == found.yield_
    none = kp.tolerances(case, {"F": 0.04}, "mass.x", subject_to="mass.x < 0*most", **ask)
    assert none.yield_ == 0.0
    with pytest.raises(kp.ModelError, match="must be a comparison"):
        kp.tolerances(case, {"F": 0.04}, "mass.x", subject_to="mass.x", **ask)


def sums(scale: float) -> tuple[kp.Case, dict[str, float]]:
    """A mass that rests at a weighted sum of three forces over k, and the weights over k."""
    weights = {"F": 1.0, "G": -0.3, "H": 5.0}
    parameters = dict.fromkeys(weights, 0.8 * scale) | {"zero": 0.0}
    m = kp.Model("sum", parameters=parameters)
    m.ground.points(O=(0, 0))
    m.body("mass", mass=2, inertia=1, points={"P": (0, 0)})
    m.translational("guide", "ground.O", "mass.P")
    total = " + ".join(f"({x})*{name}" for name, x in weights.items())
    m.generalized_force("push", "guide.displacement", value=f"{total} - 50*guide.displacement")
    case = kp.Case(m, None, [kp.Equilibrium()])
    return case, {name: x / 50 for name, x in weights.items()}


@pytest.mark.parametrize("scale", [1.0, 1e-6, 20.0])
def test_yield_of_a_linear_measure_between_two_limits(scale: float) -> None:
    """A sum of normal distributions is normal; the limits are at -1.2 and +0.7 deviations."""
    case, slopes = sums(scale)
    widths, n = {"F": 0.1 * scale, "G": 0.2 * scale, "H": 0.02 * scale}, 1500
    nominal = 0.8 * scale * sum(slopes.values())
    spread = np.sqrt(sum((slopes[name] * x) ** 2 for name, x in widths.items()))
    limits = [f"mass.x >= {nominal - 1.2 * spread}", f"mass.x <= {nominal + 0.7 * spread}"]
    found = kp.tolerances(case, widths, "mass.x", n=n, seed=3, subject_to=limits)
    share = norm.cdf(0.7) - norm.cdf(-1.2)
    assert abs(found.yield_ - share) < 4 * np.sqrt(share * (1 - share) / n)
    assert found.first_order == pytest.approx(spread, rel=1e-9)
    assert found.deviation == pytest.approx(spread, rel=4 / np.sqrt(2 * n))
    assert found.mean == pytest.approx(nominal, abs=4 * spread / np.sqrt(n))


def test_variants_that_fail_satisfy_no_limit() -> None:
    m = kp.Model("dyad", gravity=(0, -9.81), parameters={"a": 0.5, "b": 0.52})
    m.ground.points(A=(0, 0), B=(1, 0))
    m.bar("one", mass=1, length="a", ends=("A", "C"))
    m.bar("two", mass=1, length="b", ends=("B", "C"))
    for name, i, j in (("A", "ground.A", "one.A"), ("B", "ground.B", "two.B")):
        m.revolute(name, i, j)
    m.revolute("C", "one.C", "two.C")
    guess = {"one.angle": 0.2, "two.angle": 2.9}
    case = kp.Case(m, {"guess": guess}, [kp.Equilibrium()])
    found = kp.tolerances(case, {"a": 0.01}, "one.C.y", n=400, subject_to="one.C.y >= 0", seed=1)
    assert found.yield_ == found.sample.succeeded.mean() < 0.99
    assert np.isnan(found.worst_case[0]) and found.worst_case[1] > found.nominal


def test_measures_without_slopes_keep_differences() -> None:
    """Steps of generalized-alpha have no slopes."""
    run = kp.Dynamics(t_end=0.5, method=kp.GeneralizedAlpha(step=1e-3))
    case = kp.Case(rest().model, {"set": {"guide.displacement": 0.1}}, [run])
    assert kp.gradient(case, ["mass.x.final"], ["F"]).remarks
    # x = F/k + (0.1 - F/k) cos √(k/m) t, at t = 0.5 s
    widths = {"F": 0.03, "k": 0.7}
    found = kp.tolerances(case, widths, "mass.x.final", n=10)
    by_k = -4 * (1 - np.cos(2.5)) / 50**2 - 0.02 * np.sin(2.5) * 0.5 / (2 * np.sqrt(50 * 2))
    assert found.slopes["F"] == pytest.approx((1 - np.cos(2.5)) / 50, rel=1e-4)
    assert found.slopes["k"] == pytest.approx(by_k, rel=1e-3)
    parts = {name: (found.slopes[name] * width) ** 2 for name, width in widths.items()}
    for name, part in parts.items():
        assert found.contributions[name] == pytest.approx(part / sum(parts.values()), rel=1e-9)


@pytest.mark.parametrize("limit", [0.085, 0.07])
def test_the_cheapest_tolerances(limit: float) -> None:
    costs = {"F": 0.02, "k": 1.5, "idle": 2.0}
    found = kp.allocate(rest(), "mass.x", limit, costs)
    slopes = np.array([1 / 50, -4 / 50**2])
    prices = np.array([0.02, 1.5])

    def cost(log: np.ndarray) -> float:
        return float((prices / np.exp(log)).sum())

    def room(log: np.ndarray) -> float:
        return float(abs(limit - 0.08) - 3 * np.linalg.norm(slopes * np.exp(log)))

    start = np.log([0.01, 0.1])
    best = minimize(
        cost, start, constraints={"type": "ineq", "fun": lambda x: 1e3 * room(x)}, tol=1e-12
    )
    sigma = [found.deviations["F"], found.deviations["k"]]
    assert sigma == pytest.approx(np.exp(best.x), rel=1e-4)
    assert found.cost == pytest.approx(best.fun, rel=1e-6) and found.deviations["idle"] == np.inf
    spread = np.linalg.norm(slopes * sigma)
    assert 3 * spread == pytest.approx(abs(limit - found.nominal), rel=1e-12)


@pytest.mark.parametrize("scale", [1.0, 1e-6, 20.0])
@pytest.mark.parametrize("side", [-0.05, 0.02])
def test_the_cheapest_tolerances_of_a_linear_measure(scale: float, side: float) -> None:
    """By Lagrange: the least Σ c/σ is 3/room · (Σ (c s)^⅔)^1.5, with slopes s; σ³ ∝ c/s²."""
    case, slopes = sums(scale)
    costs = {"F": 0.02 * scale, "G": 1.5, "H": 40.0 * scale}
    nominal = 0.8 * scale * sum(slopes.values())
    found = kp.allocate(case, "mass.x", nominal + side * scale, {**costs, "zero": 1.0})
    s, c = np.array(list(slopes.values())), np.array(list(costs.values()))
    total = (np.abs(c * s) ** (2 / 3)).sum()
    assert found.cost == pytest.approx(3 / abs(side * scale) * total**1.5, rel=1e-9)
    sigma = np.cbrt(c / s**2) * abs(side * scale) / 3 / np.sqrt(total)
    assert [found.deviations[name] for name in slopes] == pytest.approx(sigma, rel=1e-9)
    assert found.deviations["zero"] == np.inf
    kept = {name: found.deviations[name] for name in slopes}
    limit = f"mass.x {'<=' if side > 0 else '>='} {found.limit}"
    held = kp.tolerances(case, kept, "mass.x", n=1000, seed=7, subject_to=limit)
    assert abs(held.yield_ - norm.cdf(3)) < 4 * np.sqrt(norm.sf(3) / 1000)


@pytest.mark.parametrize(
    ("costs", "limit", "message"),
    [
        ({"F": 0}, 0.09, r"costs.F: 0; must be > 0"),
        ({"F": 1}, 0.08, "no tolerance is left"),
        ({"idle": 1}, 0.09, "does not depend on idle"),
        ({"G": 1}, 0.09, "unknown variable 'G'"),
    ],
)
def test_wrong_allocations(costs: dict[str, float], limit: float, message: str) -> None:
    with pytest.raises(kp.ModelError, match=message):
        kp.allocate(rest(), "mass.x", limit, costs)


@pytest.mark.parametrize("limit", [float("nan"), float("inf"), "1 m", None])
def test_an_allocation_needs_a_finite_limit(limit: object) -> None:
    with pytest.raises(kp.ModelError, match="limit: it is not a finite number"):
        kp.allocate(rest(), "mass.x", limit, {"k": 1.0})  # type: ignore[arg-type]


def test_sobol_indices_of_a_product() -> None:
    """f = a b² with independent normal variables; moments in closed form."""
    m = kp.Model("slide", parameters={"a": 1.0, "b": 1.0, "idle": 2.0})
    m.ground.points(O=(0, 0))
    m.body("slide", mass=1, inertia=1, points={"P": (0, 0)})
    m.translational("guide", "ground.O", "slide.P")
    m.generalized_force("spring", "guide.displacement", value="a*b^2 - guide.displacement")
    case = kp.Case(m, None, [kp.Equilibrium(name="rest")])
    sa, sb = 0.3, 0.4
    found = kp.tolerances(
        case, {"a": sa, "b": sb, "idle": 0.5}, "slide.x", n=64, seed=2, sobol=1024
    )
    square, fourth = 1 + sb**2, 1 + 6 * sb**2 + 3 * sb**4  # of b² and b⁴
    variance = (1 + sa**2) * fourth - square**2
    of_a, of_b = sa**2 * square**2, fourth - square**2
    exact = {
        "a": (of_a / variance, (variance - of_b) / variance),
        "b": (of_b / variance, (variance - of_a) / variance),
        "idle": (0.0, 0.0),
    }
    for name, (first, total) in exact.items():
        share = found.sobol[name]
        assert share.first == pytest.approx(first, abs=0.03)
        assert share.total == pytest.approx(total, abs=0.03)
        assert share.first_error < 0.15 and share.total_error < 0.1
    few = {"n": 8, "seed": 2, "sobol": 64}
    first, again = (kp.tolerances(case, {"a": sa, "b": sb}, "slide.x", **few) for _ in range(2))
    assert again.sobol == first.sobol
    assert not kp.tolerances(case, {"a": sa}, "slide.x", n=8).sobol
    with pytest.raises(kp.ModelError, match="sobol: 100; must be a power of two"):
        kp.tolerances(case, {"a": sa}, "slide.x", n=8, sobol=100)
