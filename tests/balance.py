"""A plugin of pytest: the Newton–Euler balance of every solution that the tests compute.

    PYTHONPATH=tests python -m pytest -p balance tests/python tests/truth

At the end it prints the number of solutions and the largest residuals with their tests.
"""

import os
from typing import Any

import kempe as kp
from kempe.results.solution import Solution

#: The largest residual that is accepted, relative to the largest force (moment) on the body.
BALANCED = 1e-9
#: Solutions that are printed.
SHOWN = 20

found: list[tuple[float, str]] = []
without: list[str] = []
_made = Solution.__init__


def _checked(self: Solution, *given: Any, **named: Any) -> None:
    _made(self, *given, **named)
    test = os.environ.get("PYTEST_CURRENT_TEST", "")
    apart = Solution.__new__(Solution)
    _made(apart, *given, **named)  # the test's own solution stays as it is
    try:
        found.append((apart.newton_euler.largest, test))
    except (kp.KempeError, ValueError, AttributeError) as error:
        without.append(f"{type(error).__name__}: {test}")


def pytest_configure() -> None:
    Solution.__init__ = _checked  # type: ignore[method-assign]


def pytest_terminal_summary(terminalreporter: Any) -> None:
    write = terminalreporter.write_line
    above = sum(residual > BALANCED for residual, _ in found)
    write(f"Newton-Euler balance of {len(found)} solutions, {above} above {BALANCED:g}")
    for residual, test in sorted(found, reverse=True)[:SHOWN]:
        write(f"  {residual:.2e} {test}")
    write(f"{len(without)} solutions without unique reactions")
    for text in sorted(set(without)):
        write(f"  {text}")
