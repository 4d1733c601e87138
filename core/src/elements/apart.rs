//! A distance and its change while a point moves.

use crate::math::Local;

/// A distance at a place in the frame of body j.
#[derive(Clone, Copy, Debug)]
pub struct Apart {
    /// The distance.
    pub distance: f64,
    /// Its gradient, a unit vector.
    pub away: Local,
    /// The largest rate at which the gradient turns within the radius in question, 1/m; infinite if it is not known.
    pub bend: f64,
    /// The error of the distance.
    pub error: f64,
    /// A distance that other parts of the curve have at least; infinite if they do not matter.
    pub other: f64,
}

/// The way of a point around its place in the middle of a part of a step: p - by to p + by, with an error; and the
/// largest distance from this place.
#[derive(Clone, Copy, Debug)]
pub struct Way {
    /// From the middle to the end.
    pub by: Local,
    /// The largest distance from the straight way.
    pub error: f64,
    /// The largest distance from the middle.
    pub within: f64,
}

impl Apart {
    /// The distance of a point from the origin.
    pub fn from_origin(p: Local, within: f64) -> Self {
        let distance = p.norm();
        let away = p.scale(1.0 / distance);
        Self {
            distance,
            away,
            bend: from_corner(distance, within),
            error: 0.0,
            other: f64::INFINITY,
        }
    }
}

/// The largest rate at which the direction from a corner turns within a radius around a point.
pub(super) fn from_corner(distance: f64, within: f64) -> f64 {
    if distance > within {
        1.0 / (distance - within)
    } else {
        f64::INFINITY
    }
}
