//! Stops and contacts with restitution outside of runs, where nothing decides whether they hit, rest or release.
//!
//! They are limits of driven motions, as dead points are. Positions beyond them are refused, and so are accelerations
//! of a state that presses or moves into them.

use crate::elements::{Behaviour, Mode, QuantityKind};
use crate::equations::forces::{self, Acting};
use crate::equations::kinematics::Motions;
use crate::math::{Listed, Real};
use crate::model::{size, Model};

/// Largest depth beyond a stop or contact that counts as touching, relative to the size of the mechanism or in rad.
pub(super) const TOUCHING: f64 = 1e-9;

/// Whether a force is a stop or contact with restitution.
pub fn is_rigid(model: &Model, force: usize) -> bool {
    matches!(model.forces[force].element.behaviour(), Some(Behaviour::Impacts { .. }))
}

/// The size of the mechanism for a gap or a way of friction that is a length, 1 rad for one that is an angle.
pub fn unit<S: Real>(model: &Model<S>, size: f64, force: usize) -> f64 {
    let element = &model.forces[force].element;
    let effort = element.result_quantities().first();
    let kind = match element.measured().first() {
        Some(measured) => Some(measured.kind),
        None => effort.and_then(|of| QuantityKind::of_effort(of.unit)),
    };
    kind.unwrap_or_default().scale(size)
}

/// The stops and contacts with restitution of a model, without those for which a run has decided.
#[derive(Clone, Debug, Default)]
pub(super) struct RigidContacts {
    forces: Vec<usize>,
    /// The depth up to which each of them counts as touching.
    slack: Vec<f64>,
}

impl RigidContacts {
    pub fn of(model: &Model) -> Self {
        let open = |k: &usize| model.forces[*k].mode == Mode::Open && is_rigid(model, *k);
        let forces = (0..model.forces.len()).filter(open).list();
        let size = if forces.is_empty() { 0.0 } else { size(model) };
        let slack = forces.iter().map(|k| TOUCHING * unit(model, size, *k)).list();
        Self { forces, slack }
    }

    /// The gaps at a position.
    fn gaps(&self, model: &Model, t: f64, q: &[f64], of: &[usize]) -> Vec<f64> {
        if of.is_empty() {
            return Vec::new();
        }
        let (motions, z) = (Motions::at_rest(&model.layout, q), vec![0.0; model.layout.n_z]);
        let acting = Acting { z: &z, lam: None, t };
        of.iter().map(|k| forces::threshold(model, *k, &motions, acting)).list()
    }

    /// The first one beyond which a position is: its name and its gap.
    pub fn beyond(&self, model: &Model, t: f64, q: &[f64]) -> Option<(String, f64)> {
        let gaps = self.gaps(model, t, q, &self.forces);
        let at = gaps.iter().zip(&self.slack).position(|(gap, slack)| *gap < -slack)?;
        Some((model.forces[self.forces[at]].name.clone(), gaps[at]))
    }

    /// Whether a position is within all of them.
    pub fn allow(&self, model: &Model, t: f64, q: &[f64]) -> bool {
        !self.gaps(model, t, q, &self.forces).iter().any(|gap| *gap < 0.0)
    }

    /// Those that a position touches or is beyond.
    pub fn touched(&self, model: &Model, t: f64, q: &[f64]) -> Self {
        let gaps = self.gaps(model, t, q, &self.forces);
        let all = self.forces.iter().zip(&self.slack).zip(gaps);
        let closed =
            all.filter(|((_, slack), gap)| gap < slack).map(|((k, slack), _)| (*k, *slack));
        let (forces, slack) = closed.unzip();
        Self { forces, slack }
    }

    /// The gaps of `some` at a position, beyond which it [is](Self::beyond) below zero.
    pub fn margins(&self, model: &Model, (t, q): (f64, &[f64]), some: &[usize]) -> Vec<f64> {
        let forces = some.iter().map(|at| self.forces[*at]).list();
        let gaps = self.gaps(model, t, q, &forces);
        some.iter().zip(gaps).map(|(at, gap)| gap + self.slack[*at]).list()
    }

    /// The depth up to which one of them counts as touching.
    pub fn slack(&self, index: usize) -> f64 {
        self.slack[index]
    }

    /// The indices of the forces.
    pub fn forces(&self) -> &[usize] {
        &self.forces
    }
}
