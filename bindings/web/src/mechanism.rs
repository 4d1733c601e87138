//! The description of a model for a page.

use kempe::case::Case;
use kempe::elements::Group;
use kempe::model::{Body, Value as Written};
use kempe::Model;
use serde_json::{json, Map, Value};

/// Bodies, elements, parameters and analyses of a model.
pub fn mechanism(case: &Case, model: &Model) -> Value {
    let group = |group: Group| -> Vec<Value> {
        let items = model.constraints.iter();
        let items = items.filter(|item| item.group == group && item.element.in_files());
        items.map(|item| json!({ "name": item.name, "type": item.element.kind() })).collect()
    };
    // an elastic piece is part of its beam
    let forces = model.listed_forces().iter().filter(|item| item.element.in_files());
    let forces: Vec<Value> =
        forces.map(|item| json!({ "name": item.name, "type": item.element.written() })).collect();
    let blueprint = &model.blueprint;
    let parameters = blueprint.parameters.iter().zip(&model.parameters).zip(&blueprint.inferred);
    let parameters: Vec<Value> = parameters
        .map(|((name, value), unit)| json!({ "name": name, "value": value, "unit": unit.unit() }))
        .collect();
    let analyses = case.analyses.iter().map(|entry| {
        let kind = match entry.get("type") {
            Some(Written::Text(kind)) => kind.as_str(),
            _ => "",
        };
        json!({ "name": entry.name, "type": kind })
    });
    json!({
        "title": case.definition.title,
        "gravity": [model.gravity.x, model.gravity.y],
        "bodies": model.bodies.iter().enumerate().map(body).collect::<Vec<_>>(),
        "joints": group(Group::Joints),
        "drivers": group(Group::Drivers),
        "forces": forces,
        "parameters": parameters,
        "analyses": analyses.collect::<Vec<_>>(),
    })
}

fn body((k, body): (usize, &Body)) -> Value {
    let points = body.points.iter().map(|(name, s)| (name.clone(), json!([s.x, s.y])));
    json!({
        "name": body.name, "kind": body.kind, "ground": k == 0,
        "points": points.collect::<Map<_, _>>(),
        "center": [body.center.x, body.center.y], "mass": body.mass, "inertia": body.inertia,
    })
}
