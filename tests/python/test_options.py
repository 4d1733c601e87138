"""Options and bodies written by hand agree with the catalogue of the core."""

import json
from dataclasses import MISSING, fields
from pathlib import Path

import kempe as kp
import numpy as np
import pytest
from kempe import _core, _generate
from kempe.analyses import options
from kempe.analyses.option import Option
from kempe.model.bodies import Bar, Body, PointMass

CATALOGUE = json.loads(_core.catalogue())
FAMILIES = [*CATALOGUE["methods"], *CATALOGUE["stabilizations"]]


def defaults(kind: type) -> dict[str, object]:
    """Defaults by field, in order; MISSING where a value is required."""
    return {field.name: field.default for field in fields(kind) if field.name != "name"}


def declared(table: dict) -> dict[str, object]:
    """The same from the catalogue."""

    def default(field: dict) -> object:
        value = field["default"]
        if value is None:
            return MISSING
        if isinstance(value, dict):
            return None  # may be absent
        return tuple(value) if isinstance(value, list) else value

    return {field["name"]: default(field) for field in table["fields"]}


@pytest.mark.parametrize("table", FAMILIES, ids=lambda table: table["name"])
def test_options_are_those_of_the_core(table: dict) -> None:
    kind = getattr(kp, table["class"])
    assert issubclass(kind, Option)
    assert kind.kind == table["name"]
    assert defaults(kind) == declared(table)


@pytest.mark.parametrize("kind", [Bar, Body, PointMass])
def test_bodies_are_those_of_the_core(kind: type) -> None:
    (table,) = (table for table in CATALOGUE["bodies"] if table["name"] == kind.kind)
    assert defaults(kind) == declared(table)
    assert kind.value_kinds == {field["name"]: field["shape"] for field in table["fields"]}


def test_a_simulation_has_the_fields_of_the_core() -> None:
    (table,) = (table for table in CATALOGUE["analyses"] if table["name"] == "dynamics")
    names = ["after" if name == "from" else name for name in declared(table)]
    assert list(defaults(kp.Dynamics)) == names


def test_the_options_are_what_the_catalogue_says() -> None:
    written = Path(options.__file__).read_text(encoding="utf-8")
    assert _generate.options_source(_core.catalogue()) == written


@pytest.mark.filterwarnings("ignore:other. the state does not meet:kempe.AssemblyWarning")
def test_all_options_reach_the_core(model: kp.Model) -> None:
    every = kp.Dynamics(
        t_end="0.05 s",
        output_step=0.01,
        method=kp.RK45(rtol="1e-7", atol=1e-10, first_step=1e-4, max_step=0.02),
        stabilization=kp.Baumgarte(alpha=5, beta="100"),
        max_steps=1000,
        dense_output=False,
        name="first",
    )
    other = kp.Dynamics(
        0.1,
        method=kp.DOP853(rtol="1e-7", atol=1e-10, first_step=1e-4, max_step=0.02),
        stabilization=kp.Projection(tolerance="1e-11"),
        name="other",
    )
    plain = kp.Dynamics(0.2, method=kp.RK4(step=0.005), stabilization=None, name="second")
    start = {"set": {"crank.angle": "70*deg"}, "guess": {"rocker.angle": "240*deg"}}
    results = kp.Case(model, start, [every, other, plain]).run()
    assert results["first"].t[-1] == pytest.approx(0.05)
    assert results["first"].dense is None
    assert results["other"].drift.position.max() < 1e-9
    assert results["other"].dense is not None
    assert results["other"].dense.c.shape[2] == 9
    assert results["second"].statistics["steps"] == 20


@pytest.mark.parametrize("method", [kp.RK45, kp.DOP853])
def test_a_constant_step_is_kept(
    model: kp.Model, start: kp.State, method: type[kp.RK45] | type[kp.DOP853]
) -> None:
    sol = kp.dynamics(model, start, t_end=0.1, method=method(step=0.001))
    np.testing.assert_allclose(np.diff(sol.t), 0.001, rtol=1e-12)
    with pytest.raises(kp.ModelError, match=r"max_step: not together with step; remove one"):
        kp.dynamics(model, start, t_end=0.1, method=method(step=0.001, max_step=1))


@pytest.mark.parametrize(
    "method", [kp.RK4(step=1e-12), kp.DOP853(step=1e-12), kp.RK45(max_step=1e-12)], ids=str
)
def test_steps_without_end_are_refused_at_once(
    model: kp.Model, start: kp.State, method: kp.RK4 | kp.RK45 | kp.DOP853
) -> None:
    with pytest.raises(kp.IntegrationError, match=r"1e12 steps of 1e-12 s .* = 333333; take") as e:
        kp.dynamics(model, start, t_end=1, method=method)
    np.testing.assert_array_equal(e.value.solution.t, [0.0])


