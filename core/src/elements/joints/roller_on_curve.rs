//! Roller on a curve: Φ = Pᵢ - C(u) - r ν(u) = 0 with the centre Pᵢ of the roller, its radius r, the curve C(u) in the
//! frame of body j, and ν the unit normal to the right of growing u (to the left for `side = "left"`).
//!
//! The roller is a circle around Pᵢ. It rolls or slides without friction, so that its rotation does not enter the
//! equations. Since ν′ = ±κ C′ with the curvature κ, the row of the massless u is (1 ± r κ) C′ᵀ λ = 0: the force is
//! normal to the curve and acts at the point of contact C(u). Where 1 ± r κ ≤ 0, the roller does not fit into the
//! curve (undercut).

use crate::elements::{
    contact, derive, element, At, Attachment, BodyId, CurveOn, Equation, Fixes, Joint, Linearized,
    Mark, Moving, ResultQuantity, SceneSymbol, Side, SymbolEnd,
};
use crate::math::{Local, Pose, Real};

element! {
    /// Roller on a curve: a circle of body i touches a curve of body j. Φ = P_i - C(u) - radius
    /// ν(u), where C(u) is the curve in the frame of body j and ν is its unit normal towards
    /// `side`. The right side of growing u is the outside of a counter-clockwise rim. The force is
    /// normal to the curve and acts at the point of contact: +λ on body j, and -λ on body i. A
    /// positive `normal` presses the roller onto the curve.
    RollerOnCurve, "roller_on_curve" {
        /// Centre of the roller on body i, as `body.point`.
        i: point,
        /// Curve of body j, as `body.curve`.
        curve: curve,
        /// Radius of the roller.
        radius: number [m],
        /// Side of the curve on which the roller lies, seen in the direction of growing u.
        side: side = "right",
    }
}

/// ν of the side times the radius.
fn offset<S: Real>(e: &RollerOnCurve<S>, first: Local<S>) -> Local<S> {
    let signed = match e.side {
        Side::Right => -e.radius,
        Side::Left => e.radius,
    };
    first.perp().scale(signed / first.norm())
}

/// The centre of the roller in the frame of body j.
fn centre<S: Real>(e: &RollerOnCurve<S>, u: S) -> Local<S> {
    let [c, first] = e.curve.curve.tangent(u);
    let offset = offset(e, first);
    Local::new(c.x + offset.x, c.y + offset.y)
}

fn sign(side: Side) -> f64 {
    match side {
        Side::Right => 1.0,
        Side::Left => -1.0,
    }
}

impl Joint for RollerOnCurve {
    const OWN: usize = 1;
    const RESULTS: &'static [ResultQuantity] =
        &[ResultQuantity { name: "normal", unit: "N", negative: Some("lift_off") }];

    fn bodies<S>(e: &RollerOnCurve<S>) -> Vec<BodyId> {
        vec![e.i.body, e.curve.body]
    }

    fn equations<S>(_: &RollerOnCurve<S>) -> Vec<Equation> {
        vec![Equation::length("x"), Equation::length("y")]
    }

    fn residual<S: Real>(e: &RollerOnCurve<S>, at: &At<'_, S>, phi: &mut [S]) {
        let gap = at.i().point(e.i.s) - at.j().point(centre(e, at.own[0]));
        phi.copy_from_slice(&[gap.x, gap.y]);
    }

    /// -λᵀ ν: the force on body j along -ν.
    fn results<S: Real>(e: &RollerOnCurve<S>, at: &At<'_, S>, lam: &[S], out: &mut [S]) {
        let first = e.curve.curve.derivatives(at.own[0])[1];
        let normal = at.j().global(offset(e, first).scale(S::one() / e.radius));
        out[0] = -(normal.x * lam[0] + normal.y * lam[1]);
    }

    fn symbols(e: &RollerOnCurve) -> Vec<SceneSymbol> {
        let (i, j) = (SymbolEnd::point(&e.i), SymbolEnd::body(e.curve.body));
        vec![SceneSymbol::new(Mark::Roller, i, j).to_scale([e.radius, 0.0])]
    }

    fn attachment<S: Real>(e: &RollerOnCurve<S>, body: usize) -> Attachment<S> {
        Attachment { s: [e.i.s, Local::zero()][body], axis: S::zero() }
    }

    fn contact<S: Real>(e: &RollerOnCurve<S>, at: &At<'_, S>) -> Option<Local<S>> {
        Some(e.curve.curve.point(at.own[0]))
    }

    fn curve<S>(e: &RollerOnCurve<S>) -> Option<&CurveOn<S>> {
        Some(&e.curve)
    }

    fn curve_mut<S>(e: &mut RollerOnCurve<S>) -> Option<&mut CurveOn<S>> {
        Some(&mut e.curve)
    }

    fn fixes<S: Clone>(_: &RollerOnCurve<S>) -> Vec<Fixes<S>> {
        vec![Fixes::Contact]
    }

    fn own_start(e: &RollerOnCurve, bodies: &[Pose]) -> Vec<f64> {
        let p = bodies[1].rotation.inverse(bodies[0].point(e.i.s) - bodies[1].r);
        let apart = |u: f64| {
            let c = centre(e, u);
            (c.x - p.x).hypot(c.y - p.y)
        };
        vec![contact::least(&e.curve.curve, apart)]
    }

    fn fault(e: &RollerOnCurve) -> Option<(&'static str, String)> {
        if e.radius <= 0.0 {
            return Some(("radius", format!("{} m; must be > 0", e.radius)));
        }
        let curve = &e.curve.curve;
        if curve.fault().is_some() {
            return None; // it is reported at the curve
        }
        if let Some(message) = contact::cusp(curve) {
            return Some(("curve", message));
        }
        let bent = |u: f64| sign(e.side) * contact::curvature(&curve.derivatives(u));
        let u = contact::least(curve, bent);
        let left = 1.0 + e.radius * bent(u);
        (left <= 1e-9).then(|| {
            let message = format!(
                "{} m is too large: the curve has a hollow of radius {:.6} m for {} (undercut); take a smaller \
                 roller or a flatter curve",
                e.radius,
                -1.0 / bent(u),
                contact::place(curve, u),
            );
            ("radius", message)
        })
    }

    fn linearize<S: Real>(e: &RollerOnCurve<S>, at: &Moving<'_, S>, out: Linearized<'_, S>) {
        let curve = e.curve.near(at.own[0]);
        let near = RollerOnCurve { i: e.i.clone(), curve, radius: e.radius, side: e.side };
        derive::linearize::<Self, S>(&near, at, out);
    }
}
