//! Data derived from a model: everything that evaluations need and that does not depend on the state.
//!
//! A [`Model`] holds no caches. [`Compiled`] is built from it once, and shared by everything that evaluates the same
//! model over the same scalar.

use super::added_mass::{self, Added};
use super::grounded::{grounded, holds, Grounded};
use super::inertia::{self, inertias, Inertia};
use super::lending::lend;
use super::loans::Loan;
use crate::elements::{ForcePools, JointPools, Place};
use crate::math::{Real, Vec2};
use crate::model::{Body, Model, Weighed};

/// Loans between bodies, and the inertia of the moving bodies with them.
#[derive(Clone, Debug)]
pub(super) struct Lent<S> {
    pub loans: Vec<Loan>,
    pub inertias: Vec<Inertia<S>>,
}

/// Data derived from a [`Model`]; immutable.
#[derive(Clone, Debug)]
pub struct Compiled<S = f64> {
    /// Inertia of the moving bodies, without ground.
    pub inertias: Vec<Inertia<S>>,
    /// The inertia that light bodies borrow for condensed elimination; None if no body is light, or if loans are not
    /// enough.
    pub(super) lent: Option<Lent<S>>,
    /// The moving bodies whose mass centre is off the frame's origin, as places in `inertias`.
    pub off_center: Vec<usize>,
    /// Weight of the bodies as generalized force, shape (n_q).
    pub weight: Vec<S>,
    /// Mass and inertia that are added to light bodies while the equations are solved; `refine` takes them back. One for
    /// each moving body, zero for most.
    pub added: Vec<Added>,
    /// Mass that is added to the internal coordinates of elements in the same way, kg.
    pub own_mass: f64,
    /// Whether anything is added where nothing is lent.
    pub adds_mass: bool,
    /// Moving bodies that a joint of two rows holds to ground.
    pub grounded: Vec<Grounded<S>>,
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
        let inertias = inertias(&model.blueprint.bodies, &model.bodies, &added);
        let own_coordinates = model.layout.owners.len() >= model.bodies.len();
        let adds_mass = own_coordinates || added.iter().any(Added::any);
        let mut holds = holds(model);
        let lent = if adds_mass && !own_coordinates {
            lend((model, weighed(&model.bodies)), &added, &holds)
        } else {
            None
        };
        if lent.is_none() {
            let light = holds.iter_mut().zip(&added).filter(|(_, added)| added.any());
            light.for_each(|(hold, _)| *hold = None);
        }
        let grounded = match &lent {
            Some((_, bodies)) => grounded(model, &holds, bodies),
            None => grounded(model, &holds, &weighed(&model.bodies)),
        };
        let of_bodies = |(loans, bodies): (Vec<Loan>, Vec<Weighed<S>>)| Lent {
            loans,
            inertias: inertia::lent(&model.bodies, &bodies),
        };
        let off_center = (0..inertias.len()).filter(|k| inertias[*k].coupled).collect();
        Self {
            off_center,
            weight: weight(model),
            joints,
            joints_with_laws,
            forces,
            forces_with_laws,
            inertias,
            grounded,
            lent: lent.map(of_bodies),
            own_mass: added_mass::own_mass(&model.bodies),
            adds_mass,
            added: added[1..].to_vec(),
        }
    }

    /// Inertia of the moving bodies in the matrix of a plan that condenses bodies or not, without ground.
    #[inline(always)]
    pub(super) fn inertias_in(&self, condenses: bool) -> &[Inertia<S>] {
        match &self.lent {
            Some(lent) if condenses => &lent.inertias,
            _ => &self.inertias,
        }
    }

    /// The largest 1/m of the moving bodies, additions included, 1/kg.
    pub fn compliance(&self) -> S {
        self.inertias.iter().map(|inertia| inertia.inverse[0]).fold(S::zero(), S::max)
    }
}

/// Inertia of all bodies, ground first.
fn weighed<S: Real>(bodies: &[Body<S>]) -> Vec<Weighed<S>> {
    let of = |body: &Body<S>| {
        let Body { mass, center, inertia, .. } = *body;
        Weighed { mass, center, inertia }
    };
    bodies.iter().map(of).collect()
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
