"""Deliberate mistakes: each message names the thing at fault and a remedy, without a traceback."""
# ruff: noqa: ARG005, PLW0108 - each mistake is an act on a model

import inspect
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import kempe as kp
import pytest
from command_line import kempe
from house.places import ROOT
from kempe.analyses import options
from kempe.analyses.option import Analysis, Option
from kempe.model.elements import ElementMethods

FOUR_BAR = (ROOT / "examples" / "four_bar.toml").read_text("utf-8")
HEAD = FOUR_BAR.partition("[analyses.release]")[0]
#: Words of a remedy.
REMEDY = re.compile(
    r"did you mean|must be|the \w[\w ]* are|there (is|are)|it may (be|have)|write |use |give |"
    r"name |add |remove |make |check |correct|choose|declare|save it|needs|cannot|belongs in|"
    r"point|missing",
)


def pendulum(**more: Any) -> kp.Model:
    m = kp.Model("pendulum", gravity=(0, -9.81), **more)
    m.ground.points(O=(0, 0))
    m.bar("rod", mass=1, length=1, ends=("A", "B"))
    m.revolute("A", "ground.O", "rod.A")
    return m


def start(m: kp.Model) -> kp.State:
    return kp.assemble(m, {"rod.angle": 0.1})


def checked(message: str, *told: str) -> None:
    for text in told:
        assert text in message, message
    assert REMEDY.search(message), message
    assert len(message) < 1200, message


# --- elements and options: the same mistake in each -----------------------------------------------

METHODS = [
    name
    for name, method in vars(ElementMethods).items()
    if not name.startswith("_") and callable(method)
]
OPTIONS = [
    one
    for one in vars(options).values()
    if inspect.isclass(one)
    and issubclass(one, (Option, Analysis))
    and one.__module__ == options.__name__
]


@pytest.mark.parametrize("element", METHODS)
def test_an_unknown_argument_of_an_element_is_named(element: str) -> None:
    with pytest.raises(kp.ModelError) as caught:
        getattr(pendulum(), element)("new", nonsense_of_mine=3)
    assert isinstance(caught.value, TypeError)
    checked(str(caught.value), element, "'nonsense_of_mine'", "the arguments are name, ")


@pytest.mark.parametrize("element", METHODS)
def test_a_misspelt_argument_of_an_element_is_suggested(element: str) -> None:
    field = list(inspect.signature(getattr(ElementMethods, element)).parameters)[-1]
    wrong = f"{field}s_" if len(field) < 3 else field[:-1] + "_" + field[-1]
    with pytest.raises(kp.ModelError) as caught:
        getattr(pendulum(), element)("new", **{wrong: 3})
    checked(str(caught.value), element, repr(wrong), f"did you mean {field!r}")


@pytest.mark.parametrize("element", METHODS)
def test_an_unknown_field_of_an_element_in_a_file_is_named(element: str) -> None:
    section = {"joints": [], "drivers": [], "forces": []}
    for kind in section:
        text = f"{HEAD}\n[{kind}.new]\ntype = '{element}'\nnonsense_of_mine = 3\n"
        with pytest.raises(kp.KempeError) as caught:
            _parsed(text)
        checked(str(caught.value), f"{kind}.new", "line ")


def _parsed(text: str) -> kp.Case:
    from kempe.case import parsed

    return parsed(text, "toml", "case.toml", {})


@pytest.mark.parametrize("option", OPTIONS, ids=lambda option: option.__name__)
def test_an_unknown_argument_of_an_option_is_named(option: type) -> None:
    with pytest.raises(kp.ModelError) as caught:
        option(nonsense_of_mine=3)
    assert option.__name__ in str(caught.value) and "'nonsense_of_mine'" in str(caught.value)


# --- words of other programs ----------------------------------------------------------------------

