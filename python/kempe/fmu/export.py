"""``kp.export_fmu``: a case as an FMU."""

from __future__ import annotations

import hashlib
import json
import re
import zipfile
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from kempe import _core
from kempe.analyses.event import with_actions
from kempe.analyses.options import DOP853, RK45, Auto, Dynamics
from kempe.base import files
from kempe.base.arguments import explained
from kempe.base.names import one_of
from kempe.case import Case
from kempe.errors import FileError, KempeError, ModelError
from kempe.fmu.description import TIME, Description, Variable
from kempe.fmu.library import ending, folder, library, licences
from kempe.model.compiled import CompiledModel
from kempe.model.measure_infos import measure_info, parameter_unit
from kempe.model.model import Model
from kempe.stepping import Stepper

#: Versions of the standard.
VERSIONS = ("2.0", "3.0")
#: The name of an analysis that is not one of the case.
_OWN = "fmu"
#: All files of an FMU have this time, so that the same case gives the same file.
_EPOCH = (1980, 1, 1, 0, 0, 0)
#: Relative tolerances of methods without one of their own.
_RTOL = {method.kind: method.rtol for method in (RK45, DOP853, Auto)}


@explained
def export_fmu(
    case: Case | Model,
    path: Path | str,
    inputs: Sequence[str] = (),
    outputs: Sequence[str] | None = None,
    *,
    version: str = "2.0",
    analysis: str | Dynamics | None = None,
) -> None:
    """Write a case as a functional mock-up unit (FMU) for co-simulation.

    A step of the FMU is a step of ``kp.Stepper``. The FMU contains a library for this system, and
    runs without kempe and Python.

    Args:
        case: the case, or a model, which starts as ``kp.assemble`` assembles it.
        path: the file, which ends with ``.fmu``.
        inputs: parameters of the case that the other tool changes; constant over a step. Other
            parameters with a number as value are parameters of the FMU: they may be set before the
            start.
        outputs: quantities and measures; by default, coordinates and rates of all moving bodies,
            and the measures of the case.
        version: the version of the standard FMI: "2.0" or "3.0".
        analysis: the analysis of type dynamics whose options are used, as in ``kp.Stepper``.

    Raises:
        AssemblyError: the mechanism does not close.
        ModelError: there is no such parameter, quantity or analysis; or a law is a Python function,
            which an FMU cannot contain.
        FileError: the file cannot be written, or there is no library for this system.
    """
    one_of("version of FMI", version, VERSIONS)
    target = files.checked_path(path, "write")
    if target.suffix.lower() != ".fmu":
        raise FileError(f"cannot write {path}: its name must end with .fmu", name=str(path))
    case = Case(case) if isinstance(case, Model) else case
    content = _content(case, target.stem, version, (inputs, outputs), analysis)
    with files.writing(target) as file, zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as pack:
        for place, data in content.items():
            entry = zipfile.ZipInfo(place, _EPOCH)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = 0o644 << 16
            pack.writestr(entry, data)


def _content(
    case: Case,
    stem: str,
    version: str,
    asked: tuple[Sequence[str], Sequence[str] | None],
    analysis: str | Dynamics | None,
) -> dict[str, bytes]:
    """The files in an FMU by their paths. ``asked`` are the inputs and outputs."""
    inputs, outputs = asked
    stepper = Stepper(case, analysis)
    whole, name = _with_analysis(case, analysis)
    names = _default_outputs(stepper._model) if outputs is None else _listed("outputs", outputs)
    variables, interface = _variables(stepper, _listed("inputs", inputs), names)
    text = _text(whole)
    interface |= {"analysis": name}
    token = hashlib.sha256(f"{text}{json.dumps(interface, allow_nan=False)}".encode()).hexdigest()
    identifier = re.sub(r"\W", "_", stem, flags=re.ASCII)
    description = Description(
        case.model.title or stem,
        identifier if identifier[:1].isalpha() else f"m_{identifier}",
        f"{{{token[:32]}}}",
        variables,
        _experiment(whole.analyses[name], stepper.t),
    )
    interface |= {"token": description.token}
    return {
        "modelDescription.xml": description.xml(version),
        "resources/case.toml": text.encode(),
        "resources/interface.json": json.dumps(interface, allow_nan=False).encode(),
        f"binaries/{folder(version)}/{description.identifier}{ending()}": library(),
        "documentation/licenses/license.txt": licences(),
    }


def _listed(what: str, names: Sequence[str]) -> list[str]:
    """Names, each once."""
    if isinstance(names, str) or not all(isinstance(name, str) for name in names):
        raise ModelError(f"{what}: {names!r} is not a list of names", hint="write ['name', …]")
    twice = {name for name in names if list(names).count(name) > 1}
    if twice:
        raise ModelError(f"{what}: {min(twice)} is given twice")
    return list(names)


