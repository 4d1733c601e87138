"""Tasks in CSV files, and the command."""

import json
from pathlib import Path

import kempe as kp
import numpy as np
import pytest
from command_line import kempe
from synthesis.test_motion import CRANK, KNOWN


def written(folder: Path, header: str, rows: np.ndarray) -> Path:
    lines = [header, *(", ".join(map(repr, row)) for row in rows.tolist())]
    path = folder / "task.csv"
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path


def test_poses_in_other_units_give_the_same_four_bars(tmp_path: Path) -> None:
    places, angles = KNOWN.poses(CRANK)
    rows = np.column_stack([places.real, places.imag, angles])
    path = written(tmp_path, "x [mm], y [mm], angle [deg]", rows * [1e3, 1e3, 180.0 / np.pi])
    found = kp.synthesis.from_file("motion", path)
    direct = kp.synthesis.motion(rows.tolist())
    assert len(found) == len(direct) == 5
    assert found[0].lengths == pytest.approx(direct[0].lengths, rel=1e-9)
    timed = written(tmp_path, "x, y, angle", np.column_stack([rows[:, :2], CRANK]))
    assert kp.synthesis.from_file("path", timed, defects="tell").complete
    pairs = np.column_stack([CRANK, np.unwrap(KNOWN.rocker(CRANK))])
    angles_of = written(tmp_path, "crank [deg], rocker [deg]", np.degrees(pairs))
    assert kp.synthesis.from_file("function", angles_of, defects="tell").complete


def test_the_command_writes_a_table_a_case_and_a_figure(tmp_path: Path) -> None:
    places, angles = KNOWN.poses(CRANK)
    path = written(tmp_path, "x, y, angle", np.column_stack([places.real, places.imag, angles]))
    out = tmp_path / "out"
    answer = kempe("synthesis", "motion", path, "-o", out, "--rank", "drive.effort.peak", "--json")
    told = json.loads(answer.stdout)
    assert told["complete"]
    assert len(told["candidates"]) == 5
    assert told["candidates"][0]["lengths"]["crank"] == pytest.approx(1.0)
    case = kp.load(out / "best.toml")
    assert case.start()["coupler.P.x"] == pytest.approx(places[0].real)
    assert len((out / "candidates.csv").read_text("utf-8").splitlines()) == 6
    assert [name.suffix for name in (out / "figures").iterdir()]
    plain = kempe("synthesis", "motion", path, "-o", out)
    assert "Found: 5 candidates" in plain.stdout


def test_wrong_files_are_explained(tmp_path: Path) -> None:
    path = written(tmp_path, "x, y", np.array([[0.0, 0.0], [1.0, 1.0]]))
    with pytest.raises(kp.FileError, match=r"no column angle.*x, y, angle"):
        kp.synthesis.from_file("motion", path)
    with pytest.raises(kp.ModelError, match="motion, path or function"):
        kp.synthesis.from_file("cam", path)
    wrong = written(tmp_path, "x [deg], y, angle", np.zeros((2, 3)))
    with pytest.raises(kp.ModelError, match="x"):
        kp.synthesis.from_file("motion", wrong)


def test_a_section_with_a_six_bar_and_prescribed_parts(tmp_path: Path) -> None:
    path = tmp_path / "generator.toml"
    path.write_text(
        "kempe = 1\n[synthesis]\ntask = 'function'\nfamily = 'watt_2'\n"
        "pairs = [[0, 0], ['30 deg', '10 deg'], ['60 deg', '25 deg']]\nsamples = 8\n"
        "[synthesis.pivots]\nG = [0.3, 0.1]\n"
        "[synthesis.parts]\ncrank = 0.2\narm = [0.2, 2]\nlink = { A = [0, 0], B = [1, 0] }\n"
    )
    best = kp.synthesis.from_case(kp.load(path), defects="tell")[0]
    assert best.points["G"] == pytest.approx((0.3, 0.1), abs=1e-12)
    assert [best.lengths[name] for name in ("crank", "link")] == pytest.approx([0.2, 1.0])
    path.write_text(path.read_text().replace("arm = [0.2, 2]", "arm = true"))
    with pytest.raises(kp.KempeError, match="arm"):
        kp.load(path)
