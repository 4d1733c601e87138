"""Designs: their values, their distributions, and errors with a remedy."""

import sys
from typing import Any

import kempe as kp
import numpy as np
import pytest
from kempe.sweeps import design
from kempe.sweeps.variables import read_variables
from sweeps.conftest import flagship

CASE = flagship()


def rows(variables: dict, kind: str, n: int | None = None, seed: int | None = None) -> np.ndarray:
    return design.rows(read_variables(CASE, variables), kind, n, seed)


def test_a_grid_has_every_pair_and_its_last_variable_changes_fastest() -> None:
    found = rows({"L2": [1, 2], "k": {"from": 10, "to": 1000, "n": 3, "scale": "log"}}, "grid")
    expected = [[1, 10], [1, 100], [1, 1000], [2, 10], [2, 100], [2, 1000]]
    np.testing.assert_allclose(found, expected, rtol=1e-14)


def test_paired_lists_go_together() -> None:
    found = rows({"L2": [1, 2], "crank.omega": [3, 4]}, "paired")
    np.testing.assert_array_equal(found, [[1, 3], [2, 4]])


@pytest.mark.parametrize("kind", ["random", "latin", "sobol"])
def test_distributions_have_their_moments(kind: str) -> None:
    given = {
        "L2": {"normal": [26, 0.05]},
        "L1": {"uniform": [9, 11]},
        "k": {"from": 1e4, "to": 1e6, "scale": "log"},
        "c": [1, 2],
    }
    found = rows(given, kind, 4096, 3)
    np.testing.assert_allclose(found[:, 0].mean(), 26, atol=3e-3)
    np.testing.assert_allclose(found[:, 0].std(), 0.05, rtol=0.04)
    assert found[:, 1].min() >= 9 and found[:, 1].max() <= 11
    np.testing.assert_allclose(found[:, 1].std(), 2 / np.sqrt(12), rtol=0.03)
    np.testing.assert_allclose(np.log10(found[:, 2]).mean(), 5, atol=0.03)
    np.testing.assert_allclose((found[:, 3] == 2).mean(), 0.5, atol=0.03)


@pytest.mark.parametrize(
    ("values", "least", "middle", "largest"),
    [
        ({"uniform": [2.0, 5.0]}, 2.0, 3.5, 5.0),
        ({"from": 8.0, "to": 2.0}, 8.0, 5.0, 2.0),
        ({"from": 1.0, "to": 100.0, "scale": "log"}, 1.0, 10.0, 100.0),
        ({"from": -4.0, "to": -1.0, "scale": "log"}, -4.0, -2.0, -1.0),
        ([3.0, 1.0, 2.0], 3.0, 1.0, 2.0),
        # 2^-53 of all values lie more than 8.2095 standard deviations beyond the mean
        ({"normal": [26.0, 0.5]}, 26 - 8.20953615160139 / 2, 26.0, 26 + 8.20953615160139 / 2),
    ],
)
def test_values_at_the_ends_and_in_the_middle(
    values: Any, least: float, middle: float, largest: float
) -> None:
    (one,) = read_variables(CASE, {"L2": values})
    found = one.at(np.array([0.0, 0.5, 1.0]))
    np.testing.assert_allclose(found, [least, middle, largest], rtol=1e-13)
    assert not one.of_start and one.is_log == ("scale" in values)


def test_a_latin_hypercube_has_one_point_in_each_stratum() -> None:
    found = rows({"L2": {"uniform": [0, 1]}, "L1": {"uniform": [0, 1]}}, "latin", 50)
    for column in found.T:
        np.testing.assert_array_equal(np.sort((column * 50).astype(int)), np.arange(50))


def test_a_sobol_design_is_a_net() -> None:
    """Each quarter of the square has the same number of points, and each strip of 1/64."""
    found = rows({"L2": {"uniform": [0, 1]}, "L1": {"uniform": [0, 1]}}, "sobol", 64)
    boxes = (found * 2).astype(int)
    assert np.bincount(2 * boxes[:, 0] + boxes[:, 1]).tolist() == [16] * 4
    np.testing.assert_array_equal(np.sort((found[:, 0] * 64).astype(int)), np.arange(64))


@pytest.mark.parametrize("kind", ["random", "latin", "sobol"])
def test_a_seed_repeats_a_design(kind: str) -> None:
    given = {"L2": {"uniform": [0, 1]}}
    np.testing.assert_array_equal(rows(given, kind, 8, 5), rows(given, kind, 8, 5))
    assert (rows(given, kind, 8, 5) != rows(given, kind, 8, 6)).any()


@pytest.mark.parametrize(
    ("variables", "options", "message"),
    [
        ({"L3x": [1]}, {}, "unknown variable 'L3x'; did you mean 'L3'"),
        ({"crank.foo": [1]}, {}, "crank.foo|coordinate"),
        ({"L2": []}, {}, "the list is empty"),
        ({"L2": ["a"]}, {}, "SI units"),
        ({"L2": {"form": 1, "to": 2}}, {}, "is none of"),
        ({"L2": {"from": -1, "to": 2, "n": 3, "scale": "log"}}, {}, "one sign"),
        ({"L2": {"from": 1, "to": 2, "n": 1}}, {}, "from 2 to"),
        ({"L2": {"normal": [1, 0]}}, {}, "must be > 0"),
        ({"L2": {"normal": [26, 1]}}, {}, 'use design="random"'),
        ({"L2": [1, 2], "k": [1]}, {"design": "paired"}, "L2 2, k 1"),
        ({"L2": [1]}, {"design": "random"}, "n=1000"),
        ({"L2": [1]}, {"design": "sobol", "n": 100}, "use n=128"),
        ({"L2": [1]}, {"n": 100}, "leave n out"),
        ({"L2": [1]}, {"design": "gird"}, "did you mean 'grid'"),
        ({"L2": [1]}, {"design": "random", "n": 4, "seed": -1}, "at least 0"),
        ({"L2": [1]}, {"workers": 0}, "workers"),
        ({"L2": [1]}, {"analysis": "releas"}, "did you mean 'release'"),
        ({}, {}, "no variables"),
    ],
)
def test_faults_are_named_with_a_remedy(variables: dict, options: dict, message: str) -> None:
    with pytest.raises(kp.ModelError, match=message):
        kp.sweep(CASE, variables, ["pin.max"], **options)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("pin.mx", "did you mean 'max'"),
        ("pin", "write pin.max"),
        ("C.fource.max", "did you mean"),
    ],
)
def test_faulty_measures_are_named(text: str, message: str) -> None:
    with pytest.raises(kp.ModelError, match=message):
        kp.sweep(CASE, {"k": [1e6]}, [text])


def test_without_scipy_the_remedy_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in [name for name in sys.modules if name.split(".")[0] == "scipy"]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, "scipy", None)
    with pytest.raises(kp.ModelError, match="pip install scipy"):
        rows({"L2": {"uniform": [0, 1]}}, "latin", 8)
