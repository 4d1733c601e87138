"""Eleven mechanisms drawn from nothing by mouse; `kempe run` runs the saved files without edits."""

import base64
from collections.abc import Iterator
from pathlib import Path

import kempe as kp
import numpy as np
import pytest
from studio.hands import Hands, Place, run
from studio.window import Studio

ROOT = Path(__file__).parents[2]


@pytest.fixture
def hands(one: Studio, request: pytest.FixtureRequest) -> Iterator[Hands]:
    """The hands of a person; their counts are those of docs/studio.md."""
    found = Hands(one)
    yield found
    task = request.node.name.removeprefix("test_").replace("_", " ")
    docs = (ROOT / "docs" / "studio.md").read_text(encoding="utf-8")
    assert f"| {task} | {found.counts()} |" in docs, found.counts()


def results(hands: Hands, folder: Path) -> kp.Solution:
    """What `kempe run` computes of the saved file."""
    (path,) = sorted(run(hands.saved(folder)).rglob("solution.npz"))
    return kp.load_solution(path)


def travel(found: kp.Solution, name: str) -> float:
    return float(np.ptp(found[name]))


def test_a_watt_six_bar_with_its_coupler_curve(hands: Hands, tmp_path: Path) -> None:
    hands.new()
    hands.use("ground", (-0.6, -0.2), (0.0, -0.2), (0.7, -0.2))
    hands.bars((-0.6, -0.2), (-0.6, -0.05), (-0.6, -0.05), (-0.05, 0.3))
    hands.plate((-0.05, 0.3), (0.0, -0.2), (0.2, 0.2))
    hands.bars((0.2, 0.2), (0.65, 0.3), (0.65, 0.3), (0.7, -0.2))
    hands.use("coordinate_driver", (-0.6, -0.125))
    hands.select((-0.35, 0.11))  # the coupler
    hands.press("#add-point")
    hands.read()
    found = results(hands, tmp_path)
    assert travel(found, "bar1.angle") == pytest.approx(2 * np.pi, rel=1e-6)
    name = list(hands.one.tree()["bodies"]["bar2"]["through"])[-1]
    assert travel(found, f"bar2.{name}.x") > 0.1
    assert hands.one.page.locator("#diagram").count() == 1


def test_a_slider_crank_with_gas_force_and_its_torque(hands: Hands, tmp_path: Path) -> None:
    hands.new()
    hands.use("ground", (-0.5, 0.0))
    hands.bars((-0.5, 0.0), (-0.35, 0.1), (-0.35, 0.1), (0.2, 0.0))
    hands.use("slider", (0.2, 0.0), (0.5, 0.0))
    hands.use("coordinate_driver", (-0.425, 0.05))
    hands.use("force", (0.2, 0.0))
    hands.fill("force", "-800*if(block1.vx < 0, 1, 0.1); 0")
    hands.read()
    hands.choose("Add plot", "driver1.effort")
    assert "driver1.effort" in hands.one.page.locator(".plot").last.inner_text()
    found = results(hands, tmp_path)
    assert travel(found, "block1.x") == pytest.approx(2 * np.hypot(0.15, 0.1), rel=0.05)
    # virtual power: the torque of the driver at the steepest place is about force times crank
    assert np.abs(found["driver1.effort"]).max() == pytest.approx(800 * 0.18, rel=0.2)


def test_a_quick_return(hands: Hands, tmp_path: Path) -> None:
    hands.new()
    hands.use("ground", (-0.1, 0.0), (-0.1, -0.5))
    hands.bars((-0.1, 0.0), (0.1, 0.0), (-0.1, -0.5), (0.22, 0.3))
    hands.use("pin_in_slot", (0.18, 0.2), (0.1, 0.0))
    hands.bars((0.22, 0.3), (0.6, 0.4))
    hands.use("slider", (0.6, 0.4), (0.9, 0.4))
    hands.use("coordinate_driver", (0.0, 0.0))
    hands.read()
    found = results(hands, tmp_path)
    v = found["block1.vx"]
    assert abs(v.min()) > 1.5 * v.max() or v.max() > 1.5 * abs(v.min())


