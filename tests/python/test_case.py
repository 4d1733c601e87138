"""Cases: reading, running, saving, and invalid files."""

import json
import os
from pathlib import Path

import kempe as kp
import numpy as np
import pytest


def test_a_file_is_read(four_bar_file: Path) -> None:
    case = kp.load(four_bar_file)
    assert case.model.title == "Four-bar linkage with a rotational spring-damper"
    assert list(case.analyses) == ["release"]
    assert case.start()["crank"].angle == pytest.approx(np.deg2rad(70), abs=1e-12)


def test_results_by_name_and_by_index(four_bar_file: Path) -> None:
    results = kp.load(four_bar_file).run()
    assert list(results) == ["release"]
    assert results[0] is results["release"]
    assert results["release"].t[-1] == pytest.approx(0.5)
    with pytest.raises(kp.ModelError, match="did you mean 'release'"):
        results["relaese"]


def test_an_analysis_starts_at_the_end_of_the_previous_one(model: kp.Model) -> None:
    start = kp.Start(set={"crank.angle": "70*deg"}, guess={"rocker.angle": "240*deg"})
    analyses = [
        kp.Dynamics(0.1, name="first"),
        kp.Dynamics(0.2, name="second"),
        kp.Dynamics(0.05, name="again", after="start"),
    ]
    results = kp.Case(model, start, analyses).run()
    assert results["second"].t[0] == results["first"].t[-1]
    np.testing.assert_array_equal(results["second"].q[0], results["first"].q[-1])
    assert results["again"].t[0] == 0.0
    np.testing.assert_array_equal(results["again"].q[0], results["first"].q[0])


@pytest.mark.parametrize("suffix", [".toml", ".json"])
def test_a_saved_case_is_loaded_unchanged(four_bar_file: Path, tmp_path: Path, suffix: str) -> None:
    case = kp.load(four_bar_file)
    saved = tmp_path / f"again{suffix}"
    case.save(saved)
    assert kp.load(saved).tree() == case.tree()
    first, second = case.run()[0], kp.load(saved).run()[0]
    np.testing.assert_array_equal(first.q, second.q)


def test_a_case_built_in_python_equals_the_case_in_the_file(
    model: kp.Model, four_bar_file: Path, tmp_path: Path
) -> None:
    start = {
        "set": {"crank.angle": "70*deg"},
        "guess": {"coupler.angle": "14*deg", "rocker.angle": "240*deg"},
    }
    classical = {"method": kp.RK45(rtol=1e-6, atol=1e-9), "stabilization": kp.Baumgarte()}
    release = kp.Dynamics(0.5, output_step=0.01, name="release", **classical)
    case = kp.Case(model, start, [release])
    case.save(tmp_path / "built.toml")
    built, written = kp.load(tmp_path / "built.toml").run()[0], kp.load(four_bar_file).run()[0]
    np.testing.assert_array_equal(built.q, written.q)


def test_overridden_parameters_are_saved(four_bar_file: Path, tmp_path: Path) -> None:
    case = kp.load(four_bar_file, parameters={"k": 2e6, "c": "k/50"})
    assert case.model.parameters["k"] == 2e6
    assert case.model.parameters["c"] == pytest.approx(4e4)
    case.save(tmp_path / "stiff.toml")
    assert kp.load(tmp_path / "stiff.toml").model.parameters["c"] == pytest.approx(4e4)


def test_nested_keys_of_start_are_equivalent(four_bar_file: Path) -> None:
    text = four_bar_file.read_text(encoding="utf-8")
    four_bar_file.write_text(text.replace('"crank.angle" =', "crank.angle ="), encoding="utf-8")
    assert kp.load(four_bar_file).held == {"crank.angle": "70*deg"}


