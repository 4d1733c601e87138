"""kempe: planar multibody mechanics.

``import kempe as kp`` loads almost nothing: each name below is fetched when it is first used.
A new public name is one line in ``_HOME`` and one in the block for type checkers under it.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from kempe._version import __version__

if TYPE_CHECKING:
    from kempe import errors as errors
    from kempe.errors import AssemblyError as AssemblyError
    from kempe.errors import FileError as FileError
    from kempe.errors import IntegrationError as IntegrationError
    from kempe.errors import InternalError as InternalError
    from kempe.errors import KempeError as KempeError
    from kempe.errors import ModelError as ModelError
    from kempe.errors import RedundancyError as RedundancyError
    from kempe.errors import SingularityError as SingularityError

#: Public name → the module of kempe that holds it; "" means that the name is a module itself.
_HOME = {
    "AssemblyError": "errors",
    "FileError": "errors",
    "IntegrationError": "errors",
    "InternalError": "errors",
    "KempeError": "errors",
    "ModelError": "errors",
    "RedundancyError": "errors",
    "SingularityError": "errors",
    "errors": "",
}

__all__ = ["__version__", *_HOME]  # noqa: PLE0604


def __getattr__(name: str) -> Any:
    """Fetch a public name from its module and keep it (PEP 562)."""
    if name not in _HOME:
        raise AttributeError(f"module 'kempe' has no attribute {name!r}")
    home = _HOME[name]
    value = (
        getattr(import_module(f"kempe.{home}"), name) if home else import_module(f"kempe.{name}")
    )
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted(__all__)
