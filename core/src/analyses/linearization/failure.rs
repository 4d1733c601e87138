//! Reasons for which a mechanism cannot be linearized at a state.

use crate::analyses::dynamics;
use crate::model::{Model, Problem};
use crate::solve::Breakdown;
use std::fmt;

/// The reason.
#[derive(Clone, Debug, PartialEq)]
pub enum Failure {
    /// The position is singular: its degrees of freedom differ from those of neighbouring positions.
    Singular {
        /// Time, s.
        t: f64,
        /// A joint or driver whose equations are dependent.
        name: String,
        /// Description.
        message: String,
    },
    /// The state does not satisfy the constraints.
    Open {
        /// The time, s.
        t: f64,
        /// The joint or driver.
        name: String,
        /// The gap, m or rad.
        gap: f64,
        /// Its unit.
        unit: &'static str,
    },
    /// A degree of freedom has no inertia.
    NoInertia {
        /// The time, s.
        t: f64,
        /// The independent coordinate, or the beam.
        name: String,
        /// What lacks inertia, with a remedy.
        message: String,
    },
    /// The equations of motion have no solution at the state.
    Motion(Box<dynamics::Failure>),
    /// The name of an input or output is invalid.
    Name(Box<Problem>),
    /// A parameter that cannot be an input because the constraints depend on it.
    Geometry {
        /// The parameter.
        parameter: String,
    },
    /// The index of an output that has no derivative at the state.
    NoDerivative(usize),
    /// The mechanism does not rotate uniformly.
    Rotation {
        /// The time, s.
        t: f64,
        /// Why not.
        message: String,
    },
}

impl Failure {
    /// The failure for groups of constraints that are dependent only at this position.
    pub(super) fn singular(model: &Model, t: f64, groups: &[Vec<usize>]) -> Self {
        let group = groups.first().cloned().unwrap_or_default();
        let names = model.names_of(&group);
        let name = names.first().map_or_else(String::new, |name| (*name).to_string());
        let message = format!(
            "the position at t = {t:.6} s is singular: {} depend on each other here, so that the mechanism has other \
             freedoms than beside it, and no linear equations",
            names.join(", ")
        );
        Self::Singular { t, name, message }
    }

    /// The failure for an independent coordinate without inertia; `column` is its index in q.
    pub(super) fn no_inertia(model: &Model, t: f64, column: usize) -> Self {
        let body = model.layout.body_of(column).map(|(body, _)| body);
        let of_beam = body.and_then(|body| dynamics::of_beam(model, t, body));
        let (name, message) = of_beam.unwrap_or_else(|| {
            let coordinate = coordinate(model, column);
            let message = format!(
                "no mass moves with {coordinate} at t = {t:.6} s, so that its acceleration is not determined; give mass \
                 or inertia to a body that moves with it"
            );
            (coordinate, message)
        });
        Self::NoInertia { t, name, message }
    }

    pub(super) fn geometry(model: &Model, k: usize) -> Self {
        Self::Geometry { parameter: model.blueprint.parameters[k].clone() }
    }

    pub(super) const fn no_derivative(k: usize) -> Self {
        Self::NoDerivative(k)
    }

    /// The failure for a factorisation that broke down at a dependent row.
    pub(super) fn breakdown(model: &Model, t: f64, breakdown: Breakdown) -> Self {
        let group = match breakdown {
            Breakdown::Row(row) => vec![vec![model.layout.owner(row).0]],
            _ => Vec::new(),
        };
        Self::singular(model, t, &group)
    }
}

/// The name of a coordinate, such as `crank.angle`, or of an internal coordinate, such as `contact.u`.
pub fn coordinate(model: &Model, column: usize) -> String {
    if let Some((body, k)) = model.layout.body_of(column) {
        return format!("{}.{}", model.bodies[body.0].name, ["x", "y", "angle"][k]);
    }
    let own = |slots: &crate::model::Slots| slots.own.range().contains(&column);
    let k = model.layout.constraints.iter().position(own).unwrap_or(0);
    let slots = &model.layout.constraints[k];
    let number = match slots.own.count {
        1 => String::new(),
        _ => (column + 1 - slots.own.first).to_string(),
    };
    format!("{}.u{number}", model.constraints[k].name)
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Singular { message, .. } | Self::NoInertia { message, .. } => {
                f.write_str(message)
            }
            Self::Open { t, name, gap, unit } => write!(
                f,
                "the state does not meet the constraints at t = {t:.6} s: {name} is open by {:.3e} {unit}",
                gap.abs()
            ),
            Self::Motion(failure) => write!(f, "{}", failure.reason),
            Self::Name(problem) => f.write_str(&problem.message),
            Self::Geometry { parameter } => write!(
                f,
                "'{parameter}' changes the geometry of a joint or the law of a driver; an input is a parameter of forces \
                 or masses alone"
            ),
            Self::Rotation { t, message } => {
                write!(f, "no frame rotates with the mechanism at t = {t:.6} s: {message}")
            }
            Self::NoDerivative(k) => write!(f, "output {} has no derivative at the state", k + 1),
        }
    }
}
