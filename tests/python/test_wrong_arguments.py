"""Unknown arguments of functions are named, and synonyms lead to names that exist."""

import inspect

import kempe as kp
import pytest
from kempe.base.synonyms import table
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
    known = {*dir(kp), *dir(kp.Model)}
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
