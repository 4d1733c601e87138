"""Every refusal of ``kp.design`` is met, and says what it said when a person last read it."""

from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import kempe as kp
import numpy as np
import pytest
from cams.machines import oscillating, programme, translating
from design_problems.machines import four_bar
from kempe import design
from motions import results
from python.test_design_kinematics import TURN
from python.test_design_kinematics import four_bar as linkage
from python.test_kinematics import slider_crank, started
from refusals.told import check, statements

HERE = Path(__file__).parent


@cache
def moved(**options: Any) -> kp.Solution:
    """A slider-crank over a turn."""
    m = slider_crank()
    given = {"over": "motor", "range": TURN, "n": 9, **options}
    return kp.inverse_dynamics(m, started(m), **given)


@cache
def driven(value: str = "0.2 + sin(t)") -> kp.Solution:
    """A slider-crank whose crank moves by a law over time."""
    tree = slider_crank().tree()
    tree["drivers"]["motor"]["value"] = value
    m = kp.Model.from_tree(tree)
    return kp.inverse_dynamics(m, started(m), t_end=3.0, output_step=0.1)


def pendulum(analysis: Any = None) -> kp.Case:
    m = kp.Model("pendulum", gravity=(0, -9.81))
    m.ground.points(O=(0, 0))
    m.bar("arm", mass=1, length=1, ends=("O", "E"))
    m.revolute("O", "ground.O", "arm.O")
    return kp.Case(m, {"set": {"arm.angle": 0.3}}, [analysis or kp.Dynamics(t_end=0.1)])


@cache
def spun() -> kp.Solution:
    """A wheel with a force that measures no coordinate, and one with a spring on a slide."""
    m = kp.Model("wheel")
    m.ground.points(O=(0, 0))
    m.body("wheel", mass=1, inertia=2.0, points={"O": (0, 0), "P": (1, 0)})
    m.revolute("O", "ground.O", "wheel.O")
    m.force("push", "wheel.P", force=(1.0, 0.0))
    return kp.dynamics(m, kp.assemble(m), t_end=0.2)


@cache
def plate() -> kp.Solution:
    m = linkage()
    start = kp.assemble(m, guess={"coupler.angle": "50 deg", "rocker.angle": "-90 deg"})
    return kp.kinematics(m, start, over="crank.angle", range=TURN, n=9)


@cache
def slid() -> kp.Solution:
    """A block that a driver moves along a line."""
    m = kp.Model("block")
    m.ground.points(O=(0, 0))
    m.body("block", mass=1, inertia=1, points={"P": (0, 0)})
    m.translational("guide", "ground.O", "block.P")
    m.coordinate_driver("drive", "guide.displacement", value="t")
    return kp.inverse_dynamics(m, kp.assemble(m), t_end=1.0)


def fallen(t_end: float, **options: Any) -> kp.Solution:
    m = pendulum().model
    return kp.dynamics(m, kp.assemble(m), t_end=t_end, **options)


def file_of(text: str) -> Any:
    """Read a programme from a file with this text."""

    def call() -> object:
        Path("programme.csv").write_text(text, "utf-8")
        return design.read_programme("programme.csv")

    return call


def unbalanced() -> None:
    from dataclasses import replace

    case = design.load_cases(driven(), "rod", "A")[0]
    wrong = replace(case.loads[0], force=case.loads[0].force * 2)
    replace(case, loads=(wrong, *case.loads[1:]), t=0.25).to_csv("never.csv")


def law(**of: Any) -> list[Any]:
    return [("rise", "100 deg", 0.01, of), *programme(0.01)[1:]]


def cam(**more: Any) -> Any:
    return lambda: translating(**more)


def swung(**more: Any) -> Any:
    return lambda: oscillating(**more)


def balanced(**more: Any) -> Any:
    return lambda: design.balance(four_bar(1.0, 1.0, 1.0)[0], **more)


def train(*given: Any, **more: Any) -> Any:
    return lambda: design.gear_train(*given, **more)


