"""Errors of the core keep their attributes in Python, and a panic raises InternalError."""

import pickle
import re
from collections.abc import Callable

import kempe
import numpy as np
import pytest
from house.places import ROOT
from kempe import _core
from kempe.errors import IntegrationError, InternalError, KempeError, ModelError, Problem

CLASSES = [
    "ModelError",
    "AssemblyError",
    "RedundancyError",
    "SingularityError",
    "IntegrationError",
    "FileError",
    "InternalError",
]

#: A call of each guarded entry point. The panic occurs before the arguments are used, so only their
#: types matter.
TURN = 2.0 * np.pi
CASE = _core.Case((ROOT / "examples/four_bar.toml").read_text("utf-8"), "toml", None)
MODEL = CASE.model("{}")
T, Q, V, Z, _ = _core.assemble(MODEL, '{"crank.angle": "70*deg"}', "{}", 0.0, None, None, None)
TIMES, ROW, STATES, LAM = np.array([T]), Q[None, :], Z[None, :], np.zeros((1, 8))
WORKS, FOURS, POSES = np.zeros((1, 3)), np.zeros((0, 4)), np.zeros((1, 3, 3))
AT_ONCE = _core.States(MODEL, TIMES, ROW, ROW, STATES, ROW, LAM)
OPTIONS = '{"type": "dynamics", "t_end": 0.01}'
AT = (T, Q, V, Z)
RECORD = _core.run_analysis(MODEL, OPTIONS, AT, [], None)
STEPPED = _core.SteppedRun(MODEL, OPTIONS, AT, [])
RUN = RECORD.run
assert RUN is not None
CAM = kempe.design.cam(
    "knife", [("rise", 3, 1, "cycloidal"), ("return", TURN - 3, "poly345")], base_radius=1
)

