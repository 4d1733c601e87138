"""Unknown arguments of functions are named, and synonyms lead to names that exist."""

import copy
import inspect
import pickle
from typing import Any

import kempe as kp
import pytest
from kempe.base.synonyms import table
from kempe.model.ground import Ground
from kempe.results.views.body import BodyView
from python.test_mistakes import OPTIONS, checked

FUNCTIONS = {
    f"{package.__name__}.{name}": getattr(package, name)
    for package in (kp, kp.plot, kp.design, kp.report)
    for name in package.__all__
    if inspect.isroutine(getattr(package, name))
}


@pytest.mark.parametrize("name", FUNCTIONS)
def test_an_unknown_argument_of_a_function_is_named(name: str) -> None:
    with pytest.raises(kp.ModelError) as caught:
        FUNCTIONS[name](nonsense_of_mine=3)
    checked(str(caught.value), name.rpartition(".")[2], "'nonsense_of_mine'", "the arguments are")


def test_synonyms_lead_to_existing_names() -> None:
    owners = kp, kp.Model, kp.Solution, kp.plot, BodyView, Ground
    known = {"t"} | {name for owner in owners for name in dir(owner)}
    assert not {name for names in table("names").values() for name in names} - known
    arguments = {"of", "path", "set", "value", "t", "points"}
    functions = [getattr(kp, name) for name in kp.__all__ if callable(getattr(kp, name))]
    methods = [getattr(kp.Model, name) for name in dir(kp.Model) if name[0] != "_"]
    for one in [*functions, *filter(callable, methods)]:
        try:
            arguments |= set(inspect.signature(one).parameters)
        except (TypeError, ValueError):
            continue
    arguments |= {field for option in OPTIONS for field in option.shapes}
    assert not {name for names in table("arguments").values() for name in names} - arguments


def motion() -> kp.Solution:
    m = kp.Model("pendulum")
    m.ground.points(O=(0, 0))
    m.bar("rod", mass=1, length=1, ends=("A", "B"))
    m.revolute("A", "ground.O", "rod.A")
    return kp.dynamics(m, kp.assemble(m), t_end=0.1)


@pytest.mark.parametrize(
    ("read", "told"),
    [
        (lambda sol: sol["rod"].angel, "did you mean 'angle'?"),
        (lambda sol: sol["rod"].position, "did you mean 'x' or 'angle'?"),
        (lambda sol: sol["A"].forc, "did you mean 'force'?"),
        (lambda sol: sol["rod"].point("B").acceleratio, "did you mean 'acceleration'?"),
        (lambda sol: sol.energy.kinetc, "did you mean 'kinetic'?"),
        (lambda sol: sol.drift.positions, "did you mean 'position'?"),
        (lambda sol: sol.finl, "did you mean 'final'?"),
        (lambda sol: sol.nonsense_of_mine, "it has "),
        (lambda sol: sol.final.matrice, "did you mean 'matrices'?"),
        (lambda sol: sol.final.matrices().jacobian, "it has M, "),
        (lambda sol: sol.model.ground.point, "did you mean 'points'?"),
        (lambda _: kp.plot.reaction, "did you mean 'reactions' or 'all_reactions'?"),
        (lambda _: kp.design.pinload, "did you mean 'pin_load'?"),
    ],
)
def test_an_unknown_attribute_has_a_suggestion(read: Any, told: str) -> None:
    with pytest.raises(AttributeError, match="has no attribute") as caught:
        read(motion())
    assert told in str(caught.value)


def test_attributes_that_fail_keep_their_own_error() -> None:
    sol = motion()
    assert not hasattr(sol, "_nonsense") and not hasattr(sol["rod"], "__array__")
    assert copy.copy(sol["rod"]).name == "rod"
    assert len(pickle.loads(pickle.dumps(sol)).t) == len(sol.t)

    class Broken(type(sol.energy)):  # type: ignore[misc]
        @property
        def kinetic(self) -> None:
            raise AttributeError("of its own")

    broken = Broken.__new__(Broken)
    with pytest.raises(AttributeError, match="of its own"):
        _ = broken.kinetic


@pytest.mark.parametrize(
    ("read", "what"),
    [
        (lambda sol: sol.events["hit"], "event 'hit'"),
        (lambda sol: sol.model.joints["B"], "joint 'B'; there is A"),
        (lambda sol: sol.model.bodies["rodd"], "body 'rodd'; did you mean 'rod'?"),
        (lambda sol: sol.model.forces["f"], "force 'f'"),
        (lambda sol: sol.compiled.parameters["k"], "parameter 'k'"),
        (lambda sol: sol.measure("A.force"), "measure 'A.force'; .*; declare it"),
    ],
)
def test_an_unknown_name_of_a_mapping_is_named(read: Any, what: str) -> None:
    with pytest.raises(KeyError, match=f"unknown {what}") as caught:
        read(motion())
    assert isinstance(caught.value, kp.ModelError)


@pytest.mark.parametrize(
    "call",
    [
        kp.design.balance,
        kp.synthesis.cognates,
        kp.Exercise,
        lambda of: kp.tolerances(of, {}, "x"),
        lambda of: kp.allocate(of, "x", 1.0, {}),
        lambda of: kp.animate(of, "film.html"),
        lambda of: kp.write_dxf(of, "links.dxf"),
    ],
)
def test_a_model_in_place_of_a_case_or_solution_is_named(call: Any) -> None:
    with pytest.raises(kp.ModelError, match="<Model 'empty': empty> is not a "):
        call(kp.Model("empty"))
