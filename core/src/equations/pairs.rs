//! Joints of two rows that the elimination handles by themselves, whatever their type.
//!
//! A joint to ground leaves its body one freedom: the body is condensed to it before everything else
//! (`solve/condensed.rs`). A pin among bodies has rows [±I b] (Haug 3.3.12): of its columns b alone changes, and its part
//! of the matrix is computed while its numbers are at hand. All numbers come from the element's own `linearize`;
//! constant columns ±I are a property that it declares.

use super::constraints::Stabilized;
use super::inertia::Inertia;
use super::plan::PinJoint;
use super::{kinematics, mass, Compiled};
use crate::elements::{BodyId, Constraint, Joint, TypedLoop, VelocityTerms};
use crate::math::{Motion, Real};
use crate::model::Model;
use crate::solve::{CondensedGroup, Pattern, PinSum, Saddle};
use std::ops::Range;

/// A joint of two rows with constant fields.
#[derive(Clone, Debug)]
pub struct Pair<S = f64> {
    /// The element.
    pub element: Constraint<S>,
    /// Its place among the constraints.
    pub constraint: u32,
    /// The first of its rows.
    pub row: u32,
}

/// A moving body that a joint of two rows holds to ground.
#[derive(Clone, Copy, Debug)]
pub struct Grounded<S = f64> {
    /// The joint's place among the [`Pair`]s.
    pub pair: u32,
    /// Its place among the constraints.
    pub constraint: u32,
    /// The body's place among the moving bodies.
    pub body: u32,
    /// Whether the body is body j of the joint.
    is_j: bool,
    /// W of the body in its own frame.
    mass: CondensedGroup<S>,
    /// For a pin, the inverse of the moment of inertia about it, 1/(kg·m²), whatever the state.
    about_pin: Option<S>,
}

/// All joints of two rows with constant fields that touch a moving body, in the order of the constraints.
pub(super) fn pairs<S: Real>(model: &Model<S>) -> Vec<Pair<S>> {
    let index = |i: usize| u32::try_from(i).expect("fewer than 2^32 rows");
    let items = model.constraints.iter().zip(&model.layout.constraints).enumerate();
    let pairs = items.filter(|(_, (item, slots))| {
        item.law.is_none() && slots.rows.len() == 2 && !slots.blocks.is_empty()
    });
    pairs
        .map(|(k, (item, slots))| Pair {
            element: item.element.clone(),
            constraint: index(k),
            row: index(slots.rows.start),
        })
        .collect()
}

/// The bodies that joints to ground hold: by the first pin of each, else by the first other joint; sorted by types.
/// Bodies without an inertia of their own stay free.
pub(super) fn grounded<S: Real>(
    model: &Model<S>,
    pairs: &[Pair<S>],
    added: &[S],
) -> Vec<Grounded<S>> {
    let mut holds: Vec<Option<(u32, bool)>> = vec![None; model.bodies.len()];
    for (k, pair) in (0..).zip(pairs) {
        let [i, j] = pair.element.ends();
        let body = if i.is_ground() { j } else { i };
        let to_ground = i.is_ground() != j.is_ground();
        let pin = model.layout.constraints[pair.constraint as usize].blocks[0].sign != 0.0;
        let better = holds[body.0].is_none_or(|(_, held_by_pin)| pin && !held_by_pin);
        if to_ground && better && added[body.0].largest_magnitude() == 0.0 {
            holds[body.0] = Some((k, pin));
        }
    }
    let bodies = holds.into_iter().enumerate();
    let found = bodies.filter_map(|(body, hold)| Some(Grounded::new(model, pairs, body, hold?)));
    let mut found: Vec<_> = found.collect();
    found.sort_by_key(|grounded| pairs[grounded.pair as usize].element.kind());
    found
}

