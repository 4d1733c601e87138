"""What MJCF or kempe cannot describe is named with its line, and nothing is lost in silence."""

from __future__ import annotations

import time
from pathlib import Path

import kempe as kp
import numpy as np
import pytest
from command_line import kempe
from kempe.mjcf.attributes import Names
from sizes import count

HEAD = '<mujoco>\n<option gravity="0 0 -9.81"/>\n<worldbody>\n<body name="rod" pos="0 0 1">\n'
MASS = '<inertial pos="0.5 0 0" mass="1" diaginertia="0.1 0.1 0.1"/>\n'
PIN = '<joint name="pin" axis="0 -1 0"/>\n'
SPRING = '<joint name="pin" axis="0 -1 0" stiffness="1" springref="20"/>\n'
PIN_SPRING_SITES = '<site name="a" pos="1 0 0"/><site name="b"/>\n'
OUT_OF_PLANE = '<site name="a" pos="1 0 0"/><site name="b" pos="0 1 0"/>\n'
CORD = '<tendon><spatial stiffness="1"><site site="a"/><site site="b"/></spatial></tendon>\n'
TAIL = "</body>\n</worldbody>\n{after}</mujoco>\n"


def text(body: str = "", joint: str = PIN, mass: str = MASS, after: str = "") -> str:
    return HEAD + mass + joint + body + TAIL.format(after=after)


def test_the_plain_file_is_a_pendulum(tmp_path: Path) -> None:
    (tmp_path / "a.xml").write_text(text())
    case = kp.load(tmp_path / "a.xml")
    assert case.unread == ()
    start = case.start()
    # a rigid body of 1 kg with its centre at 0.5 m: J alpha = - m g s
    assert start["rod.alpha"] == pytest.approx(-9.81 * 0.5 / (0.1 + 0.25), rel=1e-12)


@pytest.mark.parametrize(
    ("content", "line", "message"),
    [
        (text(joint='<joint type="ball"/>\n'), 6, "joints of type ball move in space"),
        (text(joint="<freejoint/>\n"), 6, "a free joint moves in space"),
        (text(joint=PIN + '<joint name="up" axis="1 0 0"/>\n'), 7, "not normal to the plane"),
        (text(joint=PIN + '<joint type="slide" axis="0 1 0"/>\n'), 7, "not in the plane"),
        (text(joint='<joint axis="1 1 0"/>\n'), 6, "not an axis of the world frame"),
        (text(joint=PIN.replace("/>", ' range="-1 1"/>')), 6, "range is not supported"),
        (text(joint=PIN.replace("/>", ' armature="0.1"/>')), 6, "armature is not supported"),
        (text(joint=PIN.replace("/>", ' damping="x"/>')), 6, "damping='x' is not 1 numbers"),
        (text(mass=""), 4, "it has no inertial"),
        (text(body="<flexcomp/>\n"), 7, "flexcomp: this element is not supported"),
        (text(after="<deformable/>\n"), 9, "this section is not supported"),
        (text(after='<equality><joint joint1="pin"/></equality>\n'), 9, "joint: this equation"),
        (text(after='<equality><connect body1="no"/></equality>\n'), 9, "body1 and body2"),
        (text(after='<tendon><fixed><joint joint="no"/></fixed></tendon>\n'), 9, "no joint"),
        (text(after='<tendon><spatial><site site="a"/></spatial></tendon>\n'), 9, "two sites"),
        (
            text(PIN_SPRING_SITES, joint=SPRING, after=CORD),
            10,
            "relaxed at springref",
        ),
        (text(OUT_OF_PLANE, after=CORD), 10, "not in one plane"),
        (text(joint='<joint name="pin" axis="0 0 0"/>\n'), 6, "axis is zero"),
        (text(joint='<joint name="pin" axis="0 -1 0" class="no"/>\n'), 6, "no default class"),
        (text(after='<compiler eulerseq="abc"/>\n'), 9, "not three of the axes"),
        (text(after='<keyframe><key qvel="1 2"/></keyframe>\n'), 9, "qvel does not have"),
        (text(after='<keyframe><key ctrl="1"/></keyframe>\n'), 9, "ctrl does not have"),
        (text(mass=MASS + MASS), 6, "another inertial"),
        (text(body='<body name="rod" quat="0 0 0 0">' + MASS + "</body>\n"), 7, "quat is zero"),
        (text(body='<body name="rod">' + MASS + "</body>\n"), 7, "another one has this name"),
        (text(after='<actuator><muscle joint="pin"/></actuator>\n'), 9, "muscle"),
        (text(after='<actuator><motor joint="no"/></actuator>\n'), 9, "motor"),
        (text(after='<keyframe><key qpos="1"/></keyframe>\n'), 9, "qpos is not supported"),
        (text(after='<option wind="1 0 0"/>\n'), 9, "wind is not supported"),
    ],
)
def test_what_is_not_read_is_named_with_its_line(
    tmp_path: Path, content: str, line: int, message: str
) -> None:
    path = tmp_path / "a.xml"
    path.write_text(content)
    with pytest.raises(kp.FileError) as raised:
        kp.load(path)
    named = [(problem.line, problem.message) for problem in raised.value.problems]
    assert any(at == line and message in what for at, what in named), named
    assert kp.load(path, partial=True).unread  # the remedy of the message


