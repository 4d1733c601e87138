"""Contacts, windows and events of random motions: none is missed in a long step."""

import kempe as kp
import numpy as np
import pytest
from sizes import count
from stress.random_events import KINDS, METHODS, Trial


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.__name__)
@pytest.mark.filterwarnings("ignore")
def test_none_is_missed(kind: "type[Trial]") -> None:
    rng = np.random.default_rng(3)
    for seed in range(count(20, 200)):
        method, accuracy = METHODS[seed % len(METHODS)]
        try:
            kind(rng).run(method, accuracy)
        except (AssertionError, kp.KempeError) as fault:
            raise AssertionError(f"{kind.__name__} {seed} by {method}") from fault
