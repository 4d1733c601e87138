"""Mechanisms of PMKS+, in texts that the tests write themselves."""

from __future__ import annotations

from pathlib import Path

import kempe as kp
import numpy as np
import pytest
from command_line import kempe
from exchange.pmks_text import (
    CENTIMETRE,
    GROUND,
    INCH,
    INPUT,
    METRE,
    SEALED,
    SLIDE,
    WELDED,
    drawing,
    force,
    joint,
    link,
    number,
    stamped,
)

CRANK = [joint("A", 0, 0, INPUT | GROUND), joint("B", 0, 1)]
#: A four-bar linkage, its lengths in the unit of the drawing.
FOUR_BAR = (
    [*CRANK, joint("C", 3, 2), joint("D", 4, 0, GROUND)],
    [link("AB"), link("BC"), link("CD")],
)
#: Rate of the input of the drawings, rad/s.
RATE = 10 * 2 * np.pi / 60


def loaded(folder: Path, text: str, *, partial: bool = False) -> kp.Case:
    path = folder / "made.pmks"
    path.write_text(text, encoding="utf-8")
    return kp.load(path, partial=partial)


@pytest.mark.parametrize("hashed", [False, True])
@pytest.mark.parametrize(("units", "unit"), [(INCH, 0.0254), (CENTIMETRE, 0.01), (METRE, 1)])
def test_a_four_bar_has_its_lengths_in_metres_and_turns_clockwise(
    tmp_path: Path, units: str, unit: float, hashed: bool
) -> None:
    # the fourth choice of unit is missing in older texts
    text = drawing(*FOUR_BAR, units=units if hashed else units[:3])
    solution = loaded(tmp_path, stamped(text, hashed)).run()["motion"]
    angle = np.pi / 2 - RATE * solution.t
    assert solution.t[-1] == pytest.approx(6)
    b = unit * np.array([np.cos(angle), np.sin(angle)])
    c = np.array([solution["BC.C.x"], solution["BC.C.y"]])
    assert np.allclose([solution["AB.B.x"], solution["AB.B.y"]], b, atol=1e-9 * unit)
    assert np.allclose(np.hypot(*(c - b)), unit * np.hypot(3, 1), atol=1e-9 * unit)
    to_d = np.hypot(c[0] - 4 * unit, c[1])
    assert np.allclose(to_d, unit * np.hypot(1, 2), atol=1e-9 * unit)


#: A slide as one joint, and in older texts with a pin and a block between both.
SLIDES = {
    "one joint": ([joint("C", 3, 0, SLIDE | GROUND, 0, ",,,,,1E8")], []),
    "a block": (
        [joint("C", 3, 0), joint("P", 3, 0, SLIDE | GROUND)],
        [link("CP", kind="YP", values=(5, 0, 0, 0))],
    ),
}


@pytest.mark.parametrize("form", SLIDES)
def test_a_slider_crank_follows_its_closed_form(tmp_path: Path, form: str) -> None:
    joints, blocks = SLIDES[form]
    text = drawing([*CRANK, *joints], [link("AB"), link("BC"), *blocks])
    case = loaded(tmp_path, stamped(text))
    assert case.tree()["bodies"]["C_block"]["mass"] == pytest.approx(0.005)
    solution = case.run()["motion"]
    angle = np.pi / 2 - RATE * solution.t
    x = np.cos(angle) + np.sqrt(10 - np.sin(angle) ** 2)
    assert np.allclose(solution["C_block.x"], 0.01 * x, atol=1e-10)
    assert np.abs(solution["BC.C.y"]).max() < 1e-10


def test_a_slot_turns_with_its_link(tmp_path: Path) -> None:
    # the crank pin slides along CD; the text has it a thousandth beside the line
    joints = [
        joint("A", 0, 0, INPUT | GROUND),
        joint("B", 0, 1.001, SLIDE, 0, ",CD,C,D"),
        joint("C", 2, 0, GROUND),
        joint("D", -2, 2),
    ]
    case = loaded(tmp_path, stamped(drawing(joints, [link("AB"), link("CD")])))
    solution = case.run()["motion"]
    angle = np.pi / 2 - RATE * solution.t
    lever = np.arctan2(1.001 * np.sin(angle), 1.001 * np.cos(angle) - 2)
    start = np.arctan2(2, -4)
    assert np.allclose(solution["CD.angle"], np.unwrap(lever) - start, atol=1e-9)


@pytest.mark.parametrize("older", [False, True])
def test_a_scotch_yoke_moves_without_turning(tmp_path: Path, older: bool) -> None:
    joints = [joint("A", 0, 0, INPUT | GROUND), joint("D", 1, 2)]
    links = [link("AB"), link("CD")]
    if older:
        joints += [joint("B", 1, 0), joint("P", 1, 0, SLIDE, 0, ",CD,C,D")]
        joints += [joint("C", 1, -2, WELDED), joint("Q", 1, -2, SLIDE | GROUND)]
        links += [link("BP", kind="YP"), link("CQ", kind="YP")]
    else:
        joints += [joint("B", 1, 0, SLIDE, 0, ",CD,C,D")]
        joints += [joint("C", 1, -2, SLIDE | GROUND | WELDED)]
    solution = loaded(tmp_path, stamped(drawing(joints, links))).run()["motion"]
    assert np.abs(solution["CD.angle"]).max() < 1e-9
    assert np.allclose(solution["CD.C.x"], 0.01 * np.cos(RATE * solution.t), atol=1e-10)


