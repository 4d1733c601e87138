"""Hashes of all results of runs, for a bitwise comparison between processes.

PYTHONPATH=tests python -m stress.fingerprint
"""

import hashlib
import warnings

import kempe as kp
import numpy as np
from house.places import ROOT
from stress.mechanisms import KINDS
from stress.trial import options

METHODS = (kp.RK45(rtol=1e-8), kp.DOP853(rtol=1e-9), kp.RK4(step=1e-3))
STABILIZATIONS = (kp.Projection(), kp.Baumgarte(), None)
#: Random runs in addition to the examples.
DRAWN = 40


def tables(sol: kp.Solution) -> list[np.ndarray]:
    energy = sol.energy
    parts = (energy.kinetic, energy.potential, energy.dissipated, energy.work)
    dense = () if sol.dense is None else (sol.dense.c,)
    return [np.asarray(x) for x in (sol.t, sol.q, sol.v, sol.a, sol.lam, *parts, *dense)]


def digest(sol: kp.Solution) -> str:
    sums = hashlib.sha256()
    for table in tables(sol):
        sums.update(repr(table.shape).encode())
        sums.update(np.ascontiguousarray(table).tobytes())
    return sums.hexdigest()[:16]


def example(name: str, t_end: float) -> str:
    """All methods and stabilizations on an example."""
    case = kp.load(ROOT / "examples" / f"{name}.toml")
    start = case.start()
    made = [
        digest(kp.dynamics(case.model, start, t_end=t_end, method=m, stabilization=s))
        for m in METHODS
        for s in STABILIZATIONS
    ]
    return " ".join(made)


def drawn(number: int) -> str:
    """A random run, or its error."""
    random = np.random.default_rng([7, number])
    kind = str(random.choice(list(KINDS)))
    mechanism, chosen = KINDS[kind](random), options(random)
    try:
        start = kp.assemble(mechanism.model, set=mechanism.set, guess=mechanism.guess)
        return digest(kp.dynamics(mechanism.model, start, **chosen))  # type: ignore[arg-type]
    except kp.KempeError as error:
        partial = getattr(error, "solution", None)
        return str(error) + (digest(partial) if isinstance(partial, kp.Solution) else "")


def fingerprints() -> list[str]:
    made = [example("four_bar", 0.5), example("six_bar", 0.2), example("squeezer", 0.002)]
    return made + [drawn(number) for number in range(DRAWN)]


if __name__ == "__main__":
    warnings.simplefilter("ignore")
    print("\n".join(fingerprints()))