impl<S: Real> Grounded<S> {
    fn new(model: &Model<S>, pairs: &[Pair<S>], body: usize, (k, pin): (u32, bool)) -> Self {
        let pair = &pairs[k as usize];
        let is_j = pair.element.ends()[1] == BodyId(body);
        let motions = kinematics::at_rest(&vec![S::zero(); model.layout.n_q]);
        let block = mass::block(&model.bodies[body], &motions[body]);
        let moment = [block.coupling.x, block.coupling.y];
        let mass = CondensedGroup::new(block.mass, moment, block.inertia);
        let about_pin = pin.then(|| {
            let mut rows = [[S::zero(); 6]; 2];
            let [i, j] = pair.element.ends().map(|b| &motions[b.0].pose);
            pair.element.jacobian(i, j, S::zero(), &mut rows);
            let sign = if is_j { 1.0 } else { -1.0 };
            let b = rows.map(|row| if is_j { row[5] } else { row[2] });
            S::one() / mass.about_pin(sign, b).1
        });
        let (body, constraint) = (body as u32 - 1, pair.constraint);
        Self { pair: k, constraint, body, is_j, mass, about_pin }
    }

    /// Puts what no state changes in the matrix.
    pub(super) fn set(&self, k: usize, saddle: &mut Saddle<S>) {
        let mass = &mut saddle.masses[self.body as usize];
        mass.translation = [S::zero(); 2];
        mass.held = S::one() / self.mass.mass;
        if let Some(inverse) = self.about_pin {
            mass.along = inverse;
        }
        saddle.condensed[k] = self.mass;
    }

    /// Turns its W with the body.
    #[inline(always)]
    pub(super) fn turn(
        &self,
        inertias: &[Inertia<S>],
        motions: &[Motion<S>],
        group: &mut CondensedGroup<S>,
    ) {
        let inertia = &inertias[self.body as usize];
        if inertia.coupled {
            let arm = motions[self.body as usize + 1].pose.global(inertia.center);
            let b = arm.perp().scale(inertia.mass);
            group.moment = [b.x, b.y];
        }
    }
}

/// Where an evaluation stands.
#[derive(Clone, Copy)]
pub(super) struct At<'a, S> {
    pub motions: &'a [Motion<S>],
    pub t: S,
    pub stabilized: Stabilized<S>,
    /// Subtracted from γ̂, shape (n_rows), or empty.
    pub offset: &'a [S],
}

impl<S: Real> At<'_, S> {
    /// γ̂ of two rows.
    #[inline(always)]
    fn gamma<const M: usize>(&self, terms: &VelocityTerms<S, M>, row: u32) -> [S; 2] {
        let mut gamma = [S::zero(); 2];
        self.stabilized.put(terms, &mut gamma);
        if !self.offset.is_empty() {
            let offset = &self.offset[row as usize..row as usize + 2];
            gamma.iter_mut().zip(offset).for_each(|(gamma, offset)| *gamma -= *offset);
        }
        gamma
    }
}

/// Ranges of `items` whose elements have one type each.
pub(super) fn runs<T>(items: &[T], kind: impl Fn(&T) -> &'static str) -> Vec<Range<usize>> {
    let chunks = items.chunk_by(|a, b| kind(a) == kind(b));
    let range = |next: &mut usize, chunk: &[T]| {
        *next += chunk.len();
        Some(*next - chunk.len()..*next)
    };
    chunks.scan(0, range).collect()
}

/// Condenses the grounded bodies. `forces` and `right`, shapes (n_q) and (n_rows), become what
/// [`Saddle::condense`] leaves there.
#[inline(always)] // once in an evaluation: a call would spill registers
pub(super) fn condense<S: Real>(
    compiled: &Compiled<S>,
    at: At<'_, S>,
    (pattern, saddle): (&Pattern, &mut Saddle<S>),
    (forces, right): (&mut [S], &mut [S]),
) {
    if pattern.condensed().is_empty() {
        return;
    }
    for run in &compiled.grounded_runs {
        let pair = compiled.grounded[run.start].pair as usize;
        let (saddle, forces, right) = (&mut *saddle, &mut *forces, &mut *right);
        let work = Condense { compiled, run: run.clone(), at, pattern, saddle, forces, right };
        compiled.pairs[pair].element.run_typed(work);
    }
}

