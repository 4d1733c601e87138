//! When the analyses of a case begin and end.

use super::Case;
use crate::analyses::dynamics::Options;
use crate::model::{Problem, Value};
use std::collections::HashMap;

/// The time at which a case starts, s.
const START: f64 = 0.0;

/// The analyses that end before they begin.
///
/// # Arguments
/// `options` has one entry for each analysis; None where the options are faulty. Analyses that follow one are not
/// checked, because their start is not known.
pub fn backward(case: &Case, options: &[Option<Options>]) -> Vec<Problem> {
    let mut ends = HashMap::from([("start", Some(START))]);
    let (mut before, mut found) = (Some(START), Vec::new());
    for (entry, options) in case.analyses.iter().zip(options) {
        let begin = match entry.get("from") {
            Some(Value::Text(name)) => ends.get(name.as_str()).copied().flatten(),
            _ => before,
        };
        before = options.as_ref().map(|options| options.t_end);
        ends.insert(&entry.name, before);
        if let (Some(begin), Some(options)) = (begin, options) {
            let path = ["analyses", &entry.name, "t_end"];
            found.extend(options.backward(begin, &path));
        }
    }
    found
}
