//! Point on a curve: Φ = Pᵢ - C(u) = 0 with C(u) a curve in the frame of body j and u an internal coordinate.
//!
//! Since u has no mass, its row in the equations of motion is C′ᵀ λ = 0: the force is normal to the curve. It acts at
//! the point of contact. |C′| must be positive. An open curve ends at its range.

use crate::elements::{
    contact, derive, element, At, Attachment, BodyId, CurveOn, Equation, Fixes, Joint, Linearized,
    Mark, Moving, SceneSymbol, SymbolEnd,
};
use crate::math::{Local, Pose, Real};

element! {
    /// Point on a curve: a point of body i stays on a curve of body j. Φ = P_i - C(u), where C(u)
    /// is the curve in the frame of body j. The parameter u of the contact is an unknown. The force
    /// is normal to the curve: +λ on body j, and -λ on body i.
    PointOnCurve, "point_on_curve" {
        /// Point of body i, as `body.point`.
        i: point,
        /// Curve of body j, as `body.curve`.
        curve: curve,
    }
}

impl Joint for PointOnCurve {
    const OWN: usize = 1;

    fn bodies<S>(e: &PointOnCurve<S>) -> Vec<BodyId> {
        vec![e.i.body, e.curve.body]
    }

    fn equations<S>(_: &PointOnCurve<S>) -> Vec<Equation> {
        vec![Equation::length("x"), Equation::length("y")]
    }

    fn residual<S: Real>(e: &PointOnCurve<S>, at: &At<'_, S>, phi: &mut [S]) {
        let gap = at.i().point(e.i.s) - at.j().point(e.curve.curve.point(at.own[0]));
        phi.copy_from_slice(&[gap.x, gap.y]);
    }

    fn symbols(e: &PointOnCurve) -> Vec<SceneSymbol> {
        let (i, j) = (SymbolEnd::point(&e.i), SymbolEnd::body(e.curve.body));
        vec![SceneSymbol::new(Mark::Touch, i, j)]
    }

    fn attachment<S: Real>(e: &PointOnCurve<S>, body: usize) -> Attachment<S> {
        Attachment { s: [e.i.s, Local::zero()][body], axis: S::zero() }
    }

    fn contact<S: Real>(e: &PointOnCurve<S>, at: &At<'_, S>) -> Option<Local<S>> {
        Some(e.curve.curve.point(at.own[0]))
    }

    fn curve<S>(e: &PointOnCurve<S>) -> Option<&CurveOn<S>> {
        Some(&e.curve)
    }

    fn curve_mut<S>(e: &mut PointOnCurve<S>) -> Option<&mut CurveOn<S>> {
        Some(&mut e.curve)
    }

    fn fixes<S: Clone>(_: &PointOnCurve<S>) -> Vec<Fixes<S>> {
        vec![Fixes::Contact]
    }

    fn own_start(e: &PointOnCurve, bodies: &[Pose]) -> Vec<f64> {
        let p = bodies[1].rotation.inverse(bodies[0].point(e.i.s) - bodies[1].r);
        let apart = |u: f64| {
            let c = e.curve.curve.point(u);
            (c.x - p.x).hypot(c.y - p.y)
        };
        vec![contact::least(&e.curve.curve, apart)]
    }

    fn fault(e: &PointOnCurve) -> Option<(&'static str, String)> {
        contact::cusp(&e.curve.curve).map(|message| ("curve", message))
    }

    fn linearize<S: Real>(e: &PointOnCurve<S>, at: &Moving<'_, S>, out: Linearized<'_, S>) {
        let near = PointOnCurve { i: e.i.clone(), curve: e.curve.near(at.own[0]) };
        derive::linearize::<Self, S>(&near, at, out);
    }
}
