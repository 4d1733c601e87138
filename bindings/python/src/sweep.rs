//! Variants of a case on threads, without the interpreter's lock.

use crate::attended::attended;
use crate::convert::{refuse, table, tree, Rows};
use crate::errors::{Failure, Kind};
use crate::guard::{caught, guard, Caught};
use crate::model::PyModel;
use crate::respond::Table;
use crate::run_analysis::entries;
use kempe::analyses::slopes::Gradient;
use kempe::analyses::sweep::{Outcome, Statistic, Sweep, VariantRow, Wanted};
use kempe::math::Lanes;
use numpy::{IntoPyArray, PyArray1};
use pyo3::prelude::*;
use rayon::prelude::*;
use rayon::ThreadPoolBuilder;
use std::sync::Arc;

/// Largest number of variants in a block, so that a block fits into the cache of a processor.
const BLOCK: usize = 32;
/// Number of blocks per thread, so that all threads end at about the same time.
const BLOCKS: usize = 4;

/// Stack size of a thread, equal to that of a main thread.
const STACK: usize = 8 << 20;

/// Rows of numbers, the reasons of the rows that failed, and the rows that need a single run.
type Swept<'py> = (Table<'py>, Vec<(usize, String)>, Bound<'py, PyArray1<u64>>);

/// Whether `sweep` supports a model and statistics; `reads` states whether the sweep reads quantities. With `slopes`,
/// whether `gradient` does, for which functions of the caller may have derivatives.
#[pyfunction]
#[pyo3(signature = (model, statistics, reads, slopes))]
pub fn sweeps(
    model: &PyModel,
    statistics: Vec<String>,
    reads: bool,
    slopes: bool,
) -> PyResult<bool> {
    guard("sweeps", || {
        let known = statistics.iter().all(|name| Statistic::named(name).is_some());
        let plain = slopes || model.model.blueprint.functions.is_none();
        Ok(known && plain && Sweep::serves(&model.model, reads))
    })
}

/// Runs variants of a case, one per row, and returns numbers of the result of the last analysis: statistics of measures
/// with their indices, or numbers by name. `start`, `guess` and `analyses` are JSON in the format of a file;
/// `parameters` and `coordinates` are the names of the columns.
#[pyfunction]
#[pyo3(signature = (model, start, guess, analyses, measures, wanted, parameters, coordinates, rows, workers))]
#[allow(clippy::too_many_arguments)] // the arguments of Python
pub fn sweep<'py>(
    py: Python<'py>,
    model: &PyModel,
    start: &str,
    guess: &str,
    analyses: &str,
    measures: Vec<String>,
    wanted: Vec<(Option<usize>, String)>,
    parameters: Vec<String>,
    coordinates: Vec<String>,
    rows: Rows<'py>,
    workers: usize,
) -> PyResult<Swept<'py>> {
    guard("sweep", || {
        let (count, width) = rows.as_array().dim();
        if width != parameters.len() + coordinates.len() {
            return Err(refuse(py, "rows", format!("{width} columns do not fit the names")));
        }
        let numbers = wanted.len();
        let sweep = request(py, model, [start, guess, analyses], measures, wanted)?;
        let given: Vec<f64> = rows.as_array().iter().copied().collect();
        let names = (parameters, coordinates);
        let outcomes = attended(py, move |stop| on_threads(&sweep, &names, &given, workers, stop))?;
        sorted(py, outcomes, (count, numbers))
    })
}

/// The case whose variants are run, and what is read of each.
fn request(
    py: Python<'_>,
    model: &PyModel,
    [start, guess, analyses]: [&str; 3],
    measures: Vec<String>,
    wanted: Vec<(Option<usize>, String)>,
) -> PyResult<Sweep> {
    let wanted = wanted.into_iter().map(|(of, name)| match (of, Statistic::named(&name)) {
        (None, _) => Ok(Wanted::Number(name)),
        (Some(of), Some(statistic)) if of < measures.len() => Ok(Wanted::Statistic(of, statistic)),
        _ => Err(refuse(py, "wanted", format!("there is no '{name}' of this measure"))),
    });
    Ok(Sweep {
        model: Arc::clone(&model.model),
        definition: Arc::clone(&model.definition),
        set: tree(py, start)?,
        guess: tree(py, guess)?,
        analyses: entries(py, analyses)?,
        wanted: wanted.collect::<PyResult<Vec<_>>>()?,
        measures,
    })
}

/// Numbers, their derivatives (a row for each number, a column for each variable), and the reasons for missing ones.
type Derived<'py> = (Bound<'py, PyArray1<f64>>, Table<'py>, Vec<(usize, usize, String)>);

/// Runs a case and returns numbers of the result of the last analysis with their derivatives by parameters and by
/// coordinates of the start. `row` contains the values of the variables; the other arguments are those of `sweep`.
#[pyfunction]
#[pyo3(signature = (model, start, guess, analyses, measures, wanted, parameters, coordinates, row))]
#[allow(clippy::too_many_arguments)] // the arguments of Python
pub fn gradient<'py>(
    py: Python<'py>,
    model: &PyModel,
    start: &str,
    guess: &str,
    analyses: &str,
    measures: Vec<String>,
    wanted: Vec<(Option<usize>, String)>,
    parameters: Vec<String>,
    coordinates: Vec<String>,
    row: Vec<f64>,
) -> PyResult<Derived<'py>> {
    guard("gradient", || {
        let variables = parameters.len() + coordinates.len();
        if row.len() != variables {
            return Err(refuse(py, "row", format!("{} numbers do not fit the names", row.len())));
        }
        let numbers = wanted.len();
        let sweep = request(py, model, [start, guess, analyses], measures, wanted)?;
        let row = variant(&parameters, &coordinates, &row);
        let found = attended(py, move |stop| caught(|| sweep.gradient(&row, stop)))?;
        let found = found.unwrap_or_else(|panic| panic.resume());
        let Gradient { values, jacobian, remarks } =
            found.map_err(|outcome| failed(py, outcome))?;
        let remarks = remarks.into_iter().map(|one| (one.number, one.variable, one.text));
        let table = table(py, jacobian, (numbers, variables))?;
        Ok((values.into_pyarray(py), table, remarks.collect()))
    })
}

