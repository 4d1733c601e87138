"""Models of MuJoCo: written, simulated by MuJoCo, and read again."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import kempe as kp
import mujoco
import numpy as np
import pytest

PRECISE = kp.DOP853(rtol=1e-10)


def rig(size: float = 1.0) -> kp.Case:
    """A slide on a slope, a pendulum on it, a free plate, springs and torques; all in motion."""
    m = kp.Model("rig", gravity=(0.3 * size, -9.81 * size), parameters={"k": 40, "c": 1.5})
    m.ground.points(O=(0, 0), S=(0.2 * size, 0.9 * size))
    inertia = size**2
    points = {"P": (0.1 * size, 0.02 * size)}
    m.body("cart", mass=2, inertia=0.3 * inertia, center=(0.05 * size, 0), points=points)
    m.bar("rod", mass=0.7, length=0.8 * size, ends=("A", "B"))
    m.bar("tip", mass=0.4, length=0.5 * size, ends=("A", "B"))
    m.body("plate", mass=1, inertia=0.2 * inertia, points={"Q": (0.1 * size, 0)})
    m.translational("slope", "cart.P", "ground.O", axes=("10 deg", "30 deg"))
    m.revolute("pin", "rod.A", "cart.P")
    m.revolute("elbow", "rod.B", "tip.A")
    m.spring_damper("cord", "ground.S", "rod.B", stiffness="k", damping="c", free_length=0.3 * size)
    m.torsion_spring(
        "twist", "cart", "tip", stiffness=5 * inertia, damping=0.2 * inertia, free_angle=0.4
    )
    m.torque("drive", "tip", torque=1.3 * inertia)
    m.spring_damper("tie", "plate.Q", "tip.B", stiffness=30, preload=2 * size)
    m.torque("spin", "plate", i="rod", torque=0.2 * inertia)
    start = {"slope.displacement": 0.1 * size, "rod.angle": -1.0, "tip.angle": 0.3}
    start |= {"slope.rate": 0.2 * size, "rod.omega": 1.0, "tip.omega": -2.0}
    start |= {"plate.x": 0.7 * size, "plate.y": 0.1 * size, "plate.angle": 0.5}
    start |= {"plate.vx": 0.1 * size, "plate.vy": 0.3 * size, "plate.omega": 0.7}
    return kp.Case(m, {"set": start})


def case(name: str) -> kp.Case:
    return rig() if name == "rig" else kp.load(f"examples/{name}.toml")


def simulated(path: Path, t_end: float) -> tuple[Any, Any]:
    model = mujoco.MjModel.from_xml_path(str(path))
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, 0)
    for _ in range(round(t_end / model.opt.timestep)):
        mujoco.mj_step(model, data)
    mujoco.mj_forward(model, data)
    return model, data


@pytest.mark.parametrize("name", ["four_bar", "slider_crank", "double_pendulum", "rig"])
def test_mujoco_moves_as_kempe_within_its_gap(tmp_path: Path, name: str) -> None:
    own, t_end = case(name), 0.3
    start = own.start()
    end = kp.dynamics(own.model, start, t_end=t_end, method=PRECISE).final
    size = max(abs(start[f"{body}.{x}"]) for body in start.compiled.bodies for x in "xy")
    errors = []
    for timestep in (1e-3, 2.5e-4):
        kp.write_mjcf(start, tmp_path / "out.xml", timestep=timestep)
        _, data = simulated(tmp_path / "out.xml", t_end)
        found = np.array([data.body(body).xpos for body in end.compiled.bodies])
        wanted = [[end[f"{body}.x"], 0, end[f"{body}.y"]] for body in end.compiled.bodies]
        errors.append(abs(found - wanted).max() / size)
    assert errors[0] < 1e-5
    assert errors[1] < errors[0] / 3 + 1e-9


@pytest.mark.parametrize(
    ("name", "size"),
    [("four_bar", 1), ("slider_crank", 1), ("double_pendulum", 1)]
    + [("rig", size) for size in (1e-3, 1e-2, 1, 1e2, 1e3)],
)
def test_kempe_reads_its_own_models(tmp_path: Path, name: str, size: float) -> None:
    own = rig(size) if name == "rig" else case(name)
    start = own.start()
    kp.write_mjcf(start, tmp_path / "out.xml")
    read = kp.load(tmp_path / "out.xml")
    assert read.unread == ()
    again = read.start()
    ends = [
        kp.dynamics(c.model, s, t_end=0.3, method=PRECISE).final
        for c, s in ((own, start), (read, again))
    ]
    for one, other in ((start, again), ends):
        for body in start.compiled.bodies:
            for quantity, scale in (("x", size), ("y", size), ("vx", size), ("vy", size)):
                name = f"{body}.{quantity}"
                assert other[name] == pytest.approx(one[name], rel=1e-7, abs=1e-7 * scale)
            assert other[f"{body}.omega"] == pytest.approx(one[f"{body}.omega"], abs=1e-6)
    # zero joint angles are the start
    assert all(again[f"{body}.angle"] == 0 for body in again.compiled.bodies)


FILE = """\
<mujoco model="arm">
  <compiler angle="degree" eulerseq="xyz"/>
  <option gravity="0 0 -9.81" timestep="0.0005" integrator="RK4"/>
  <default>
    <joint damping="0.02"/>
    <default class="loose"><joint damping="0"/></default>
  </default>
  <worldbody>
    <body name="base" pos="0.1 0.2 0.3" euler="{euler}">
      <body name="cart">
        <inertial pos="0 0 0" mass="1.5" diaginertia="0.1 0.2 0.3"/>
        <joint name="rail" type="slide" axis="1 0 0" stiffness="20" springref="0.1"/>
        <joint name="tilt" type="hinge" axis="0 -1 0" pos="0 0 0.05" class="loose"/>
        <body name="rod" pos="0.2 0 0.1" euler="0 20 0">
          <inertial pos="0.1 0 0" mass="0.5" fullinertia="0.02 0.03 0.02 0 0.001 0"/>
          <joint name="pin" axis="0 1 0" stiffness="0.4" springref="30"/>
          <site name="end" pos="0.3 0 0"/>
        </body>
      </body>
    </body>
  </worldbody>
  <tendon>
    <spatial name="cord" stiffness="15" damping="0.3" springlength="0.5">
      <site site="end"/><site site="hook"/>
    </spatial>
    <fixed name="both"><joint joint="tilt" coef="2"/><joint joint="pin" coef="-1"/></fixed>
  </tendon>
  <actuator>
    <position name="hold" joint="tilt" kp="3" kv="0.1"/>
    <motor name="push" joint="pin" gear="0.7"/>
    <velocity name="slow" tendon="both" kv="0.2"/>
  </actuator>
  <keyframe><key name="start" qvel="0.3 -0.5 1" ctrl="0.2 0.3 0.1"/></keyframe>
