//! Running the analyses of a case.

use super::Case;
use crate::analyses::assemble::assemble_until;
use crate::analyses::record::{
    Observer, Outcome, Record, RunResult, StartState, Subject, Unfinished,
};
use crate::analyses::{fields_of, run_after, start_of, AnyAnalysis};
use crate::model::{Model, Value};

impl Case {
    /// The assembled mechanism at the start.
    ///
    /// # Errors
    /// The faults of the start, or the reason that the mechanism does not close.
    pub fn assembled(&self, model: &Model, stop: &dyn Fn() -> bool) -> Result<StartState, Outcome> {
        let request = self.start.request(model).map_err(|problems| Outcome::from(problems.0))?;
        let (state, _) = assemble_until(model, &request, stop).map_err(|failure| *failure)?;
        Ok(StartState::new(state))
    }

    /// The fields of an analysis. One that can hold coordinates holds those of the start if it names none.
    pub fn fields(&self, place: usize) -> Vec<(String, Value)> {
        fields_of(&self.analyses[place], &self.start.set)
    }

    /// Runs an analysis after the analyses at whose ends it starts. Its remarks contain the remarks and doubts of these,
    /// each with the name of the analysis.
    ///
    /// # Errors
    /// The failure of the first analysis that cannot be run.
    pub fn run_to(
        &self,
        place: usize,
        subject: &Subject<'_>,
        mut observer: Observer<'_>,
    ) -> RunResult {
        let name = &self.analyses[place].name;
        let path = ["analyses".to_string(), name.clone()];
        let analysis = AnyAnalysis::read(subject.model(), &self.fields(place), &path)?;
        match start_of(&self.analyses, place) {
            None => {
                let start = self.assembled(subject.model(), observer.stop)?;
                analysis.run(subject, &start, observer)
            }
            Some(before) => {
                let earlier = self.run_to(before, subject, observer.again())?;
                let doubts = earlier.doubts().map(named(&self.analyses[before].name));
                let earlier_remarks: Vec<_> =
                    earlier.remarks.iter().cloned().chain(doubts).collect();
                let remarked = |mut record: Record| {
                    let own = record.remarks.iter().map(named(name));
                    record.remarks = earlier_remarks.into_iter().chain(own).collect();
                    record
                };
                match run_after(&analysis, subject, &earlier.end, observer) {
                    Ok(record) => Ok(remarked(record)),
                    Err(failed) => {
                        let Unfinished { outcome, record } = *failed;
                        Err(Box::new(Unfinished { outcome, record: record.map(remarked) }))
                    }
                }
            }
        }
    }
}

/// Writes the name of an analysis before a remark.
fn named(name: &str) -> impl Fn(&String) -> String + '_ {
    move |remark| format!("{name}: {remark}")
}