def jansen() -> dict[str, Place]:
    """The pins of Jansen's leg in the example, in a drawing of 1.4 m."""
    start = kp.load(ROOT / "examples" / "jansen_leg.toml").start()
    model = start.compiled
    found: dict[str, Place] = {}
    for body in model.all_bodies.values():
        for point in body.points:
            at = start.body(body.name).at(body.points[point])
            found[f"{body.name}.{point}"] = (float(at.position[0]), float(at.position[1]))
    return found


def test_a_jansen_leg_with_the_path_of_its_foot(hands: Hands, tmp_path: Path) -> None:
    at = jansen()
    hands.new()
    hands.press("text=Snap")  # free places
    o, b, m = at["ground.O"], at["ground.B"], at["crank.M"]
    top, left, knee = at["shoulder.T"], at["shoulder.L"], at["thigh.K"]
    hands.use("ground", o, b)
    hands.bars(o, m, m, top)
    hands.plate(top, b, left)
    hands.bars(m, knee, knee, b)
    hands.plate(knee, at["foot.N"], at["foot.F"])
    hands.bars(left, at["foot.N"])
    hands.use("coordinate_driver", ((o[0] + m[0]) / 2, (o[1] + m[1]) / 2))
    hands.read()
    hands.press("#mode-edit")
    hands.press("text=Snap")
    found = results(hands, tmp_path)
    tip = list(hands.one.tree()["bodies"]["body2"]["through"])[-1]
    assert travel(found, f"body2.{tip}.x") > 0.4
    y = found[f"body2.{tip}.y"]
    assert np.mean(y < y.min() + 0.02) > 0.3


def test_a_cam_with_a_roller_from_a_motion_law(hands: Hands, tmp_path: Path) -> None:
    hands.new()
    hands.use("ground", (0.0, -0.2))
    # the cam: its curves are about the middle of the first two points, which is on the shaft
    hands.plate((-0.1, -0.2), (0.1, -0.2), (0.0, -0.2))
    hands.press("#add-curve")
    law = "0.2 + 0.08*(cycloidal(u/(120*deg)) - cycloidal((u - 180*deg)/(120*deg)))"
    hands.fill("curves", f'{{ rim = {{ polar = "{law}" }} }}')
    hands.key("Escape")
    hands.use("slider", (0.0, 0.2), (0.0, 0.4))
    hands.use("roller_on_curve", (0.0, 0.2), (0.05, -0.2))
    hands.fill("radius", "0.03")
    hands.use("coordinate_driver", (0.05, -0.2))
    hands.fill("speed1", "-10 rpm")  # the polar angle at the roller grows
    hands.read()
    found = results(hands, tmp_path)
    follower = next(name for name in hands.one.tree()["bodies"] if name.startswith("block"))
    assert travel(found, f"{follower}.y") == pytest.approx(0.08, rel=0.02)


def test_a_four_bar_with_a_spring_let_go(hands: Hands, tmp_path: Path) -> None:
    hands.new()
    hands.use("ground", (-0.4, -0.2), (0.2, -0.2))
    hands.bars((-0.4, -0.2), (-0.3, 0.1), (-0.3, 0.1), (0.3, 0.3), (0.3, 0.3), (0.2, -0.2))
    hands.use("spring_damper", (-0.4, -0.2), (0.3, 0.3))
    hands.press("#mode-live")
    hands.one.wait("kempe.state().then(({ t }) => t > 0.3)")
    hands.press("#mode-read")
    hands.one.wait("!document.querySelector('#run')?.disabled", 30.0)
    found = results(hands, tmp_path)
    assert found.t[-1] == pytest.approx(5.0)
    assert travel(found, "bar1.angle") > 0.01


def test_a_gripper_closes_on_a_disc(hands: Hands, tmp_path: Path) -> None:
    hands.new()
    hands.use("ground", (-0.3, -0.4), (0.3, -0.4), (0.0, 0.2))
    hands.bars((-0.3, -0.4), (-0.35, 0.2), (0.3, -0.4), (0.35, 0.2))
    hands.plate((0.0, 0.2), (0.0, 0.3))  # the disc
    hands.press("#add-curve")
    hands.fill("curves", "{ rim = { circle = [0, 0, 0.2] } }")
    hands.use("gear", (-0.33, -0.1), (0.33, -0.1))
    assert hands.one.quantity("bar1.angle") == pytest.approx(np.arctan2(0.6, -0.05))  # as drawn
    hands.use("contact", (-0.35, 0.2), (0.0, 0.25))
    hands.use("contact", (0.35, 0.2), (0.0, 0.25))
    hands.use("torque", (-0.33, -0.1))
    hands.fill("torque", "-20")
    hands.read()
    found = results(hands, tmp_path)
    assert found["contact1.force"].max() > 20.0
    assert travel(found, "bar1.angle") > 0.05