CALLS: dict[str, Callable[[], object]] = {
    "version": _core.version,
    "instructions": _core.instructions,
    "supports_v3": _core.supports_v3,
    "catalogue": _core.catalogue,
    "schema": _core.schema,
    "is_reserved": lambda: _core.is_reserved("t"),
    "Case": lambda: _core.Case("kempe = 1", "toml", None),
    "Case.tree": CASE.tree,
    "Case.variant": lambda: CASE.variant(1, []),
    "Case.write": lambda: CASE.write("json"),
    "Case.model": lambda: CASE.model("{}"),
    "Case.place": lambda: CASE.place("joints.A"),
    "Case.supply": lambda: CASE.supply("lift", ROW[0], ROW[0]),
    "Case.check": lambda: CASE.check(MODEL),
    "Case.analyses": CASE.analyses,
    "Model.describe": MODEL.describe,
    "Model.variant": lambda: MODEL.variant([], [], []),
    "Model.symbols": MODEL.symbols,
    "Model.table": lambda: MODEL.table("lift", 0, ROW[0]),
    "Model.allowing_redundancy": MODEL.allowing_redundancy,
    "run_analysis": lambda: _core.run_analysis(MODEL, OPTIONS, AT, [], None),
    "driven_by": lambda: _core.driven_by(MODEL, "crank.angle", AT, []),
    "assemble": lambda: _core.assemble(MODEL, "{}", "{}", 0.0, Q, V, Z),
    "rate_unit": lambda: _core.rate_unit("m/s", "rad"),
    "line_at": lambda: _core.line_at(MODEL, "C", "rocker"),
    "transmitting": lambda: _core.transmitting(MODEL),
    "compliance": lambda: _core.compliance(MODEL, T, Q, V, Z, "rocker.C", ["crank.angle"]),
    "dyad_conditions": lambda: _core.dyad_conditions([(0.0, 0.0)], [0.0]),
    "all_dyads": lambda: _core.all_dyads([], 0, None, 1, 0, ["pin"], "pose"),
    "dyads_with_end": lambda: _core.dyads_with_end([], "pin", []),
    "pairs_of_dyads": lambda: _core.pairs_of_dyads(2, None, 0),
    "four_bars": lambda: _core.four_bars([(0.0, 0.0), (1.0, 0.0)], [0.0, 1.0], (None, None), 1, 0),
    "ranked_linkages": lambda: _core.ranked_linkages(
        np.zeros((0, 8)), [], False, (False, None, None, None, 0), False, False
    ),
    "path_four_bars": lambda: _core.path_four_bars(
        [(0.0, 0.0), (1.0, 0.0)], [], True, (None, None), 1, 0, None
    ),
    "nine_point_four_bars": lambda: _core.nine_point_four_bars([], b"", None),
    "near_poses": lambda: _core.near_poses([(0.0, 0.0)], [0.0], (None, None), np.zeros((0, 8))),
    "fit_pairs": lambda: _core.fit_pairs([], 1.0, [], [], [], 1),
    "cam_laws": _core.cam_laws,
    "cam_programme": lambda: _core.cam_programme([], False),
    "cam_lift": lambda: _core.cam_lift(CAM.programme, TIMES, 0),
    "cam_sampled": lambda: _core.cam_sampled(CAM.programme, 1.0),
    "cam_check": lambda: _core.cam_check(CAM),
    "cam_angles": lambda: _core.cam_angles(CAM),
    "cam_shape": lambda: _core.cam_shape(CAM, TIMES, False),
    "cam_limits": lambda: _core.cam_limits(CAM),
    "cam_least_base": lambda: _core.cam_least_base(CAM, None, 0.0),
    "cam_remarks": lambda: _core.cam_remarks(CAM),
    "cam_case": lambda: _core.cam_case(CAM),
    "cam_walls": lambda: _core.cam_walls(CAM, TIMES, None),
    "Record.number": lambda: RECORD.number("count"),
    "Run.responses": RUN.responses,
    "Run.energies": RUN.energies,
    "SteppedRun": lambda: _core.SteppedRun(MODEL, OPTIONS, AT, []),
    "SteppedRun.step": lambda: STEPPED.step(0.01),
    "SteppedRun.set": lambda: STEPPED.set([]),
    "SteppedRun.save": STEPPED.save,
    "SteppedRun.restore": lambda: STEPPED.restore(STEPPED.save()),
    "SteppedRun.last_part": STEPPED.last_part,
    "measure": lambda: _core.measure(MODEL, "C.force"),
    "measure_values": lambda: _core.measure_values(MODEL, "C.force", TIMES, ROW[:, :1]),
    "measure_slopes": lambda: _core.measure_slopes(MODEL, ["t"], ROW[0]),
    "instants": lambda: _core.instants(np.arange(2.0), TIMES, 9),
    "interpolate": lambda: _core.interpolate(
        np.arange(2.0), np.zeros((1, 2)), np.zeros((1, 2, 4)), TIMES
    ),
    "maxima": lambda: _core.maxima(TIMES, TIMES, [], TIMES, True, lambda t: t),
    "singular_instants": lambda: _core.singular_instants(TIMES, TIMES, lambda t: t),
    "extreme": lambda: _core.extreme(1.0, TIMES, TIMES),
    "changes": lambda: _core.changes(TIMES),
    "integrals": lambda: _core.integrals(TIMES, TIMES),
    "row_norms": lambda: _core.row_norms(ROW),
    "settling": lambda: _core.settling(TIMES, TIMES),
    "sweeps": lambda: _core.sweeps(MODEL, ["max"], True, False),
    "sweep": lambda: _core.sweep(
        MODEL, "{}", "{}", '{"type": "dynamics", "t_end": 1}', [], [], [], [], np.zeros((0, 0)), 1
    ),
    "gradient": lambda: _core.gradient(
        MODEL, "{}", "{}", '{"type": "dynamics", "t_end": 1}', [], [], [], [], ROW[0, :0]
    ),
    "slopes_at": lambda: _core.slopes_at(
        MODEL, "{}", "{}", '{"type": "dynamics", "t_end": 1}', [], TIMES, [], [], ROW[0, :0]
    ),
    "exchange_dxf": lambda: _core.exchange_dxf(1.0, [], [], []),
    "exchange_formats": _core.exchange_formats,
    "exchange_format": lambda: _core.exchange_format("Assembly"),
    "exchange_read": lambda: _core.exchange_read("Assembly", "asmt"),
    "formula_names": lambda: _core.formula_names("a + 2*b"),
    "formula_unit": lambda: _core.formula_unit("a + 2*b", ["a", "b"], ["m", "m"]),
    "formula_value": lambda: _core.formula_value("a + 2*b", ["a", "b"], [1.0, 2.0]),
    "States": lambda: _core.States(MODEL, TIMES, ROW, ROW, STATES),
    "States.evaluate": lambda: AT_ONCE.evaluate(False),
    "States.project": lambda: AT_ONCE.project(1e-12),
    "States.energies": lambda: AT_ONCE.energies(WORKS),
    "States.residual": AT_ONCE.residual,
    "States.measured": lambda: AT_ONCE.measured("C"),
    "States.reaction": lambda: AT_ONCE.reaction("C", "rocker", "global"),
    "States.impulse": lambda: AT_ONCE.impulse("C", "rocker"),
    "States.place": lambda: AT_ONCE.place("C", "rocker"),
    "States.results": lambda: AT_ONCE.results("C"),
    "States.force": lambda: AT_ONCE.force("spring", "rocker", None, "global"),
    "States.force_place": lambda: AT_ONCE.force_place("spring", "rocker"),
    "States.force_results": lambda: AT_ONCE.force_results("spring"),
    "States.force_energy": lambda: AT_ONCE.force_energy("spring"),
    "States.newton_euler": AT_ONCE.newton_euler,
    "States.friction_modes": AT_ONCE.friction_modes,
    "States.friction_range": lambda: AT_ONCE.friction_range(True),
    "States.not_unique": AT_ONCE.not_unique,
    "States.measure": lambda: AT_ONCE.measure("crank.x"),
    "matrices": lambda: _core.matrices(MODEL, T, Q, V, Z, "{}"),
    "formulas": lambda: _core.formulas(MODEL, "C", {}, "latex"),
    "scene": lambda: _core.scene(MODEL, POSES, []),
    "display": lambda: _core.display("{}", POSES, ((0.0, 0.0), 1.0, (1.0, 1.0)), "{}"),
    "view_around": lambda: _core.view_around((0.0, 0.0, 1.0, 1.0), (4.0, 3.0)),
    "place_texts": lambda: _core.place_texts(ROW[:, :2], ROW[:, :2], FOURS, FOURS, (1.0, 1.0)),
    "text_width": lambda: _core.text_width("A", 9.0, False),
    "_raise": lambda: _core._raise("ModelError", "wrong"),
}


