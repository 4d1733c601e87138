//! Analyses for Python: without the interpreter's lock, interruptible, with progress.

use crate::attended::{attend, Attended, ENDING};
use crate::convert::{number, state, table, Row};
use crate::dynamics::PyRun;
use crate::errors::{raise, raise_plain, Failure, Kind};
use crate::guard::{guard, raised};
use crate::model::{written, PyModel};
use crate::watch::{ToEnd, Watch};
use kempe::analyses::dynamics::{Change, Prepared, Setting};
use kempe::analyses::record::{
    Driven, EventActions, Observer, Record, RunResult, StartState, Subject,
};
use kempe::analyses::{run_after, AnyAnalysis, State};
use kempe::case::{self, Case, Format};
use kempe::model::{Definition, Entry, Model, Value};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::sync::{Arc, Mutex, PoisonError};

/// What an analysis found.
#[pyclass(name = "Record", module = "kempe._core", frozen)]
pub struct PyRecord {
    /// The motion, if the result is one.
    #[pyo3(get)]
    run: Option<Py<PyRun>>,
    /// The mechanism in which a quantity replaces the time.
    #[pyo3(get)]
    driven: Option<Written>,
    /// Other numbers by name, (n, width).
    #[pyo3(get)]
    numbers: Py<PyDict>,
    /// The record without its motion, and the analysis and the model to which it belongs.
    record: Record,
    analysis: AnyAnalysis,
    model: Py<PyModel>,
}

/// A mechanism in which a quantity replaces the time: its model, its case as JSON, the quantity, its unit, its value
/// at the start, and whether the mechanism is at rest at each value.
type Written = (Py<PyModel>, String, String, String, f64, bool);

/// Time, q, v and z.
pub type At<'py> = (f64, Row<'py>, Row<'py>, Row<'py>);

impl PyRecord {
    fn new(
        py: Python<'_>,
        (model, analysis): (&Bound<'_, PyModel>, &AnyAnalysis),
        mut record: Record,
        message: &str,
    ) -> PyResult<Self> {
        let (driven, responses) = (record.driven.take(), record.responses.take());
        let driven = driven.map(|driven| write(py, driven)).transpose()?;
        let own = driven.as_ref().map_or(model, |(driven, ..)| driven.bind(py));
        let run = record
            .motion
            .take()
            .map(|motion| Py::new(py, PyRun::new(py, own, motion, responses, message)?));
        let numbers = PyDict::new(py);
        for of in &record.numbers {
            let [count, width] = of.shape;
            numbers.set_item(of.name, table(py, of.values.clone(), (count, width))?)?;
        }
        Ok(Self {
            run: run.transpose()?,
            driven,
            numbers: numbers.unbind(),
            record,
            analysis: analysis.clone(),
            model: model.clone().unbind(),
        })
    }
}

#[pymethods]
impl PyRecord {
    /// The other findings, as JSON.
    #[getter]
    fn findings(&self) -> String {
        self.record.findings.to_string()
    }

    /// Remarks that a user must see.
    #[getter]
    fn remarks(&self) -> Vec<String> {
        self.record.remarks.clone()
    }