def test_a_planetary_gear(hands: Hands, tmp_path: Path) -> None:
    hands.new()
    hands.use("ground", (0.0, 0.0))
    hands.bars((0.0, 0.0), (0.0, 0.14))  # on the sun
    hands.bars((0.0, 0.0), (0.3, 0.0))  # the carrier
    hands.bars((0.3, 0.0), (0.3, 0.14))  # on the planet
    hands.use("gear", (0.0, 0.07), (0.3, 0.07))
    hands.fill("radii", "0.1; 0.2")
    hands.press(".left [data-type=gear]")
    hands.at((0.0, 0.07), (0.3, 0.07))
    hands.choose("i", "ground.A")  # the ground is the ring
    hands.one.page.get_by_label("internal", exact=True).check()
    hands.clicks += 1
    hands.fill("radii", "0.5; 0.2")
    hands.use("coordinate_driver", (0.0, 0.07))
    hands.read()
    found = results(hands, tmp_path)
    assert travel(found, "bar1.angle") / travel(found, "bar2.angle") == pytest.approx(1 + 0.5 / 0.1)


def test_a_scissor_lift(hands: Hands, tmp_path: Path) -> None:
    hands.new()
    hands.use("ground", (-0.4, -0.5))
    hands.bars((-0.4, -0.5), (0.4, -0.1), (0.4, -0.5), (-0.4, -0.1))
    hands.use("revolute", (0.0, -0.3), (0.0, -0.3))
    hands.use("slider", (0.4, -0.5), (0.7, -0.5))
    hands.bars((-0.4, -0.1), (0.7, -0.1))
    hands.use("slider", (0.4, -0.1), (0.6, -0.1))
    hands.use("cylinder", (-0.2, -0.6), (0.2, -0.2))
    hands.read("swings between its ends")
    found = results(hands, tmp_path)
    assert travel(found, "bar3.y") > 0.02
    assert travel(found, "bar3.angle") < 1e-6


def test_an_excavator_bucket_with_two_cylinders(hands: Hands, tmp_path: Path) -> None:
    hands.new()
    hands.use("ground", (-0.7, -0.3))
    hands.bars((-0.7, -0.3), (0.2, 0.3))
    hands.plate((0.2, 0.3), (0.4, 0.1), (0.2, -0.1), (0.1, 0.1))  # the bucket
    hands.use("cylinder", (-0.5, -0.5), (-0.4, -0.1))
    hands.use("cylinder", (-0.25, 0.0), (0.1, 0.1))
    hands.read("ends before it now")
    found = results(hands, tmp_path)
    assert travel(found, "bar1.angle") > 0.01
    assert np.ptp(found["body1.angle"] - found["bar1.angle"]) > 0.01


#: A picture of one pixel, which the page enlarges.
PHOTOGRAPH = base64.b64decode(
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNkYPj/HwADAgH/p2MDhAAAAABJRU5ErkJggg=="
)


def test_a_photograph_is_traced_over(hands: Hands, tmp_path: Path) -> None:
    hands.new()
    path = tmp_path / "photograph.png"
    path.write_bytes(PHOTOGRAPH)
    with hands.one.page.expect_file_chooser() as chooser:
        hands.press("#picture")
    chooser.value.set_files(path)
    hands.one.page.wait_for_timeout(300)
    hands.press("text=Scale by two points")
    hands.at((-0.4, 0.0), (0.4, 0.0))
    hands.fill("Their distance / m", "0.8")
    hands.use("ground", (-0.4, -0.2), (0.3, -0.2))
    hands.bars((-0.4, -0.2), (-0.3, 0.0), (-0.3, 0.0), (0.3, 0.3), (0.3, 0.3), (0.3, -0.2))
    hands.use("coordinate_driver", (-0.35, -0.1))
    hands.read()
    assert "photograph" not in hands.one.toml()
    found = results(hands, tmp_path)
    assert travel(found, "bar1.angle") == pytest.approx(2 * np.pi, rel=1e-6)
