//! Φ_q and γ from Φ alone, by dual numbers and a time jet.

use super::traits::Joint;
use crate::math::{Dual, Jet, Lift, Motion, Pose, Real, Rotation, Vec2};

/// Φ, its time derivative along the motion, and the right side γ of Φ_q q̈ = γ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VelocityTerms<S, const M: usize> {
    /// Φ(q, t).
    pub residual: [S; M],
    /// Φ_q q̇ + Φ_t.
    pub rate: [S; M],
    /// γ = -d²Φ/dt² at q̈ = 0 (Haug 3.6.11).
    pub gamma: [S; M],
}

/// A pose whose three coordinates are the seeds `first`, `first + 1`, `first + 2`.
pub(crate) fn seeded<const N: usize, S: Real>(pose: &Pose<S>, first: usize) -> Pose<Dual<N, S>> {
    let angle = Dual::variable(pose.angle, first + 2);
    // sin and cos are at hand in the pose: only their slopes are new
    let (mut cos, mut sin) = (Dual::lift(pose.rotation.cos), Dual::lift(pose.rotation.sin));
    cos.slope[first + 2] = -pose.rotation.sin;
    sin.slope[first + 2] = pose.rotation.cos;
    Pose {
        r: Vec2::new(Dual::variable(pose.r.x, first), Dual::variable(pose.r.y, first + 1)),
        angle,
        rotation: Rotation { cos, sin },
    }
}

/// A pose as a function of time with the given velocity and no acceleration.
pub(crate) fn moving<S: Real>(m: &Motion<S>) -> Pose<Jet<S>> {
    let (s, c, w) = (m.pose.rotation.sin, m.pose.rotation.cos, m.twist.omega);
    let jet = |value, rate| Jet::new(value, rate, S::zero());
    Pose {
        r: Vec2::new(jet(m.pose.r.x, m.twist.velocity.x), jet(m.pose.r.y, m.twist.velocity.y)),
        angle: jet(m.pose.angle, w),
        rotation: Rotation {
            cos: Jet::new(c, -s * w, -c * w * w),
            sin: Jet::new(s, c * w, -s * w * w),
        },
    }
}

/// ∂Φ/∂(qᵢ, qⱼ) by six dual parts.
pub fn derived_jacobian<const M: usize, E: Joint<M> + ?Sized, S: Real>(
    e: &E::Over<S>,
    i: &Pose<S>,
    j: &Pose<S>,
    t: S,
) -> [[S; 6]; M] {
    let lifted = E::map(e, &mut |s: &S| Dual::<6, S>::lift(*s));
    let phi = E::residual(&lifted, &seeded(i, 0), &seeded(j, 3), Dual::lift(t));
    phi.map(|row| row.slope)
}

/// Φ, Φ̇ and γ by a jet in time; fields are constant.
pub fn derived_velocity_terms<const M: usize, E: Joint<M> + ?Sized, S: Real>(
    e: &E::Over<S>,
    i: &Motion<S>,
    j: &Motion<S>,
    t: S,
) -> VelocityTerms<S, M> {
    let lifted = E::map(e, &mut |s: &S| Jet::lift(*s));
    let time = Jet::new(t, S::one(), S::zero());
    VelocityTerms::from_jets(E::residual(&lifted, &moving(i), &moving(j), time))
}

impl<S: Real, const M: usize> VelocityTerms<S, M> {
    /// From the jet of Φ taken at q̈ = 0.
    pub fn from_jets(phi: [Jet<S>; M]) -> Self {
        Self {
            residual: phi.map(|p| p.value),
            rate: phi.map(|p| p.rate),
            gamma: phi.map(|p| -p.second),
        }
    }
}
