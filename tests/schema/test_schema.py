"""The JSON Schema: valid, the same verdict as the core, and one error for one typo."""

import copy
import json
import random
import re
from typing import Any

import jsonschema
import kempe as kp
import pytest
from kempe import _core
from schema.cases import cases, mutated, places, typo
from sizes import count, some

SCHEMA = json.loads(_core.schema())
VALIDATOR = jsonschema.Draft202012Validator(SCHEMA)
CASES = cases()

#: Faults of references between parts of a case, which no schema can find.
REFERENCES = re.compile(
    r"is already the name of|no earlier analysis|unknown coordinate|is not a coordinate|given twice"
)


def refusal(case: dict[str, Any]) -> str:
    """The faults of structure that the core finds; empty if there are none."""
    try:
        _core.Case(json.dumps(case), "json", "case.json")
    except kp.KempeError as error:
        return str(error)
    return ""


def refusal_of_curves(case: dict[str, Any]) -> str:
    """The faults of curves, whose values the core checks when it builds the model."""
    try:
        _core.Case(json.dumps(case), "json", "case.json").model("{}")
    except kp.KempeError as error:
        return str(error) if ".curves." in str(error) else ""
    return ""


def test_the_schema_is_valid() -> None:
    jsonschema.Draft202012Validator.check_schema(SCHEMA)


@pytest.mark.parametrize("name", CASES)
def test_every_example_fits(name: str) -> None:
    assert [error.message for error in VALIDATOR.iter_errors(CASES[name])] == []


def test_every_type_occurs() -> None:
    told = json.loads(_core.catalogue())
    kinds = {
        entry["type"]
        for node, key in places(CASES["everything"])
        if "type" in (entry := node[key] if isinstance(node[key], dict) else {})
    }
    for group in ("bodies", "elements", "methods", "stabilizations", "analyses"):
        for table in told.get(group, []):
            assert table["name"] in kinds | {"auto", "ground"}, table["name"]


def test_the_verdict_on_mutated_cases_is_that_of_the_core() -> None:
    chance = random.Random(13)
    names, references, refused = list(CASES), 0, 0
    size = count(150, 1000)
    for _ in range(size):
        words, case = mutated(CASES[chance.choice(names)], chance)
        fault = refusal(case)
        errors = [error.message for error in VALIDATOR.iter_errors(case)]
        if errors:
            told = fault or refusal_of_curves(case)
            assert told, f"only the schema refuses: {words}\n{errors}"
            refused += 1
        elif fault:
            assert REFERENCES.search(fault), f"only the core refuses: {words}\n{fault}"
            references += 1
    assert refused > 0.4 * size
    assert references < 0.1 * size


def closed(path: list[Any]) -> bool:
    """Whether the keys of a table are known: not names, coordinates or points."""
    match path:
        case ["parameters"] | ["tables" | "bodies" | "joints" | "drivers" | "forces" | "analyses"]:
            return False
        case ["measures"] | ["start", "set" | "guess", *_] | ["analyses", _, "set" | "parameters"]:
            return False
        case [*_, "points" | "through" | "curves" | "terms"]:
            return False
    return True


def tables(node: Any, path: list[Any]) -> list[tuple[list[Any], dict[str, Any]]]:
    """All tables whose keys are known, with their paths."""
    if not isinstance(node, dict):
        return []
    own = [(path, node)] if closed(path) else []
    return own + [found for key, value in node.items() for found in tables(value, [*path, key])]


#: "everything" has every type.
SOME = sorted({*some([*CASES], 6), "everything"})


@pytest.mark.parametrize("name", SOME)
def test_one_typo_of_a_key_is_one_error_that_names_it(name: str) -> None:
    chance = random.Random(5)
    for path, table in tables(CASES[name], []):
        for key in table:
            wrong = typo(key, chance)
            if wrong in table or wrong in ("a", "b"):
                continue
            case = copy.deepcopy(CASES[name])
            node: Any = case
            for step in path:
                node = node[step]
            entries = [(wrong if known == key else known, value) for known, value in node.items()]
            node.clear()
            node.update(entries)
            errors = list(VALIDATOR.iter_errors(case))
            told = [error.message for error in errors]
            assert len(errors) == 1, f"{[*path, key]} as {wrong}: {told}"
            assert repr(wrong) in told[0]
            assert list(errors[0].absolute_path) == path
            assert wrong in refusal(case)


@pytest.mark.parametrize("name", SOME)
def test_one_typo_of_a_type_is_one_error_that_names_it(name: str) -> None:
    chance = random.Random(6)
    for path, table in tables(CASES[name], []):
        if "type" not in table:
            continue
        case = copy.deepcopy(CASES[name])
        node: Any = case
        for step in path:
            node = node[step]
        node["type"] = typo(table["type"], chance)
        errors = list(VALIDATOR.iter_errors(case))
        assert [list(error.absolute_path) for error in errors] == [[*path, "type"]]
        assert repr(node["type"]) in errors[0].message