def test_the_set_of_errors_is_closed() -> None:
    assert sorted(kind.__name__ for kind in KempeError.__subclasses__()) == sorted(CLASSES)


@pytest.mark.parametrize("name", CLASSES)
def test_an_error_of_the_core_keeps_its_attributes(name: str) -> None:
    with pytest.raises(getattr(kempe, name)) as caught:
        _core._raise(name, "what is wrong")
    error = caught.value
    assert type(error).__name__ == name
    assert (error.name, error.t, error.hint) == ("crank", 1.5, "do this")
    assert error.problems == (Problem("not a number", "bodies.crank.mass", 7, 8),)
    assert str(error) == "what is wrong; do this"
    assert getattr(error, "solution", None) == (() if name == "IntegrationError" else None)


def test_an_error_survives_pickling() -> None:
    error = IntegrationError(
        "stuck", name="crank", t=2.0, hint="a", problems=(Problem("b"),), solution=3
    )
    copy = pickle.loads(pickle.dumps(error))
    assert (type(copy), copy.args, vars(copy)) == (IntegrationError, ("stuck",), vars(error))


@pytest.mark.parametrize(
    ("problem", "text"),
    [
        (Problem("must be > 0"), "must be > 0"),
        (Problem("must be > 0", "bodies.crank.mass"), "bodies.crank.mass: must be > 0"),
        (Problem("must be > 0", "bodies.crank.mass", 7), "bodies.crank.mass: must be > 0 (line 7)"),
        (Problem("not TOML", line=7, column=8), "not TOML (line 7, column 8)"),
    ],
)
def test_a_problem_gives_its_position(problem: Problem, text: str) -> None:
    assert str(problem) == text


def test_every_function_and_method_of_the_core_is_in_the_list_of_calls() -> None:
    public = {name: entry for name, entry in vars(_core).items() if not name.startswith("_")}
    classes = {name: entry for name, entry in public.items() if isinstance(entry, type)}
    methods = {
        f"{name}.{method}"
        for name, entry in classes.items()
        for method, member in vars(entry).items()
        if not method.startswith("_") and callable(member)
    }
    made_by_python = {"Case", "States", "SteppedRun", "_raise"}
    assert set(CALLS) == (public.keys() - classes.keys()) | methods | made_by_python


def test_every_guard_in_the_sources_is_in_the_list_of_calls() -> None:
    text = "".join(path.read_text("utf-8") for path in (ROOT / "bindings").rglob("*.rs"))
    code = re.sub(r"//[^\n]*", "", text)
    assert sorted(re.findall(r'\bguard\(\s*"([\w.]+)"', code)) == sorted(CALLS)


@pytest.mark.parametrize("entry", sorted(CALLS))
def test_a_panic_is_an_internal_error(entry: str, capfd: pytest.CaptureFixture[str]) -> None:
    _core._inject_panic(entry)
    with pytest.raises(InternalError, match=rf"^{entry}: injected panic in '{entry}' \(.+:\d+\)"):
        CALLS[entry]()
    assert capfd.readouterr() == ("", "")


def test_a_panic_affects_one_call_only() -> None:
    _core._inject_panic("version")
    with pytest.raises(ModelError):
        CALLS["_raise"]()
    with pytest.raises(InternalError):
        _core.version()
    assert _core.version() == kempe.__version__


def test_an_injected_panic_can_be_cancelled() -> None:
    _core._inject_panic("version")
    _core._inject_panic(None)
    assert _core.version() == kempe.__version__
