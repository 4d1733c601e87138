"""Calls upwards: what methods of lower modules need of upper ones.

Imports run one way, from upper modules to lower ones. A model that shows itself in a notebook needs
a module above it all the same. ``kempe/__init__.py`` fills this table; each entry imports its
module when it is called.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable

#: The functions by name. ARCHITECTURE.md gives the reason for each.
CALLS: dict[str, Callable[..., Any]] = {}
