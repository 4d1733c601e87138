//! Revolute joint (Haug 3.3.10): point Pᵢ of body i and point Pⱼ of body j coincide.
//!
//! Φ = rⱼ + Aⱼ s′ⱼ - rᵢ - Aᵢ s′ᵢ = 0. Two equations; all positions are allowed.

use crate::elements::{
    element, measure, At, Attachment, BodyId, Equation, Fixes, Joint, Linearized, Mark, Measured,
    Moving, SceneSymbol,
};
use crate::math::Real;

element! {
    /// Revolute joint: point i and point j coincide, Φ = point_j - point_i (Haug 3.3.10). The force
    /// of the joint is +λ on body i and -λ on body j, in the global frame.
    Revolute, "revolute" {
        /// Point of body i, as `body.point`.
        i: point,
        /// Point of body j, as `body.point`.
        j: point,
        /// Angles of the x axis of the joint frame in the frames of body i and body j.
        axes: pair [rad] = [0.0, 0.0],
    }
}

impl Joint for Revolute {
    const RUBS: bool = true;
    const MEASURED: &'static [Measured] = &[Measured::ANGLE];
    const CONSTANT_COLUMNS: bool = true;

    fn bodies<S>(e: &Revolute<S>) -> Vec<BodyId> {
        vec![e.i.body, e.j.body]
    }

    fn equations<S>(_: &Revolute<S>) -> Vec<Equation> {
        vec![Equation::length("x"), Equation::length("y")]
    }

    fn residual<S: Real>(e: &Revolute<S>, at: &At<'_, S>, phi: &mut [S]) {
        let gap = at.j().point(e.j.s) - at.i().point(e.i.s);
        phi.copy_from_slice(&[gap.x, gap.y]);
    }

    fn measure<S: Real>(_: &Revolute<S>, at: &At<'_, S>, out: &mut [S]) {
        out[0] = measure::turned(at);
    }

    fn symbols(e: &Revolute) -> Vec<SceneSymbol> {
        vec![SceneSymbol::between_points(Mark::Pin, &e.i, &e.j)]
    }

    fn attachment<S: Real>(e: &Revolute<S>, body: usize) -> Attachment<S> {
        match body {
            0 => Attachment { s: e.i.s, axis: e.axes[0] },
            _ => Attachment { s: e.j.s, axis: e.axes[1] },
        }
    }

    fn fixes<S: Clone>(_: &Revolute<S>) -> Vec<Fixes<S>> {
        vec![Fixes::Points]
    }

    /// Closed form: Φ_q = [-I, -Bᵢ s′ᵢ, I, Bⱼ s′ⱼ] (Haug 3.3.12), γ = Aⱼ s′ⱼ φ̇ⱼ² - Aᵢ s′ᵢ φ̇ᵢ² (Haug
    /// 3.6.13 with the sign of Φ here).
    #[inline(always)] // in the loop over all revolute joints
    fn linearize<S: Real>(e: &Revolute<S>, at: &Moving<'_, S>, out: Linearized<'_, S>) {
        let [i, j] = [&at.bodies[0], &at.bodies[1]];
        let (a_i, a_j) = (i.pose.global(e.i.s), j.pose.global(e.j.s));
        let (b_i, b_j) = (a_i.perp(), a_j.perp());
        let (w_i, w_j) = (i.twist.omega, j.twist.omega);
        let gap = (j.pose.r + a_j) - (i.pose.r + a_i);
        let rate = (j.twist.velocity + b_j.scale(w_j)) - (i.twist.velocity + b_i.scale(w_i));
        let gamma = a_j.scale(w_j * w_j) - a_i.scale(w_i * w_i);
        let (zero, one) = (S::zero(), S::one());
        let of_i = [[-one, zero, -b_i.x], [zero, -one, -b_i.y]];
        let of_j = [[one, zero, b_j.x], [zero, one, b_j.y]];
        let terms = [[gap.x, gap.y], [rate.x, rate.y], [gamma.x, gamma.y]];
        out.put(terms, [of_i[0], of_i[1], of_j[0], of_j[1]]);
    }
}
