//! Derivatives of forces with respect to the multipliers on which they depend, with dual numbers.
//!
//! A force depends on the reaction of one joint, which is linear in the multipliers of this joint. A friction force
//! that follows another one also depends on the multiplier and on the limit of the other force.

use super::forces::{self, Acting};
use super::kinematics::Motions;
use super::reactions;
use crate::elements::derive::ByThree;
use crate::elements::{BodyId, ForceElement, Mode, Situation};
use crate::math::{each, Lift, Listed, Motion, Real, Vec2, Wrench};
use crate::model::Model;

/// The derivative is the first slope; the others are zero. A scalar of its own would only be more code.
type D<S> = ByThree<S>;

/// ∂(Q + loads)/∂λ for the multiplier of one row, shape (n_q).
pub fn by_multiplier<S: Real>(
    model: &Model<S>,
    motions: &Motions<S>,
    acting: Acting<'_, S>,
    row: usize,
) -> Vec<S> {
    let mut column = vec![S::zero(); model.layout.n_q];
    let mut unit = vec![S::zero(); model.n_multipliers()];
    unit[row] = S::one();
    if let Some(lam) = acting.lam {
        reactions::add_load_slopes(model, motions, acting.t, (lam, row), &mut column);
    }
    let seed = Seed { model, motions, acting, row, unit: &unit };
    for (k, item) in model.forces.iter().enumerate() {
        if rows_of(model, k).contains(&row) {
            let multiplier = seed.multiplier(k);
            seed.with(k, multiplier, |element, at| {
                element.action(at, &mut |_: usize, body: usize, w: Wrench<D<S>>| {
                    let [x, y, torque] = each([w.force.x, w.force.y, w.torque], |x| x.slope[0]);
                    model.layout.bodies[item.bodies[body].0].add([x, y, torque], &mut column);
                });
            });
        }
    }
    column
}

/// The rows of the multipliers on which force `k` depends.
pub fn rows_of<S>(model: &Model<S>, k: usize) -> Vec<usize> {
    let item = &model.forces[k];
    let seen = |k: usize| model.forces[k].reaction.map(|joint| joint.0);
    let rows = |joint: usize| model.layout.constraints[joint].rows.clone();
    let mut all: Vec<usize> = seen(k).into_iter().flat_map(rows).list();
    if let Mode::Follows { leader, .. } = item.mode {
        seen(leader).into_iter().flat_map(rows).append_to(&mut all);
        all.extend(model.forces[leader].held_row);
    }
    all.sort_unstable();
    all.dedup();
    all
}

/// The multiplier of one row as the independent variable.
#[derive(Clone, Copy)]
struct Seed<'a, S> {
    model: &'a Model<S>,
    motions: &'a Motions<S>,
    acting: Acting<'a, S>,
    row: usize,
    /// A vector that is 1 at the row and 0 elsewhere.
    unit: &'a [S],
}

impl<S: Real> Seed<'_, S> {
    /// Calls `f` with force `k` in its situation, as dual numbers.
    fn with<R>(
        &self,
        k: usize,
        multiplier: D<S>,
        f: impl FnOnce(&ForceElement<D<S>>, &Situation<'_, D<S>>) -> R,
    ) -> R {
        let Self { model, motions, acting, unit, .. } = *self;
        let at = forces::situation(model, k, motions, acting);
        let slope = forces::situation(model, k, motions, Acting { lam: Some(unit), ..acting });
        let element = forces::at_state(model, &model.forces[k], motions, acting);
        let element = element.map(&mut |x: &S| D::lift(*x));
        let own: Vec<Motion<D<S>>> = at.bodies.iter().map(|b| motions[b.0].lift()).list();
        let bodies: Vec<BodyId> = (0..own.len()).map(BodyId).list();
        let z: Vec<D<S>> = at.z.iter().map(|z| D::lift(*z)).list();
        let situation = Situation {
            motions: &own,
            bodies: &bodies,
            z: &z,
            reaction: seeded(at.reaction, slope.reaction),
            t: D::lift(at.t),
            held: at.held,
            mode: at.mode,
            multiplier,
        };
        f(&element, &situation)
    }

    /// The effort that force `k` takes from the force that it follows, with opposite sign. Zero if it follows none.
    fn multiplier(&self, k: usize) -> D<S> {
        let Mode::Follows { leader, sense } = self.model.forces[k].mode else { return D::zero() };
        let limit = |k: usize| self.with(k, D::zero(), |element, at| element.limit(at));
        let row = self.model.forces[leader].held_row;
        let held = row.zip(self.acting.lam).map_or(S::zero(), |(row, lam)| lam[row]);
        let slope = if row == Some(self.row) { S::one() } else { S::zero() };
        let most = limit(leader);
        let part = along(held, slope) * limit(k) / most;
        D::select(most, D::constant(sense) * part, D::zero())
    }
}

/// A wrench whose derivative is a second wrench.
fn seeded<S: Real>(value: Wrench<S>, slope: Wrench<S>) -> Wrench<D<S>> {
    let (x, y) = (along(value.force.x, slope.force.x), along(value.force.y, slope.force.y));
    Wrench { force: Vec2::new(x, y), torque: along(value.torque, slope.torque) }
}

/// A number with its derivative with respect to the multiplier.
fn along<S: Real>(value: S, slope: S) -> D<S> {
    D { value, slope: [slope, S::zero(), S::zero()] }
}
