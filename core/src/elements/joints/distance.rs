//! Distance (Haug 3.3.8): a massless rod keeps point Pⱼ of body j at the distance l from point Pᵢ of
//! body i.
//!
//! With d = Pⱼ - Pᵢ: Φ = (dᵀ d - l²) / (2 l) = 0. The book has dᵀ d - l²; divided by 2 l, Φ is to first
//! order how much too long the rod is, in m, and λ is the pull in the rod, in N, as Φ_r = d/l has
//! length 1. No square root, so that Φ and its derivatives are finite for all d; where the points meet
//! Φ_q is zero. l > 0.

use crate::elements::{element, Attachment, BodyId, Equation, Joint, Side, VelocityTerms};
use crate::math::{Motion, Pose, Real, Vec2};

element! {
    /// Distance: a massless rod between two points, Φ = (d² - length²) / (2 length) with d the
    /// distance from point i to point j (Haug 3.3.8). The force of the rod on body i is +λ along the
    /// line from i to j, on body j -λ: λ > 0 is tension.
    Distance, "distance" {
        /// Point of body i, as `body.point`.
        i: point,
        /// Point of body j, as `body.point`.
        j: point,
        /// Length of the rod.
        length: number [m],
    }
}

impl Joint<1> for Distance {
    fn ends<S>(e: &Distance<S>) -> [BodyId; 2] {
        [e.i.body, e.j.body]
    }

    fn equations<S>(_: &Distance<S>) -> [Equation; 1] {
        [Equation { name: "length", unit: "m" }]
    }

    fn residual<S: Real>(e: &Distance<S>, i: &Pose<S>, j: &Pose<S>, _: S) -> [S; 1] {
        [excess(e, j.point(e.j.s) - i.point(e.i.s))]
    }

    fn attachment<S: Real>(e: &Distance<S>, side: Side) -> Attachment<S> {
        let s = match side {
            Side::I => e.i.s,
            Side::J => e.j.s,
        };
        Attachment { s, axis: S::zero() }
    }

    fn fault(e: &Distance) -> Option<(&'static str, String)> {
        (e.length <= 0.0).then(|| ("length", format!("{} m; must be > 0", e.length)))
    }

    /// Closed form: [-uᵀ, -uᵀ Bᵢ s′ᵢ, uᵀ, uᵀ Bⱼ s′ⱼ] with u = d/l (Haug 3.3.9, divided by 2 l).
    fn jacobian<S: Real>(e: &Distance<S>, i: &Pose<S>, j: &Pose<S>, _: S) -> [[S; 6]; 1] {
        let (a_i, a_j) = (i.global(e.i.s), j.global(e.j.s));
        let u = (j.r + a_j - (i.r + a_i)).scale(S::one() / e.length);
        [[-u.x, -u.y, -u.dot(a_i.perp()), u.x, u.y, u.dot(a_j.perp())]]
    }

    /// Closed form: γ = (dᵀ (Aⱼ s′ⱼ φ̇ⱼ² - Aᵢ s′ᵢ φ̇ᵢ²) - ḋᵀ ḋ) / l.
    fn velocity_terms<S: Real>(
        e: &Distance<S>,
        i: &Motion<S>,
        j: &Motion<S>,
        _: S,
    ) -> VelocityTerms<S, 1> {
        let (a_i, a_j) = (i.pose.global(e.i.s), j.pose.global(e.j.s));
        let (w_i, w_j) = (i.twist.omega, j.twist.omega);
        let d = j.pose.r + a_j - (i.pose.r + a_i);
        let apart = j.point_velocity(e.j.s) - i.point_velocity(e.i.s);
        let inward = a_j.scale(w_j * w_j) - a_i.scale(w_i * w_i);
        VelocityTerms {
            residual: [excess(e, d)],
            rate: [d.dot(apart) / e.length],
            gamma: [(d.dot(inward) - apart.dot(apart)) / e.length],
        }
    }
}

/// (dᵀ d - l²) / (2 l).
fn excess<S: Real>(e: &Distance<S>, d: Vec2<S>) -> S {
    (d.dot(d) - e.length * e.length) / (S::constant(2.0) * e.length)
}
