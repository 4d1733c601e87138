//! Generalized forces Q: gravity, force elements, and the φ̇² term of frames off the mass centre; and
//! the rates of the first-order states of elements.

use super::kinematics::Motions;
use super::laws::{self, Laws};
use super::powers::Powers;
use super::reactions::{self, Frame};
use super::{Compiled, Inertia};
use crate::elements::{
    BodyId, Force, ForceElement, Held, Nature, Pooled, Situation, VisitForces, Wrenches,
};
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

/// Writes Q into `out`, shape (n_q), and the powers of the force elements into `powers`.
pub fn generalized<S: Real>(
    model: &Model<S>,
    compiled: &Compiled<S>,
    motions: &Motions<S>,
    acting: Acting<'_, S>,
    out: &mut [S],
    powers: &mut Powers<S>,
) {
    body_forces(model, compiled, motions, out);
    *powers = Powers::zero();
    let mut sum = Sum { model, motions, acting, out, powers };
    compiled.forces.visit(&mut sum);
    for &k in &compiled.forces_with_laws {
        sum.law(&model.forces[k], k);
    }
}

/// Weight, and the centrifugal force of mass centres off the frame's origin.
fn body_forces<S: Real>(
    model: &Model<S>,
    compiled: &Compiled<S>,
    motions: &Motions<S>,
    out: &mut [S],
) {
    out[..compiled.weight.len()].copy_from_slice(&compiled.weight);
    for &k in &compiled.off_center {
        let [weight_x, weight_y, _] = model.layout.bodies[k + 1].of(out);
        let w = off_center(&compiled.inertias[k], &motions[k + 1], Vec2::new(weight_x, weight_y));
        out[model.layout.bodies[k + 1].range()].copy_from_slice(&[w.force.x, w.force.y, w.torque]);
    }
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
    powers: &'a mut Powers<S>,
}

impl<S: Real> VisitForces<S> for Sum<'_, S> {
    #[inline(never)] // one loop for each type
    fn visit<E: Force>(&mut self, pool: &[Pooled<E::Over<S>>]) {
        for Pooled { element, place } in pool {
            let at = situation(self.model, place.item as usize, self.motions, self.acting);
            let nature = |part: usize| E::PARTS[part].nature;
            E::action(element, &at, Add { sum: self, at: &at, nature });
            self.powers.add_own(E::own_powers(element, &at));
        }
    }
}

impl<S: Real> Sum<'_, S> {
    /// A force with a law of time or state.
    fn law(&mut self, item: &ForceItem<S>, k: usize) {
        let at = situation(self.model, k, self.motions, self.acting);
        let element = at_state(self.model, item, self.motions, self.acting);
        let nature = |part: usize| element.parts()[part].nature.under_law();
        element.action(&at, Add { sum: self, at: &at, nature });
        self.powers.add_own(element.own_powers(&at));
    }
}

/// Adds the wrenches of one force to a sum.
struct Add<'a, 'b, S, N> {
    sum: &'a mut Sum<'b, S>,
    at: &'a Situation<'b, S>,
    /// The nature of each part.
    nature: N,
}

impl<S: Real, N: Fn(usize) -> Nature> Wrenches<S> for Add<'_, '_, S, N> {
    #[inline(always)]
    fn put(&mut self, part: usize, body: usize, w: Wrench<S>) {
        let power = || w.power(self.at.body(body).twist);
        self.sum.powers.add((self.nature)(part), power);
        let columns = self.sum.model.layout.bodies[self.at.bodies[body].0];
        columns.add([w.force.x, w.force.y, w.torque], self.sum.out);
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
            let function = |k| of_host(model, k, motions, z, t);
            let values = laws::held(&model.parameters, motions, z, t);
            let values = Laws { function: Some(&function), ..values };
            law.map(&mut |tape| tape.evaluate(&values))
        }
    }
}

/// The value of a law that a host computes.
#[cold]
fn of_host<S: Real>(model: &Model<S>, k: usize, motions: &Motions<S>, z: &[S], t: S) -> S {
    let Some(functions) = &model.blueprint.functions else { return S::constant(f64::NAN) };
    let mut x = Vec::with_capacity(1 + 2 * model.layout.n_q + z.len());
    motions.collect(&model.layout, t, z, &mut x);
    functions.value(k, &x)
}

/// The situation of force `k`.
#[inline(always)]
fn situation<'a, S: Real>(
    model: &'a Model<S>,
    k: usize,
    motions: &'a Motions<S>,
    Acting { z, lam, t }: Acting<'a, S>,
) -> Situation<'a, S> {
    let item = &model.forces[k];
    let reaction = match (item.reaction, lam) {
        (Some(joint), Some(lam)) => seen(model, joint.0, motions, lam, t),
        _ => Wrench::zero(),
    };
    let z = &z[model.layout.states[k].clone()];
    let held = Held { pieces: &motions.pieces, first: item.first_switch };
    Situation { motions, bodies: &item.bodies, z, reaction, t, held }
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
    let at = situation(model, k, motions, acting);
    element.action(&at, |part, body, w| visit(part, at.bodies[body], w));
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
    model.layout.held.iter().for_each(|place| out[*place] = S::zero());
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
    element.state_rates(&situation(model, k, motions, acting), out);
}

/// The functions of the switches of force `k` itself, into the first entries of `out`.
pub(super) fn switches<S: Real>(
    model: &Model<S>,
    k: usize,
    motions: &Motions<S>,
    acting: Acting<'_, S>,
    out: &mut [S],
) {
    let count = model.forces[k].element.switch_count();
    if count > 0 {
        let element = at_state(model, &model.forces[k], motions, acting);
        element.switches(&situation(model, k, motions, acting), &mut out[..count]);
    }
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
    let at = &situation(model, k, motions, acting);
    match &item.law {
        None => item.element.potential(at) + item.element.own_energy(at),
        Some(_) if item.states.is_empty() => S::zero(),
        Some(_) => at_state(model, item, motions, acting).own_energy(at),
    }
}

/// Power that force `k` dissipates, W.
pub fn dissipated<S: Real>(
    model: &Model<S>,
    k: usize,
    motions: &Motions<S>,
    acting: Acting<'_, S>,
) -> S {
    let element = at_state(model, &model.forces[k], motions, acting);
    let at = situation(model, k, motions, acting);
    let mut powers = Powers::zero();
    element.action(&at, |part: usize, body: usize, w: Wrench<S>| {
        powers.add(element.parts()[part].nature, || w.power(at.body(body).twist));
    });
    powers.add_own(element.own_powers(&at));
    powers.dissipated
}
