//! Whether the reactions of joints and drivers are unique at a position.
//!
//! M a + Φ_qᵀ λ = Q determines λ only up to the left null vectors y of Φ_q, yᵀ Φ_q = 0. A joint whose rows take part
//! in a null vector has no unique reaction: its values belong to the λ of least norm.

use super::dependence::{self, Dependent};
use super::mobility::{beyond_doubt, Mobility};
use super::second_order::mobility;
use crate::math::Listed;
use crate::model::Model;
use crate::solve::RANK_TOLERANCE;
use std::collections::BTreeSet;

/// The constraints (indices) without a unique reaction, ascending.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NotUnique {
    /// Redundant equations share their loads.
    pub redundant: Vec<usize>,
    /// Equations of second order keep a coordinate. Their reactions do not contain the effort along it, which ideal
    /// joints could apply with infinite forces only.
    pub second_order: Vec<usize>,
}

impl NotUnique {
    /// All of them, ascending.
    pub fn all(&self) -> Vec<usize> {
        ascending(self.redundant.iter().chain(&self.second_order).copied())
    }
}

/// The constraints without a unique reaction at and near a position. At a singular position, the reactions of the
/// motion through it are used.
pub fn not_unique(model: &Model, t: f64, q: &[f64]) -> NotUnique {
    if beyond_doubt(model, t, q)
        || dependence::at(model, t, q, RANK_TOLERANCE, &|| false).is_empty()
    {
        return NotUnique::default();
    }
    let Mobility { redundant_equations, second_order, .. } = mobility(model, t, q);
    let of = |found: Vec<Dependent>| ascending(found.into_iter().flat_map(|one| one.group));
    NotUnique { redundant: of(redundant_equations), second_order: of(second_order) }
}

fn ascending(constraints: impl Iterator<Item = usize>) -> Vec<usize> {
    let found: BTreeSet<usize> = constraints.collect();
    found.into_iter().list()
}
