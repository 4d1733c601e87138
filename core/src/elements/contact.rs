//! Search along a curve: the nearest contact, and places where a curve cannot carry a joint.

use super::plane_curve::Curve;
use crate::math::Local;

/// Number of places of u that a search looks at first.
const PLACES: usize = 720;

/// The places of u, from one end to the other; a spline has several in each piece.
pub(super) fn places(curve: &Curve) -> impl Iterator<Item = f64> {
    let [a, b] = curve.range();
    let count = match curve {
        Curve::Points(own) => PLACES.max(12 * own.points.len()),
        _ => PLACES,
    };
    (0..=count).map(move |k| a + (b - a) * k as f64 / count as f64)
}

/// The u of the least value of `f`, to about the square root of the precision.
pub(super) fn least(curve: &Curve, f: impl Fn(f64) -> f64) -> f64 {
    let finite = |x: f64| if x.is_nan() { f64::INFINITY } else { x };
    let all: Vec<f64> = places(curve).collect();
    let best = (0..all.len()).min_by(|a, b| finite(f(all[*a])).total_cmp(&finite(f(all[*b]))));
    let best = best.unwrap_or(0);
    let step = all[1] - all[0];
    let [low, high] = curve.range();
    let (mut a, mut b) = (all[best] - step, all[best] + step);
    if !curve.periodic() {
        (a, b) = (a.max(low), b.min(high));
    }
    // golden section
    let ratio = 0.5 * (5.0_f64.sqrt() - 1.0);
    for _ in 0..60 {
        let (left, right) = (b - ratio * (b - a), a + ratio * (b - a));
        if finite(f(left)) < finite(f(right)) {
            b = right;
        } else {
            a = left;
        }
    }
    0.5 * (a + b)
}

/// Curvature of a curve, positive where it turns to the left.
pub(super) fn curvature(terms: &[Local; 4]) -> f64 {
    let [_, first, second, _] = terms;
    first.cross(*second) / first.norm().powi(3)
}

/// The unit normal to the right of growing u.
pub(super) fn right(terms: &[Local; 4]) -> Local {
    let first = terms[1];
    -first.perp().scale(1.0 / first.norm())
}

/// "u = 0.3 at (0.1, 0.2) m".
pub(super) fn place(curve: &Curve, u: f64) -> String {
    let p = curve.point(u);
    format!("u = {u:.6} at ({:.6}, {:.6}) m", p.x, p.y)
}

/// A place where the curve stops or turns back: C′ = 0, or C has no value.
pub(super) fn cusp(curve: &Curve) -> Option<String> {
    let speed = |u: f64| curve.derivatives(u)[1].norm();
    let largest = places(curve).map(speed).fold(0.0_f64, |most, x| match x.is_finite() {
        true => most.max(x),
        false => f64::NAN,
    });
    if let Some(u) = places(curve).find(|u| !speed(*u).is_finite() || !finite(curve.point(*u))) {
        return Some(format!("it has no value with a derivative at u = {u:.6}"));
    }
    let slowest = least(curve, speed);
    (speed(slowest) <= 1e-6 * largest).then(|| {
        format!("it has a cusp: |C'| = {:.3e} m for {}", speed(slowest), place(curve, slowest))
    })
}

fn finite(p: Local) -> bool {
    p.x.is_finite() && p.y.is_finite()
}
