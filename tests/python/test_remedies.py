"""The remedy that a message names works: each mistake is mended with it."""
# ruff: noqa: ARG005 - each remedy is an act on a model

import inspect
import re
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import kempe as kp
import pytest
from command_line import kempe
from kempe.model.elements import ElementMethods
from python.test_mistakes import (
    COMMANDS,
    FILES,
    FOUR_BAR,
    HEAD,
    METHODS,
    SAME,
    VALUES,
    WORDS,
    pendulum,
    start,
)


@pytest.fixture(autouse=True)
def _usual_units() -> Iterator[None]:
    yield
    kp.units("SI")


Act = Callable[[kp.Model], object]


def spring(m: kp.Model, **more: Any) -> object:
    m.torsion_spring("s", "ground", "rod", **more)
    return m.compile()


def angle(m: kp.Model, rate: str = "2*t") -> object:
    m.coordinate_driver("D", coordinate="rod.angle", value=rate)
    return m.compile()


def bar(m: kp.Model, mass: Any) -> object:
    m.bar("r", mass=mass, length=1, ends=("A", "B"))
    return m.compile()


def turned(m: kp.Model) -> kp.State:
    angle(m)
    return kp.assemble(m)


#: The name of a mistake, the remedy in its message, and the act with this remedy.
REMEDIES: dict[str, tuple[str, Act]] = {
    "hinge": ("revolute", lambda m: m.revolute("B", "ground.O", "rod.B")),
    "prismatic": ("translational", lambda m: m.translational("B", "ground.O", "rod.B")),
    "rsda": ("torsion_spring", lambda m: spring(m, stiffness=3)),
    "fixed": ("weld", lambda m: m.weld("B", "ground.O", "rod.B")),
    "revolut": ("revolute", lambda m: m.revolute("B", "ground.O", "rod.B")),
    "simulate": ("dynamics", lambda m: kp.dynamics(m, start(m), t_end=1)),
    "linearize": ("modes", lambda m: kp.modes(m, kp.assemble(m, {"rod.angle": "-90 deg"}))),
    "kinematic": ("kinematics", lambda m: kp.kinematics(m, turned(m), t_end=1)),
    "dt": ("output_step", lambda m: kp.dynamics(m, start(m), t_end=1, output_step=0.1)),
    "tf": ("t_end", lambda m: kp.dynamics(m, start(m), t_end=1)),
    "k": ("stiffness", lambda m: spring(m, stiffness=3)),
    "c": ("damping", lambda m: spring(m, stiffness=3, damping=3)),
    "l0": (
        "free_length",
        lambda m: m.spring_damper("s", "ground.O", "rod.B", stiffness=2, free_length=3),
    ),
    "m": ("mass", lambda m: bar(m, 3)),
    "I": ("inertia", lambda m: m.body("r", mass=3, inertia=3)),
    "g": ("gravity", lambda m: kp.Model("x", gravity=(0, -9.81))),
    "step": ("step", lambda m: kp.RK4(step=0.1)),
    "gain": ("alpha' or 'beta", lambda m: kp.Baumgarte(alpha=3, beta=3)),
    "rate": ("set", lambda m: kp.assemble(m, set={"rod.angle": 0.1, "rod.omega": 1})),
    "parameter": ("kp.Model(parameters={'k': 2})", lambda m: kp.Model(parameters={"k": 2})),
    "missing": ("name, i, j", lambda m: m.revolute("B", "ground.O", "rod.B")),
    "save": ("progress", lambda m: _case().run(progress=lambda *_: None)),
    "view": ("on, frame, about", lambda m: start(m)["A"].force(on="rod")),
    "solution": ("on", lambda m: start(m).joint("A").torque(on="rod")),
    "event": ("stop", lambda m: kp.Event("rod.angle", stop=True)),
    "many": ("write them by name", lambda m: m.bar("r", mass=1, length=2, ends=("A", "B"))),
    "body": ("rod", lambda m: m.revolute("B", "ground.O", "rod.B") and m.compile()),
    "point": ("are: O", lambda m: m.revolute("B", "ground.O", "rod.B") and m.compile()),
    "frame": (
        "'i' or 'j'",
        lambda m: m.force("F", j="rod.B", force=(1, 0), frame="j") and m.compile(),
    ),
    "negative mass": ("must not be negative", lambda m: bar(m, 1)),
    "unit": ("must be in kg", lambda m: bar(m, "1 kg")),
    "unit as a factor": ("'2 kg'", lambda m: bar(m, "2 kg")),
    "tonne": ("'2 tonne'", lambda m: bar(m, "2 tonne")),
    "name": (
        "declare it in the parameters",
        lambda m: pendulum(parameters={"foo": 3}).torque("T", j="rod", torque="foo*2"),
    ),
    "formula": ("is never closed", lambda m: m.torque("T", j="rod", torque="2*(3)") or m.compile()),
    "rate of a driver": ("'rod.angle', and a law such as 2*t", lambda m: angle(m, "2*t")),
    "coordinate": ("'angle'", angle),
    "over": (
        "'rod.angle'",
        lambda m: kp.kinematics(m, start(m), over="rod.angle", range=(0, 1)),
    ),
    "range": (
        "range = [first, last]",
        lambda m: kp.kinematics(m, start(m), over="rod.angle", range=[0, 1]),
    ),
    "past": (
        "at least 1 s",
        lambda m: kp.dynamics(m, kp.dynamics(m, start(m), t_end=1).final, t_end=1.5),
    ),
    "outputs": (
        "at least 1e-6 of the time",
        lambda m: kp.dynamics(m, start(m), t_end=1, output_step=1e-3),
    ),
    "method": (
        "kp.RK45(rtol=1e-6)",
        lambda m: kp.dynamics(m, start(m), t_end=1, method=kp.RK45(rtol=1e-6)),
    ),
    "undriven": (
        "add a coordinate_driver for each, or use dynamics",
        lambda m: kp.kinematics(m, turned(m), t_end=1),
    ),
    "set": ("'angle'", lambda m: kp.assemble(m, {"rod.angle": 0.1})),
    "set body": ("'rod'", lambda m: kp.assemble(m, {"rod.angle": 0.1})),
    "model": ("kp.Model(…)", kp.assemble),
    "result": ("'omega'", lambda m: start(m)["rod.omega"]),
    "joint": ("there is ground, rod, A", lambda m: start(m)["A"]),
    "time": ("choose a time within it", lambda m: kp.dynamics(m, start(m), t_end=1)(1.0)),
    "units": ("write 'mm'", lambda m: kp.units("mm")),
    "degrees": ("write 'deg'", lambda m: kp.units("deg")),
    "contradiction": ("remove one of them", turned),
}


