"""Matrices with names, and the equations as formulas, held against the numbers of the core."""

import csv
import io
import itertools
import json
import re
from pathlib import Path
from typing import Any

import kempe as kp
import numpy as np
import pytest
import sympy
from kempe import _core
from kempe.analyses.iterations import iterations
from kempe.cli import main
from kempe.results.matrices.equations import Equations
from numpy.testing import assert_allclose

REFERENCE = json.loads(
    (Path(__file__).parents[1] / "reference" / "four_bar.json").read_text(encoding="utf-8")
)


def test_the_jacobian_of_the_assembly_is_the_published_one(start: kp.State) -> None:
    shown = kp.show(start.model, start, "Phi_q", assembly={"crank.angle": "70*deg"})
    assert shown.values.shape == (9, 9)
    assert shown.rows == (*(f"{j}.{c}" for j in "ABCD" for c in "xy"), "set.crank.angle")
    assert shown.columns[:3] == ("crank.x", "crank.y", "crank.angle")
    # three digits were published
    assert_allclose(shown.values[:8], REFERENCE["Phi_q_at_start_rounded"], atol=0.05)
    assert_allclose(shown.values[8], np.eye(9)[2])


def test_multipliers_carry_the_names_of_their_equations(start: kp.State) -> None:
    shown = kp.show(start.model, start, "lam")
    assert_allclose(shown.values, REFERENCE["start"]["lam"], rtol=1e-9)
    lines = dict(line.split(maxsplit=1) for line in shown.text().splitlines())
    assert float(lines["C.x"]) == pytest.approx(REFERENCE["start"]["lam"][4], rel=1e-5)


@pytest.mark.parametrize("what", ["M", "Phi", "Phi_q", "nu", "gamma", "Q", "kkt", "rhs", "a"])
def test_every_matrix_is_written_in_three_ways(start: kp.State, what: str) -> None:
    shown = kp.show(start.model, start, what)
    full = shown.values.reshape(len(shown.rows), -1)
    header, *lines = csv.reader(io.StringIO(shown.csv()))
    assert len(header) == full.shape[1] + 1
    np.testing.assert_array_equal([[float(x) for x in line[1:]] for line in lines], full)
    assert [line[0] for line in lines] == list(shown.rows)
    text = shown.text().splitlines()[bool(shown.columns) :]
    assert [line.split("  ")[0].strip() for line in text] == list(shown.rows)
    cells = [0.0 if c == "·" else float(c) for line in text for c in line.split()[1:]]
    if what != "kkt":
        assert_allclose(np.array(cells).reshape(full.shape), full, atol=1e-4 * abs(full).max())
    tex = shown.latex()
    assert tex.count("\\begin{") == tex.count("\\end{")
    body = tex.split("\\begin{bmatrix}")[-1].split("\\end{bmatrix}")[0]
    assert body.count("&") == full.shape[0] * (full.shape[1] - 1)
    assert all(f"\\text{{{row}}}" in tex for row in shown.rows)


def test_the_augmented_matrix_solves_for_accelerations_and_multipliers(start: kp.State) -> None:
    kkt, rhs = (np.asarray(kp.show(start.model, start, what)) for what in ("kkt", "rhs"))
    a, lam = (np.asarray(kp.show(start.model, start, what)) for what in ("a", "lam"))
    assert_allclose(np.linalg.solve(kkt, rhs), np.concatenate([a, lam]), rtol=1e-9, atol=1e-6)


def test_zeros_are_dots_and_rounding_is_shown_in_residuals_only(start: kp.State) -> None:
    model = start.model
    upright = kp.assemble(model, set={"crank.angle": "90*deg"}, from_state=start)
    jacobian = kp.show(model, upright, "Phi_q").text()
    assert "·" in jacobian
    assert "e-1" not in jacobian
    assert "e-1" in kp.show(model, upright, "Phi").text()


def test_what_does_not_exist_is_refused(start: kp.State, model: kp.Model) -> None:
    with pytest.raises(kp.ModelError, match="did you mean 'Phi_q'"):
        kp.show(model, start, "Phi_p")
    with pytest.raises(kp.ModelError, match="not of the assembly"):
        kp.show(model, start, "lam", assembly={"crank.angle": 0})
    other = kp.Model()
    other.bar("rod", mass=1, length=1, ends=("A", "B"))
    with pytest.raises(kp.ModelError, match="another model"):
        kp.show(other, start)


# --- Newton from the guess ----------------------------------------------------------------------


