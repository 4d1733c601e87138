"""Reading results: display units, and a stored run beside the present one."""

import re
from pathlib import Path

import kempe as kp
import numpy as np
import pytest
from studio.window import Studio

EXAMPLES = Path(__file__).parents[2] / "examples"
CASE = EXAMPLES / "pendulum.toml"
#: A number with its unit, and the units that the test has.
MEASURED = re.compile(r"(−?[\d.]+) (mm|µm|m|N|mN|kN)")
SCALES = {"m": 1.0, "mm": 1e-3, "µm": 1e-6, "N": 1.0, "mN": 1e-3, "kN": 1e3}


def plot_only(one: Studio, quantity: str) -> None:
    """One plot with one curve."""
    one.page.get_by_label("Add plot").select_option(quantity)
    one.settle()


def shown(one: Studio, word: str, quantity: str) -> float:
    """The number behind a word in the legend of a quantity."""
    entry = one.page.locator(".legend li").filter(has_text=quantity).last.inner_text()
    found = re.search(rf"{word} (−?[\d.]+)", entry)
    assert found, entry
    return float(found[1].replace("−", "-"))


def choose(one: Studio, path: Path) -> None:
    with one.page.expect_file_chooser() as chooser:
        one.page.locator("#compare").click()
    chooser.value.set_files(path)
    one.page.wait_for_timeout(300)
    one.settle()


def test_speeds_are_shown_in_rpm_and_angles_in_degrees(one: Studio) -> None:
    one.load(CASE.read_text(encoding="utf-8"))
    one.mode("read")
    plot_only(one, "rod.omega")
    omega = kp.load(CASE).run()["swing"]["rod.omega"]
    peak = omega[np.abs(omega).argmax()]
    assert shown(one, "peak", "rod.omega") == pytest.approx(peak * 30 / np.pi, rel=1e-3)
    assert "rpm" in one.page.locator(".legend").last.inner_text()
    one.page.get_by_text("° and rpm").click()
    one.settle()
    assert shown(one, "peak", "rod.omega") == pytest.approx(peak, rel=1e-3)
    one.page.get_by_text("° and rpm").click()


def test_long_names_leave_the_plot_in_its_panel(one: Studio) -> None:
    one.load((EXAMPLES / "jansen_leg.toml").read_text(encoding="utf-8"))
    one.mode("read")
    one.page.wait_for_timeout(300)
    edge = "(name) => document.querySelector(name).getBoundingClientRect().right"
    panel = one.call(edge, ".results")
    for part in (".plot", ".plot .curves", ".legend li:last-child button", ".plot .chip"):
        assert one.call(edge, part) <= panel, part


def test_a_stored_run_is_drawn_dashed_in_the_same_plots(one: Studio, tmp_path: Path) -> None:
    solution = kp.load(CASE, parameters={"L": 2}).run()["swing"]
    path = tmp_path / "longer.npz"
    solution.save(path)
    one.load(CASE.read_text(encoding="utf-8"))
    one.mode("read")
    plot_only(one, "rod.alpha")
    one.call(
        """() => {
          window.dashes = 0;
          const dash = CanvasRenderingContext2D.prototype.setLineDash;
          CanvasRenderingContext2D.prototype.setLineDash = function (lengths) {
            if (lengths.length && this.canvas.id !== "sheet") window.dashes += 1;
            return dash.call(this, lengths);
          };
        }"""
    )
    assert one.page.locator("p.stored").count() == 0
    choose(one, path)
    assert "longer.npz" in one.message()
    assert one.call("dashes") > 0
    for name, factor in (("rod.angle", 180 / np.pi), ("rod.alpha", 180 / np.pi)):
        peak = solution[name][np.abs(solution[name]).argmax()] * factor
        assert shown(one, "stored", name) == pytest.approx(peak, rel=1e-3)
    one.page.locator("p.stored button").click()
    one.wait("![...document.querySelectorAll('.legend')].at(-1).innerText.includes('stored')")


def test_a_file_that_is_no_run_of_the_mechanism_gives_a_message(
    one: Studio, tmp_path: Path
) -> None:
    one.load(CASE.read_text(encoding="utf-8"))
    one.mode("read")
    path = tmp_path / "other.npz"
    kp.load(EXAMPLES / "four_bar.toml").run()["release"].save(path)
    choose(one, path)
    assert "not a stored run" in one.message()
    path.write_bytes(b"PK no zip")
    choose(one, path)
    assert "not a stored run" in one.message()