MECHANISMS: dict[str, Callable[[], object]] = {
    "balance of": balanced(of="torques"),
    "balance on": balanced(on=["coupler"]),
    "balance radius": balanced(radius=0.0),
    "balance radius of one": balanced(radius={"crank": 0.1, "rocker": -0.1}),
    "balance a model": lambda: design.balance(four_bar(1.0, 1.0, 1.0)[0].model),  # type: ignore[arg-type]
    "balance without motion": lambda: design.balance(kp.Case(four_bar(1.0, 1.0, 1.0)[0].model)),
    "balance without drive": lambda: design.balance(pendulum(), of="torque"),
    "balance without pivots": lambda: design.balance(
        kp.Case(slid().model, None, [kp.InverseDynamics(t_end=1.0)])
    ),
    "balance a free motion": lambda: design.balance(pendulum()),
    "centre of one": lambda: design.instant_centre(moved(), "rod", "rod"),
    "centre at rest": lambda: design.instant_centre(driven("0.2 + 0*t"), "ground", "rod"),
    "path at rest": lambda: design.coupler_curve(moved(), "crank.O"),
    "path of a number": lambda: design.coupler_curve(moved(), 3),  # type: ignore[arg-type]
    "path of three": lambda: design.coupler_curve(moved(), ("rod", (0, 0), 1)),  # type: ignore[arg-type]
    "path of a body alone": lambda: design.coupler_curve(moved(), ("rod",)),  # type: ignore[arg-type]
    "path of a word": lambda: design.coupler_curve(moved(), ("rod", "A")),  # type: ignore[arg-type]
    "path of no point": lambda: design.coupler_curve(moved(), "rod.Q"),
    "path of no body": lambda: design.coupler_curve(moved(), "rod"),
    "duty of a push": lambda: design.duty(spun(), "push"),
    "duty of nothing": lambda: design.duty(spun(), "pull"),
    "duty of a state": lambda: design.duty(moved().initial, "motor"),  # type: ignore[arg-type]
    "duty without values between": lambda: design.duty(fallen(0.1, dense_output=False), "O"),
    "duty of one instant": lambda: design.duty(fallen(0.0), "O"),
    "flywheel of a slide": lambda: design.flywheel(slid(), "drive", fluctuation=0.02),
    "flywheel share": lambda: design.flywheel(moved(), "motor", fluctuation=1.0),
    "flywheel to and fro": lambda: design.flywheel(driven(), "motor", fluctuation=0.02),
    "flywheel without speed": lambda: design.flywheel(moved(), "motor", fluctuation=0.02),
    "flywheel speed": lambda: design.flywheel(moved(), "motor", fluctuation=0.02, speed=-1.0),
    "free body of a number": lambda: design.free_body(3, "rod"),  # type: ignore[arg-type]
    "free body of ground": lambda: design.free_body(moved(), "ground"),
    "load case out of balance": unbalanced,
    "load cases of ground": lambda: design.load_cases(moved(), "ground"),
    "load cases of another joint": lambda: design.load_cases(moved(), "rod", "O"),
    "pin load on another body": lambda: design.pin_load(moved(), "A", "piston"),
    "gear kind": train(2.0, "bevel"),
    "gear ratio": train(0.0),
    "gear ratio without bound": train(np.inf),
    "gear teeth": train(2.0, teeth=(2, 20)),
    "gear teeth in turn": train(2.0, teeth=(50, 20)),
    "gear teeth of three": train(2.0, teeth=(17, 20, 30)),
    "gear teeth of one number": train(2.0, teeth=17),
    "gear teeth in parts": train(2.0, teeth=(17.5, 20)),
    "gear compound": train(-2.0, "compound"),
    "gear planetary": train(1.0, "planetary"),
    "gear none": train(4.0, "planetary", teeth=(17, 18), planets=9),
    "gear planets": train(4.0, "planetary", planets=0),
    "polygon of a number": lambda: design.velocity_polygon(3),  # type: ignore[arg-type]
    "polygon of a state": lambda: design.velocity_polygon(moved().initial, 99.0),
    "shaking about a body": lambda: design.shaking(moved(), "crank.O"),
    "shaking about a number": lambda: design.shaking(moved(), 3),  # type: ignore[arg-type]
    "transmission at a slide": lambda: design.transmission_angle(moved(), "S"),
    "transmission lines": lambda: design.transmission_angle(moved(), "B", lines=3),  # type: ignore[arg-type]
    "transmission of another": lambda: design.transmission_angle(
        moved(), "B", lines={"crank": "crank.A"}
    ),
    "transmission without a line": lambda: design.transmission_angle(results("six_bar")[0], "C"),
    "transmission of a free end": lambda: design.transmission_angle(spun(), "O"),
    "ratio at rest": lambda: design.velocity_ratio(
        driven("0.2 + cycloidal(t)"), "piston.x", "crank.angle"
    ),
    "toggles at rest": lambda: design.toggles(moved(), "crank.O.x"),
}
CAMS: dict[str, Callable[[], object]] = {
    "closure": cam(closure="spring"),
    "direction": cam(direction="left"),
    "follower": cam(follower="rollers"),
    "face": cam(face=0.01),
    "base": cam(base_radius=0.0),
    "roller": cam(roller_radius=0.0),
    "roller of a knife": cam(follower="knife", roller_radius=0.01),
    "groove of a knife": cam(follower="knife", closure="groove"),
    "offset of an arm": swung(offset=0.01),
    "arm alone": cam(arm=0.05),
    "pivot alone": cam(pivot=(0.05, 0.0)),
    "arm": swung(arm=-0.07),
    "pivot": swung(pivot=(1.0, 2.0, 3.0)),
    "pivot of one": swung(pivot=(1.0,)),
    "spring of three": cam(spring=(1.0, 2.0, 3.0)),
    "pivot at the shaft": swung(pivot=(0.0, 0.0)),
    "speed": cam(speed=-1.0),
    "mass": cam(mass=-1.0),
    "spring": cam(spring=5.0),
    "spring that pulls": cam(spring=(-5.0, 0.0)),
    "offset": cam(offset=0.05),
    "base of a flat face": swung(follower="flat", base_radius=0.08),
    "reach of an arm": swung(arm=0.01),
    "beyond the line": swung(follower="flat", base_radius=0.069),
    "as fast as the cam": lambda: design.cam(
        "flat",
        [("rise", "30 deg", "40 deg", "cycloidal"), ("return", "330 deg", "cycloidal")],
        base_radius=0.03, arm=0.2, pivot=(-0.2, 0.0),
    ).undercut,
    "programme": cam(programme="rise"),
    "no segment": cam(programme=[]),
    "no rise": cam(programme=[("dwell", "360 deg")]),
    "segment": cam(programme=[("climb", 1.0, 0.01, "cycloidal")]),
    "parts": cam(programme=[("rise", 1.0, "cycloidal")]),
    "angle": cam(programme=[("rise", -1.0, 0.01, "cycloidal")]),
    "lift": cam(programme=[("rise", 1.0, -0.01, "cycloidal")]),
    "return from nothing": cam(programme=[("return", 1.0, "cycloidal")]),
    "law": cam(programme=[("rise", 1.0, 0.01, "sine")]),
    "law of a number": cam(programme=[("rise", 1.0, 0.01, 3)]),
    "key of a polynomial": cam(programme=law(type="polynomial", points=[])),
    "key of a spline": cam(programme=law(type="spline", begin=[])),
    "end": cam(programme=law(type="polynomial", end=3)),
    "end of an arm": lambda: design.cam(
        "flat", [("rise", 1.0, 0.1, {"type": "polynomial", "end": "a"})],
        base_radius=0.03, arm=0.2, pivot=(0.2, 0.0),
    ),
    "five derivatives": cam(programme=law(type="polynomial", start=[0] * 5)),
    "point": cam(programme=law(type="spline", points=[(0.5, 0.002), 3])),
    "point of three": cam(programme=law(type="spline", points=[(0.5, 0.002, 1.0)])),
    "points in turn": cam(programme=law(type="spline", points=[(0.5, 0.002), (0.5, 0.003)])),
    "start of a spline": cam(programme=law(type="spline", start=[0])),
    "end of a spline": cam(programme=law(type="spline", end=[0, 0, 0])),
    "less than a turn": cam(programme=programme(0.01)[:-1]),
    "more than a turn": cam(programme=[*programme(0.01), ("dwell", "40 deg")]),
    "above its start": cam(programme=[("rise", "360 deg", 0.01, "cycloidal")]),
    "below its start": cam(
        programme=[("rise", "180 deg", 0.01, "poly345"), ("return", "180 deg", 0.02, "poly345")]
    ),
    "jump of the speed": cam(programme=programme(0.01, "linear")),
    "undercut": lambda: translating(base_radius=0.003, roller_radius=0.02).case,
    "no base": lambda: oscillating().least_base_radius("1 deg"),
    "outer": lambda: translating().outer,
    "conjugate": lambda: translating().conjugate,
    "contact": lambda: translating().contact,
    "unit of a drawing": lambda: translating().write_dxf("never.dxf", unit="mile"),
    "step": lambda: translating().write_csv("never.csv", step="7 deg"),
    "cutter": lambda: translating().cutter_path(-0.01),
    "cutter in a groove": lambda: translating(closure="groove").cutter_path(0.009),
    "cutter in a hollow": lambda: translating(
        programme=programme(0.02), base_radius=0.02
    ).cutter_path(1.0),
}  # fmt: skip


FILES = {
    "column": file_of("segment, angle [deg]\nrise, 100\n"),
    "cell": file_of("segment, angle, lift, law\ndwell, 1\nrise, , 0.01, cycloidal\n"),
}


def test_every_refusal_says_what_is_wrong_and_what_to_do(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    cams = {f"cam: {name}": call for name, call in (CAMS | FILES).items()}
    check(HERE / "design.txt", MECHANISMS | cams, statements("design"))
    assert list(tmp_path.iterdir()) == [tmp_path / "programme.csv"]
