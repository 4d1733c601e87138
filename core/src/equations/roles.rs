//! The joints and drivers of a model, by type and by their role in an elimination.
//!
//! A joint that connects a condensed body to ground is condensed with the body. A pin between bodies has rows [±I b]
//! (Haug 3.3.12), of which only b depends on the state; its part of the matrix is computed in the same loop as its
//! rows. Every other joint writes its rows into the entries of Φ_q. Each type has one loop for each role. All numbers
//! come from the function `linearize` of the element.

use super::constraints::{self, ByBlock, Stabilized, Terms};
use super::inertia::Inertia;
use super::kinematics::Motions;
use super::plan::Plan;
use super::Compiled;
use crate::elements::{BodyId, Joint, JointPools, Linearized, Moving, Place, Pooled, VisitJoints};
use crate::math::{each, Real};
use crate::model::Model;
use crate::solve::{PinEnd, PinRows, PinSum, Saddle};
use std::cell::Cell;

/// Joints and drivers by role.
#[derive(Clone, Debug)]
pub(super) struct Roles<S> {
    /// Joints that connect condensed bodies to ground.
    condensing: JointPools<S>,
    /// Pins between bodies.
    pins: JointPools<S>,
    /// All other joints and drivers with constant fields.
    others: JointPools<S>,
    /// Indices of the joints and drivers with laws.
    laws: Vec<usize>,
}

impl<S: Real> Roles<S> {
    /// The roles for a model and its plan of elimination.
    pub fn new(model: &Model<S>, compiled: &Compiled<S>, plan: &Plan) -> Self {
        let mut roles = Self {
            condensing: JointPools::default(),
            pins: JointPools::default(),
            others: JointPools::default(),
            laws: compiled.joints_with_laws.clone(),
        };
        let place = |k: usize, slot: usize| {
            let item = &model.constraints[k];
            Place::new(k, &item.bodies, model.layout.constraints[k].rows.start).with_slot(slot)
        };
        let mut others = vec![true; model.constraints.len()];
        compiled.joints_with_laws.iter().for_each(|k| others[*k] = false);
        for (slot, k) in plan.condensed.iter().enumerate() {
            roles.condensing.push(&model.constraints[*k].element, place(*k, slot));
            others[*k] = false;
        }
        for (slot, k) in plan.pins.iter().enumerate() {
            roles.pins.push(&model.constraints[*k].element, place(*k, slot));
            others[*k] = false;
        }
        for k in (0..others.len()).filter(|k| others[*k]) {
            roles.others.push(&model.constraints[k].element, place(k, 0));
        }
        roles
    }
}

/// The state of an evaluation.
#[derive(Clone, Copy)]
pub(super) struct At<'a, S> {
    pub model: &'a Model<S>,
    pub compiled: &'a Compiled<S>,
    pub plan: &'a Plan,
    /// The inertias that belong to the plan.
    pub inertias: &'a [Inertia<S>],
    pub motions: &'a Motions<S>,
    pub t: S,
    pub stabilized: Stabilized<S>,
    /// A vector that is subtracted from γ̂, shape (n_rows), or empty.
    pub offset: &'a [S],
    /// Where γ̂ of pins and condensed joints is kept, shape (n_rows), or empty.
    pub kept: &'a [Cell<S>],
}

/// Φ, Φ̇ and γ of two rows, and their columns for bodies i and j.
type TwoRows<S> = ([[S; 2]; 3], [[S; 3]; 4]);

impl<S: Real> At<'_, S> {
    /// Evaluates the rows of a joint with two rows between two bodies.
    #[inline(always)]
    fn two_rows<E: Joint>(&self, element: &E::Over<S>, bodies: [u32; 2]) -> TwoRows<S> {
        let bodies = each(bodies, |body| self.motions[body as usize]);
        let at = Moving { bodies: &bodies, own: &[], own_rates: &[], t: self.t };
        let [mut residual, mut rate, mut gamma] = [[S::zero(); 2]; 3];
        let mut columns = [[S::zero(); 3]; 4];
        let out = Linearized {
            residual: &mut residual,
            rate: &mut rate,
            gamma: &mut gamma,
            columns: &mut columns,
        };
        E::linearize(element, &at, out);
        ([residual, rate, gamma], columns)
    }

    /// Computes γ̂ of two rows.
    #[inline(always)]
    fn gamma(&self, [residual, rate, gamma]: &[[S; 2]; 3], row: u32) -> [S; 2] {
        let mut right = [S::zero(); 2];
        self.stabilized.put(&Terms { residual, rate, gamma }, &mut right);
        if !self.offset.is_empty() {
            for (k, right) in right.iter_mut().enumerate() {
                *right -= self.offset[row as usize + k];
            }
        }
        if let Some([first, second]) = self.kept.get(row as usize..row as usize + 2) {
            first.set(right[0]);
            second.set(right[1]);
        }
        right
    }
}

/// Writes all joints except pins and condensed joints into the entries of Φ_q and into `right`.
pub(super) fn put_others<S: Real>(
    roles: &Roles<S>,
    at: At<'_, S>,
    saddle: &mut Saddle<S>,
    right: &mut [S],
) {
    let mut target = PutOthers { at, saddle, right };
    roles.others.visit(&mut target);
    roles.laws.iter().for_each(|k| target.law(*k));
}

struct PutOthers<'a, S> {
    at: At<'a, S>,
    saddle: &'a mut Saddle<S>,
    right: &'a mut [S],
}