def test_outputs_without_end_are_refused(model: kp.Model, start: kp.State) -> None:
    with pytest.raises(kp.ModelError, match=r"output_step: .* must be at least 1e-6 of the time"):
        kp.dynamics(model, start, t_end=1, output_step=1e-12)


@pytest.mark.parametrize(
    "method",
    [
        kp.GeneralizedAlpha(rho=0.6, rtol=1e-5, atol=1e-8, first_step=1e-4, max_step=0.01),
        kp.GeneralizedAlpha(step="1/500"),
        kp.HHT(alpha=-0.2, rtol=1e-5, atol=1e-8),
        kp.Radau(rtol="1e-7", atol=1e-10, first_step=1e-4, max_step=0.02),
        kp.Radau(step=0.005, rtol=1e-9, atol=1e-11),
        kp.Auto(rtol=1e-7, atol=1e-10, first_step=1e-4, max_step=0.02),
    ],
    ids=str,
)
def test_methods_for_stiff_models(model: kp.Model, start: kp.State, method: Option) -> None:
    sol = kp.dynamics(model, start, t_end=0.2, output_step=0.01, method=method)
    exact = kp.dynamics(
        model, start, t_end=0.2, method=kp.DOP853(1e-11, 1e-13), stabilization=kp.Projection()
    )
    assert sol.final["crank"].angle == pytest.approx(exact.final["crank"].angle, abs=2e-3)
    assert sol.drift.position.max() < 1e-9
    assert sol(0.105)["crank"].angle == pytest.approx(exact(0.105)["crank"].angle, abs=2e-3)
    if getattr(method, "step", None) is not None:
        assert sol.statistics["rejected"] == 0
    if isinstance(method, kp.Auto):
        assert sol.statistics["method"] == "dop853"
        assert sol.statistics["why"].startswith("not stiff")
    else:
        assert sol.njev > 0
        assert sol.statistics["iterations"] >= sol.statistics["steps"]


def test_a_simulation_may_start_at_another_time(model: kp.Model) -> None:
    start = {"set": {"crank.angle": "70*deg"}, "guess": {"rocker.angle": "240*deg"}}
    sol = kp.Case(model, start, [kp.Dynamics(1.1, t_start=1)]).run()[0]
    assert (sol.t[0], sol.t[-1]) == pytest.approx((1.0, 1.1))


@pytest.mark.parametrize(
    "wrong",
    [
        {"t_end": 1, "method": kp.RK45(rtol=-1)},
        {"t_end": 1, "method": kp.RK4(step=0)},
        {"t_end": 1, "stabilization": kp.Baumgarte(alpha=-1)},
        {"t_end": 1, "stabilization": kp.Projection(tolerance=0)},
        {"t_end": 1, "method": kp.DOP853(atol=-1)},
        {"t_end": 1, "method": kp.GeneralizedAlpha(rho=1)},
        {"t_end": 1, "method": kp.HHT(alpha=0)},
        {"t_end": 1, "method": kp.HHT(step=0.1, max_step=1)},
        {"t_end": 1, "method": kp.Radau(step=0.1, first_step=1)},
        {"t_end": 1, "method": kp.Radau(), "stabilization": kp.Baumgarte()},
        {"t_end": 1, "method": kp.Auto(), "stabilization": kp.Baumgarte()},
        {"t_end": 1, "output_step": -0.1},
        {"t_end": "unknown"},
        {"t_end": 1, "max_steps": 0},
    ],
    ids=str,
)
def test_options_that_cannot_be_are_refused(model: kp.Model, start: kp.State, wrong: dict) -> None:
    with pytest.raises(kp.ModelError):
        kp.dynamics(model, start, **wrong)


@pytest.mark.parametrize(
    ("field", "remedy"), [("method", "kp.RK45"), ("stabilization", "kp.Projection")]
)
def test_a_word_is_no_option(model: kp.Model, start: kp.State, field: str, remedy: str) -> None:
    words: dict = {field: "auto"}
    with pytest.raises(kp.ModelError, match=rf"{field}: 'auto'; pass an object such as {remedy}"):
        kp.dynamics(model, start, t_end=1, **words)


def test_gains_from_the_step_go_without_numbers(model: kp.Model) -> None:
    start = {"set": {"crank.angle": "70*deg"}, "guess": {"rocker.angle": "240*deg"}}

    def run(stabilization: kp.Baumgarte) -> kp.Solution:
        simulation = kp.Dynamics(0.1, method=kp.RK45(), stabilization=stabilization)
        return kp.Case(model, start, [simulation]).run()["dynamics"]

    assert run(kp.Baumgarte(gains="step")).drift.position.max() < 1e-6
    with pytest.raises(kp.ModelError, match=r"stabilization\.beta: not together with gains"):
        run(kp.Baumgarte(gains="step", beta=3))
    with pytest.raises(kp.ModelError, match="gains"):
        run(kp.Baumgarte(gains="stop"))
