"""Solutions that several tests draw."""

import kempe as kp
import pytest
from draw import mechanisms


@pytest.fixture(scope="session")
def four_bar() -> kp.Solution:
    return mechanisms.moving()


@pytest.fixture(scope="session")
def hostile() -> kp.Solution:
    return mechanisms.moving(mechanisms.HOSTILE)
