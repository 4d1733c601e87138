"""The scene agrees with the solution."""

import json
from importlib import resources
from typing import Any

import jsonschema
import kempe as kp
import numpy as np
import pytest
from draw.mechanisms import moving, pendulum, point_pendulum, resting, slider_crank, sprung
from house.places import ROOT
from kempe.draw.frame import Frame
from kempe.draw.geometry import placed, smooth
from kempe.draw.numbers import plain, round_below
from kempe.draw.scene import playback_rate

#: Numbers are rounded to nine significant digits.
HALF_A_DIGIT = 5.001e-9
SCHEMA = json.loads(
    (resources.files("kempe.draw") / "assets" / "scene.schema.json").read_text(encoding="utf-8")
)


def pins(scene: dict[str, Any], side: int) -> np.ndarray:
    """Places of the joints at all frames by their point on one of the bodies, (n_t, n, 2)."""
    poses = np.array([[[0, 0, 0], *frame] for frame in scene["frames"]["poses"]], dtype=float)
    joints = scene["joints"]
    found = [placed(poses[:, j["bodies"][side]], j["points"][side]) for j in joints]
    return np.stack(found, axis=1)


def test_it_fits_its_schema_and_is_json(four_bar: kp.Solution, hostile: kp.Solution) -> None:
    for drawn in (
        four_bar,
        hostile,
        four_bar.initial,
        pendulum(),
        slider_crank(),
        sprung(),
        point_pendulum(),
    ):
        told = json.loads(json.dumps(kp.scene(drawn), allow_nan=False))
        jsonschema.validate(told, SCHEMA)


def test_a_scene_of_another_version_does_not_fit(four_bar: kp.Solution) -> None:
    with pytest.raises(jsonschema.ValidationError):
        jsonschema.validate(kp.scene(four_bar.initial) | {"scene": 3}, SCHEMA)


def test_poses_rates_and_reactions_are_those_of_the_solution(four_bar: kp.Solution) -> None:
    scene = kp.scene(four_bar, frames=37)
    t = np.array(scene["frames"]["t"])
    np.testing.assert_allclose(t, np.linspace(0, 1, 37), rtol=1e-8)
    motion = four_bar(t)  # the numbers are those at the times that are written
    np.testing.assert_allclose(
        np.array(scene["frames"]["poses"]).reshape(37, -1), motion.q, rtol=HALF_A_DIGIT, atol=1e-15
    )
    np.testing.assert_allclose(
        np.array(scene["frames"]["rates"]).reshape(37, -1), motion.v, rtol=HALF_A_DIGIT, atol=1e-15
    )
    for k, name in enumerate("ABCD"):
        joint = motion.constraint(name)
        told = np.array(scene["frames"]["reactions"])[:, k]
        np.testing.assert_allclose(told, joint.force(on=joint.info.j), rtol=HALF_A_DIGIT)


def test_both_points_of_every_joint_are_in_one_place(four_bar: kp.Solution) -> None:
    scene = kp.scene(four_bar)
    np.testing.assert_allclose(pins(scene, 0), pins(scene, 1), atol=1e-3)
    C = four_bar(np.array(scene["frames"]["t"])).body("rocker").point("C").position
    np.testing.assert_allclose(pins(scene, 1)[:, 2], C, atol=1e-6)


def test_bounds_hold_everything(four_bar: kp.Solution) -> None:
    scene = kp.scene(four_bar)
    x0, y0, x1, y1 = scene["bounds"]
    places = pins(scene, 1)
    assert (places.min(axis=(0, 1)) >= np.array([x0, y0]) - 1e-6).all()
    assert (places.max(axis=(0, 1)) <= np.array([x1, y1]) + 1e-6).all()
    assert places[..., 0].max() == pytest.approx(x1)
    assert places[..., 1].max() == pytest.approx(y1)


def test_frames_follow_time(four_bar: kp.Solution) -> None:
    assert len(kp.scene(four_bar)["frames"]["t"]) == 241  # slow motion of one second
    assert 1200 <= len(kp.scene(moving(t_end=30))["frames"]["t"]) < 1210
    assert kp.scene(four_bar.final)["frames"]["t"] == [1.0]
    with pytest.raises(kp.ModelError, match="frames=0"):
        kp.scene(four_bar, frames=0)


def test_without_dense_output_the_frames_are_outputs() -> None:
    solution = moving(dense_output=False)
    scene = kp.scene(solution)
    assert scene["interpolation"] == "none"
    np.testing.assert_allclose(scene["frames"]["t"], solution.t)
    assert kp.scene(solution, frames=5)["frames"]["t"] == [0.0, 0.25, 0.5, 0.75, 1.0]


def test_where_reactions_have_no_answer_the_outputs_are_drawn(
    four_bar: kp.Solution, monkeypatch: pytest.MonkeyPatch
) -> None:
    def no_answer(*_: object) -> None:
        raise kp.SingularityError("dead point")

    monkeypatch.setattr("kempe.results.motion.Motion._evaluated", no_answer)
    scene = kp.scene(four_bar)
    np.testing.assert_allclose(scene["frames"]["t"], four_bar.t)
    told = np.array(scene["frames"]["reactions"])[:, 2]
    np.testing.assert_allclose(told, four_bar.constraint("C").force(on="rocker"), rtol=HALF_A_DIGIT)


