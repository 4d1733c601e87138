//! Detection of stiffness for the automatic choice of the method: DOP853, or Radau if the equations are stiff.
//!
//! `initial_stiffness` checks the model at the start. This module checks the steps during the run.
//!
//! Stiffness cannot be read from a single number of a model: a damper of 1e7 N·m·s/rad is soft on a heavy rocker, and
//! a system that is stiff over a second is not stiff over a microsecond. Therefore the steps of the explicit method
//! are checked from time to time. If the stability of a damped motion of the linearised equations limits the steps (h
//! |λ| ≈ 6.1 for DOP853, the value of its authors), accuracy would allow longer steps, and Radau takes over. Undamped
//! vibrations do not count, because an implicit method needs steps of the same length to follow them.
//!
//! Radau is of lower order, so stability alone does not make it cheaper. If its steps are not longer by the factor
//! [`WORTH`], DOP853 takes over again, and the next check is later.
//!
//! |λ| is computed by power iteration on differences of the accelerations (as in the code RKC of Sommeijer, Shampine
//! and Verwer, *RKC: an explicit solver for parabolic PDEs*, J. Comput. Appl. Math. 88 (1998) 315), which begins with
//! the vector of the last check. The quadratic equation of its last images shows whether the motion is damped.

use crate::equations::{Gains, Workspace};
use crate::integrate::Step;
use crate::math::{Listed, ShortArray};
use crate::model::{column_scales, Model};

/// Length of the stability region of DOP853 along the negative real axis.
pub(super) const LIMIT: f64 = 6.1;
/// Fraction of this limit from which steps count as limited by stability.
const NEAR: f64 = 0.6;
/// Smallest value of -Re λ / |λ| for a motion that counts as damped.
const DAMPED: f64 = 0.3;
/// Number of steps before the first check, and smallest number of steps between checks.
const FIRST_LOOK: usize = 15;
/// Number of steps until the next check, divided by the number of steps so far.
const NEXT_LOOK: f64 = 0.25;
/// The method changes only if more steps than this remain.
pub(super) const TO_GO: f64 = 100.0;
/// Number of steps of Radau between its checks.
pub(super) const TRIAL: usize = 20;
/// Factor by which the steps of Radau must be longer: the cost of a step of Radau relative to a step of DOP853.
pub(super) const WORTH: f64 = 2.0;
/// Double applications of the Jacobian in a check.
const ITERATIONS: usize = 3;
/// Relative size of the finite differences.
const DIFFERENCE: f64 = 1e-7;

/// The chosen method and the reason.
#[derive(Clone, Debug, PartialEq)]
pub struct MethodChoice {
    /// The method at the end: its `type` in a file.
    pub method: &'static str,
    /// The reason.
    pub why: String,
}

/// The fastest motion of the linearised equations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Fastest {
    /// |λ|, 1/s.
    pub rate: f64,
    pub damped: bool,
}

/// Watches the steps of the explicit method.
pub(super) struct StiffnessDetector<'a> {
    model: &'a Model,
    workspace: Workspace,
    /// The vector of the power iteration: (q part, v part, z part), and its two images. Lengths are relative to the
    /// size of the mechanism.
    x: [Vec<f64>; 3],
    /// Scale of each component.
    scales: Vec<f64>,
    steps: usize,
    next: usize,
    since: (usize, f64),
    /// Rate of a damped motion that is predicted at the start to limit the steps.
    pub predicted: Option<f64>,
    /// Result of the last check: the fastest motion, and the mean step.
    pub seen: Option<(Fastest, f64)>,
}

impl<'a> StiffnessDetector<'a> {
    /// Uses the elimination plan of the equations of motion of this run.
    pub fn new(model: &'a Model, one: &Workspace, t0: f64) -> Self {
        let n = 2 * model.layout.n_q + model.layout.n_z;
        let columns = column_scales(model);
        let ones = std::iter::repeat_n(1.0, model.layout.n_z);
        let scales = columns.iter().chain(&columns).copied().chain(ones).list();
        Self {
            model,
            workspace: Workspace::like(model, one),
            scales,
            x: [arbitrary(n), vec![0.0; n], vec![0.0; n]],
            steps: 0,
            next: FIRST_LOOK,
            since: (0, t0),
            predicted: None,
            seen: None,
        }
    }

