"""``kp.export_fmu`` and ``kempe convert``: contents of the file, and refusals."""

from __future__ import annotations

import json
import zipfile
from pathlib import Path
from xml.etree import ElementTree as ET

import kempe as kp
import pytest
from command_line import kempe
from fmpy import read_model_description
from fmu.machines import VERSIONS, ball
from kempe.fmu import library
from kempe.fmu.units import powers_of

PRESS = "examples/motor_press.toml"


@pytest.mark.parametrize(
    ("unit", "powers"),
    [
        ("m", {"m": 1}),
        ("N", {"kg": 1, "m": 1, "s": -2}),
        ("N*m/rad", {"kg": 1, "m": 2, "s": -2, "rad": -1}),
        ("kg*m^2", {"kg": 1, "m": 2}),
        ("rad/s^2", {"s": -2, "rad": 1}),
        ("s^-1", {"s": -1}),
        ("V", {"kg": 1, "m": 2, "s": -3, "A": -1}),
        ("W/m", {"kg": 1, "m": 1, "s": -3}),
        ("1", {}),
        ("m or rad", None),
        ("SI", None),
        ("", None),
        ("m*", None),
    ],
)
def test_units_are_powers_of_base_units(unit: str, powers: dict[str, int] | None) -> None:
    assert powers_of(unit) == powers


@pytest.mark.parametrize("version", VERSIONS)
def test_the_description_has_the_variables(tmp_path: Path, version: str) -> None:
    path = tmp_path / "2 presses.fmu"
    kp.export_fmu(kp.load(PRESS), path, ["stall"], ["ram.y", "ram.vy"], version=version)
    found = read_model_description(str(path))
    assert found.modelName == "A motor starts a crank press"
    assert found.coSimulation.modelIdentifier == "m_2_presses"
    assert found.variableNamingConvention == "structured"
    rows = {
        v.name: (v.causality, v.variability, v.start and float(v.start), v.unit)
        for v in found.modelVariables
    }
    assert rows == {
        "time": ("independent", "continuous", None, "s"),
        "ram.y": ("output", "continuous", None, "m"),
        "ram.vy": ("output", "continuous", None, "m/s"),
        "stall": ("input", "continuous", 500.0, "N*m"),
        "free": ("parameter", "fixed", pytest.approx(157.07963267948966), "s^-1"),
        "flywheel": ("parameter", "fixed", 2.0, "kg*m^2"),
        "k": ("parameter", "fixed", 4e6, None),
        "c": ("parameter", "fixed", 5e4, None),
    }
    times = found.defaultExperiment
    assert [float(x) for x in (times.startTime, times.stopTime, times.stepSize)] == [0, 4, 0.002]
    assert float(times.tolerance) == kp.Auto().rtol


def test_formulas_of_parameters_are_no_parameters_of_the_fmu(tmp_path: Path) -> None:
    numbers = {"L": 1, "M": "2*L", "m": 3, "W": "2 m"}  # m is also the unit of W
    m = kp.Model("rod", gravity=(0, -9.81), parameters=numbers)
    m.ground.points(A=(0, 0))
    m.bar("rod", mass="M", length="L", ends=("A", "B"))
    m.revolute("A", "ground.A", "rod.A")
    kp.export_fmu(kp.Case(m, {"set": {"rod.angle": 0}}), tmp_path / "rod.fmu")
    names = [v.name for v in read_model_description(str(tmp_path / "rod.fmu")).modelVariables]
    coordinates = [f"rod.{part}" for part in ("x", "y", "angle", "vx", "vy", "omega")]
    assert names == ["time", *coordinates, "L", "m", "W"]


def test_the_same_case_gives_the_same_file(tmp_path: Path) -> None:
    for name in ("a", "b"):
        (tmp_path / name).mkdir()
        kp.export_fmu(kp.load(PRESS), tmp_path / name / "press.fmu", ["stall"])
    one, other = (tmp_path / name / "press.fmu" for name in ("a", "b"))
    assert one.read_bytes() == other.read_bytes()
    kp.export_fmu(kp.load(PRESS, parameters={"k": 1e6}), other, ["stall"])
    tokens = [read_model_description(str(path)).guid for path in (one, other)]
    assert tokens[0] != tokens[1]


