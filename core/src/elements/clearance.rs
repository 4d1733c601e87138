//! Distances whose zeros begin and end a contact, with bounds of their change while their points move.

use super::foot::Rim;
use super::kinds::{PointOn, Side};
use crate::math::Local;

/// A distance between two bodies, positive if they are apart.
#[derive(Clone, Copy, Debug)]
pub enum Clearance<'e> {
    /// The distance of a point of body i from a curve of body j, positive on the side of the curve, minus a radius.
    Curve {
        /// The point.
        i: &'e PointOn,
        /// The curve.
        curve: &'e Rim,
        /// The side of the curve.
        side: Side,
        /// The radius, m.
        radius: f64,
    },
    /// ±(distance of two points - length).
    Length {
        /// The point of body i.
        i: &'e PointOn,
        /// The point of body j.
        j: &'e PointOn,
        /// The length, m.
        length: f64,
        /// ±1.
        sign: f64,
    },
    /// ±(position quantity that the element follows - limit).
    Limit {
        /// The limit.
        limit: f64,
        /// ±1.
        sign: f64,
    },
}

/// A distance at a place in the frame of body j.
#[derive(Clone, Copy, Debug)]
pub struct Apart {
    /// The distance.
    pub distance: f64,
    /// Its gradient, a unit vector.
    pub away: Local,
    /// The largest rate at which the gradient turns within the radius in question, 1/m.
    pub bend: f64,
}

impl Apart {
    /// The distance of a point from the origin.
    pub fn from_origin(p: Local, within: f64) -> Self {
        let distance = p.norm();
        let away = p.scale(1.0 / distance);
        Self { distance, away, bend: from_corner(distance, within) }
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
