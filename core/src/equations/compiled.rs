//! Data derived from a model: all state-independent data that evaluations need.
//!
//! A [`Model`] contains no caches. [`Compiled`] is built from it once, and shared by all evaluations of the model
//! over the same scalar.

use super::added_mass::{self, Added};
use super::grounded::{grounded, holds, Grounded};
use super::lending::{lend, Lent};
use crate::elements::{ForcePools, JointPools, Place};
use crate::math::{Real, Vec2};
use crate::model::Model;
use std::sync::Arc;

/// Data derived from a [`Model`]; immutable.
#[derive(Clone, Debug)]
pub struct Compiled<S = f64> {
    /// Inertia of the bodies in the matrix, without and with condensed bodies.
    lent: [Arc<Lent<S>>; 2],
    /// The moving bodies whose mass centre is not the origin of the frame, counted without ground.
    pub off_center: Vec<usize>,
    /// Weight of the bodies as generalized force, shape (n_q).
    pub weight: Vec<S>,
    /// Mass and inertia that must be lent or added to light bodies. One entry for each moving body; most are zero.
    pub added: Vec<Added>,
    /// Mass added to the internal coordinates of elements, kg.
    pub own_mass: f64,
    /// Moving bodies that a joint with two rows connects to ground.
    pub grounded: Vec<Grounded<S>>,
    /// Joints and drivers with constant fields, by type.
    pub joints: JointPools<S>,
    /// Indices of the joints and drivers with laws of time or state.
    pub joints_with_laws: Vec<usize>,
    /// Forces with constant fields, by type.
    pub forces: ForcePools<S>,
    /// Indices of the forces with laws of time or state.
    pub forces_with_laws: Vec<usize>,
}

impl<S: Real> Compiled<S> {
    /// Derives the data from a model.
    pub fn new(model: &Model<S>) -> Self {
        let added = added_mass::added(model);
        let (mut joints, mut forces) = (JointPools::default(), ForcePools::default());
        let (mut joints_with_laws, mut forces_with_laws) = (Vec::new(), Vec::new());
        for (k, item) in model.constraints.iter().enumerate() {
            let row = model.layout.constraints[k].rows.start;
            match item.law {
                None => joints.push(&item.element, Place::new(k, &item.bodies, row)),
                Some(_) => joints_with_laws.push(k),
            }
        }
        for (k, item) in model.forces.iter().enumerate() {
            match item.law {
                None => forces.push(&item.element, Place::new(k, &item.bodies, 0)),
                Some(_) => forces_with_laws.push(k),
            }
        }
        let (holds, free) = (holds(model), vec![None; model.bodies.len()]);
        let lent = [&free, &holds].map(|holds| Arc::new(lend(model, &added, holds)));
        let grounded = grounded(model, &holds, &lent[1].bodies);
        let formulas = model.blueprint.bodies.iter().skip(1).enumerate();
        let off_center = formulas.filter(|(_, body)| !body.is_centred()).map(|(k, _)| k).collect();
        Self {
            lent,
            off_center,
            weight: weight(model),
            joints,
            joints_with_laws,
            forces,
            forces_with_laws,
            grounded,
            own_mass: added_mass::own_mass(&model.bodies),
            added: added[1..].to_vec(),
        }
    }

    /// Inertia of the bodies in the matrix, for a plan with or without condensed bodies.
    #[inline(always)]
    pub(super) fn lent(&self, condenses: bool) -> &Arc<Lent<S>> {
        &self.lent[usize::from(condenses)]
    }

    /// The numbers of loans and additions, for condensed grounded bodies.
    #[inline]
    pub fn lent_and_added(&self) -> [usize; 2] {
        let Lent { loans, additions, .. } = &*self.lent[1];
        [loans.len(), additions.len()]
    }

    /// The largest 1/m of the moving bodies including additions, 1/kg.
    #[inline]
    pub fn compliance(&self) -> S {
        self.lent[0].inertias.iter().map(|inertia| inertia.inverse[0]).fold(S::zero(), S::max)
    }
}

/// Weight of the bodies as generalized force, shape (n_q).
fn weight<S: Real>(model: &Model<S>) -> Vec<S> {
    let mut weight = vec![S::zero(); model.layout.n_q];
    for (body, columns) in model.bodies.iter().zip(&model.layout.bodies).skip(1) {
        let Vec2 { x, y } = model.gravity.scale(body.mass);
        columns.add([x, y, S::zero()], &mut weight);
    }
    weight
}
