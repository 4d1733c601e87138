//! Weld: body i and body j move as one rigid body.
//!
//! With dᵢⱼ = rⱼ + Aⱼ s′ⱼ - rᵢ - Aᵢ s′ᵢ: Φ₁,₂ = dᵢⱼ = 0 as in the revolute joint (Haug 3.3.10), m; and Φ₃ = φⱼ - φᵢ -
//! angle = 0, rad. Positions that differ by whole turns of φⱼ - φᵢ are different.

use crate::elements::{
    element, At, Attachment, BodyId, Equation, Fixes, Joint, Linearized, Mark, Moving, SceneSymbol,
};
use crate::math::Real;

element! {
    /// Weld: two points coincide, and the bodies do not rotate relative to each other. Φ =
    /// (point_j - point_i, angle_j - angle_i - angle). The force of the weld is +(λ1, λ2) on body i
    /// and -(λ1, λ2) on body j, in the global frame. Its torque about the points is +λ3 on body i
    /// and -λ3 on body j.
    Weld, "weld" {
        /// Point of body i, as `body.point`.
        i: point,
        /// Point of body j, as `body.point`.
        j: point,
        /// Angle of body j relative to body i.
        angle: number [rad] = 0.0,
    }
}

impl Joint for Weld {
    fn bodies<S>(e: &Weld<S>) -> Vec<BodyId> {
        vec![e.i.body, e.j.body]
    }

    fn equations<S>(_: &Weld<S>) -> Vec<Equation> {
        vec![Equation::length("x"), Equation::length("y"), Equation::angle("angle")]
    }

    fn residual<S: Real>(e: &Weld<S>, at: &At<'_, S>, phi: &mut [S]) {
        let gap = at.j().point(e.j.s) - at.i().point(e.i.s);
        phi.copy_from_slice(&[gap.x, gap.y, at.j().angle - at.i().angle - e.angle]);
    }

    fn symbols(e: &Weld) -> Vec<SceneSymbol> {
        vec![SceneSymbol::between_points(Mark::Clamp, &e.i, &e.j)]
    }

    fn attachment<S: Real>(e: &Weld<S>, body: usize) -> Attachment<S> {
        match body {
            0 => Attachment { s: e.i.s, axis: e.angle },
            _ => Attachment { s: e.j.s, axis: S::zero() },
        }
    }

    fn fixes<S: Clone>(_: &Weld<S>) -> Vec<Fixes<S>> {
        vec![Fixes::Points, Fixes::Direction]
    }

    /// Closed form: the rows of the revolute joint (Haug 3.3.12, 3.6.13), and [0, 0, -1, 0, 0, 1] with γ₃ = 0.
    fn linearize<S: Real>(e: &Weld<S>, at: &Moving<'_, S>, out: Linearized<'_, S>) {
        let [i, j] = [&at.bodies[0], &at.bodies[1]];
        let (a_i, a_j) = (i.pose.global(e.i.s), j.pose.global(e.j.s));
        let (b_i, b_j) = (a_i.perp(), a_j.perp());
        let (w_i, w_j) = (i.twist.omega, j.twist.omega);
        let gap = (j.pose.r + a_j) - (i.pose.r + a_i);
        let rate = (j.twist.velocity + b_j.scale(w_j)) - (i.twist.velocity + b_i.scale(w_i));
        let gamma = a_j.scale(w_j * w_j) - a_i.scale(w_i * w_i);
        let turned = j.pose.angle - i.pose.angle - e.angle;
        let (zero, one) = (S::zero(), S::one());
        let terms = [[gap.x, gap.y, turned], [rate.x, rate.y, w_j - w_i], [gamma.x, gamma.y, zero]];
        let columns = [
            [-one, zero, -b_i.x],
            [zero, -one, -b_i.y],
            [zero, zero, -one],
            [one, zero, b_j.x],
            [zero, one, b_j.y],
            [zero, zero, one],
        ];
        out.put(terms, columns);
    }
}
