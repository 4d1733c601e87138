"""Damaged cases through Python: load, save, load, assemble, run, save the solution.

    PYTHONPATH=tests python -m stress.fuzz --runs 100000 --processes 2

prints the stages that the inputs reach and every fault with its number. ``--only 4711`` repeats
one input. The exit code is 1 if there is a fault. ``CONTRIBUTING.md`` has the same run of the core.
"""

import copy
import json
import sys
import tempfile
import time
import warnings
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import Any

import kempe as kp
import numpy as np
from house.places import ROOT
from stress import command
from stress.mechanisms import KINDS, Random, chance
from stress.trial import finite

#: Largest CPU time of one input, s.
PATIENCE = 10.0
#: Largest number of steps of a run.
STEPS = 200
EXAMPLES = ("four_bar", "pendulum", "six_bar", "slider_crank")
STAGES = ("refused", "loaded", "assembled", "run")
#: Values in place of others.
VALUES: tuple[Any, ...] = (
    *(0, -1, 1e-300, 1e300, 5e-324, -0.0, 10**30, float("nan"), float("inf")),
    *(None, True, "", "k", "2*t", "1/0", "sqrt(-1)", "crank.angle", "\u202e", "é" * 300, "=1+1"),
    *([], [0, 0], [1, [2, [3]]], {}, {"type": "revolute"}, {"": {"": 0}}),
)
KEYS = ("mass", "type", "t", "ground", "", "a.b", "é", "x" * 300, "\n", "set")


@dataclass
class Outcome:
    """The outcome of an input.

    Attributes:
        number: number of the input.
        reached: the last stage.
        message: message of the error.
        seconds: CPU time.
        faults: violations of the requirements.
    """

    number: int
    reached: str = "refused"
    message: str = ""
    seconds: float = 0.0
    faults: list[str] = field(default_factory=list)


@cache
def example(name: str) -> dict[str, Any]:
    return kp.load(ROOT / "examples" / f"{name}.toml").tree()


def places(tree: Any) -> Iterator[tuple[Any, Any]]:
    """All containers of a tree with their keys."""
    items = tree.items() if isinstance(tree, dict) else enumerate(tree)
    for key, value in list(items):
        yield tree, key
        if isinstance(value, (dict, list)):
            yield from places(value)


def damage(random: Random, tree: dict[str, Any]) -> None:
    """Change, remove, rename or exchange an entry, mostly a number."""
    found = list(places(tree))
    numbers = [(o, k) for o, k in found if isinstance(o[k], (int, float))]
    some = numbers if numbers and chance(random, 0.7) else found
    owner, key = some[random.integers(len(some))]
    kind = random.integers(6)
    if isinstance(owner[key], (int, float)) and chance(random, 0.7):
        owner[key] = float(random.uniform(-2, 4))
    elif kind <= 2:
        owner[key] = copy.deepcopy(VALUES[random.integers(len(VALUES))])
    elif kind == 3:
        del owner[key]
    elif kind == 4 and isinstance(owner, dict):
        owner[KEYS[random.integers(len(KEYS))]] = owner.pop(key)
    else:
        other, place = found[random.integers(len(found))]
        owner[key] = copy.deepcopy(other[place])


def tree(random: Random) -> dict[str, Any]:
    """An example or a random mechanism, mostly damaged."""
    if chance(random, 0.5):
        made = copy.deepcopy(example(str(random.choice(EXAMPLES))))
    else:
        drawn = KINDS[str(random.choice(list(KINDS)))](random)
        made = drawn.model.tree() | {"start": {"set": drawn.set, "guess": drawn.guess}}
        made["analyses"] = {"run": {"type": "dynamics", "t_end": 0.1}}
        made = json.loads(json.dumps(made))
    for entry in made["analyses"].values():
        entry |= {"max_steps": STEPS, "t_end": float(random.uniform(0.01, 0.5))}
    for _ in range(random.integers(0, 3)):
        damage(random, made)
    return made


def entries(case: kp.Case) -> Any:
    """The tree of a case as pairs of keys and values, in order."""
    return json.loads(json.dumps(case.tree()), object_pairs_hook=list)


def passage(outcome: Outcome, text: str, folder: Path) -> None:
    """Take a text through all stages."""
    path = folder / "case.json"
    path.write_text(text, "utf-8")
    case = kp.load(path)
    outcome.reached = "loaded"
    for name in ("again.toml", "again.json"):
        case.save(folder / name)
        if entries(kp.load(folder / name)) != entries(case):
            outcome.faults.append(f"{name} is read back differently")
    state = case.start()
    outcome.reached = "assembled"
    if not (np.isfinite(state.q).all() and np.isfinite(state.v).all()):
        outcome.faults.append("assembled with numbers that are not finite")
    for name, sol in case.each(start=state):
        if not finite(sol):
            outcome.faults.append(f"success of {name} with numbers that are not finite")
        sol.save(folder / "solution.npz")
        if not np.array_equal(kp.load_solution(folder / "solution.npz").q, sol.q):
            outcome.faults.append(f"the solution of {name} is read back differently")
    outcome.reached = "run"


def run(seed: int, number: int) -> Outcome:
    """The reproducible input with this number."""
    random = np.random.default_rng([seed, number])
    outcome = Outcome(number)
    begin = time.process_time()
    text = json.dumps(tree(random))
    with tempfile.TemporaryDirectory() as folder, warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            passage(outcome, text, Path(folder))
        except kp.InternalError as error:
            outcome.faults.append(str(error))
        except kp.KempeError as error:
            outcome.message = str(error).replace(folder, "")
            if not outcome.message.strip():
                outcome.faults.append("an error without a message")
        except Exception as error:
            outcome.faults.append(f"{type(error).__name__}: {error}")
    outcome.seconds = time.process_time() - begin
    if outcome.seconds > PATIENCE:
        outcome.faults.append(f"took {outcome.seconds:.1f} s")
    return outcome


def report(outcomes: list[Outcome]) -> None:
    """Print how many inputs each stage was the last of."""
    reached = Counter(o.reached for o in outcomes)
    command.say(", ".join(f"{stage} {reached[stage]}" for stage in STAGES))


def shown(seed: int, number: int) -> dict[str, Any]:
    return tree(np.random.default_rng([seed, number]))


def told(o: Outcome) -> str:
    return "; ".join(o.faults)


if __name__ == "__main__":
    sys.exit(command.main(__doc__ or "", run, report, told, shown))
