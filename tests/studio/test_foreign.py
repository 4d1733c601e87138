"""Files of other tools, opened in the page, compared with what Python reads from them."""

from pathlib import Path
from typing import Any

import kempe as kp
import pytest
from kempe import _core
from studio.window import Studio

SAMPLES = Path(__file__).parents[2] / "exchange" / "tests" / "samples"

#: Drops a file with a name and a text onto the drawing.
DROP = """([name, text]) => {
  const data = new DataTransfer();
  data.items.add(new File([text], name));
  document.getElementById("sheet").dispatchEvent(
    new DragEvent("drop", { dataTransfer: data, bubbles: true, cancelable: true }));
}"""


def check_alike(found: Any, expected: Any) -> None:
    """Two trees have the same parts. A sine may have another last digit in a browser."""
    if isinstance(expected, (dict, list)):
        assert len(found) == len(expected)
        for key in expected if isinstance(expected, dict) else range(len(expected)):
            check_alike(found[key], expected[key])
    elif isinstance(expected, (int, float)):
        assert found == pytest.approx(expected, rel=1e-12, abs=1e-12)
    else:
        assert found == expected


def opened(one: Studio, path: Path) -> None:
    """Open a file by the button *Open*."""
    with one.page.expect_file_chooser() as chooser:
        one.page.locator("#open").click()
    offered = (chooser.value.element.get_attribute("accept") or "").split(",")
    assert {f".{name}" for name in _core.exchange_formats()} < set(offered)
    chooser.value.set_files(path)
    one.settle()


@pytest.mark.parametrize("path", sorted(SAMPLES.iterdir()), ids=lambda path: path.suffix[1:])
def test_a_file_of_another_tool_becomes_the_case_that_python_reads(one: Studio, path: Path) -> None:
    case = kp.load(path, partial=True)
    opened(one, path)
    check_alike(one.tree(), case.tree())
    start = case.start()
    state = one.state()
    assert state["q"] == pytest.approx(start.q, abs=1e-12, rel=1e-12)
    listed = [line[4:] for line in one.toml().splitlines() if line.startswith("#   line")]
    assert listed == [part for part in case.unread if part.startswith("line")]
    # saved beside the file, not over it
    with one.page.expect_download() as download:
        one.page.locator("#save").click()
    assert download.value.suggested_filename == f"{path.stem}.toml"


def test_a_message_says_what_is_left_out_and_an_older_drawing_is_decoded(
    one: Studio, tmp_path: Path
) -> None:
    text = (SAMPLES / "pendulum.adm").read_text()
    path = tmp_path / "twisted.adm"
    path.write_text(text.replace("END\n", "BEAM/1, I = 0101\nEND\n"))
    opened(one, path)
    assert "A part of twisted.adm has no equal here" in one.message()
    assert "# Not read from twisted.adm:" in one.toml()
    plates = (SAMPLES / "plates.dxf").read_text()
    layer = plates.split("  8\n", 2)[1].split("\n")[0]
    path = tmp_path / "older.dxf"
    path.write_bytes(plates.replace(layer, "hübsch").encode("cp1252"))
    opened(one, path)
    assert "hübsch" in one.toml()
    binary = tmp_path / "picture.asmt"
    binary.write_bytes(bytes(range(256)))
    before = one.toml()
    opened(one, binary)
    assert "picture.asmt is not a text in UTF-8" in one.message()
    assert one.toml() == before


def test_a_file_can_be_dropped_onto_the_sheet_and_undone(one: Studio, tmp_path: Path) -> None:
    before = one.toml()
    path = SAMPLES / "slider_crank.asmt"
    one.call(DROP, [path.name, path.read_text()])
    one.settle()
    check_alike(one.tree(), kp.load(path, partial=True).tree())
    one.page.keyboard.press("Control+z")
    one.settle()
    assert one.toml() == before
    own = kp.load(path, partial=True)
    own.save(tmp_path / "again.json")
    one.call(DROP, ["again.json", (tmp_path / "again.json").read_text()])
    one.settle()
    check_alike(one.tree(), own.tree())
