//! Scene and display list of a mechanism in its current pose.

use crate::convert::Fields;
use crate::fault::Fault;
use crate::loaded::Loaded;
use kempe::equations::kinematics::Motions;
use kempe_drawing::scene::efforts;
use kempe_drawing::{display as list, scene as make, Pose, Request, Scene, View};
use serde_json::{json, Value};

/// The static part of the scene: bodies, joints, symbols, bounds, unit of lengths and gravity.
pub fn scene(loaded: &Loaded) -> Result<Value, Fault> {
    let scene = serde_json::to_value(made(loaded)).map_err(|e| Fault::new(e.to_string()))?;
    Ok(json!({ "scene": scene }))
}

/// The display list for an area in points, and the view for which names are laid out.
pub fn display(loaded: &Loaded, fields: &Fields<'_>) -> Result<Value, Fault> {
    let scene = made(loaded);
    let size = [fields.number("width")?, fields.number("height")?];
    let view = View::around(scene.bounds, size);
    let shown = |name: &str| fields.get(name) != Some(&Value::Bool(false));
    let all = Request::labelled();
    let request = Request {
        numbers: all.numbers.filter(|_| shown("numbers")),
        joints: shown("names"),
        elements: shown("names"),
        ..all
    };
    let items = list(&scene, &[poses(loaded)], &view, &request);
    let items = serde_json::to_value(items).map_err(|e| Fault::new(e.to_string()))?;
    Ok(json!({ "items": items, "low": view.low, "scale": view.scale }))
}

fn made(loaded: &Loaded) -> Scene {
    let state = std::slice::from_ref(&loaded.state);
    // accelerations, and therefore efforts, exist only if the mechanism closes
    let efforts = match loaded.assembled {
        true => efforts(&loaded.model, state),
        false => Vec::new(),
    };
    make(&loaded.model, &[poses(loaded)], &efforts)
}

fn poses(loaded: &Loaded) -> Vec<Pose> {
    let (layout, state) = (&loaded.model.layout, &loaded.state);
    let motions = Motions::at_rest(layout, &state.q);
    let pose = |body: usize| {
        let pose = &motions[body].pose;
        [pose.r.x, pose.r.y, pose.angle]
    };
    (1..loaded.model.bodies.len()).map(pose).collect()
}
