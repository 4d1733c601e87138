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
pub(super) struct RigidContacts(Vec<usize>);

impl RigidContacts {
    pub fn of(model: &Model) -> Self {
        let open = |k: &usize| model.forces[*k].mode == Mode::Open && is_rigid(model, *k);
        Self((0..model.forces.len()).filter(open).list())
    }

    /// The first one beyond which a position is, with its gap. It is beyond if the gap is below `-depth`, relative to
    /// the size of the mechanism or in rad.
    fn deeper(&self, model: &Model, t: f64, q: &[f64], depth: f64) -> Option<(usize, f64)> {
        if self.0.is_empty() {
            return None;
        }
        let (motions, z) = (Motions::at_rest(&model.layout, q), vec![0.0; model.layout.n_z]);
        let acting = Acting { z: &z, lam: None, t };
        let gap = |k: &usize| (*k, forces::threshold(model, *k, &motions, acting));
        let size = size(model);
        self.0.iter().map(gap).find(|(k, gap)| *gap < -depth * unit(model, size, *k))
    }

    /// The first one beyond which a position is: its name and its gap.
    pub fn beyond(&self, model: &Model, t: f64, q: &[f64]) -> Option<(String, f64)> {
        let (k, gap) = self.deeper(model, t, q, TOUCHING)?;
        Some((model.forces[k].name.clone(), gap))
    }

    /// Whether a position is within all of them.
    pub fn allow(&self, model: &Model, t: f64, q: &[f64]) -> bool {
        self.deeper(model, t, q, 0.0).is_none()
    }

    /// Those that a position touches or is beyond.
    pub fn touched(&self, model: &Model, t: f64, q: &[f64]) -> Self {
        let closed = |k: &usize| Self(vec![*k]).deeper(model, t, q, -TOUCHING).is_some();
        Self(self.0.iter().copied().filter(closed).list())
    }

    /// The gap of one of them at a position, beyond which it [is](Self::beyond) below zero.
    pub fn margin(&self, model: &Model, (t, q): (f64, &[f64]), index: usize) -> f64 {
        let (motions, z) = (Motions::at_rest(&model.layout, q), vec![0.0; model.layout.n_z]);
        let acting = Acting { z: &z, lam: None, t };
        forces::threshold(model, self.0[index], &motions, acting) + self.slack(model, index)
    }

    /// The depth up to which one of them counts as touching.
    pub fn slack(&self, model: &Model, index: usize) -> f64 {
        TOUCHING * unit(model, size(model), self.0[index])
    }

    /// The indices of the forces.
    pub fn forces(&self) -> &[usize] {
        &self.0
    }
}