def test_the_command_line_writes_an_fmu(tmp_path: Path) -> None:
    path = tmp_path / "press.fmu"
    words = ("--input", "stall", "--input", "free", "--output", "ram.y", "--fmi", "3.0")
    done = kempe("convert", PRESS, str(path), *words, "--analysis", "strokes")
    assert done.returncode == 0, done.stderr
    with zipfile.ZipFile(path) as pack:
        root = ET.fromstring(pack.read("modelDescription.xml"))
        interface = json.loads(pack.read("resources/interface.json"))
    assert root.get("fmiVersion") == "3.0"
    assert interface["analysis"] == "strokes"
    assert [p["name"] for p in interface["parameters"] if p["input"]] == ["stall", "free"]
    assert kempe("convert", PRESS, str(path)).returncode != 0  # it exists
    done = kempe("convert", PRESS, str(tmp_path / "press.json"), "--input", "stall")
    assert done.returncode != 0 and "--input belongs to FMUs" in done.stderr


def test_refusals_name_the_thing(tmp_path: Path) -> None:
    path, case = tmp_path / "a.fmu", kp.load(PRESS)

    def refused(message: str, *words: object, **options: object) -> None:
        with pytest.raises(kp.KempeError) as raised:
            kp.export_fmu(*words, **options)  # type: ignore[arg-type]
        assert message in str(raised.value)
        assert not path.exists()

    refused("'stal'", case, path, ["stal"])
    refused("unknown quantity of ram 'z'", case, path, outputs=["ram.z"])
    refused("energy.balance", case, path, outputs=["energy.balance"])
    refused("'1.0'", case, path, version="1.0")
    refused("must end with .fmu", case, tmp_path / "a.zip")
    refused("ram.y is given twice", case, path, outputs=["ram.y", "ram.y"])
    refused("is not a list of names", case, path, "stall")
    refused("'start'", case, path, analysis="start")
    event = kp.Event("wheel.angle > 3", action=lambda _: None)
    refused(
        "the action of the event turn", case, path, analysis=kp.Dynamics(1, events={"turn": event})
    )
    timed = kp.Model("ball", parameters={"time": 1})
    timed.point_mass("ball", mass="time")
    refused("time is the name of two variables", timed, path)
    law = kp.Model("rotor")
    law.ground.points(O=(0, 0))
    law.bar("rotor", mass=1, length=1, ends=("A", "B"))
    law.revolute("pin", "ground.O", "rotor.A")
    law.torque("push", "rotor", torque=lambda t, _: t)  # type: ignore[arg-type]
    refused("Python function", law, path)


def test_without_sources_and_library_the_remedy_is_a_wheel(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(library, "ROOT", tmp_path)
    with pytest.raises(kp.FileError, match="has no library for FMUs") as raised:
        kp.export_fmu(ball(), tmp_path / "ball.fmu")
    assert raised.value.hint is not None and "wheel" in raised.value.hint
    # the library of a wheel needs no sources
    (tmp_path / "_fmu").mkdir()
    name = f"libkempe_fmu{library.ending()}"
    (tmp_path / "_fmu" / name).write_bytes(b"a library")
    for name in ("LICENSE-MIT", "THIRD_PARTY_NOTICES.txt"):
        (tmp_path / "_fmu" / name).write_bytes(name.encode())
    monkeypatch.setattr(library, "IN_WHEEL", tmp_path / "_fmu")
    kp.export_fmu(ball(), tmp_path / "ball.fmu")
    with zipfile.ZipFile(tmp_path / "ball.fmu") as pack:
        assert pack.read(f"binaries/{library.folder('2.0')}/ball.so") == b"a library"


def test_a_failing_build_is_an_error(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    (tmp_path / "bindings" / "fmu").mkdir(parents=True)
    (tmp_path / "bindings" / "fmu" / "Cargo.toml").touch()
    monkeypatch.setattr(library, "ROOT", tmp_path)
    with pytest.raises(kp.FileError, match="cannot build the library for FMUs"):
        library.library()
