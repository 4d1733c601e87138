"""The ends of a scene: where forces of elements act, with what sign, and with which remark."""

import kempe as kp
import numpy as np
import pytest
from draw.forces import on_body, place_of
from draw.mechanisms import four_bar, sprung
from house.places import ROOT

#: Mechanisms with springs, drivers, loads, contacts, curves and stops.
EXAMPLES = (
    "balanced_lamp",
    "crane_trolley",
    "engine",
    "jumping_follower",
    "motor_press",
    "pantograph",
    "planetary_gear",
    "slamming_door",
    "squeezer",
)


def example(name: str) -> kp.Solution:
    return next(iter(kp.load(ROOT / "examples" / f"{name}.toml").run().values()))


@pytest.mark.parametrize("name", EXAMPLES)
def test_forces_on_both_bodies_are_those_of_the_solution(name: str) -> None:
    solution = example(name)
    scene = kp.scene(solution, frames=23)
    motion = solution(np.array(scene["frames"]["t"]))
    elements = motion.compiled.constraints | motion.compiled.forces
    seen = set()
    for body in motion.compiled.all_bodies:
        for element, (force, _) in on_body(scene, body).items():
            right = motion[element].force(on=body)
            size = np.abs(right).max()
            np.testing.assert_allclose(force, right, rtol=1e-8, atol=1e-8 * size)
            seen.add(element)
    for element, info in elements.items():
        assert (element in seen) == bool(np.abs(motion[element].force(on=info.j)).max() > 0)


@pytest.mark.parametrize("name", EXAMPLES)
def test_reactions_act_where_the_solution_has_them(name: str) -> None:
    solution = example(name)
    scene = kp.scene(solution, frames=23)
    motion = solution(np.array(scene["frames"]["t"]))
    names = list(motion.compiled.all_bodies)
    of_joints = [end for end in scene["ends"] if end["group"] != "forces"]
    assert of_joints
    for end in of_joints:
        place = motion.place(end["element"], names[end["body"]])
        np.testing.assert_allclose(place_of(scene, end), place, rtol=1e-8, atol=1e-9)


@pytest.mark.parametrize(
    ("name", "body"),
    [
        ("balanced_lamp", "arm"),
        ("squeezer", "K3"),
        ("engine", "rod"),
        ("motor_press", "rod"),
        ("four_bar", "coupler"),
    ],
)
def test_forces_on_a_body_are_in_balance_with_its_inertia(name: str, body: str) -> None:
    """Newton and Euler: Σ F + m g = m a, and Σ r × F = J α about the mass centre."""
    solution = example(name)
    scene = kp.scene(solution, frames=23)
    motion = solution(np.array(scene["frames"]["t"]))
    info, view = motion.compiled.bodies[body], motion.body(body)
    centre = view.at(info.center)
    force = info.mass * (np.array(scene["gravity"]) - centre.acceleration)
    moment = -info.inertia * view.alpha
    sizes, turns = [np.abs(force).max()], [np.abs(moment).max()]
    acting = on_body(scene, body)
    assert len(acting) >= 2
    for each, place in acting.values():
        arm = place - centre.position
        turn = arm[:, 0] * each[:, 1] - arm[:, 1] * each[:, 0]
        force, moment = force + each, moment + turn
        sizes.append(np.abs(each).max())
        turns.append((np.hypot(*arm.T) * np.hypot(*each.T)).max())
    assert np.abs(force).max() < 1e-7 * max(sizes)
    assert np.abs(moment).max() < 1e-7 * max(turns)


@pytest.mark.parametrize(
    ("name", "element", "body", "point"),
    [
        ("jumping_follower", "touch", "cam", (0.005, 0.0)),  # a contact
        ("cam_roller", "contact", "follower", (0.0, 0.0)),  # a joint
    ],
)
def test_forces_of_a_body_on_a_curve_act_at_its_point(
    name: str, element: str, body: str, point: tuple[float, float]
) -> None:
    solution = example(name)
    scene = kp.scene(solution, frames=23)
    place = solution(np.array(scene["frames"]["t"])).body(body).at(point).position
    ends = [end for end in scene["ends"] if end["element"] == element]
    assert sorted(end["sign"] for end in ends) == [-1, 1]
    for end in ends:
        np.testing.assert_allclose(place_of(scene, end), place, rtol=1e-8, atol=1e-10)


def test_a_stop_of_a_coordinate_exerts_no_force_on_ground() -> None:
    scene = kp.scene(example("slamming_door"), frames=23)
    assert [end["body"] for end in scene["ends"] if end["element"] == "stop"] == [1]


def test_the_scale_has_the_largest_force() -> None:
    solution = sprung()
    force = np.hypot(*solution["s"].force(on="rod").T)
    assert kp.scene(solution)["largest"]["force"] == pytest.approx(force.max(), rel=1e-3)
    assert kp.scene(solution)["largest"]["force"] >= force[0] * (1 - 1e-8)


def test_ends_have_the_remarks_of_reactions() -> None:
    garage = example("garage_door")
    told = {end["remark"] for end in kp.scene(garage, frames=5)["ends"]}
    assert any(one.startswith("without bound at 1.39") for one in told)
    model = four_bar()
    model.revolute("again", "ground.D", "rocker.D")
    guess = {"coupler.angle": "14*deg", "rocker.angle": "240*deg"}
    state = kp.assemble(model, set={"crank.angle": "70*deg"}, guess=guess, redundancy="allow")
    assert state.constraint("D").unique is False
    remarks = {end["element"]: end["remark"] for end in kp.scene(state)["ends"]}
    assert remarks["D"] == remarks["again"] == "minimum norm"
    assert remarks["B"] == ""
