"""Classic redundancies: all joints are named, and the remedies leave the motion unchanged."""

from functools import cache

import kempe as kp
import numpy as np
import pytest
from kempe.analyses.mobility import MobilityResult
from redundant.pinned import PINNED, Redundant
from redundant.remedied import without
from redundant.wheels import WHEELS

from examples.n_four_bar import upright, windows

CLASSICS = PINNED | WHEELS
METHOD = kp.DOP853(rtol=1e-13, atol=1e-15)


@cache
def found(name: str) -> tuple[Redundant, kp.State, MobilityResult]:
    one = CLASSICS[name]()
    start = kp.assemble(one.model, set=one.start, guess=one.guess, redundancy="allow")
    return one, start, kp.mobility(one.model, start)


@cache
def motion(name: str) -> kp.Solution:
    one, start, _ = found(name)
    return kp.dynamics(one.model, start, t_end=0.4, output_step=0.05, method=METHOD)


def test_there_are_twenty() -> None:
    assert len(CLASSICS) >= 20


@pytest.mark.parametrize("name", CLASSICS)
def test_found_with_all_joints(name: str) -> None:
    one, start, mobility = found(name)
    assert len(mobility.redundant) == one.count
    assert {joint for each in mobility.redundant for joint in each.joints} == one.joints
    assert not mobility.singular
    assert all(each.consistent and not each.kind for each in mobility.redundant)
    matrix = start.matrices().Phi_q
    assert mobility.rank == np.linalg.matrix_rank(matrix) == len(matrix) - one.count
    # what is named is what a left null vector of the whole matrix needs
    null = np.linalg.svd(matrix.T)[2][mobility.rank :]
    rows = list(one.model.compile().row_names())
    needed = {rows[k].rpartition(".")[0] for k in np.flatnonzero(np.abs(null).max(axis=0) > 1e-9)}
    assert needed == one.joints
    with pytest.raises(kp.RedundancyError) as caught:
        kp.assemble(one.model, set=one.start, guess=one.guess)
    assert all(joint in str(caught.value) for joint in one.joints)


@pytest.mark.parametrize("name", CLASSICS)
def test_reactions_that_are_not_unique_are_marked(name: str) -> None:
    one, start, _ = found(name)
    for joint in start.compiled.constraints:
        assert start[joint].unique == (joint not in one.joints), joint
        assert motion(name)[joint].unique == (joint not in one.joints), joint


@pytest.mark.parametrize("name", CLASSICS)
def test_the_multipliers_are_the_smallest_that_balance(name: str) -> None:
    _, start, mobility = found(name)
    sol = motion(name)
    for state in (start, sol(0.0), sol(0.2), sol(0.4)):
        # any left null vector could be added
        null = np.linalg.svd(state.matrices().Phi_q.T)[2][mobility.rank :]
        assert np.abs(null @ state.lam).max() <= 1e-11 * np.abs(state.lam).max()


@pytest.mark.parametrize("name", CLASSICS)
def test_each_remedy_alone_leaves_the_motion_unchanged(name: str) -> None:
    one, start, mobility = found(name)
    for each in mobility.redundant:
        assert {remedy.joint for remedy in each.remedies} == set(each.joints)
        for remedy in each.remedies:
            if remedy.axis is None or remedy.body is not None:
                for equation in remedy.equations[: 1 if remedy.axis is not None else None]:
                    left = without(one.model, start, [(remedy, equation)])
                    compare(name, start, left, one.count - 1)


@pytest.mark.parametrize("name", CLASSICS)
def test_all_that_are_proposed_leave_nothing_redundant(name: str) -> None:
    one, start, mobility = found(name)
    chosen = [(each.example, each.remove) for each in mobility.redundant]
    compare(name, start, without(one.model, start, chosen), 0)


def compare(name: str, start: kp.State, model: kp.Model, left: int) -> None:
    """Compare the motion of a model with fewer joints."""
    held = {column: start[column] for column in start.compiled.column_names()}
    allow = "allow" if left else None
    begin = kp.assemble(model, guess=held, redundancy=allow)
    assert np.abs(begin.q - start.q).max() < 1e-11
    assert len(kp.mobility(model, begin).redundant) == left
    again = kp.dynamics(model, begin, t_end=0.4, output_step=0.05, method=METHOD)
    assert again.success
    assert np.abs(again.q - motion(name).q).max() < 1e-9
    assert np.abs(again.v - motion(name).v).max() < 1e-8
    if not left:
        assert all(again[joint].unique for joint in again.compiled.constraints)


def test_the_beam_is_advised_to_free_one_direction() -> None:
    one, _, mobility = found("beam on two pins")
    assert [str(each) for each in mobility.redundant[0].remedies] == ["A along x", "B along x"]
    assert "A along x, B along x; for example B as a pin in a slot of ground" in str(mobility)
    with pytest.raises(kp.RedundancyError, match="free one of A along x, B along x, or pass"):
        kp.assemble(one.model)


@pytest.mark.parametrize("cells", [1, 2, 5, 10])
def test_the_chain_of_four_bars_is_not_called_redundant(cells: int) -> None:
    made = windows(cells)
    assert not kp.mobility(made, upright(made, cells)).redundant
    # with all bars in line, each window has a freedom of its own
    flat = np.array([[k + 0.5, 0, 0] for k in range(cells + 1)]).ravel()
    level = np.array([[k + 1.5, 0, 0] for k in range(cells)]).ravel()
    q = np.concatenate([flat, level])
    found = kp.mobility(made, kp.State(made, 0, q, np.zeros_like(q)))
    assert not found.redundant
    assert [one.kind for one in found.singular] == ["change point"] * cells
    assert found.degrees_of_freedom == cells + 1
