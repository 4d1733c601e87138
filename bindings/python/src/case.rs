//! Cases for Python: reading and writing text, and compiling the model.

use crate::attended::attended;
use crate::convert::{refuse, tree, Row};
use crate::errors::{raise, Failure, Kind};
use crate::functions;
use crate::guard::guard;
use crate::model::PyModel;
use kempe::analyses::{measures, start_of};
use kempe::case::{self, Case, Diagnostic, Document, Format, MOST_REPORTED};
use kempe::model::{self, Entry};
use pyo3::prelude::*;
use std::sync::Arc;

/// The text of a case with valid structure.
#[pyclass(name = "Case", module = "kempe._core", frozen)]
pub struct PyCase {
    case: Arc<Case>,
    document: Arc<Document>,
    origin: Option<String>,
}

/// Values of parameters, and texts that contain them.
type Variant = (Vec<(String, f64, String)>, Vec<String>);

fn format_named(py: Python<'_>, name: &str) -> PyResult<Format> {
    match name {
        "toml" => Ok(Format::Toml),
        "json" => Ok(Format::Json),
        _ => {
            Err(Failure::new(Kind::File, format!("format '{name}'; must be toml or json"))
                .raise(py))
        }
    }
}

impl PyCase {
    /// Raises faults with their positions in this text.
    fn raise(&self, py: Python<'_>, kind: Kind, found: &[model::Problem]) -> PyErr {
        let more = found.len().saturating_sub(MOST_REPORTED);
        let shown = found.iter().take(MOST_REPORTED);
        let mut shown: Vec<Diagnostic> = shown.map(|p| self.document.diagnose(p)).collect();
        shown.sort_by_key(|d| (d.line, d.column));
        shown.extend((more > 0).then(|| Diagnostic::more(more)));
        raise(py, kind, &shown, self.origin.as_deref())
    }
}

#[pymethods]
impl PyCase {
    #[new]
    #[pyo3(signature = (text, format, origin))]
    fn new(py: Python<'_>, text: &str, format: &str, origin: Option<String>) -> PyResult<Self> {
        guard("Case", || {
            let kind = if origin.is_some() { Kind::File } else { Kind::Model };
            let format = format_named(py, format)?;
            let text = text.to_string();
            let (case, document) = attended(py, move |_| case::read(&text, format))?
                .map_err(|found| raise(py, kind, &found, origin.as_deref()))?;
            Ok(Self { case: Arc::new(case), document: Arc::new(document), origin })
        })
    }

    /// The case as JSON, with the structure and order of the file.
    fn tree(&self) -> PyResult<String> {
        guard("Case.tree", || Ok(case::write(&self.case, Format::Json)))
    }

    /// The case as text in the format "toml" or "json".
    fn write(&self, py: Python<'_>, format: &str) -> PyResult<String> {
        guard("Case.write", || Ok(case::write(&self.case, format_named(py, format)?)))
    }

    /// The values of the random parameters of the exercise for a seed: name, value, and the value for people; and texts
    /// with the values of all parameters.
    fn variant(&self, py: Python<'_>, seed: u64, texts: Vec<String>) -> PyResult<Variant> {
        guard("Case.variant", || {
            let found = case::exercise::drawn(&self.case, seed);
            let values = found.map_err(|problem| self.raise(py, Kind::Model, &[problem]))?;
            let fill = |text: &String| case::exercise::filled(&self.case, text, &values);
            let texts = texts.iter().map(fill).collect();
            let values = values.into_iter().map(|one| (one.name, one.value, one.shown)).collect();
            Ok((values, texts))
        })
    }

    /// The case with the points of a table that a file contains.
    fn supply(&self, py: Python<'_>, table: &str, x: Row<'_>, y: Row<'_>) -> PyResult<Self> {
        guard("Case.supply", || {
            let mut case = (*self.case).clone();
            if !case.supply(table, &x.as_array().to_vec(), &y.as_array().to_vec()) {
                return Err(refuse(py, "table", format!("there is no table '{table}'")));
            }
            let (document, origin) = (Arc::clone(&self.document), self.origin.clone());
            Ok(Self { case: Arc::new(case), document, origin })
        })
    }

    /// Compiles the model with other parameters, and with Python functions as laws of forces. `state` creates a state
    /// from an array (t, q, v, z).
    #[pyo3(signature = (overrides, functions=None, state=None))]
    fn model(
        &self,
        py: Python<'_>,
        overrides: &str,
        functions: Option<Vec<functions::Described>>,
        state: Option<Py<PyAny>>,
    ) -> PyResult<PyModel> {
        guard("Case.model", || {
            let overrides = tree(py, overrides)?;
            let mut case = Arc::clone(&self.case);
            if let (Some(functions), Some(state)) = (functions, state) {
                functions::place(py, &mut Arc::make_mut(&mut case).definition, state, functions);
            }
            let built = attended(py, move |_| {
                let model = model::build(&case.definition, &overrides)?;
                match measures::check(&model, &case.definition.measures) {
                    found if found.is_empty() => Ok((model, case)),
                    found => Err(found),
                }
            })?;
            let (model, case) = built.map_err(|found| self.raise(py, Kind::Model, &found))?;
            Ok(PyModel::new(Arc::new(model), Arc::new(case.definition.clone())))
        })
    }

    /// Raises the problems of the start and of the analyses, with their positions in the text.
    fn check(&self, py: Python<'_>, model: &PyModel) -> PyResult<()> {
        guard("Case.check", || {
            let found = self.case.faults(&model.model);
            if found.is_empty() {
                return Ok(());
            }
            Err(self.raise(py, Kind::Model, &found))
        })
    }

    /// File, line and column of the entry at a path. None if the case has no file or the file does not contain the
    /// entry.
    fn place(&self, path: &str) -> PyResult<Option<(String, usize, usize)>> {
        guard("Case.place", || {
            let path: Vec<&str> = path.split('.').collect();
            let found = self.document.position(&path);
            Ok(self.origin.clone().zip(found).map(|(file, (line, column))| (file, line, column)))
        })
    }

    /// The analyses as JSON, in order, and for each the index of the analysis at whose end it starts.
    fn analyses(&self) -> PyResult<(String, Vec<Option<usize>>)> {
        guard("Case.analyses", || {
            let all = &self.case.analyses;
            let one = |(place, entry): (usize, &Entry)| {
                (Entry { fields: self.case.fields(place), ..entry.clone() }, start_of(all, place))
            };
            let (analyses, after) = all.iter().enumerate().map(one).unzip();
            let case = Case { analyses, ..Case::default() };
            Ok((case::write(&case, Format::Json), after))
        })
    }
}
