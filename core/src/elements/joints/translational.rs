//! Translational joint (Haug 3.3.13, 3.3.14): body j slides along a line fixed in body i and does not rotate relative
//! to it.
//!
//! With uᵢ = Aᵢ u′ᵢ along the slide, nᵢ = uᵢ turned by +90° and dᵢⱼ = rⱼ + Aⱼ s′ⱼ - rᵢ - Aᵢ s′ᵢ: Φ₁ = nᵢᵀ dᵢⱼ = 0,
//! the distance of point j from the line, m; Φ₂ = φⱼ + aⱼ - φᵢ - aᵢ = 0, rad, with a the angle of the slide in each
//! body. The second equation of the book contains the sine of this angle (3.3.14), which is also zero for a slide
//! turned by 180°; Φ₂ is not. Positions that differ by whole turns of φⱼ - φᵢ are different positions for Φ₂.

use crate::elements::{
    element, measure, At, Attachment, BodyId, Equation, Fixes, Joint, Linearized, Mark, Measured,
    Moving, SceneSymbol, SymbolEnd,
};
use crate::math::{Local, Pose, Real, Rotation, ShortArray, Vec2};

element! {
    /// Translational joint: body j slides along a line of body i and does not rotate relative to
    /// body i (Haug 3.3.13, 3.3.14). The line passes through point i along the slide. Φ1 is the
    /// distance of point j from the line, positive on its left. Φ2 = angle_j + axes_j - angle_i -
    /// axes_i. The force of the joint is normal to the slide: +λ1 along the normal on body i, and
    /// -λ1 on body j.
    Translational, "translational" {
        /// Point of body i on the slide, as `body.point`.
        i: point,
        /// Point of body j on the slide, as `body.point`.
        j: point,
        /// Angles of the slide, the x axis of the joint frame, in the frames of body i and body j.
        axes: pair [rad] = [0.0, 0.0],
    }
}

/// The directions along the slide (u) and to its left (n), in global components.
fn directions<S: Real>(e: &Translational<S>, i: &Pose<S>) -> (Vec2<S>, Vec2<S>) {
    let axis = Rotation::new(e.axes[0]);
    let u = i.global(Local::new(axis.cos, axis.sin));
    (u, u.perp())
}

impl Joint for Translational {
    const CONDENSES: bool = true;

    const RUBS: bool = true;
    const MEASURED: &'static [Measured] = &[Measured::DISPLACEMENT];

    fn bodies<S>(e: &Translational<S>) -> Vec<BodyId> {
        vec![e.i.body, e.j.body]
    }

    fn equations<S>(_: &Translational<S>) -> Vec<Equation> {
        vec![Equation::length("normal"), Equation::angle("angle")]
    }

    fn residual<S: Real>(e: &Translational<S>, at: &At<'_, S>, phi: &mut [S]) {
        let (_, n) = directions(e, at.i());
        let apart = at.j().point(e.j.s) - at.i().point(e.i.s);
        phi.copy_from_slice(&[n.dot(apart), turned(e, at.i(), at.j())]);
    }

    fn measure<S: Real>(e: &Translational<S>, at: &At<'_, S>, out: &mut [S]) {
        out[0] = measure::along(at, e.axes[0], &e.i, &e.j);
    }

    fn symbols(e: &Translational) -> Vec<SceneSymbol> {
        let [i, j] = [(&e.i, 0), (&e.j, 1)].each(|(on, k)| SymbolEnd::point(on).along(e.axes[k]));
        vec![SceneSymbol::new(Mark::Slide, i, j)]
    }

    fn attachment<S: Real>(e: &Translational<S>, body: usize) -> Attachment<S> {
        match body {
            0 => Attachment { s: e.i.s, axis: e.axes[0] },
            _ => Attachment { s: e.j.s, axis: e.axes[1] },
        }
    }

    fn fixes<S: Clone>(_: &Translational<S>) -> Vec<Fixes<S>> {
        vec![Fixes::Line, Fixes::Direction]
    }

    /// Closed form, with e = rⱼ + Aⱼ s′ⱼ - rᵢ: Φ_q = [-nᵢᵀ, -uᵢᵀ e, nᵢᵀ, uᵢᵀ Aⱼ s′ⱼ; 0 0 -1, 0 0 1], since
    /// nᵢᵀ Aᵢ s′ᵢ is constant; γ₁ = φ̇ⱼ² nᵢᵀ Aⱼ s′ⱼ + 2 φ̇ᵢ uᵢᵀ ė + φ̇ᵢ² nᵢᵀ e.
    fn linearize<S: Real>(e: &Translational<S>, at: &Moving<'_, S>, out: Linearized<'_, S>) {
        let [i, j] = [&at.bodies[0], &at.bodies[1]];
        let (u, n) = directions(e, &i.pose);
        let (w_i, w_j) = (i.twist.omega, j.twist.omega);
        let arm = j.pose.global(e.j.s);
        let from_i = j.pose.r + arm - i.pose.r;
        let speed = j.twist.velocity + arm.perp().scale(w_j) - i.twist.velocity;
        let (two, zero, one) = (S::constant(2.0), S::zero(), S::one());
        let gamma = w_j * w_j * n.dot(arm) + two * w_i * u.dot(speed) + w_i * w_i * n.dot(from_i);
        let apart = j.pose.point(e.j.s) - i.pose.point(e.i.s);
        let terms = [
            [n.dot(apart), turned(e, &i.pose, &j.pose)],
            [n.dot(speed) - w_i * u.dot(from_i), w_j - w_i],
            [gamma, zero],
        ];
        let (of_i, of_j) = ([-n.x, -n.y, -u.dot(from_i)], [n.x, n.y, u.dot(arm)]);
        out.put(terms, [of_i, [zero, zero, -one], of_j, [zero, zero, one]]);
    }
}

/// The angle between the slide directions fixed in the two bodies.
fn turned<S: Real>(e: &Translational<S>, i: &Pose<S>, j: &Pose<S>) -> S {
    (j.angle + e.axes[1]) - (i.angle + e.axes[0])
}