    /// Omits the same rows as `one`, and holds the same pieces of switches.
    pub fn follow(&mut self, one: &Workspace) {
        self.workspace.motions.pieces.clone_from(&one.motions.pieces);
        if self.workspace.matrix.omitted() != one.matrix.omitted() {
            self.workspace.omit(one.matrix.omitted());
        }
    }

    /// Whether the explicit method should stop after this step.
    pub fn stiff(&mut self, step: &Step<'_>, t_end: f64) -> bool {
        self.steps += 1;
        if self.predicted.is_some_and(|rate| (step.t - step.t_old) * rate > NEAR * LIMIT) {
            self.predicted = None;
            self.since = (self.steps - 1, step.t_old);
        } else if self.steps < self.next {
            return false;
        }
        let h = (step.t - self.since.1) / (self.steps - self.since.0) as f64;
        self.wait(1.0);
        self.since = (self.steps, step.t);
        let Some(fastest) = self.fastest(step.t, step.y) else { return false };
        self.seen = Some((fastest, h));
        // backward in time damped motions grow, and an implicit method is no better
        let to_go = (t_end - step.t) / h;
        h > 0.0 && to_go > TO_GO && fastest.damped && h * fastest.rate > NEAR * LIMIT
    }

    /// Schedules the next check, `times` later than usual.
    pub fn wait(&mut self, times: f64) {
        let steps = (times * NEXT_LOOK * self.steps as f64) as usize;
        self.next = self.steps + steps.max((times * FIRST_LOOK as f64) as usize);
    }

    /// Restarts the detection where the explicit method continues from `t`.
    pub fn resume(&mut self, t: f64) {
        self.since = (self.steps, t);
        self.next = self.next.max(self.steps + FIRST_LOOK);
    }

    /// Accelerations at a state, and their rate along the motion from a difference over the time `probe`, s. None
    /// where the equations are singular.
    pub fn rates(&mut self, t: f64, y: &[f64], probe: f64) -> Option<[Vec<f64>; 2]> {
        let [q, v, z, _] = self.model.layout.split(y);
        let [a, dz] = self.respond(t, [q, v, z])?;
        let moved = |x: &[f64], rate: &[f64]| -> Vec<f64> {
            x.iter().zip(rate).map(|(x, rate)| x + probe * rate).list()
        };
        let (q, v, z) = (moved(q, v), moved(v, &a), moved(z, &dz));
        let [later, _] = self.respond(t + probe, [&q, &v, &z])?;
        let jerk = later.iter().zip(&a).map(|(new, a)| (new - a) / probe).list();
        Some([a, jerk])
    }

    /// q̈ and ż at a state.
    fn respond(&mut self, t: f64, state: [&[f64]; 3]) -> Option<[Vec<f64>; 2]> {
        self.workspace.accelerate(self.model, t, state, Gains::default()).ok()?;
        let mut dz = vec![0.0; self.model.layout.n_z];
        self.workspace.state_rates(self.model, t, &mut dz);
        Some([self.workspace.a().to_vec(), dz])
    }