    /// A number of a result that is not a motion, such as `lower`, `frequency[0]` or `rocker.angle`.
    fn number(&self, py: Python<'_>, text: &str) -> PyResult<f64> {
        guard("Record.number", || {
            let PyModel { definition, prepared, .. } = self.model.get();
            let subject = Subject { definition, prepared };
            let found = self.analysis.number(&subject, &self.record, text);
            found.map_err(|outcome| Failure::from(outcome).raise(py))
        })
    }
}

fn write(py: Python<'_>, driven: Driven) -> PyResult<Written> {
    let Driven { model, definition, variable } = driven;
    let case = Case { definition: definition.clone(), ..Case::default() };
    let text = case::write(&case, Format::Json);
    let model = Py::new(py, PyModel::new(model, Arc::new(definition)))?;
    Ok((model, text, variable.name, variable.unit, variable.start, variable.rests))
}

/// The mechanism in which t is the value of a driver or position quantity.
#[pyfunction]
pub fn driven_by(
    py: Python<'_>,
    model: &PyModel,
    over: Option<String>,
    at: At<'_>,
    released: Vec<String>,
) -> PyResult<Written> {
    guard("driven_by", || {
        let (t, q, v, z) = at;
        let start = StartState { state: state(py, &model.model, t, [&q, &v, &z])?, released };
        let subject = Subject { definition: &model.definition, prepared: &model.prepared };
        let over = over.map_or_else(|| subject.only_driver(&start), Ok);
        let driven = over.and_then(|over| Ok(subject.driven_by(&start, &over, false)?));
        write(py, driven.map_err(|outcome| Failure::from(outcome).raise(py))?)
    })
}

/// The SI unit of a rate in a motion over a quantity.
#[pyfunction]
pub fn rate_unit(unit: &str, by: &str) -> PyResult<String> {
    guard("rate_unit", || Ok(kempe::analyses::record::rate_unit(unit, by)))
}

/// Runs an analysis from a state.
#[pyfunction]
#[pyo3(signature = (model, options, at, released, progress, after=false, t_end=None, actions=None))]
#[allow(clippy::too_many_arguments)] // the arguments of Python
pub fn run_analysis(
    py: Python<'_>,
    model: &Bound<'_, PyModel>,
    options: &str,
    at: At<'_>,
    released: Vec<String>,
    progress: Option<Py<PyAny>>,
    after: bool,
    t_end: Option<f64>,
    actions: Option<(Vec<String>, Py<PyAny>)>,
) -> PyResult<PyRecord> {
    guard("run_analysis", || {
        let core = model.get();
        let (t, q, v, z) = at;
        let analysis = read(py, core, options, t_end)?;
        let start = StartState { state: state(py, &core.model, t, [&q, &v, &z])?, released };
        let of = (model, &analysis);
        let work = Work {
            analysis: analysis.clone(),
            definition: Arc::clone(&core.definition),
            prepared: Arc::clone(&core.prepared),
            start,
            after,
        };
        let (outcome, error) = match work.analysis {
            // which looks at signals so often that it needs no thread
            AnyAnalysis::Dynamics(_) => work.here(py, progress.as_ref(), actions),
            _ => work.beside(py, progress)?,
        };
        match (outcome, error) {
            (Ok(record), None) => {
                let message = record.message.clone();
                PyRecord::new(py, of, record, &message)
            }
            (Ok(record), Some(error)) => partial(py, of, Some(record), "interrupted", error),
            (Err(failed), Some(error)) => partial(py, of, failed.record, "interrupted", error),
            (Err(failed), None) => {
                let message = failed.outcome.message.clone();
                let error = Failure::from(failed.outcome).raise(py);
                partial(py, of, failed.record, &message, error)
            }
        }
    })
}

/// Raises an error that contains the record so far, if this is a motion.
fn partial(
    py: Python<'_>,
    of: (&Bound<'_, PyModel>, &AnyAnalysis),
    record: Option<Record>,
    message: &str,
    error: PyErr,
) -> PyResult<PyRecord> {
    if let Some(record) = record.filter(|record| record.motion.is_some()) {
        error.value(py).setattr("record", PyRecord::new(py, of, record, message)?)?;
    }
    Err(error)
}

/// An analysis that is to be run.
struct Work {
    analysis: AnyAnalysis,
    definition: Arc<Definition>,
    prepared: Arc<Prepared<Arc<Model>>>,
    start: StartState,
    /// Whether it starts at the end of another analysis.
    after: bool,
}

impl Work {
    fn run(&self, observer: Observer<'_>) -> RunResult {
        let subject = Subject { definition: &self.definition, prepared: &self.prepared };
        match self.after {
            true => run_after(&self.analysis, &subject, &self.start, observer),
            false => self.analysis.run(&subject, &self.start, observer),
        }
    }

    /// Runs it on this thread.
    fn here(
        &self,
        py: Python<'_>,
        progress: Option<&Py<PyAny>>,
        actions: Option<(Vec<String>, Py<PyAny>)>,
    ) -> (RunResult, Option<PyErr>) {
        let (mut watch, mut stopped) = (Watch::new(progress), None);
        let (events, call) = actions.unwrap_or_else(|| (Vec::new(), py.None()));
        let model = self.prepared.model();
        let mut act = |name: &str, state: &State, setting: &Setting| {
            let changed = Python::attach(|py| called(py, &call, model, name, (state, setting)));
            changed.map_err(|error| stopped = Some(error)).ok()
        };
        let outcome = py.detach(|| {
            let acting = EventActions { events: &events, act: &mut act };
            let acting = (!events.is_empty()).then_some(acting);
            let mut look = |t| watch.look(t);
            self.run(Observer { acting, ..Observer::new(&mut look) })
        });
        (outcome, watch.raised.or(stopped).or_else(raised::take))
    }

    /// Runs it on a thread of its own while this thread waits for signals.
    fn beside(
        self,
        py: Python<'_>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<(RunResult, Option<PyErr>)> {
        let work = move |stop: ToEnd<'_>| {
            let mut watch = Watch::until(progress.as_ref(), stop);
            let mut look = |at| watch.look(at);
            let outcome = self.run(Observer { stop, ..Observer::new(&mut look) });
            (outcome, watch.raised)
        };
        match attend(py, ENDING, work)? {
            Attended::Done(found) => Ok(found),
            Attended::Interrupted(error, Some((outcome, _))) => Ok((outcome, Some(error))),
            Attended::Interrupted(error, None) => Err(error),
        }
    }
}

/// Calls the function of an event.
pub fn called(
    py: Python<'_>,
    call: &Py<PyAny>,
    model: &Model,
    name: &str,
    (state, setting): (&State, &Setting),
) -> PyResult<Change> {
    use numpy::IntoPyArray;
    let [q, v, z] = [&state.q, &state.v, &state.z].map(|x| x.clone().into_pyarray(py));
    let answer = call.call1(py, (name, written(setting), state.t, q, v, z))?;
    type Answer<'py> = (Vec<(String, f64)>, Option<(Row<'py>, Row<'py>, Row<'py>)>);
    let (parameters, given): Answer<'_> = answer.extract(py)?;
    let given = given.map(|(q, v, z)| self::state(py, model, state.t, [&q, &v, &z]));
    Ok(Change { parameters, state: given.transpose()? })
}