def test_measures_of_the_case_and_typed_ones_have_the_numbers_of_python(
    one: Studio, tmp_path: Path
) -> None:
    path = tmp_path / "measured.toml"
    path.write_text(CASE.read_text(encoding="utf-8") + '[measures]\npeg = "pin.force"\n')
    solution = kp.load(path).run()["swing"]
    one.load(path.read_text(encoding="utf-8"))
    one.mode("read")
    one.page.get_by_label("Measure a quantity").first.fill("rod.x")
    one.page.keyboard.press("Enter")
    one.settle()
    texts = one.page.locator(".measure").all_inner_texts()
    for text, name in zip(texts, ("pin.force", "rod.x"), strict=True):
        values = solution[name]
        mean = np.trapezoid(values, solution.t) / solution.t[-1]
        numbers = [(float(x.replace("−", "-")), u) for x, u in MEASURED.findall(text)]
        found = [x * SCALES[u] for x, u in numbers]
        peak = values[np.abs(values).argmax()]
        assert found == pytest.approx([peak, mean, values[-1]], rel=1e-3), text
    one.page.get_by_label("Measure a quantity").first.fill("rod.colour")
    one.page.keyboard.press("Enter")
    one.settle()
    assert "no quantity 'rod.colour'" in one.page.locator(".measure .problem").inner_text()


def test_another_case_has_plots_of_its_own(one: Studio) -> None:
    for name in ("slider_crank", "four_bar"):  # both have a crank
        one.load((EXAMPLES / f"{name}.toml").read_text(encoding="utf-8"))
        one.mode("read")
        one.settle()
    legend = one.page.locator(".legend li").all_inner_texts()
    names = [entry.split()[0] for entry in legend]
    assert names == ["crank.angle", "coupler.angle", "rocker.angle"]


#: A beam between two pins, which share its load, and a pendulum beside it.
BEAM = """kempe = 1
redundancy = "allow"
gravity = [0, -9.81]
[bodies.ground]
points = { A = [0, 0], B = [2, 0], P = [0.5, -0.5] }
[bodies.beam]
mass = 3
inertia = 1
points = { A = [-1, 0], B = [1, 0] }
[bodies.rod]
type = "bar"
mass = 1
length = 1
ends = ["P", "Q"]
[joints]
A = { type = "revolute", i = "ground.A", j = "beam.A" }
B = { type = "revolute", i = "ground.B", j = "beam.B" }
P = { type = "revolute", i = "ground.P", j = "rod.P" }
[start]
set = { "beam.x" = 1, "beam.y" = 0, "beam.angle" = 0, "rod.angle" = -1 }
[analyses.swing]
type = "dynamics"
t_end = 0.5
"""


def test_reactions_that_are_not_unique_have_a_star_and_a_note(one: Studio, tmp_path: Path) -> None:
    one.load(BEAM)
    one.mode("read")
    for name in ("A.fx", "A.fy", "P.fy", "rod.angle"):
        plot_only(one, name)
    path = tmp_path / "beam.toml"
    path.write_text(BEAM, encoding="utf-8")
    names = sorted(kp.load(path).run()["swing"].not_unique)
    assert names == ["A", "B"]
    note = one.page.locator("#not-unique").inner_text()
    assert note.endswith(f"(minimum norm): {', '.join(names)}.")
    entries = one.page.locator(".legend .name").all_inner_texts()
    assert [entry for entry in entries if entry.endswith("*")] == ["A.fx *", "A.fy *"]
    one.load(BEAM.replace('B = { type = "revolute", i = "ground.B", j = "beam.B" }\n', ""))
    one.mode("read")
    assert one.page.locator("#not-unique").count() == 0
    assert "*" not in "".join(one.page.locator(".legend .name").all_inner_texts())


FEET = """kempe = 1
gravity = [0, -9.81]
[bodies.ground]
curves.floor.line = [[9, 0], [-9, 0]]
[bodies.beam]
mass = 2
inertia = 1
points = { A = [-1, 0], B = [0.5, 0], C = [1, 0] }
[forces.a]
type = "contact"
i = "beam.A"
curve = "ground.floor"
restitution = 0
[forces.b]
type = "contact"
i = "beam.B"
curve = "ground.floor"
restitution = 0
[forces.c]
type = "contact"
i = "beam.C"
curve = "ground.floor"
restitution = 0
[analyses.rest]
type = "dynamics"
t_end = 0.1
"""


def test_loads_that_feet_share_have_a_star_and_a_note(one: Studio, tmp_path: Path) -> None:
    one.load(FEET)
    one.mode("read")
    for name in ("a.fy", "b.fy", "beam.y"):
        plot_only(one, name)
    path = tmp_path / "feet.toml"
    path.write_text(FEET, encoding="utf-8")
    assert sorted(kp.load(path).run()["rest"].choices) == ["a", "b", "c"]
    assert one.page.locator("#shared").inner_text().endswith("one of them is shown: a, b, c.")
    entries = one.page.locator(".legend .name").all_inner_texts()
    assert [entry for entry in entries if entry.endswith("*")] == ["a.fy *", "b.fy *"]
    # two feet share the load in one way
    one.load(FEET[: FEET.index("[forces.c]")] + FEET[FEET.index("[analyses.rest]") :])
    one.mode("read")
    assert one.page.locator("#shared").count() == 0
    assert "*" not in "".join(one.page.locator(".legend .name").all_inner_texts())
