"""Every "did you mean" of a mistyped case is applied, and the fault is gone."""

import copy
import json
import random
import re
from typing import Any

import kempe as kp
import numpy as np
import pytest
from kempe import _core
from schema.cases import cases, places, typo
from sizes import FULL, some

CASES = cases()
#: Its curves take long to check: only each 15th place is mistyped, all of them with KEMPE_FULL=1.
SLOW = "geneva_drive.toml"
#: "everything" has every type.
SOME = sorted({*some([*CASES], 9), "everything"})
MEANT = re.compile(r"'([^']*)'[^;]*; did you mean '([^']*)'\?")


def faults(case: dict[str, Any]) -> list[str]:
    """The faults that are known without a run."""
    try:
        core = _core.Case(json.dumps(case), "json", None)
        for name, entry in case.get("tables", {}).items():
            if "file" in entry:
                core = core.supply(name, np.arange(3.0), np.ones(3))
        core.check(core.model("{}"))
    except kp.KempeError as error:
        return [problem.message for problem in error.problems] or [str(error)]
    return []


def replaced(node: dict[str, Any], key: str, wrong: str, meant: str) -> None:
    """Replaces a part of a key."""
    name = key.replace(wrong, meant, 1)
    entries = [(name if known == key else known, value) for known, value in node.items()]
    node.clear()
    node.update(entries)


@pytest.mark.parametrize("name", SOME)
def test_suggestions_remove_the_fault(name: str) -> None:
    chance = random.Random(4)
    assert faults(CASES[name]) == []
    applied, step = 0, 15 if name == SLOW and not FULL else 1
    for k, (node, key) in list(enumerate(places(CASES[name])))[::step]:
        for is_key in (True, False):
            word = key if is_key else node[key]
            if not isinstance(word, str) or len(word) < 3 or (not is_key and key == "title"):
                continue
            case = copy.deepcopy(CASES[name])
            own, own_key = list(places(case))[k]
            wrong = typo(word, chance)
            if is_key and wrong in own:
                continue
            if is_key:
                replaced(own, key, key, wrong)
            else:
                own[own_key] = wrong
            found = [match for text in faults(case) if (match := MEANT.search(text))]
            if len(found) != 1 or not re.search(rf"(?<!\w){re.escape(found[0][1])}(?!\w)", wrong):
                continue  # the name of a part: those that refer to it are at fault
            applied += 1
            part, meant = found[0].groups()
            if is_key:
                replaced(own, wrong, part, meant)
            else:
                own[own_key] = wrong.replace(part, meant, 1)
            left = faults(case)
            if wrong.replace(part, meant, 1) != word:
                # another valid formula, such as pi for pi*h, may lead to other faults
                left = [text for text in left if f"'{part}'" in text]
            assert left == [], f"{wrong!r} of {word!r} at {key!r}: {part!r} as {meant!r}"
    assert applied > 20 / step
