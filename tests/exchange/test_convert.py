"""``kempe convert`` and the choice of the format."""

from __future__ import annotations

import shutil
from pathlib import Path

import kempe as kp
import pytest
from command_line import kempe

SAMPLES = Path(__file__).parents[2] / "exchange" / "tests" / "samples"


@pytest.mark.parametrize("sample", sorted(SAMPLES.iterdir()), ids=lambda path: path.name)
def test_the_content_gives_the_format_where_the_ending_does_not(
    tmp_path: Path, sample: Path
) -> None:
    copied = shutil.copy(sample, tmp_path / "copied.txt")
    assert kp.load(copied).tree() == kp.load(sample).tree()
    assert kp.load(copied, form=sample.suffix[1:]).tree() == kp.load(sample).tree()


def test_a_file_becomes_a_case_and_a_drawing(tmp_path: Path) -> None:
    case, drawing = tmp_path / "case.toml", tmp_path / "out.dxf"
    done = kempe("convert", str(SAMPLES / "quick_return.linkage2"), str(case))
    assert done.returncode == 0, done.stderr
    assert "left out: line 10: an element of a drawing layer" in done.stdout
    assert list(kp.load(case).model.tree()["bodies"]) == ["ground", "crank", "link1"]
    assert kempe("convert", str(case), str(drawing)).returncode == 0
    assert "crank" in kp.load(drawing).model.tree()["bodies"]
    again = kempe("convert", str(case), str(drawing))
    assert again.returncode != 0
    assert "--force" in again.stderr
    assert kempe("convert", str(case), str(drawing), "--force").returncode == 0


def test_what_is_lost_needs_the_option_partial(tmp_path: Path) -> None:
    broken = tmp_path / "broken.adm"
    text = (SAMPLES / "pendulum.adm").read_text()
    broken.write_text(text.replace("END", "BEAM/7, I = 0101\nEND"))
    refused = kempe("convert", str(broken), str(tmp_path / "case.json"))
    assert refused.returncode != 0
    assert "BEAM/7" in refused.stderr
    done = kempe("convert", str(broken), str(tmp_path / "case.json"), "--partial")
    assert done.returncode == 0
    assert "BEAM/7" in done.stdout