def test_interpolation_is_offered_where_it_cannot_be_seen(four_bar: kp.Solution) -> None:
    fine, coarse = kp.scene(four_bar), kp.scene(four_bar, frames=12)
    assert (fine["interpolation"], coarse["interpolation"]) == ("cubic", "none")
    t, frames = np.array(fine["frames"]["t"]), fine["frames"]
    rocker, rates = (np.array(frames[key])[:, 2] for key in ("poses", "rates"))
    between = smooth(rocker, rates, t, 4)
    exact = four_bar(np.linspace(0, 1, 4 * (len(t) - 1) + 1)).body("rocker")
    np.testing.assert_allclose(between[:, 2], exact.angle, atol=1e-3)
    np.testing.assert_allclose(between[:, :2], exact.r, atol=0.03)


def test_bodies_are_drawn_by_their_shape(four_bar: kp.Solution) -> None:
    bars = kp.scene(four_bar.initial)["bodies"]
    assert [bar["kind"] for bar in bars] == ["ground", "bar", "bar", "bar"]
    assert bars[0]["outline"] == []
    assert bars[1]["outline"] == [[-5, 0], [5, 0]]
    plate = kp.scene(pendulum())["bodies"][1]
    assert sorted(plate["outline"]) == [[0, 0], [1, 0], [1, 0.5]]  # S lies inside


def marked(scene: dict[str, Any]) -> list[tuple[str, str]]:
    return [(symbol["element"], symbol["mark"]) for symbol in scene["symbols"]]


def test_symbols_are_those_of_the_elements(four_bar: kp.Solution) -> None:
    spiral = [("spring", "spiral_spring"), ("spring", "rotary_dashpot")]
    assert marked(kp.scene(four_bar)) == [*((name, "pin") for name in "ABCD"), *spiral]
    assert marked(kp.scene(sprung()))[1:] == [("s", "spring"), ("s", "dashpot")]
    assert marked(kp.scene(point_pendulum())) == [("rod", "rod")]


def test_a_symbol_without_points_is_at_the_joint_of_its_bodies(four_bar: kp.Solution) -> None:
    spring = kp.scene(four_bar.initial)["symbols"][4]
    assert (spring["bodies"], spring["points"]) == ([0, 3], [None, [9, 0]])
    rest = float(four_bar.initial["rocker"].angle)
    assert spring["turning"] == pytest.approx([rest, 0.0])


def test_a_symbol_between_points_has_them() -> None:
    spring = kp.scene(sprung())["symbols"][1]
    assert (spring["bodies"], spring["points"]) == ([0, 1], [[-1.2, 0.3], [0.5, 0]])


def test_a_slider_is_drawn_along_its_axis() -> None:
    solution = slider_crank()
    scene = kp.scene(solution)
    guide = scene["symbols"][3]
    assert (guide["mark"], guide["axes"]) == ("slide", [0.3, 0.1])
    low, high = guide["reach"]
    B = pins(scene, 1)[:, 3]
    along = B @ [np.cos(0.3), np.sin(0.3)]
    np.testing.assert_allclose([low, high], [along.min(), along.max()], rtol=1e-7)
    assert high - low == pytest.approx(0.2, abs=1e-3)  # twice the crank
    np.testing.assert_allclose(B @ [-np.sin(0.3), np.cos(0.3)], 0.0, atol=1e-6)


def test_one_unit_of_length_for_the_whole_drawing(four_bar: kp.Solution) -> None:
    assert kp.scene(four_bar)["length"] == {"unit": "m", "metres": 1.0}
    small = kp.load(ROOT / "examples" / "squeezer.toml").start()
    assert kp.scene(small)["length"] == {"unit": "mm", "metres": 1e-3}


def test_traces_are_points_that_move(four_bar: kp.Solution) -> None:
    told = [trace["name"] for trace in kp.scene(four_bar)["traces"]]
    assert told == ["crank.B", "coupler.C"]
    chosen = kp.scene(four_bar, traces=["coupler.B"])["traces"]
    assert chosen == [{"name": "coupler.B", "body": 2, "point": [-13, 0]}]
    for wrong in ("coupler", "coupler.X", "link.B"):
        with pytest.raises(kp.ModelError):
            kp.scene(four_bar, traces=[wrong])


def test_channels_are_those_of_the_solution(four_bar: kp.Solution) -> None:
    scene = kp.scene(four_bar)
    motion = four_bar(np.array(scene["frames"]["t"]))
    told = {channel["name"]: channel for channel in scene["channels"]}
    expected = {
        "spring.torque": ("N·m", motion.force("spring").torque(on="rocker")),
        "residual.length": ("m", np.abs(motion.residuals[0]).max(axis=1)),
    }
    for name, (unit, values) in expected.items():
        assert told[name]["unit"] == unit
        np.testing.assert_allclose(told[name]["values"], values, rtol=1e-8, atol=1e-15)
    assert "C.torque" not in told  # a pin has none
    assert "spring.force" not in told
    assert "residual.angle" not in told  # no equation of this model is an angle


