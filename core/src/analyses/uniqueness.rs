//! Whether the reactions of joints and drivers are unique at a position.
//!
//! M a + Φ_qᵀ λ = Q determines λ only up to the left null vectors y of Φ_q, yᵀ Φ_q = 0. A joint whose rows take part
//! in a null vector has no unique reaction: its values belong to the λ of least norm.

use super::dependence::{self, Dependent};
use super::mobility::{beyond_doubt, dependent_equations, Mobility};
use super::second_order::mobility;
use crate::elements::{Behaviour, Mode};
use crate::math::Listed;
use crate::model::{ForceMode, Model};
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

/// The names of forces, joints and drivers whose loads are not unique because contacts and friction at rest share them.
/// `open` is the model without modes; friction that drivers hold is left out, see
/// [`friction_range`](super::friction_range()).
pub fn shared(open: &Model, modes: &[ForceMode], t: f64, q: &[f64]) -> Vec<String> {
    let shares = |of: &ForceMode| of.mode.holds() && !matches!(of.mode, Mode::Holds(_));
    if !modes.iter().any(shares) {
        return Vec::new();
    }
    let holds = modes.iter().filter(|of| of.mode.holds());
    // both limits of a stop have the same derivatives
    let side = |mode| if matches!(mode, Mode::Holds(_)) { mode } else { Mode::Holds(1.0) };
    let held = holds.map(|of| ForceMode { mode: side(of.mode), ..*of }).list();
    let phase = open.in_modes(&held);
    let first = phase.constraints.len() - held.len();
    let sticks = |k: &usize| {
        let element = &open.forces[held[*k - first].force].element;
        matches!(element.behaviour(), Some(Behaviour::Sticks))
    };
    let driven = |group: &[usize]| match group.iter().filter(|k| **k >= first).list()[..] {
        [] => true,
        [only] => sticks(only),
        _ => false,
    };
    let found = dependent_equations(&phase, t, q, &|| false);
    let groups = found.into_iter().map(|one| one.group).filter(|group| !driven(group));
    let all = ascending(groups.flatten());
    let takes_part =
        |force: usize| all.iter().any(|k| *k >= first && held[*k - first].force == force);
    let mut names: Vec<String> = Vec::new();
    for (k, item) in open.listed_forces().iter().enumerate() {
        if open.whole(k).any(takes_part) {
            names.push(item.name.clone());
        }
    }
    let joints = all.iter().filter(|k| **k < first);
    names.extend(joints.map(|k| phase.constraints[*k].name.clone()));
    names
}

fn ascending(constraints: impl Iterator<Item = usize>) -> Vec<usize> {
    let found: BTreeSet<usize> = constraints.collect();
    found.into_iter().list()
}
