//! Bodies that a joint with two rows connects to ground. Such a body has one degree of freedom. It is condensed to
//! this degree of freedom before all other unknowns are eliminated (`solve/condensed.rs`).

use super::constraints;
use super::inertia::Inertia;
use super::kinematics::Motions;
use crate::elements::BodyId;
use crate::math::{each, Listed, Motion, Real};
use crate::model::{ConstraintItem, Model, Slots, Weighed};
use crate::solve::{CondensedGroup, Saddle};

/// A moving body that a joint with two rows connects to ground.
#[derive(Clone, Copy, Debug)]
pub struct Grounded<S = f64> {
    /// Index of the joint among the constraints.
    pub constraint: usize,
    /// The body.
    pub body: BodyId,
    /// W of the body, in the frame of the body.
    mass: CondensedGroup<S>,
    /// For a pin, the inverse of the moment of inertia about the pin, 1/(kg·m²). It does not depend on the state.
    about_pin: Option<S>,
}

/// A joint with two rows that connects a body to ground.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hold {
    /// Index of the joint among the constraints.
    pub constraint: usize,
    /// Whether the joint is a pin.
    pub pin: bool,
}

/// The joints that connect bodies to ground, one for each body, ground first. If several joints connect a body to
/// ground, the first pin is chosen, otherwise the first joint. Point masses are excluded.
pub(super) fn holds<S: Real>(model: &Model<S>) -> Vec<Option<Hold>> {
    let mut holds: Vec<Option<Hold>> = vec![None; model.bodies.len()];
    for (k, (item, slots)) in model.constraints.iter().zip(&model.layout.constraints).enumerate() {
        let Some(body) = held(item, slots) else { continue };
        let pin = slots.blocks[0].sign != 0.0;
        let better = holds[body.0].is_none_or(|hold| pin && !hold.pin);
        if better && model.bodies[body.0].turns {
            holds[body.0] = Some(Hold { constraint: k, pin });
        }
    }
    holds
}

/// The bodies that joints connect to ground. `bodies` contains the inertia of each body.
pub(super) fn grounded<S: Real>(
    model: &Model<S>,
    holds: &[Option<Hold>],
    bodies: &[Weighed<S>],
) -> Vec<Grounded<S>> {
    let motions = Motions::at_rest(&model.layout, &vec![S::zero(); model.layout.n_q]);
    let held = holds.iter().zip(bodies).enumerate();
    let grounded = |(body, (hold, own)): (usize, (&Option<Hold>, &Weighed<S>))| {
        Some(Grounded::new((model, &motions), BodyId(body), hold.as_ref()?, own))
    };
    held.filter_map(grounded).list()
}

/// The body that a joint with two rows and constant fields connects to ground.
#[inline]
fn held<S>(item: &ConstraintItem<S>, slots: &Slots) -> Option<BodyId> {
    let to_ground = item.bodies.len() == 2 && item.bodies.iter().any(|body| body.is_ground());
    let fits = item.law.is_none() && item.element.condenses();
    match slots.blocks.as_slice() {
        [one] if to_ground && fits && slots.rows.len() == 2 => one.body,
        _ => None,
    }
}

impl<S: Real> Grounded<S> {
    /// The data of a grounded body, evaluated at rest at the origin.
    fn new(
        (model, motions): (&Model<S>, &Motions<S>),
        body: BodyId,
        &Hold { constraint, pin }: &Hold,
        own: &Weighed<S>,
    ) -> Self {
        let coupling = motions[body.0].pose.global(own.center).perp().scale(own.mass);
        let inertia = own.inertia + own.mass * own.center.dot(own.center);
        let mass = CondensedGroup::new(own.mass, [coupling.x, coupling.y], inertia);
        let about_pin = pin.then(|| {
            let mut rows = [[S::zero(); 3]; 2];
            constraints::columns_by_body(model, constraint, motions, S::zero(), body, &mut rows);
            let sign = model.layout.constraints[constraint].blocks[0].sign;
            S::one() / mass.about_pin(sign, each(rows, |row| row[2])).1
        });
        Self { constraint, body, mass, about_pin }
    }

    /// The ratio of the inertia along its freedom to that of its surroundings, from those of mass and moment of
    /// inertia. At a pin, either is sufficient.
    pub(super) fn ratio(&self, [mass, inertia]: [f64; 2]) -> f64 {
        if self.about_pin.is_some() {
            mass.max(inertia)
        } else {
            mass
        }
    }

    /// Writes the state-independent numbers into the matrix.
    pub(super) fn set(&self, k: usize, saddle: &mut Saddle<S>) {
        let mass = &mut saddle.masses[self.body.0 - 1];
        mass.translation = [S::zero(); 2];
        mass.held = S::one() / self.mass.mass;
        if let Some(inverse) = self.about_pin {
            mass.along = inverse;
        }
        saddle.condensed[k] = self.mass;
    }

    /// Updates W of the body for its current angle.
    #[inline(always)]
    pub(super) fn turn(
        &self,
        inertias: &[Inertia<S>],
        motions: &[Motion<S>],
        group: &mut CondensedGroup<S>,
    ) {
        let inertia = &inertias[self.body.0 - 1];
        if inertia.coupled {
            let arm = motions[self.body.0].pose.global(inertia.center);
            let b = arm.perp().scale(inertia.mass);
            group.moment = [b.x, b.y];
        }
    }
}
