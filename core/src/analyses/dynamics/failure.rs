//! Failures of forward dynamics, in terms of the mechanism.

use super::law_fault::{undefined_law, LawFault};
use super::law_jump::{LawJump, SMOOTH};
use super::no_mass;
use super::run_results::Run;
use crate::analyses::mobility::dependent;
use crate::elements::Equation;
use crate::expression::TABLE_ENDS;
use crate::integrate::Cause;
use crate::math::{Listed, ShortArray};
use crate::model::{is_inner, size, Model, Switch};
use crate::solve::Breakdown;
use std::fmt;

/// A failed run or evaluation, with the results up to the failure.
#[derive(Clone, Debug, PartialEq)]
pub struct Failure {
    /// The reason.
    pub reason: Reason,
    /// The results of a run before the failure; otherwise empty.
    pub run: Run,
}

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
    /// A joint repeats others, so its reaction is not unique, and a force depends on this reaction.
    Redundant {
        /// Time, s.
        t: f64,
        /// The joint.
        name: String,
        /// Description.
        message: String,
        /// Remedy.
        hint: &'static str,
    },
    /// A law that no run can follow. It is found before the run.
    Law {
        /// The time at which the law cannot be followed, s.
        t: f64,
        /// The joint, driver or force.
        name: String,
        /// Description.
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

/// Mismatch of lengths, relative to the size, above which two motions past a change point are distinct.
const MEET: f64 = 1e-8;

impl From<Reason> for Box<Failure> {
    fn from(reason: Reason) -> Self {
        Self::new(Failure { reason, run: Run::default() })
    }
}

impl Failure {
    /// Failure of equations that have no usable solution at a time and a position.
    pub(super) fn at_state(model: &Model, t: f64, q: &[f64], breakdown: Breakdown) -> Box<Self> {
        let name = |row| model.constraints[model.layout.owner(row).0].name.clone();
        let (name, message) = match breakdown {
            Breakdown::Row(row) => {
                let message = format!(
                    "singular position at t = {t:.6} s: constraint {} depends on the others, \
                     so reactions and accelerations are not unique{}",
                    equation(model, row).0,
                    place(model, t, q, row)
                );
                (name(row), message)
            }
            Breakdown::Passable(row) => return Self::passable(model, t, q, row),
            Breakdown::AtRest(row) => {
                let message = format!(
                    "singular position at t = {t:.6} s: the mechanism is almost at rest where its motion can \
                     continue in more than one way{}",
                    place(model, t, q, row)
                );
                (name(row), message)
            }
            Breakdown::Beside { row, left } => (name(row), beside(model, t, q, (row, left))),
            Breakdown::Reaction(row) => return Self::reaction(model, t, q, row),
            Breakdown::Column(column) => no_mass::undetermined(model, t, column),
            Breakdown::Open { gap, .. } if gap.is_nan() => return Self::undefined(model, t, q),
            Breakdown::Open { row, gap } => {
                let message = format!(
                    "projection fails at t = {t:.6} s: constraint {} stays open by {gap:.1e}",
                    equation(model, row).0
                );
                let hint = "use smaller steps or tolerances";
                return Reason::Integration { t, message, hint }.into();
            }
            Breakdown::Apart { row, gap, most } => {
                let (name, unit) = equation(model, row);
                let [gap, most] = apart_in_print(gap, most);
                let message = format!(
                    "the joints come apart at t = {t:.6} s: constraint {name} is open by {gap} {unit}, more \
                     than {most} {unit}"
                );
                let hint = "use stabilization projection, or a smaller tolerance or step; with Baumgarte, smaller gains \
                            where beta times the step exceeds 1, else greater ones; a start must meet the \
                            constraints; check the size of the forces";
                return Reason::Integration { t, message, hint }.into();
            }
            Breakdown::NotFinite => return Self::undefined(model, t, q),
            _ => return at_switch(model, t, breakdown),
        };
        Reason::Singular { t, name, message }.into()
    }

    /// Failure of equations with a number that is not finite at a time and a position.
    fn undefined(model: &Model, t: f64, q: &[f64]) -> Box<Self> {
        let rest = vec![0.0; q.len()];
        let (message, hint) = not_finite(t, undefined_law(model, (t, t), [q, &rest, &[]]));
        Reason::Integration { t, message, hint }.into()
    }

    /// Failure of a dependent row at a position that a run with projection could pass.
    fn passable(model: &Model, t: f64, q: &[f64], row: usize) -> Box<Self> {
        let mut failure = Self::at_state(model, t, q, Breakdown::Row(row));
        if let Reason::Singular { message, .. } = &mut failure.reason {
            message.push_str("; a run with stabilization projection passes this position");
        }
        failure
    }

    /// Failure of a condition that changes faster than steps can follow.
    pub(super) fn too_fast(name: &str, t: f64) -> Box<Self> {
        let message = format!(
            "the condition of {name} may change more than a million times in the step from t = {t:.6} s"
        );
        let hint = "use a condition that changes less often, or a smooth mean value; or limit the steps by max_step";
        Reason::Integration { t, message, hint }.into()
    }

    /// Failure of an integrator that stopped at a time `t` and a state `y`.
    pub(super) fn of_integrator(
        model: &Model,
        cause: Cause<Breakdown>,
        t: f64,
        y: &[f64],
    ) -> Box<Self> {
        let [q, v, z, _] = model.layout.split(y);
        let law = |failed| undefined_law(model, (t, failed), [q, v, z]);
        let (message, hint) = match cause {
            Cause::Equations { t, error } if is_undefined(error) => not_finite(t, law(t)),
            Cause::Equations { t, error } => {
                return Self::at_state(model, t, q, error)
            }
            Cause::Argument { name, value, must } => {
                let message = format!("{name}: {value}; must be {must}");
                return Reason::Option { name, message }.into();
            }
            Cause::StepTooSmall { h, .. } => {
                let step = format!("the step fell to {h:.1e} s at t = {t:.6} s");
                match law(t) {
                    Some(law) => (format!("{step}: {}", law_ends(&law)), remedy(&law)),
                    None => (
                        format!("{step}: the tolerance cannot be met"),
                        "a singular position or a discontinuity lies here; look at the solution so far",
                    ),
                }
            }
            Cause::NotFinite { t } => not_finite(t, law(t)),
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
                if model.bodies.iter().any(|body| is_inner(&body.name)) {
                    "give the beams damping, shear = false and inextensible = true; or raise max_steps, or loosen \
                     the tolerance"
                } else {
                    "raise max_steps, or loosen the tolerance"
                },
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
        Reason::Integration { t, message, hint }.into()
    }
}

/// Failure at a switch: a law jumps, the motion slides along the switch, or the steps are too long for a contact.
fn at_switch(model: &Model, t: f64, breakdown: Breakdown) -> Box<Failure> {
    let switch = match breakdown {
        Breakdown::Sliding(switch) => switch,
        Breakdown::TooFast(switch) => {
            let Switch { owner, law, .. } = model.switches[switch];
            let what = if law { "a law of " } else { "" };
            return Failure::too_fast(&format!("{what}{}", model.owner_name(owner)), t);
        }
        Breakdown::Jump { constraint, position, values } => {
            let message = LawJump { constraint, position, values }.describe(model, t);
            return Reason::Integration { t, message, hint: SMOOTH }.into();
        }
        Breakdown::Unresolved { force, lasts, step } => {
            let name = &model.forces[force].name;
            let message = format!(
                "constant steps of {step:.3e} s are too long for {name}, which begins to touch at t = {t:.6} s and \
                 does so for about {lasts:.1e} s"
            );
            let hint = "use at least ten steps for this time, a method that chooses its steps such as auto or dop853, \
                        or restitution in place of stiffness";
            return Reason::Integration { t, message, hint }.into();
        }
        other => unreachable!("{other:?} is not at a switch"),
    };
    let Switch { owner, law, .. } = model.switches[switch];
    let message = format!(
        "{}{} switches back and forth at t = {t:.6} s: on both sides of its condition the motion returns to it",
        if law { "a law of " } else { "" },
        model.owner_name(owner)
    );
    let hint = "use a friction element, which may stick and whose load may be a law; or replace the jump by a steep smooth \
                function: sign(x) by tanh(x/x0), with x0 small against the usual x";
    Reason::Integration { t, message, hint }.into()
}

/// Whether numbers are not finite, so that a law may have no value.
fn is_undefined(breakdown: Breakdown) -> bool {
    match breakdown {
        Breakdown::NotFinite => true,
        Breakdown::Open { gap, .. } => gap.is_nan(),
        _ => false,
    }
}

fn not_finite(t: f64, law: Option<LawFault>) -> (String, &'static str) {
    let message = format!("the motion became infinite or undefined at t = {t:.6} s");
    match law {
        Some(law) => (format!("{message}: {}", law_ends(&law)), remedy(&law)),
        None => (message, "use a smaller step or tolerance; check forces and laws at this state"),
    }
}

fn remedy(fault: &LawFault) -> &'static str {
    match fault.table {
        Some(_) => TABLE_ENDS,
        None if !fault.written => {
            "the state is beyond its range; reduce its load or change its fields"
        }
        None => "write a formula that has a value during the whole run, or end the run before",
    }
}

fn law_ends(LawFault { law, table, .. }: &LawFault) -> String {
    match table {
        Some(table) => format!("the law {law} has no value there: {table}"),
        None => format!("the law {law} has no finite value there"),
    }
}

/// Two unequal numbers, with enough digits to show the difference.
fn apart_in_print(a: f64, b: f64) -> [String; 2] {
    let written = |digits: usize| [a, b].each(|x| format!("{x:.digits$e}"));
    (1..17).map(written).find(|[a, b]| a != b).unwrap_or_else(|| written(1))
}

/// The name and unit of a row of Φ, such as `B.x`.
pub(super) fn equation(model: &Model, row: usize) -> (String, &'static str) {
    let (k, equation) = model.layout.owner(row);
    let item = &model.constraints[k];
    let Equation { name, kind } = item.equations[equation];
    (format!("{}.{name}", item.name), kind.unit())
}

/// Largest number of bodies whose coordinates a message contains.
const MOST_BODIES: usize = 4;

/// The joints whose equations depend on each other, and the positions of the bodies.
fn place(model: &Model, t: f64, q: &[f64], row: usize) -> String {
    let joints = model.names_of(&dependent(model, t, q, row)).join(", ");
    format!(" (joints {joints}; {})", positions(model, q))
}

/// Two motions that pass each other without meeting.
fn beside(model: &Model, t: f64, q: &[f64], (row, left): (usize, f64)) -> String {
    let size = size(model);
    format!(
        "singular position at t = {t:.6} s: two motions pass each other without meeting, too near to be distinguished, \
         because lengths miss a change point by a little, less than {:.0e} m{}; make the lengths exact, so that the \
         motions meet, or, if no constraint is redundant, change them by more than {:.0e} m",
        left * size,
        place(model, t, q, row),
        MEET * size
    )
}

/// The positions of the bodies.
pub(super) fn positions(model: &Model, q: &[f64]) -> String {
    let bodies = model.bodies.iter().zip(&model.layout.bodies).skip(1).take(MOST_BODIES);
    let bodies = bodies.map(|(body, columns)| (body, columns.of(q)));
    let bodies: Vec<String> = bodies
        .map(|(b, q)| format!("{} x = {:.6} y = {:.6} angle = {:.6}", b.name, q[0], q[1], q[2]))
        .list();
    let more = if model.bodies.len() > MOST_BODIES + 1 { ", …" } else { "" };
    format!("at {}{more}", bodies.join(", "))
}

impl fmt::Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Singular { message, .. }
            | Self::Start { message, .. }
            | Self::Redundant { message, .. }
            | Self::Law { message, .. }
            | Self::Option { message, .. }
            | Self::Integration { message, .. } => f.write_str(message),
        }
    }
}
