"""A window with the studio, driven as a person would."""

import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import kempe as kp

if TYPE_CHECKING:
    from playwright.sync_api import Page

#: The browser has shown the page before, so that no mechanism moves when it opens.
VISITED = "try { localStorage.setItem('kempe.visited', '1') } catch {}"


@dataclass
class Studio:
    """A window with the studio, driven as a person would."""

    page: "Page"
    messages: list[str] = field(default_factory=list)
    requests: list[str] = field(default_factory=list)
    #: A test has left it as it was at its end, in any mode and with any case.
    left: bool = False

    def call(self, expression: str, argument: Any = None) -> Any:
        return self.page.evaluate(expression, argument)

    def load(self, text: str) -> dict[str, Any]:
        found: dict[str, Any] = self.page.evaluate("text => kempe.load(text)", text)
        return found

    def toml(self) -> str:
        found: str = self.page.evaluate("kempe.toml()")
        return found

    def tree(self) -> dict[str, Any]:
        """The tree of the case that is drawn, as kempe reads it."""
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "drawn.toml"
            path.write_text(self.toml(), encoding="utf-8")
            return kp.load(path).tree()

    def state(self) -> dict[str, Any]:
        found: dict[str, Any] = self.page.evaluate("kempe.state()")
        return found

    def quantity(self, name: str) -> float:
        found: float = self.page.evaluate("name => kempe.quantity(name).then(x => x.value)", name)
        return found

    def screen(self, x: float, y: float) -> tuple[float, float]:
        px, py = self.page.evaluate("at => kempe.screen(at)", [x, y])
        return px, py

    def click(self, x: float, y: float) -> None:
        self.page.mouse.click(*self.screen(x, y))
        self.settle()

    def tool(self, name: str) -> None:
        self.page.locator(f".left [data-type={name}]").click()

    def mode(self, name: str) -> None:
        self.page.locator(f"#mode-{name}").click()
        if name != "live":
            self.settle()

    def message(self) -> str:
        found: str = self.page.locator("#message").inner_text()
        return found

    def settle(self) -> None:
        """Wait until the core has answered what was sent before, and the answer is drawn."""
        self.page.evaluate("kempe.settled().then(() => new Promise(requestAnimationFrame))")

    def wait(self, condition: str, seconds: float = 10.0) -> None:
        """Wait for a condition; playwright's own waiting is forbidden by the policy of the page."""
        end = time.monotonic() + seconds
        while not self.page.evaluate(condition):
            assert time.monotonic() < end, condition
            self.page.wait_for_timeout(20)


class Mouse:
    """Drags with the left button."""

    def __init__(self, one: Studio) -> None:
        self._mouse = one.page.mouse

    def down(self, x: float, y: float) -> None:
        self._mouse.move(x, y)
        self._mouse.down()

    def move(self, x: float, y: float) -> None:
        self._mouse.move(x, y)

    def up(self) -> None:
        self._mouse.up()


class Finger:
    """Drags with one finger, in a context with touch."""

    def __init__(self, one: Studio) -> None:
        self._session = one.page.context.new_cdp_session(one.page)

    def _send(self, kind: str, *points: dict[str, float]) -> None:
        event = {"type": kind, "touchPoints": list(points)}
        self._session.send("Input.dispatchTouchEvent", event)

    def down(self, x: float, y: float) -> None:
        self._send("touchStart", {"x": x, "y": y})

    def move(self, x: float, y: float) -> None:
        self._send("touchMove", {"x": x, "y": y})

    def up(self) -> None:
        self._send("touchEnd")


Opener = Callable[..., Studio]
