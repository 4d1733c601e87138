//! Distances whose zeros begin and end a contact.

use super::foot::Rim;
use super::kinds::{PointOn, Side};

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
