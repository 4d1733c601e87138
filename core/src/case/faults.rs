//! The faults of a case that only its model shows.

use super::Case;
use crate::analyses::{self, assemble, measures};
use crate::model::{Model, Problem};

impl Case {
    /// Everything that is wrong with the measures, the start and the analyses and is known without an assembly or a run.
    pub fn faults(&self, model: &Model) -> Vec<Problem> {
        let start = [("set", &self.start.set), ("guess", &self.start.guess)];
        let start = start.into_iter().flat_map(|(section, targets)| {
            assemble::targets(model, section, targets).err().unwrap_or_default()
        });
        let measures = measures::check(model, &self.definition.measures);
        let found = measures.into_iter().chain(start);
        found.chain(analyses::check(model, &self.analyses)).collect()
    }
}