WORDS: list[tuple[str, Callable[[kp.Model], object], str, str]] = [
    ("hinge", lambda m: m.hinge, "'hinge'", "'revolute'"),  # type: ignore[attr-defined]
    ("prismatic", lambda m: m.prismatic, "'prismatic'", "'translational'"),  # type: ignore[attr-defined]
    ("rsda", lambda m: m.RSDA, "'RSDA'", "'torsion_spring'"),  # type: ignore[attr-defined]
    ("fixed", lambda m: m.fixed, "'fixed'", "'weld'"),  # type: ignore[attr-defined]
    ("revolut", lambda m: m.revolut, "'revolut'", "'revolute'"),  # type: ignore[attr-defined]
    ("simulate", lambda m: kp.simulate(m), "'simulate'", "'dynamics'"),  # type: ignore[attr-defined]
    ("linearize", lambda m: kp.linearize(m), "'linearize'", "'modes'"),  # type: ignore[attr-defined]
    ("kinematic", lambda m: kp.kinematic(m), "'kinematic'", "'kinematics'"),  # type: ignore[attr-defined]
    ("dt", lambda m: kp.dynamics(m, start(m), t_end=1, dt=0.1), "'dt'", "'output_step'"),  # type: ignore[call-arg]
    ("tf", lambda m: kp.dynamics(m, start(m), tf=1), "'tf'", "'t_end'"),  # type: ignore[call-arg]
    ("k", lambda m: m.torsion_spring("s", "ground", "rod", k=3), "'k'", "'stiffness'"),  # type: ignore[call-arg]
    ("c", lambda m: m.torsion_spring("s", "ground", "rod", stiffness=3, c=3), "'c'", "'damping'"),  # type: ignore[call-arg]
    ("l0", lambda m: m.spring_damper("s", "ground.O", "rod.B", l0=3), "'l0'", "'free_length'"),  # type: ignore[call-arg]
    ("m", lambda m: m.bar("r", m=3), "'m'", "'mass'"),  # type: ignore[call-arg]
    ("I", lambda m: m.body("r", mass=3, I=3), "'I'", "'inertia'"),  # type: ignore[call-arg]
    ("g", lambda m: kp.Model("x", g=9.81), "'g'", "'gravity'"),  # type: ignore[call-arg]
    ("step", lambda m: kp.RK4(dt=0.1), "'dt'", "'step'"),  # type: ignore[call-arg]
    ("gain", lambda m: kp.Baumgarte(gain=3), "'gain'", "'alpha' or 'beta'"),  # type: ignore[call-arg]
    ("rate", lambda m: kp.assemble(m, {"rod.angle": 0.1}, rate={}), "'rate'", "'set'"),  # type: ignore[call-arg]
    ("parameter", lambda m: m.parameter("k", 2), "'parameter'", "kp.Model(parameters={'k': 2})"),  # type: ignore[attr-defined]
    ("missing", lambda m: m.revolute("B", "ground.O"), "revolute: missing", "'j'"),  # type: ignore[call-arg]
    ("save", lambda m: kp.load(ROOT / "examples/four_bar.toml").run(dt=1), "'dt'", "progress"),  # type: ignore[call-arg]
    ("view", lambda m: start(m)["A"].force(body="rod"), "'body'", "on, frame, about"),
    ("solution", lambda m: start(m).joint("A").torque(), "torque: missing", "on"),  # type: ignore[call-arg]
    (
        "event",
        lambda m: kp.Event("rod.angle", terminal=True),
        "'terminal'",
        "condition, direction, stop",
    ),
    ("many", lambda m: m.bar("r", 1, 2, 3, 4, 5), "bar: too many", "the arguments are"),  # type: ignore[call-arg]
]


@pytest.mark.parametrize(
    ("act", "thing", "remedy"), [w[1:] for w in WORDS], ids=[w[0] for w in WORDS]
)
def test_a_word_of_another_program_is_translated(
    act: Callable[[kp.Model], object], thing: str, remedy: str
) -> None:
    with pytest.raises((kp.ModelError, AttributeError)) as caught:
        act(pendulum())
    checked(str(caught.value), thing, remedy)


# --- values ---------------------------------------------------------------------------------------

