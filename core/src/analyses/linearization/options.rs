//! Options of `modes`.

use super::names::{output, Input};
use crate::analyses::options::{count, flag, kind, name, options};

kind! {
    /// Parameters of forces, or position quantities such as `crank.angle`. The input at a quantity
    /// is its generalized force.
    inputs: Vec<String>, Quantities, |reader, key| {
        let what = "parameters and position quantities";
        reader.names(key, what, |model, name, _| Input::named(model, name).map(|_| ()))
    }
}

kind! {
    /// Quantities of the mechanism, such as `crank.angle`.
    outputs: Vec<String>, Quantities, |reader, key| {
        reader.names(key, "quantities", |model, name, _| output(model, name).map(|_| ()))
    }
}

options! {
    /// Frequencies, damping and shapes of small motions about a state, with the state-space matrices of named inputs and
    /// outputs.
    Options, "modes", "Modes" () {
        /// Number of modes, the slowest first; if absent, all modes.
        n: Option<count> = None,
        /// Parameters of forces, or position quantities such as `crank.angle` for their generalized force.
        inputs: inputs = Vec::new(),
        /// Quantities.
        outputs: outputs = Vec::new(),
        /// Whether friction that sticks at the state locks its joint. Otherwise small motions slide.
        lock_friction: flag = false,
        /// Whether small motions are those in a frame that rotates with the mechanism, as for a blade
        /// at speed: all bodies rotate about one point of ground with the same constant rate, and
        /// there is no gravity.
        rotating: flag = false,
        /// State about which the motions are small: "start", or the name of an earlier analysis to
        /// use its final state. If absent, the final state of the previous analysis.
        from: Option<name> = None,
    }
}