    /// The fastest motion of the equations linearised at a state. None where the equations are singular.
    pub fn fastest(&mut self, t: f64, y: &[f64]) -> Option<Fastest> {
        let n = self.model.layout.n_q;
        let [q, v, z, _] = self.model.layout.split(y);
        let [a, dz] = self.respond(t, [q, v, z])?;
        let scales = self.scales.clone();
        let [columns, ..] = parts(n, &scales);
        let relative = |x: &[f64]| x.iter().zip(columns).map(|(x, scale)| x / scale).list();
        let reach = largest(&relative(q)).max(1e-3);
        for _ in 0..ITERATIONS {
            for k in 0..2 {
                let [of_q, of_v, of_z] = parts(n, &self.x[k]);
                let size = largest(of_q) / reach
                    + largest(of_v) / largest(&relative(v)).max(reach)
                    + largest(of_z) / largest(z).max(reach);
                let epsilon = DIFFERENCE / size;
                if !(epsilon.is_finite() && epsilon > 0.0) {
                    self.x[0] = arbitrary(self.x[0].len());
                    return None;
                }
                let moved = |y: &[f64], x: &[f64], scales: &[f64]| -> Vec<f64> {
                    let parts = y.iter().zip(x).zip(scales);
                    parts.map(|((y, x), scale)| y + epsilon * x * scale).list()
                };
                let [q, v] = [(q, of_q), (v, of_v)].each(|(y, x)| moved(y, x, columns));
                let z = moved(z, of_z, &scales[2 * n..]);
                let [near_a, near_dz] = self.respond(t, [&q, &v, &z])?;
                let images = near_a.iter().zip(&a).chain(near_dz.iter().zip(&dz));
                let (from, to) = self.x.split_at_mut(k + 1);
                to[0][..n].copy_from_slice(&from[k][n..2 * n]);
                to[0][n..]
                    .iter_mut()
                    .zip(images)
                    .zip(&scales[n..])
                    .for_each(|((to, (near, x)), scale)| *to = (near - x) / (epsilon * scale));
            }
            self.x.rotate_left(2);
            let scale = 1.0 / largest(&self.x[0]).max(f64::MIN_POSITIVE);
            // the other vectors are rotated too, so that all three yield the quadratic equation
            for x in &mut self.x {
                x.iter_mut().for_each(|x| *x *= scale);
            }
        }
        // after the rotation: J² x, x, J x
        let [last, first, second] = &self.x;
        let found = dominant(n, first, second, last);
        if found.is_none() {
            // bodies that move freely leave no vector with which the next check could begin
            self.x[0] = arbitrary(last.len());
        }
        found
    }
}

/// An arbitrary vector, which has a component in every motion.
fn arbitrary(n: usize) -> Vec<f64> {
    (0..n).map(|k| (1.0 + 0.7 * k as f64).sin()).list()
}

/// The dominant λ from x, J x and J² x, each with a q part of length n: J² x = s J x - p x holds for one pair of
/// eigenvalues. The other parts are divided by |λ|, so that all parts have equal weight.
fn dominant(n: usize, x: &[f64], jx: &[f64], jjx: &[f64]) -> Option<Fastest> {
    let plain = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let weight = (plain(&x[n..], &x[n..]) / plain(&jjx[n..], &jjx[n..])).sqrt();
    let dot = |a: &[f64], b: &[f64]| plain(&a[..n], &b[..n]) + weight * plain(&a[n..], &b[n..]);
    let (xx, xj, jj) = (dot(x, x), dot(x, jx), dot(jx, jx));
    let determinant = xx * jj - xj * xj;
    let (re, size) = if determinant <= 1e-6 * xx * jj {
        (xj / xx, (xj / xx).abs())
    } else {
        let (bx, bj) = (dot(jjx, x), dot(jjx, jx));
        let s = (bj * xx - bx * xj) / determinant;
        let p = (bj * xj - bx * jj) / determinant;
        let discriminant = 0.25 * s * s - p;
        if discriminant < 0.0 {
            (0.5 * s, p.sqrt())
        } else {
            let root = 0.5 * s + discriminant.sqrt().copysign(s);
            (root, root.abs())
        }
    };
    size.is_finite().then_some(Fastest { rate: size, damped: -re > DAMPED * size })
}

/// The q, v and z parts of a vector of the power iteration.
fn parts(n: usize, x: &[f64]) -> [&[f64]; 3] {
    [&x[..n], &x[n..2 * n], &x[2 * n..]]
}

fn largest(x: &[f64]) -> f64 {
    x.iter().fold(0.0, |most: f64, x| most.max(x.abs()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn damped_and_undamped_pairs_are_distinguished() {
        let pair = |re: f64, im: f64| {
            // one coordinate: q̈ = 2 re q̇ - (re² + im²) q
            let times = |[q, v]: [f64; 2]| [v, 2.0 * re * v - (re * re + im * im) * q];
            // a real pair has the form that the power iteration returns
            let x = if im == 0.0 { [1.0, re] } else { [1.0, 0.3 * im] };
            dominant(1, &x, &times(x), &times(times(x))).expect("finite")
        };
        let close = |found: f64, expected: f64| (found - expected).abs() < 1e-9 * expected;
        assert!(close(pair(0.0, 50.0).rate, 50.0) && !pair(0.0, 50.0).damped);
        assert!(close(pair(-3.0, 4.0).rate, 5.0) && pair(-3.0, 4.0).damped);
        assert!(close(pair(-1e4, 0.0).rate, 1e4) && pair(-1e4, 0.0).damped);
        assert!(!pair(20.0, 0.0).damped);
    }
}
