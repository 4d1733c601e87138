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
}

impl Apart {
    /// The distance of a point from the origin.
    pub fn from_origin(p: Local, within: f64) -> Self {
        let distance = p.norm();
        let away = p.scale(1.0 / distance);
        Self { distance, away, bend: from_corner(distance, within), error: 0.0 }
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
