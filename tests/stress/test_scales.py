"""Random mechanisms have the same motion at every length scale.

All lengths have a factor 2^-30, about 1e-9, which scales binary numbers exactly. Masses and times
stay. Gravity, free lengths, rods and points have the factor, inertia and torques its square.
"""

import copy
from typing import Any

import kempe as kp
import numpy as np
import pytest
from sizes import count
from stress.mechanisms import KINDS

SCALE = 2.0**-30
#: Fields with a factor of SCALE to this power.
POWERS = {"length": 1, "free_length": 1, "inertia": 2, "torque": 2}
TURNING = {"stiffness": 2, "damping": 2}
#: Runs end after so many steps, at both scales.
STEPS = 500


def shrunk(tree: dict[str, Any]) -> dict[str, Any]:
    """The model of a case with all lengths times SCALE."""
    tree = copy.deepcopy(tree)
    entries = [e for part in ("bodies", "joints", "forces") for e in tree.get(part, {}).values()]
    for entry in entries:
        powers = POWERS | (TURNING if entry.get("type") == "torsion_spring" else {})
        for key in powers.keys() & entry.keys():
            entry[key] *= SCALE ** powers[key]
        for name, point in entry.get("points", {}).items():
            entry["points"][name] = [float(x) * SCALE for x in point]
    tree["gravity"] = [float(g) * SCALE for g in tree.get("gravity", (0, 0))]
    return tree


def placed(given: dict[str, float]) -> dict[str, float]:
    lengths = {".x", ".y"}
    return {key: x * (SCALE if key[-2:] in lengths else 1.0) for key, x in given.items()}


def outcome(model: kp.Model, held: dict[str, float], guess: dict[str, float], t_end: float) -> Any:
    """The solution, the part before a failure, or the class of the error without any."""
    try:
        start = kp.assemble(model, held, guess)
        return kp.dynamics(model, start, t_end=t_end, method=kp.DOP853(), max_steps=STEPS)
    except kp.KempeError as error:
        return getattr(error, "solution", None) or type(error)


@pytest.mark.filterwarnings("ignore::kempe.AssemblyWarning")
@pytest.mark.parametrize("seed", range(count(20, 60)))
def test_the_motion_is_the_same_at_a_billionth_of_the_size(seed: int) -> None:
    random = np.random.default_rng(seed)
    drawn = list(KINDS.values())[seed % len(KINDS)](random)
    t_end = float(10 ** random.uniform(-2, 0.5))
    metre = outcome(drawn.model, drawn.set, drawn.guess, t_end)
    small = kp.Model.from_tree(shrunk(drawn.model.tree()))
    nanometre = outcome(small, placed(drawn.set), placed(drawn.guess), t_end)
    if isinstance(metre, type):
        assert nanometre is metre
        return
    assert isinstance(nanometre, kp.Solution)
    lengths = np.array([not name.endswith(".angle") for name in metre.model.column_names()])
    scale = np.where(lengths, SCALE, 1.0)
    last = min(metre.t[-1], nanometre.t[-1])
    if last == 0.0:  # at rest in a singular position, where rounding errors decide
        assert "singular position" in metre.message + nanometre.message
        return
    assert last > 0.99 * max(metre.t[-1], nanometre.t[-1])
    common = np.linspace(0, last, 100)
    off = np.abs(nanometre(common).q / scale - metre(common).q)
    assert off.max() < 1e-4 * max(1.0, np.abs(metre.q).max())
    worst = [np.abs(solution.energy.balance).max() for solution in (metre, nanometre)]
    assert worst[1] < 3 * worst[0] + 1e-5
