"""The report of the four-bar linkage contains what design notes and reference results list."""

import json
import math
from collections.abc import Callable

import pytest
from house.places import ROOT
from lab_report.conftest import Reported
from lab_report.pages import Page

REFERENCE = json.loads((ROOT / "tests" / "reference" / "four_bar.json").read_text("utf-8"))
START = REFERENCE["start"]
BODIES = ("crank", "coupler", "rocker")
POINTS = {"A": (0.0, 0.0), "D": (20.0, 0.0)}


@pytest.fixture
def page(reported: Callable[[str], Reported]) -> Page:
    return reported("four_bar").page


def test_the_sections_are_those_of_a_laboratory_report(page: Page) -> None:
    wanted = [
        "Summary",
        "Mechanism",
        "Data",
        "Joints and their equations",
        "Initial configuration, t = 0 s",
        "Assembly",
        "Mass matrix",
        "Jacobian",
        "Accelerations and multipliers",
        "Method",
        "Analysis release",
        "Results of release",
        "Motion",
        "Settling",
        "Forces",
        "Reactions",
        "Accuracy",
        "Energy",
        "Study of stabilization, method and tolerance",
        "Findings",
        "Figures",
        "Model file",
    ]
    assert page.headings == wanted


def test_the_data_are_those_of_the_linkage(page: Page) -> None:
    lengths, masses = (10.0, 26.0, 18.0), (3.0, 5.0, 4.0)
    for number, (name, length, mass) in enumerate(zip(BODIES, lengths, masses, strict=True), 1):
        expected = [mass, mass * length**2 / 12.0, 0.0, 0.0]
        assert page.table("Bodies").values(str(number), name) == pytest.approx(expected)
    parameters = page.table("Parameters")
    assert parameters.values("k") == [1e6]
    assert parameters.values("c") == [1e4]
    for name, at in POINTS.items():
        assert page.table("Points").values("ground", name) == [*at, *at]
    assert any("[0, −9.81] m/s²" in told for told in page.paragraphs)
    stiffness, damping, free = page.table("Force elements").rows
    assert [cell.text for cell in stiffness[2:]] == ["stiffness", "k", "1·10⁶", "N·m/rad"]
    assert [cell.text for cell in damping[2:]] == ["damping", "c", "10000", "N·m·s/rad"]
    assert [cell.text for cell in free[2:]] == ["free_angle", "270*deg", "4.71239", "rad"]
    assert any("bar" in told and "mass length^2/12" in told for told in page.paragraphs)


def test_the_points_of_the_bodies_meet_at_the_start(page: Page) -> None:
    points = page.table("Points")
    for one, other in ((("crank", "B"), ("coupler", "B")), (("coupler", "C"), ("rocker", "C"))):
        assert points.values(*one)[2:] == pytest.approx(points.values(*other)[2:], abs=1e-12)
    crank = [10.0 * math.cos(math.radians(70)), 10.0 * math.sin(math.radians(70))]
    assert points.values("crank", "B")[2:] == pytest.approx(crank, rel=1e-12)


def test_the_initial_coordinates_are_those_of_the_reference(page: Page) -> None:
    table = page.table("Coordinates q")
    for k, name in enumerate(BODIES):
        x, y, angle, degrees, *rates = table.values(name)
        assert [x, y, angle] == pytest.approx(START["q"][3 * k : 3 * k + 3], rel=1e-12)
        assert degrees == angle
        assert table.row(name)[4].printed == pytest.approx(math.degrees(angle), rel=1e-5)
        assert rates == [0.0, 0.0, 0.0]


def test_the_start_is_assembled_by_newtons_method(page: Page) -> None:
    assert [cell.text for cell in page.table("Request").row("set")] == [
        "set",
        "crank.angle",
        "70*deg",
    ]
    rows = page.table("Newton–Raphson").rows
    residuals = [row[1].value for row in rows]
    assert residuals == sorted(residuals, reverse=True)
    assert residuals[-1] < 1e-12 < residuals[0]
    for later, earlier in zip(residuals[2:], residuals[1:], strict=False):
        assert later < max(10.0 * earlier**2, 1e-14)  # quadratic
    assert page.table("Largest residuals").rows[0][2].value < 1e-12


def test_the_jacobian_is_that_of_the_reference(page: Page) -> None:
    table = page.table("Jacobian")
    names = [f"{body}.{of}" for body in BODIES for of in ("x", "y", "angle")]
    assert [cell.name for cell in table.head[1][1:]] == names
    rows = [f"{joint}.{of}" for joint in "ABCD" for of in "xy"]
    assert [row[0].text for row in table.rows] == [*rows, "set.crank.angle"]
    for row, expected in zip(table.rows, REFERENCE["Phi_q_at_start_rounded"], strict=False):
        for cell, value in zip(row[1:], expected, strict=True):
            assert cell.value == pytest.approx(value, abs=0.06), row[0].text
            assert cell.text == "·" or cell.printed == pytest.approx(cell.value, abs=1e-4)
    assert any("17 × 17" in told for told in page.paragraphs)


