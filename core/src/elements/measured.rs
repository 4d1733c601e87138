//! Position quantities that can be measured on an element: the motion of body j relative to body i.

/// A position quantity of an element and the names of its derivatives in time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Measured {
    /// Names of the position, the rate and the acceleration. A quantity with an empty name is not available.
    pub names: [&'static str; 3],
    /// SI unit of the position: `m` or `rad`.
    pub unit: &'static str,
}

impl Measured {
    /// The relative angle angle_j - angle_i, continuous.
    pub const ANGLE: Self = Self { names: ["angle", "omega", "alpha"], unit: "rad" };
    /// The component of the distance along a direction of body i.
    pub const DISPLACEMENT: Self =
        Self { names: ["displacement", "rate", "acceleration"], unit: "m" };
    /// The distance of two points.
    pub const LENGTH: Self = Self { names: ["length", "rate", "acceleration"], unit: "m" };

    /// The distance of two bodies that may touch; positive if they are apart.
    pub const GAP: Self = Self { names: ["gap", "gap_rate", ""], unit: "m" };

    /// SI unit of the derivative of this order.
    pub fn unit_of(&self, order: usize) -> String {
        self.unit.to_string() + ["", "/s", "/s^2"][order]
    }
}
