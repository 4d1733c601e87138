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

/// r_i (φ_i - θ) + σ r_j (φ_j - θ) with θ the direction of `d`.
pub(super) fn rolled<S: Real>(d: Vec2<S>, [r_i, r_j]: [S; 2], sigma: f64, at: &At<'_, S>) -> S {
    let theta = d.y.atan2(d.x);
    r_i * (at.i().angle - theta) + S::constant(sigma) * r_j * (at.j().angle - theta)
}

/// [`rolled`] - offset modulo 2π (r_i + σ r_j), nearest 0, in a form that has no jump where θ has one. With α = (r_i φ_i
/// + σ r_j φ_j - offset)/(r_i + σ r_j), it is (r_i + σ r_j) times the angle from `d` to the direction α.
pub(super) fn meshed<S: Real>(
    d: Vec2<S>,
    [r_i, r_j]: [S; 2],
    sigma: f64,
    (offset, at): (S, &At<'_, S>),
) -> S {
    let r_j = S::constant(sigma) * r_j;
    let alpha = (r_i * at.i().angle + r_j * at.j().angle - offset) / (r_i + r_j);
    let seen = Rotation::new(alpha).inverse(d);
    (r_i + r_j) * (-seen.y).atan2(seen.x)
}

/// The change of the equation by a whole turn of θ, 2π `radius`.
pub(super) fn whole_turn<S: Real>(radius: S) -> S {
    S::constant(std::f64::consts::TAU) * radius
}

/// `x` modulo 2π `radius`, nearest 0, so that the result does not change with a whole turn of θ.
pub(super) fn nearest<S: Real>(x: S, radius: S) -> S {
    let turn = whole_turn(radius);
    x - turn * (x / turn + S::constant(0.5)).floor()
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

/// 1 while there is no slip, 0 otherwise.
pub(super) const STICKING: ResultQuantity =
    ResultQuantity { name: "sticking", unit: "", negative: None };

/// The field with the play of teeth.
pub(super) const BACKLASH: &str = "backlash";

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
