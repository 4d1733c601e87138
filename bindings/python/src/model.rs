//! A compiled model, and its content as JSON.

use crate::active::Active;
use crate::convert::{refuse, Row};
use crate::errors::{raise_plain, Kind};
use crate::guard::guard;
use crate::run_analysis::RecentAnalysis;
use kempe::analyses::dynamics::{Prepared, Setting};
use kempe::elements::{
    BodyId, Curve, Group, Measured, Mode, OwnState, ResultQuantity, SceneSymbol, SymbolEnd,
};
use kempe::equations::reactions::touched;
use kempe::expression::Table;
use kempe::math::Local;
use kempe::model::{Body, Columns, Definition, Drawn, ForceMode, Functions, Model};
use numpy::{IntoPyArray, PyArray1};
use pyo3::prelude::*;
use serde_json::{json, Map, Value};
use std::ops::Range;
use std::sync::Arc;

/// A compiled model. Immutable.
#[pyclass(name = "Model", module = "kempe._core", frozen)]
pub struct PyModel {
    /// The model, with all drivers.
    pub model: Arc<Model>,
    /// The data that its simulations share.
    pub prepared: Arc<Prepared<Arc<Model>>>,
    /// The model without released drivers, which solves the equations.
    pub active: Active,
    /// The differences from the model of the case.
    setting: Setting,
    /// Its definition, in which analyses drive other quantities.
    pub definition: Arc<Definition>,
    /// The analysis of this model that was read last.
    pub recent: RecentAnalysis,
}

/// Python's allocator aligns objects only to 16 bytes.
const _: () = assert!(align_of::<PyModel>() <= 16);

impl PyModel {
    /// Wraps a model of the core.
    pub fn new(model: Arc<Model>, definition: Arc<Definition>) -> Self {
        let prepared = Arc::new(Prepared::new(Arc::clone(&model)));
        let active = Active::whole(&prepared);
        let (setting, recent) = (Setting::default(), RecentAnalysis::default());
        Self { model, prepared, active, setting, definition, recent }
    }

    /// The differences from the model of the case.
    pub fn setting(&self) -> &Setting {
        &self.setting
    }

    /// Wraps the model in a phase of a run.
    pub fn in_phase(&self, py: Python<'_>, setting: &Setting) -> PyResult<Self> {
        let with_drivers = Setting { released: Vec::new(), ..setting.clone() };
        let open = with_drivers
            .open(&self.model)
            .map_err(|problems| raise_plain(py, Kind::Model, &problems))?;
        let marked = (!setting.modes.is_empty()).then(|| open.marked(&setting.modes));
        let mut varied = Self::new(Arc::new(open.into_owned()), Arc::clone(&self.definition));
        varied.active = Active::of_phase(&varied.prepared, setting);
        varied.model = marked.map_or(varied.model, Arc::new);
        varied.setting = setting.clone();
        Ok(varied)
    }
}

#[pymethods]
impl PyModel {
    /// The content of the model in numbers, as JSON.
    fn describe(&self) -> PyResult<String> {
        guard("Model.describe", || Ok(describe(&self.model).to_string()))
    }

    /// The model with other values of parameters and with released drivers.
    fn variant(
        &self,
        py: Python<'_>,
        parameters: Vec<(String, f64)>,
        released: Vec<String>,
        modes: Vec<WrittenMode>,
    ) -> PyResult<Self> {
        guard("Model.variant", || {
            let modes = modes.iter().map(|of| read_mode(py, &self.model, of));
            let modes = modes.collect::<PyResult<_>>()?;
            self.in_phase(py, &Setting { parameters, released, modes })
        })
    }

    /// The values of parameters and the released drivers that differ from the model of the case.
    #[getter]
    #[pyo3(name = "setting")]
    fn written_setting(&self) -> Written {
        written(&self.setting)
    }

    /// The symbols of all elements, in the order of the model, as JSON.
    fn symbols(&self) -> PyResult<String> {
        guard("Model.symbols", || Ok(symbols(&self.model).to_string()))
    }

    /// Values of a table or of one of its derivatives, in SI units; NaN where there is no value.
    fn table<'py>(
        &self,
        py: Python<'py>,
        name: &str,
        derivative: usize,
        x: Row<'py>,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        guard("Model.table", || {
            let tables = &self.model.blueprint.tables;
            let Some(table) = tables.iter().find(|table| table.name() == name) else {
                return Err(refuse(py, "name", format!("there is no table '{name}'")));
            };
            if derivative > 5 {
                let message = format!("{derivative}; must be at most 5");
                return Err(refuse(py, "derivative", message));
            }
            let x = x.as_array();
            let values: Vec<f64> = x.iter().map(|x| table.derivative(derivative, *x)).collect();
            Ok(values.into_pyarray(py))
        })
    }

    /// The model with redundant constraints accepted.
    fn allowing_redundancy(&self) -> PyResult<Self> {
        guard("Model.allowing_redundancy", || {
            let open = Arc::new(self.model.allowing_redundancy());
            Ok(Self::new(open, Arc::clone(&self.definition)))
        })
    }
}

