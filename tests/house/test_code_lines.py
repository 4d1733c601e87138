"""The script that counts lines of code leaves out comments, blank lines and unit tests."""

import importlib.util

from house.places import ROOT

_SPEC = importlib.util.spec_from_file_location("code_lines", ROOT / "tools" / "code_lines.py")
assert _SPEC
assert _SPEC.loader
SCRIPT = importlib.util.module_from_spec(_SPEC)
_SPEC.loader.exec_module(SCRIPT)

TEXT = """//! A module.

/// A function.
fn f() -> &'static str {
    // a comment
    let x = "// not a comment"; // a comment
    x
}

#[cfg(test)]
mod tests {
    #[test]
    fn g() {}
}
"""


def test_comments_blank_lines_and_unit_tests_do_not_count() -> None:
    assert SCRIPT.code_lines(TEXT) == 4


def test_folders_of_analyses_are_modules() -> None:
    names = ["core/src/lib.rs", "core/src/analyses/a.rs", "core/src/analyses/b/c.rs"]
    counted = SCRIPT.counted(dict.fromkeys(names, TEXT))
    assert counted == {"lib.rs": 4, "analyses": 4, "analyses/b": 4}
