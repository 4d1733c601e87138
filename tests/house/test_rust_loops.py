"""Files of one folder of the core import each other in one direction, except for listed loops."""

from house.places import DRAWING, ROOT
from house.rust_imports import Source, graph, loops, sources

FILES = sources()
FOLDERS = sorted({module[:end] for module in FILES for end in range(len(module))})

#: Folder → loops of its files with the reason for each. ARCHITECTURE.md contains the same list.
KNOWN: dict[str, list[tuple[set[str], str]]] = {
    "elements": [
        (
            {"derive", "joint_trait"},
            "Joint::linearize has a default, which derives Φ_q and γ from Joint::residual",
        ),
    ],
    "math": [
        (
            {"base", "dual", "lanes", "real", "sine"},
            "one polynomial over Real gives the sine of f64 and of Lanes, and Real has a sine; "
            "a scalar has a base, and so has Dual over it",
        ),
    ],
}


def test_the_folders_have_the_known_loops_only() -> None:
    found = {"/".join(folder): loops(graph(folder, FILES)) for folder in FOLDERS}
    known = {folder: [loop for loop, _ in own] for folder, own in KNOWN.items()}
    assert {folder: own for folder, own in found.items() if own} == known


def test_the_folders_of_the_drawing_have_no_loops() -> None:
    files = sources(DRAWING)
    folders = {module[:end] for module in files for end in range(len(module))}
    assert ("display",) in folders
    assert not [found for folder in folders if (found := loops(graph(folder, files)))]


def test_every_loop_has_a_folder_and_is_described() -> None:
    assert set(KNOWN) <= {"/".join(folder) for folder in FOLDERS}
    text = (ROOT / "ARCHITECTURE.md").read_text(encoding="utf-8")
    for folder, known in KNOWN.items():
        for loop, _ in known:
            absent = {name for name in loop if f"`{name}`" not in text}
            assert not absent, f"ARCHITECTURE.md does not name {absent} of {folder}"


def test_a_loop_is_found_through_a_re_export() -> None:
    texts = {
        ("a",): "mod b; mod c; pub use b::{B, inner::Deep}; pub use c::C;",
        ("a", "b"): "use super::C; pub struct B;",
        ("a", "c"): "fn f() -> crate::a::B { todo!() }",
        ("d",): "use crate::a::C;",
    }
    files = {module: Source(text, module) for module, text in texts.items()}
    assert loops(graph(("a",), files)) == [{"b", "c"}]
    assert loops(graph((), files)) == []
    files[("a", "b")] = Source("pub struct B; #[cfg(test)] mod tests { use super::C; }", ("a", "b"))
    assert loops(graph(("a",), files)) == []


def test_a_module_that_uses_its_child_is_part_of_a_loop() -> None:
    texts = {
        ("a",): "mod b; use b::f; pub const ONE: u8 = f();",
        ("a", "b"): "pub const fn f() -> u8 { super::ONE }",
    }
    files = {module: Source(text, module) for module, text in texts.items()}
    assert loops(graph(("a",), files)) == [{"b", "mod"}]
