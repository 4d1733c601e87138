//! Data derived from a model: all state-independent data that evaluations need.
//!
//! A [`Model`] contains no caches. [`Compiled`] is built from it once, and shared by all evaluations of the model
//! over the same scalar.

use super::grounded::{grounded, holds, Grounded};
use super::inertia::Inertia;
use super::light::Light;
use crate::elements::{ForcePools, JointPools, Place};
use crate::math::{Listed, Real, Vec2};
use crate::model::Model;
use std::sync::Arc;

/// Data derived from a [`Model`]; immutable.
#[derive(Clone, Debug)]
pub struct Compiled<S = f64> {
    /// Inertia of the bodies in the matrix, and the light ones.
    pub light: Arc<Light<S>>,
    /// The moving bodies whose mass centre is not the origin of the frame, counted without ground.
    pub off_center: Vec<usize>,
    /// Weight of the bodies as generalized force, shape (n_q).
    pub weight: Vec<S>,
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
        let light = Arc::new(Light::new(model));
        let grounded = grounded(model, &holds(model), &light.bodies);
        let formulas = model.blueprint.bodies.iter().skip(1).enumerate();
        let off_center = formulas.filter(|(_, body)| !body.is_centred()).map(|(k, _)| k).list();
        Self {
            light,
            off_center,
            weight: weight(model),
            joints,
            joints_with_laws,
            forces,
            forces_with_laws,
            grounded,
        }
    }

    /// The largest 1/m of the moving bodies, 1/kg. Light bodies count with the mass of their surroundings.
    #[inline]
    pub fn compliance(&self) -> S {
        let Light { inertias, ratios, .. } = &*self.light;
        let bodies = inertias.iter().zip(ratios);
        let of_body =
            |(own, [mass, _]): (&Inertia<S>, &[f64; 2])| own.inverse[0] * S::constant(*mass);
        bodies.map(of_body).fold(S::zero(), S::max)
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
