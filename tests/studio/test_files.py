"""Files that the page gives, read by other programs and compared with the results of Python."""

import csv
import re
from pathlib import Path
from xml.etree import ElementTree

import kempe as kp
import numpy as np
import pytest
from studio.window import Studio

EXAMPLES = Path(__file__).parents[2] / "examples"
CASE = EXAMPLES / "four_bar.toml"
NAMES = ["crank.angle", "coupler.angle", "rocker.angle"]
NUMBER = re.compile(r"-?\d+(?:\.\d+)?")
#: What moves with a body is drawn in its frame.
MOVED = re.compile(
    rf"translate\(({NUMBER.pattern}) ({NUMBER.pattern})\)rotate\(({NUMBER.pattern})\)"
)


@pytest.fixture(scope="module")
def solution() -> kp.Solution:
    return kp.load(CASE).run()["release"]


def given(one: Studio, hint: str, path: Path) -> Path:
    """The file of a button."""
    with one.page.expect_download() as download:
        one.page.locator(f"button[title='{hint}']").click()
    assert Path(download.value.suggested_filename).suffix == path.suffix
    download.value.save_as(path)
    return path


def read_the_flagship(one: Studio) -> None:
    one.load(CASE.read_text(encoding="utf-8"))
    one.mode("read")
    one.settle()


def test_csv_has_the_curves_of_the_plots(
    one: Studio, solution: kp.Solution, tmp_path: Path
) -> None:
    read_the_flagship(one)
    hint = "Save the plotted curves as CSV, in SI units and rad"
    path = given(one, hint, tmp_path / "curves.csv")
    with path.open(encoding="utf-8") as file:
        head = next(csv.reader(file))
    assert head == ["t [s]", *(f"{name} [rad]" for name in NAMES)]
    table = np.loadtxt(path, delimiter=",", skiprows=1)
    assert table.shape == (len(solution.t), 4)
    np.testing.assert_allclose(table[:, 0], solution.t, rtol=0, atol=1e-12)
    for column, name in zip(table.T[1:], NAMES, strict=True):
        np.testing.assert_allclose(column, solution[name], rtol=1e-9, atol=1e-9)


def test_npz_has_times_poses_and_curves(one: Studio, solution: kp.Solution, tmp_path: Path) -> None:
    read_the_flagship(one)
    one.page.get_by_label("Add plot").select_option("C.force")
    one.settle()
    hint = "Save times, poses and plotted quantities for NumPy"
    path = given(one, hint, tmp_path / "run.npz")
    with np.load(path) as found:
        assert set(found) == {"t", "variable", "crank", "coupler", "rocker", *NAMES, "C.force"}
        assert list(found["variable"]) == ["t", "s"]
        np.testing.assert_allclose(found["t"], solution.t, rtol=0, atol=1e-12)
        rocker = solution["rocker"]
        poses = np.column_stack([rocker.x, rocker.y, rocker.angle])
        np.testing.assert_allclose(found["rocker"], poses, rtol=1e-9, atol=1e-9)
        force = np.hypot(*solution["C"].force(on="rocker").T)
        np.testing.assert_allclose(found["C.force"], force, rtol=1e-7)


def test_svg_has_the_pins_where_python_has_them(one: Studio, tmp_path: Path) -> None:
    one.load(CASE.read_text(encoding="utf-8"))
    path = given(one, "Save the drawing as SVG", tmp_path / "drawing.svg")
    root = ElementTree.parse(path).getroot()
    space = "{http://www.w3.org/2000/svg}"
    texts = {element.text for element in root.iter(f"{space}text")}
    assert {"A", "B", "C", "D", "1", "2", "3", "spring", "g"} <= texts
    centres = []
    for element in root.iter(f"{space}path"):
        d, moved = element.get("d", ""), element.get("transform", "")
        if d.endswith("Z"):
            x, y, angle = MOVED.fullmatch(moved).groups() if moved else (0, 0, 0)  # type: ignore[union-attr]
            numbers = np.array([float(x) for x in NUMBER.findall(d)]).reshape(-1, 2)
            middle = complex(*(numbers.min(axis=0) + numbers.max(axis=0)) / 2)
            placed = middle * np.exp(1j * np.radians(float(angle)))
            centres.append(np.array([placed.real + float(x), placed.imag + float(y)]))
    start = kp.load(CASE).start()
    corner = one.page.locator("#sheet").bounding_box()
    assert corner is not None
    for point in ("crank.A", "crank.B", "rocker.C", "rocker.D"):
        x, y = one.screen(start[f"{point}.x"], start[f"{point}.y"])
        at = np.array([x - corner["x"], y - corner["y"]])
        assert min(np.linalg.norm(centre - at) for centre in centres) < 0.1, point
