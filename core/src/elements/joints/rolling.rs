//! Rolling: wheel j rolls on a line of body i without slip and without separation.
//!
//! With u the direction of the line, n = u turned by +90° and d = Pⱼ - Pᵢ: Φ₁ = nᵀ d - r = 0 keeps the centre at the
//! distance r, and Φ₂ = uᵀ d + r (φⱼ - φᵢ) - offset = 0 makes the velocities of wheel and line equal at the point of
//! contact. r > 0: the wheel is on the left of u; r < 0: on its right. The constraint is bilateral: λ₁ may have any
//! sign.
//!
//! With a coefficient of friction, the wheel may slip. The joint then has the first equation only, and the second one
//! belongs to its friction, `forces/slip_friction.rs`, which slides and sticks with the load |λ₁|.

use crate::elements::wheels::{directions, radius_fault, STICKING, TANGENTIAL};
use crate::elements::{
    element, measure, At, Attachment, BodyId, Equation, Fixes, Joint, Mark, Measured,
    ResultQuantity, SceneSymbol, Slips, SymbolEnd,
};
use crate::math::Real;

element! {
    /// Rolling: wheel j rolls on a line of body i without slip. Φ1 = n·d - radius and Φ2 = u·d +
    /// radius (angle_j - angle_i) - offset, where u is the direction of the line, n is its left
    /// normal and d = point_j - point_i. The force on body i at the point of contact is +λ1 along n
    /// and +λ2 along u. The opposite force acts on body j. With `friction`, the wheel rolls as long as
    /// |λ2| is at most static |λ1|. Otherwise it slides, and the force along u is friction |λ1| against
    /// the sliding velocity.
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
        /// Coefficient of friction while the wheel slides. Without it, the wheel never slides.
        friction: optional_number,
        /// Coefficient of friction up to which the wheel rolls; `friction` if absent.
        r#static: optional_number,
    }
}

impl Joint for Rolling {
    const CONDENSES: bool = true;

    const MEASURED: &'static [Measured] = &[Measured::DISPLACEMENT, Measured::SLIP];
    const RESULTS: &'static [ResultQuantity] = &[TANGENTIAL, STICKING];

    fn bodies<S>(e: &Rolling<S>) -> Vec<BodyId> {
        vec![e.i.body, e.j.body]
    }

    fn equations<S>(e: &Rolling<S>) -> Vec<Equation> {
        let normal = Equation::length("normal");
        match e.friction {
            Some(_) => vec![normal],
            None => vec![normal, Equation::length("tangential")],
        }
    }

    fn slips<S: Clone>(e: &Rolling<S>) -> Option<Slips<S>> {
        let kinetic = e.friction.clone()?;
        Some(Slips { r#static: e.r#static.clone().unwrap_or_else(|| kinetic.clone()), kinetic })
    }

    fn residual<S: Real>(e: &Rolling<S>, at: &At<'_, S>, phi: &mut [S]) {
        let (_, n) = directions(e.axis, at.i());
        phi[0] = n.dot(measure::apart(at, &e.i, &e.j)) - e.radius;
        if let Some(tangential) = phi.get_mut(1) {
            *tangential = slip(e, at);
        }
    }

    fn measure<S: Real>(e: &Rolling<S>, at: &At<'_, S>, out: &mut [S]) {
        out.copy_from_slice(&[measure::along(at, e.axis, &e.i, &e.j), slip(e, at)]);
    }

    fn symbols(e: &Rolling) -> Vec<SceneSymbol> {
        let (i, j) = (SymbolEnd::point(&e.i).along(e.axis), SymbolEnd::point(&e.j));
        let line = SceneSymbol::new(Mark::Track, i.clone(), j.clone());
        let wheel = SceneSymbol::new(Mark::Circle, i, j);
        vec![wheel.to_scale([0.0, e.radius.abs()]), line.to_scale([0.0, e.radius])]
    }

    /// Those of a wheel that does not slip. Friction gives them otherwise.
    fn results<S: Real>(_: &Rolling<S>, _: &At<'_, S>, lam: &[S], out: &mut [S]) {
        out.copy_from_slice(&[lam.get(1).copied().unwrap_or_else(S::zero), S::one()]);
    }

    fn attachment<S: Real>(e: &Rolling<S>, body: usize) -> Attachment<S> {
        match body {
            0 => Attachment { s: e.i.s, axis: e.axis },
            _ => Attachment { s: e.j.s, axis: S::zero() },
        }
    }

    fn fixes<S: Clone>(e: &Rolling<S>) -> Vec<Fixes<S>> {
        let beside = Fixes::Beside(e.radius.clone());
        match e.friction {
            Some(_) => vec![beside],
            None => vec![beside, Fixes::Turn],
        }
    }

    fn fault(e: &Rolling) -> Option<(&'static str, String)> {
        let of_friction = match (e.friction, e.r#static) {
            (Some(kinetic), _) if kinetic < 0.0 => Some(("friction", "must not be negative")),
            (Some(kinetic), Some(most)) if most < kinetic => {
                Some(("static", "must not be below friction"))
            }
            (None, Some(_)) => Some(("static", "needs friction")),
            _ => None,
        };
        let of_friction = of_friction.map(|(field, must)| (field, must.to_string()));
        radius_fault("radius", e.radius, true).or(of_friction)
    }
}

/// Φ₂: the length by which the wheel has slipped along u.
fn slip<S: Real>(e: &Rolling<S>, at: &At<'_, S>) -> S {
    let (u, _) = directions(e.axis, at.i());
    let turned = at.j().angle - at.i().angle;
    u.dot(measure::apart(at, &e.i, &e.j)) + e.radius * turned - e.offset
}
