"""The design of a sweep: the values of all variables in each variant."""

from __future__ import annotations

from collections.abc import Sequence
from math import prod
from typing import Any

import numpy as np

from kempe.base.arrays import Floats, fixed
from kempe.base.names import one_of
from kempe.errors import ModelError
from kempe.model.values import refuse
from kempe.sweeps.variables import MOST, Variable

#: The designs; the last three place points in the unit cube.
DESIGNS = ("grid", "paired", "random", "latin", "sobol")
#: Designs of lists.
_OF_LEVELS = ("grid", "paired")


def rows(variables: Sequence[Variable], design: str, n: int | None, seed: int | None) -> Floats:
    """The values of the variables, (n, n_variables), in the order of the design.

    In a grid the last variable changes fastest.

    Raises:
        ModelError: the design needs other values or another ``n``, or SciPy is missing.
    """
    count = count_of(variables, design, n, seed)
    if design in _OF_LEVELS:
        levels = [_levels(variable, design) for variable in variables]
        return fixed(_grid(levels) if design == "grid" else np.column_stack(levels))
    shares = _shares(design, count, len(variables), seed)
    columns = [variable.at(shares[:, k]) for k, variable in enumerate(variables)]
    return fixed(np.column_stack(columns))


def count_of(variables: Sequence[Variable], design: str, n: int | None, seed: int | None) -> int:
    """The number of variants of a design, which is checked but not made.

    Raises:
        ModelError: as for ``rows``.
    """
    one_of("design", design, DESIGNS)
    if design in _OF_LEVELS:
        if n is not None:
            refuse("n", f"a {design} design has as many variants as its lists give; leave n out")
        counts = [len(_levels(variable, design)) for variable in variables]
        return _size_of_grid(counts) if design == "grid" else _length(variables, counts)
    count = _count(n, design)
    _seed(seed)
    if design != "random":
        _qmc(design)
    return count


def _levels(variable: Variable, design: str) -> Floats:
    if variable.levels is None:
        raise ModelError(
            f"variables.{variable.name}: a {design} design needs a list, or a range with n",
            hint='give one, or use design="random" with n=1000',
        )
    return np.asarray(variable.levels)


def _size_of_grid(counts: Sequence[int]) -> int:
    count = prod(map(float, counts))
    if count > MOST:
        refuse("variables", f"the grid has {count:.3g} variants; at most {MOST}")
    return int(count)


def _grid(levels: Sequence[Floats]) -> Floats:
    return np.stack(np.meshgrid(*levels, indexing="ij"), axis=-1).reshape(-1, len(levels))


def _length(variables: Sequence[Variable], counts: Sequence[int]) -> int:
    """The one length of paired lists."""
    if len(set(counts)) > 1:
        pairs = zip(variables, counts, strict=True)
        told = ", ".join(f"{variable.name} {count}" for variable, count in pairs)
        raise ModelError(
            f"variables: a paired design needs lists of one length; these have {told}",
            hint='make them equal, or use design="grid"',
        )
    return counts[0]


def _count(n: int | None, design: str) -> int:
    if not isinstance(n, (int, np.integer)) or isinstance(n, bool) or not 1 <= n <= MOST:
        given = "missing" if n is None else repr(n)
        needed = f"a {design} design needs the number of variants, such as n=1000, at most {MOST}"
        refuse("n", f"{given}; {needed}")
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
