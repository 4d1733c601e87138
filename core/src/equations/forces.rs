//! Generalized forces Q: gravity, force elements, and the φ̇² term of frames off the mass centre.

use super::energy::Powers;
use super::{laws, Compiled, Inertia};
use crate::elements::{Acting, Action, BodyId, Part, Situation};
use crate::math::{Motion, Real, Vec2, Wrench};
use crate::model::{columns, ForceItem, Model};

/// Q into `out`, shape (n_q); the powers of the force elements come with it.
#[inline(always)] // as constraints::linearize
pub fn generalized<S: Real>(
    model: &Model<S>,
    compiled: &Compiled<S>,
    motions: &[Motion<S>],
    t: S,
    out: &mut [S],
) -> Powers<S> {
    let moving = compiled.inertias.iter().zip(&motions[1..]);
    for ((inertia, motion), out) in moving.zip(out.chunks_exact_mut(3)) {
        let weight = model.gravity.scale(inertia.mass);
        // before the branch, so that the two are written as a pair: they are read as one
        (out[0], out[1], out[2]) = (weight.x, weight.y, S::zero());
        if inertia.coupled {
            let w = off_center(inertia, motion, weight);
            out.copy_from_slice(&[w.force.x, w.force.y, w.torque]);
        }
    }
    let mut powers = Powers::zero();
    for item in &model.forces {
        let lawful = item.law.is_some();
        each(model, item, motions, t, Sum { motions, lawful, out, powers: &mut powers });
    }
    powers
}

/// Adds forces up, and their powers.
struct Sum<'a, S> {
    motions: &'a [Motion<S>],
    /// Whether time or state enters the formulas.
    lawful: bool,
    /// Q.
    out: &'a mut [S],
    powers: &'a mut Powers<S>,
}

impl<S: Real> Acting<S> for Sum<'_, S> {
    #[inline(always)]
    fn take<const P: usize>(self, ends: [BodyId; 2], parts: &[Part; P], actions: &[Action<S>; P]) {
        let twists = ends.map(|body| self.motions[body.0].twist);
        let mut total = [Wrench::zero(); 2];
        for (part, Action { on_i, on_j }) in parts.iter().zip(actions) {
            let power = || on_i.power(twists[0]) + on_j.power(twists[1]);
            self.powers.add(part.nature, self.lawful, power);
            total = [total[0] + *on_i, total[1] + *on_j];
        }
        for (body, wrench) in ends.into_iter().zip(total) {
            if let [x, y, angle] = &mut self.out[columns(body)] {
                *x += wrench.force.x;
                *y += wrench.force.y;
                *angle += wrench.torque;
            }
        }
    }
}

/// Weight, and the centrifugal force m A c′ φ̇², of a mass centre off the frame's origin.
#[inline(always)]
fn off_center<S: Real>(inertia: &Inertia<S>, motion: &Motion<S>, weight: Vec2<S>) -> Wrench<S> {
    let arm = motion.pose.global(inertia.center);
    let omega = motion.twist.omega;
    let centrifugal = arm.scale(inertia.mass * omega * omega);
    Wrench { force: weight + centrifugal, torque: arm.cross(weight) }
}

/// Gives the action of a force at a state, laws put in.
#[inline(always)]
fn each<S: Real>(
    model: &Model<S>,
    item: &ForceItem<S>,
    motions: &[Motion<S>],
    t: S,
    taker: impl Acting<S>,
) {
    let Some(law) = &item.law else { return item.element.action(motions, t, taker) };
    let values = laws::at(&model.parameters, motions, t);
    law.map(&mut |tape| tape.evaluate(&values)).action(motions, t, taker);
}

/// Gives the action of every part of a force, with the bodies it acts on.
pub fn each_action<S: Real>(
    model: &Model<S>,
    item: &ForceItem<S>,
    motions: &[Motion<S>],
    t: S,
    visit: impl FnMut(usize, [BodyId; 2], Action<S>),
) {
    each(model, item, motions, t, Visit(visit));
}

struct Visit<F>(F);

impl<S: Real, F: FnMut(usize, [BodyId; 2], Action<S>)> Acting<S> for Visit<F> {
    fn take<const P: usize>(self, ends: [BodyId; 2], _: &[Part; P], actions: &[Action<S>; P]) {
        let Self(mut visit) = self;
        actions.iter().enumerate().for_each(|(part, action)| visit(part, ends, *action));
    }
}

/// Potential energy of a force, J; zero where a law makes it non-conservative.
pub fn potential<S: Real>(item: &ForceItem<S>, motions: &[Motion<S>], t: S) -> S {
    match item.law {
        Some(_) => S::zero(),
        None => {
            let [i, j] = item.element.ends().map(|b| motions[b.0]);
            item.element.potential(&Situation { i, j, t })
        }
    }
}
