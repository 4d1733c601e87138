//! The analyses of a case in their order: where each starts, and the checks that need no run.

use super::analysis_table::{declarations, kind_of, AnyAnalysis};
use super::assemble::{assemble_until, Request};
use super::conditions::Condition;
use super::record::{ErrorClass, Observer, Outcome, RunResult, StartState, Subject};
use crate::math::{Listed, ShortArray};
use crate::model::{Entry, Model, Problem, Value};

/// The option that holds coordinates. An analysis without it holds those of the start.
const HELD: &str = "set";

/// The index of the analysis at whose end an analysis starts: the one that `from` names, or the one before it. None at
/// the start of the case.
pub fn start_of(analyses: &[Entry], place: usize) -> Option<usize> {
    match analyses[place].get("from") {
        Some(Value::Text(name)) => analyses[..place].iter().rposition(|entry| entry.name == *name),
        _ => place.checked_sub(1),
    }
}

/// The analyses that lead to an analysis, in order: each starts at the end of the one before it.
pub fn chain(analyses: &[Entry], place: usize) -> Vec<usize> {
    let mut found = vec![place];
    while let Some(before) = start_of(analyses, found[found.len() - 1]) {
        found.push(before);
    }
    found.reverse();
    found
}

/// The fields of an analysis. One that can hold coordinates holds those of the start, `set`, if it names none.
pub fn fields_of(entry: &Entry, set: &[(String, Value)]) -> Vec<(String, Value)> {
    let kind = kind_of(&entry.fields);
    let declared = declarations().iter().find(|declared| declared.table.name == kind);
    let holds = declared.is_some_and(|d| d.table.fields.iter().any(|f| f.name == HELD));
    let mut fields = entry.fields.clone();
    if holds && entry.get(HELD).is_none() && !set.is_empty() {
        fields.push((HELD.to_string(), Value::Table(set.to_vec())));
    }
    fields
}

/// Runs an analysis from the end of another one. If joints have drifted there, it starts in the nearest state that
/// meets the constraints, and a remark gives the opening.
///
/// # Errors
/// [`Unfinished`](super::record::Unfinished).
pub fn run_after(
    analysis: &AnyAnalysis,
    subject: &Subject<'_>,
    end: &StartState,
    mut observer: Observer<'_>,
) -> RunResult {
    let failed = match analysis.run(subject, end, observer.again()) {
        Err(failed) if is_open(&failed.outcome) && !analysis.changes_parameters() => failed,
        other => return other,
    };
    let (t, state) = (end.state.t, Some(end.state.clone()));
    let request = Request { state, t, ..Request::default() };
    let (state, _) = assemble_until(&subject.released(end), &request, observer.stop)
        .map_err(|failure| Outcome::from(*failure))?;
    let mut record = analysis.run(subject, &end.at(state), observer)?;
    let message = failed.outcome.message;
    record.remarks.push(format!("{message}; it starts from the nearest state that does"));
    Ok(record)
}

/// Whether an analysis failed because its start does not meet the constraints.
fn is_open(outcome: &Outcome) -> bool {
    outcome.class == ErrorClass::Assembly
}

/// All problems of a sequence of analyses that begins with an assembled start at t = 0.
pub fn check(model: &Model, analyses: &[Entry]) -> Vec<Problem> {
    let mut problems = releases(model);
    // the end time of each analysis, if it is known
    let mut ends: Vec<Option<f64>> = Vec::new();
    for (place, entry) in analyses.iter().enumerate() {
        let begin = start_of(analyses, place).map_or(Some(0.0), |before| ends[before]);
        let path = ["analyses".to_string(), entry.name.clone()];
        let read = AnyAnalysis::read(model, &entry.fields, &path);
        let end = read
            .and_then(|analysis| analysis.ends(model, begin).map_err(|found| within(&path, found)));
        ends.push(end.unwrap_or_else(|found| {
            problems.extend(found);
            None
        }));
    }
    problems
}

/// Problems with their paths in the file.
fn within(path: &[String], problems: Vec<Problem>) -> Vec<Problem> {
    let one = |problem: Problem| Problem { path: [path, &problem.path].concat(), ..problem };
    problems.into_iter().map(one).list()
}

/// The problems of release conditions of drivers.
fn releases(model: &Model) -> Vec<Problem> {
    let wrong = model.constraints.iter().filter_map(|driver| {
        let problem = Condition::read(model, &[], driver.element.release()?).err()?;
        let path = ["drivers", &driver.name, "release"].each(str::to_string).to_vec();
        Some(Problem { path, ..problem })
    });
    wrong.list()
}
