//! The diagnosis as an analysis.

use super::{as_json, diagnose, Options};
use crate::analyses::record::{Analysis, Observer, Record, StartState, Subject, Unfinished};

impl Analysis for Options {
    const NUMBERS: &'static [(&'static str, &'static str)] = &[
        ("degrees_of_freedom", ""),
        ("gruebler", ""),
        ("rank", ""),
        ("driven", ""),
        ("redundant", ""),
        ("singular", ""),
        ("locked", ""),
        ("loose", ""),
        ("undetermined", ""),
    ];

    fn run(
        &self,
        subject: &Subject<'_>,
        start: &StartState,
        _: Observer<'_>,
    ) -> Result<Record, Box<Unfinished>> {
        let found = diagnose(&subject.released(start), &start.state);
        Ok(Record::new(as_json(&found), start.clone()))
    }
}
