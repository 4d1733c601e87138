//! Errors for Python. A [`Failure`] collects the data and is raised as a class of `kempe.errors`, which is imported
//! only if an error is raised.

use kempe::analyses::record::Outcome;
use kempe::case::Diagnostic;
use kempe::model::{self, MOST_REPORTED};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};

/// The exceptions; each is a class of `kempe.errors`.
pub use kempe::analyses::record::ErrorClass as Kind;

/// One fault of a model or a file.
#[derive(Clone, Debug, Default)]
pub struct Problem {
    /// Description of the fault, and the remedy.
    pub message: String,
    /// The path in the model, such as `joints.C.i`; empty if there is no path.
    pub path: String,
    /// Line and column in the file, counted from 1; `None` for a model built in Python.
    pub position: Option<(usize, usize)>,
}

/// An error with its path, time and remedy. [`Failure::raise`] converts it to the Python exception.
#[derive(Debug)]
pub struct Failure {
    kind: Kind,
    message: String,
    name: Option<String>,
    t: Option<f64>,
    hint: Option<String>,
    problems: Vec<Problem>,
    solution: Option<Py<PyAny>>,
}

impl Failure {
    /// A failure with only a message.
    pub fn new(kind: Kind, message: impl Into<String>) -> Self {
        let message = message.into();
        Self { kind, message, name: None, t: None, hint: None, problems: vec![], solution: None }
    }

    /// The joint or body at fault.
    pub fn name(mut self, name: impl Into<String>) -> Self {
        self.name = Some(name.into());
        self
    }

    /// The time of the failure, s.
    pub const fn at(mut self, t: f64) -> Self {
        self.t = Some(t);
        self
    }

    /// The remedy.
    pub fn hint(mut self, hint: impl Into<String>) -> Self {
        self.hint = Some(hint.into());
        self
    }

    /// All faults, in the order of the file.
    pub fn problems(mut self, problems: Vec<Problem>) -> Self {
        self.problems = problems;
        self
    }

    /// The results computed before the failure. Only an `IntegrationError` contains them.
    pub fn solution(mut self, solution: Py<PyAny>) -> Self {
        self.solution = Some(solution);
        self
    }

    /// The Python exception, or the error that prevented its creation.
    pub fn raise(self, py: Python<'_>) -> PyErr {
        self.exception(py).map_or_else(|error| error, PyErr::from_value)
    }

    fn exception(self, py: Python<'_>) -> PyResult<Bound<'_, PyAny>> {
        let module = py.import("kempe.errors")?;
        let keywords = PyDict::new(py);
        keywords.set_item("name", self.name)?;
        keywords.set_item("t", self.t)?;
        keywords.set_item("hint", self.hint)?;
        keywords.set_item("problems", problems(&module, self.problems)?)?;
        if self.kind == Kind::Integration {
            keywords.set_item("solution", self.solution)?;
        }
        module.getattr(self.kind.name())?.call((self.message,), Some(&keywords))
    }
}

fn problems<'py>(
    module: &Bound<'py, PyModule>,
    list: Vec<Problem>,
) -> PyResult<Bound<'py, PyTuple>> {
    let class = module.getattr("Problem")?;
    let made: PyResult<Vec<_>> = list
        .into_iter()
        .map(|Problem { message, path, position }| {
            let (line, column) = position.unzip();
            class.call1((message, path, line, column))
        })
        .collect();
    PyTuple::new(module.py(), made?)
}

/// A fault for Python, with its position in a file, or only its path if there is no file.
fn problem(diagnostic: &Diagnostic, origin: Option<&str>) -> Problem {
    let path = diagnostic.path.join(".");
    if origin.is_some() {
        let position = Some((diagnostic.line, diagnostic.column));
        return Problem { message: diagnostic.to_string(), path, position };
    }
    let hint = diagnostic.hint.as_ref().map(|hint| format!("; {hint}")).unwrap_or_default();
    let place = if path.is_empty() { String::new() } else { format!("{path}: ") };
    Problem { message: format!("{place}{}{hint}", diagnostic.message), path, position: None }
}

/// All faults as one exception.
pub fn raise(py: Python<'_>, kind: Kind, found: &[Diagnostic], origin: Option<&str>) -> PyErr {
    // the last entry may be the number of further faults
    let (shown, more): (Vec<_>, Vec<_>) = found.iter().partition(|d| d.line > 0);
    let problems: Vec<Problem> = shown.into_iter().map(|d| problem(d, origin)).collect();
    let texts = problems.iter().map(|p| p.message.as_str());
    let texts: Vec<&str> = texts.chain(more.iter().map(|d| d.message.as_str())).collect();
    let text = texts.join("\n");
    let count = problems.len();
    let message = match origin {
        Some(origin) if found.len() == 1 => format!("{origin}: {text}"),
        Some(origin) if more.is_empty() => format!("{origin}: {count} problems\n{text}"),
        Some(origin) => format!("{origin}: more than {count} problems\n{text}"),
        None => text,
    };
    let name = found.first().and_then(|d| d.path.get(1).cloned()).unwrap_or_default();
    Failure::new(kind, message).name(name).problems(problems).raise(py)
}

/// All faults without positions in a text, as one exception.
pub fn raise_plain(py: Python<'_>, kind: Kind, found: &[model::Problem]) -> PyErr {
    Failure::from(Outcome { class: kind, ..found.to_vec().into() }).raise(py)
}

impl From<Outcome> for Failure {
    fn from(outcome: Outcome) -> Self {
        let Outcome { class: kind, message, name, t, hint, problems } = outcome;
        let problem = |p: &model::Problem| Problem {
            message: p.to_string(),
            path: p.path.join("."),
            position: None,
        };
        let problems = problems.iter().take(MOST_REPORTED).map(problem).collect();
        Self { kind, message, name, t, hint, problems, solution: None }
    }
}

/// A failure of the class `kind` with all attributes set, for tests in Python.
///
/// # Errors
/// `ValueError` if there is no such class.
pub fn sample(kind: &str, message: &str) -> PyResult<Failure> {
    let known = Kind::ALL.into_iter().find(|known| known.name() == kind);
    let kind = known.ok_or_else(|| PyValueError::new_err(format!("no error class '{kind}'")))?;
    let problem = Problem {
        message: "not a number".into(),
        path: "bodies.crank.mass".into(),
        position: Some((7, 8)),
    };
    let failure = Failure::new(kind, message).name("crank").at(1.5).hint("do this");
    let partial = Python::attach(|py| PyTuple::empty(py).into_any().unbind());
    Ok(failure.problems(vec![problem]).solution(partial))
}
