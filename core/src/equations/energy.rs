//! Energies and the powers that change their sum.
//!
//! Energy balance: T + V + dissipated energy - work of drivers - work of applied forces is constant.

use super::forces::{self, Acting};
use super::kinematics::Motions;
use crate::math::{Motion, Real, Twist};
use crate::model::{Body, Model};

/// Kinetic energy ½ q̇ᵀ M q̇, J, from the velocity of the mass centre and the moment of inertia about it.
pub fn kinetic<S: Real>(model: &Model<S>, motions: &[Motion<S>]) -> S {
    let mut twice = S::zero();
    for (body, motion) in moving(model, motions) {
        let Twist { velocity, omega } = motion.twist;
        let velocity = velocity + motion.pose.global(body.center).perp().scale(omega);
        twice = twice.plus_product(body.mass, velocity.dot(velocity));
        twice = twice.plus_product(body.inertia, omega * omega);
    }
    S::constant(0.5) * twice
}

/// The kinetic energy of motions in which those of the frame and of the mass centre about it do not cancel, J. The
/// rounding errors of forces of inertia are in proportion to it.
pub fn stirred(model: &Model, motions: &[Motion<f64>]) -> f64 {
    let of = |(body, motion): (&Body<f64>, &Motion<f64>)| {
        let Twist { velocity, omega } = motion.twist;
        let about = body.inertia + body.mass * body.center.dot(body.center);
        0.5 * (body.mass * velocity.dot(velocity) + about * omega * omega)
    };
    moving(model, motions).map(of).sum()
}

/// The largest force of inertia of a body, N, where `motions` have accelerations in place of rates. A couple J α counts
/// as a force at the arm `size`.
pub fn largest_inertia(model: &Model, motions: &[Motion<f64>], size: f64) -> f64 {
    let of = |(body, motion): (&Body<f64>, &Motion<f64>)| {
        let Twist { velocity, omega } = motion.twist;
        let velocity = velocity + motion.pose.global(body.center).perp().scale(omega);
        (body.mass * velocity.norm()).max(body.inertia * omega.abs() / size)
    };
    moving(model, motions).map(of).fold(0.0, f64::max)
}

/// Potential energy of gravity (zero at the global origin) and of the forces, J.
pub fn potential<S: Real>(model: &Model<S>, motions: &Motions<S>, z: &[S], t: S) -> S {
    let mut sum = S::zero();
    for (body, motion) in moving(model, motions) {
        sum = sum.minus_product(body.mass, model.gravity.dot(motion.pose.point(body.center)));
    }
    for k in 0..model.forces.len() {
        sum += forces::potential(model, k, motions, Acting { z, lam: None, t });
    }
    sum
}

/// All bodies except ground.
fn moving<'a, S>(
    model: &'a Model<S>,
    motions: &'a [Motion<S>],
) -> impl Iterator<Item = (&'a Body<S>, &'a Motion<S>)> {
    model.bodies.iter().zip(motions).skip(1)
}