def test_newton_from_the_guess_converges_quadratically(four_bar_file: Path) -> None:
    rows = iterations(kp.load(four_bar_file)).rows
    residuals = [row.residual for row in rows]
    assert residuals[0] > 1e-2  # the loop is open
    assert residuals[-1] < 1e-12
    assert 4 <= len(rows) <= 7
    assert all(row.damping == 1.0 for row in rows)
    # e' <= C e² with one constant, until rounding
    constants = [b / a**2 for a, b in itertools.pairwise(residuals) if b > 1e-13]
    assert len(constants) >= 2
    assert max(constants) < 10.0


def test_newton_from_the_guess_finds_the_position_of_the_placement(
    start: kp.State, model: kp.Model
) -> None:
    guess = {"coupler.angle": "14*deg", "rocker.angle": "240*deg"}
    found = kp.assemble(model, {"crank.angle": "70*deg"}, guess, from_guess=True)
    assert_allclose(found.q, start.q, atol=1e-11)
    assert_allclose(found.q, REFERENCE["start"]["q"], atol=1e-11)


def test_newton_from_a_bad_guess_fails_in_words(model: kp.Model) -> None:
    short = model.with_parameters({"L2": 1})
    with pytest.raises(kp.AssemblyError, match="cannot close"):
        kp.assemble(short, {"crank.angle": "70*deg"}, from_guess=True)


# --- formulas -----------------------------------------------------------------------------------


def joints_and_drivers() -> dict[str, dict[str, Any]]:
    """The declarations of all types of joints and drivers."""
    tables: dict[str, Any] = json.loads(_core.catalogue())
    return {table["name"]: table for group in ("joints", "drivers") for table in tables[group]}


#: Wheels, whose equations are taken modulo a turn, and joints on curves, whose equations name them.
#: The conformance tests of the core compare their printed equations with their numbers.
OTHERWISE = {"clearance", "gear", "belt", "point_on_curve", "roller_on_curve", "flat_on_curve"}


def sample(table: dict[str, Any]) -> dict[str, Any]:
    """A value for every required field of an element."""
    values: dict[str, Any] = {
        "number": 0.7,
        "pair": (0.3, 0.8),
        "law": "0.3*sin(w*t)",
        "laws": ["a.P.x - b.y*sin(w*t)"],
        "units": ["m"],
        "terms": {"hinge.angle": 2, "b.x": -0.5},
    }
    several = {"point": ["a.R", "b.P"], "body": ["a", "b"], "coordinate": ["b.x"]}
    places = {shape: iter(names) for shape, names in several.items()}
    return {
        field["name"]: values.get(field["shape"]) or next(places[field["shape"]])
        for field in table["fields"]
        if field["required"]
    }


def mechanism() -> kp.Model:
    """Every type of joint and driver, with arms and axes of which none is zero."""
    m = kp.Model("all", parameters={"w": 0.7})
    m.ground.points(O=(0.3, -0.4))
    m.body("a", mass=1, inertia=1, points={"P": (0.2, -0.5), "R": (-0.7, 0.6)})
    m.body("b", mass=1, inertia=1, points={"P": (-0.8, 0.3), "R": (0.4, 0.9)})
    m.revolute("pin", "ground.O", "a.P", axes=(0.2, 0.3))
    m.revolute("hinge", "a.R", "b.P")
    m.translational("slide", "a.P", "b.R", axes=(0.4, -1.1))
    m.translational("guide", "ground.O", "b.P", axes=(0.9, 0.2))
    m.distance("rod", "a.R", "b.R", length="2*w")
    m.distance("tie", "ground.O", "b.R", length=0.9)
    for coordinate in ("x", "y", "angle"):
        law = "0.3 - 1.2*sin(w*t) + t^2"
        m.coordinate_driver(f"drive_{coordinate}", f"b.{coordinate}", value=law)
    tree = m.tree()
    known = {entry["type"] for group in ("joints", "drivers") for entry in tree[group].values()}
    for kind, table in joints_and_drivers().items():
        if kind not in known | OTHERWISE:
            getattr(m, kind)(f"another_{kind}", **sample(table))
    return m


@pytest.fixture
def somewhere() -> kp.State:
    rng = np.random.default_rng(7)
    compiled = mechanism().compile()
    n = compiled.n_q
    return kp.State(compiled, 0.37, rng.normal(size=n), rng.normal(size=n))


def numbers(state: kp.State, equations: Equations) -> dict[str, float]:
    """Every name that the formulas of a joint may hold, named parts of them included."""
    values = {**state.coordinates(), **state.model.parameters, "t": float(state.t)}
    for body in state.model.all_bodies.values():
        for point, place in body.points.items():
            values |= {f"{body.name}.{point}.{c}": place[k] for k, c in enumerate("xy")}
    for name, formula in equations.expressions.definitions:
        values[name] = evaluated(formula, values)
    return values


