//! Data derived from a model: all that evaluations need and no state changes.
//!
//! A [`Model`] holds no caches. [`Compiled`] is built from it once, and shared by everything that evaluates the same
//! model over the same scalar.

use super::added_inertia;
use super::inertia::{inertias, Inertia};
use super::pairs::{grounded, pairs, runs, Grounded, Pair};
use crate::math::Real;
use crate::model::Model;
use std::ops::Range;

/// Data derived from a [`Model`]; immutable.
#[derive(Clone, Debug)]
pub struct Compiled<S = f64> {
    /// Inertia of the moving bodies, without ground.
    pub inertias: Vec<Inertia<S>>,
    /// Moments of inertia that are added to bodies without their own while the equations are solved, and are taken
    /// back by `refine`, kg·m²; one for each moving body, zero for most.
    pub added_inertia: Vec<S>,
    /// The joints of two rows whose fields are constant.
    pub pairs: Vec<Pair<S>>,
    /// Moving bodies that one of these joints holds to ground.
    pub grounded: Vec<Grounded<S>>,
    /// Ranges of these whose joints have one type.
    pub(super) grounded_runs: Vec<Range<usize>>,
}

impl<S: Real> Compiled<S> {
    /// Of a model.
    pub fn new(model: &Model<S>) -> Self {
        let added_inertia = added_inertia::added(&model.bodies, &model.constraints);
        let pairs = pairs(model);
        let grounded = grounded(model, &pairs, &added_inertia);
        let kind = |grounded: &Grounded<S>| pairs[grounded.pair as usize].element.kind();
        Self {
            inertias: inertias(&model.blueprint.bodies, &model.bodies, &added_inertia),
            grounded_runs: runs(&grounded, kind),
            grounded,
            added_inertia: added_inertia[1..].to_vec(),
            pairs,
        }
    }

    /// Whether a body has an inertia that is not its own.
    pub fn has_added_inertia(&self) -> bool {
        self.added_inertia.iter().any(|added| added.least_magnitude() > 0.0)
    }
}
