"""Representations: short texts, HTML with drawings and tables, LaTeX of matrices."""

import inspect
import re
import xml.etree.ElementTree as ET
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import kempe as kp
import numpy as np
import pytest


@pytest.fixture(autouse=True)
def si_units() -> Iterator[None]:
    yield
    kp.units("SI")


def chain(count: int) -> kp.Model:
    m = kp.Model("chain", gravity=(0, -9.81))
    m.ground.points(P0=(0, 0))
    before = "ground"
    for k in range(count):
        m.bar(f"link{k}", mass=1, length=1, ends=(f"P{k}", f"P{k + 1}"))
        m.revolute(f"J{k}", f"{before}.P{k}", f"link{k}.P{k}")
        before = f"link{k}"
    return m


def objects(model: kp.Model, start: kp.State, sol: kp.Solution) -> list[Any]:
    case = kp.Case(model, analyses=[kp.Dynamics(0.01)])
    return [
        *(model, model.ground, model.compile(), start, sol, sol(sol.t), case, case.run()),
        *(start.report, start.matrices(), kp.show(model, start, "kkt"), kp.equations(model)[0]),
        *(sol.energy, sol.drift, sol.dense, kp.units(), kp.plot.pages(sol)[0], kp.Dynamics(1)),
        *(kp.RK45(), kp.Auto(), model.bodies[next(iter(model.bodies))], kp.Start()),
        *(
            next(iter(model.joints.values())),
            sol.body("ground"),
            sol.joint(next(iter(model.joints))),
        ),
    ]


@pytest.mark.parametrize("count", [1, 60])
def test_a_representation_is_short_whatever_the_size(count: int) -> None:
    model = chain(count)
    start = kp.assemble(model)
    sol = kp.dynamics(model, start, t_end=0.01)
    for thing in objects(model, start, sol):
        text = repr(thing)
        lines = text.splitlines()
        assert len(lines) <= 3, text
        assert max(map(len, lines)) <= 220, text
        assert " at 0x" not in text, text
        assert "array(" not in text, text


def test_representations_say_what_is_there(
    model: kp.Model, start: kp.State, solution: kp.Solution
) -> None:
    told = {
        "<State of 'four-bar' at t = 0 s: crank, coupler, rocker>": start,
        "<bar 'crank': 3 kg, points A, B>": model.bodies["crank"],
        "<revolute 'C': coupler - rocker>": model.joints["C"],
        "<torsion_spring 'spring': ground - rocker>": model.forces["spring"],
        "<ground of 'four-bar': points A, D>": model.ground,
        "<Matrices: 9 coordinates, 8 equations>": start.matrices(),
        "<Labelled Phi_q: 8 × 9, Jacobian>": kp.show(model, start),
        "<AssemblyReport: 1 iteration, 1 degree of freedom>": start.report,
        "RK45(rtol=1e-08)": kp.RK45(rtol=1e-8),
        "RK4(step=0.001)": kp.RK4(step=1e-3),
        "Dynamics(t_end=2, method=RK45())": kp.Dynamics(2, method=kp.RK45()),
        "Baumgarte(alpha=3)": kp.Baumgarte(alpha=3),
        "<Units mm, deg>": kp.units("mm", "deg"),
    }
    for text, thing in told.items():
        assert repr(thing) == text
    assert eval(repr(kp.Dynamics(2, stabilization=None)), vars(kp)) == kp.Dynamics(
        2, stabilization=None
    )
    assert "101 outputs" in repr(solution)


def parsed(html: str) -> ET.Element:
    return ET.fromstring(html.replace("&nbsp;", " "))


def cells(tree: ET.Element) -> list[list[str]]:
    return [["".join(cell.itertext()) for cell in row] for row in tree.iter("tr")]


def test_a_notebook_shows_a_drawing_and_tables(
    model: kp.Model, start: kp.State, solution: kp.Solution
) -> None:
    for thing in (model, start, solution):
        assert any(
            tag.endswith("svg") for tag in (e.tag for e in parsed(thing._repr_html_()).iter())
        )
    rows = cells(parsed(model._repr_html_()))
    assert ["2", "coupler", "bar", "5", "281.667"] in rows
    assert ["spring", "torsion_spring", "ground", "rocker"] in rows
    assert ["method", f"dop853, {solution.statistics['steps']} steps"] in cells(
        parsed(solution._repr_html_())
    )