/// The error for a variant without derivatives.
fn failed(py: Python<'_>, outcome: Outcome) -> PyErr {
    let message = match outcome {
        Outcome::Failed(reason) => reason,
        _ => "derivatives are not available yet where joints are redundant, where a driver holds friction \
              at rest, where contacts or friction at rest share a load, or near singular positions"
            .to_string(),
    };
    Failure::new(Kind::Integration, message).raise(py)
}

/// A variant with these values of its parameters, then of its coordinates.
fn variant(parameters: &[String], coordinates: &[String], values: &[f64]) -> VariantRow {
    let (of_parameters, of_start) = values.split_at(parameters.len());
    let named = |names: &[String], values: &[f64]| -> Vec<(String, f64)> {
        names.iter().cloned().zip(values.iter().copied()).collect()
    };
    (named(parameters, of_parameters), named(coordinates, of_start))
}

/// Values of measures at times, their derivatives (a row for each measure of each time), and why there are none.
type Timed<'py> = (Table<'py>, Table<'py>, String);

/// Runs a case and returns measures of the motion of its last analysis at given times, with their derivatives. The other
/// arguments are those of `gradient`. Without derivatives, both tables are empty.
#[pyfunction]
#[pyo3(signature = (model, start, guess, analyses, measures, times, parameters, coordinates, row))]
#[allow(clippy::too_many_arguments)] // the arguments of Python
pub fn slopes_at<'py>(
    py: Python<'py>,
    model: &PyModel,
    start: &str,
    guess: &str,
    analyses: &str,
    measures: Vec<String>,
    times: Vec<f64>,
    parameters: Vec<String>,
    coordinates: Vec<String>,
    row: Vec<f64>,
) -> PyResult<Timed<'py>> {
    guard("slopes_at", || {
        let (count, variables) = (measures.len(), parameters.len() + coordinates.len());
        if row.len() != variables {
            return Err(refuse(py, "row", format!("{} numbers do not fit the names", row.len())));
        }
        let sweep = request(py, model, [start, guess, analyses], measures, Vec::new())?;
        let row = variant(&parameters, &coordinates, &row);
        let n = times.len();
        let found = attended(py, move |stop| caught(|| sweep.slopes_at(&times, &row, stop)))?;
        let found = found.unwrap_or_else(|panic| panic.resume());
        match found.map_err(|outcome| failed(py, outcome))? {
            Ok((values, slopes)) => {
                let slopes = table(py, slopes, (n * count, variables))?;
                Ok((table(py, values, (n, count))?, slopes, String::new()))
            }
            Err(reason) => Ok((
                table(py, Vec::new(), (0, count))?,
                table(py, Vec::new(), (0, variables))?,
                reason,
            )),
        }
    })
}

/// The outcome of each row. A panic ends all computations.
fn on_threads(
    sweep: &Sweep,
    (parameters, coordinates): &(Vec<String>, Vec<String>),
    rows: &[f64],
    workers: usize,
    stop: &(dyn Fn() -> bool + Sync),
) -> Result<Vec<Outcome>, Caught> {
    let width = (parameters.len() + coordinates.len()).max(1);
    let named = |names: &[String], values: &[f64]| -> Vec<(String, f64)> {
        names.iter().cloned().zip(values.iter().copied()).collect()
    };
    let rows = rows.chunks_exact(width).map(|row| {
        let (of_parameters, of_start) = row.split_at(parameters.len());
        (named(parameters, of_parameters), named(coordinates, of_start))
    });
    let rows: Vec<VariantRow> = rows.collect();
    let block = (rows.len() / (BLOCKS * workers.max(1))).clamp(Lanes::WIDTH, BLOCK);
    let run = |rows: &[VariantRow]| caught(|| sweep.variants(rows, stop));
    let pool = ThreadPoolBuilder::new().num_threads(workers).stack_size(STACK).build();
    let outcomes: Result<Vec<_>, _> = match pool {
        Ok(pool) => pool.install(|| rows.par_chunks(block).map(run).collect()),
        // threads cannot be started
        Err(_) => rows.chunks(block).map(run).collect(),
    };
    Ok(outcomes?.concat())
}

fn sorted<'py>(
    py: Python<'py>,
    outcomes: Result<Vec<Outcome>, Caught>,
    (count, width): (usize, usize),
) -> PyResult<Swept<'py>> {
    let outcomes = outcomes.unwrap_or_else(|panic| panic.resume());
    let (mut values, mut reasons, mut single) =
        (Vec::with_capacity(count * width), Vec::new(), Vec::new());
    for (k, outcome) in outcomes.into_iter().enumerate() {
        match outcome {
            Outcome::Values(row) => values.extend(row),
            Outcome::Failed(reason) => reasons.push((k, reason)),
            Outcome::Single | Outcome::Stopped => single.push(k as u64),
        }
        values.resize((k + 1) * width, f64::NAN);
    }
    Ok((table(py, values, (count, width))?, reasons, single.into_pyarray(py)))
}
