//! How forward dynamics fails, in terms of the mechanism.

use super::Run;
use crate::equations::augmented::Dependent;
use crate::equations::Singular;
use crate::integrate::{self, Cause};
use crate::model::Model;
use crate::stabilize::Fault;
use std::fmt;

/// Why the integration could not go on.
#[derive(Clone, Debug, PartialEq)]
pub enum Reason {
    /// The constraints lose rank: reactions and accelerations are not unique.
    Singular {
        /// Time, s.
        t: f64,
        /// The joint or driver whose equation depends on the others, or the body without mass.
        name: String,
        /// In words.
        message: String,
    },
    /// An option that cannot be right.
    Option {
        /// Its name.
        name: &'static str,
        /// In words.
        message: String,
    },
    /// The integrator gave up.
    Integration {
        /// Time reached, s.
        t: f64,
        /// In words.
        message: String,
        /// What to try.
        hint: &'static str,
    },
}

/// A failed run with what was computed before.
#[derive(Clone, Debug, PartialEq)]
pub struct Failure {
    /// Why.
    pub reason: Reason,
    /// What was computed before.
    pub run: Run,
}

impl Reason {
    pub(super) fn singular(model: &Model, t: f64, Singular(at): Singular) -> Self {
        let (name, message) = match at {
            Dependent::Row(row) => {
                let (k, equation) = model.layout.owner(row);
                let item = &model.constraints[k];
                let what = format!("{}.{}", item.name, item.equations[equation].name);
                let message = format!(
                    "singular position at t = {t:.6} s: constraint {what} depends on the others, \
                     so reactions and accelerations are not unique"
                );
                (item.name.clone(), message)
            }
            Dependent::Column(column) => {
                let name = model.bodies[column / 3 + 1].name.clone();
                let message = format!(
                    "a torque turns {name} at t = {t:.6} s, which has no inertia and which no joint \
                     keeps from turning: give it an inertia"
                );
                (name, message)
            }
        };
        Self::Singular { t, name, message }
    }

    pub(super) fn fault(model: &Model, t: f64, fault: Fault) -> Self {
        let (row, gap) = match fault {
            Fault::Singular(singular) => return Self::singular(model, t, singular),
            Fault::Open { row, gap } => (row, gap),
        };
        let (k, equation) = model.layout.owner(row);
        let item = &model.constraints[k];
        let message = format!(
            "projection fails at t = {t:.6} s: constraint {}.{} stays open by {gap:.1e}",
            item.name, item.equations[equation].name
        );
        let hint = "tighten the tolerance; a start must meet the constraints";
        Self::Integration { t, message, hint }
    }

    pub(super) fn from_integrator(
        model: &Model,
        failure: integrate::Failure<(f64, Fault)>,
    ) -> Self {
        let t = failure.t;
        let (message, hint) = match failure.cause {
            Cause::Equations((at, fault)) => return Self::fault(model, at, fault),
            Cause::Argument { name, value, must } => {
                return Self::Option { name, message: format!("{name}: {value}; must be {must}") }
            }
            Cause::StepTooSmall { h, .. } => (
                format!("the step fell to {h:.1e} s at t = {t:.6} s: the tolerance cannot be met"),
                "a singular position or a discontinuity lies here; look at the solution so far",
            ),
            Cause::Newton { h, .. } => (
                format!(
                    "the equations of the step from t = {t:.6} s, {h:.1e} s long, have no solution \
                     that Newton's iteration finds"
                ),
                "use a smaller step, or step control (rtol, atol); check forces and laws at this state",
            ),
            Cause::NotFinite { t } => (
                format!("the motion became infinite or undefined at t = {t:.6} s"),
                "use a smaller step or tolerance; check forces and laws at this state",
            ),
            Cause::MaxSteps { steps } => (
                format!("max_steps = {steps} steps ended at t = {t:.6} s"),
                "raise max_steps, or loosen the tolerance",
            ),
        };
        Self::Integration { t, message, hint }
    }
}

impl fmt::Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Singular { message, .. }
            | Self::Option { message, .. }
            | Self::Integration { message, .. } => f.write_str(message),
        }
    }
}
