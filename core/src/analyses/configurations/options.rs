//! Options of the list of configurations.

use crate::analyses::assemble::{targets, Target};
use crate::analyses::options::{count, kind, name, options};
use crate::model::Value;

/// Default of the largest number of configurations.
const LIMIT: usize = 100;

kind! {
    /// Values of coordinates and other position quantities by name.
    coordinates: Vec<Target>, Values, |reader, key| {
        let Some(Value::Table(fields)) = reader.get(key) else {
            return reader.refuse(key, "must be a table such as { \"crank.angle\" = \"70 deg\" }");
        };
        match targets(reader.model(), key, fields) {
            Ok(found) => Some(found),
            Err(problems) => reader.table(key, |inner| {
                for problem in problems {
                    let name = problem.path.last().cloned().unwrap_or_default();
                    inner.report::<()>(&name, problem);
                }
                None
            }),
        }
    }
}

options! {
    /// All positions in which the mechanism closes, for given values of its drivers and of `set`.
    Options, "configurations", "Configurations" () {
        /// Values of coordinates and other position quantities that hold exactly, as in
        /// `start.set`. If absent, the values of the start.
        set: coordinates = Vec::new(),
        /// Largest number of configurations.
        limit: count = LIMIT,
        /// State whose time is used: "start", or the name of an earlier analysis to use its final
        /// state. If absent, the final state of the previous analysis.
        from: Option<name> = None,
    }
}
