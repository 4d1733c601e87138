//! The faults of a case that can be found only with its model.

use super::{columns, exercise, tasks, Case};
use crate::analyses::{self, assemble, measures};
use crate::math::Listed;
use crate::model::{Model, Problem, Value};

impl Case {
    /// All faults of the measures, the start, the analyses and the requests for many runs that can be found without an
    /// assembly or a run.
    pub fn faults(&self, model: &Model) -> Vec<Problem> {
        let start = [("set", &self.start.set), ("guess", &self.start.guess)];
        let start = start.into_iter().flat_map(|(section, targets)| {
            assemble::targets(model, section, targets).err().unwrap_or_default()
        });
        let found = measures::check(model, &self.definition.measures).into_iter().chain(start);
        let found = found.chain(analyses::check(model, &self.analyses));
        let kinds: Vec<(String, String)> = self
            .analyses
            .iter()
            .filter_map(|entry| match entry.get("type") {
                Some(Value::Text(kind)) => Some((entry.name.clone(), kind.clone())),
                _ => None,
            })
            .list();
        let measures = &self.definition.measures;
        let sections = [
            ("sweep", &self.sweep[..]),
            ("gradient", &self.gradient),
            ("optimize", &self.optimize),
            ("fit", &self.fit),
        ];
        let of_sections =
            sections.into_iter().flat_map(|one| columns::faults(model, one, measures, &kinds));
        let of_exercise = tasks::faults(model, &self.exercise, measures, &kinds);
        let of_exercise = of_exercise.into_iter().chain(exercise::unit_faults(self));
        found.chain(of_sections).chain(of_exercise).list()
    }
}