VALUES: list[tuple[str, Callable[[kp.Model], object], tuple[str, ...]]] = [
    (
        "body",
        lambda m: m.revolute("B", "ground.O", "rodd.B") and m.compile(),
        ("joints.B.j", "'rod'"),
    ),
    ("point", lambda m: m.revolute("B", "ground.P", "rod.B") and m.compile(), ("joints.B.i",)),
    (
        "frame",
        lambda m: m.force("F", j="rod.B", force=(1, 0), frame="local") and m.compile(),
        ("'local'", "'i' or 'j'"),
    ),
    (
        "negative mass",
        lambda m: m.bar("r", mass=-1, length=1, ends=("A", "B")) and m.compile(),
        ("bodies.r.mass",),
    ),
    (
        "unit",
        lambda m: m.bar("r", mass="1 s", length=1, ends=("A", "B")) and m.compile(),
        ("bodies.r.mass",),
    ),
    (
        "unit as a factor",
        lambda m: m.bar("r", mass="2*kg", length=1, ends=("A", "B")) and m.compile(),
        ("bodies.r.mass", "'kg'", "'2 kg'"),
    ),
    (
        "tonne",
        lambda m: m.bar("r", mass="2*t", length=1, ends=("A", "B")) and m.compile(),
        ("bodies.r.mass", "the time t", "'2 tonne'"),
    ),
    (
        "name",
        lambda m: m.torque("T", j="rod", torque="foo*2") and m.compile(),
        ("'foo'", "forces.T", "declare it in the parameters"),
    ),
    ("formula", lambda m: m.torque("T", j="rod", torque="2*(3") and m.compile(), ("forces.T",)),
    (
        "rate",
        lambda m: m.coordinate_driver("D", coordinate="rod.omega", value="2*t") and m.compile(),
        ("'omega'", "'rod.angle'", "2*t"),
    ),
    (
        "coordinate",
        lambda m: m.coordinate_driver("D", coordinate="rod.angel", value="2*t") and m.compile(),
        ("'angel'", "'angle'"),
    ),
    (
        "over",
        lambda m: kp.kinematics(m, start(m), over="rod.omega", range=(0, 1)),
        ("'omega'", "'rod.angle'"),
    ),
    ("range", lambda m: kp.kinematics(m, start(m), over="rod.angle"), ("range", "missing")),
    (
        "past",
        lambda m: kp.dynamics(m, kp.dynamics(m, start(m), t_end=1).final, t_end=0.5),
        ("t_end", "at least 1 s"),
    ),
    ("outputs", lambda m: kp.dynamics(m, start(m), t_end=1, output_step=1e-9), ("output_step",)),
    ("method", lambda m: kp.dynamics(m, start(m), t_end=1, method="rk54"), ("'rk54'",)),
    ("undriven", lambda m: kp.kinematics(m, start(m), t_end=1), ("1 degree of freedom", "driver")),
    ("set", lambda m: kp.assemble(m, {"rod.angel": 0.1}), ("'angel'",)),
    ("set body", lambda m: kp.assemble(m, {"rood.angle": 0.1}), ("'rood'", "'rod'")),
    ("model", lambda m: kp.assemble("model.toml"), ("model",)),  # type: ignore[arg-type]
    ("result", lambda m: kp.dynamics(m, start(m), t_end=1)["rod.omgea"], ("omgea", "omega")),
    ("joint", lambda m: kp.dynamics(m, start(m), t_end=1)["Q"], ("'Q'",)),
    ("time", lambda m: kp.dynamics(m, start(m), t_end=1)(2.0), ("t = 2 s", "outside")),
    ("units", lambda m: kp.units("milimeter"), ("milimeter", "write 'mm'")),
    ("units", lambda m: kp.units("Degrees"), ("Degrees", "write 'deg'")),
    ("contradiction", lambda m: kp.assemble(_twice(m)), ("D", "E", "would have to change by")),
]


def _twice(m: kp.Model) -> kp.Model:
    m.coordinate_driver("D", coordinate="rod.angle", value="0.1")
    m.coordinate_driver("E", coordinate="rod.angle", value="0.3")
    return m


@pytest.mark.parametrize(("act", "told"), [v[1:] for v in VALUES], ids=[v[0] for v in VALUES])
def test_a_wrong_value_is_named(act: Callable[[kp.Model], object], told: tuple[str, ...]) -> None:
    with pytest.raises(kp.KempeError) as caught:
        act(pendulum())
    message = str(caught.value)
    for text in told:
        assert text in message, message


# --- files and commands ---------------------------------------------------------------------------

