//! Positions of rest against closed forms and independent searches.

mod chain;
mod fifty;
mod one_freedom;
mod paths;
mod refused;
mod robust;

use kempe::analyses::equilibrium::{equilibrium, Equilibrium, Options, Reason};
use kempe::analyses::State;
use kempe::integrate::Flow;
use kempe::model::Model;

/// The position of rest with default options.
pub fn rest(model: &Model, start: &State) -> Equilibrium {
    found(model, start, &Options::new()).unwrap_or_else(|reason| panic!("{reason}"))
}

/// The position of rest, or the reason that there is none.
pub fn found(model: &Model, start: &State, options: &Options) -> Result<Equilibrium, Reason> {
    equilibrium(model, start, options, |_| Flow::Continue)
}

/// Options with holders.
pub fn holding(names: &[&str]) -> Options {
    Options { hold: names.iter().map(ToString::to_string).collect(), ..Options::new() }
}
