//! Reasons for which a mechanism has no linear equations at a state.

use crate::analyses::dynamics;
use crate::model::{Model, Problem};
use crate::solve::Breakdown;
use std::fmt;

/// The reason.
#[derive(Clone, Debug, PartialEq)]
pub enum Failure {
    /// The position is singular: its freedoms are not those of its neighbours.
    Singular {
        /// Time, s.
        t: f64,
        /// A joint or driver that takes part.
        name: String,
        /// Description.
        message: String,
    },
    /// The state does not meet the constraints.
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
    /// A freedom moves no mass.
    NoInertia {
        /// The time, s.
        t: f64,
        /// The independent coordinate.
        coordinate: String,
    },
    /// The equations of motion have no solution at the state.
    Motion(Box<dynamics::Failure>),
    /// The name of an input or output.
    Name(Box<Problem>),
}

impl Failure {
    /// The groups of constraints depend on each other at this position only.
    pub(super) fn singular(model: &Model, t: f64, groups: &[Vec<usize>]) -> Self {
        let group = groups.first().cloned().unwrap_or_default();
        let names: Vec<&str> = group.iter().map(|k| model.constraints[*k].name.as_str()).collect();
        let name = names.first().map_or_else(String::new, |name| (*name).to_string());
        let message = format!(
            "the position at t = {t:.6} s is singular: {} depend on each other here, so that the mechanism has other \
             freedoms than beside it, and no linear equations",
            names.join(", ")
        );
        Self::Singular { t, name, message }
    }

    /// The row of a breakdown depends on others.
    pub(super) fn breakdown(model: &Model, t: f64, breakdown: Breakdown) -> Self {
        let group = match breakdown {
            Breakdown::Row(row) => vec![vec![model.layout.owner(row).0]],
            _ => Vec::new(),
        };
        Self::singular(model, t, &group)
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Singular { message, .. } => f.write_str(message),
            Self::Open { t, name, gap, unit } => write!(
                f,
                "the state does not meet the constraints at t = {t:.6} s: {name} is open by {:.3e} {unit}",
                gap.abs()
            ),
            Self::NoInertia { coordinate, t } => write!(
                f,
                "no mass moves with {coordinate} at t = {t:.6} s, so that its acceleration is not determined; give mass \
                 or inertia to a body that moves with it"
            ),
            Self::Motion(failure) => write!(f, "{}", failure.reason),
            Self::Name(problem) => f.write_str(&problem.message),
        }
    }
}
