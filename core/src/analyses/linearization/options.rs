//! Options of `modes`.

use super::names::{output, Input};
use crate::analyses::options::{count, name, options, Kind, Reader};
use crate::elements::{Default, Shape};
use crate::model::{Model, Problem, Value};

/// Declares a kind of option: names that are checked one by one.
macro_rules! names {
    ($(#[doc = $doc:literal])* $kind:ident, $must:literal, $check:expr) => {
        $(#[doc = $doc])*
        #[allow(non_camel_case_types)] // a type in `options!`, written like a word
        pub enum $kind {}
        impl Kind for $kind {
            type Value = Vec<String>;

            fn shape() -> Shape {
                Shape::Quantities
            }
            fn data(_: &Vec<String>) -> Default {
                Default::Absent
            }
            fn read(reader: &mut Reader<'_>, key: &'static str, _: &'static str) -> Option<Vec<String>> {
                let Some(Value::List(items)) = reader.get(key) else {
                    return reader.refuse(key, concat!("must be a list of ", $must));
                };
                let mut names = Vec::new();
                for item in items {
                    let Value::Text(name) = item else {
                        return reader.refuse(key, concat!("must be a list of ", $must));
                    };
                    let check: fn(&Model, &str) -> Option<Problem> = $check;
                    match check(reader.model(), name) {
                        Some(problem) => return reader.report(key, problem),
                        None => names.push(name.clone()),
                    }
                }
                Some(names)
            }
        }
    };
}

names! {
    /// Names of inputs.
    inputs, "parameters and position quantities", |model, name| Input::named(model, name).err()
}

names! {
    /// Names of outputs.
    outputs, "quantities", |model, name| output(model, name).err()
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
        use crate::analyses::options::Declared;
        Reader::read(model, fields, path, Self::read)
    }
}
