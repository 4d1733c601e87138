//! Second derivatives of the equations of motion.
//!
//! The second derivatives of a function along two lines, with the directions y + x and y - x, give the mixed derivative:
//! F″[x, y] = (F″[y + x, y + x] - F″[y - x, y - x]) / 4. Jets contain the second derivative along a line. The forces are
//! evaluated over jets here, and γ contains the second derivative of Φ.

use super::forces::{self, Acting};
use super::kinematics::Motions;
use super::mass;
use super::sensitivity::{Sensitivity, Slope};
use crate::math::{Jet, Lift, Listed, Real, Vec2};
use crate::model::Model;

/// A direction of coordinates, rates and accelerations, each of shape (n_q).
pub type Direction<'a> = [&'a [f64]; 3];

/// The mixed second derivative of M a - Q along the directions `x` and `y`, shape (n_q). The parameters of the model
/// have the rates of `y`. The model must have neither first-order states nor forces that depend on reactions.
pub fn of_forces(
    model: &Model<Jet>,
    (t, at): (f64, Direction<'_>),
    x: Direction<'_>,
    y: Direction<'_>,
) -> Vec<f64> {
    let n = model.layout.n_q;
    let along = |sign: f64| {
        let jets = |k: usize| -> Vec<Jet> {
            (0..n).map(|c| Jet::new(at[k][c], y[k][c] + sign * x[k][c], 0.0)).list()
        };
        unbalanced(model, t, [&jets(0), &jets(1), &jets(2)])
    };
    let (upper, lower) = (along(1.0), along(-1.0));
    upper.iter().zip(&lower).map(|(a, b)| (a.second - b.second) / 4.0).list()
}

/// M a - Q over jets.
fn unbalanced(model: &Model<Jet>, t: f64, [q, v, a]: [&[Jet]; 3]) -> Vec<Jet> {
    let layout = &model.layout;
    let motions = Motions::at(layout, q, v);
    let mut out = vec![Jet::zero(); layout.n_q];
    mass::add_times(model, &motions, a, &mut out);
    for (k, body) in model.bodies.iter().enumerate().skip(1) {
        let weight = Vec2::new(body.mass * model.gravity.x, body.mass * model.gravity.y);
        let w = forces::off_center(body, &motions[k], weight);
        layout.bodies[k].add([-w.force.x, -w.force.y, -w.torque], &mut out);
    }
    let acting = Acting { z: &[], lam: None, t: Jet::lift(t) };
    for (k, item) in model.forces.iter().enumerate() {
        let at = forces::situation(model, k, &motions, acting);
        let element = forces::at_state(model, item, &motions, acting);
        element.action(&at, &mut |_: usize, body: usize, w: crate::math::Wrench<Jet>| {
            let columns = layout.bodies[at.bodies[body].0];
            columns.add([-w.force.x, -w.force.y, -w.torque], &mut out);
        });
    }
    out
}

impl Sensitivity {
    /// Φ_qq[u, x] with derivatives at a position, shape (n_rows).
    pub fn curvature(&self, (t, q): (f64, &[Slope]), u: &[Slope], x: &[f64]) -> Vec<Slope> {
        let size =
            |of: &mut dyn Iterator<Item = f64>| of.fold(0.0, |most: f64, x| most.max(x.abs()));
        let own = size(&mut u.iter().flat_map(|u| u.slope.into_iter().chain([u.value])));
        let other = size(&mut x.iter().copied());
        let m = self.model.layout.n_rows;
        if own == 0.0 || other == 0.0 {
            return vec![Slope::zero(); m];
        }
        let gamma = |sign: f64| {
            let sum = |(u, x): (&Slope, &f64)| {
                *u * Slope::constant(1.0 / own) + Slope::constant(sign * x / other)
            };
            let v: Vec<Slope> = u.iter().zip(x).map(sum).list();
            self.terms(Slope::constant(t), q, &v)[2].clone()
        };
        let (upper, lower, scale) = (gamma(1.0), gamma(-1.0), Slope::constant(own * other / 4.0));
        upper.iter().zip(&lower).map(|(a, b)| (*b - *a) * scale).list()
    }

    /// Φ_q at the present motions, times a vector.
    pub fn times(&self, x: &[f64]) -> Vec<Slope> {
        let x: Vec<Slope> = x.iter().map(|x| Slope::constant(*x)).list();
        let mut out = vec![Slope::zero(); self.model.layout.n_rows];
        super::constraints::times_all(&self.model, &self.jacobian, &x, &mut out);
        out
    }
}