def test_the_jacobian_is_the_derivative_of_the_residuals(page: Page) -> None:
    """Entries of the angles: ∓B s′ with the coordinates and points of the report."""
    table, coordinates, points = (
        page.table(name) for name in ("Jacobian", "Coordinates q", "Points")
    )
    joints = {"A": ("ground", "crank"), "B": ("crank", "coupler")}
    joints |= {"C": ("coupler", "rocker"), "D": ("ground", "rocker")}
    columns = [cell.name for cell in table.head[1]]
    for joint, ends in joints.items():
        for body, sign in zip(ends, (-1.0, 1.0), strict=True):
            if body == "ground":
                continue
            angle = coordinates.values(body)[2]
            s = points.values(body, joint)[0]
            k = columns.index(f"{body}.angle")
            expected = (-sign * s * math.sin(angle), sign * s * math.cos(angle))
            found = [table.row(f"{joint}.{of}")[k].value for of in "xy"]
            assert found == pytest.approx(expected, rel=1e-12)


def test_the_mass_matrix_has_masses_and_inertias(page: Page) -> None:
    table, bodies = page.table("Mass matrix M"), page.table("Bodies")
    for k, row in enumerate(table.rows):
        mass, inertia = bodies.values(str(k // 3 + 1), BODIES[k // 3])[:2]
        expected = [0.0] * 9
        expected[k] = inertia if k % 3 == 2 else mass
        assert [cell.value for cell in row[1:]] == pytest.approx(expected)


def test_accelerations_and_multipliers_are_those_of_the_reference(page: Page) -> None:
    table = page.table("Multipliers")
    names = [f"{joint}.{of}" for joint in "ABCD" for of in "xy"]
    assert [row[0].text for row in table.rows] == names
    assert [row[1].value for row in table.rows] == pytest.approx(START["lam"], rel=1e-9)
    for k, name in enumerate(BODIES):
        found = page.table("Accelerations").values(name)
        assert found == pytest.approx(START["a"][3 * k : 3 * k + 3], rel=1e-9)


def test_the_largest_reaction_of_joint_c_is_that_of_the_start(page: Page) -> None:
    x, y = START["lam"][4:6]
    force, at = page.table("Largest reactions").values("C", "rocker")
    assert force == pytest.approx(math.hypot(x, y), rel=1e-9)
    assert (24_900 < force < 25_000, at) == (True, 0.0)
    (torque, at, *_) = page.table("Largest forces").values("spring", "rocker")
    assert torque == pytest.approx(START["spring_damper_torque_on_rocker"], rel=1e-9)


def test_the_method_names_equations_and_options(
    page: Page, reported: Callable[[str], Reported]
) -> None:
    text = reported("four_bar").text
    for number in ("3.6.10", "3.6.11", "6.3.18", "6.6.8", "6.6.9", "7.3.8"):
        assert f'<span class="number">({number})</span>' in text
    options = page.table("Options of release")
    numbers = {"method.rtol": 1e-6, "method.atol": 1e-9, "t_end": 15.0, "output_step": 0.01}
    numbers |= {"stabilization.alpha": 10.0, "stabilization.beta": 200.0}
    assert {name: options.values(name)[0] for name in numbers} == numbers
    assert options.row("method")[1].text == "rk45"
    assert options.row("stabilization")[1].text == "baumgarte"
    rows, slopes, method = 8, 24, 8  # a pin between two moving bodies has four slopes in each row
    assert text.count('class="formula"') == 2 * rows + slopes + method


def test_the_linkage_settles_in_two_to_two_and_a_half_seconds(page: Page) -> None:
    for name in BODIES:
        settled, angle = page.table("Settling").values(name)
        assert 2.0 < settled < 2.5
    assert angle == pytest.approx(math.radians(270.017), abs=1e-4)  # gravity turns the spring
    times = [page.table("Settling").values(name)[0] for name in BODIES]
    results = page.table("Main results").rows
    (found,) = (row[2].value for row in results if row[1].text == "all angles settled at")
    assert found == max(times)


def test_the_study_has_the_residuals_of_the_classical_gains(page: Page) -> None:
    table = page.table("Stabilization")
    expected = {"α = 10, β = 200": (1.5e-3, 1333), "α = 1, β = 20": (8e-3, 234)}
    for gains, (residual, steps) in expected.items():
        _, _, found, _, count, _ = table.values(f"{gains}, RK45 rtol 0.001")
        assert found == pytest.approx(residual, rel=0.1)
        assert count == pytest.approx(steps, rel=0.05)
    assert table.values("α = β = 0, RK45 rtol 0.001")[2] > 1.0
    assert any("stability sets the step" in told for told in page.paragraphs)


def test_residual_and_energy_are_those_of_the_run(
    page: Page, reported: Callable[[str], Reported]
) -> None:
    solution = reported("four_bar").results["release"]
    residual = page.table("Accuracy").rows[0][1].value
    assert residual >= solution.drift.position.max()
    assert residual == pytest.approx(4.36e-7, rel=0.01)
    energy = page.table("Energy")
    assert energy.values("dissipated until the end") == [solution.energy.dissipated[-1]]
    (balance,) = energy.values("largest error of the balance, relative to the scale")
    assert balance < 1e-7


def test_the_figures_show_motion_reactions_residual_and_energy(page: Page) -> None:
    assert page.figures[:2] == [
        "The mechanism with its dimensions",
        "Initial configuration with the numbers of the bodies",
    ]
    for name in BODIES:
        assert any(told.endswith(f", {name}") for told in page.figures)
    for joint in "ABCD":
        assert any(told.startswith(f"Reactions of {joint} ") for told in page.figures)
    for told in ("Positions and angles", "Torque of spring", "Residuals of", "Energies"):
        assert any(figure.startswith(told) for figure in page.figures), told


def test_the_model_file_is_at_the_end(page: Page) -> None:
    text = (ROOT / "examples" / "four_bar.toml").read_text("utf-8")
    assert page.listing.strip() == text.strip()
