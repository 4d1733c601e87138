//! The equations of joints and drivers as text.

use crate::convert::refuse;
use crate::guard::guard;
use crate::model::PyModel;
use kempe::elements::Group;
use kempe::equations::formulas::{of_constraint, of_type, Formulas};
use kempe::symbolic::Form;
use pyo3::prelude::*;
use serde_json::{json, Value};

/// Φ, Φ_q and γ of a joint or driver of a model, as JSON. `written` contains the fields of its entry that are texts.
#[pyfunction]
#[pyo3(signature = (model, name, written, form))]
pub fn formulas(
    py: Python<'_>,
    model: &PyModel,
    name: &str,
    written: std::collections::HashMap<String, String>,
    form: &str,
) -> PyResult<String> {
    guard("formulas", || {
        let Some(k) = model.model.constraint(name) else {
            return Err(refuse(py, "name", format!("there is no joint or driver '{name}'")));
        };
        let form = match form {
            "expression" => Form::Expression,
            "unicode" => Form::Unicode,
            "latex" => Form::Latex,
            _ => return Err(refuse(py, "form", format!("there is no form '{form}'"))),
        };
        let found = of_constraint(&model.model, k, &|field| written.get(field).cloned(), form);
        Ok(value(&found).to_string())
    })
}

/// The equations of a type of element.
pub fn declared(group: Group, kind: &str) -> Value {
    of_type(group, kind, Form::Unicode).as_ref().map_or(Value::Null, value)
}

fn value(formulas: &Formulas) -> Value {
    let rows = formulas.rows.iter().map(
        |row| json!({ "residual": row.residual, "jacobian": row.jacobian, "gamma": row.gamma }),
    );
    json!({
        "columns": formulas.columns,
        "definitions": formulas.definitions,
        "rows": rows.collect::<Vec<_>>(),
        "names": formulas.names,
    })
}
