"""The Python example of README.md with hashes of its results, for an installed kempe.

python example.py README.md

It prints one JSON object: the instructions of the core, the folder of the package, the last state,
a state of a run with a small tolerance, and hashes of runs with several methods.
"""

import contextlib
import hashlib
import json
import re
import sys
from pathlib import Path


def example(page: str) -> dict[str, object]:
    """Names of the first Python block of a page after its execution."""
    block = re.search(r"^```python\n(.*?)^```", page, re.DOTALL | re.MULTILINE)
    assert block is not None
    names: dict[str, object] = {}
    with contextlib.redirect_stdout(sys.stderr):
        exec(block[1], names)
    return names


def report(page: str) -> dict[str, object]:
    names = example(page)
    import kempe as kp
    import numpy as np
    from kempe import _core

    def digest(sol: kp.Solution) -> str:
        tables = [sol.t, sol.q, sol.v, sol.a, sol.lam]
        return hashlib.sha256(b"".join(np.asarray(x).tobytes() for x in tables)).hexdigest()

    solution, model, start = names["sol"], names["m"], names["start"]
    assert isinstance(solution, kp.Solution)
    methods = [kp.DOP853(rtol=1e-9), kp.Radau(rtol=1e-6), kp.RK4(step=1e-3)]
    runs = [kp.dynamics(model, start, t_end=0.5, output_step=0.01, method=m) for m in methods]
    return {
        "instructions": _core.instructions(),
        "package": str(Path(kp.__file__).parent),
        "version": kp.__version__,
        "last": solution.q[-1].tolist(),
        "tight": {"t": round(runs[0].t[-1], 12), "q": runs[0].q[-1].tolist()},
        "hashes": [digest(sol) for sol in [solution, *runs]],
    }


if __name__ == "__main__":
    print(json.dumps(report(Path(sys.argv[1]).read_text("utf-8"))))
