"""The flagship drawn from nothing by mouse, released, and read; kempe run reads the same tree."""

import subprocess
import sys
from pathlib import Path

import kempe as kp
import pytest
from studio.window import Opener, Studio

EXAMPLE = Path(__file__).parents[2] / "examples" / "four_bar.toml"
# The reaction at C at the start, N.
REACTION = 24932.06738951351


def fill(one: Studio, label: str, value: str) -> None:
    """Type a value into a field of the panel."""
    field = one.page.get_by_label(label, exact=True)
    field.fill(value)
    field.press("Enter")
    one.settle()


def deselect(one: Studio) -> None:
    one.page.locator("#sheet").focus()
    one.page.keyboard.press("Escape")
    one.page.keyboard.press("Escape")
    one.settle()


def bar(one: Studio, begin: tuple[float, float], length: str, end: tuple[float, float]) -> None:
    """A bar from a place in the direction of another, with its length typed in."""
    one.click(*begin)
    one.page.keyboard.type(length)
    one.click(*end)


def draw_linkage(one: Studio) -> None:
    """Two fixed points, three bars of the flagship, and the pin that closes the loop."""
    one.page.locator("#new").click()
    one.settle()
    one.page.locator("#sheet").focus()
    for _ in range(15):
        one.page.keyboard.press("-")
    one.settle()
    one.tool("ground")
    one.click(0, 0)
    one.click(20, 0)
    one.tool("bar")
    bar(one, (0, 0), "10", (0, 8))
    bar(one, (0, 10), "26", (24, 10))
    bar(one, (20, 18), "18", (20, 2))
    one.tool("revolute")
    one.click(26, 10)
    one.click(20, 18)
    deselect(one)


def write_properties(one: Studio) -> None:
    """Names and masses of the bars, in the panel."""
    bars = (("bar1", "crank", "3"), ("bar2", "coupler", "5"), ("bar3", "rocker", "4"))
    for old, name, mass in bars:
        one.page.locator(".contents button").filter(has_text=old).first.click()
        fill(one, "mass", mass)
        fill(one, "Name", name)
        deselect(one)
    fill(one, "Gravity", "0, -9.81")
    one.page.get_by_label("Add an analysis").click()
    one.settle()


def add_spring(one: Studio) -> None:
    """The rotational spring and damper between ground and rocker."""
    one.tool("torsion_spring")
    one.click(-5, -5)
    one.click(one.quantity("rocker.x"), one.quantity("rocker.y"))
    for field, value in (("stiffness", "1e6"), ("damping", "1e4"), ("free_angle", "270*deg")):
        fill(one, field, value)
    deselect(one)


def prescribe(one: Studio, name: str, value: str) -> None:
    one.page.locator("#start-name").fill(name)
    one.page.locator("#start-value").fill(value)
    one.page.locator("#start-value").press("Enter")
    one.settle()


def test_the_flagship_is_drawn_released_and_read(fresh: Opener, tmp_path: Path) -> None:
    one = fresh(accept_downloads=True)
    draw_linkage(one)
    write_properties(one)
    prescribe(one, "crank.angle", "70*deg")
    add_spring(one)
    assert one.tree()["start"]["set"] == {"crank.angle": "70*deg"}
    assert one.page.locator("#freedom").inner_text() == "1 degree of freedom"
    one.page.locator(".contents button").filter(has_text="revolute").last.click()
    fill(one, "Name", "top")
    # the panel shows the reaction, and the page has it with all digits
    one.wait("document.querySelector('.side').innerText.includes('24.93 kN')")
    drawn = one.quantity("top.force")
    assert drawn == pytest.approx(REACTION, rel=1e-9)
    assert drawn == pytest.approx(kp.load(EXAMPLE).start()["C.force"], rel=1e-9)

    one.mode("live")  # let go
    one.wait("kempe.state().then(state => state.t > 0.5)")
    one.page.keyboard.press("Space")
    one.settle()
    t, crank = one.state()["t"], one.quantity("crank.angle")
    case = kp.load(EXAMPLE)
    run = kp.dynamics(case.model, case.start(), t_end=t, output_step=t / 100)
    assert crank == pytest.approx(run["crank.angle"][-1], abs=1e-3)

    one.mode("edit")
    with one.page.expect_download() as saved:
        one.page.locator("#save").click()
    path = tmp_path / "drawn.toml"
    saved.value.save_as(path)
    assert kp.load(path).tree() == one.tree()
    folder = tmp_path / "results"
    command = [sys.executable, "-m", "kempe", "run", str(path), "-o", str(folder), "-q"]
    command += ["--figures", "none"]
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=120)
    assert done.returncode == 0, done.stderr
    force = kp.load_solution(folder / "solution.npz")["top.force"]
    assert force[0] == pytest.approx(REACTION, rel=1e-9)
