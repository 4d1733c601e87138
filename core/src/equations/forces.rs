//! Generalized forces Q: gravity, force elements, and the φ̇² term of frames off the mass centre; and
//! the rates of the first-order states of elements.

use super::kinematics::Motions;
use super::powers::Powers;
use super::reactions::{self, Frame};
use super::{laws, Compiled, Inertia};
use crate::elements::derive::with_values;
use crate::elements::{BodyId, Force, ForceElement, Part, Pooled, Situation, VisitForces};
use crate::math::{Motion, Real, Vec2, Wrench};
use crate::model::{ForceItem, Model};

/// The quantities that forces may depend on in addition to the motion.
#[derive(Clone, Copy, Debug)]
pub struct Acting<'a, S> {
    /// First-order states of elements, shape (n_z).
    pub z: &'a [S],
    /// Multipliers for forces that depend on reactions, shape (n_rows); without them reactions are zero.
    pub lam: Option<&'a [S]>,
    /// Time, s.
    pub t: S,
}

/// Writes Q into `out`, shape (n_q), and returns the powers of the force elements.
pub fn generalized<S: Real>(
    model: &Model<S>,
    compiled: &Compiled<S>,
    motions: &Motions<S>,
    acting: Acting<'_, S>,
    out: &mut [S],
) -> Powers<S> {
    body_forces(model, compiled, motions, out);
    let mut sum = Sum { model, motions, acting, out, powers: Powers::zero() };
    compiled.forces.visit(&mut sum);
    for &k in &compiled.forces_with_laws {
        sum.law(&model.forces[k], k);
    }
    sum.powers
}

/// Weight, and the centrifugal force of mass centres off the frame's origin.
fn body_forces<S: Real>(
    model: &Model<S>,
    compiled: &Compiled<S>,
    motions: &Motions<S>,
    out: &mut [S],
) {
    let bodies = compiled.inertias.iter().zip(&motions[1..]).zip(&model.layout.bodies[1..]);
    for ((inertia, motion), columns) in bodies {
        let weight = model.gravity.scale(inertia.mass);
        let out = &mut out[columns.range()];
        (out[0], out[1]) = (weight.x, weight.y);
        let Some(turning) = out.get_mut(2) else { continue };
        *turning = S::zero();
        if inertia.coupled {
            let w = off_center(inertia, motion, weight);
            out.copy_from_slice(&[w.force.x, w.force.y, w.torque]);
        }
    }
    let own = model.layout.owners[model.bodies.len() - 1..].iter();
    own.for_each(|columns| out[columns.range()].fill(S::zero()));
}

/// Weight, and the centrifugal force m A c′ φ̇², of a mass centre off the frame's origin.
fn off_center<S: Real>(inertia: &Inertia<S>, motion: &Motion<S>, weight: Vec2<S>) -> Wrench<S> {
    let arm = motion.pose.global(inertia.center);
    let omega = motion.twist.omega;
    let centrifugal = arm.scale(inertia.mass * omega * omega);
    Wrench { force: weight + centrifugal, torque: arm.cross(weight) }
}

/// Adds up forces and their powers.
struct Sum<'a, S> {
    model: &'a Model<S>,
    motions: &'a Motions<S>,
    acting: Acting<'a, S>,
    /// Q.
    out: &'a mut [S],
    powers: Powers<S>,
}

impl<S: Real> VisitForces<S> for Sum<'_, S> {
    #[inline(never)] // one loop for each type
    fn visit<E: Force>(&mut self, pool: &[Pooled<E::Over<S>>]) {
        for Pooled { element, place } in pool {
            let item = place.item as usize;
            let bodies = &self.model.forces[item].bodies;
            let (model, motions, acting) = (self.model, self.motions, self.acting);
            situation(model, item, motions, acting, |at| {
                with_values(
                    E::PARTS.len() * bodies.len(),
                    |_| Wrench::zero(),
                    |wrenches| {
                        E::action(element, at, wrenches);
                        self.add(bodies, E::PARTS, false, wrenches);
                    },
                );
                let own = E::own_powers(element, at);
                self.powers.dissipated += own.dissipated;
                self.powers.applied += own.applied;
            });
        }
    }
}

