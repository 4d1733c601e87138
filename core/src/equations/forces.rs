//! Generalized forces Q: gravity, force elements, and the φ̇² term of bodies whose mass centre is not the origin of
//! the frame; and the rates of the first-order states of elements.

use super::kinematics::Motions;
use super::laws::{self, Laws};
use super::measured::lag;
use super::powers::Powers;
use super::reactions::{self, Frame};
use super::Compiled;
use crate::elements::{
    BodyId, Force, ForceElement, Held, Mode, Nature, Pooled, Situation, VisitForces, Wrenches,
};
use crate::math::{Motion, Real, Vec2, Wrench};
use crate::model::{Body, ForceItem, Model};
use std::borrow::Cow;

/// The quantities that forces may depend on in addition to the motion.
#[derive(Clone, Copy, Debug)]
pub struct Acting<'a, S> {
    /// First-order states of elements, shape (n_z).
    pub z: &'a [S],
    /// Multipliers for forces that depend on reactions, shape (n_rows). If None, reactions are zero.
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

/// Weight, and the centrifugal force of mass centres that are not the origin of the frame.
fn body_forces<S: Real>(
    model: &Model<S>,
    compiled: &Compiled<S>,
    motions: &Motions<S>,
    out: &mut [S],
) {
    out[..compiled.weight.len()].copy_from_slice(&compiled.weight);
    for &k in &compiled.off_center {
        let [weight_x, weight_y, _] = model.layout.bodies[k + 1].of(out);
        let w = off_center(&model.bodies[k + 1], &motions[k + 1], Vec2::new(weight_x, weight_y));
        out[model.layout.bodies[k + 1].range()].copy_from_slice(&[w.force.x, w.force.y, w.torque]);
    }
}

/// Weight and centrifugal force m A c′ φ̇² of one body whose mass centre is not the origin of the frame.
#[inline]
pub(super) fn off_center<S: Real>(body: &Body<S>, at: &Motion<S>, weight: Vec2<S>) -> Wrench<S> {
    let (arm, omega) = (at.pose.global(body.center), at.twist.omega);
    let centrifugal = arm.scale(body.mass * omega * omega);
    Wrench { force: weight + centrifugal, torque: arm.cross(weight) }
}

/// Sums forces and their powers.
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
    /// Adds a force with a law of time or state.
    #[inline(never)] // as for `visit`
    fn law(&mut self, item: &ForceItem<S>, k: usize) {
        let at = situation(self.model, k, self.motions, self.acting);
        let element = at_state(self.model, item, self.motions, self.acting);
        let follows = element.follows();
        let nature = |part: usize| match element.parts()[part].nature {
            nature if follows => nature,
            nature => nature.under_law(),
        };
        element.action(&at, &mut Add { sum: self, at: &at, nature });
        self.powers.add_own(element.own_powers(&at));
    }
}

/// Adds the wrenches of one force to a sum.
struct Add<'a, 'b, S, N> {
    sum: &'a mut Sum<'b, S>,
    at: &'a Situation<'b, S>,
    /// The nature of each part of the force.
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

/// The element of a force at a state, with its laws replaced by their values.
pub(super) fn at_state<'m, S: Real>(
    model: &Model<S>,
    item: &'m ForceItem<S>,
    motions: &Motions<S>,
    Acting { z, t, .. }: Acting<'_, S>,
) -> Cow<'m, ForceElement<S>> {
    match &item.law {
        None => Cow::Borrowed(&item.element),
        Some(law) => {
            let function = |k| of_host(model, k, motions, z, t);
            let values = laws::held(&model.parameters, motions, z, t);
            let values = Laws { function: Some(&function), ..values };
            Cow::Owned(law.map(&mut |tape| tape.evaluate(&values)))
        }
    }
}

/// The value of a law that the host program computes.
#[cold]
fn of_host<S: Real>(model: &Model<S>, k: usize, motions: &Motions<S>, z: &[S], t: S) -> S {
    let Some(functions) = &model.blueprint.functions else { return S::constant(f64::NAN) };
    let mut x = Vec::with_capacity(1 + 2 * model.layout.n_q + z.len());
    motions.collect(&model.layout, t, z, &mut x);
    let count = x.len();
    x.extend(&model.parameters);
    functions.value(k, &x, count)
}

/// The situation of force `k`.
#[inline(always)]
pub(super) fn situation<'a, S: Real>(
    model: &'a Model<S>,
    k: usize,
    motions: &'a Motions<S>,
    Acting { z, lam, t }: Acting<'a, S>,
) -> Situation<'a, S> {
    let item = &model.forces[k];
    let reaction = reaction(model, k, motions, lam, t);
    let z = &z[model.layout.states[k].clone()];
    let held = Held { pieces: &motions.pieces, first: item.first_switch };
    let multiplier = match (item.mode, lam) {
        (Mode::Follows { leader, sense }, Some(_)) => {
            following(model, k, (leader, sense), motions, Acting { z, lam, t })
        }
        (Mode::Carries(share), _) => S::constant(share),
        _ => S::zero(),
    };
    let (bodies, mode) = (&item.bodies, item.mode);
    Situation { motions, bodies, z, reaction, t, held, mode, multiplier }
}

/// The situation of force `k` for reports. If the force holds, it contains the multiplier.
#[inline]
pub(super) fn reported<'a, S: Real>(
    model: &'a Model<S>,
    k: usize,
    motions: &'a Motions<S>,
    acting: Acting<'a, S>,
) -> Situation<'a, S> {
    let at = situation(model, k, motions, acting);
    match at.mode {
        Mode::Holds(_) => Situation { multiplier: multiplier(model, k, acting), ..at },
        _ => at,
    }
}

