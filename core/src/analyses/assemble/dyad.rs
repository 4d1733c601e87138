//! Closing a dyad: the intersection of two circles.

use crate::math::Vec2;

/// The possible positions of the joint of a dyad.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Closure {
    /// One to the left of the line from the first to the second centre, and one to its right.
    Two(Vec2, Vec2),
    /// The circles touch, or they miss each other by the given length: positive if the dyad is too short,
    /// negative if one arm is too long for the other.
    One(Vec2, Option<f64>),
    /// Equal circles: the joint may be anywhere on them.
    Undetermined,
}

/// Intersects the circles of radius `r1` about `p1` and `r2` about `p2`, m.
pub fn close(p1: Vec2, r1: f64, p2: Vec2, r2: f64) -> Closure {
    let (line, d) = (p2 - p1, (p2 - p1).norm());
    let scale = r1.max(r2).max(d);
    if d <= 1e-12 * scale {
        if (r1 - r2).abs() <= 1e-12 * scale {
            return Closure::Undetermined;
        }
        return Closure::One(p1 + Vec2::new(r1, 0.0), Some(-(r1 - r2).abs()));
    }
    let along = line.scale(1.0 / d);
    // distance from p1 to the chord, in a form without cancellation of squares
    let a = 0.5 * (d + (r1 - r2) * ((r1 + r2) / d));
    let h2 = (r1 - a) * (r1 + a);
    if h2 > (1e-9 * scale).powi(2) {
        let h = along.perp().scale(h2.sqrt());
        let foot = p1 + along.scale(a);
        return Closure::Two(foot + h, foot - h);
    }
    let missing = if d > r1 + r2 { d - r1 - r2 } else { d - (r1 - r2).abs() };
    let reach = if d > r1 + r2 { r1 + 0.5 * missing } else { r1.copysign(r1 - r2) };
    let missing = (missing.abs() > 1e-9 * scale).then_some(missing);
    Closure::One(p1 + along.scale(reach), missing)
}
