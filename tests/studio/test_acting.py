"""Arrows of forces on one body: springs, actuators, loads and reactions, against Python."""

import re
from pathlib import Path

import kempe as kp
import numpy as np
import pytest
from studio.test_arrows import drawing, show
from studio.test_modes import CRANK_ROCKER
from studio.window import Studio

CASE = (
    CRANK_ROCKER
    + """
[forces]
spring = { type = "spring_damper", i = "crank.B", j = "rocker.C", stiffness = 20, free_length = 1 }
push = { type = "force", j = "coupler.C", force = [5, -8] }
cylinder = { type = "actuator", i = "ground.D", j = "coupler.B", force = 12 }

[analyses.fall]
type = "dynamics"
t_end = 0.5
output_step = 0.1
"""
)
T = 0.3
#: Elements, and their ends on the bodies i and j.
JOINTS = {
    "A": ("ground.A", "crank.A"),
    "B": ("crank.B", "coupler.B"),
    "C": ("coupler.C", "rocker.C"),
    "D": ("ground.D", "rocker.D"),
}
FORCES = {
    "spring": ("crank.B", "rocker.C"),
    "push": (None, "coupler.C"),
    "cylinder": ("ground.D", "coupler.B"),
}
KINDS = {"Reactions": ("--reactions", JOINTS), "Forces": ("--force", FORCES)}
TEXT = re.compile(r'fill="(#\w+)"[^>]*>([\d.]+ k?N on [^<]*)</text>')
STROKE = re.compile(
    r'<path d="M(\S+) (\S+)L(\S+) (\S+)" fill="none" stroke="(#\w+)" stroke-width="2.4"'
)


def colour(one: Studio, name: str) -> str:
    style = "name => getComputedStyle(document.documentElement).getPropertyValue(name).trim()"
    return str(one.call(style, name))


def acting(solution: kp.Solution, k: int, kind: str, body: str) -> list[tuple[str, np.ndarray]]:
    """The point and the force of each element on a body, or on body j for all bodies."""
    found = []
    for element, (i, j) in KINDS[kind][1].items():
        force = np.array([solution[f"{element}.fx"][k], solution[f"{element}.fy"][k]])
        for point, sign in ((i, -1), (j, 1)):
            if point and (point.split(".")[0] == body if body else point == j):
                found.append((point, sign * force))
    return found


def place(solution: kp.Solution, k: int, point: str) -> tuple[float, float]:
    fixed = {"ground.A": (0.0, 0.0), "ground.D": (4.0, 0.0)}
    return fixed.get(point) or (float(solution[f"{point}.x"][k]), float(solution[f"{point}.y"][k]))


def drawn(one: Studio, tmp_path: Path, kind: str, count: int) -> tuple[list[str], np.ndarray]:
    """The texts of the arrows of a kind, and of each arrow its beginning and its direction, px."""
    of_kind = colour(one, KINDS[kind][0])
    for _ in range(50):
        picture = drawing(one, tmp_path)
        texts = [text for own, text in TEXT.findall(picture) if own == of_kind]
        if len(texts) == count:
            break
        one.page.wait_for_timeout(100)
    lines = [line[:4] for line in STROKE.findall(picture) if line[4] == of_kind]
    ends = np.array(lines, dtype=float).reshape(-1, 4)
    return texts, np.hstack([ends[:, :2], ends[:, 2:] - ends[:, :2]])


@pytest.mark.parametrize("kind", ["Forces", "Reactions"])
@pytest.mark.parametrize("body", ["", "ground", "crank", "coupler", "rocker"])
def test_the_arrows_of_a_body_are_the_forces_on_it(
    one: Studio, tmp_path: Path, body: str, kind: str
) -> None:
    assert one.load(CASE)["problems"] == []
    one.mode("read")
    for other in KINDS:
        one.page.get_by_label(other, exact=True).set_checked(other == kind)
    show(one, T)
    one.page.locator("#on-body").select_option(body)
    path = tmp_path / "case.toml"
    path.write_text(CASE, encoding="utf-8")
    solution = kp.load(path).run()["fall"]
    k = int(np.abs(solution.t - T).argmin())
    expected = acting(solution, k, kind, body)
    texts, arrows = drawn(one, tmp_path, kind, len(expected))
    sizes = [f"{np.hypot(*force):#.3g} N on {point.split('.')[0]}" for point, force in expected]
    assert sorted(texts) == sorted(sizes)
    box = one.page.locator("#sheet").bounding_box()
    assert box
    for point, force in expected:
        x, y = one.screen(*place(solution, k, point))
        begin = np.array([x - box["x"], y - box["y"]])
        heading = np.array([force[0], -force[1]]) / np.hypot(*force)
        near = arrows[np.hypot(*(arrows[:, :2] - begin).T) < 1]
        assert any(
            line[2:] / np.hypot(*line[2:]) == pytest.approx(heading, abs=0.01) for line in near
        ), (point, force, near)