def _case() -> kp.Case:
    return _read(f"{HEAD}\n[analyses.one]\ntype = 'dynamics'\nt_end = 0.1\n")


def _read(text: str) -> kp.Case:
    from kempe.case import parsed

    return parsed(text, "toml", "case.toml", {})


#: Names that occur twice in the lists of mistakes, by the remedy of the second one.
SECOND = {("rate", "'omega'"): "rate of a driver", ("units", "Degrees"): "degrees"}
ACTS = [
    (SECOND.get((name, str(told[0])), name), act)
    for name, act, *told in [*WORDS, *((name, act, *told) for name, act, told in VALUES)]
]


@pytest.mark.parametrize(("name", "act"), ACTS, ids=[name for name, _ in ACTS])
def test_the_remedy_of_a_message_works(name: str, act: Act) -> None:
    remedy, mended = REMEDIES[name]
    with pytest.raises((kp.KempeError, AttributeError)) as caught:
        act(pendulum())
    assert remedy in str(caught.value), str(caught.value)
    mended(pendulum())


@pytest.mark.parametrize("element", METHODS)
def test_the_suggested_argument_of_an_element_is_one_of_its_arguments(element: str) -> None:
    names = list(inspect.signature(getattr(ElementMethods, element)).parameters)[2:]
    for field in names:
        wrong = f"{field}s_" if len(field) < 3 else field[:-1] + "_" + field[-1]
        with pytest.raises(kp.ModelError) as caught:
            getattr(pendulum(), element)("new", **{wrong: 3})
        found = re.search(r"did you mean '(\w+)'", str(caught.value))
        assert found and found[1] in names, str(caught.value)


