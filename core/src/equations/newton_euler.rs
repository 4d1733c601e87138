//! The Newton–Euler balance of each body, and the balance of each internal coordinate.
//!
//! For a body with mass m, moment of inertia J and mass centre C, the residuals are
//!
//! ```text
//! Σ F - m a_C,        Σ (T + (P - C) × F) - J α.
//! ```
//!
//! Each F acts at its point P with the torque T about P, as [`reaction`] reports them for joints and drivers. The
//! sums use neither Φ_q of the mechanism, nor the mass matrix, nor Q. They therefore check the reported forces, not
//! the solution of the equations of motion.
//!
//! An internal coordinate u, such as the parameter of a joint on a curve, has no mass, and no force acts on it. Its
//! balance is Σ λ ∂Φ/∂u = 0: the reaction has no component along the curve.

use super::constraints::{linearize_one, store};
use super::forces::{each_wrench, Acting};
use super::kinematics::Motions;
use super::measured;
use super::reactions::{place, reaction, touched, Frame};
use crate::elements::{BodyId, Group};
use crate::math::{Listed, Vec2, Wrench};
use crate::model::{size, Model};
use serde::{Deserialize, Serialize};

/// The sums over the forces on one body at one state.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct BodyBalance {
    /// |Σ F - m a_C|, N.
    pub force: f64,
    /// |Σ M - J α| about the mass centre, N·m; zero for a point mass.
    pub moment: f64,
    /// The largest single force including weight, N.
    pub largest_force: f64,
    /// The largest moment of a single force or torque about the mass centre, N·m.
    pub largest_moment: f64,
    /// The largest distance from the mass centre to a point where a reaction acts, and at least the size of the
    /// mechanism, m.
    pub lever: f64,
}

/// The sum of the generalized forces on one internal coordinate at one state.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct CoordinateBalance {
    /// |Σ λ ∂Φ/∂u|, N·m per unit of u.
    pub effort: f64,
    /// The largest term of the sum.
    pub largest_effort: f64,
    /// The largest |∂Φ/∂u|, which converts a multiplier to an effort.
    pub lever: f64,
}

/// The balances at one state.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Balances {
    /// All moving bodies, in the order of the model.
    pub bodies: Vec<BodyBalance>,
    /// All internal coordinates, in the order of the columns.
    pub coordinates: Vec<CoordinateBalance>,
}

/// The sum of the forces on one body.
#[derive(Clone, Copy, Default)]
struct ForceSum {
    force: [f64; 2],
    moment: f64,
    of: BodyBalance,
}

impl ForceSum {
    /// Adds a force at an arm from the mass centre, and a torque.
    fn add(&mut self, arm: Vec2, force: Vec2, torque: f64) {
        let moment = torque + arm.cross(force);
        self.force = [self.force[0] + force.x, self.force[1] + force.y];
        self.moment += moment;
        self.of.largest_force = self.of.largest_force.max(force.norm());
        self.of.largest_moment = self.of.largest_moment.max(moment.abs());
    }
}

/// The balances of all moving bodies and internal coordinates.
///
/// `a` contains the accelerations, shape (n_q); `acting` contains the multipliers.
pub fn balances(model: &Model, motions: &Motions, a: &[f64], acting: Acting<'_, f64>) -> Balances {
    let of = BodyBalance { lever: size(model), ..BodyBalance::default() };
    let mut sums = vec![ForceSum { of, ..ForceSum::default() }; model.bodies.len()];
    let center = |body: usize| motions[body].pose.point(model.bodies[body].center);
    add_reactions(model, motions, acting, &center, &mut sums);
    for k in 0..model.forces.len() {
        each_wrench(model, k, motions, acting, |_, BodyId(body), w| {
            sums[body].add(motions[body].pose.r - center(body), w.force, w.torque);
        });
    }
    let balance = |(k, mut sum): (usize, ForceSum)| {
        let body = &model.bodies[k];
        sum.add(Vec2::zero(), model.gravity.scale(body.mass), 0.0);
        let [x, y] = measured::point(model, BodyId(k), body.center, motions, a);
        let alpha = model.layout.bodies[k].of(a)[2];
        let [fx, fy] = [sum.force[0] - body.mass * x.second, sum.force[1] - body.mass * y.second];
        let moment = if body.turns { (sum.moment - body.inertia * alpha).abs() } else { 0.0 };
        BodyBalance { force: fx.hypot(fy), moment, ..sum.of }
    };
    let bodies = sums.into_iter().enumerate().skip(1).map(balance).list();
    Balances { bodies, coordinates: of_coordinates(model, motions, acting) }
}

/// The balances of the internal coordinates.
fn of_coordinates(
    model: &Model,
    motions: &Motions,
    acting: Acting<'_, f64>,
) -> Vec<CoordinateBalance> {
    let layout = &model.layout;
    let first = layout.bodies.iter().map(|body| body.count).sum::<usize>();
    let mut sums = vec![CoordinateBalance::default(); layout.n_q - first];
    let lam = acting.lam.unwrap_or_default();
    let mut entries = vec![0.0; if sums.is_empty() { 0 } else { layout.n_entries }];
    for (k, slots) in layout.constraints.iter().enumerate() {
        let own = || slots.blocks.iter().filter(|block| block.columns.first >= first);
        if own().next().is_none() {
            continue;
        }
        linearize_one(model, k, motions, acting.t, &mut |_, columns| {
            store(columns, slots, &mut entries);
        });
        for (block, (r, row)) in
            own().flat_map(|b| slots.rows.clone().enumerate().map(move |r| (b, r)))
        {
            for (column, at) in block.columns.range().zip(block.row(r)) {
                let (sum, effort) = (&mut sums[column - first], lam[row] * entries[at]);
                sum.effort += effort;
                sum.largest_effort = sum.largest_effort.max(effort.abs());
                sum.lever = sum.lever.max(entries[at].abs());
            }
        }
    }
    sums.iter_mut().for_each(|sum| sum.effort = sum.effort.abs());
    sums
}

/// Adds the reactions of all joints and drivers, each at its reported point.
fn add_reactions(
    model: &Model,
    motions: &Motions,
    acting: Acting<'_, f64>,
    center: &impl Fn(usize) -> Vec2,
    sums: &mut [ForceSum],
) {
    let lam = acting.lam.unwrap_or_default();
    for (k, slots) in model.layout.constraints.iter().enumerate() {
        if model.constraints[k].group == Group::Forces {
            continue; // reported as a force
        }
        let own = &lam[slots.rows.clone()];
        for on in touched(model, k) {
            let found = reaction(model, k, on, Frame::Global, motions, acting.t, own);
            let w = found.unwrap_or_else(Wrench::zero);
            let arm = place(model, k, on, motions, acting.t) - center(on.0);
            let sum = &mut sums[on.0];
            sum.of.lever = sum.of.lever.max(arm.norm());
            sum.add(arm, w.force, w.torque);
        }
    }
}
