"""Data that kempe returns cannot be changed: every dataclass of the package is frozen."""

import dataclasses
import importlib
import pkgutil
from typing import Any

import kempe

#: What is filled while a file or a figure is read, written or drawn; none of it is a result.
FILLED = {
    "kempe.asmt.sheet.Sheet",
    "kempe.asmt.sheet.Solid",
    "kempe.cli.run._Finished",
    "kempe.draw.dxf._Sheet",
    "kempe.mjcf.trees.Branch",
    "kempe.mjcf.xml.Node",
    "kempe.plot.grid._Drawing",
}


def test_the_dataclasses_of_the_package_are_frozen() -> None:
    found: dict[str, Any] = {}
    for module in pkgutil.walk_packages(kempe.__path__, "kempe."):
        if not module.name.endswith("__main__"):
            found |= {
                f"{module.name}.{name}": one
                for name, one in vars(importlib.import_module(module.name)).items()
                if dataclasses.is_dataclass(one) and one.__module__ == module.name
            }
    assert {"kempe.results.assembly_report.Mode", "kempe.results.table.Column"} <= set(found)
    changeable = {name for name, one in found.items() if not one.__dataclass_params__.frozen}
    assert changeable == FILLED