def test_the_points_of_one_body_have_the_velocities(one: Studio, tmp_path: Path) -> None:
    """crank.B and coupler.B are pinned together: each body has its own arrow there."""
    one.load(CASE)
    one.mode("read")
    for kind in KINDS:
        one.page.get_by_label(kind, exact=True).uncheck()
    show(one, T, "Velocities")
    found = {}
    for body in ("crank", "coupler", "rocker"):
        one.page.locator("#on-body").select_option(body)
        for _ in range(50):
            names = set(re.findall(r">[\d.]+ m?m/s ([\w.]+)</text>", drawing(one, tmp_path)))
            if names and all(name.startswith(body) for name in names):
                break
            one.page.wait_for_timeout(100)
        found[body] = names
    one.page.locator("#on-body").select_option("")
    assert found == {
        "crank": {"crank.B"},
        "coupler": {"coupler.B", "coupler.C"},
        "rocker": {"rocker.C"},
    }


#: A cam with a roller, and a spring-loaded point that a contact presses on the same cam.
CAM = """kempe = 1
gravity = [0, -9.81]
[bodies.ground]
points = { O = [0, 0], U = [0, 0.5], L = [0.5, 0] }
[bodies.cam]
mass = 2
inertia = 0.05
points = { O = [0, 0] }
curves = { rim = { polar = "0.2 + 0.05*cos(2*u)" } }
[bodies.rod]
mass = 1
inertia = 0.01
points = { P = [0, 0], T = [0, 0.2] }
[bodies.bar]
mass = 1
inertia = 0.01
points = { Q = [0, 0], E = [0.2, 0] }
[joints]
pivot = { type = "revolute", i = "ground.O", j = "cam.O" }
up = { type = "translational", i = "ground.U", j = "rod.T", axes = ["90 deg", "90 deg"] }
aside = { type = "translational", i = "ground.L", j = "bar.E" }
roller = { type = "roller_on_curve", i = "rod.P", curve = "cam.rim", radius = 0.03 }
[drivers.motor]
type = "coordinate_driver"
coordinate = "cam.angle"
value = "0.4 + 3*t"
[forces]
press = { type = "force", j = "bar.Q", force = [-40, 0] }
touch = { type = "contact", i = "bar.Q", curve = "cam.rim", stiffness = 1e4, exponent = 1 }
[start]
guess = { "rod.y" = 0.2, "bar.x" = 0.24 }
[analyses.fall]
type = "dynamics"
t_end = 0.5
output_step = 0.1
"""
CAM_KINDS = {
    "Reactions": {
        "pivot": ("ground.O", "cam.O"),
        "up": ("ground.U", "rod.T"),
        "aside": ("ground.L", "bar.E"),
        "roller": ("rod", "cam"),
    },
    "Forces": {"press": (None, "bar.Q"), "touch": ("bar", "cam")},
}


@pytest.mark.parametrize("body", ["", "cam", "rod", "bar"])
@pytest.mark.parametrize("kind", ["Reactions", "Forces"])
def test_forces_on_curves_act_on_both_bodies(
    one: Studio, tmp_path: Path, kind: str, body: str
) -> None:
    """The force of a roller or a contact is drawn where it touches, with the sign for the body."""
    assert one.load(CAM)["problems"] == []
    one.mode("read")
    for other in KINDS:
        one.page.get_by_label(other, exact=True).set_checked(other == kind)
    show(one, T)
    one.page.locator("#on-body").select_option(body)
    path = tmp_path / "case.toml"
    path.write_text(CAM, encoding="utf-8")
    solution = kp.load(path).run()["fall"]
    k = int(np.abs(solution.t - T).argmin())
    expected = {}
    for element, (i, j) in CAM_KINDS[kind].items():
        force = np.array([solution[f"{element}.fx"][k], solution[f"{element}.fy"][k]])
        for on, sign in ((i, -1), (j, 1)):
            owner = (on or "").split(".")[0]
            if owner and (owner == body if body else sign == 1):
                expected[f"{np.hypot(*force):#.3g} N on {owner}"] = sign * force
    texts, arrows = drawn(one, tmp_path, kind, len(expected))
    assert sorted(texts) == sorted(expected)
    headings = {tuple(np.round(line[2:] / np.hypot(*line[2:]), 2)) for line in arrows}
    found = {
        tuple(np.round(np.array([x, -y]) / np.hypot(x, y), 2) + 0.0) for x, y in expected.values()
    }
    assert all(min(np.hypot(*np.subtract(one_, own)) for own in headings) < 0.02 for one_ in found)
    if kind == "Forces" and body != "rod":  # both forces on the bar act at its point Q
        x, y = one.screen(*(float(solution[f"bar.Q.{axis}"][k]) for axis in "xy"))
        box = one.page.locator("#sheet").bounding_box()
        assert box
        begins = np.abs(arrows[:, :2] - [x - box["x"], y - box["y"]]).max(axis=1) < 1
        assert begins.sum() == len(expected)
    one.page.get_by_label(kind, exact=True).uncheck()
    one.page.locator("#on-body").select_option("")
