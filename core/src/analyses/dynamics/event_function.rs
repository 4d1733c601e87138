//! The functions of the state whose changes of sign are events.

use super::modes::ModeFunction;
use crate::analyses::conditions::Condition;
use crate::analyses::signals::Seen;
use crate::model::Model;

/// A function of the state.
#[derive(Clone, Copy)]
pub(super) enum EventFunction<'a> {
    /// The function of a condition in a case.
    Condition(&'a Condition),
    /// The function of a force with modes; it is positive while the mode lasts.
    Mode(ModeFunction),
    /// An event that no longer occurs.
    Never,
}

impl EventFunction<'_> {
    /// The value at a state.
    pub fn value(&self, model: &Model, seen: &Seen<'_>) -> f64 {
        match self {
            Self::Condition(condition) => condition.value(model, seen),
            Self::Mode(of) => of.value(model, seen),
            Self::Never => 1.0,
        }
    }

    /// Whether the value needs the solution of the equations of motion.
    pub fn needs_solution(&self) -> bool {
        match self {
            Self::Condition(condition) => condition.needs_solution,
            Self::Mode(of) => of.needs_solution(),
            Self::Never => false,
        }
    }

    /// The value that replaces a zero of the function, because a quantity may rest where both sides of a comparison
    /// are equal.
    pub fn at_zero(&self) -> f64 {
        let holds = match self {
            Self::Condition(condition) => condition.holds_at_zero(),
            Self::Mode(_) | Self::Never => None,
        };
        holds.map_or(0.0, |holds| if holds { f64::MIN_POSITIVE } else { -f64::MIN_POSITIVE })
    }
}
