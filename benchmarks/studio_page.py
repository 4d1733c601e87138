"""Measure the built page of the studio in Chromium.

    python benchmarks/studio_page.py               # all measurements, ten minutes of play
    python benchmarks/studio_page.py --minutes 1

The program prints the size of the page, the time to the first picture, the times of drags and
drawings, the growth of the heap during play, and the violations that axe-core finds in each mode.
It needs the built page, Chromium (or $CHROMIUM), playwright, and `npm ci` in studio/ for axe-core.
"""

from __future__ import annotations

import argparse
import gzip
import math
import os
import shutil
import statistics
from pathlib import Path
from typing import TYPE_CHECKING, Any

from playwright.sync_api import sync_playwright

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page

STUDIO = Path(__file__).parents[1] / "studio"
PAGE = STUDIO / "dist" / "index.html"
AXE = STUDIO / "node_modules" / "axe-core" / "axe.min.js"
EXAMPLES = Path(__file__).parents[1] / "examples"
MODES = ("edit", "move", "live", "read")
STARTS = 7
MOVES = 150
#: Notes how long the core takes for each drag and the page for each drawing, ms.
WATCH = """
  window.times = { drag: [], draw: [] };
  const sent = new Map();
  const post = Worker.prototype.postMessage;
  Worker.prototype.postMessage = function (message, ...more) {
    if (!this.watched) {
      this.watched = true;
      this.addEventListener("message", ({ data }) => {
        const began = sent.get(data.number);
        if (began) times.drag.push(performance.now() - began);
      });
    }
    if (message.request?.startsWith('{"do":"drag"')) sent.set(message.number, performance.now());
    return post.call(this, message, ...more);
  };
  let painted = false;
  const clear = CanvasRenderingContext2D.prototype.clearRect;
  CanvasRenderingContext2D.prototype.clearRect = function (...box) {
    painted ||= this.canvas.id === "sheet";
    return clear.apply(this, box);
  };
  const request = window.requestAnimationFrame.bind(window);
  window.requestAnimationFrame = (call) => request((t) => {
    painted = false;
    const began = performance.now();
    call(t);
    if (painted) times.draw.push(performance.now() - began);
  });
"""


def linkage(windows: int) -> str:
    """Four-bar windows in a row: one degree of freedom, 2 `windows` + 1 bodies."""
    lines = ["kempe = 1", "gravity = [0, -9.81]", "[bodies.ground]", "points = {"]
    lines[-1] += ", ".join(f"G{k} = [{k}, 0]" for k in range(windows + 1)) + " }"
    length = windows / 10  # long enough for the mouse
    x, y = length * math.cos(1.2), length * math.sin(1.2)
    for k in range(windows + 1):
        lines += [f"[bodies.link{k}]", 'type = "bar"', "mass = 1"]
        lines += [f"through = {{ A = [{k}, 0], B = [{k + x}, {y}] }}"]
        lines += [f"[joints.A{k}]", 'type = "revolute"', f'i = "ground.G{k}"', f'j = "link{k}.A"']
    for k in range(windows):
        lines += [f"[bodies.bar{k}]", 'type = "bar"', "mass = 1"]
        lines += [f"through = {{ L = [{k + x}, {y}], R = [{k + 1 + x}, {y}] }}"]
        for side, link in (("L", k), ("R", k + 1)):
            lines += [f"[joints.{side}{k}]", 'type = "revolute"']
            lines += [f'i = "link{link}.B"', f'j = "bar{k}.{side}"']
    return "\n".join(lines) + "\n"


def opened(browser: Browser, **more: Any) -> Page:
    """The page in a context of its own, with its first case drawn."""
    page = browser.new_context(viewport={"width": 1280, "height": 800}, **more).new_page()
    page.add_init_script(WATCH)
    page.add_init_script("localStorage.setItem('kempe.visited', '1')")
    page.goto(PAGE.as_uri())
    while not page.evaluate("performance.getEntriesByName('first picture').length"):
        page.wait_for_timeout(20)
    page.evaluate("kempe.settled()")
    return page


