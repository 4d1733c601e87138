//! Scene and display list of a mechanism in its current pose and over its last run.

use crate::convert::Fields;
use crate::fault::Fault;
use crate::loaded::Loaded;
use crate::run::Ran;
use kempe::equations::kinematics::Motions;
use kempe_drawing::scene::efforts;
use kempe_drawing::{display as list, scene as make, Pose, Request, Scene, View};
use serde_json::{json, Value};

/// The largest number of instants for which names are laid out.
const LAID_OUT: usize = 20;

/// The static part of the scene: bodies, joints, symbols, bounds, unit of lengths and gravity. Slots and guides are as long
/// as the travel of a run.
pub fn scene(loaded: &Loaded, ran: Option<&Ran>) -> Result<Value, Fault> {
    let scene = made(loaded, ran);
    let scene = serde_json::to_value(scene).map_err(|e| Fault::new(e.to_string()))?;
    Ok(json!({ "scene": scene }))
}

/// The display list for an area in points, and the view for which names are laid out.
pub fn display(loaded: &Loaded, ran: Option<&Ran>, fields: &Fields<'_>) -> Result<Value, Fault> {
    let scene = made(loaded, ran);
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
    let items = list(&scene, &poses(loaded, ran, LAID_OUT), &view, &request);
    let items = serde_json::to_value(items).map_err(|e| Fault::new(e.to_string()))?;
    Ok(json!({ "items": items, "low": view.low, "scale": view.scale }))
}

fn made(loaded: &Loaded, ran: Option<&Ran>) -> Scene {
    let state = std::slice::from_ref(&loaded.state);
    // accelerations, and therefore efforts, exist only if the mechanism closes
    let efforts = match loaded.assembled {
        true => efforts(&loaded.model, state),
        false => Vec::new(),
    };
    make(&loaded.model, &poses(loaded, ran, usize::MAX), &efforts)
}

/// The poses of the moving bodies now, and at some outputs of a run.
fn poses(loaded: &Loaded, ran: Option<&Ran>, most: usize) -> Vec<Vec<Pose>> {
    let (layout, state) = (&loaded.model.layout, &loaded.state);
    let motions = Motions::at_rest(layout, &state.q);
    let pose = |body: usize| {
        let pose = &motions[body].pose;
        [pose.r.x, pose.r.y, pose.angle]
    };
    let mut found: Vec<Vec<Pose>> = vec![(1..loaded.model.bodies.len()).map(pose).collect()];
    let Some(Ok(rows)) = ran.map(Ran::frames) else { return found };
    let width = 1 + 3 * found[0].len();
    for rows in rows.chunks_exact(width * (rows.len() / width).div_ceil(most).max(1)) {
        let mut row = found[0].clone();
        for (pose, at) in row.iter_mut().zip(rows[1..].chunks_exact(3)) {
            *pose = [at[0], at[1], at[2]];
        }
        found.push(row);
    }
    found
}
