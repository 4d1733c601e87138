"""Numbers around a sweep that no figure shows: time left, fingerprints and weights."""

import itertools
from types import SimpleNamespace
from typing import Any

import kempe as kp
import numpy as np
import pytest
from kempe.sweeps import plan as plans
from kempe.sweeps import table as tables
from kempe.sweeps.asked import asked_of, planned
from kempe.sweeps.contributions import contributions
from kempe.sweeps.plan import Block
from kempe.sweeps.variables import Variable

# --- time left ------------------------------------------------------------------------------------


@pytest.mark.parametrize("each", [1e-3, 1.0, 1e3])
@pytest.mark.parametrize("before", [0, 3])
def test_the_time_left_is_that_of_the_rows_left(
    each: float, before: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Each row takes the same time; rows of an earlier run took none of it."""
    now = [100.0]
    monkeypatch.setattr(tables, "monotonic", lambda: now[0])
    told: list[tuple[int, int, int, float]] = []
    kept = [(k, np.zeros(1), "", np.zeros(1, np.uint8)) for k in range(before)]
    storage: Any = SimpleNamespace(read=lambda *_: iter(kept), add=lambda *_: None)
    table = tables.Table(10, 1, storage, lambda *numbers: told.append(numbers))
    table.tell()
    assert told[0][:3] == (before, 0, 10)
    assert np.isnan(told[0][3])
    for k in range(before, 10):
        now[0] += each
        table.add(
            np.array([k]),
            Block(np.ones((1, 1)), ["why"] if k == 9 else [""], np.zeros((1, 1), np.uint8)),
        )
        done, failed, total, left = told[-1]
        assert (done, failed, total) == (k + 1, int(k == 9), 10)
        assert left == pytest.approx(each * (9 - k), abs=1e-9 * each)


# --- fingerprints ---------------------------------------------------------------------------------


def fingerprint(
    case: kp.Case, given: dict[str, list[float]], texts: list[str], analysis: str | None = None
) -> str:
    plan, known = planned(case, asked_of(case, given, texts, None, None, None, analysis))
    rows = np.column_stack([variable.levels for variable in known])
    return plan.key_of(rows)


def test_a_fingerprint_depends_on_all_that_determines_the_rows(
    case: kp.Case, monkeypatch: pytest.MonkeyPatch
) -> None:
    given, texts = {"k": [1e6, 2e6], "c": [1e4, 2e4]}, ["pin.max", "lean.final"]
    other = kp.Case(case.model, case._start, {**case.analyses, "more": case.analyses["release"]})
    stiff = case.with_parameters({"L2": 26.5})
    found = [
        fingerprint(case, given, texts),
        fingerprint(case, {"k": [1e6, 2e6 * (1 + 1e-15)], "c": [1e4, 2e4]}, texts),
        fingerprint(case, {"k": [2e6, 1e6], "c": [2e4, 1e4]}, texts),
        fingerprint(case, {"c": [1e6, 2e6], "k": [1e4, 2e4]}, texts),
        fingerprint(case, given, texts[::-1]),
        fingerprint(case, given, ["pin.max", "lean.max"]),
        fingerprint(stiff, given, texts),
        fingerprint(other, given, texts),
        fingerprint(other, given, texts, "release"),
        fingerprint(case.with_start({"crank.omega": 1e-9}), given, texts),
    ]
    for name, value in (("__version__", "0.0.0+other"), ("FORMAT", -1)):
        with monkeypatch.context() as patch:
            patch.setattr(plans, name, value)
            found.append(fingerprint(case, given, texts))
    assert fingerprint(case, given, texts) == found[0]
    alike = {(found.index(key), k) for k, key in enumerate(found) if found.index(key) != k}
    assert alike == {(0, 8)}, "only the sweep of the same analysis has the same fingerprint"


# --- weights of groups ----------------------------------------------------------------------------


def result_of(columns: dict[str, list[float]], levels: dict[str, Any], failed: set[int]) -> Any:
    """A result with these columns; variables with levels None have a distribution."""

    found = _Found({name: np.array(values, float) for name, values in columns.items()})
    found.variables = [Variable(name, of, None, "list") for name, of in levels.items()]
    found.succeeded = np.array([k not in failed for k in range(len(columns["y"]))])
    return found


class _Found(dict[str, Any]):
    variables: Any
    succeeded: Any


def ratio(values: np.ndarray, of: np.ndarray) -> float:
    """The correlation ratio by the decomposition of the sum of squares within groups."""
    within = sum(
        float(((values[of == level] - values[of == level].mean()) ** 2).sum())
        for level in np.unique(of)
    )
    return 1.0 - within / float(((values - values.mean()) ** 2).sum())


@pytest.mark.parametrize("scale", [1e-3, 1.0, 1e3])
def test_groups_count_by_their_sizes(scale: float) -> None:
    random = np.random.default_rng(4)
    a = np.repeat([1.0, 2.0, 5.0], [40, 7, 3])  # unequal groups
    b = random.integers(0, 4, 50).astype(float)
    y = scale * (a**2 + 3.0 * b + random.normal(size=50))
    failed = {0, 41, 49}
    kept = [k for k in range(50) if k not in failed]
    y[41] = np.nan
    found = contributions(
        result_of(
            {"a": a, "b": b, "y": y}, {"a": (1.0, 2.0, 5.0), "b": (0.0, 1.0, 2.0, 3.0)}, failed
        ),
        "y",
    )
    for name, column in (("a", a), ("b", b)):
        assert found[name] == pytest.approx(ratio(y[kept], column[kept]), abs=1e-12)


@pytest.mark.parametrize("count", [37, 100, 433])
def test_a_distribution_is_divided_into_groups_of_neighbours(count: int) -> None:
    random = np.random.default_rng(count)
    x = random.normal(size=count)
    y = np.exp(x)
    groups = max(1, min(20, count // 5))
    edges = [count * k / groups for k in range(groups + 1)]
    place = np.argsort(np.argsort(x))
    of = np.array([sum(p >= edge for edge in itertools.islice(edges, 1, None)) for p in place])
    found = contributions(result_of({"x": x, "y": y}, {"x": None}, set()), "y")
    assert found["x"] == pytest.approx(ratio(y, of), abs=1e-12)
