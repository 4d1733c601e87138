"""The options of a simulation as an entry of a case and as the text that the core reads, cached.

Loops over starts or brief intervals repeat the same options many times. A checked request is kept
under the values of its options, all of which are immutable.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any, Literal, NamedTuple, TypeAlias

from kempe.analyses.option import Option, core_options
from kempe.analyses.options import Dynamics, NoStabilization
from kempe.model.values import Number, number

#: ``json.dumps`` would construct such an encoder for each text.
encode = json.JSONEncoder(allow_nan=False).encode

#: Values of exactly these types are distinguished by type and value.
_PLAIN = frozenset({float, int, bool, str, type(None)})
#: Options whose text follows from their fields.
_KNOWN = frozenset(Option.__subclasses__())
_NONE = NoStabilization()
#: The largest number of requests kept.
_MOST = 64


class Request(NamedTuple):
    """A requested simulation.

    Attributes:
        entry: its options as in a file.
        text: the options that the core reads, as JSON.
        t_end: end of the simulation, s; it replaces the end time in the text unless it is None.
    """

    entry: Mapping[str, Any]
    text: str
    t_end: float | None = None


#: t_end, output_step, method, stabilization, max_steps.
Asked: TypeAlias = "tuple[Number, Number | None, Option, Option | None, int | None]"
#: Whether output is dense; classes of the options; types of the values; the values.
_Key: TypeAlias = tuple[bool, tuple[type, ...], tuple[type, ...], tuple[object, ...]]

_kept: dict[_Key, Request] = {}


def request(
    asked: Asked,
    dense_output: bool,
    singularity: Literal["stop", "pass"],
    more: Mapping[str, Any],
) -> Request:
    """The entry for a simulation, checked.

    Args:
        asked: the first fields of ``Dynamics``, in their order.
        dense_output: as in ``Dynamics``.
        singularity: as in ``Dynamics``.
        more: other fields of ``Dynamics``; requests with such fields are not cached.

    Raises:
        ModelError: a value is not allowed in its field.
    """
    key = None if more else _key(asked, dense_output, singularity)
    known = None if key is None else _kept.get(key)
    t_end = number(asked[0], f"analyses.{Dynamics.name}.t_end")
    if known is not None and not isinstance(t_end, str):
        return Request({**known.entry, "t_end": t_end}, known.text, float(t_end))
    entry = Dynamics(*asked, dense_output, singularity=singularity, **more).tree()
    made = Request(entry, encode(core_options(entry)))
    if key is not None and not isinstance(entry["t_end"], str):
        _keep(key, made)
    return made


def _key(asked: Asked, dense_output: bool, singularity: str) -> _Key | None:
    """Options except t_end, each with its type, since 1 == True; None if a value is mutable."""
    _, output_step, method, stabilization, max_steps = asked
    chosen = _NONE if stabilization is None else stabilization
    kinds = type(method), type(chosen)
    if not _KNOWN.issuperset(kinds) or type(dense_output) is not bool:
        return None
    options = (*vars(method).values(), *vars(chosen).values())
    values = (output_step, max_steps, singularity, *options)
    types = tuple(map(type, values))
    return (dense_output, kinds, types, values) if _PLAIN.issuperset(types) else None


def _keep(key: _Key, made: Request) -> None:
    if 0.0 in key[-1]:  # -0.0 equals 0.0 but is written differently
        return
    if len(_kept) >= _MOST:
        _kept.clear()
    _kept[key] = made
