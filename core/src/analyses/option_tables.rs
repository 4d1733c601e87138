//! All analyses and options, as data: for the reader of files, the schema, Python and docs.

use super::configurations;
use super::diagnosis;
use super::dynamics;
use super::equilibrium;
use super::kinematics;
use super::limits;
use super::linearization;
use super::options::{Declaration, Declared, Family, Member};
use std::sync::LazyLock;

// created once, because every simulation is checked with them
static ANALYSES: LazyLock<Vec<Declaration>> = LazyLock::new(|| {
    vec![
        dynamics::Options::declaration(),
        kinematics::Options::declaration(),
        kinematics::InverseOptions::declaration(),
        equilibrium::Options::declaration(),
        linearization::Options::declaration(),
        limits::Options::declaration(),
        diagnosis::Options::declaration(),
        configurations::Options::declaration(),
    ]
});
static FAMILIES: LazyLock<Vec<Family>> =
    LazyLock::new(|| vec![dynamics::Scheme::family(), dynamics::Stabilization::family()]);

/// The analyses, by the `type` in the file.
pub fn declarations() -> &'static [Declaration] {
    &ANALYSES
}

/// The families of options that the analyses use.
pub fn option_families() -> &'static [Family] {
    &FAMILIES
}