impl<S: Real> VisitJoints<S> for PutOthers<'_, S> {
    #[inline(never)] // one loop for each type
    fn visit<E: Joint>(&mut self, pool: &[Pooled<E::Over<S>>]) {
        for Pooled { element, place } in pool {
            let At { model, motions, t, .. } = self.at;
            let k = place.item as usize;
            constraints::linearize_element::<E, S, _>(
                model,
                k,
                element,
                motions,
                t,
                |terms, columns| self.put(k, terms, columns),
            );
        }
    }
}

impl<S: Real> PutOthers<'_, S> {
    #[inline(always)]
    fn put(&mut self, k: usize, terms: &Terms<'_, S>, columns: ByBlock<'_, S>) {
        let slots = &self.at.model.layout.constraints[k];
        let right = &mut self.right[slots.rows.clone()];
        self.at.stabilized.put(terms, right);
        if !self.at.offset.is_empty() {
            let offset = &self.at.offset[slots.rows.clone()];
            right.iter_mut().zip(offset).for_each(|(right, offset)| *right -= *offset);
        }
        constraints::store(columns, slots, self.saddle.entries.as_flattened_mut());
    }

    /// Writes a joint with a law.
    #[inline(never)] // as for `visit`
    fn law(&mut self, k: usize) {
        let At { model, motions, t, .. } = self.at;
        constraints::linearize_one(model, k, motions, t, &mut |terms, columns| {
            self.put(k, terms, columns)
        });
    }
}

/// Stores the right sides of two rows.
#[inline(always)]
fn put_two<S: Real>(right: &mut [S], row: usize, [first, second]: [S; 2]) {
    let right = &mut right[row..row + 2];
    (right[0], right[1]) = (first, second);
}

/// The rotation columns of two rows, for the body at an end.
#[inline(always)]
fn turning<S: Real>(columns: &[[S; 3]; 4], end: &PinEnd) -> [S; 2] {
    let [first, second] = match end.sign > 0.0 {
        true => [&columns[2], &columns[3]],
        false => [&columns[0], &columns[1]],
    };
    [first[2], second[2]]
}

/// Condenses the grounded bodies. `forces` has the length of the unknowns and `right` that of the rows;
/// [`Saddle::condense`] changes both.
#[inline(always)] // one call in an evaluation, which would spill registers
pub(super) fn condense<S: Real>(
    roles: &Roles<S>,
    at: At<'_, S>,
    saddle: &mut Saddle<S>,
    (forces, right): (&mut [S], &mut [S]),
) {
    roles.condensing.visit(&mut Condense { at, saddle, forces, right });
}

struct Condense<'a, S> {
    at: At<'a, S>,
    saddle: &'a mut Saddle<S>,
    forces: &'a mut [S],
    right: &'a mut [S],
}

impl<S: Real> VisitJoints<S> for Condense<'_, S> {
    #[inline(never)] // one loop for each type
    fn visit<E: Joint>(&mut self, pool: &[Pooled<E::Over<S>>]) {
        assert!(E::CONDENSES); // leaves the loop out of the program for other types
        let Self { at, saddle, forces, right } = self;
        for Pooled { element, place } in pool {
            let (k, row) = (place.slot as usize, place.row as usize);
            let grounded = &at.compiled.grounded[k];
            grounded.turn(at.inertias, at.motions, &mut saddle.condensed[k]);
            let (terms, [i_first, i_second, j_first, j_second]) =
                at.two_rows::<E>(element, place.bodies);
            let own = match BodyId(place.bodies[0] as usize).is_ground() {
                true => [j_first, j_second],
                false => [i_first, i_second],
            };
            let gamma = at.gamma(&terms, place.row);
            let found = saddle.condense(&at.plan.pattern, k, &own, forces, gamma);
            put_two(right, row, found);
        }
    }
}

/// Adds the rows of the pins to the matrix, with `x` = W⁻¹ Q. Replaces `right` by the right side of the Schur
/// complement.
#[inline(always)] // as for `condense`
pub(super) fn put<S: Real>(
    roles: &Roles<S>,
    at: At<'_, S>,
    saddle: &mut Saddle<S>,
    (x, right): (&[S], &mut [S]),
) {
    roles.pins.visit(&mut PutPins { at, saddle, x, right });
}

struct PutPins<'a, S> {
    at: At<'a, S>,
    saddle: &'a mut Saddle<S>,
    x: &'a [S],
    right: &'a mut [S],
}

impl<S: Real> VisitJoints<S> for PutPins<'_, S> {
    #[inline(never)] // one loop for each type
    fn visit<E: Joint>(&mut self, pool: &[Pooled<E::Over<S>>]) {
        assert!(E::CONSTANT_COLUMNS); // leaves the loop out of the program for other types
        let Self { at, saddle, x, right } = self;
        let all: &[PinRows] = at.plan.pattern.pin_rows();
        for Pooled { element, place } in pool {
            let rows = &all[place.slot as usize];
            let (terms, columns) = at.two_rows::<E>(element, place.bodies);
            let mut sum = PinSum::new(at.gamma(&terms, place.row));
            for end in rows.ends() {
                saddle.add_pin(end, turning(&columns, end), x, &mut sum);
            }
            put_two(right, place.row as usize, sum.right);
            saddle.put_pin_rows(rows, &sum);
        }
    }
}
