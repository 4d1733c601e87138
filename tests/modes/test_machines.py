"""Linear equations of the examples against differences of their nonlinear equations of motion."""

import warnings
from collections.abc import Iterator

import kempe as kp
import numpy as np
import pytest
from house.places import ROOT

#: Machines that are not driven.
MACHINES = (
    "engine",
    "four_bar",
    "garage_door",
    "motor_press",
    "planetary_gear",
    "slider_crank",
    "squeezer",
)
STEP = 1e-5


def neighbours(found: kp.ModesResult, model: kp.Model) -> Iterator[tuple[kp.State, kp.State]]:
    """States on both sides in the direction of each component of x."""
    at, names = found.state, found.state_names
    compiled, moving = at.compiled, 2 * len(found.coordinates)
    columns, rates = compiled.column_names(), compiled.rate_names()
    known = dict(zip([*columns, *rates], [*at.q, *at.v], strict=True))
    own = [compiled.state_names().index(name) for name in names[moving:]]
    x = np.array([*(known[name] for name in names[:moving]), *at.z[own]])
    guess = {name: known[name] for name in columns if name not in found.coordinates}

    def beside(k: int, step: float) -> kp.State:
        moved = x + step * (np.arange(len(x)) == k)
        held = dict(zip(names[:moving], moved[:moving], strict=True))
        closed = kp.assemble(model, set=held, guess=guess, t=at.t)
        z = np.array(at.z)
        z[own] = moved[moving:]
        return kp.State(compiled, at.t, closed.q, closed.v, z=z)

    for k in range(len(x)):
        yield beside(k, STEP), beside(k, -STEP)


def agree(model: kp.Model, state: kp.State) -> None:
    compiled = state.compiled
    joints = [f"{name}.{part}" for name in compiled.joints for part in ("fx", "fy", "torque")]
    bodies = [f"{name}.{part}" for name in compiled.bodies for part in ("ax", "vy")]
    outputs = [*joints, *bodies, "energy.kinetic", "energy.potential"]
    found = kp.modes(model, state, outputs=outputs)
    f = len(found.coordinates)
    columns = [compiled.column_names().index(name) for name in found.coordinates]
    pairs = list(neighbours(found, model))
    rows = np.array([(a.a[columns] - b.a[columns]) / (2 * STEP) for a, b in pairs]).T
    np.testing.assert_allclose(found.A[f : 2 * f], rows, atol=1e-6 * np.abs(rows).max())
    seen = kp.modes  # outputs beside the state, as values of the same analysis
    values = [[seen(model, s, outputs=outputs).values for s in pair] for pair in pairs]
    slopes = np.array([(a - b) / (2 * STEP) for a, b in values]).T
    for name, own, expected in zip(outputs, found.C, slopes, strict=True):
        size = np.abs(slopes).max()
        np.testing.assert_allclose(own, expected, atol=1e-6 * size, err_msg=name)


@pytest.mark.parametrize("name", MACHINES)
def test_a_machine_at_rest_and_in_motion(name: str) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", kp.AssemblyWarning)
        case = kp.load(ROOT / "examples" / f"{name}.toml")
        agree(case.model, case.start())
        _, sol = next(case.each())
        agree(case.model, sol(float(sol.t[0] + 0.37 * (sol.t[-1] - sol.t[0]))))


def test_a_mechanism_without_freedom() -> None:
    case = kp.load(ROOT / "examples" / "quick_return.toml")
    found = kp.modes(case.model, case.start(), outputs=["energy.kinetic"])
    assert found.eigenvalues.shape == (0,)
    assert found.shapes.shape == (0, case.start().compiled.n_q)
    assert found.values.shape == (1,)
    assert "drivers hold all coordinates" in str(found)