/// A mode of a force: index, name of the mode, sign, index of another force, and the value at which it holds.
pub type WrittenMode = (usize, String, f64, usize, f64);

/// Values of parameters, released drivers, and modes of forces.
pub type Written = (Vec<(String, f64)>, Vec<String>, Vec<WrittenMode>);

/// A setting for Python.
pub fn written(setting: &Setting) -> Written {
    (setting.parameters.clone(), setting.released.clone(), written_modes(&setting.modes))
}

/// Modes of forces for Python.
pub fn written_modes(modes: &[ForceMode]) -> Vec<WrittenMode> {
    let modes = modes.iter().map(|of| {
        let (name, sign, leader) = match of.mode {
            Mode::Open => ("open", 0.0, 0),
            Mode::Free => ("free", 0.0, 0),
            Mode::Idle => ("idle", 0.0, 0),
            Mode::Slides(sign) => ("slides", sign, 0),
            Mode::Holds(side) => ("holds", side, 0),
            Mode::Carries(share) => ("carries", share, 0),
            Mode::Follows { leader, sense } => ("follows", sense, leader),
        };
        (of.force, name.to_string(), sign, leader, of.value)
    });
    modes.collect()
}

/// The first row of each stretch of rows with the same modes, and these.
pub fn stretches(rows: &[Vec<ForceMode>]) -> Vec<(usize, Vec<WrittenMode>)> {
    let modes = |of: &ForceMode| (of.force, of.mode);
    let mut row = 0;
    let stretches = rows.chunk_by(|a, b| a.iter().map(modes).eq(b.iter().map(modes))).map(|of| {
        row += of.len();
        (row - of.len(), written_modes(&of[0]))
    });
    stretches.collect()
}

/// Reads a mode from Python.
fn read_mode(
    py: Python<'_>,
    model: &Model,
    (force, name, sign, leader, value): &WrittenMode,
) -> PyResult<ForceMode> {
    let mode = match name.as_str() {
        "open" => Mode::Open,
        "free" => Mode::Free,
        "idle" => Mode::Idle,
        "slides" => Mode::Slides(*sign),
        "holds" => Mode::Holds(*sign),
        "carries" => Mode::Carries(*sign),
        "follows" => Mode::Follows { leader: *leader, sense: *sign },
        _ => return Err(refuse(py, "modes", format!("there is no mode '{name}'"))),
    };
    let has_modes = |k: &usize| model.forces.get(*k).is_some_and(|item| item.held_row.is_some());
    if !has_modes(force) || matches!(mode, Mode::Follows { leader, .. } if !has_modes(&leader)) {
        return Err(refuse(py, "modes", format!("force {force} has no modes")));
    }
    Ok(ForceMode { value: *value, ..ForceMode::new(*force, mode) })
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
            "radii": symbol.radii,
            "module": symbol.module,
        })
    };
    let all = model.symbols();
    all.iter().flat_map(|(name, own)| own.iter().map(|symbol| one(name, symbol))).collect()
}

fn describe(model: &Model) -> Value {
    let names = &model.blueprint.parameters;
    let parameters: Map<String, Value> =
        names.iter().zip(&model.parameters).map(|(n, x)| (n.clone(), json!(x))).collect();
    let layout = &model.layout;
    let bodies = model.bodies.iter().zip(&layout.bodies);
    json!({
        "title": model.blueprint.title,
        "gravity": [model.gravity.x, model.gravity.y],
        "parameters": parameters,
        "redundancy": if model.allow_redundancy { "allow" } else { "refuse" },
        "tables": model.blueprint.tables.iter().map(|t| table(t)).collect::<Vec<_>>(),
        "n_q": layout.n_q,
        "n_z": layout.n_z,
        "n_rows": layout.n_rows,
        "n_multipliers": model.n_multipliers(),
        "bodies": bodies.map(|(item, columns)| body(item, *columns)).collect::<Vec<_>>(),
        "constraints": (0..model.constraints.len()).map(|k| constraint(model, k)).collect::<Vec<_>>(),
        "forces": (0..model.listed_forces().len()).map(|k| force(model, k)).collect::<Vec<_>>(),
    })
}

fn body(body: &Body, columns: Columns) -> Value {
    let points: Map<String, Value> =
        body.points.iter().map(|(name, s)| (name.clone(), pair(s))).collect();
    let curves: Map<String, Value> = body.curves.iter().filter_map(drawn).collect();
    json!({
        "name": body.name,
        "type": body.kind,
        "mass": body.mass,
        "inertia": body.inertia,
        "center": pair(&body.center),
        "points": points,
        "curves": curves,
        "drawn": body.drawn().iter().map(part).collect::<Vec<_>>(),
        "columns": span(&columns.range()),
    })
}

/// A line or an area of the drawing of a body, as JSON.
fn part(part: &Drawn) -> Value {
    json!({ "points": part.points.iter().map(pair).collect::<Vec<_>>(), "form": part.form.name() })
}