/// The analyses that were read last for a model. Loops over starts pass the same text many times.
#[derive(Default)]
pub struct RecentAnalysis(Mutex<Option<(String, AnyAnalysis)>>);

/// Reads an entry of `analyses` such as `{"type": "dynamics", "t_end": 15, "method": {"type": "rk45", …}, …}`.
/// `t_end`, if given, replaces the value in the text.
pub fn read(
    py: Python<'_>,
    model: &PyModel,
    text: &str,
    t_end: Option<f64>,
) -> PyResult<AnyAnalysis> {
    let last = model.recent.0.lock().unwrap_or_else(PoisonError::into_inner);
    let known = last.as_ref().filter(|(known, _)| known == text).map(|(_, it)| it.clone());
    drop(last);
    let mut analysis = match known {
        Some(known) => known,
        None => {
            let fields = fields(py, text)?;
            let analysis = AnyAnalysis::read(&model.model, &fields, &[])
                .map_err(|found| raise_plain(py, Kind::Model, &found))?;
            let mut last = model.recent.0.lock().unwrap_or_else(PoisonError::into_inner);
            *last = Some((text.to_string(), analysis.clone()));
            analysis
        }
    };
    if let (AnyAnalysis::Dynamics(options), Some(t_end)) = (&mut analysis, t_end) {
        options.t_end = number(py, "t_end", t_end)?;
    }
    Ok(analysis)
}

/// The fields of an entry of `analyses` that is given as JSON.
fn fields(py: Python<'_>, text: &str) -> PyResult<Vec<(String, Value)>> {
    let all = entries(py, &format!("{{\"analysis\": {text}}}"))?;
    Ok(all.into_iter().next().map(|entry| entry.fields).unwrap_or_default())
}

/// Entries of `analyses` that are given as JSON.
pub fn entries(py: Python<'_>, text: &str) -> PyResult<Vec<Entry>> {
    let written = format!("{{\"kempe\": 1, \"analyses\": {text}}}");
    let (case, _) = case::read(&written, Format::Json).map_err(|mut found| {
        found.iter_mut().for_each(|d| drop(d.path.drain(..d.path.len().min(2))));
        raise(py, Kind::Model, &found, None)
    })?;
    Ok(case.analyses)
}
