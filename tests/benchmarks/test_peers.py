"""Every available adapter computes the motion of the problem; the others give a reason."""

from dataclasses import replace
from types import ModuleType

import numpy as np
import peers
import pytest
from peers import kempe_itself, numpy_scipy
from peers.setting import Setting
from problems import problem
from problems.planar import Problem
from problems.truth import reference

#: Error, at the coarsest setting of each tool over the first tenths of a second.
BOUND = 2e-2


def short(name: str) -> Problem:
    told = problem(name)
    rows = 11
    return replace(told, t_end=(rows - 1) * told.output_step)


def error_of_windows(tool: ModuleType, setting: Setting) -> float:
    told = short("n_four_bar_2")
    motion = tool.motion(told, tool.prepare(told, setting)())
    assert motion.q.shape == (len(motion.t), 5, 3)
    assert told.gap(motion) < 1e-2
    return told.error(motion)


@pytest.mark.parametrize("tool", peers.tools(), ids=lambda tool: tool.NAME)
def test_a_tool_finds_the_motion_of_two_windows(tool: ModuleType) -> None:
    if why := tool.missing():
        pytest.skip(why)
    if tool.NAME == "numba":
        pytest.skip("compiles for ten seconds; python benchmarks/run.py --tools numba runs it")
    assert error_of_windows(tool, tool.settings(problem("n_four_bar_2"), quick=True)[0]) < BOUND


@pytest.mark.parametrize("name", ["flagship", "andrews", "n_four_bar_2"])
def test_kempe_and_the_plain_program_agree(name: str) -> None:
    told = short(name)
    found = []
    for tool, curve in (
        (kempe_itself, kempe_itself.PROJECTION),
        (numpy_scipy, "scipy DOP853, Baumgarte"),
    ):
        setting = next(s for s in tool.settings(told) if s.curve == curve and s.tolerance == 1e-9)
        found.append(tool.motion(told, tool.prepare(told, setting)()))
    assert np.abs(found[0].q - found[1].q).max() < 1e-8


def test_the_plain_program_solves_the_equations_of_motion() -> None:
    equations = numpy_scipy.Equations(problem("flagship"))
    for state in (reference("four_bar")["start"], *reference("four_bar")["states"]):
        found = equations.solve(np.array(state["q"]), np.array(state["v"]))
        expected = np.concatenate([state["a"], state["lam"]])
        assert np.abs(found - expected).max() < 1e-10 * 3e4


def test_an_unknown_tool_is_refused() -> None:
    with pytest.raises(SystemExit, match=r"unknown tools: mujco; there are \['casadi'"):
        peers.tools(["mujco"])


def test_an_unknown_problem_is_refused() -> None:
    with pytest.raises(SystemExit, match="unknown problem 'n_four_bar_3'"):
        problem("n_four_bar_3")
