//! The faults of a case that only its model shows.

use super::Case;
use crate::analyses::{self, assemble};
use crate::model::{Model, Problem};

impl Case {
    /// Everything that is wrong with the start and the analyses and is known without an assembly or a run.
    pub fn faults(&self, model: &Model) -> Vec<Problem> {
        let start = [("set", &self.start.set), ("guess", &self.start.guess)];
        let start = start.into_iter().flat_map(|(section, targets)| {
            assemble::targets(model, section, targets).err().unwrap_or_default()
        });
        start.chain(analyses::check(model, &self.analyses)).collect()
    }
}