# --- files: the message names what to write -------------------------------------------------------

#: The remedy in the message, the faulty text of the file and the text after the remedy.
EDITS: dict[str, tuple[str, str, str]] = {
    "commas": ("write commas", "A = [0 0]", "A = [0, 0]"),
    "decimal comma": ("is a point", "mass = 3,5", "mass = 3.5"),
    "decimal comma in a text": ("is a point", '"0,5"', '"L1"'),
    "section": ("did you mean 'joints'", "[joint.A]", "[joints.A]"),
    "type": ("did you mean 'revolute'", '"revolut"', '"revolute"'),
    "key": ("did you mean 'damping'", "dampin =", "damping ="),
    "parameter": ("declare it in the parameters", "[parameters]", "[parameters]\nkk = 1e6"),
    "version": ("this kempe reads 1", "kempe = 9", "kempe = 1"),
    "twice": ("is given twice", "mass = 3\nmass = 4", "mass = 3"),
    "no gravity": ("a list of two numbers [x, y]", "gravity = -9.81", "gravity = [0, -9.81]"),
    "angle": ("units are separated by spaces", " deg deg", " deg"),
    "method": ("did you mean 'rk45'", '"rk54"', '"rk45"'),
    "gains": ("must be >= 0", "beta = -1", "beta = 0"),
    "analysis": ("did you mean 'dynamics'", '"dynamic"', '"dynamics"'),
    "end": ("at least 0 s", "t_end = -1", "t_end = 0.1"),
}


@pytest.mark.parametrize("name", FILES)
def test_the_remedy_for_a_file_works(name: str) -> None:
    text = FILES[name][0]
    remedy, wrong, right = EDITS[name]
    assert wrong in text
    with pytest.raises(kp.KempeError) as caught:
        _read(text).run()
    assert remedy in str(caught.value), str(caught.value)
    _read(text.replace(wrong, right).replace("t_end = 15", "t_end = 0.1")).run()


#: The same for analyses that check and run refuse.
ANALYSES: dict[str, tuple[str, str, str]] = {
    "over a rate": ("'crank.angle'", "crank.omega", "crank.angle"),
    "over an unknown quantity": ("'crank.angle'", "crankk", "crank"),
    "beyond a dead point": ("drive another coordinate", "rocker.angle", "crank.angle"),
    "without drivers": ("use dynamics", '"kinematics"', '"dynamics"'),
    "inverse without drivers": ("use dynamics", '"inverse_dynamics"', '"dynamics"'),
    "limits of a rate": ("'crank.angle'", "crank.omega", "crank.angle"),
    "parameters of a phase": ("must be > 0", "L2 = -3", "L2 = 26"),
    "equilibrium over a length": ("must be > 0", "[-1, 10]", "[9, 10]"),
    "reachable twice": ("such as crank.angle", "rocker.omega", "rocker.angle"),
    "modes with a length as input": ("parameter of forces", '["L1"]', '["k"]'),
    "a force without a value": ("a value during the whole run", '"1/t"', '"1/(1 + t)"'),
}