/// The multiplier of the equation with which force `k` holds.
#[inline]
fn multiplier<S: Real>(model: &Model<S>, k: usize, acting: Acting<'_, S>) -> S {
    let row = model.forces[k].held_row;
    row.zip(acting.lam).and_then(|(row, lam)| lam.get(row).copied()).unwrap_or(S::zero())
}

/// The effort of a friction force that follows another one, with opposite sign. Both have the same ratio to their
/// limits.
#[cold]
fn following<S: Real>(
    model: &Model<S>,
    k: usize,
    (leader, sense): (usize, f64),
    motions: &Motions<S>,
    acting: Acting<'_, S>,
) -> S {
    let own = multiplier(model, leader, acting);
    let limit = |k: usize, own: S| {
        let at = situation(model, k, motions, Acting { lam: None, ..acting });
        let reaction = reaction(model, k, motions, acting.lam, acting.t);
        let z = &acting.z[model.layout.states[k].clone()];
        let element = at_state(model, &model.forces[k], motions, acting);
        element.limit_against(&Situation { reaction, z, ..at }, own).0
    };
    let most = limit(leader, own);
    let part = own * limit(k, S::constant(sense) * own) / most;
    S::select(most, S::constant(sense) * part, S::zero())
}

/// The function whose zero may change the mode of force `k`.
#[inline]
pub fn threshold<S: Real>(
    model: &Model<S>,
    k: usize,
    motions: &Motions<S>,
    acting: Acting<'_, S>,
) -> S {
    if model.forces[k].element.driver().is_some() {
        let still = vec![S::zero(); model.layout.n_q];
        return lag(model, k, motions, &still, acting.t).rate;
    }
    threshold_of_state(model, k, motions, acting)
}

/// The [`threshold`] of a force that limits no driver. The threshold of a limit contains the rate of a law, which no jet
/// gives in addition to its own derivatives.
#[inline]
pub fn threshold_of_state<S: Real>(
    model: &Model<S>,
    k: usize,
    motions: &Motions<S>,
    acting: Acting<'_, S>,
) -> S {
    let element = at_state(model, &model.forces[k], motions, acting);
    element.threshold(&reported(model, k, motions, acting))
}

/// The side on which force `k` touches.
#[inline]
pub fn side(model: &Model, k: usize, motions: &Motions, acting: Acting<'_, f64>) -> f64 {
    let element = at_state(model, &model.forces[k], motions, acting);
    element.side(&reported(model, k, motions, acting))
}

/// The reserve of a holding force `k`. It is positive until friction slips or a contact separates.
pub fn reserve<S: Real>(
    model: &Model<S>,
    k: usize,
    motions: &Motions<S>,
    acting: Acting<'_, S>,
) -> S {
    let element = at_state(model, &model.forces[k], motions, acting);
    element.reserve(&reported(model, k, motions, acting))
}

/// The reaction of the joint on which force `k` depends, on its body j at its joint point, in the global frame. Zero
/// without such a joint or without multipliers.
#[inline(always)]
fn reaction<S: Real>(
    model: &Model<S>,
    k: usize,
    motions: &Motions<S>,
    lam: Option<&[S]>,
    t: S,
) -> Wrench<S> {
    let (item, of_row) = (&model.forces[k], |lam: &S| reactions::of_row(*lam));
    match (item.reaction, item.load_row, lam) {
        (Some(joint), _, Some(lam)) => seen(model, joint.0, motions, lam, t),
        (None, Some(row), Some(lam)) => lam.get(row).map_or(Wrench::zero(), of_row),
        _ => Wrench::zero(),
    }
}

/// The reaction of a joint on its body j at its joint point, in the global frame.
///
/// # Panics
/// If the scalar has no equations.
#[cold]
fn seen<S: Real>(
    model: &Model<S>,
    joint: usize,
    motions: &Motions<S>,
    lam: &[S],
    t: S,
) -> Wrench<S> {
    // the constant condition leaves the equations of such scalars out of the program
    if !S::HAS_EQUATIONS {
        panic!("reactions over a scalar without equations");
    }
    let Some(body) = model.constraints[joint].bodies.get(1) else { return Wrench::zero() };
    let own = &lam[model.layout.constraints[joint].rows.clone()];
    reactions::reaction(model, joint, *body, Frame::Global, motions, t, own)
        .unwrap_or_else(Wrench::zero)
}

/// Calls `visit` with the part, body and value of every wrench of force `k`.
#[inline]
pub fn each_wrench<S: Real>(
    model: &Model<S>,
    k: usize,
    motions: &Motions<S>,
    acting: Acting<'_, S>,
    mut visit: impl FnMut(usize, BodyId, Wrench<S>),
) {
    let item = &model.forces[k];
    let element = at_state(model, item, motions, acting);
    let at = reported(model, k, motions, acting);
    element.action(&at, &mut |part, body, w| visit(part, at.bodies[body], w));
}

/// Computes ż of all elements into `out`, shape (n_z).
#[inline]
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

/// Computes ż of force `k` only.
#[inline]
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

/// Computes the switch functions of force `k` itself into the first entries of `out`.
#[inline]
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

/// Potential energy of one part of a force `k`, J, including the energy stored in its states. The potential is zero if a law makes
/// the force non-conservative.
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
        Some(_) if item.element.follows() => at_state(model, item, motions, acting).potential(at),
        Some(_) if item.states.is_empty() => S::zero(),
        Some(_) => at_state(model, item, motions, acting).own_energy(at),
    }
}