def _with_analysis(case: Case, analysis: str | Dynamics | None) -> tuple[Case, str]:
    """The case with the analyses up to the one of the FMU, and its name."""
    entries = case.analyses
    of_type = [name for name, entry in entries.items() if entry["type"] == Dynamics.kind]
    if isinstance(analysis, Dynamics):
        plain, actions = with_actions(analysis.events)
        if actions:
            raise ModelError(
                f"the action of the event {next(iter(actions))} is a Python function, which an "
                "FMU cannot contain",
                hint="use an input, or an event that stops the run or releases a driver",
            )
        entry = {**replace(analysis, events=plain or None).tree()}  # type: ignore[arg-type]
        return Case(case.model, case._start, {_OWN: _ending(entry)}), _OWN
    name = analysis or next(iter(of_type), None)
    if name is None:
        return Case(case.model, case._start, {_OWN: Dynamics(1.0).tree()}), _OWN
    kept = list(entries)[: list(entries).index(name) + 1]
    return Case(case.model, case._start, {known: entries[known] for known in kept}), name


def _ending(entry: Mapping[str, Any]) -> dict[str, Any]:
    """An analysis whose end, which does not matter, is after its start."""
    end = entry["t_end"]
    return {**entry, "t_end": 1.0 if isinstance(end, int | float) and end <= 0 else end}


def _text(case: Case) -> str:
    """The case as TOML, with the points of tables in place of their files."""
    tree = case.model.with_points(case.tree())
    return _core.Case(json.dumps(tree, allow_nan=False), "json", None).write("toml")


def _default_outputs(model: CompiledModel) -> list[str]:
    bodies = [name for name in model.tree.get("bodies", {}) if name != "ground"]
    own = {name: ("x", "y", "vx", "vy") for name in bodies if _is_point(model, name)}
    whole = ("x", "y", "angle", "vx", "vy", "omega")
    names = [f"{name}.{part}" for name in bodies for part in own.get(name, whole)]
    return names + list(model.measures)


def _is_point(model: CompiledModel, body: str) -> bool:
    return bool(model.tree["bodies"][body].get("type") == "point_mass")


def _variables(
    stepper: Stepper, inputs: Sequence[str], outputs: Sequence[str]
) -> tuple[list[Variable], dict[str, Any]]:
    """The variables in the order of their value references, and the file ``interface.json``."""
    model, written = stepper._model, stepper._model.tree.get("parameters", {})
    for name in inputs:
        one_of("parameter", name, model.parameters)
    fixed = [name for name in model.parameters if name not in inputs and _is_number(model, name)]
    found = [Variable(TIME, "independent", "s", None, "time")]
    formulas = []
    for name in outputs:
        float(stepper[name])  # an error if there is no such quantity, or it has no value
        info = model.measures.get(name) or measure_info(model, name)
        text = f"measure {info.expression}" if name in model.measures else "quantity of the motion"
        found.append(Variable(name, "output", info.unit, None, text))
        formulas.append({"name": name, "formula": info.expression})
    for name in (*inputs, *fixed):
        causality = "input" if name in inputs else "parameter"
        text = f"{name} = {written[name]}"
        unit = parameter_unit(model, name)
        found.append(Variable(name, causality, unit, float(model.parameters[name]), text))
    names = [variable.name for variable in found]
    for name in names:
        if names.count(name) > 1:
            raise ModelError(
                f"{name} is the name of two variables of the FMU: of the time, a measure or a "
                "parameter",
                hint="rename the measure or the parameter",
            )
    given = [variable for variable in found if variable.start is not None]
    parameters = [{"name": v.name, "input": v.causality == "input"} for v in given]
    return found, {"outputs": formulas, "parameters": parameters}


def _is_number(model: CompiledModel, name: str) -> bool:
    """Whether a parameter is a number with or without a unit, not a formula of others."""
    value = model.tree["parameters"][name]
    others = (other for other in model.parameters if other != name)
    if not isinstance(value, str) or set(re.findall(r"\w+", value)).isdisjoint(others):
        return True
    try:  # a unit may have the name of a parameter
        _core.formula_value(value, [], [])
    except KempeError:
        return False
    return True


def _experiment(entry: Mapping[str, Any], start: float) -> dict[str, float]:
    """The default experiment: the times of the analysis, and the tolerance of its method."""
    method = entry.get("method", Auto.kind)
    table = method if isinstance(method, Mapping) else {"type": method}
    rtol = table.get("rtol", _RTOL.get(str(table.get("type"))))
    if "step" in table:
        rtol = None
    given = {
        "startTime": start,
        "stopTime": entry.get("t_end"),
        "tolerance": rtol,
        "stepSize": entry.get("output_step"),
    }
    return {key: float(x) for key, x in given.items() if isinstance(x, int | float)}
