//! Flat face on a curve: a straight line of body i touches the curve C(u) of body j.
//!
//! The line passes through Pᵢ with the direction u of `axis`, and n = u turned by +90°: Φ₁ = nᵀ (C(u) - Pᵢ) = 0, the
//! distance of the curve from the line, and Φ₂ = nᵀ C′/|C′| = 0, the sine of the angle between the curve and the
//! line. Since ∂Φ₁/∂u = nᵀ C′ = 0 in contact, the row of the massless u leaves λ₂ = 0: the force is λ₁ along the
//! normal of the line and acts at the point of contact C(u). The curve must be strictly convex, because otherwise Φ₂
//! does not determine u.

use crate::elements::{
    contact, derive, element, At, Attachment, BodyId, CurveOn, Equation, Fixes, Joint, Linearized,
    Mark, Moving, ResultQuantity, SceneSymbol, SymbolEnd,
};
use crate::math::{Listed, Local, Pose, Real, Rotation, Vec2};

element! {
    /// Flat face on a curve: a straight line of body i touches the curve C(u) of body j. The line
    /// passes through P_i at the angle `axis`, and n is its left normal. Φ1 = n·(C(u) - P_i) and
    /// Φ2 = n·C'/|C'|. The force acts at the point of contact: -λ1 n on body j, and +λ1 n on body
    /// i. A positive `normal` presses the face onto the curve.
    FlatOnCurve, "flat_on_curve" {
        /// Point of the face on body i, as `body.point`.
        i: point,
        /// Curve of body j, as `body.curve`.
        curve: curve,
        /// Angle of the face in the frame of body i.
        axis: number [rad] = 0.0,
    }
}

/// The normal of the face, to its left.
fn normal<S: Real>(e: &FlatOnCurve<S>, i: &Pose<S>) -> Vec2<S> {
    let axis = Rotation::new(e.axis);
    i.global(Local::new(-axis.sin, axis.cos))
}

impl Joint for FlatOnCurve {
    const OWN: usize = 1;
    const RESULTS: &'static [ResultQuantity] =
        &[ResultQuantity { name: "normal", unit: "N", negative: Some("lift_off") }];

    fn bodies<S>(e: &FlatOnCurve<S>) -> Vec<BodyId> {
        vec![e.i.body, e.curve.body]
    }

    fn equations<S>(_: &FlatOnCurve<S>) -> Vec<Equation> {
        vec![Equation::length("distance"), Equation::angle("angle")]
    }

    fn residual<S: Real>(e: &FlatOnCurve<S>, at: &At<'_, S>, phi: &mut [S]) {
        let n = normal(e, at.i());
        let [c, first] = e.curve.curve.tangent(at.own[0]);
        let apart = at.j().point(c) - at.i().point(e.i.s);
        let tangent = at.j().global(first.scale(S::one() / first.norm()));
        phi.copy_from_slice(&[n.dot(apart), n.dot(tangent)]);
    }

    /// The force on body j along the inward normal of the curve: λ₁ n·ν, with ν towards the side on which the
    /// curve has no centre of curvature.
    fn results<S: Real>(e: &FlatOnCurve<S>, at: &At<'_, S>, lam: &[S], out: &mut [S]) {
        let [_, first, second, _] = e.curve.curve.derivatives(at.own[0]);
        let right = at.j().global(-first.perp());
        let along = normal(e, at.i()).dot(right) * first.cross(second);
        out[0] = S::select(along, lam[0], -lam[0]);
    }

    fn symbols(e: &FlatOnCurve) -> Vec<SceneSymbol> {
        let (i, j) = (SymbolEnd::point(&e.i).along(e.axis), SymbolEnd::body(e.curve.body));
        vec![SceneSymbol::new(Mark::Face, i, j)]
    }

    fn attachment<S: Real>(e: &FlatOnCurve<S>, body: usize) -> Attachment<S> {
        match body {
            0 => Attachment { s: e.i.s, axis: e.axis },
            _ => Attachment { s: Local::zero(), axis: S::zero() },
        }
    }

    fn contact<S: Real>(e: &FlatOnCurve<S>, at: &At<'_, S>) -> Option<Local<S>> {
        Some(e.curve.curve.point(at.own[0]))
    }

    fn curve<S>(e: &FlatOnCurve<S>) -> Option<&CurveOn<S>> {
        Some(&e.curve)
    }

    fn curve_mut<S>(e: &mut FlatOnCurve<S>) -> Option<&mut CurveOn<S>> {
        Some(&mut e.curve)
    }

    fn fixes<S: Clone>(_: &FlatOnCurve<S>) -> Vec<Fixes<S>> {
        vec![Fixes::Contact]
    }

    /// The point nearest to the face, among the points where the curve is parallel to the face.
    fn own_start(e: &FlatOnCurve, bodies: &[Pose]) -> Vec<f64> {
        let curve = &e.curve.curve;
        let both = |u: f64| {
            let mut phi = [0.0; 2];
            Self::residual(e, &At { bodies, own: &[u], t: 0.0 }, &mut phi);
            phi
        };
        let all: Vec<f64> = contact::places(curve).list();
        let parallel = all.windows(2).filter_map(|pair| {
            let [a, b] = [both(pair[0])[1], both(pair[1])[1]];
            (a * b <= 0.0 && a != b).then(|| pair[0] + (pair[1] - pair[0]) * a / (a - b))
        });
        let distance = |u: &f64| both(*u)[0].abs();
        let nearest = parallel.min_by(|a, b| distance(a).total_cmp(&distance(b)));
        vec![nearest.unwrap_or_else(|| contact::least(curve, |u| both(u)[1].abs()))]
    }

    fn fault(e: &FlatOnCurve) -> Option<(&'static str, String)> {
        let curve = &e.curve.curve;
        if curve.fault().is_some() {
            return None; // it is reported at the curve
        }
        if let Some(message) = contact::cusp(curve) {
            return Some(("curve", message));
        }
        let bent = |u: f64| contact::curvature(&curve.derivatives(u));
        let mean = contact::places(curve).map(bent).sum::<f64>();
        let side = if mean < 0.0 { -1.0 } else { 1.0 };
        let u = contact::least(curve, |u| side * bent(u));
        let size = contact::places(curve).map(|u| bent(u).abs()).fold(0.0, f64::max);
        (side * bent(u) <= 1e-9 * size).then(|| {
            let message = format!(
                "it is not strictly convex: its curvature is {:.6} 1/m for {}; a flat face needs a curve that \
                 turns to one side everywhere",
                bent(u),
                contact::place(curve, u),
            );
            ("curve", message)
        })
    }

    fn linearize<S: Real>(e: &FlatOnCurve<S>, at: &Moving<'_, S>, out: Linearized<'_, S>) {
        let near = FlatOnCurve { i: e.i.clone(), curve: e.curve.near(at.own[0]), axis: e.axis };
        derive::linearize::<Self, S>(&near, at, out);
    }
}
