"""Values in notebooks: players, figures and tables, as well-formed HTML with the right numbers."""

import html
import json
import re
import xml.etree.ElementTree as ET
from typing import Any

import kempe as kp
import numpy as np
import pytest
from house.places import ROOT


@pytest.fixture(scope="module")
def case() -> kp.Case:
    return kp.load(ROOT / "examples" / "four_bar.toml").with_analysis("release", t_end=0.2)


@pytest.fixture(scope="module")
def sol(case: kp.Case) -> kp.Solution:
    found = case.run()[0]
    assert isinstance(found, kp.Solution)
    return found


def parsed(of: Any) -> ET.Element:
    return ET.fromstring(of._repr_html_().replace("&nbsp;", " "))


def cells(root: ET.Element) -> list[list[str]]:
    return [["".join(cell.itertext()) for cell in row] for row in root.iter("tr")]


def scene_of(frame: ET.Element) -> dict[str, Any]:
    """The scene in the page of a player."""
    texts = re.findall(
        r"<script[^>]*application/json[^>]*>(.*?)</script>", frame.attrib["srcdoc"], re.S
    )
    found = next(json.loads(text) for text in texts if "frames" in text)
    assert isinstance(found, dict)
    return found


def test_a_solution_plays(sol: kp.Solution) -> None:
    root = parsed(sol)
    (frame,) = root.iter("iframe")
    scene = scene_of(frame)
    assert scene["frames"]["t"][0] == 0.0
    assert scene["frames"]["t"][-1] == pytest.approx(sol.t[-1])
    assert "Content-Security-Policy" in frame.attrib["srcdoc"]
    assert ["time", f"0 to {sol.t[-1]:g} s, {len(sol.t)} outputs"] in cells(root)


def test_animate_without_a_path_is_the_player(sol: kp.Solution, tmp_path: Any) -> None:
    player = kp.animate(sol)
    kp.animate(sol, tmp_path / "page.html")
    assert player.page == (tmp_path / "page.html").read_text("utf-8")
    frame = parsed(player)
    assert frame.tag == "iframe"
    (page,) = re.findall(r'srcdoc="([^"]*)"', player._repr_html_())
    assert html.unescape(page) == player.page
    slow = scene_of(parsed(kp.animate(sol, speed=0.5)))
    rate = scene_of(frame)["playback"]["rate"]
    assert slow["playback"]["rate"] == pytest.approx(0.5 * rate)
    with pytest.raises(kp.ModelError, match="speed"):
        kp.animate(sol, speed=0.0)


def test_matrices_have_their_names_and_numbers(case: kp.Case) -> None:
    found = case.start().matrices()
    rows = cells(parsed(found))
    assert ["Phi_q", "8 × 9"] in rows and ["kkt", "17 × 17"] in rows
    for name, values in zip(found.rows, found.Phi_q, strict=True):
        shown = next(row for row in rows if row[0] == name)[1:]
        read = [0.0 if cell == "·" else float(cell) for cell in shown]
        assert read == pytest.approx(values, rel=1e-3)


def test_results_have_report_figure_and_table(case: kp.Case) -> None:
    start = case.start()
    results = {
        "limits": kp.limits(case.model, start, over="crank.angle"),
        "modes": kp.modes(case.model, kp.equilibrium(case.model, start).final),
        "mobility": kp.mobility(case.model, start),
        "configurations": kp.configurations(case.model, {"crank.angle": 1.0}),
    }
    for name, result in results.items():
        root = parsed(result)
        text = "".join(root.itertext())
        assert all(line.strip() in text for line in result.report()), name
        assert any(tag.tag.endswith("svg") for tag in root.iter()) is (name != "mobility"), name
    table = next(iter(results["modes"].tables().values()))
    rows = cells(parsed(results["modes"]))
    assert [column.label for column in table] in rows
    assert [f"{column.values[0]:.6g}" for column in table] in rows


def test_a_sweep_has_ranges_and_rows(case: kp.Case) -> None:
    result = kp.sweep(case, {"k": np.linspace(1e6, 2e6, 12)}, ["C.force.max"])
    rows = cells(parsed(result))
    values = result["C.force.max"]
    ends = [f"{of:.6g}" for of in (values.min(), values.mean(), values.max())]
    assert ["C.force.max", "N", *ends] in rows
    assert sum(row[0] == f"{k:.6g}" for row in rows for k in result["k"]) == 10


def test_names_cannot_inject_html() -> None:
    m = kp.Model("</iframe><script>alert(1)</script>", gravity=(0, -9.81))
    m.ground.points(O=(0, 0))
    m.bar("rod", mass=1, length=1, ends=("A", "B"))
    m.revolute("A", "ground.O", "rod.A")
    sol = kp.dynamics(m, kp.assemble(m), t_end=0.1)
    for of in (sol, kp.animate(sol), kp.equilibrium(m, sol.final), sol.final.matrices()):
        assert "<script>" not in of._repr_html_()
        parsed(of)