def test_geoms_that_may_touch_are_named(tmp_path: Path) -> None:
    geom = '<geom type="sphere" size="0.1"/>\n'
    ground = text(body=geom).replace("<worldbody>\n", f"<worldbody>\n{geom}")
    (tmp_path / "a.xml").write_text(ground)
    with pytest.raises(kp.FileError, match="line 4: geom: geoms of several bodies may touch"):
        kp.load(tmp_path / "a.xml")
    off = '<option gravity="0 0 -9.81"><flag contact="disable"/></option>'
    (tmp_path / "a.xml").write_text(ground.replace('<option gravity="0 0 -9.81"/>', off))
    assert all("shapes" in what for what in kp.load(tmp_path / "a.xml").unread)


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ('<!DOCTYPE a [<!ENTITY b "c">]>\n<mujoco>&b;</mujoco>', "line 1: document types"),
        ("<mujoco>\n<a>\n</mujoco>", "line 3: mismatched tag"),
        ("<mujoco>" + "<body>" * 300 + "</body>" * 300 + "</mujoco>", "more than 200 levels"),
        ("<robot/>", "the first element must be mujoco"),
        ("", "line 1: no element found"),
    ],
)
def test_hostile_and_broken_texts_are_errors(tmp_path: Path, content: str, message: str) -> None:
    (tmp_path / "a.xml").write_text(content)
    with pytest.raises(kp.FileError, match=message):
        kp.load(tmp_path / "a.xml", form="mjcf")


def test_mutated_files_end_in_a_case_or_an_error(tmp_path: Path) -> None:
    random = np.random.default_rng(7)
    kp.write_mjcf(kp.load("examples/four_bar.toml").start(), tmp_path / "whole.xml")
    whole = (tmp_path / "whole.xml").read_text()
    for _ in range(count(150, 10_000)):
        k, n = int(random.integers(len(whole))), int(random.integers(1, 12))
        piece = "".join(random.choice(list(' "<>/=-09eE.abz'), int(random.integers(0, 4))))
        (tmp_path / "a.xml").write_text(whole[:k] + piece + whole[k + n :])
        try:
            kp.load(tmp_path / "a.xml", partial=True)
        except kp.KempeError as error:
            assert not isinstance(error, kp.InternalError)


def test_what_mjcf_cannot_describe_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "a.xml"

    def refused(case: kp.Case, message: str) -> None:
        with pytest.raises(kp.ModelError, match=message):
            kp.write_mjcf(case.start(), path)
        assert not path.exists()

    refused(kp.load("examples/motor_press.toml"), "mesh: joints of type gear")
    refused(kp.load("examples/quick_return.toml"), "cannot be written as MJCF")
    m = kp.Model("pin")
    m.ground.points(A=(0, 0))
    m.bar("rod", mass=1, length=1, ends=("A", "B"))
    m.clearance("A", "ground.A", "rod.A", radius=0.01, clearance=1e-4, restitution=0.5)
    refused(kp.Case(m, {"set": {"rod.x": 0.5, "rod.y": 0}}), "A: clearance cannot be written")
    for law in ("k*t", "3*rod.omega"):
        m = kp.Model("rod", parameters={"k": 3})
        m.ground.points(A=(0, 0))
        m.bar("rod", mass=1, length=1, ends=("A", "B"))
        m.revolute("A", "ground.A", "rod.A")
        m.torque("turn", "rod", torque=law)
        refused(kp.Case(m, {"set": {"rod.angle": 0}}), "turn.torque = .* is not constant")
    with pytest.raises(kp.ModelError, match="timestep"):
        kp.write_mjcf(kp.load("examples/pendulum.toml").start(), path, timestep=0)


def test_the_command_line_converts_both_ways(tmp_path: Path) -> None:
    done = kempe("convert", "examples/four_bar.toml", str(tmp_path / "a.xml"))
    assert done.returncode == 0, done.stderr
    done = kempe("convert", str(tmp_path / "a.xml"), str(tmp_path / "b.toml"))
    assert done.returncode == 0, done.stderr
    bodies = kp.load(tmp_path / "b.toml").model.tree()["bodies"]
    assert set(bodies) == {"ground", "crank", "coupler", "rocker"}


def test_defaults_in_two_sections_add_up_and_controls_keep_their_range(tmp_path: Path) -> None:
    after = (
        '<default><joint stiffness="3"/></default><default><joint damping="2"/></default>'
        '<actuator><motor joint="pin" ctrlrange="-1 1"/></actuator>'
        '<keyframe><key qvel="0.5" ctrl="7"/></keyframe>\n'
    )
    (tmp_path / "a.xml").write_text(text(after=after))
    case = kp.load(tmp_path / "a.xml")
    start = case.start()
    moment = -9.81 * 0.5 - 2 * 0.5 + 1
    assert start["rod.alpha"] == pytest.approx(moment / (0.1 + 0.25), rel=1e-12)
    assert start["rod.omega"] == 0.5


def test_many_points_of_a_body_are_read_quickly(tmp_path: Path) -> None:
    sites = "".join(f'<site pos="{k} 0 0"/>\n' for k in range(10_000))
    (tmp_path / "a.xml").write_text(text(sites))
    began = time.perf_counter()
    points = kp.load(tmp_path / "a.xml").model.tree()["bodies"]["rod"]["points"]
    assert time.perf_counter() - began < 5
    assert len(points) == 10_000 + 1  # and that of the pin


def test_many_equal_names_are_told_apart_quickly() -> None:
    names, began = Names(), time.perf_counter()
    found = [names.new("a") for _ in range(30_000)]
    assert time.perf_counter() - began < 2
    assert len(set(found)) == 30_000 and found[:3] == ["a", "a_2", "a_3"]
    assert [names.new(name) for name in ("a_3", "a_3")] == ["a_3_2", "a_3_3"]
