//! Options of equilibrium.

use crate::analyses::assemble::position;
use crate::analyses::options::{flag, interval, kind, name, options};
use crate::math::Listed;
use crate::model::{did_you_mean, Model, Problem};

kind! {
    /// Names of position quantities.
    positions: Vec<String>, Quantities, |reader, key| {
        let what = "position quantities, such as [\"crank.angle\"]";
        reader.names(key, what, |model, name, before| {
            if before.iter().any(|known| known == name) {
                return Err(Problem::new(format!("{name} is listed twice")));
            }
            position(model, name).map(|_| ())
        })
    }
}

options! {
    /// Position in which a mechanism comes to rest, with its stability; or all positions of rest
    /// along a path over a parameter.
    Options, "equilibrium", "Equilibrium" () {
        /// Position quantities that are held at their initial values, such as `crank.angle`.
        hold: positions = Vec::new(),
        /// Parameter of the model over which a path of equilibria is followed.
        over: Option<name> = None,
        /// First and last value of `over`, in SI units and rad.
        range: Option<interval> = None,
        /// Whether to find the equilibrium nearest to the start, stable or not.
        nearest: flag = false,
        /// State at which the analysis starts: "start", or the name of an earlier analysis to use
        /// its final state. If absent, the final state of the previous analysis.
        from: Option<name> = None,
    }
    conflict conflict;
}

/// A path needs a parameter and its range.
fn conflict(options: &Options, model: &Model) -> Option<(&'static str, String)> {
    match (&options.over, options.range) {
        (Some(_), None) => {
            Some(("range", "missing; over needs it: range = [first, last]".to_string()))
        }
        (None, Some(_)) => Some(("over", "missing; range needs it: over = \"load\"".to_string())),
        (Some(over), Some([first, last])) => {
            let known = &model.blueprint.parameters;
            if !known.contains(over) {
                let known = known.iter().map(String::as_str).list();
                let hint = did_you_mean(over, &known, "parameters");
                let hint = hint.map_or(String::new(), |hint| format!("; {hint}"));
                return Some(("over", format!("there is no parameter '{over}'{hint}")));
            }
            let empty = "has no length; give two different values".to_string();
            (first == last).then_some(("range", empty))
        }
        (None, None) => None,
    }
}
