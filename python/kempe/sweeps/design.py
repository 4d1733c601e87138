"""The design of a sweep: the values of all variables in each variant."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from kempe.arrays import Floats, fixed
from kempe.errors import ModelError
from kempe.names import one_of
from kempe.sweeps.variables import Variable
from kempe.values import refuse

#: The designs; the last three place points in the unit cube.
DESIGNS = ("grid", "paired", "random", "latin", "sobol")
#: Largest number of variants of a sweep; their table alone has some gigabytes.
MOST = 100_000_000


def rows(variables: Sequence[Variable], design: str, n: int | None, seed: int | None) -> Floats:
    """The values of the variables, (n, n_variables), in the order of the design.

    In a grid the last variable changes fastest.

    Raises:
        ModelError: the design needs other values or another ``n``, or SciPy is missing.
    """
    one_of("design", design, DESIGNS)
    if design in ("grid", "paired"):
        if n is not None:
            refuse("n", f"a {design} design has as many variants as its lists give; leave n out")
        levels = [_levels(variable, design) for variable in variables]
        return fixed(_grid(levels) if design == "grid" else _paired(variables, levels))
    count = _count(n, design)
    shares = _shares(design, count, len(variables), seed)
    columns = [variable.at(shares[:, k]) for k, variable in enumerate(variables)]
    return fixed(np.column_stack(columns))


def _levels(variable: Variable, design: str) -> Floats:
    if variable.levels is None:
        raise ModelError(
            f"variables.{variable.name}: a {design} design needs a list, or a range with n",
            hint='give one, or use design="random" with n=1000',
        )
    return np.asarray(variable.levels)


def _grid(levels: Sequence[Floats]) -> Floats:
    count = float(np.prod([float(len(one)) for one in levels]))
    if count > MOST:
        refuse("variables", f"the grid has {count:.3g} variants; at most {MOST:.0e}")
    return np.stack(np.meshgrid(*levels, indexing="ij"), axis=-1).reshape(-1, len(levels))


def _paired(variables: Sequence[Variable], levels: Sequence[Floats]) -> Floats:
    counts = {variable.name: len(one) for variable, one in zip(variables, levels, strict=True)}
    if len(set(counts.values())) > 1:
        told = ", ".join(f"{name} {count}" for name, count in counts.items())
        raise ModelError(
            f"variables: a paired design needs lists of one length; these have {told}",
            hint='make them equal, or use design="grid"',
        )
    return np.column_stack(levels)


def _count(n: int | None, design: str) -> int:
    if not isinstance(n, (int, np.integer)) or isinstance(n, bool) or not 1 <= n <= MOST:
        refuse("n", f"{n!r}; a {design} design needs the number of variants, such as n=1000")
    if design == "sobol" and n & (n - 1):
        power = 2 ** int(np.ceil(np.log2(n)))
        raise ModelError(
            f"n: {n}; a Sobol design is balanced only for powers of two", hint=f"use n={power}"
        )
    return int(n)


def _shares(design: str, n: int, dimension: int, seed: int | None) -> Floats:
    """Points in the unit cube, (n, dimension)."""
    generator = np.random.default_rng(_seed(seed))
    if design == "random":
        return generator.random((n, dimension))
    qmc: Any = _qmc(design)
    kind = qmc.LatinHypercube if design == "latin" else qmc.Sobol
    return np.asarray(kind(dimension, seed=generator).random(n), dtype=np.float64)


def _seed(seed: int | None) -> int:
    if seed is None:
        return 0
    if not isinstance(seed, (int, np.integer)) or isinstance(seed, bool) or seed < 0:
        refuse("seed", f"{seed!r}; must be a whole number, at least 0")
    return int(seed)


def _qmc(design: str) -> Any:
    try:
        from scipy.stats import qmc
    except ImportError as error:
        raise ModelError(
            f'design="{design}" needs SciPy, which is not installed',
            hint="pip install scipy, or use design='random'",
        ) from error
    return qmc