def test_an_error_in_a_file_has_its_line(four_bar_file: Path) -> None:
    text = four_bar_file.read_text(encoding="utf-8").replace("mass = 3", "mass = -3")
    four_bar_file.write_text(text, encoding="utf-8")
    with pytest.raises(kp.ModelError) as caught:
        kp.load(four_bar_file)
    (problem,) = caught.value.problems
    assert problem.path == "bodies.crank.mass"
    assert problem.line is not None


def broken(folder: Path, kind: str) -> Path:
    path = folder / f"{kind}.toml"
    match kind:
        case "folder":
            path.mkdir()
        case "not utf-8":
            path.write_bytes(b'title = "\xff"')
        case "too large":
            path.write_bytes(b"#" * (16 * 2**20 + 1))
        case "syntax":
            path.write_text("kempe = = 1", encoding="utf-8")
        case "suffix":
            return folder / "case.yaml"
    return path


@pytest.mark.parametrize(
    ("kind", "words"),
    [
        ("missing", "does not exist"),
        ("folder", "folder"),
        ("not utf-8", "UTF-8"),
        ("too large", "16 MiB"),
        ("suffix", r"\.toml or \.json"),
        ("syntax", "syntax"),
    ],
)
def test_an_invalid_file_is_refused_with_its_name(tmp_path: Path, kind: str, words: str) -> None:
    path = broken(tmp_path, kind)
    with pytest.raises(kp.FileError, match=words) as caught:
        kp.load(path)
    assert str(path) in str(caught.value)


@pytest.mark.skipif(os.name != "posix" or os.geteuid() == 0, reason="root may read everything")
def test_a_file_without_permission_is_reported(four_bar_file: Path) -> None:
    four_bar_file.chmod(0)
    with pytest.raises(kp.FileError, match="not permitted"):
        kp.load(four_bar_file)


def test_a_failed_save_keeps_the_old_file_and_leaves_no_other(
    four_bar_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    case = kp.load(four_bar_file)
    target = tmp_path / "kept.json"
    target.write_text("old", encoding="utf-8")

    def full(_: int) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(kp.FileError, match="No space left"):
        case.save(target)
    assert target.read_text(encoding="utf-8") == "old"
    assert sorted(path.name for path in tmp_path.iterdir()) == ["four_bar.toml", "kept.json"]


def test_saving_creates_folders_and_keeps_links_and_permissions(
    four_bar_file: Path, tmp_path: Path
) -> None:
    case = kp.load(four_bar_file)
    real = tmp_path / "a" / "b" / "case.json"
    case.save(real)
    real.chmod(0o640)
    link = tmp_path / "link.json"
    link.symlink_to(real)
    case.save(link)
    assert link.is_symlink()
    assert real.stat().st_mode & 0o777 == 0o640
    assert json.loads(real.read_text(encoding="utf-8"))["kempe"] == 1


def test_saving_onto_a_folder_is_refused(four_bar_file: Path, tmp_path: Path) -> None:
    (tmp_path / "here.json").mkdir()
    with pytest.raises(kp.FileError, match="is a folder"):
        kp.load(four_bar_file).save(tmp_path / "here.json")


@pytest.mark.parametrize(
    ("analyses", "words"),
    [
        ([kp.Dynamics(1), kp.Dynamics(2)], "name is taken"),
        (["dynamics"], "not an analysis"),
        ([kp.Dynamics(float("nan"))], r"analyses\.dynamics\.t_end"),
        ([kp.Dynamics(1, method=kp.RK45(rtol=1j))], r"analyses\.dynamics\.method\.rtol"),
        ([kp.Dynamics(1, method="rk45")], r"analyses\.dynamics\.method"),
    ],
)
def test_wrong_analyses_are_refused(model: kp.Model, analyses: list, words: str) -> None:
    with pytest.raises(kp.ModelError, match=words):
        kp.Case(model, analyses=analyses)


def test_a_wrong_key_of_start_is_refused(model: kp.Model) -> None:
    with pytest.raises(kp.ModelError, match="did you mean 'guess'"):
        kp.Case(model, start={"gues": {}})
