//! The position quantities that can be measured on an element: the motion of body j relative to body i.

use super::quantity_kind::QuantityKind;

/// A position quantity of an element and the names of its derivatives in time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Measured {
    /// Names of the position, the rate and the acceleration. A quantity with an empty name is not available.
    pub names: [&'static str; 3],
    /// Kind of the position.
    pub kind: QuantityKind,
}

impl Measured {
    /// The relative angle angle_j - angle_i, continuous.
    pub const ANGLE: Self = Self::angle(["angle", "omega", "alpha"]);
    /// The component of the distance along a direction of body i.
    pub const DISPLACEMENT: Self = Self::length(["displacement", "rate", "acceleration"]);
    /// The distance of two points.
    pub const LENGTH: Self = Self::length(["length", "rate", "acceleration"]);

    /// The distance of two bodies that may touch; positive if they are apart.
    pub const GAP: Self = Self::length(["gap", "gap_rate", ""]);

    /// The length by which a wheel has slipped on a line.
    pub const SLIP: Self = Self::length(["slipped", "sliding", ""]);

    /// The gap between the flanks of a joint with play, and the opposite of its equation.
    pub const OF_PLAY: [Self; 2] = [Self::GAP, Self::length(["play", "play_rate", ""])];

    /// A length with the names of its derivatives.
    pub const fn length(names: [&'static str; 3]) -> Self {
        Self { names, kind: QuantityKind::Length }
    }

    /// An angle with the names of its derivatives.
    pub const fn angle(names: [&'static str; 3]) -> Self {
        Self { names, kind: QuantityKind::Angle }
    }
}
