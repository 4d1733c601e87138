//! Options of `modes`.

use super::names::{output, Input};
use crate::analyses::options::{count, kind, name, options};

kind! {
    /// Names of inputs.
    inputs: Vec<String>, Quantities, |reader, key| {
        let what = "parameters and position quantities";
        reader.names(key, what, |model, name, _| Input::named(model, name).map(|_| ()))
    }
}

kind! {
    /// Names of outputs.
    outputs: Vec<String>, Quantities, |reader, key| {
        reader.names(key, "quantities", |model, name, _| output(model, name).map(|_| ()))
    }
}

options! {
    /// Frequencies, damping and shapes of small motions about a state, with the state-space matrices of named inputs and
    /// outputs.
    Options, "modes", "Modes" () {
        /// Number of modes, the slowest first; if absent, all.
        n: Option<count> = None,
        /// Parameters of forces, or position quantities such as `crank.angle` for their generalized force.
        inputs: inputs = Vec::new(),
        /// Quantities.
        outputs: outputs = Vec::new(),
        /// State about which the motions are small: "start", or the name of an earlier analysis for the end of that
        /// analysis. If absent, the end of the analysis before it.
        from: Option<name> = None,
    }
}