def evaluated(text: str, values: dict[str, float]) -> float:
    """The value of a formula by sympy, without regard to how it was written."""
    plain = text.replace("^", "**")
    for name in sorted(values, key=len, reverse=True):
        plain = plain.replace(name, name.replace(".", "__")) if "." in name else plain
    symbols = {name.replace(".", "__"): sympy.Symbol(name.replace(".", "__")) for name in values}
    given = {symbols[name.replace(".", "__")]: value for name, value in values.items()}
    return float(sympy.sympify(plain, symbols).subs(given))


def test_every_formula_gives_the_number_of_the_core(somewhere: kp.State) -> None:
    found = somewhere.matrices()
    seen = set()
    for equations in kp.equations(somewhere.model):
        seen.add((somewhere.model.constraints[equations.name].group, equations.type))
        values, told = numbers(somewhere, equations), equations.expressions
        for k, row in enumerate(equations.rows):
            at = found.rows.index(row)
            numeric = [evaluated(text, values) for text in (told.residual[k], told.gamma[k])]
            assert numeric == pytest.approx([found.Phi[at], found.gamma[at]], abs=1e-12), row
            jacobian = np.zeros(found.Phi_q.shape[1])
            for column, text in zip(told.columns, told.jacobian[k], strict=True):
                jacobian[found.columns.index(column)] = evaluated(text, values)
            assert_allclose(jacobian, found.Phi_q[at], atol=1e-12, err_msg=row)
    tables: dict[str, Any] = json.loads(_core.catalogue())
    every = {(group, t["name"]) for group in ("joints", "drivers") for t in tables[group]}
    every = {(group, kind) for group, kind in every if kind not in OTHERWISE}
    assert seen == every


def test_a_wrong_formula_would_be_seen(somewhere: kp.State) -> None:
    found = somewhere.matrices()
    pin = next(e for e in kp.equations(somewhere.model) if e.name == "hinge")
    wrong = pin.expressions.residual[0].replace("a_i.x", "a_i.y", 1)
    value = evaluated(wrong, numbers(somewhere, pin))
    assert abs(value - found.Phi[found.rows.index("hinge.x")]) > 1e-3


def test_the_printed_jacobian_and_gamma_follow_from_the_printed_residual(
    somewhere: kp.State,
) -> None:
    """By differentiation in sympy, with the coordinates as functions of time."""
    t = sympy.Symbol("t")
    bodies = list(somewhere.model.bodies)
    rates = dict(zip(("x", "y", "angle"), ("vx", "vy", "omega"), strict=True))
    moving = {f"{b}.{c}": sympy.Function(f"{b}__{c}")(t) for b in bodies for c in rates}
    turning = {f"{b}.{rates[c]}": moving[f"{b}.{c}"].diff(t) for b in bodies for c in rates}
    for equations in kp.equations(somewhere.model):
        values, told = numbers(somewhere, equations), equations.expressions
        names = {**{name: sympy.Symbol(name) for name in values}, **moving, **turning, "t": t}
        known = {name.replace(".", "__"): symbol for name, symbol in names.items()}

        def read(text: str, known: dict[str, sympy.Expr] = known) -> sympy.Expr:
            plain = re.sub(r"(?<=[A-Za-z_])\.(?=[A-Za-z_])", "__", text.replace("^", "**"))
            return sympy.sympify(plain, known)

        for name, formula in told.definitions:
            known[name.replace(".", "__")] = read(formula)
        # rates before positions before time, of which they are functions
        steps = [
            {turning[name]: values[name] for name in turning},
            {moving[name]: values[name] for name in moving},
            {symbol: values[str(symbol)] for symbol in names.values() if symbol.is_Symbol},
        ]

        def number(formula: sympy.Expr, steps: list[dict[Any, float]] = steps) -> float:
            for step in steps:
                formula = formula.subs(step)
            return float(formula)

        for k, residual in enumerate(map(read, told.residual)):
            for column, entry in zip(told.columns, told.jacobian[k], strict=True):
                gap = residual.diff(moving[column]) - read(entry)
                assert number(gap) == pytest.approx(0.0, abs=1e-12), column
            still = {f.diff(t, 2): 0 for f in moving.values()}
            gap = residual.diff(t, 2).subs(still) + read(told.gamma[k])
            assert number(gap) == pytest.approx(0.0, abs=1e-12), equations.name


def test_formulas_have_the_names_of_the_model(start: kp.State) -> None:
    told = {e.name: e for e in kp.equations(start.model)}
    first = told["A"].text().splitlines()[1].strip()
    assert first == "Φ[A.x] = crank.x + crank.A.x*cos(crank.angle)"  # ground falls away
    assert "coupler.C = (13, 0) m" in told["C"].text()
    assert r"\varphi_{\text{rocker}}" in told["C"].latex()


