//! Functions of elements with wheels that roll on each other or on a line.

use super::joint_trait::{At, Required, ResultQuantity};
use crate::math::{each, Local, Pose, Real, Rotation, Vec2};

/// The radii: r = module z/2 if the numbers of teeth z are given; NaN if neither radii nor teeth are given.
pub(super) fn radii<S: Real>(
    radii: Option<[S; 2]>,
    teeth: Option<[S; 2]>,
    module: Option<S>,
) -> [S; 2] {
    match (radii, teeth, module) {
        (Some(radii), ..) => radii,
        (None, Some(teeth), Some(module)) => each(teeth, |z| z * module / S::constant(2.0)),
        _ => [S::constant(f64::NAN); 2],
    }
}

/// The distance of the centres of two wheels, and the required distance.
pub(super) fn centres<S: Real>(d: Vec2<S>, must: Option<S>) -> Vec<Required<S>> {
    let remedy =
        "hold both centres by joints on the same body, such as an arm or ground, at that distance";
    vec![Required { what: "distance of the centres", is: d.norm(), must, remedy }]
}

/// r_i φ_i + r_j φ_j.
pub(super) fn turned<S: Real>([r_i, r_j]: [S; 2], at: &At<'_, S>) -> S {
    r_i * at.i().angle + r_j * at.j().angle
}

/// r_i (φ_i - θ) + r_j (φ_j - θ) - offset with θ the direction of `d`, modulo 2π (r_i + r_j), nearest 0. The radius
/// r_j is negative if both wheels turn in the same sense. With α = (r_i φ_i + r_j φ_j - offset)/(r_i + r_j), it is
/// (r_i + r_j) times the direction of `d` seen from α, mirrored, which has no jump where θ has one. Wheels that are
/// exactly half a turn out of mesh are common at starts; [`CUT`] gives all of them the same sign.
pub(super) fn meshed<S: Real>(d: Vec2<S>, radii: [S; 2], offset: S, at: &At<'_, S>) -> S {
    let sum = radii[0] + radii[1];
    let Local { x, y } = Rotation::new((turned(radii, at) - offset) / sum).inverse(d);
    let (sin, cos) = CUT.sin_cos();
    let turn = |a: S, b: S| S::constant(cos) * a + S::constant(sin) * b;
    sum * (turn(-y, x).atan2(turn(x, y)) - S::constant(CUT))
}

/// Half a turn out of mesh, by which the sign of a distance from the mesh changes, is this angle before π, rad.
const CUT: f64 = 1e-6;

/// The change of the equation by a whole turn of θ, 2π `radius`.
pub(super) fn whole_turn<S: Real>(radius: S) -> S {
    S::constant(std::f64::consts::TAU) * radius
}

/// The directions along a line at the angle `axis` in a body, and to its left.
pub(super) fn directions<S: Real>(axis: S, on: &Pose<S>) -> (Vec2<S>, Vec2<S>) {
    let axis = Rotation::new(axis);
    let u = on.global(Local::new(axis.cos, axis.sin));
    (u, u.perp())
}

/// The tangential force at the rolling contact, which is a multiplier.
pub(super) const TANGENTIAL: ResultQuantity =
    ResultQuantity { name: "tangential", unit: "N", negative: None };

/// The fault of a radius that is zero or, unless it is `signed`, negative.
pub(super) fn radius_fault(
    field: &'static str,
    radius: f64,
    signed: bool,
) -> Option<(&'static str, String)> {
    let refused = if signed { radius == 0.0 } else { radius <= 0.0 };
    let must = if signed { "not be 0" } else { "be > 0" };
    refused.then(|| (field, format!("{radius} m; must {must}")))
}
