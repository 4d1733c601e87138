//! All analyses and options, as data: for the reader of files, the schema, Python and docs.

use super::dynamics;
use super::kinematics;
use super::linearization;
use super::options::{Declaration, Declared, Family, Member};
use std::sync::LazyLock;

// made once, because every simulation is checked with them
static ANALYSES: LazyLock<Vec<Declaration>> = LazyLock::new(|| {
    vec![
        dynamics::Options::declaration(),
        kinematics::Options::declaration(),
        kinematics::InverseOptions::declaration(),
        linearization::Options::declaration(),
    ]
});
static FAMILIES: LazyLock<Vec<Family>> =
    LazyLock::new(|| vec![dynamics::Scheme::family(), dynamics::Stabilization::family()]);

/// The analyses, by the `type` in the file.
pub fn declarations() -> &'static [Declaration] {
    &ANALYSES
}

/// The families of options that analyses refer to.
pub fn option_families() -> &'static [Family] {
    &FAMILIES
}
