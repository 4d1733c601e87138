//! The allowed content of a case, for palettes and forms.

use kempe::case;
use kempe::elements::{Fixes, Group};
use kempe::model::Value as Written;
use kempe::{build, Definition, Entry, Model};
use serde_json::{json, Value};

/// The catalogue and the version. Joints between two points have a flag whether they only hold the points together.
pub fn catalogue() -> Value {
    let mut found = case::catalogue();
    if let Some(joints) = found["joints"].as_array_mut() {
        for joint in joints {
            let joins = joint["name"].as_str().is_some_and(joins_points);
            joint["joins_points"] = json!(joins);
        }
    }
    json!({ "elements": found, "version": env!("CARGO_PKG_VERSION") })
}

/// Whether a joint of this type between two points only holds them together, as a pin does.
fn joins_points(kind: &str) -> bool {
    let sample = sample(kind);
    sample.is_some_and(|model| {
        let mut joints = model.constraints.iter().filter(|item| item.group == Group::Joints);
        joints.next().is_some_and(|item| matches!(item.element.fixes()[..], [Fixes::Points]))
    })
}

/// A bar on a ground point, held by a joint of this type. None unless the joint has two points and no other required
/// field.
fn sample(kind: &str) -> Option<Model> {
    let text = |text: &str| Written::Text(text.to_string());
    let number = Written::Number;
    let table = |fields: Vec<(&str, Written)>| -> Vec<(String, Written)> {
        fields.into_iter().map(|(key, value)| (key.to_string(), value)).collect()
    };
    let origin = Written::List(vec![number(0.0), number(0.0)]);
    let points = Written::Table(table(vec![("A", origin)]));
    let bar = vec![
        ("type", text("bar")),
        ("mass", number(1.0)),
        ("length", number(1.0)),
        ("ends", Written::List(vec![text("A"), text("B")])),
    ];
    let joint = vec![("type", text(kind)), ("i", text("ground.A")), ("j", text("bar.A"))];
    let entry = |name: &str, fields| Entry { name: name.to_string(), fields: table(fields) };
    let definition = Definition {
        bodies: vec![entry("ground", vec![("points", points)]), entry("bar", bar)],
        joints: vec![entry("J", joint)],
        ..Definition::default()
    };
    build(&definition, &[]).ok()
}
