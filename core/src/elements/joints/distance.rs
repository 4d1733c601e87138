//! Distance (Haug 3.3.8): a massless rod keeps point Pⱼ of body j at the distance l from point Pᵢ of
//! body i.
//!
//! With d = Pⱼ - Pᵢ: Φ = (dᵀ d - l²) / (2 l) = 0. In the book, the constraint is dᵀ d - l². After the division by 2
//! l, Φ is, to first order, the elongation of the rod in m, and λ is the tension of the rod in N, because Φ_r = d/l
//! has length 1. There is no square root, so that Φ and its derivatives are finite for all d. Φ_q is zero where the
//! points coincide. l must be positive.

use crate::elements::{
    element, measure, At, Attachment, BodyId, Equation, Fixes, Joint, Linearized, Mark, Measured,
    Moving, SceneSymbol,
};
use crate::math::{Real, Vec2};

element! {
    /// Distance: a massless rod connects two points, Φ = (d² - length²) / (2 length), where d is
    /// the distance from point i to point j (Haug 3.3.8). The force of the rod along the line from
    /// i to j is +λ on body i and -λ on body j. A positive λ is tension.
    Distance, "distance" {
        /// Point of body i, as `body.point`.
        i: point,
        /// Point of body j, as `body.point`.
        j: point,
        /// Length of the rod; may use `t` and positions, for example for a hydraulic cylinder.
        length: law [m],
    }
}

impl Joint for Distance {
    const MEASURED: &'static [Measured] = &[Measured::LENGTH];

    fn bodies<S>(e: &Distance<S>) -> Vec<BodyId> {
        vec![e.i.body, e.j.body]
    }

    fn equations<S>(_: &Distance<S>) -> Vec<Equation> {
        vec![Equation::length("length")]
    }

    fn residual<S: Real>(e: &Distance<S>, at: &At<'_, S>, phi: &mut [S]) {
        phi[0] = excess(e, at.j().point(e.j.s) - at.i().point(e.i.s));
    }

    fn measure<S: Real>(e: &Distance<S>, at: &At<'_, S>, out: &mut [S]) {
        out[0] = measure::length(at, &e.i, &e.j);
    }

    fn symbols(e: &Distance) -> Vec<SceneSymbol> {
        let mark = if e.length.is_nan() { Mark::DriveCylinder } else { Mark::Rod };
        vec![SceneSymbol::between_points(mark, &e.i, &e.j)]
    }

    fn attachment<S: Real>(e: &Distance<S>, body: usize) -> Attachment<S> {
        let s = [e.i.s, e.j.s][body];
        Attachment { s, axis: S::zero() }
    }

    fn fixes<S: Clone>(e: &Distance<S>) -> Vec<Fixes<S>> {
        vec![Fixes::Distance(e.length.clone())]
    }

    fn fault(e: &Distance) -> Option<(&'static str, String)> {
        (e.length <= 0.0).then(|| ("length", format!("{} m; must be > 0", e.length)))
    }

    /// Closed form, with u = d/l: Φ_q = [-uᵀ, -uᵀ Bᵢ s′ᵢ, uᵀ, uᵀ Bⱼ s′ⱼ] (Haug 3.3.9, divided by 2 l),
    /// γ = (dᵀ (Aⱼ s′ⱼ φ̇ⱼ² - Aᵢ s′ᵢ φ̇ᵢ²) - ḋᵀ ḋ) / l.
    fn linearize<S: Real>(e: &Distance<S>, at: &Moving<'_, S>, out: Linearized<'_, S>) {
        let [i, j] = [&at.bodies[0], &at.bodies[1]];
        let (a_i, a_j) = (i.pose.global(e.i.s), j.pose.global(e.j.s));
        let (w_i, w_j) = (i.twist.omega, j.twist.omega);
        let d = j.pose.r + a_j - (i.pose.r + a_i);
        let u = d.scale(S::one() / e.length);
        let apart = j.point_velocity(e.j.s) - i.point_velocity(e.i.s);
        let inward = a_j.scale(w_j * w_j) - a_i.scale(w_i * w_i);
        out.residual[0] = excess(e, d);
        out.rate[0] = d.dot(apart) / e.length;
        out.gamma[0] = (d.dot(inward) - apart.dot(apart)) / e.length;
        out.columns[0] = [-u.x, -u.y, -u.dot(a_i.perp())];
        out.columns[1] = [u.x, u.y, u.dot(a_j.perp())];
    }
}

/// (dᵀ d - l²) / (2 l).
fn excess<S: Real>(e: &Distance<S>, d: Vec2<S>) -> S {
    (d.dot(d) - e.length * e.length) / (S::constant(2.0) * e.length)
}
