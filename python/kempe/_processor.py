"""Select the core that is compiled for the instructions of the processor.

A wheel for x86-64 contains the core twice. ``_core`` runs on every processor. The folder
``_x86_64_v3`` contains the same source compiled with AVX2 and FMA; this build becomes
``kempe._core`` if the processor has these instructions. A build from source has only one core.
"""

import os
import sys

FOLDER = os.path.join(os.path.dirname(__file__), "_x86_64_v3")  # noqa: PTH118, PTH120 (a fast start)
#: With this variable set, the core for every processor is used.
VARIABLE = "KEMPE_BASELINE"


def load_core() -> None:
    """Import ``kempe._core`` from ``FOLDER``, if it is there and the processor supports it."""
    if not os.path.isdir(FOLDER) or os.environ.get(VARIABLE):  # noqa: PTH112
        return
    from importlib.machinery import ExtensionFileLoader
    from importlib.util import module_from_spec, spec_from_file_location

    import kempe
    from kempe import _core

    if not _core.supports_v3():
        return
    name, path = _core.__name__, os.path.join(FOLDER, os.path.basename(str(_core.__file__)))  # noqa: PTH118, PTH119
    # the last part of the name is the module's name in the file, so that it stays the same
    spec = spec_from_file_location(name, path, loader=ExtensionFileLoader(name, path))
    assert spec is not None and spec.loader is not None
    faster = module_from_spec(spec)
    spec.loader.exec_module(faster)
    sys.modules[name] = faster
    kempe._core = faster
