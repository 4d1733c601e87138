"""The modules of the core depend on each other in one direction only."""

from pathlib import Path

import pytest
from house.places import CORE, DRAWING, ROOT
from house.rust_source import modules_named

LAYERS = [
    "math",
    "expression",
    "symbolic",
    "elements",
    "model",
    "equations",
    "stabilize",
    "analyses",
    "case",
]

#: Module → modules that it may use. Numerical methods are independent of mechanics.
MAY_USE = {name: set(LAYERS[: at + 1]) for at, name in enumerate(LAYERS)}
MAY_USE |= {"solve": {"math", "solve"}, "integrate": {"math", "integrate"}}
for _mechanics in ("equations", "stabilize", "analyses", "case"):
    MAY_USE[_mechanics] |= {"solve"}
for _driver in ("analyses", "case"):
    MAY_USE[_driver] |= {"integrate"}


def module_of(path: Path) -> tuple[str, ...]:
    parts = path.relative_to(CORE).with_suffix("").parts
    return parts[:-1] if parts[-1] == "mod" else parts


def wrong_arrows(module: tuple[str, ...], text: str) -> set[str]:
    return modules_named(text, module) - MAY_USE[module[0]]


def test_the_files_of_the_core_use_only_lower_modules() -> None:
    files = [path for path in sorted(CORE.rglob("*.rs")) if path.name != "lib.rs"]
    modules = {module_of(path)[0] for path in files}
    assert modules <= set(MAY_USE), "a new module of the core needs its place in MAY_USE"
    assert not {
        str(path): wrong
        for path in files
        if (wrong := wrong_arrows(module_of(path), path.read_text(encoding="utf-8")))
    }


def test_a_scene_does_not_depend_on_its_display_list_nor_the_core_on_drawings() -> None:
    scene = {"plane", "numbers", "scene"}
    may_use = {"plane": {"plane"}, "numbers": {"numbers"}, "scene": scene}
    may_use["display"] = {*scene, "display"}
    for path in sorted(DRAWING.rglob("*.rs")):
        parts = path.relative_to(DRAWING).with_suffix("").parts
        if parts != ("lib",):
            module = parts[:-1] if parts[-1] == "mod" else parts
            named = modules_named(path.read_text(encoding="utf-8"), module)
            assert named <= may_use[module[0]], path
    assert "drawing" not in (ROOT / "core" / "Cargo.toml").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("module", "text", "wrong"),
    [
        (("math", "dual"), "use super::real::Real;", set()),
        (("math", "dual"), "use super::super::model::Model;", {"model"}),
        (("math",), "mod tests { use super::*; use super::real::Real; }", set()),
        (("math",), "mod tests { use super::super::case::read; }", {"case"}),
        (("solve", "ldlt"), "use crate::{math::{Real, Dual}, model::Model};", {"model"}),
        (
            ("integrate", "rk45"),
            "use crate::math::Real; fn f() { crate::solve::newton(); }",
            {"solve"},
        ),
        (
            ("integrate", "rk45"),
            '// crate::case\nlet s = "crate::model"; /* crate::model */',
            set(),
        ),
        (("elements", "joints"), "crate::element! { x }", set()),
        (
            ("model",),
            "pub use self::layout::Layout; pub use crate::equations::mass;",
            {"equations"},
        ),
        (("equations", "mass"), "use crate::Model;", {"Model"}),
        (("case", "read"), "use crate::model::Model; use crate::solve::Ldlt;", set()),
    ],
)
def test_a_wrong_dependency_is_found(module: tuple[str, ...], text: str, wrong: set[str]) -> None:
    assert wrong_arrows(module, text) == wrong
