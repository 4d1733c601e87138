//! Generalized forces Q: gravity, force elements, and the φ̇² term of frames off the mass centre.

use super::energy::Powers;
use super::laws;
use crate::elements::{Action, ForceElement, Situation};
use crate::math::{Motion, Real, Wrench};
use crate::model::{columns, Body, ForceItem, Model};

/// Q into `out`, shape (n_q); the powers of the force elements come with it.
pub fn generalized<S: Real>(
    model: &Model<S>,
    motions: &[Motion<S>],
    t: S,
    out: &mut [S],
) -> Powers<S> {
    let moving = model.bodies.iter().zip(motions).skip(1);
    for ((body, motion), out) in moving.zip(out.chunks_exact_mut(3)) {
        let w = gravity_and_inertia(model, body, motion);
        out.copy_from_slice(&[w.force.x, w.force.y, w.torque]);
    }
    let mut powers = Powers::zero();
    for item in &model.forces {
        let parts = item.element.parts();
        let lawful = item.law.is_some();
        each_action(model, item, motions, t, |part, ends, action| {
            let mut power = S::zero();
            for (body, wrench) in ends.into_iter().zip([action.on_i, action.on_j]) {
                power += wrench.power(motions[body.0].twist);
                if let [x, y, angle] = &mut out[columns(body)] {
                    *x += wrench.force.x;
                    *y += wrench.force.y;
                    *angle += wrench.torque;
                }
            }
            powers.add(parts[part].nature, lawful, power);
        });
    }
    powers
}

/// Weight, and the centrifugal force m A c′ φ̇² of a mass centre off the frame's origin.
fn gravity_and_inertia<S: Real>(model: &Model<S>, body: &Body<S>, motion: &Motion<S>) -> Wrench<S> {
    let arm = motion.pose.global(body.center);
    let weight = model.gravity.scale(body.mass);
    let omega = motion.twist.omega;
    let centrifugal = arm.scale(body.mass * omega * omega);
    Wrench { force: weight + centrifugal, torque: arm.cross(weight) }
}

/// The element of a force at a state, laws put in.
fn current<S: Real>(
    model: &Model<S>,
    item: &ForceItem<S>,
    motions: &[Motion<S>],
    t: S,
) -> Option<ForceElement<S>> {
    let values = laws::at(&model.parameters, motions, t);
    item.law.as_ref().map(|law| law.map(&mut |tape| tape.evaluate(&values)))
}

/// What a force sees.
fn situation<S: Real>(element: &ForceElement<S>, motions: &[Motion<S>], t: S) -> Situation<S> {
    let [i, j] = element.ends().map(|b| motions[b.0]);
    Situation { i, j, t }
}

/// Gives the action of every part of a force, with the bodies it acts on.
pub fn each_action<S: Real>(
    model: &Model<S>,
    item: &ForceItem<S>,
    motions: &[Motion<S>],
    t: S,
    mut visit: impl FnMut(usize, [crate::elements::BodyId; 2], Action<S>),
) {
    let law = current(model, item, motions, t);
    let element = law.as_ref().unwrap_or(&item.element);
    let ends = element.ends();
    element.action(&situation(element, motions, t), |part, action| visit(part, ends, action));
}

/// Potential energy of a force, J; zero where a law makes it non-conservative.
pub fn potential<S: Real>(item: &ForceItem<S>, motions: &[Motion<S>], t: S) -> S {
    match item.law {
        Some(_) => S::zero(),
        None => item.element.potential(&situation(&item.element, motions, t)),
    }
}
