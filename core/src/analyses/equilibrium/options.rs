//! Options of equilibrium.

use crate::analyses::assemble::position;
use crate::analyses::options::{flag, interval, name, options, Declared, Kind, Reader};
use crate::elements::{Default, Shape};
use crate::expression::suggest::did_you_mean;
use crate::model::{Model, Problem, Value};

/// Names of position quantities.
#[allow(non_camel_case_types)] // a type in `options!`, written like a word
pub enum positions {}

impl Kind for positions {
    type Value = Vec<String>;

    fn shape() -> Shape {
        Shape::Quantities
    }

    fn data(_: &Vec<String>) -> Default {
        Default::Absent
    }

    fn read(reader: &mut Reader<'_>, key: &'static str, _: &'static str) -> Option<Vec<String>> {
        let Some(Value::List(items)) = reader.get(key) else {
            return reader
                .refuse(key, "must be a list of position quantities, such as [\"crank.angle\"]");
        };
        let mut names: Vec<String> = Vec::new();
        for item in items {
            let Value::Text(name) = item else {
                return reader.refuse(key, "must be a list of position quantities");
            };
            if let Err(problem) = position(reader.model(), name) {
                return reader.report(key, problem);
            }
            if names.contains(name) {
                return reader.refuse(key, format!("{name} is listed twice"));
            }
            names.push(name.clone());
        }
        Some(names)
    }
}

options! {
    /// The position in which a mechanism comes to rest, with its stability; or all positions of rest along a path over a
    /// parameter.
    Options, "equilibrium", "Equilibrium" () {
        /// Position quantities that a holder keeps at their values of the start, such as `crank.angle`.
        hold: positions = Vec::new(),
        /// A parameter of the model, over which a path of equilibria is followed.
        over: Option<name> = None,
        /// First and last value of `over`, in SI units and rad.
        range: Option<interval> = None,
        /// Whether the equilibrium nearest to the start is wanted, stable or not.
        nearest: flag = false,
        /// State at which it starts: "start", or the name of an earlier analysis for the end of that analysis. If
        /// absent, the end of the analysis before it.
        from: Option<name> = None,
    }
}

impl Options {
    /// Reads the fields of an analysis of this type; `path` is its path in the file.
    ///
    /// # Errors
    /// Every faulty value, with its path.
    pub fn checked(
        model: &Model,
        fields: &[(String, Value)],
        path: &[String],
    ) -> Result<Self, Vec<Problem>> {
        let read = Reader::read(model, fields, path, Self::read)?;
        let fault = |key: &str, message: String| {
            let path: Vec<&str> = path.iter().map(String::as_str).chain([key]).collect();
            Err(vec![Problem::at(&path, message)])
        };
        match (&read.over, read.range) {
            (Some(_), None) => {
                fault("range", "missing; over needs it: range = [first, last]".to_string())
            }
            (None, Some(_)) => {
                fault("over", "missing; range needs it: over = \"load\"".to_string())
            }
            (Some(over), Some([first, last])) => {
                let known = &model.blueprint.parameters;
                if !known.contains(over) {
                    let hint =
                        did_you_mean(over, known).map_or(String::new(), |h| format!("; {h}"));
                    return fault("over", format!("there is no parameter '{over}'{hint}"));
                }
                if first == last {
                    return fault("range", "has no length; give two different values".to_string());
                }
                Ok(read)
            }
            (None, None) => Ok(read),
        }
    }
}
