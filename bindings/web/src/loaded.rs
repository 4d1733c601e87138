//! The content of a text: its case, its model and its assembled start.

use crate::fault::{diagnostic, placed, Fault};
use crate::mechanism::mechanism;
use crate::pose::pose;
use kempe::analyses::assemble::{self, open_placement, Targets};
use kempe::analyses::measures;
use kempe::case::{self, Case, Document, Format};
use kempe::{assemble, build, mobility, Model, State};
use serde_json::{json, Value};
use std::sync::Arc;

/// A case whose model could be built.
pub struct Loaded {
    /// The case.
    pub case: Case,
    /// Its model. Parameters may have other values than in the text.
    pub model: Arc<Model>,
    /// The model without drivers, for dragging, and its degrees of freedom if it closes.
    pub free: (Arc<Model>, usize),
    /// The current state.
    pub state: State,
    /// Whether the mechanism is closed.
    pub assembled: bool,
}

/// Reads a text. The reply describes the parts that could be read. There is a case only if the model could be built.
pub fn load(text: &str) -> (Option<Loaded>, Value) {
    let (case, document) = match case::read(text, Format::Toml) {
        Ok(read) => read,
        Err(found) => {
            let problems: Vec<Value> = found.iter().map(diagnostic).collect();
            return (None, unread(&problems, tree(text)));
        }
    };
    let written = tree(text);
    let model = match build(&case.definition, &[]) {
        Ok(model) => model,
        Err(found) => return (None, unread(&placed(&document, &found), written)),
    };
    let mut found = measures::check(&model, &case.definition.measures);
    found.extend(case.faults(&model));
    let (loaded, failure) = start(case, model);
    let reply = described(&loaded, &placed(&document, &found), written, failure, &document);
    (Some(loaded), reply)
}

/// The case of the text as JSON. Null if its syntax is faulty.
fn tree(text: &str) -> Value {
    let read = case::parse_tree(text, Format::Toml).ok();
    read.map_or(Value::Null, |value| crate::convert::json_of(&value))
}

fn unread(problems: &[Value], case: Value) -> Value {
    json!({ "problems": problems, "case": case, "mechanism": null, "pose": null, "unassembled": null })
}

/// Assembles the start of a case. If this fails, the bodies are placed with open joints.
fn start(case: Case, model: Model) -> (Loaded, Result<assemble::Report, Fault>) {
    let model = Arc::new(model);
    let request = case.start.request(&model);
    let outcome = match &request {
        Ok(request) => assemble(&model, request)
            .map_err(|failure| Fault::new(failure.message.clone()).hint(failure.hint.clone())),
        Err(problems) => Err(Fault::new(problems.to_string())),
    };
    let assembled = outcome.is_ok();
    let (state, report) = match outcome {
        Ok((state, report)) => (state, Ok(report)),
        Err(fault) => {
            let q = open_placement(&model, &Targets::of(&model, 0.0));
            let v = vec![0.0; q.len()];
            (State { t: 0.0, q, v, z: vec![0.0; model.layout.n_z] }, Err(fault))
        }
    };
    let free = without_drivers(&model, &state, assembled);
    (Loaded { case, model, free, state, assembled }, report)
}

/// The model without its drivers, and its degrees of freedom.
pub fn without_drivers(model: &Arc<Model>, state: &State, assembled: bool) -> (Arc<Model>, usize) {
    let drivers = model.constraints.iter().filter(|item| item.element.drives().is_some());
    let drivers: Vec<String> = drivers.map(|item| item.name.clone()).collect();
    let free = match drivers.is_empty() {
        true => Arc::clone(model),
        false => Arc::new(model.without(&drivers)),
    };
    let freedoms = match assembled {
        true => mobility(&free, state.t, &state.q).degrees_of_freedom,
        false => 0,
    };
    (free, freedoms)
}

fn described(
    loaded: &Loaded,
    problems: &[Value],
    written: Value,
    report: Result<assemble::Report, Fault>,
    document: &Document,
) -> Value {
    let mut described = mechanism(&loaded.case, &loaded.model);
    let unassembled = match report {
        Ok(report) => {
            described["degrees_of_freedom"] = json!(report.degrees_of_freedom);
            described["warnings"] = json!(report.warnings);
            Value::Null
        }
        Err(fault) => {
            described["degrees_of_freedom"] = Value::Null;
            described["warnings"] = json!([]);
            let place = document.position(&["start"]);
            let mut value = fault.value();
            value["line"] = json!(place.map(|(line, _)| line));
            value["column"] = json!(place.map(|(_, column)| column));
            value
        }
    };
    described["coordinates"] = coordinates(&loaded.model);
    json!({
        "problems": problems, "case": written, "mechanism": described,
        "pose": pose(&loaded.model, &loaded.state), "unassembled": unassembled,
    })
}

/// The names of q, such as `crank.x`. Parameters of curves follow the bodies and are omitted.
fn coordinates(model: &Model) -> Value {
    let of = |k: usize| {
        let count = model.layout.bodies[k].count;
        let body = &model.bodies[k].name;
        ["x", "y", "angle"].into_iter().take(count).map(move |c| format!("{body}.{c}"))
    };
    json!((1..model.bodies.len()).flat_map(of).collect::<Vec<_>>())
}
