//! Rolling: wheel j rolls on a line of body i without slip and without separation.
//!
//! With u the direction of the line, n = u turned by +90° and d = Pⱼ - Pᵢ: Φ₁ = nᵀ d - r = 0 keeps the centre at the
//! distance r, and Φ₂ = uᵀ d + r (φⱼ - φᵢ) - offset = 0 makes the velocities of wheel and line equal at the point of
//! contact. r > 0: the wheel is on the left of u; r < 0: on its right. The constraint is bilateral: λ₁ may have any
//! sign.

use crate::elements::wheels::{directions, radius_fault, TANGENTIAL};
use crate::elements::{
    element, measure, At, Attachment, BodyId, Equation, Fixes, Joint, Mark, Measured,
    ResultQuantity, SceneSymbol, SymbolEnd,
};
use crate::math::Real;

element! {
    /// Rolling: wheel j rolls on a line of body i without slip. Φ1 = n·d - radius and Φ2 = u·d +
    /// radius (angle_j - angle_i) - offset, where u is the direction of the line, n is its left
    /// normal and d = point_j - point_i. The force on body i at the point of contact is +λ1 along n
    /// and +λ2 along u. The opposite force acts on body j.
    Rolling, "rolling" {
        /// Point of body i on the line, as `body.point`.
        i: point,
        /// Centre of the wheel, as `body.point`.
        j: point,
        /// Radius of the wheel; > 0 for a wheel on the left of the line, < 0 on its right.
        radius: number [m],
        /// Angle of the line in the frame of body i.
        axis: number [rad] = 0.0,
        /// Constant that is subtracted in Φ2.
        offset: number [m] = 0.0,
    }
}

impl Joint for Rolling {
    const MEASURED: &'static [Measured] = &[Measured::DISPLACEMENT];
    const RESULTS: &'static [ResultQuantity] = &[TANGENTIAL];

    fn bodies<S>(e: &Rolling<S>) -> Vec<BodyId> {
        vec![e.i.body, e.j.body]
    }

    fn equations<S>(_: &Rolling<S>) -> Vec<Equation> {
        vec![Equation::length("normal"), Equation::length("tangential")]
    }

    fn residual<S: Real>(e: &Rolling<S>, at: &At<'_, S>, phi: &mut [S]) {
        let ((u, n), d) = (directions(e.axis, at.i()), measure::apart(at, &e.i, &e.j));
        let turned = at.j().angle - at.i().angle;
        let rolled = u.dot(d) + e.radius * turned - e.offset;
        phi.copy_from_slice(&[n.dot(d) - e.radius, rolled]);
    }

    fn measure<S: Real>(e: &Rolling<S>, at: &At<'_, S>, out: &mut [S]) {
        out[0] = measure::along(at, e.axis, &e.i, &e.j);
    }

    fn symbols(e: &Rolling) -> Vec<SceneSymbol> {
        let (i, j) = (SymbolEnd::point(&e.i).along(e.axis), SymbolEnd::point(&e.j));
        let line = SceneSymbol::new(Mark::Track, i.clone(), j.clone());
        let wheel = SceneSymbol::new(Mark::Circle, i, j);
        vec![wheel.to_scale([0.0, e.radius.abs()]), line.to_scale([0.0, e.radius])]
    }

    fn results<S: Real>(_: &Rolling<S>, _: &At<'_, S>, lam: &[S], out: &mut [S]) {
        out[0] = lam[1];
    }

    fn attachment<S: Real>(e: &Rolling<S>, body: usize) -> Attachment<S> {
        match body {
            0 => Attachment { s: e.i.s, axis: e.axis },
            _ => Attachment { s: e.j.s, axis: S::zero() },
        }
    }

    fn fixes<S: Clone>(e: &Rolling<S>) -> Vec<Fixes<S>> {
        vec![Fixes::Beside(e.radius.clone()), Fixes::Turn]
    }

    fn fault(e: &Rolling) -> Option<(&'static str, String)> {
        radius_fault("radius", e.radius, true)
    }
}