def test_latex_formulas_can_be_set(somewhere: kp.State) -> None:
    from matplotlib.mathtext import MathTextParser

    parser = MathTextParser("agg")
    count = 0
    for equations in kp.equations(somewhere.model):
        tex = equations.latex()
        body = tex.split("\\begin{align*}\n")[1].split("\n\\end{align*}")[0]
        for line in body.split(" \\\\\n"):
            parser.parse(f"${line.replace('&', '')}$")
            count += 1
    assert count > 40


def test_vectors_have_names(somewhere: kp.State) -> None:
    told = {e.name: e for e in kp.equations(somewhere.model)}
    lines = told["rod"].text().splitlines()
    assert "  d.x = b.x + a_j.x - a.x - a_i.x" in lines
    assert "  Φ[rod.length] = (d.x^2 + d.y^2 - 4*w^2)/(4*w)" in lines
    assert r"\dot{d}_{x} &= " in told["rod"].latex()


def test_a_law_of_the_state_has_its_columns() -> None:
    m = mechanism()
    m.coordinate_driver("gear", "b.angle", value="2*a.angle + t^2")
    gear = next(e for e in kp.equations(m) if e.name == "gear")
    told = gear.expressions
    assert told.residual == ("b.angle - 2*a.angle - t^2",)
    slopes = dict(zip(told.columns, told.jacobian[0], strict=True))
    assert (slopes["a.angle"], slopes["b.angle"]) == ("-2", "1")
    assert told.gamma == ("2",)


def test_a_body_may_have_the_name_of_a_vector() -> None:
    m = kp.Model("letters")
    for name in ("d", "u"):
        m.body(name, mass=1, inertia=1, points={"P": (0.2, -0.5)})
    m.translational("slide", "d.P", "u.P", axes=(0.4, 0.1))
    slide = kp.equations(m)[0]
    assert slide.expressions.residual[0] == "u_.x*d_.y - u_.y*d_.x"


# --- command line -------------------------------------------------------------------------------


def told(capsys: pytest.CaptureFixture[str], *words: object) -> str:
    assert main(["show", *map(str, words)]) == 0
    out, err = capsys.readouterr()
    assert err == ""
    return out


def test_the_command_shows_the_jacobian(
    four_bar_file: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    lines = told(capsys, four_bar_file, "--assembly").splitlines()
    assert lines[0] == "Φ_q, Jacobian, 9 × 9, t = 0 s"
    assert lines[-1].split() == ["set.crank.angle", "·", "·", "1", *["·"] * 6]
    assert len(told(capsys, four_bar_file, "--jacobian").splitlines()) == 10


def test_the_command_shows_all_at_a_later_time(
    four_bar_file: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    flags = ["--mass", "--kkt", "--gamma", "--forces", "--residual", "--nu", "--multipliers"]
    assert told(capsys, four_bar_file, *flags).count("t = 0 s") == 7
    target = tmp_path / "new" / "gamma.csv"
    assert told(capsys, four_bar_file, "--gamma", "--t", "0.05", "-o", target) == ""
    rows = list(csv.reader(target.read_text(encoding="utf-8").splitlines()))
    assert rows[0] == ["", "gamma"]
    state = next(s for s in REFERENCE["states"] if s["t"] == 0.05)
    q, v = (np.array(state[key]) for key in "qv")
    at = kp.State(kp.load(four_bar_file).model.compile(), 0.05, q, v)
    assert_allclose([float(row[1]) for row in rows[1:]], at.matrices().gamma, rtol=1e-3)


def test_the_command_shows_iterations_and_formulas(
    four_bar_file: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    lines = told(capsys, four_bar_file, "--iterations").splitlines()
    assert lines[2].split() == ["iteration", "residual", "step", "damping"]
    assert float(lines[-1].split()[1]) < 1e-12
    assert "iteration,residual" in told(capsys, four_bar_file, "--iterations", "--format", "csv")
    assert "tabular" in told(capsys, four_bar_file, "--iterations", "--format", "latex")
    assert "Φ[B.x] = coupler.x" in told(capsys, four_bar_file, "--symbolic")
    assert r"\begin{align*}" in told(capsys, four_bar_file, "--symbolic", "--format", "latex")


@pytest.mark.parametrize(
    ("words", "code"),
    [
        (["--format", "html"], 2),
        (["--symbolic", "--format", "csv"], 2),
        (["--t", "99"], 2),
        (["--t", "soon"], 2),
        (["-o", "."], 4),
    ],
    ids=str,
)
def test_the_command_refuses_in_words(
    four_bar_file: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    words: list[str],
    code: int,
) -> None:
    monkeypatch.chdir(four_bar_file.parent)
    assert main(["show", str(four_bar_file), *words]) == code
    out, err = capsys.readouterr()
    assert out == ""
    assert err
    assert "Traceback" not in err
