//! Revolute joint (Haug 3.3.10): point Pᵢ of body i and point Pⱼ of body j coincide.
//!
//! Φ = rⱼ + Aⱼ s′ⱼ - rᵢ - Aᵢ s′ᵢ = 0. Two equations, no restriction of the domain.

use crate::elements::{element, Attachment, BodyId, Equation, Joint, Side, VelocityTerms};
use crate::math::{Motion, Pose, Real, Vec2};

element! {
    /// Revolute joint: two points coincide, Φ = point_j - point_i (Haug 3.3.10).
    /// The force of the joint on body i is +λ, on body j is -λ, in the global frame.
    Revolute, "revolute" {
        /// Point of body i, as `body.point`.
        i: point,
        /// Point of body j, as `body.point`.
        j: point,
        /// Angle of the joint frame's x axis in the frame of body i and of body j.
        axes: pair [rad] = [0.0, 0.0],
    }
}

impl Joint<2> for Revolute {
    const PINS: bool = true;

    fn ends<S>(e: &Revolute<S>) -> [BodyId; 2] {
        [e.i.body, e.j.body]
    }

    fn equations<S>(_: &Revolute<S>) -> [Equation; 2] {
        [Equation { name: "x", unit: "m" }, Equation { name: "y", unit: "m" }]
    }

    fn residual<S: Real>(e: &Revolute<S>, i: &Pose<S>, j: &Pose<S>, _: S) -> [S; 2] {
        let gap = j.point(e.j.s) - i.point(e.i.s);
        [gap.x, gap.y]
    }

    fn attachment<S: Real>(e: &Revolute<S>, side: Side) -> Attachment<S> {
        match side {
            Side::I => Attachment { s: e.i.s, axis: e.axes[0] },
            Side::J => Attachment { s: e.j.s, axis: e.axes[1] },
        }
    }

    /// Closed form: [-I, -Bᵢ s′ᵢ, I, Bⱼ s′ⱼ] (Haug 3.3.12).
    fn jacobian<S: Real>(e: &Revolute<S>, i: &Pose<S>, j: &Pose<S>, _: S) -> [[S; 6]; 2] {
        rows(i.global(e.i.s), j.global(e.j.s))
    }

    /// Closed form: γ = Aⱼ s′ⱼ φ̇ⱼ² - Aᵢ s′ᵢ φ̇ᵢ² (Haug 3.6.13 with the sign of Φ here).
    fn velocity_terms<S: Real>(
        e: &Revolute<S>,
        i: &Motion<S>,
        j: &Motion<S>,
        _: S,
    ) -> VelocityTerms<S, 2> {
        terms(i, i.pose.global(e.i.s), j, j.pose.global(e.j.s))
    }

    fn linearize<S: Real>(
        e: &Revolute<S>,
        i: &Motion<S>,
        j: &Motion<S>,
        _: S,
    ) -> (VelocityTerms<S, 2>, [[S; 6]; 2]) {
        let (a_i, a_j) = (i.pose.global(e.i.s), j.pose.global(e.j.s));
        (terms(i, a_i, j, a_j), rows(a_i, a_j))
    }
}

/// Φ_q with the arms Aᵢ s′ᵢ and Aⱼ s′ⱼ.
#[inline(always)]
fn rows<S: Real>(a_i: Vec2<S>, a_j: Vec2<S>) -> [[S; 6]; 2] {
    let (b_i, b_j) = (a_i.perp(), a_j.perp());
    let (zero, one) = (S::zero(), S::one());
    [[-one, zero, -b_i.x, one, zero, b_j.x], [zero, -one, -b_i.y, zero, one, b_j.y]]
}

/// Φ, Φ̇ and γ with the same arms.
#[inline(always)]
fn terms<S: Real>(i: &Motion<S>, a_i: Vec2<S>, j: &Motion<S>, a_j: Vec2<S>) -> VelocityTerms<S, 2> {
    let (w_i, w_j) = (i.twist.omega, j.twist.omega);
    let gap = (j.pose.r + a_j) - (i.pose.r + a_i);
    let rate =
        (j.twist.velocity + a_j.perp().scale(w_j)) - (i.twist.velocity + a_i.perp().scale(w_i));
    let gamma = a_j.scale(w_j * w_j) - a_i.scale(w_i * w_i);
    VelocityTerms { residual: [gap.x, gap.y], rate: [rate.x, rate.y], gamma: [gamma.x, gamma.y] }
}
