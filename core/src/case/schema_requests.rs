//! The JSON Schema of the sections that ask for many runs or for slopes.

use crate::math::ShortArray;
use serde_json::Value;

use super::json_literal::json;
use super::problems::{FREE, LOSSES, METHODS};
use super::schema_parts::{by_any_name, closed, described, object, texts, with_unit};
use super::schema_tasks;
use super::sweep::{DESIGNS, SCALES};

/// The words about `analysis`.
const ANALYSIS: &str = "Name of the analysis; the last one if absent.";

/// Adds the sections.
pub(super) fn add(sections: &mut Value) {
    sections["sweep"] = sweep();
    let variables = described(texts(), "Parameters, or coordinates and rates at the start.");
    let words = "A gradient: derivatives of measures by variables.";
    sections["gradient"] = of_columns(json!({ "variables": variables }), words);
    sections["optimize"] = optimize();
    sections["fit"] = fit();
    sections["synthesis"] = schema_tasks::synthesis();
    sections["exercise"] = schema_tasks::exercise();
}

/// Variables with their values, measures, and the design of a sweep.
fn sweep() -> Value {
    let list =
        |count: u32| json!({ "type": "array", "items": { "type": "number" }, "minItems": count });
    let mut two = list(2);
    two["maxItems"] = json!(2);
    let number = || json!({ "type": "number" });
    let whole = |least: u32| json!({ "type": "integer", "minimum": least });
    let range =
        json!({ "from": number(), "to": number(), "n": whole(2), "scale": { "enum": SCALES } });
    let [range, normal, uniform] = [
        closed(object(range), json!({ "required": ["from", "to"] })),
        closed(object(json!({ "normal": two.clone() })), json!({ "required": ["normal"] })),
        closed(object(json!({ "uniform": two })), json!({ "required": ["uniform"] })),
    ];
    let values = json!({ "anyOf": [list(1), range, normal, uniform] });
    let fields = json!({
        "variables": described(
            json!({ "type": "object", "additionalProperties": values }),
            "Parameters, or coordinates and rates at the start, with lists, ranges or distributions."
        ),
        "design": { "enum": DESIGNS },
        "n": described(whole(1), "Number of variants of a random, latin or sobol design."),
        "seed": whole(0),
    });
    of_columns(fields, "A sweep: many variants of the case.")
}

/// Variables between bounds, an objective, and limits.
fn optimize() -> Value {
    let number = || json!({ "type": "number" });
    let scale = json!({ "enum": SCALES });
    let items = json!([number(), number(), scale]);
    let bounds = json!({ "type": "array", "prefixItems": items, "items": false, "minItems": 2 });
    let pair = json!({ "type": "array", "items": number(), "minItems": 2, "maxItems": 2 });
    let path = json!({
        "points": { "type": "array", "items": pair },
        "of": described(json!({ "type": "string" }), "A point such as coupler.P."),
        "angles": { "type": "array", "items": number(), "minItems": 1 },
    });
    let path = closed(object(path), json!({ "required": ["points", "of"] }));
    let one = json!({ "anyOf": [{ "type": "string" }, path] });
    let list = json!({ "type": "array", "items": one.clone(), "minItems": 1 });
    let several = json!({ "anyOf": [list, one] });
    let setting = json!({ "type": "object", "additionalProperties": with_unit() });
    let loads = json!({ "type": "array", "items": setting, "minItems": 1 });
    let about = "A column, a formula of columns, a path, or several of these.";
    let fields = json!({
        "variables": described(by_any_name(bounds), "Parameters or values at the start, with bounds."),
        "minimize": described(several.clone(), about),
        "maximize": described(several, about),
        "target": described(by_any_name(number()), "Columns, with the values that they should have."),
        "subject_to": described(texts(), "Limits such as C.force.max <= 2e4."),
        "loads": described(loads, "Load cases: settings of parameters, for worst(column)."),
        "starts": { "type": "integer", "minimum": 1 },
        "seed": { "type": "integer", "minimum": 0 },
        "method": { "enum": METHODS },
        "analysis": { "type": "string", "description": ANALYSIS },
    });
    let aims = ["minimize", "maximize", "target"].each(|key| json!({ "required": [key] }));
    let rest = json!({ "required": ["variables"], "oneOf": aims });
    described(closed(object(fields), rest), "The best values of variables within limits.")
}

/// Columns of measured data, and the parameters that are fitted to them.
fn fit() -> Value {
    let text = || json!({ "type": "string" });
    let end = json!({ "anyOf": [{ "type": "number" }, { "const": FREE }] });
    let pair = json!({ "type": "array", "items": end, "minItems": 2, "maxItems": 2 });
    let range = json!({ "anyOf": [{ "const": FREE }, pair] });
    let fields = json!({
        "t": described(text(), "Header of the column of times."),
        "shift": described(text(), "Parameter of the fit by which the model is later than the data."),
        "columns": described(by_any_name(text()), "Quantities, with the headers of their columns."),
        "sigma": described(by_any_name(with_unit()), "Standard deviations of the measured values."),
        "parameters": described(by_any_name(range), "Parameters or values at the start, with bounds."),
        "robust": { "enum": LOSSES },
        "analysis": { "type": "string", "description": ANALYSIS },
    });
    let rest = json!({ "required": ["columns", "parameters"] });
    described(
        closed(object(fields), rest),
        "Values of parameters that agree best with measured data.",
    )
}

/// A section with variables, measures and an analysis.
fn of_columns(fields: Value, words: &str) -> Value {
    let mut fields = object(fields);
    fields.insert("measures".into(), described(texts(), "Statistics such as pin.max."));
    fields.insert("analysis".into(), described(json!({ "type": "string" }), ANALYSIS));
    described(closed(fields, json!({ "required": ["variables", "measures"] })), words)
}
