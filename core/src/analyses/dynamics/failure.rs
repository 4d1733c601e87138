//! Failures of forward dynamics, in terms of the mechanism.

use super::constraint_violation::Violation;
use super::report_projection::Halt;
use crate::analyses::mobility::dependent;
use crate::elements::{BodyId, Equation};
use crate::equations::augmented::Dependent;
use crate::equations::Singular;
use crate::integrate::Cause;
use crate::model::Model;
use crate::stabilize::Fault;
use std::fmt;

/// The reason for which the integration stopped.
#[derive(Clone, Debug, PartialEq)]
pub enum Reason {
    /// The constraints lose rank: reactions and accelerations are not unique.
    Singular {
        /// Time, s.
        t: f64,
        /// The joint or driver whose equation depends on the others, or the body without mass.
        name: String,
        /// Description.
        message: String,
    },
    /// The first state does not meet the constraints.
    Start {
        /// Its time, s.
        t: f64,
        /// The joint or driver that is open.
        name: String,
        /// Description, with the gap.
        message: String,
        /// Remedy.
        hint: &'static str,
    },
    /// An option with an impossible value.
    Option {
        /// Its name.
        name: &'static str,
        /// Description.
        message: String,
    },
    /// The integrator failed.
    Integration {
        /// Time reached, s.
        t: f64,
        /// Description.
        message: String,
        /// Remedy.
        hint: &'static str,
    },
}

impl Reason {
    pub(super) fn singular(model: &Model, t: f64, q: &[f64], singular: Singular) -> Self {
        let (name, message) = match singular {
            Singular::Reaction(row) => {
                let name = model.constraints[model.layout.owner(row).0].name.clone();
                let message = format!(
                    "no reaction of {name} at t = {t:.6} s agrees with the forces that depend on it: \
                     with so much friction the mechanism jams; reduce the coefficient of friction"
                );
                (name, message)
            }
            Singular::Dependent(Dependent::Row(row)) => {
                let (k, equation) = model.layout.owner(row);
                let item = &model.constraints[k];
                let what = format!("{}.{}", item.name, item.equations[equation].name);
                let message = format!(
                    "singular position at t = {t:.6} s: constraint {what} depends on the others, \
                     so reactions and accelerations are not unique{}",
                    place(model, t, q, row)
                );
                (item.name.clone(), message)
            }
            Singular::Dependent(Dependent::Column(column)) => {
                let body = model.layout.body_of(column).map_or(BodyId::GROUND, |(body, _)| body);
                let body = &model.bodies[body.0];
                let (name, inertia) = (body.name.clone(), body.inertia);
                let (has, set) = match inertia > 0.0 {
                    true => {
                        (format!("hardly any moment of inertia ({inertia:.1e} kg·m²)"), "increase")
                    }
                    false => ("no moment of inertia".to_string(), "set"),
                };
                let message = format!(
                    "a torque acts on {name} at t = {t:.6} s, but {name} has {has} and no joint prevents its \
                    rotation; {set} its inertia"
                );
                (name, message)
            }
        };
        Self::Singular { t, name, message }
    }

    /// A mechanism at rest where branches of its motion meet.
    fn at_rest(model: &Model, t: f64, q: &[f64], row: usize) -> Self {
        let name = model.constraints[model.layout.owner(row).0].name.clone();
        let message = format!(
            "singular position at t = {t:.6} s: the mechanism is almost at rest where its motion can \
            continue in more than one way{}",
            place(model, t, q, row)
        );
        Self::Singular { t, name, message }
    }

    pub(super) fn fault(model: &Model, t: f64, q: &[f64], fault: Fault) -> Self {
        let (row, gap) = match fault {
            Fault::AtRest(Singular::Dependent(Dependent::Row(row))) => {
                return Self::at_rest(model, t, q, row)
            }
            Fault::Singular(singular) | Fault::AtRest(singular) => {
                return Self::singular(model, t, q, singular)
            }
            Fault::Passable(singular) => {
                let mut reason = Self::singular(model, t, q, singular);
                if let Self::Singular { message, .. } = &mut reason {
                    message.push_str("; a run with stabilization projection passes this position");
                }
                return reason;
            }
            Fault::Open { row, gap } => (row, gap),
        };
        let (k, equation) = model.layout.owner(row);
        let item = &model.constraints[k];
        let message = format!(
            "projection fails at t = {t:.6} s: constraint {}.{} stays open by {gap:.1e}",
            item.name, item.equations[equation].name
        );
        let hint = "use smaller steps or tolerances";
        Self::Integration { t, message, hint }
    }