</mujoco>
""".replace("<worldbody>", '<worldbody>\n    <site name="hook" pos="{hook}"/>')


@pytest.mark.parametrize(
    ("euler", "hook", "turned"),
    [
        ("0 0 0", "0.4 0.2 0.9", ("x", "z")),
        ("0 0 90", "0.1 0.5 0.9", ("y", "z")),
        ("0 50 0", "0.4 0.2 0.9", ("x", "z")),
    ],
)
def test_a_file_of_other_hands_moves_as_in_mujoco(
    tmp_path: Path, euler: str, hook: str, turned: tuple[str, str]
) -> None:
    path = tmp_path / "arm.xml"
    path.write_text(FILE.format(euler=euler, hook=hook))
    read = kp.load(path)
    end = kp.dynamics(read.model, read.start(), t_end=0.5, method=PRECISE).final
    _, data = simulated(path, 0.5)
    for body in ("cart", "rod"):
        place = dict(zip("xyz", data.body(body).xpos, strict=True))
        assert end[f"{body}.x"] == pytest.approx(place[turned[0]], abs=2e-7)
        assert end[f"{body}.y"] == pytest.approx(place[turned[1]], abs=2e-7)
    sites = dict(zip("xyz", data.site("end").xpos, strict=True))
    assert end["rod.end.x"] == pytest.approx(sites[turned[0]], abs=2e-7)