def test_welded_links_are_one_body_with_the_forces_of_all(tmp_path: Path) -> None:
    # an angled crank: 2 g at (1, 0.5) cm and 0.5 kg cm² of inertia; 3 N down at its end
    joints = [joint("A", 0, 0, INPUT | GROUND), joint("B", 2, 0, WELDED), joint("C", 2, 1)]
    links = [
        link("ABC", values=(2, 0.5, 1, 0.5), parts="AB,BC"),
        link("AB", kind="NR"),
        link("BC", kind="NR"),
    ]
    forces = [
        force("F", "BC", (2, 1), (2, 0), 3),
        force("G", "ABC", (2, 1), (3, 1), 4, flags=1),
    ]
    case = loaded(tmp_path, stamped(drawing(joints, links, forces)))
    tree = case.tree()
    assert set(tree["bodies"]) == {"ground", "ABC"}
    assert tree["bodies"]["ABC"]["inertia"] == pytest.approx(0.5e-4)
    solution = kp.inverse_dynamics(case.model, case.start(), t_end=6)
    angle = -RATE * solution.t
    arm = 0.01 * (np.cos(angle) - 0.5 * np.sin(angle))
    # G turns with the link and points inward: -4 N along x of the link, 1 cm above A
    torque = 0.002 * 9.80665 * arm + 3 * 2 * arm - 4 * 0.01
    assert np.allclose(solution["drive_A.effort"], torque, atol=1e-12)


def test_a_drawing_without_gravity_and_a_bar_on_ground(tmp_path: Path) -> None:
    joints, links = FOUR_BAR
    load = force("F", "AD", (1, 0), (1, 1), 1)
    case = loaded(tmp_path, stamped(drawing(joints, [*links, link("AD")], [load], weightless=True)))
    assert case.unread == ("line 1: force F: it acts on ground",)
    tree = case.tree()
    assert tree["gravity"] == [0, 0]
    assert set(tree["bodies"]) == {"ground", "AB", "BC", "CD"}


def test_an_input_between_two_links_turns_the_later_one(tmp_path: Path) -> None:
    joints = [joint("A", 0, 0, GROUND), joint("B", 0, 1), joint("D", 4, 0, GROUND)]
    text = drawing([*joints, joint("C", 3, 2, INPUT)], [link("AB"), link("BC"), link("CD")])
    case = loaded(tmp_path, stamped(text))
    solution = kp.kinematics(case.model, case.start(), t_end=0.1)
    turned = solution["CD.angle"] - solution["BC.angle"]
    assert np.allclose(turned, -RATE * solution.t, atol=1e-9)


def test_a_cylinder_has_its_range(tmp_path: Path) -> None:
    # the end D of the rod is on a lever of 2 cm about E; the barrel turns about A
    joints = [
        joint("A", 0, 0, GROUND),
        joint("B", 1.5, 1),
        joint("C", 0.75, 0.5, SLIDE | INPUT | WELDED | SEALED, 0, ",AB,A,B,1E8"),
        joint("D", 3, 2),
        joint("E", 3, 0, GROUND),
    ]
    case = loaded(tmp_path, stamped(drawing(joints, [link("AB"), link("CD"), link("DE")])))
    assert any("no ends" in text for text in case.unread)
    tree = case.tree()
    # 5 cm/s, which moves the rod out of the barrel
    assert tree["drivers"]["drive_C"]["value"] == "0.05*t"
    assert tree["analyses"]["range_C"]["from"] == "start"
    found = case.run()["range_C"]
    # the lever and the line of the cylinder: |AD| from 1 cm to 5 cm
    length = np.hypot(3, 2)
    assert found.lower == pytest.approx(0.01 * (1 - length), abs=1e-8)
    assert found.upper == pytest.approx(0.01 * (5 - length), abs=1e-8)


def test_exact_values_and_speeds_of_their_own(tmp_path: Path) -> None:
    joints, links = FOUR_BAR
    entries = "JB,PJB~1~1.0004,PLAB~0~0.00012,PI~0~12.5,KJB~d"
    case = loaded(tmp_path, stamped(drawing(joints, links, entries=entries)))
    assert any("colours" in text for text in case.unread)
    tree = case.tree()
    assert tree["bodies"]["AB"]["mass"] == pytest.approx(1.2e-7)
    solution = case.run()["motion"]
    assert solution.t[-1] == pytest.approx(60 / 12.5)
    assert np.allclose(np.hypot(solution["AB.B.x"], solution["AB.B.y"]), 0.010004, atol=1e-12)
    # 30 rpm of its own, and anticlockwise
    own = [joint("A", 0, 0, INPUT | GROUND, 0, f",,,,{number(30)}"), *joints[1:]]
    solution = loaded(tmp_path, stamped(drawing(own, links))).run()["motion"]
    assert solution["AB.angle"][-1] == pytest.approx(2 * np.pi)
    assert solution.t[-1] == pytest.approx(2)


