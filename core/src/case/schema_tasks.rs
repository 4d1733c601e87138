//! The JSON Schema of the sections with tasks: a synthesis and an exercise.

use crate::math::ShortArray;
use serde_json::Value;

use super::json_literal::json;
use super::schema_parts::{by_any_name, closed, described, object, texts, with_unit};
use super::tasks::{DEFECTS, DIRECTIONS, FAMILIES, FREEDOMS, TASKS};

/// A task and the limits of the linkages that solve it.
pub(super) fn synthesis() -> Value {
    let row =
        |n: u32| json!({ "type": "array", "items": with_unit(), "minItems": n, "maxItems": n });
    let rows = |n: u32| json!({ "type": "array", "items": row(n) });
    let whole = |least: u32| json!({ "type": "integer", "minimum": least });
    let kinds = json!([{ "type": "boolean" }, { "type": "string" }]);
    let part = json!({ "anyOf": [with_unit(), row(2), by_any_name(row(2))] });
    let fields = json!({
        "task": { "enum": TASKS.each(|(task, _)| task) },
        "poses": described(rows(3), "x, y and angle of the moving frame at each pose."),
        "points": described(rows(2), "Points that the coupler point must pass."),
        "angles": described(json!({ "type": "array", "items": with_unit() }), "Crank angles at the points."),
        "pairs": described(rows(2), "Angles of crank and rocker."),
        "pivots": described(by_any_name(row(2)), "Fixed ground pivots."),
        "parts": described(by_any_name(part), "Lengths, ranges or points of bodies of six-bars."),
        "family": { "enum": FAMILIES },
        "defects": { "enum": DEFECTS },
        "direction": { "enum": DIRECTIONS },
        "scales": { "enum": FREEDOMS },
        "offsets": { "enum": FREEDOMS },
        "transmission_angle": described(with_unit(), "Least transmission angle."),
        "grashof": described(json!({ "anyOf": kinds }), "True, or a type such as crank-rocker."),
        "within": described(rows(2), "Limits of x and y of the ground pivots."),
        "masses": described(by_any_name(with_unit()), "Masses of the bodies."),
        "ground": described(with_unit(), "Length of the ground of pairs of angles."),
        "samples": whole(1),
        "starts": whole(1),
        "seed": whole(0),
        "choice": described(whole(1), "The candidate that the bodies of this case are."),
    });
    let rest = json!({ "required": ["task"] });
    described(closed(object(fields), rest), "A task whose answer is a linkage.")
}

/// Questions about the mechanism, and parameters that are random.
pub(super) fn exercise() -> Value {
    let text = || json!({ "type": "string" });
    let number = || json!({ "type": "number" });
    let share = json!({ "type": "number", "exclusiveMinimum": 0, "exclusiveMaximum": 1 });
    let question = json!({
        "text": described(text(), "What is asked."),
        "measure": described(text(), "A column such as C.force.max, whose value is the answer."),
        "quantity": described(text(), "A quantity such as C.force, whose value is the answer."),
        "at": described(with_unit(), "The time or the value of the quantity; the start if absent."),
        "unit": described(text(), "The unit of an answer without one."),
        "tolerance": described(json!({ "anyOf": [share, text()] }), "A share, or such as 0.5 N."),
        "hints": texts(),
        "points": number(),
    });
    let sides = json!([{ "required": ["measure"] }, { "required": ["quantity"] }]);
    let question = closed(object(question), json!({ "required": ["text"], "oneOf": sides }));
    let step = json!({ "type": "number", "exclusiveMinimum": 0 });
    let range = json!({ "from": number(), "to": number(), "step": step, "unit": text() });
    let range = closed(object(range), json!({ "required": ["from", "to"] }));
    let fields = json!({
        "text": described(text(), "What the questions are about."),
        "questions": by_any_name(question),
        "parameters": described(by_any_name(range), "Parameters with random values."),
        "seed": { "type": "integer", "minimum": 0 },
        "analysis": described(text(), "Name of the analysis; the last one if absent."),
    });
    let rest = json!({ "required": ["questions"] });
    described(closed(object(fields), rest), "Questions about the mechanism.")
}