@pytest.mark.parametrize("name", SAME)
@pytest.mark.filterwarnings("ignore::kempe.AssemblyWarning")
def test_the_remedy_for_an_analysis_works(name: str) -> None:
    text = f"{HEAD}\n[analyses.one]\n{SAME[name]}\n"
    remedy, wrong, right = ANALYSES[name]
    assert wrong in text
    with pytest.raises(kp.KempeError) as caught:
        _read(text).run()
    assert remedy in str(caught.value), str(caught.value)
    mended = text.replace(wrong, right)
    if name == "modes with a length as input":
        both = 'type = "equilibrium"\n[analyses.two]\ntype = "modes"'
        mended = mended.replace('type = "modes"', both)
    if name == "reachable twice":  # a position, but this linkage has only one freedom
        with pytest.raises(kp.SingularityError):
            _read(mended).run()
    else:
        _read(mended).run()


# --- commands -------------------------------------------------------------------------------------

CHECK = ("check", "case.toml", "--set")
RUN = ("run", "case.toml", "--no-figures")
MEASURE = ("--measure", "C.force.max")
SWEEP = ("sweep", "case.toml", "--over", "k=1e6:2e6:2", *MEASURE)
LONE = (*SWEEP[:4], "--measure")
KINDS = ("sweep", "kinds.toml", *LONE[2:])
#: Words of the mistaken command, the remedy in its message, and the command after the remedy.
WORDS_OF: dict[str, tuple[str, tuple[str, ...]]] = {
    "run nothing.toml": ("check the name", ("check", "case.toml")),
    "run .": ("name a file in it", ("check", "case.toml")),
    "run bad.txt": ("must end in .toml or .json", ("check", "case.toml")),
    "run case.toml --set crank.mass=3": (
        "with p in [parameters]",
        ("check", "p.toml", "--set", "p=4"),
    ),
    "run case.toml --set spring.stiffness=3": (
        "make it a parameter",
        (*CHECK, "k=3"),
    ),
    "run case.toml --set kk=3": (
        "are: L1, L2, L3, G, k, c",
        (*CHECK, "k=3"),
    ),
    "run case.toml --set k": ("such as --set k=2e6", (*CHECK, "k=2e6")),
    "run case.toml --method euler": ("'rk45'", (*RUN, "--method", "rk45")),
    "run case.toml --units milimeter": ("write 'mm'", (*RUN, "--units", "mm")),
    "run case.toml --t-end -3": ("at least 0 s", (*RUN, "--t-end", "0.1")),
    "run case.toml --nonsense": ("kempe run -h", ("run", "-h")),
    "rnu case.toml": ("Did you mean 'run'", RUN),
    "sweep case.toml --over k=1:2": (
        "--over k=1e3:1e5:50:log",
        ("sweep", "case.toml", "--over", "k=1e5:1e6:2:log", "--measure", "C.force.max"),
    ),
    "sweep case.toml --over kk=1:2:3 --measure C.force.max": ("'k'", SWEEP),
    "sweep case.toml --over k=1:2:3 --measure C.force": ("write C.force.max", SWEEP),
    "sweep case.toml --over k=1:2:3 --measure max": (
        "write crank.omega.max",
        (*LONE, "crank.omega.max"),
    ),
    "sweep case.toml --over k=1:2:3 --measure pinn.max": ("crank.angle or C.force", SWEEP),
    "sweep case.toml --over k=1:2:1e9 --measure C.force.max": ("N is a whole number", SWEEP),
    "sweep case.toml --over k=1:2:3 --measure frequency[0]": (
        "--analysis NAME, of type modes",
        (*KINDS, "frequency[0]", "--analysis", "vibration"),
    ),
    "sweep case.toml --over k=1:2:3 --measure frequency": (
        "--analysis NAME, of type modes",
        (*KINDS, "frequency", "--analysis", "vibration"),
    ),
    "sweep case.toml --over k=1:2:3 --measure lower": (
        "--analysis NAME, of type limits",
        (*KINDS, "lower", "--analysis", "ends"),
    ),
    "sweep case.toml --over k=1:2:3 --measure C.foo.max": ("C.force", SWEEP),
    "sweep case.toml --over k=1:2:3 --measure max(C.force)": ("write C.force.max", SWEEP),
    "sweep case.toml --over k=1:2:3": ("measures", SWEEP),
    "sweep case.toml --over k=1:2:3 --measure C.force.max --analysis x": (
        "there is release",
        (*SWEEP, "--analysis", "release"),
    ),
    "sweep two.toml --over k=1:2:3 --measure C.force.max": (
        "--analysis NAME",
        ("sweep", "two.toml", *SWEEP[2:], "--analysis", "release"),
    ),
    "kinematics case.toml": (
        '[analyses.kinematics] with type = "kinematics"',
        ("kinematics", "driven.toml", "--no-figures"),
    ),
    "animate case.toml -o film.xyz": (".html", ("animate", "case.toml", "-o", "film.html")),
    "new nothing": ("four_bar", ("new", "four_bar")),
    "schema extra": ("kempe schema -h", ("schema",)),
}
#: The address of a scheduler cannot be mended here.
OUTSIDE = "sweep case.toml --over k=1:2:3 --measure C.force.max --scheduler nowhere"


