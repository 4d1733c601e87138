//! Inputs and outputs of linear equations by name.

use crate::analyses::signal_names::{names, signal};
use crate::analyses::signals::{Energy, Signal};
use crate::expression::suggest::did_you_mean;
use crate::math::Listed;
use crate::model::{Model, Problem};

/// What an input may be.
const INPUT: &str =
    "an input is a parameter of a force, or a position quantity such as crank.angle, for its \
                     generalized force";

/// An input.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Input {
    /// The index of a parameter.
    Parameter(usize),
    /// A position quantity: the input is its generalized force.
    Quantity(Signal),
}

impl Input {
    /// The input with this name.
    ///
    /// # Errors
    /// There is no parameter or position quantity of this name.
    pub fn named(model: &Model, name: &str) -> Result<Self, Problem> {
        let parameters = &model.blueprint.parameters;
        if let Some(k) = parameters.iter().position(|known| known == name) {
            return Ok(Self::Parameter(k));
        }
        match signal(model, name) {
            Some(
                found @ (Signal::Column { order: 0, .. }
                | Signal::Point { order: 0, .. }
                | Signal::Measured { order: 0, .. }),
            ) => Ok(Self::Quantity(found)),
            Some(_) => {
                let message = format!("'{name}' is not a position quantity");
                Err(Problem::new(message).hint(INPUT))
            }
            None => {
                let known = parameters.iter().cloned().chain(names(model, name));
                let problem = unknown("parameter or quantity", name, known);
                Err(problem.maybe_hint(Some(INPUT.to_string())))
            }
        }
    }
}

/// The output with this name.
///
/// # Errors
/// There is no such quantity, or it is not a function of the state.
pub(super) fn output(model: &Model, name: &str) -> Result<Signal, Problem> {
    match signal(model, name) {
        Some(
            Signal::Energy(Energy::Dissipated | Energy::Work | Energy::Total | Energy::Balance)
            | Signal::ForceDissipated(_)
            | Signal::Balance
            | Signal::Drift { .. },
        ) => {
            let message = format!("'{name}' depends on the run, not on the state alone");
            Err(Problem::new(message).hint("remove it from the outputs"))
        }
        Some(found) => Ok(found),
        None => Err(unknown("quantity", name, names(model, name).into_iter())),
    }
}

fn unknown(what: &str, name: &str, known: impl Iterator<Item = String>) -> Problem {
    let known: Vec<String> = known.list();
    let known: Vec<&str> = known.iter().map(String::as_str).list();
    Problem::new(format!("unknown {what} '{name}'")).maybe_hint(did_you_mean(name, &known))
}
