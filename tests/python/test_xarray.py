"""Solutions as data sets of xarray, and data frames with the time as index."""

import sys

import kempe as kp
import numpy as np
import pytest
from python.test_reaction_frames import door


def solution() -> kp.Solution:
    m = kp.Model("pendulum", gravity=(0, -9.81))
    m.ground.points(O=(0, 0))
    m.bar("rod", mass=1, length=1, ends=("A", "B"))
    m.revolute("A", "ground.O", "rod.A")
    return kp.dynamics(m, kp.assemble(m, {"rod.angle": 0.1}), t_end=1, output_step=0.1)


def test_a_data_set_has_the_columns_of_the_data_frame() -> None:
    pytest.importorskip("xarray", reason="the package xarray is missing")
    sol = solution()
    found, frame = sol.to_xarray(), sol.to_dataframe()
    assert found.attrs["title"] == "pendulum"
    assert ["t", *found.data_vars] == list(frame.columns)
    np.testing.assert_array_equal(found["t"], sol.t)
    for name in found.data_vars:
        np.testing.assert_array_equal(found[name], frame[name])
        assert found[name].dims == ("t",)
        assert found[name].attrs.get("units", "") == frame.attrs["units"][name]
    inside = found["rod.angle"].interp(t=0.55)
    assert float(inside) == pytest.approx(float(sol(0.55)["rod.angle"]), abs=2e-2)  # linear
    with kp.units("deg"):
        assert sol.to_xarray()["rod.angle"].attrs["units"] == "deg"
        np.testing.assert_allclose(sol.to_xarray()["rod.angle"], np.degrees(sol["rod.angle"]))


def test_columns_have_remarks_where_there_are_some() -> None:
    """The slides of a door share its weight; forces over an angle contain what the motion has."""
    pytest.importorskip("xarray", reason="the package xarray is missing")
    sol, still = door(), solution()
    over = kp.kinematics(still.model, still.initial, over="rod.angle", range=(0, 1), n=5)
    for one, shared, is_over in ((sol, {"low", "high"}, False), (over, set(), True)):
        frame, found = one.to_dataframe(), one.to_xarray()
        choices, conditions = frame.attrs["choices"], frame.attrs["conditions"]
        assert {name.split(".")[0] for name in choices} == shared
        assert set(choices.values()) <= {"minimum norm"}
        forces = {n for n, unit in frame.attrs["units"].items() if unit in ("N", "N*m")}
        assert forces and set(conditions) == (forces if is_over else set())
        assert all(conditions.values())
        for name in found.data_vars:
            told = found[name].attrs
            assert told.get("choice") == choices.get(name)
            assert told.get("condition") == conditions.get(name)
            assert "" not in told.values()


def test_the_time_can_be_the_index() -> None:
    pytest.importorskip("pandas", reason="the package pandas is missing")
    sol = solution()
    frame = sol.to_dataframe(index=True)
    assert frame.index.name == "t" and "t" not in frame.columns
    np.testing.assert_array_equal(frame.index, sol.t)
    assert frame.attrs == sol.to_dataframe().attrs
    over = kp.kinematics(sol.model, sol.initial, over="rod.angle", range=(0, 1), n=5)
    assert over.to_dataframe(index=True).index.name == "rod.angle"


def test_without_xarray_the_remedy_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "xarray", None)
    with pytest.raises(kp.ModelError, match=r"pip install 'kempe\[xarray\]'"):
        solution().to_xarray()
