//! A compiled model, and what it holds as JSON.

use crate::guard::guard;
use crate::recent_options::RecentOptions;
use kempe::analyses::dynamics::Prepared;
use kempe::elements::{SceneSymbol, SymbolEnd};
use kempe::math::Local;
use kempe::model::{Body, ConstraintItem, ForceItem, Model};
use pyo3::prelude::*;
use serde_json::{json, Map, Value};
use std::sync::Arc;

/// A compiled model: immutable.
#[pyclass(name = "Model", module = "kempe._core", frozen)]
pub struct PyModel {
    /// The model.
    pub model: Arc<Model>,
    /// What its simulations have in common.
    pub prepared: Arc<Prepared<Arc<Model>>>,
    /// The options that were read for it last.
    pub options: RecentOptions,
}

/// Python's allocator aligns objects to 16 bytes only.
const _: () = assert!(align_of::<PyModel>() <= 16);

impl PyModel {
    /// Of a model of the core.
    pub fn new(model: Model) -> Self {
        let model = Arc::new(model);
        let prepared = Arc::new(Prepared::new(Arc::clone(&model)));
        Self { model, prepared, options: RecentOptions::default() }
    }
}

#[pymethods]
impl PyModel {
    /// What the model holds, in numbers, as JSON.
    fn describe(&self) -> PyResult<String> {
        guard("Model.describe", || Ok(describe(&self.model).to_string()))
    }

    /// The symbols of all elements, in the order of the model, as JSON.
    fn symbols(&self) -> PyResult<String> {
        guard("Model.symbols", || Ok(symbols(&self.model).to_string()))
    }

    /// The same model with redundant constraints accepted.
    fn allowing_redundancy(&self) -> PyResult<Self> {
        guard("Model.allowing_redundancy", || Ok(Self::new(self.model.allowing_redundancy())))
    }
}

fn pair(s: &Local) -> Value {
    json!([s.x, s.y])
}

fn symbols(model: &Model) -> Value {
    let end = |end: &SymbolEnd| json!({ "body": end.body.0, "point": end.point.as_ref().map(pair), "axis": end.axis });
    let one = |element: &str, symbol: &SceneSymbol| {
        json!({
            "element": element,
            "mark": symbol.mark.name(),
            "i": end(&symbol.i),
            "j": end(&symbol.j),
            "radius": symbol.mark.radius(),
        })
    };
    let all = model.symbols();
    all.iter().flat_map(|(name, own)| own.iter().map(|symbol| one(name, symbol))).collect()
}

fn describe(model: &Model) -> Value {
    let names = &model.blueprint.parameters;
    let parameters: Map<String, Value> =
        names.iter().zip(&model.parameters).map(|(n, x)| (n.clone(), json!(x))).collect();
    let rows = model.layout.constraints.iter().map(|slots| &slots.rows);
    json!({
        "title": model.blueprint.title,
        "gravity": [model.gravity.x, model.gravity.y],
        "parameters": parameters,
        "redundancy": if model.allow_redundancy { "allow" } else { "refuse" },
        "n_q": model.layout.n_q,
        "n_rows": model.layout.n_rows,
        "bodies": model.bodies.iter().map(body).collect::<Vec<_>>(),
        "constraints": model.constraints.iter().zip(rows)
            .map(|(item, rows)| constraint(model, item, rows)).collect::<Vec<_>>(),
        "forces": model.forces.iter().map(|item| force(model, item)).collect::<Vec<_>>(),
    })
}

fn body(body: &Body) -> Value {
    let points: Map<String, Value> =
        body.points.iter().map(|(name, s)| (name.clone(), pair(s))).collect();
    json!({
        "name": body.name,
        "type": body.kind,
        "mass": body.mass,
        "inertia": body.inertia,
        "center": pair(&body.center),
        "points": points,
    })
}

fn constraint(model: &Model, item: &ConstraintItem, rows: &std::ops::Range<usize>) -> Value {
    let [i, j] = [0, 1].map(|k| model.bodies[item.bodies[k].0].name.as_str());
    let equation = |e: &kempe::elements::Equation| json!({ "name": e.name, "unit": e.unit });
    json!({
        "name": item.name,
        "group": item.group.section(),
        "type": item.element.kind(),
        "i": i,
        "j": j,
        "point_i": pair(&item.element.attachment(0).s),
        "point_j": pair(&item.element.attachment(1).s),
        "axis_i": item.element.attachment(0).axis,
        "axis_j": item.element.attachment(1).axis,
        "rows": [rows.start, rows.end],
        "equations": item.equations.iter().map(equation).collect::<Vec<_>>(),
    })
}

fn force(model: &Model, item: &ForceItem) -> Value {
    let [i, j] = [0, 1].map(|k| model.bodies[item.bodies[k].0].name.as_str());
    let parts: Vec<&str> = item.element.parts().iter().map(|p| p.name).collect();
    let points = item.element.points();
    json!({
        "name": item.name,
        "type": item.element.kind(),
        "i": i,
        "j": j,
        "parts": parts,
        "points": points.map(|ends| ends.each_ref().map(pair)),
    })
}
