//! What a coordinate, a position quantity or a residual measures.

/// The kind of a coordinate, of a position quantity or of the residual of an equation. The units of its value, of its
/// rates and of the effort along it follow from the kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum QuantityKind {
    /// A length.
    #[default]
    Length,
    /// An angle.
    Angle,
    /// A number without a unit, such as the parameter of a curve from formulas.
    Pure,
}

impl QuantityKind {
    /// The kinds of x, y and angle.
    pub const OF_BODY: [Self; 3] = [Self::Length, Self::Length, Self::Angle];
    /// The kinds that the residual of an equation may have.
    pub const OF_EQUATIONS: [Self; 2] = [Self::Length, Self::Angle];

    /// The SI unit.
    pub const fn unit(self) -> &'static str {
        ["m", "rad", "1"][self as usize]
    }

    /// The SI unit of the derivative of this order by time.
    pub fn unit_of_rate(self, order: usize) -> String {
        self.unit().to_string() + ["", "/s", "/s^2"][order]
    }

    /// The SI unit of an effort along the quantity: effort times quantity is an energy.
    pub const fn unit_of_effort(self) -> &'static str {
        ["N", "N*m", "J"][self as usize]
    }

    /// The kind of a quantity along which an effort has this unit.
    pub fn of_effort(unit: &str) -> Option<Self> {
        [Self::Length, Self::Angle, Self::Pure].into_iter().find(|of| of.unit_of_effort() == unit)
    }

    /// The kind with this unit.
    pub fn of_unit(unit: &str) -> Option<Self> {
        [Self::Length, Self::Angle, Self::Pure].into_iter().find(|kind| kind.unit() == unit)
    }

    /// The kind of an equation with this unit.
    pub fn of_equation(unit: &str) -> Option<Self> {
        Self::of_unit(unit).filter(|kind| Self::OF_EQUATIONS.contains(kind))
    }

    /// A value of this kind that is comparable with the size of a mechanism.
    pub fn scale(self, size: f64) -> f64 {
        match self {
            Self::Length => size,
            Self::Angle | Self::Pure => 1.0,
        }
    }

    /// A written value with its unit, if the kind has one.
    pub fn with_unit(self, value: &str) -> String {
        match self {
            Self::Pure => value.to_string(),
            Self::Length | Self::Angle => format!("{value} {}", self.unit()),
        }
    }
}