fn table(table: &Table) -> Value {
    json!({
        "name": table.name(),
        "interpolation": table.interpolation().name(),
        "range": table.range(),
        "period": table.period(),
    })
}

/// The name of a curve and points along the curve, for drawings.
fn drawn((name, curve): &(String, Option<Curve>)) -> Option<(String, Value)> {
    let curve = curve.as_ref()?;
    let points: Vec<Value> = curve.drawn().iter().map(pair).collect();
    Some((name.clone(), json!({ "points": points, "closed": curve.periodic() })))
}

fn span(range: &Range<usize>) -> Value {
    json!([range.start, range.end])
}

/// Names of the bodies of an element: i and j first. For an element with one body, this body is both i and j.
fn connected<'a>(model: &'a Model, bodies: &[BodyId]) -> (Value, Value, Vec<&'a str>) {
    let names: Vec<&str> = bodies.iter().map(|body| model.bodies[body.0].name.as_str()).collect();
    let at = |k: usize| json!(names.get(k.min(names.len().saturating_sub(1))));
    (at(0), at(1), names)
}

/// Names and units of the internal coordinates of an element: u, or u1, u2 and u3.
fn internal(model: &Model, columns: Columns) -> Vec<Value> {
    let unit = |k: usize| model.layout.kinds[columns.first + k].unit();
    let name = |k: usize| match columns.count {
        1 => "u".to_string(),
        _ => format!("u{}", k + 1),
    };
    (0..columns.count).map(|k| json!({ "name": name(k), "unit": unit(k) })).collect()
}

/// Position quantities: the names of position, rate and acceleration, and the unit of the position.
fn measured(all: &[Measured]) -> Vec<Value> {
    all.iter().map(|of| json!({ "names": of.names, "unit": of.kind.unit() })).collect()
}

fn constraint(model: &Model, k: usize) -> Value {
    let (item, slots) = (&model.constraints[k], &model.layout.constraints[k]);
    let (i, j, _) = connected(model, &item.bodies);
    let touched: Vec<BodyId> = touched(model, k).collect();
    let (_, _, bodies) = connected(model, &touched);
    let result =
        |r: &ResultQuantity| json!({ "name": r.name, "unit": r.unit, "negative": r.negative });
    let limits = |k: usize| model.forces[k].element.driver().is_some();
    let equation = |e: &kempe::elements::Equation| json!({ "name": e.name, "unit": e.kind.unit() });
    json!({
        "name": item.name,
        "group": item.group.section(),
        "type": item.element.kind(),
        "is_shown": item.element.in_files(),
        "is_limited": item.companion.is_some_and(limits),
        "may_slip": item.companion.is_some_and(|k| !limits(k)),
        "i": i,
        "j": j,
        "point_i": pair(&item.element.attachment(0).s),
        "point_j": pair(&item.element.attachment(1).s),
        "axis_i": item.element.attachment(0).axis,
        "axis_j": item.element.attachment(1).axis,
        "bodies": bodies,
        "columns": span(&slots.own.range()),
        "coordinates": internal(model, slots.own),
        "rows": span(&slots.rows),
        "equations": item.equations.iter().map(equation).collect::<Vec<_>>(),
        "results": item.element.result_quantities().iter().map(result).collect::<Vec<_>>(),
        "measured": measured(item.element.measured()),
    })
}

fn force(model: &Model, k: usize) -> Value {
    let (item, places) = (&model.forces[k], &model.layout.states[k]);
    let sampled = model.blueprint.functions.iter().flat_map(Functions::sampled);
    let held: Vec<Value> = sampled
        .filter(|(_, law, _)| law.element == item.name)
        .map(|(_, law, _)| json!({ "name": format!("{}_held", law.field), "unit": law.unit }))
        .collect();
    let (i, j, bodies) = connected(model, &item.bodies);
    let state = |state: &OwnState| json!({ "name": state.name, "unit": state.unit });
    let parts: Vec<&str> = item.element.parts().iter().map(|p| p.name).collect();
    let points = item.element.points();
    let of_result = |r: &ResultQuantity| json!({ "name": r.name, "unit": r.unit });
    json!({
        "name": item.name,
        "type": item.element.written(),
        "is_joint": item.element.group() == Group::Joints,
        "i": i,
        "j": j,
        "bodies": bodies,
        "parts": parts,
        "places": span(&(places.start..places.end + held.len())),
        "states": item.states.iter().map(state).chain(held).collect::<Vec<_>>(),
        "reaction": item.reaction.map(|joint| model.constraints[joint.0].name.as_str()),
        "points": points.map(|ends| ends.each_ref().map(pair)),
        "results": item.element.result_quantities().iter().map(of_result).collect::<Vec<_>>(),
        "is_shown": item.element.in_files(),
        "reads_multipliers": item.needs_multipliers(),
        "measured": measured(item.element.measured()),
    })
}