    /// Joints that open too far.
    fn apart(model: &Model, t: f64, Violation { row, gap, most }: Violation) -> Self {
        let (k, equation) = model.layout.owner(row);
        let item = &model.constraints[k];
        let Equation { name, unit } = item.equations[equation];
        let message = format!(
            "the joints come apart at t = {t:.6} s: constraint {}.{name} is open by {gap:.1e} {unit}, more \
             than {most:.1e} {unit}",
            item.name
        );
        let hint = "use stabilization projection, a smaller tolerance or step, or greater gains; a start must \
                    meet the constraints";
        Self::Integration { t, message, hint }
    }

    pub(super) fn halt(model: &Model, t: f64, q: &[f64], halt: Halt) -> Self {
        match halt {
            Halt::Fault(fault) => Self::fault(model, t, q, fault),
            Halt::Violation(apart) => Self::apart(model, t, apart),
            Halt::NotFinite => {
                let (message, hint) = not_finite(t);
                Self::Integration { t, message, hint }
            }
        }
    }

    pub(super) fn from_integrator(
        model: &Model,
        cause: Cause<(f64, Fault)>,
        t: f64,
        y: &[f64],
    ) -> Self {
        let (message, hint) = match cause {
            Cause::Equations((at, fault)) => {
                return Self::fault(model, at, model.layout.split(y)[0], fault)
            }
            Cause::Argument { name, value, must } => {
                return Self::Option { name, message: format!("{name}: {value}; must be {must}") }
            }
            Cause::StepTooSmall { h, .. } => (
                format!("the step fell to {h:.1e} s at t = {t:.6} s: the tolerance cannot be met"),
                "a singular position or a discontinuity lies here; look at the solution so far",
            ),
            Cause::NotFinite { t } => not_finite(t),
            Cause::Newton { h, .. } => (
                format!(
                    "the equations of the step from t = {t:.6} s, {h:.1e} s long, have no solution \
                     that Newton's iteration finds"
                ),
                "use a smaller step, step control (rtol, atol), or an explicit method such as dop853; check \
                 forces and laws at this state",
            ),
            Cause::MaxSteps { steps } => (
                format!("max_steps = {steps} steps ended at t = {t:.6} s"),
                "raise max_steps, or loosen the tolerance",
            ),
            Cause::TooManySteps { needed, step, most } => {
                let needed =
                    if needed < 1e9 { format!("{needed}") } else { format!("{needed:.0e}") };
                let message = format!(
                    "{needed} steps of {step:e} s to t_end are more than max_steps = {most}"
                );
                (message, "take larger steps, or raise max_steps")
            }
        };
        Self::Integration { t, message, hint }
    }
}

fn not_finite(t: f64) -> (String, &'static str) {
    let message = format!("the motion became infinite or undefined at t = {t:.6} s");
    (message, "use a smaller step or tolerance; check forces and laws at this state")
}

/// Largest number of bodies whose coordinates a message contains.
const MOST_BODIES: usize = 4;

/// The joints that depend on each other, and the positions of the bodies.
fn place(model: &Model, t: f64, q: &[f64], row: usize) -> String {
    let joints = dependent(model, t, q, row);
    let joints: Vec<&str> = joints.iter().map(|k| model.constraints[*k].name.as_str()).collect();
    let bodies = model.bodies.iter().zip(&model.layout.bodies).skip(1).take(MOST_BODIES);
    let bodies = bodies.map(|(body, columns)| (body, columns.of(q)));
    let bodies: Vec<String> = bodies
        .map(|(b, q)| format!("{} x = {:.6} y = {:.6} angle = {:.6}", b.name, q[0], q[1], q[2]))
        .collect();
    let more = if model.bodies.len() > MOST_BODIES + 1 { ", …" } else { "" };
    format!(" (joints {}; at {}{more})", joints.join(", "), bodies.join(", "))
}

impl fmt::Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Singular { message, .. }
            | Self::Start { message, .. }
            | Self::Option { message, .. }
            | Self::Integration { message, .. } => f.write_str(message),
        }
    }
}