impl<S: Real> Sum<'_, S> {
    /// A force with a law of time or state.
    fn law(&mut self, item: &ForceItem<S>, k: usize) {
        let (model, motions, acting) = (self.model, self.motions, self.acting);
        let element = at_state(model, item, motions, acting);
        let parts = element.parts();
        situation(model, k, motions, acting, |at| {
            with_values(
                parts.len() * item.bodies.len(),
                |_| Wrench::zero(),
                |wrenches| {
                    element.action(at, wrenches);
                    self.add(&item.bodies, parts, true, wrenches);
                },
            );
            let own = element.own_powers(at);
            self.powers.dissipated += own.dissipated;
            self.powers.applied += own.applied;
        });
    }

    /// Adds the wrenches of all parts; `law`: whether time or state enters the formulas.
    #[inline(always)]
    fn add(&mut self, bodies: &[BodyId], parts: &[Part], law: bool, wrenches: &[Wrench<S>]) {
        for (part, own) in parts.iter().zip(wrenches.chunks_exact(bodies.len())) {
            let power = || {
                let both = bodies.iter().zip(own);
                let each = both.map(|(body, w)| w.power(self.motions[body.0].twist));
                each.fold(S::zero(), |sum, power| sum + power)
            };
            self.powers.add(part.nature, law, power);
            for (body, w) in bodies.iter().zip(own) {
                let columns = self.model.layout.bodies[body.0];
                columns.add([w.force.x, w.force.y, w.torque], self.out);
            }
        }
    }
}

/// The element of a force at a state: its laws replaced by their values.
fn at_state<S: Real>(
    model: &Model<S>,
    item: &ForceItem<S>,
    motions: &Motions<S>,
    Acting { z, t, .. }: Acting<'_, S>,
) -> ForceElement<S> {
    match &item.law {
        None => item.element.clone(),
        Some(law) => {
            let values = laws::at(&model.parameters, motions, z, t);
            law.map(&mut |tape| tape.evaluate(&values))
        }
    }
}

/// Calls `take` with the situation of force `k`.
#[inline(always)]
fn situation<S: Real, R>(
    model: &Model<S>,
    k: usize,
    motions: &Motions<S>,
    Acting { z, lam, t }: Acting<'_, S>,
    take: impl FnOnce(&Situation<'_, S>) -> R,
) -> R {
    let item = &model.forces[k];
    let reaction = match (item.reaction, lam) {
        (Some(joint), Some(lam)) => seen(model, joint.0, motions, lam, t),
        _ => Wrench::zero(),
    };
    with_values(
        item.bodies.len(),
        |b| motions[item.bodies[b].0],
        |bodies| take(&Situation { bodies, z: &z[model.layout.states[k].clone()], reaction, t }),
    )
}

/// The reaction of a joint on its body j at its joint point, in the global frame.
#[cold]
fn seen<S: Real>(
    model: &Model<S>,
    joint: usize,
    motions: &Motions<S>,
    lam: &[S],
    t: S,
) -> Wrench<S> {
    let Some(body) = model.constraints[joint].bodies.get(1) else { return Wrench::zero() };
    let own = &lam[model.layout.constraints[joint].rows.clone()];
    reactions::reaction(model, joint, *body, Frame::Global, motions, t, own)
        .unwrap_or_else(Wrench::zero)
}

/// Gives every wrench of force `k` with its part and body.
pub fn each_wrench<S: Real>(
    model: &Model<S>,
    k: usize,
    motions: &Motions<S>,
    acting: Acting<'_, S>,
    mut visit: impl FnMut(usize, BodyId, Wrench<S>),
) {
    let item = &model.forces[k];
    let element = at_state(model, item, motions, acting);
    situation(model, k, motions, acting, |at| {
        let n = item.bodies.len();
        with_values(
            element.parts().len() * n,
            |_| Wrench::zero(),
            |wrenches| {
                element.action(at, wrenches);
                let all = wrenches.iter().enumerate();
                all.for_each(|(place, w)| visit(place / n, item.bodies[place % n], *w));
            },
        );
    });
}

/// ż of all elements into `out`, shape (n_z).
pub fn state_rates<S: Real>(
    model: &Model<S>,
    motions: &Motions<S>,
    acting: Acting<'_, S>,
    out: &mut [S],
) {
    for (k, states) in model.layout.states.iter().enumerate().filter(|(_, own)| !own.is_empty()) {
        state_rates_of(model, k, motions, acting, &mut out[states.clone()]);
    }
}

/// ż of force `k` alone.
pub(super) fn state_rates_of<S: Real>(
    model: &Model<S>,
    k: usize,
    motions: &Motions<S>,
    acting: Acting<'_, S>,
    out: &mut [S],
) {
    let element = at_state(model, &model.forces[k], motions, acting);
    situation(model, k, motions, acting, |at| element.state_rates(at, out));
}

/// Potential energy of force `k`, zero where a law makes it non-conservative, and the energy stored in its
/// states, J.
pub fn potential<S: Real>(
    model: &Model<S>,
    k: usize,
    motions: &Motions<S>,
    acting: Acting<'_, S>,
) -> S {
    let item = &model.forces[k];
    situation(model, k, motions, acting, |at| match &item.law {
        None => item.element.potential(at) + item.element.own_energy(at),
        Some(_) if item.states.is_empty() => S::zero(),
        Some(_) => at_state(model, item, motions, acting).own_energy(at),
    })
}