def first_picture(browser: Browser) -> float:
    """The time from the address to the first drawn mechanism, ms; median of cold starts."""
    times = []
    for _ in range(STARTS):
        page = opened(browser)
        times.append(page.evaluate("performance.getEntriesByName('first picture')[0].startTime"))
        page.context.close()
    return statistics.median(times)


def p95(times: list[float]) -> float:
    """The time that 95 % of the times do not exceed."""
    return sorted(times)[math.ceil(0.95 * len(times)) - 1]


def dragged(browser: Browser, windows: int) -> tuple[int, dict[str, list[float]]]:
    """Times of the core and the page while the mouse turns the first link of a linkage."""
    page = opened(browser)
    page.evaluate("text => kempe.load(text)", linkage(windows))
    page.locator("#mode-move").click()
    page.evaluate("kempe.settled()")
    before = page.evaluate("kempe.state()")["q"]

    def move(angle: float) -> None:
        at = [windows / 10 * math.cos(angle), windows / 10 * math.sin(angle)]
        page.mouse.move(*page.evaluate("at => kempe.screen(at)", at))

    move(1.2)
    page.mouse.down()
    page.evaluate("times.drag.length = times.draw.length = 0")
    for k in range(MOVES):
        move(1.2 + 0.6 * math.sin(k / 8))
        page.wait_for_timeout(20)
    times: dict[str, list[float]] = page.evaluate("times")
    assert page.evaluate("kempe.state()")["q"] != before
    page.context.close()
    return 2 * windows + 1, times


def heap_growth(browser: Browser, minutes: float) -> float:
    """Growth of the JavaScript heap after garbage collection while a mechanism is live, kB."""
    page = opened(browser)
    page.evaluate("text => kempe.load(text)", (EXAMPLES / "pendulum.toml").read_text("utf-8"))
    page.locator("#mode-live").click()
    tools = page.context.new_cdp_session(page)
    tools.send("Performance.enable")

    def used() -> float:
        page.evaluate("times.drag.length = times.draw.length = 0")
        tools.send("HeapProfiler.collectGarbage")
        metrics = tools.send("Performance.getMetrics")["metrics"]
        return float(next(m["value"] for m in metrics if m["name"] == "JSHeapUsedSize"))

    page.wait_for_timeout(5000)
    before = used()
    page.wait_for_timeout(60_000 * minutes)
    grown = used() - before
    assert page.evaluate("kempe.state()")["t"] > 30 * minutes
    page.context.close()
    return grown / 1024


def violations(browser: Browser) -> dict[str, list[str]]:
    """The rules of axe-core that each mode violates."""
    page = opened(browser, bypass_csp=True)
    page.add_script_tag(path=AXE)
    found = {}
    for mode in MODES:
        page.locator(f"#mode-{mode}").click()
        page.wait_for_timeout(1500)
        result = page.evaluate("axe.run()")
        found[mode] = [
            f"{one['id']}: {one['nodes'][0]['html'][:120]}" for one in result["violations"]
        ]
    page.context.close()
    return found


def main() -> None:
    """Print all measurements."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--minutes", type=float, default=10, help="minutes of play")
    minutes = parser.parse_args().minutes
    size = len(gzip.compress(PAGE.read_bytes(), 9))
    print(f"size of the page, compressed: {size / 1024:.0f} kB")
    path = os.environ.get("CHROMIUM") or shutil.which("chromium")
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=path, args=["--no-sandbox"])
        print(f"first picture from a cold start: {first_picture(browser):.0f} ms (median)")
        for windows in (25, 100):
            count, times = dragged(browser, windows)
            for what, words in (("drag", "the core moves them"), ("draw", "the page draws them")):
                middle = statistics.median(times[what])
                print(f"{count} bodies, {words}: {middle:.1f} ms, p95 {p95(times[what]):.1f} ms")
        for mode, found in violations(browser).items():
            print(f"axe-core, mode {mode}: {len(found)} violations", *found, sep="\n  ")
        print(f"heap growth in {minutes:g} minutes: {heap_growth(browser, minutes):.0f} kB")
        browser.close()


if __name__ == "__main__":
    main()