def test_what_follows_from_the_frames_is_not_repeated(four_bar: kp.Solution) -> None:
    scene = kp.scene(four_bar)
    assert {channel["group"] for channel in scene["channels"]} == {"forces", "energy", "accuracy"}
    motion = four_bar(np.array(scene["frames"]["t"]))
    told = np.array(scene["frames"]["accelerations"]).reshape(len(motion.t), -1)
    np.testing.assert_allclose(told, motion.a, rtol=HALF_A_DIGIT, atol=1e-12)


def test_components_of_forces_of_elements_and_drivers() -> None:
    told = {one["name"]: one for one in kp.scene(sprung(), frames=9)["channels"]}
    motion = sprung()(np.linspace(0, 0.5, 9))
    force = motion.force("s").force(on="rod")
    for name, values in zip(("force_x", "force_y"), force.T, strict=True):
        np.testing.assert_allclose(told[f"s.{name}"]["values"], values, rtol=1e-7, atol=1e-7)
    np.testing.assert_allclose(told["s.force"]["values"], np.hypot(*force.T), rtol=1e-7)
    assert (told["s.force_x"]["of"], told["s.force_x"]["quantity"]) == ("s", "force_x")


def test_the_arrow_of_reactions_is_round(four_bar: kp.Solution) -> None:
    scene = kp.scene(four_bar)
    reactions = np.array(scene["frames"]["reactions"])
    largest = np.hypot(reactions[..., 0], reactions[..., 1]).max()
    unit, length = scene["reaction_scale"]["force"], scene["reaction_scale"]["length"]
    assert unit == 10_000
    size = scene["bounds"][2] - scene["bounds"][0]
    assert length * largest / unit == pytest.approx(0.3 * size)


def test_numbers_are_rounded_to_nine_digits_and_never_nan() -> None:
    values = np.array([[1 / 3, -0.0], [np.nan, 1.23456789123e-7]])
    assert plain(values) == [[0.333333333, 0.0], [None, 1.23456789e-7]]
    assert str(plain(values)[0][1]) == "0.0"


@pytest.mark.parametrize(("value", "expected"), [(1, 1), (4.9, 2), (5, 5), (0.03, 0.02), (99, 50)])
def test_round_numbers(value: float, expected: float) -> None:
    assert round_below(value) == pytest.approx(expected)


@pytest.mark.parametrize(
    ("duration", "rate"), [(15, 1), (0.03, 0.01), (1000, 10), (0, 1), (60, 1), (2, 1), (1, 0.5)]
)
def test_playback_takes_a_bearable_time(duration: float, rate: float) -> None:
    assert playback_rate(duration) == pytest.approx(rate)


def over_a_crank() -> kp.Solution:
    case = kp.load(ROOT / "examples" / "four_bar.toml")
    return kp.kinematics(
        case.model, case.start(), over="crank.angle", range=["70 deg", "90 deg"], n=5
    )


def test_frames_over_a_quantity_have_its_name_and_unit(four_bar: kp.Solution) -> None:
    of_time = kp.scene(four_bar)
    seconds = {"name": "t", "unit": "s", "shown": "s", "divisor": 1.0, "condition": ""}
    assert of_time["variable"] == seconds
    assert of_time["units"]["angular_acceleration"] == "rad/s²"
    turned = over_a_crank()
    told = kp.scene(turned)
    jsonschema.validate(told, SCHEMA)
    of = told["variable"]
    assert (of["name"], of["unit"], of["shown"]) == ("crank.angle", "rad", "°")
    assert of["condition"] == "with inertia and damping at 1 rad/s"
    units = told["units"]
    assert [units["velocity"], units["angular_acceleration"]] == ["m/rad", "rad/rad²"]
    assert told["frames"]["t"][-1] / of["divisor"] == pytest.approx(90.0)
    picture = Frame(told)
    picture.put(len(told["frames"]["t"]) - 1)
    texts = [text.get_text() for text in picture.axes.texts]
    assert "crank.angle = 90.000°" in [text.replace("\\", "") for text in texts]


def test_a_state_on_a_rigid_stop_has_the_known_forces_and_a_reason_for_the_others() -> None:
    state = resting(0.3)
    told = kp.scene(state)
    jsonschema.validate(told, SCHEMA)
    with pytest.raises(kp.KempeError) as error:
        _ = state.lam
    assert told["undetermined"] == error.value.args[0]
    assert "only a run decides" in told["undetermined"]
    assert {end["element"] for end in told["ends"]} == {"spring"}
    assert {one["of"] for one in told["channels"]} == {"spring"}
    assert told["frames"]["accelerations"] == [[[None, None, 0.0]] * 2]
    begun = kp.dynamics(state.compiled, state, t_end=0.01).initial
    after = kp.scene(begun)
    assert after["undetermined"] == ""
    assert {end["element"] for end in after["ends"]} == {"spring", "floor"}
    jsonschema.validate(after, SCHEMA)
