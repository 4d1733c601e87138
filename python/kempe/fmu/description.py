"""The file ``modelDescription.xml`` of an FMU."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any
from xml.etree import ElementTree as ET

from kempe._version import __version__
from kempe.fmu.units import powers_of

#: The name of the time in an FMU.
TIME = "time"
#: Categories of messages, with their meaning.
_LOG = {
    "logStatusError": "the reason of an error",
    "logStatusWarning": "doubts about the accuracy",
    "logAll": "the event that has ended a run",
}
_STRUCTURED = re.compile(r"[A-Za-z_]\w*(\.[A-Za-z_]\w*)*", re.ASCII)


@dataclass(frozen=True)
class Variable:
    """A variable of an FMU. Its value reference is its place in the list.

    Attributes:
        name: its name in kempe.
        causality: independent, output, input or parameter.
        unit: its SI unit; "1" or "SI" without one.
        start: its value at the start, in SI units; None for outputs and the time.
        text: a description.
    """

    name: str
    causality: str
    unit: str
    start: float | None
    text: str

    @property
    def variability(self) -> str:
        """When the value may change."""
        return "fixed" if self.causality == "parameter" else "continuous"

    @property
    def initial(self) -> str | None:
        """How the value at the start is found; inputs and the time have no such attribute."""
        return {"output": "calculated", "parameter": "exact"}.get(self.causality)


@dataclass(frozen=True)
class Description:
    """The content of ``modelDescription.xml``.

    Attributes:
        title: name of the model.
        identifier: name of the library, without its ending.
        token: text that belongs to this content alone.
        variables: first the time, then outputs, inputs and parameters.
        experiment: start, end, step and tolerance of the analysis, as far as they are numbers.
    """

    title: str
    identifier: str
    token: str
    variables: Sequence[Variable]
    experiment: Mapping[str, float] = field(default_factory=dict)

    def xml(self, version: str) -> bytes:
        """The text for a version of the standard, 2.0 or 3.0."""
        root = _of_3(self) if version == "3.0" else _of_2(self)
        ET.indent(root)
        text: bytes = ET.tostring(root, encoding="UTF-8", xml_declaration=True)
        return text


def _head(of: Description, version: str, token: str) -> ET.Element:
    structured = all(_STRUCTURED.fullmatch(v.name) for v in of.variables)
    attributes = {
        "fmiVersion": version,
        "modelName": of.title,
        token: of.token,
        "generationTool": f"kempe {__version__}",
        "variableNamingConvention": "structured" if structured else "flat",
    }
    return ET.Element("fmiModelDescription", attributes)


def _common(of: Description, root: ET.Element) -> None:
    """Add units, categories of messages and the experiment."""
    names = sorted({v.unit for v in of.variables if _has_unit(v)})
    if names:
        units = ET.SubElement(root, "UnitDefinitions")
        for name in names:
            powers = {base: str(power) for base, power in (powers_of(name) or {}).items()}
            ET.SubElement(ET.SubElement(units, "Unit", name=name), "BaseUnit", powers)
    categories = ET.SubElement(root, "LogCategories")
    for name, text in _LOG.items():
        ET.SubElement(categories, "Category", name=name, description=text)
    ET.SubElement(root, "DefaultExperiment", {k: repr(x) for k, x in of.experiment.items()})


def _has_unit(variable: Variable) -> bool:
    return bool(powers_of(variable.unit))


def _attributes(variable: Variable, place: int) -> dict[str, str]:
    found = {
        "name": variable.name,
        "valueReference": str(place),
        "description": variable.text,
        "causality": variable.causality,
        "variability": variable.variability,
    }
    return found | ({"initial": variable.initial} if variable.initial else {})


def _value(variable: Variable) -> dict[str, str]:
    unit = {"unit": variable.unit} if _has_unit(variable) else {}
    return unit | ({} if variable.start is None else {"start": repr(variable.start)})


def _outputs(of: Description) -> Iterator[int]:
    return (k for k, v in enumerate(of.variables) if v.causality == "output")


def _of_2(of: Description) -> ET.Element:
    root = _head(of, "2.0", "guid")
    root.set("numberOfEventIndicators", "0")
    abilities: dict[str, Any] = {
        "modelIdentifier": of.identifier,
        "canHandleVariableCommunicationStepSize": "true",
        "canNotUseMemoryManagementFunctions": "true",
        "canGetAndSetFMUstate": "true",
        "canSerializeFMUstate": "true",
    }
    ET.SubElement(root, "CoSimulation", abilities)
    _common(of, root)
    variables = ET.SubElement(root, "ModelVariables")
    for place, variable in enumerate(of.variables):
        own = ET.SubElement(variables, "ScalarVariable", _attributes(variable, place))
        ET.SubElement(own, "Real", _value(variable))
    structure = ET.SubElement(root, "ModelStructure")
    for name in ("Outputs", "InitialUnknowns"):
        if places := list(_outputs(of)):
            section = ET.SubElement(structure, name)
            for place in places:
                ET.SubElement(section, "Unknown", index=str(place + 1))
    return root


def _of_3(of: Description) -> ET.Element:
    root = _head(of, "3.0", "instantiationToken")
    abilities = {
        "modelIdentifier": of.identifier,
        "canHandleVariableCommunicationStepSize": "true",
        "canGetAndSetFMUState": "true",
        "canSerializeFMUState": "true",
        "canReturnEarlyAfterIntermediateUpdate": "false",
        "hasEventMode": "false",
    }
    ET.SubElement(root, "CoSimulation", abilities)
    _common(of, root)
    variables = ET.SubElement(root, "ModelVariables")
    for place, variable in enumerate(of.variables):
        attributes = _attributes(variable, place) | _value(variable)
        ET.SubElement(variables, "Float64", attributes)
    structure = ET.SubElement(root, "ModelStructure")
    for name in ("Output", "InitialUnknown"):
        for place in _outputs(of):
            ET.SubElement(structure, name, valueReference=str(place))
    return root