def test_the_table_of_a_state_has_the_display_units(start: kp.State) -> None:
    header, *rows = cells(parsed(start._repr_html_()))
    assert header == [
        "body",
        "x / m",
        "y / m",
        "angle / °",
        "vx / m/s",
        "vy / m/s",
        "omega / rad/s",
    ]
    assert rows[0][:4] == ["crank", "1.7101", "4.69846", "70"]
    kp.units("mm", "rad", "rpm")
    header, *rows = cells(parsed(start._repr_html_()))
    assert header[1:4] + header[6:] == ["x / mm", "y / mm", "angle / rad", "omega / rpm"]
    assert rows[0][:4] == ["crank", "1710.1", "4698.46", "1.22173"]
    printed = str(start).splitlines()
    assert printed[1].split()[:6] == ["x", "/", "mm", "y", "/", "mm"]
    assert printed[2].split()[:4] == rows[0][:4]


def test_omega_is_shown_in_the_display_unit(model: kp.Model) -> None:
    start = kp.assemble(model, set={"crank.angle": "70*deg", "crank.omega": 2.0})
    kp.units("rpm")
    assert f"{2.0 * 60 / (2 * np.pi):.6g}" in str(start)


def test_names_cannot_inject_html() -> None:
    m = kp.Model("<script>alert(1)</script>", gravity=(0, -9.81))
    m.body("<b>", mass=1, inertia=1)
    html = m._repr_html_()
    assert "<script>" not in html
    assert "&lt;b&gt;" in html


def test_an_unfinished_model_is_shown_with_its_error() -> None:
    m = kp.Model("unfinished")
    m.revolute("A", "ground.A", "rod.A")
    assert "unknown body" in m._repr_html_()


def test_a_matrix_is_shown_in_html_and_latex(model: kp.Model, start: kp.State) -> None:
    shown = kp.show(model, start, "Phi_q")
    header, *rows = cells(parsed(shown._repr_html_()))
    assert header == ["", *shown.columns]
    assert rows[2][:4] == ["B.x", "-1", "·", "4.6985"]
    latex = shown._repr_latex_()
    assert latex.startswith(r"$\displaystyle \Phi_q =")
    assert latex.endswith("$")
    assert r"\begin{equation" not in latex
    assert latex.count(r" \\") == 3 * 8 - 3 + 1  # three columns of 8, 8 and 9 lines
    assert str(shown).splitlines()[0] == "Φ_q, Jacobian, 8 × 9"


def test_equations_are_shown_in_latex(model: kp.Model) -> None:
    joint = kp.equations(model)[0]
    assert joint._repr_latex_().startswith(r"$\displaystyle \begin{aligned}")
    assert joint.latex().startswith("% A (revolute)\n\\begin{align*}\n")


def test_a_long_table_is_cut() -> None:
    rows = cells(parsed(chain(35)._repr_html_()))
    assert ["… 5 more"] in rows


def test_the_help_is_for_users_and_its_example_runs(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    text = inspect.getdoc(kp) or ""
    assert "_HOME" not in text
    words = re.findall(
        r"(?m)^    ((?:[\w.]+, )*[\w.]+)(?: {2,}|,?$| [a-z])", text.partition("Build:")[2]
    )
    listed = [name for line in words for name in line.split(", ")]
    assert {"Model", "RK45", "Auto", "report.summary", "units"} <= set(listed)
    for name in listed:
        found: Any = kp
        for part in name.split("."):
            found = getattr(found, part)
    example = re.search(r"released from rest::\n\n((?:    .*\n|\n)+)", text)
    assert example
    monkeypatch.chdir(tmp_path)
    scope: dict[str, Any] = {}
    exec(inspect.cleandoc("\n" + example[1]), scope)
    assert scope["sol"]["rod.angle"][0] == pytest.approx(np.radians(-30))
    assert (tmp_path / "pendulum.html").exists()


def test_every_public_name_has_a_docstring() -> None:
    for name in kp.__all__:
        thing = getattr(kp, name)
        assert name == "__version__" or (inspect.getdoc(thing) or "").strip(), name
