//! Whether the reactions of joints and drivers are unique at a position.
//!
//! M a + Φ_qᵀ λ = Q determines λ only up to the left null vectors y of Φ_q, yᵀ Φ_q = 0. A joint whose rows take part
//! in a null vector has no unique reaction: its values belong to the λ of least norm.

use super::dependence;
use super::mobility::{beyond_doubt, Mobility};
use super::second_order::mobility;
use crate::math::Listed;
use crate::model::Model;
use crate::solve::RANK_TOLERANCE;

/// The constraints (indices) without a unique reaction at and near a position, ascending. At a singular position, the
/// reactions of the motion through it are used.
pub fn not_unique(model: &Model, t: f64, q: &[f64]) -> Vec<usize> {
    if beyond_doubt(model, t, q) {
        return Vec::new();
    }
    let mut found = dependence::at(model, t, q, RANK_TOLERANCE, &|| false);
    if !found.is_empty() {
        let Mobility { redundant_equations, second_order, .. } = mobility(model, t, q);
        found = [redundant_equations, second_order].concat();
    }
    let mut all: Vec<usize> = found.into_iter().flat_map(|dependent| dependent.group).list();
    all.sort_unstable();
    all.dedup();
    all
}
