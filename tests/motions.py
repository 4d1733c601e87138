"""The results of the examples, each computed once in a process."""

from functools import cache

import kempe as kp
from house.places import ROOT


@cache
def results(name: str) -> kp.Results:
    """The results of an example by its name; they are shared, so that no test may change them."""
    return kp.load(ROOT / "examples" / f"{name}.toml").run()
