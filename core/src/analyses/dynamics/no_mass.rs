//! Messages about coordinates whose motion no inertia resists: bodies without mass or inertia.

use crate::elements::BodyId;
use crate::math::Listed;
use crate::model::{beam_of, Model, Slots, BEAM, NODE};

/// The name of a body, or of a joint with internal coordinates, and a message that no inertia resists the motion of this
/// coordinate.
pub(super) fn undetermined(model: &Model, t: f64, column: usize) -> (String, String) {
    let owner = |slots: &Slots| slots.own.range().contains(&column);
    if let Some(k) = model.layout.constraints.iter().position(owner) {
        let name = model.constraints[k].name.clone();
        let message = format!(
            "the place of {name} on its curve is not determined at t = {t:.6} s: no inertia resists its motion along the curve"
        );
        return (name, message);
    }
    let (id, place) = model.layout.body_of(column).unwrap_or((BodyId::GROUND, 0));
    if let Some(of_beam) = of_beam(model, t, id) {
        return of_beam;
    }
    let name = model.bodies[id.0].name.clone();
    let joints = joined(model, id).join(", ");
    let message = match model.bodies[id.0].mass > 0.0 {
        true => without_inertia(model, t, id, &joints),
        false => {
            let coordinate = ["x", "y", "angle"][place];
            // the inertia of a bar follows from its mass
            let turns = place == 2 && model.bodies[id.0].kind == "body";
            let set = if turns { "inertia" } else { "mass" };
            let leave = match joints.as_str() {
                "" => "no joint holds it".to_string(),
                joints => {
                    format!("its joints ({joints}) leave it a freedom of its own in this position")
                }
            };
            format!(
                "the motion of {name} is not determined at t = {t:.6} s: no inertia resists {name}.{coordinate}, because \
                 {name} has no {set} and {leave}; set its {set}, or hold it with a joint or driver"
            )
        }
    };
    (name, message)
}

/// The name of a beam without mass, or whose sections have no moment of inertia, and the message. None if the body is not
/// part of a beam.
pub(in crate::analyses) fn of_beam(model: &Model, t: f64, id: BodyId) -> Option<(String, String)> {
    let node = &model.bodies[id.0];
    if ![BEAM, NODE].contains(&node.kind) {
        return None;
    }
    let beam = beam_of(&node.name);
    let (lacks, remedy) = match node.mass > 0.0 {
        true => ("moment of inertia of its sections", "give inertia_per_length > 0"),
        false => ("mass", "give density or mass_per_length > 0"),
    };
    let message = format!(
        "the motion of beam {beam} is not determined at t = {t:.6} s: it has no {lacks}; {remedy}, or compute \
         its equilibrium"
    );
    Some((beam.to_string(), message))
}

fn without_inertia(model: &Model, t: f64, id: BodyId, joints: &str) -> String {
    let body = &model.bodies[id.0];
    let (name, inertia) = (&body.name, body.inertia);
    let (has, set) = match inertia > 0.0 {
        true => (format!("hardly any moment of inertia ({inertia:.1e} kg·m²)"), "increase"),
        false => ("no moment of inertia".to_string(), "set"),
    };
    let advice = match joints {
        "" => format!("and no joint prevents its rotation; {set} its inertia"),
        joints => format!(
            "and its joints ({joints}) add hardly any in this position; {set} its inertia, or increase the \
             mass of the bodies that they join to it"
        ),
    };
    format!("a torque acts on {name} at t = {t:.6} s, but {name} has {has} {advice}")
}

/// The joints and drivers of a body.
fn joined(model: &Model, body: BodyId) -> Vec<&str> {
    let joints = model.constraints.iter().filter(|item| item.bodies.contains(&body));
    joints.map(|item| item.name.as_str()).list()
}
