//! The matrices of the equations at a state.

use crate::assemble::targets;
use crate::convert::{state, table, Row};
use crate::guard::guard;
use crate::model::PyModel;
use kempe::analyses::assemble::{holding, Request};
use kempe::elements::{Equation, Group};
use kempe::model::{ConstraintItem, Model};
use numpy::PyArrayMethods;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// The name and the unit of each equation. Friction that sticks, or a contact at rest, has one under its own name; a
/// driver with a limit that follows its law has its own.
fn rows(model: &Model) -> Vec<(String, &'static str)> {
    let limits =
        |name: &str| model.forces.iter().any(|of| of.name == name && of.element.driver().is_some());
    let of_item = |item: &ConstraintItem| {
        let own = match item.name.rsplit_once(" (") {
            Some((driver, _)) if limits(driver) => driver,
            _ => &item.name,
        };
        let name = |equation: &Equation| match own.strip_prefix("set ") {
            Some(held) => format!("set.{held}"),
            None if item.group == Group::Forces && own == item.name => own.to_string(),
            None => format!("{own}.{}", equation.name),
        };
        let of = |equation: &Equation| (name(equation), equation.kind.unit());
        item.equations.iter().map(of).collect::<Vec<_>>()
    };
    model.constraints.iter().flat_map(of_item).collect()
}

/// The matrices and right sides of the equations at a state. `set` adds rows of drivers as in assembly.
#[pyfunction]
#[pyo3(signature = (model, t, q, v, z, set))]
#[allow(clippy::too_many_arguments)] // the arguments of Python
pub fn matrices<'py>(
    py: Python<'py>,
    model: &PyModel,
    t: f64,
    q: Row<'py>,
    v: Row<'py>,
    z: Row<'py>,
    set: &str,
) -> PyResult<Bound<'py, PyDict>> {
    guard("matrices", || {
        let state = state(py, &model.model, t, [&q, &v, &z])?;
        let set = targets(py, model, "set", set)?;
        let active = model.active.prepared.model();
        let extended = holding(active, &Request { set, t, ..Request::default() });
        let all = kempe::equations::dense::matrices(&extended, t, [&state.q, &state.v, &state.z]);
        let (n, m) = (extended.layout.n_q, extended.layout.n_rows);
        let out = PyDict::new(py);
        out.set_item("M", table(py, all.mass, (n, n))?)?;
        out.set_item("Phi_q", table(py, all.jacobian, (m, n))?)?;
        out.set_item("kkt", table(py, all.kkt, (n + m, n + m))?)?;
        let columns = [("Phi", all.phi), ("nu", all.nu), ("gamma", all.gamma), ("Q", all.forces)];
        out.set_item("rows", rows(&extended))?;
        for (name, column) in columns {
            let length = column.len();
            let column = table(py, column, (1, length))?.reshape([length])?;
            out.set_item(name, column)?;
        }
        Ok(out)
    })
}
