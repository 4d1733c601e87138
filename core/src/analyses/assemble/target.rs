//! Values that `set` or `guess` prescribes for the start.

use crate::elements::{BodyId, Coordinate, CoordinateOf, Followed};
use crate::expression::Tape;
use crate::model::Model;

/// A value given for a coordinate or a rate of a body.
#[derive(Clone, Debug, PartialEq)]
pub struct CoordinateTarget {
    /// The moving body.
    pub body: BodyId,
    /// Coordinate or rate.
    pub coordinate: Coordinate,
    /// m, rad, m/s or rad/s.
    pub value: f64,
}

impl CoordinateTarget {
    /// The index of the coordinate, or of the coordinate of the rate.
    pub(super) fn place(&self, model: &Model) -> usize {
        model.layout.bodies[self.body.0].first + self.coordinate.column()
    }
}

/// A value given for a position quantity of a point or an element, or for its rate.
#[derive(Clone, Debug)]
pub struct QuantityTarget {
    /// As written, such as `A.angle` or `A.omega`.
    pub name: String,
    /// The position quantity.
    pub of: Followed<Tape>,
    /// Whether the value is the value of the rate.
    pub rate: bool,
    /// SI unit.
    pub unit: String,
    /// The value in its unit.
    pub value: f64,
}

impl PartialEq for QuantityTarget {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name && self.value == other.value
    }
}

/// A value given for the start.
#[derive(Clone, Debug, PartialEq)]
pub enum Target {
    /// A coordinate or rate of a body.
    Coordinate(CoordinateTarget),
    /// A quantity of a point or an element.
    Quantity(QuantityTarget),
    /// The guess of an internal coordinate of a joint.
    Internal {
        /// Its column.
        column: usize,
        /// m or rad.
        value: f64,
    },
    /// A first-order state of an element.
    State {
        /// Index in z.
        place: usize,
        /// The value in its unit.
        value: f64,
    },
}

impl Target {
    /// The position quantity, with its value or the value of its rate; None for other targets.
    pub(super) fn followed(&self) -> Option<(Followed<Tape>, f64)> {
        match self {
            Self::Coordinate(CoordinateTarget { body, coordinate, value }) => {
                let coordinate = Coordinate::ALL[coordinate.column()];
                Some((CoordinateOf { body: *body, coordinate }.into(), *value))
            }
            Self::Quantity(target) => Some((target.of.clone(), target.value)),
            Self::State { .. } | Self::Internal { .. } => None,
        }
    }

    /// Whether the target is a rate.
    pub(super) fn is_rate(&self) -> bool {
        match self {
            Self::Coordinate(target) => target.coordinate.is_rate(),
            Self::Quantity(target) => target.rate,
            Self::State { .. } | Self::Internal { .. } => false,
        }
    }

    /// The quantity as written; empty for other targets.
    pub(super) fn name(&self, model: &Model) -> String {
        match self {
            Self::Coordinate(target) => {
                format!("{}.{}", model.bodies[target.body.0].name, target.coordinate.name())
            }
            Self::Quantity(target) => target.name.clone(),
            Self::State { .. } | Self::Internal { .. } => String::new(),
        }
    }

    /// The target as written, such as "crank.angle = 70°".
    pub(super) fn written(&self, model: &Model) -> String {
        let (unit, value) = match self {
            Self::Coordinate(target) => (target.coordinate.unit(), target.value),
            Self::Quantity(target) => (target.unit.as_str(), target.value),
            Self::State { .. } | Self::Internal { .. } => ("", f64::NAN),
        };
        let name = self.name(model);
        match unit {
            "rad" => format!("{name} = {}°", trimmed(value.to_degrees(), 7)),
            unit => format!("{name} = {} {unit}", trimmed(value, 7)),
        }
    }
}

/// The number with some significant digits and without trailing zeros.
pub(in crate::analyses) fn trimmed(x: f64, digits: usize) -> String {
    let rounded = format!("{x:.*e}", digits - 1).parse::<f64>().unwrap_or(x);
    match rounded.abs() {
        1e-5..1e16 => format!("{rounded}"),
        0.0 => "0".to_string(),
        _ => format!("{rounded:e}"),
    }
}

/// The targets of positions.
pub(super) fn of_positions(targets: &[Target]) -> impl Iterator<Item = &Target> + Clone {
    of_motion(targets).filter(|target| !target.is_rate())
}

/// The targets of rates.
pub(super) fn of_rates(targets: &[Target]) -> impl Iterator<Item = &Target> + Clone {
    of_motion(targets).filter(|target| target.is_rate())
}

/// The targets of positions and rates.
pub(super) fn of_motion(targets: &[Target]) -> impl Iterator<Item = &Target> + Clone {
    targets.iter().filter(|target| matches!(target, Target::Coordinate(_) | Target::Quantity(_)))
}

/// The targets of positions of bodies.
pub(super) fn of_bodies(targets: &[Target]) -> impl Iterator<Item = &CoordinateTarget> {
    of_positions(targets).filter_map(|target| match target {
        Target::Coordinate(target) => Some(target),
        _ => None,
    })
}

/// The targets of positions of points and elements.
pub(super) fn of_quantities(targets: &[Target]) -> impl Iterator<Item = &QuantityTarget> {
    of_positions(targets).filter_map(|target| match target {
        Target::Quantity(target) => Some(target),
        _ => None,
    })
}