@pytest.mark.parametrize("words", [c[0] for c in COMMANDS], ids=[" ".join(c[0]) for c in COMMANDS])
def test_the_remedy_for_a_command_works(words: tuple[str, ...], tmp_path: Path) -> None:
    if " ".join(words) == OUTSIDE:
        pytest.skip("the address is outside of kempe")
    remedy, mended = WORDS_OF[" ".join(words)]
    short = FOUR_BAR.replace("t_end = 15", "t_end = 0.1")
    (tmp_path / "case.toml").write_text(short)
    (tmp_path / "bad.txt").write_bytes(b"\xff\xfe")
    (tmp_path / "two.toml").write_text(short + '\n[analyses.rest]\ntype = "equilibrium"\n')
    kinds = '\n[analyses.vibration]\ntype = "modes"\n[analyses.ends]\ntype = "limits"\n'
    (tmp_path / "kinds.toml").write_text(f'{short}{kinds}over = "rocker.angle"\n')
    given = short.replace("mass = 3", 'mass = "p"').replace("[parameters]", "[parameters]\np = 3")
    (tmp_path / "p.toml").write_text(given)
    driven = '[drivers.motor]\ntype = "coordinate_driver"\ncoordinate = "crank.angle"\n'
    driven += 'value = "1.2 + t"\n'
    analysis = '[analyses.kinematics]\ntype = "kinematics"\nt_end = 0.1\n'
    start = HEAD.replace('"crank.angle" = "70*deg"', "")
    (tmp_path / "driven.toml").write_text(f"{start}\n{driven}{analysis}")
    ran = kempe(*words, cwd=tmp_path)
    assert ran.returncode and remedy in " ".join(ran.stderr.split()), ran.stderr
    done = kempe(*mended, cwd=tmp_path)
    assert done.returncode == 0, done.stderr


def test_every_mistake_has_a_remedy() -> None:
    assert {name for name, _ in ACTS} == set(REMEDIES)
    assert set(FILES) == set(EDITS)
    assert set(SAME) == set(ANALYSES)
    assert {" ".join(c[0]) for c in COMMANDS} == {*WORDS_OF, OUTSIDE}


def test_commands_name_their_own_options_and_formats(tmp_path: Path) -> None:
    (tmp_path / "case.toml").write_text(FOUR_BAR)
    done = kempe("sweep", "case.toml", "--over", "k=1:2:3", cwd=tmp_path)
    assert "give --measure on the command line" in done.stderr
    done = kempe("convert", "case.toml", "case.stp", cwd=tmp_path)
    assert "must be one of toml, json, asmt, dxf, fmu, xml" in done.stderr
    for ending in ("asmt", "dxf", "fmu", "xml"):
        done = kempe("convert", "case.toml", f"case.{ending}", cwd=tmp_path)
        assert "must be one of" not in done.stderr