FILES: dict[str, tuple[str, tuple[str, ...]]] = {
    "commas": (FOUR_BAR.replace("A = [0, 0]", "A = [0 0]"), ("'0 0'", "commas", "line 14")),
    "decimal comma": (
        FOUR_BAR.replace("mass = 3", "mass = 3,5"),
        ("decimal mark is a point", "line 18"),
    ),
    "decimal comma in a text": (FOUR_BAR.replace('"L1"', '"0,5"'), ("decimal mark is a point",)),
    "section": (FOUR_BAR.replace("[joints.A]", "[joint.A]"), ("'joint'", "'joints'")),
    "type": (FOUR_BAR.replace('"revolute"', '"revolut"', 1), ("'revolut'", "'revolute'")),
    "key": (FOUR_BAR.replace("damping", "dampin"), ("dampin", "damping")),
    "parameter": (FOUR_BAR.replace('"k"', '"kk"'), ("'kk'",)),
    "version": (FOUR_BAR.replace("kempe = 1 ", "kempe = 9 "), ("9",)),
    "twice": (FOUR_BAR.replace("mass = 3", "mass = 3\nmass = 4"), ("mass",)),
    "empty": ("", ("bodies",)),
    "no gravity": (FOUR_BAR.replace("[0, -9.81]", "-9.81"), ("gravity",)),
    "angle": (FOUR_BAR.replace("70*deg", "70 deg deg"), ("write", "deg*deg")),
    "method": (FOUR_BAR.replace('"rk45"', '"rk54"'), ("'rk54'", "'rk45'")),
    "gains": (FOUR_BAR.replace("beta = 200", "beta = -1"), ("beta", ">= 0")),
    "analysis": (FOUR_BAR.replace('"dynamics"', '"dynamic"'), ("'dynamic'", "'dynamics'")),
    "end": (FOUR_BAR.replace("t_end = 15", "t_end = -1"), ("t_end",)),
}
FILES = {name: (text, told) for name, (text, told) in FILES.items() if name != "empty"}


@pytest.mark.parametrize(("text", "told"), FILES.values(), ids=FILES.keys())
def test_a_wrong_file_is_refused_by_check_and_run(
    text: str, told: tuple[str, ...], tmp_path: Path
) -> None:
    (tmp_path / "case.toml").write_text(text)
    for command in ("check", "run"):
        ran = kempe(command, "case.toml", cwd=tmp_path)
        assert ran.returncode == 2, ran.stderr
        assert "Traceback" not in ran.stderr and "case.toml" in ran.stderr
        for word in told:
            assert word in ran.stderr, ran.stderr


SAME = {
    "over a rate": 'type = "kinematics"\nover = "crank.omega"\nrange = [0, 1]',
    "over an unknown quantity": 'type = "kinematics"\nover = "crankk.angle"\nrange = [0, 1]',
    "beyond a dead point": 'type = "kinematics"\nover = "rocker.angle"\nrange = [7, 8]',
    "without drivers": 'type = "kinematics"\nt_end = 1',
    "inverse without drivers": 'type = "inverse_dynamics"\nt_end = 1',
    "limits of a rate": 'type = "limits"\nover = "crank.omega"',
    "parameters of a phase": 'type = "dynamics"\nt_end = 1\nparameters = { L2 = -3 }',
    "equilibrium over a length": 'type = "equilibrium"\nover = "L1"\nrange = [-1, 10]',
    "reachable twice": (
        'type = "reachable"\nof = "coupler.C"\nover = ["crank.angle", "rocker.omega"]\n'
        "ranges = [[0, 1], [0, 1]]"
    ),
    "modes with a length as input": 'type = "modes"\ninputs = ["L1"]',
    "a force without a value": 'type = "dynamics"\nt_end = 1\n[forces.F]\ntype = "torque"\nj = "rocker"\ntorque = "1/t"',  # noqa: E501
}


@pytest.mark.parametrize("analysis", SAME.values(), ids=SAME.keys())
def test_check_refuses_what_run_refuses(analysis: str, tmp_path: Path) -> None:
    (tmp_path / "case.toml").write_text(f"{HEAD}\n[analyses.one]\n{analysis}\n")
    ran, checked = (kempe(word, "case.toml", cwd=tmp_path) for word in ("run", "check"))
    assert ran.returncode in (2, 3), ran.stderr
    assert checked.returncode == ran.returncode, checked.stderr
    told = [one.stderr.split("error: ")[1].splitlines()[0] for one in (ran, checked)]
    assert told[0][:60] == told[1][:60] or all("length: -" in one for one in told), told


