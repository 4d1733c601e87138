"""The meter of builds counts as the tools do whose numbers it replaces, and refuses growth."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from house.places import ROOT

from tools import build_meter
from tools.meter import llvm_lines, machine_code, timing, v0_names

POSIX = pytest.mark.skipif(os.name != "posix", reason="./kempe is a script for POSIX shells")
LINUX = pytest.mark.skipif(sys.platform != "linux", reason="the extension is not an ELF file")

LL = """; ModuleID = 'kempe'
declare void @elsewhere()
@constant = private constant [2 x i8] c"a}"

; a comment
define internal void @_RINvNtNtCsaa_5kempe5solve3one3rowINtNtNtB6_4math4dual4DualKj3_EEB6_(ptr %x) {
start:
  ; a comment in a function
  %y = call i64 @f(ptr %x)
  switch i64 %y, label %bb1 [
    i64 0, label %bb2
  ]

bb1:
  ret void
}

define { ptr, i64 } @_ZN5other8function17h0E(ptr %x) {
  ret { ptr, i64 } zeroinitializer
}
"""


def test_only_the_instructions_of_functions_count() -> None:
    """The entries of `switch` are indented further; its end counts, as in `cargo llvm-lines`."""
    (name, lines), other = llvm_lines.functions(LL.splitlines(keepends=True))
    assert name.startswith("_RINvNtNtCsaa_5kempe5solve")
    assert lines == 4
    assert other == ("_ZN5other8function17h0E", 1)


@pytest.mark.parametrize(
    ("mangled", "text", "module"),
    [
        ("_RNvCsaa_5kempe3run", "kempe::run", "lib"),
        ("_RNvNtNtCsaa_5kempe5solve6saddle3row", "kempe::solve::saddle::row", "solve::saddle"),
        (
            "_RNvNtNtNtCsaa_5kempe8elements6joints4weld8residual",
            "kempe::elements::joints::weld::residual",
            "elements::joints",
        ),
        # a method of an implementation in another module than its type
        (
            "_RNvXs_NtNtCsaa_5kempe5model5itemsNtNtNtB8_4math5plane4PoseNtNtB8_5model4Kind3map",
            "<kempe::math::plane::Pose as kempe::model::Kind>::map",
            "model::items",
        ),
        # a function of the library whose argument is a closure
        (
            "_RINvNtCsbb_4core4iter4foldNtNtNtCsaa_5kempe5model4body4BodyNCNvNtBu_4case4read0EBu_",
            "core::iter::fold<kempe::model::body::Body, kempe::case::read::{closure}>",
            "case",
        ),
        # without a closure, a type outside of `math` is preferred
        (
            "_RINvNtCsbb_4core3ptr4dropTNtNtNtCsaa_5kempe4math5lanes5LanesNtNtNtBu_5model4body4BodyEEBu_",
            "core::ptr::drop<(kempe::math::lanes::Lanes, kempe::model::body::Body)>",
            "model::body",
        ),
        (
            "_RINvNtCsbb_4core3ptr4dropRShKj1f_Kb1_ECsaa_5kempe",
            "core::ptr::drop<&[u8], 31, true>",
            None,
        ),
    ],
)
def test_names_are_read(mangled: str, text: str, module: str | None) -> None:
    assert v0_names.read(mangled, "kempe") == (text, module or v0_names.OTHER)


@pytest.mark.parametrize(
    ("name", "scalar"),
    [
        ("kempe::solve::f<f64>", llvm_lines.PLAIN),
        ("<kempe::math::lanes::Lanes as kempe::math::real::Real>::sin", "Lanes"),
        ("kempe::f<kempe::math::dual::Dual<3>>::g<fn() -> f64>", "Dual<3>"),
        (
            "kempe::f<kempe::math::lanes::Lanes, kempe::math::jet::Jet<kempe::math::dual::Dual<3, "
            "kempe::math::lanes::Lanes>>>",
            "Jet<Dual<3, Lanes>>",
        ),
        ("kempe::model::LanesOf", llvm_lines.PLAIN),
    ],
)
def test_the_longest_scalar_is_found(name: str, scalar: str) -> None:
    assert llvm_lines.scalar(name) == scalar


def test_lines_are_added_by_module_and_scalar() -> None:
    counted = llvm_lines.count(LL.splitlines(keepends=True))
    assert (counted.lines, counted.functions) == (5, 2)
    assert counted.by_module == {"solve::one": 4, v0_names.OTHER: 1}
    assert counted.by_scalar == {"Dual<3>": 4, llvm_lines.PLAIN: 1}


@pytest.mark.parametrize(
    ("name", "module"),
    [
        ("kempe::solve::saddle::Saddle<S>::mixed_row", "solve::saddle"),
        ("kempe::model::size::{{closure}}", "model"),
        ("<[T; N] as kempe::elements::declare::Element>::map", "elements::declare"),
        ("core::ptr::drop_in_place<kempe_drawing::scene::mark::Mark>", "kempe_drawing::scene"),
        ("alloc::vec::Vec<T,A>::push", v0_names.OTHER),
    ],
)
def test_modules_of_machine_code(name: str, module: str) -> None:
    assert machine_code.module(name) == module


def test_growth_by_five_percent_is_refused() -> None:
    assert build_meter.fault(build_meter.CODE, 1_049_000, 1_000_000) is None
    found = build_meter.fault(build_meter.CODE, 1_051_000, 1_000_000)
    assert found
    assert "1 051 000, 5.1 % more than the agreed 1 000 000" in found
    assert "python tools/build_meter.py code" in found


def test_the_page_contains_the_agreed_numbers() -> None:
    text = (ROOT / build_meter.PAGE).read_text(encoding="utf-8")
    for name in (build_meter.CODE, build_meter.LINES):
        assert build_meter.agreed(text, name) > 1_000_000
    assert build_meter.agreed("| size | 12 345 |\n", "size") == 12345
    with pytest.raises(ValueError, match="no row"):
        build_meter.agreed("| size | ? |\n", "size")


@pytest.fixture
def checkout(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A checkout with an extension that was built by the set-up, and an agreed size of 1000."""
    page = tmp_path / build_meter.PAGE
    for folder in (page.parent, tmp_path / "tools", tmp_path / "python/kempe", tmp_path / ".venv"):
        folder.mkdir(parents=True)
    page.write_text(f"| {build_meter.CODE} | 1 000 |\n")
    shutil.copy(ROOT / "tools" / "setup.sh", tmp_path / "tools")
    (tmp_path / "python/kempe/_core.abi3.so").touch()
    monkeypatch.setattr(build_meter, "ROOT", tmp_path)
    monkeypatch.setattr(build_meter, "why_incomparable", lambda *_: None)
    monkeypatch.setenv("KEMPE_PROFILE", "release")
    return tmp_path


