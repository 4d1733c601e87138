//! Data derived from a model: all that evaluations need and no state changes.
//!
//! A [`Model`] holds no caches. [`Compiled`] is built from it once, and shared by everything that evaluates the same
//! model over the same scalar.

use super::added_inertia;
use super::anchor::{anchors, Anchor};
use super::inertia::{inertias, Inertia};
use super::pin::{pins, Pin};
use crate::elements::{ForcePools, JointPools, Place};
use crate::math::Real;
use crate::model::Model;

/// Data derived from a [`Model`]; immutable.
#[derive(Clone, Debug)]
pub struct Compiled<S = f64> {
    /// Inertia of the moving bodies, without ground.
    pub inertias: Vec<Inertia<S>>,
    /// Moments of inertia that are added to bodies without their own while the equations are solved, and are taken
    /// back by `refine`, kg·m²; one for each moving body, zero for most.
    pub added_inertia: Vec<S>,
    /// The joints that only pin two points.
    pub pins: Vec<Pin<S>>,
    /// Moving bodies that one of them holds to ground.
    pub anchors: Vec<Anchor<S>>,
    /// Joints and drivers with constant fields, by type.
    pub joints: JointPools<S>,
    /// The places of the joints and drivers with laws of time or state.
    pub joints_with_laws: Vec<usize>,
    /// Forces with constant fields, by type.
    pub forces: ForcePools<S>,
    /// The places of the forces with laws of time or state.
    pub forces_with_laws: Vec<usize>,
}

impl<S: Real> Compiled<S> {
    /// Of a model.
    pub fn new(model: &Model<S>) -> Self {
        let added_inertia = added_inertia::added(&model.bodies, &model.constraints);
        let pins = pins(&model.constraints, &model.layout);
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
        Self {
            joints,
            joints_with_laws,
            forces,
            forces_with_laws,
            inertias: inertias(&model.blueprint.bodies, &model.bodies, &added_inertia),
            anchors: anchors(&pins, &model.bodies, &added_inertia),
            added_inertia: added_inertia[1..].to_vec(),
            pins,
        }
    }

    /// Whether a body has an inertia that is not its own.
    pub fn has_added_inertia(&self) -> bool {
        self.added_inertia.iter().any(|added| added.least_magnitude() > 0.0)
    }
}