COMMANDS: list[tuple[tuple[str, ...], int, tuple[str, ...]]] = [
    (("run", "nothing.toml"), 4, ("nothing.toml", "check the name")),
    (("run", "."), 4, ("folder",)),
    (("run", "bad.txt"), 4, ("bad.txt",)),
    (("run", "case.toml", "--set", "crank.mass=3"), 2, ("crank.mass", "make it a parameter")),
    (("run", "case.toml", "--set", "spring.stiffness=3"), 2, ("make it a parameter",)),
    (("run", "case.toml", "--set", "kk=3"), 2, ("'kk'", "the parameters are")),
    (("run", "case.toml", "--set", "k"), 2, ("NAME=VALUE",)),
    (("run", "case.toml", "--method", "euler"), 2, ("euler", "rk45")),
    (("run", "case.toml", "--units", "milimeter"), 2, ("milimeter",)),
    (("run", "case.toml", "--t-end", "-3"), 2, ("t_end",)),
    (("run", "case.toml", "--nonsense"), 2, ("--nonsense",)),
    (("rnu", "case.toml"), 2, ("rnu",)),
    (("sweep", "case.toml", "--over", "k=1:2"), 2, ("NAME=FROM:TO:N",)),
    (("sweep", "case.toml", "--over", "kk=1:2:3", "--measure", "C.force.max"), 2, ("'kk'",)),
    (
        ("sweep", "case.toml", "--over", "k=1:2:3", "--measure", "C.force"),
        2,
        ("C.force", "write C.force.max"),
    ),
    (("sweep", "case.toml", "--over", "k=1:2:3", "--measure", "C.foo.max"), 2, ("foo",)),
    (
        ("sweep", "case.toml", "--over", "k=1:2:3", "--measure", "max(C.force)"),
        2,
        ("write C.force.max",),
    ),
    *(
        (("sweep", "case.toml", "--over", f"k=1:2:{n}", "--measure", measure), 2, told)
        for n, measure, told in (
            ("3", "frequency[0]", ("not a number of a motion", "--analysis NAME, of type modes")),
            ("3", "frequency", ("'frequency' is not a number", "of type modes")),
            ("3", "lower", ("of type limits",)),
            ("3", "max", ("QUANTITY.STATISTIC", "write crank.omega.max")),
            ("3", "pinn.max", ("unknown measure 'pinn'", "such as crank.angle")),
            ("1e9", "C.force.max", ("k=1:2:1e9", "N is a whole number")),
        )
    ),
    (("sweep", "case.toml", "--over", "k=1:2:3"), 2, ("measures",)),
    (
        ("sweep", "case.toml", "--over", "k=1:2:3", "--measure", "C.force.max", "--analysis", "x"),
        2,
        ("'x'", "release"),
    ),
    (
        ("sweep", "two.toml", "--over", "k=1:2:3", "--measure", "C.force.max"),
        2,
        ("equilibrium", "--analysis"),
    ),
    (
        (
            "sweep",
            "case.toml",
            "--over",
            "k=1:2:3",
            "--measure",
            "C.force.max",
            "--scheduler",
            "nowhere",
        ),
        2,
        ("Dask", "check the address"),
    ),
    (("kinematics", "case.toml"), 2, ("kinematics", "add one")),
    (("animate", "case.toml", "-o", "film.xyz"), 2, ("film.xyz",)),
    (("new", "nothing"), 2, ("nothing",)),
    (("schema", "extra"), 2, ("extra",)),
]


@pytest.mark.parametrize(
    ("words", "code", "told"), COMMANDS, ids=[" ".join(c[0]) for c in COMMANDS]
)
def test_a_wrong_command_is_refused(
    words: tuple[str, ...], code: int, told: tuple[str, ...], tmp_path: Path
) -> None:
    (tmp_path / "case.toml").write_text(FOUR_BAR)
    (tmp_path / "bad.txt").write_bytes(b"\xff\xfe")
    (tmp_path / "two.toml").write_text(FOUR_BAR + '\n[analyses.rest]\ntype = "equilibrium"\n')
    ran = kempe(*words, cwd=tmp_path)
    assert ran.returncode == code, ran.stdout + ran.stderr
    assert "Traceback" not in ran.stderr
    for word in told:
        assert word in ran.stderr, ran.stderr


def test_there_are_a_hundred_mistakes() -> None:
    each = 3 * len(METHODS) + len(OPTIONS)
    assert each + len(WORDS) + len(VALUES) + len(FILES) + len(SAME) + len(COMMANDS) >= 160