def test_a_link_in_a_text_is_found(tmp_path: Path) -> None:
    joints, links = FOUR_BAR
    text = stamped(drawing(joints, [link("AB", "Kurbel ü"), *links[1:]]))
    path = tmp_path / "notes.txt"
    address = text.replace(" ", "%20").replace("ü", "%C3%BC")
    path.write_text(f"a four-bar:\n  <https://app.pmksplus.com/?{address}>\n", encoding="utf-8")
    assert "Kurbel ü" in kp.load(path).tree()["bodies"]
    out = tmp_path / "case.toml"
    done = kempe("convert", str(path), str(out), "--from", "pmks")
    assert done.returncode == 0, done.stderr
    assert kp.load(out).tree()["bodies"].keys() == kp.load(path).tree()["bodies"].keys()


MORE = {
    "a number": ([joint("E", 0, 0) + ",,,,?"], [], "'[?]' is not a number"),
    "flags": (["?E,E,0,0,0"], [], "flags"),
    "another joint": ([joint("B", 1, 1)], [], "joint B: there is another one"),
    "another link": ([], [link("AB")], "link AB: there is another one"),
    "no joint": ([], [link("AX")], "there is no joint X"),
    "no record": ([], ["ZRAB"], "not known"),
    "half a slot": ([joint("E", 1, 1, SLIDE, 0, ",AB,A")], [], "a slot needs"),
    "no guide": ([joint("E", 1, 1, SLIDE)], [link("AE")], "no guide"),
    "two guides": ([joint("E", 1, 1, SLIDE | GROUND, 0, ",AB,A,B")], [link("AE")], "two guides"),
    "a strange slot": ([joint("E", 1, 1, SLIDE, 0, ",AB,A,D")], [link("CE")], "not on its link"),
    "friction": ([joint("E", 1, 1, 0, 0, ",,,,,,,1")], [link("AE")], "further values"),
    "an input of one": ([joint("E", 1, 1, INPUT)], [link("AE")], "needs two bodies"),
    "a part alone": ([], [link("AB", kind="NR").replace("AB", "EF", 1)], "no link that moves"),
    "a block alone": ([], [link("BC", kind="YP").replace("BC", "EF", 1)], "a slide and a pin"),
    "a mass": ([joint("E", 1, 1)], [link("AE", values=(-1, 1, 0, 0))], "negative"),
}


@pytest.mark.parametrize("name", MORE)
def test_what_has_no_equal_is_named_and_the_rest_kept(tmp_path: Path, name: str) -> None:
    joints, links, message = MORE[name]
    text = stamped(drawing([*FOUR_BAR[0], *joints], [*FOUR_BAR[1], *links]))
    with pytest.raises(kp.FileError, match=message):
        loaded(tmp_path, text)
    assert {"AB", "BC", "CD"} <= set(loaded(tmp_path, text, partial=True).tree()["bodies"])


@pytest.mark.parametrize(
    ("forces", "entries", "message"),
    [
        ([force("F", "XY", (0, 0), (1, 0), 1)], "", "force F: it acts on no link"),
        ([force("F", "AB", (0, 0), (0, 0), 1)], "", "no direction"),
        ([force("F", "AB", (0, 0), (1, 0), -1)], "", "no direction"),
        ([], "G1~abc", "entry 'G1~abc' is not supported"),
        ([], "PJZ~0~1", "no value 'JZ~0'"),
        ([], "PJA~0~1e99", "entry 'PJA~0~1e99'"),
    ],
)
def test_forces_and_entries_without_equal_are_named(
    tmp_path: Path, forces: list[str], entries: str, message: str
) -> None:
    text = stamped(drawing(*FOUR_BAR, forces, entries=entries))
    with pytest.raises(kp.FileError, match=message):
        loaded(tmp_path, text)


def test_other_texts_are_refused(tmp_path: Path) -> None:
    good = stamped(drawing(*FOUR_BAR))
    for text, message in (
        ("", "not a mechanism"),
        ("one.two.three.four.five.six.seven", "not a mechanism"),
        (good.replace("YRBC", "YRBD"), "check sum"),
        (good[:-9], "check sum"),
        (stamped(drawing(*FOUR_BAR), hashed=False)[:-2], "check sum"),
        (stamped(f"0P.Fe.K,0.101.{CRANK[0]}."), "are missing"),
        (stamped(drawing(*FOUR_BAR, units="9000")), "unit of lengths"),
        (stamped(drawing([CRANK[1]] * 1001, [])), "more than 1000"),
        ("pmks2:0123abcd.e30", "this version"),
        ("https://pmksplus.mech.website/?j=A,1,2", "this version"),
        (f"{good}\n{good}", "line 2: a second mechanism"),
    ):
        with pytest.raises(kp.FileError, match=message):
            loaded(tmp_path, text)