/// Grounded bodies whose joints have one type, and where their rows go.
struct Condense<'a, S> {
    compiled: &'a Compiled<S>,
    run: Range<usize>,
    at: At<'a, S>,
    pattern: &'a Pattern,
    saddle: &'a mut Saddle<S>,
    forces: &'a mut [S],
    right: &'a mut [S],
}

impl<S: Real> TypedLoop<S> for Condense<'_, S> {
    #[inline(always)] // a loop for each type; calls would cost more than they share
    fn run<const M: usize, E: Joint<M>>(self, get: impl Fn(&Constraint<S>) -> Option<&E::Over<S>>) {
        let Self { compiled, run, at, pattern, saddle, forces, right } = self;
        for (k, grounded) in run.clone().zip(&compiled.grounded[run]) {
            grounded.turn(&compiled.inertias, at.motions, &mut saddle.condensed[k]);
            let Pair { element, row, .. } = &compiled.pairs[grounded.pair as usize];
            let Some(element) = get(element) else { continue };
            let [i, j] = E::ends(element).map(|body| &at.motions[body.0]);
            let (terms, rows) = E::linearize(element, i, j, at.t);
            let Some([first, second]) = rows.first_chunk() else { continue };
            let own = [first, second].map(|row| match grounded.is_j {
                true => [row[3], row[4], row[5]],
                false => [row[0], row[1], row[2]],
            });
            let gamma = at.gamma(&terms, *row);
            let found = saddle.condense(pattern, k, &own, forces, gamma);
            right[*row as usize..][..2].copy_from_slice(&found);
        }
    }
}

/// Puts the rows of `pins` into the matrix, with `x` = W⁻¹ Q; `right` becomes their right side.
#[inline(always)] // as above
pub(super) fn put<S: Real>(
    compiled: &Compiled<S>,
    (pins, runs): (&[PinJoint], &[Range<usize>]),
    at: At<'_, S>,
    saddle: &mut Saddle<S>,
    (x, right): (&[S], &mut [S]),
) {
    for run in runs {
        let pins = &pins[run.clone()];
        let (saddle, right) = (&mut *saddle, &mut *right);
        let work = PutPins { compiled, pins, at, saddle, x, right };
        compiled.pairs[pins[0].pair as usize].element.run_typed(work);
    }
}

/// Pins of one type among bodies, and where their rows go.
struct PutPins<'a, S> {
    compiled: &'a Compiled<S>,
    pins: &'a [PinJoint],
    at: At<'a, S>,
    saddle: &'a mut Saddle<S>,
    x: &'a [S],
    right: &'a mut [S],
}

impl<S: Real> TypedLoop<S> for PutPins<'_, S> {
    #[inline(always)] // a loop for each type; calls would cost more than they share
    fn run<const M: usize, E: Joint<M>>(self, get: impl Fn(&Constraint<S>) -> Option<&E::Over<S>>) {
        let Self { compiled, pins, at, saddle, x, right } = self;
        for PinJoint { pair, rows: pin } in pins {
            let Some(element) = get(&compiled.pairs[*pair as usize].element) else { continue };
            let [i, j] = E::ends(element).map(|body| &at.motions[body.0]);
            let (terms, rows) = E::linearize(element, i, j, at.t);
            let Some([first, second]) = rows.first_chunk() else { continue };
            let mut sum = PinSum::new(at.gamma(&terms, pin.row));
            for end in pin.ends() {
                let column = if end.sign > 0.0 { 5 } else { 2 };
                saddle.add_pin(end, [first[column], second[column]], x, &mut sum);
            }
            right[pin.row as usize..][..2].copy_from_slice(&sum.right);
            saddle.put_pin_rows(pin, &sum);
        }
    }
}