def stamped(root: Path, profile: str) -> None:
    """Write the stamp of a build in a profile."""
    script = 'ROOT=$1; . "$ROOT/tools/setup.sh"; write_stamp build "$(sources_sum)"'
    environment = os.environ | {"KEMPE_PROFILE": profile}
    subprocess.run(
        ["sh", "-c", script, "sh", root], env=environment, capture_output=True, check=True
    )


@POSIX
def test_a_check_fails_if_the_agreed_number_is_exceeded(
    checkout: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    stamped(checkout, build_meter.PROFILE)
    for size, code in ((1049, 0), (1051, 1)):
        monkeypatch.setattr(machine_code, "code_bytes", lambda _, size=size: size)
        assert build_meter.main(["check"]) == code
    printed = capsys.readouterr().out
    assert "1 049, agreed 1 000" in printed
    assert "5.1 % more" in printed


@POSIX
def test_an_extension_of_another_profile_is_not_compared(
    checkout: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for prepare in (
        lambda: None,
        lambda: stamped(checkout, "release"),
        lambda: (
            stamped(checkout, build_meter.PROFILE),
            os.utime(checkout / ".venv/stamp-build", (0, 0)),
        ),
    ):
        prepare()
        assert build_meter.main(["check"]) == 0
        assert "skipped, because" in capsys.readouterr().out


def test_other_builds_are_not_compared() -> None:
    reason = build_meter.why_incomparable
    here = ("x86_64", "Linux")
    assert reason({}, *here) is None
    assert reason({"RUSTFLAGS": "-C target-cpu=x86-64-v3"}, *here) is None
    assert "RUSTFLAGS" in (reason({"RUSTFLAGS": "-C target-cpu=x86-64"}, *here) or "")
    assert "aarch64" in (reason({}, "aarch64", "Linux") or "")
    assert "CARGO_PROFILE" in (reason({"CARGO_PROFILE_CHECKOUT_LTO": "thin"}, *here) or "")


def test_the_profile_is_that_of_the_set_up() -> None:
    script = (ROOT / "tools" / "setup.sh").read_text(encoding="utf-8")
    assert re.findall(r"^PROFILE=\$\{KEMPE_PROFILE:-(\w+)\}", script, re.MULTILINE) == [
        build_meter.PROFILE
    ]


@LINUX
def test_the_code_of_the_extension_is_that_of_size() -> None:
    size = shutil.which("size")
    if size is None:
        pytest.skip("the program size is missing (Debian: apt install binutils)")
    path = machine_code.extension(ROOT)
    listed = subprocess.run([size, "-A", path], capture_output=True, text=True, check=True).stdout
    (expected,) = re.findall(r"^\.text +(\d+)", listed, re.MULTILINE)
    assert machine_code.code_bytes(path) == int(expected)


def test_a_file_of_another_format_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "_core.so"
    path.write_bytes(b"MZ")
    with pytest.raises(ValueError, match="not an ELF file"):
        machine_code.code_bytes(path)


@LINUX
def test_the_modules_contain_most_of_the_code() -> None:
    path = machine_code.extension(ROOT)
    modules = machine_code.by_module(path)
    if modules is None:
        pytest.skip("the program nm is missing (Debian: apt install binutils)")
    assert 0.8 < modules.total() / machine_code.code_bytes(path) <= 1.0


@pytest.mark.parametrize("name", timing.CHANGED)
def test_a_changed_line_is_the_first_of_a_body(name: str) -> None:
    text = (ROOT / name).read_text(encoding="utf-8")
    before, line, _ = timing.changed(text).partition(f"    {timing.LINE}\n")
    assert line
    assert before.endswith("{\n")
    assert len(re.findall(r"\bfn ", before)) == 1


def test_stages_and_slow_tests_are_read() -> None:
    assert build_meter.stages("5 set-up\n70 cargo test\n") == [("set-up", 5), ("cargo test", 70)]
    log = """=== slowest durations ===
1.50s call     tests/a.py::test_a[one two]
2.00s call     tests/b.py::test_b
0.75s setup    tests/a.py::test_a[one two]
"""
    found = [("tests/a.py::test_a[one two]", 2.25), ("tests/b.py::test_b", 2.0)]
    assert build_meter.slowest(log) == found
