//! A motion at one output: places, rates and accelerations of all bodies, and all loads on them.

use crate::convert::row;
use crate::fault::Fault;
use kempe::analyses::dynamics::{Prepared, Run, States};
use kempe::elements::{BodyId, Group};
use kempe::equations::actions::{self, each_action};
use kempe::equations::forces::Acting;
use kempe::equations::kinematics::Motions;
use kempe::equations::reactions::{self, touched, Frame};
use kempe::math::{Vec2, Wrench};
use kempe::{Flow, Model};
use serde_json::{json, Value};

/// Everything at output `k` of a run. Loads and accelerations are null where they are not unique.
pub fn described(model: &Model, run: &Run, k: usize) -> Result<Value, Fault> {
    let count = run.trajectory.t.len();
    if k >= count {
        return Err(Fault::new(format!("the run has {count} outputs")));
    }
    let phase = run.phases.iter().rposition(|first| *first <= k).unwrap_or(0);
    let active = run.settings.get(phase).and_then(|setting| setting.model(model).ok());
    let model = active.as_ref().unwrap_or(model);
    let all = run.states_of(phase);
    let at = k - run.phases.get(phase).unwrap_or(&0);
    let part = |table: &[f64]| {
        let width = table.len() / all.t.len();
        at * width..(at + 1) * width
    };
    let (q, v, z) = (&all.q[part(all.q)], &all.v[part(all.v)], &all.z[part(all.z)]);
    let states = States { t: &all.t[at..=at], q, v, z };
    let solved = Prepared::new(model).accelerations(states, run.passing, |_| Flow::Continue).ok();
    let motions = Motions::at(&model.layout, q, v);
    let bodies = model.bodies.iter().enumerate().map(|(b, body)| {
        let (pose, twist) = (&motions[b].pose, &motions[b].twist);
        let a = solved.as_ref().map(|found| row(&model.layout.bodies[b].of(&found.a)));
        json!({
            "pose": row(&[pose.r.x, pose.r.y, pose.angle]),
            "rate": row(&[twist.velocity.x, twist.velocity.y, twist.omega]),
            "acceleration": a, "mass": body.mass, "inertia": body.inertia, "turns": body.turns,
            "center": [body.center.x, body.center.y],
        })
    });
    let lam = solved.as_ref().map(|found| &found.lam[..]);
    let acting = Acting { z, lam, t: all.t[at] };
    Ok(json!({
        "t": all.t[at], "bodies": bodies.collect::<Vec<_>>(), "joints": joints(model),
        "loads": lam.map(|_| loads(model, &motions, acting)),
    }))
}

/// The joints that keep two points together, and those whose body j slides along a line of body i.
fn joints(model: &Model) -> Vec<Value> {
    let own = model.constraints.iter().enumerate().filter(|(k, item)| {
        let own = model.layout.constraints[*k].own;
        item.group.section() == "joints" && item.bodies.len() == 2 && own.count == 0
    });
    let found = own.filter_map(|(_, item)| {
        let kind = item.element.measured().first()?.names[0];
        let (i, j) = (item.element.attachment(0), item.element.attachment(1));
        ["angle", "displacement"].contains(&kind).then(|| {
            json!({
                "name": item.name, "slides": kind == "displacement",
                "bodies": item.bodies.iter().map(|body| body.0).collect::<Vec<_>>(),
                "points": [[i.s.x, i.s.y], [j.s.x, j.s.y]], "axis": i.axis,
            })
        })
    });
    found.collect()
}

/// The loads of joints, drivers and force elements on every body, and the weights. The moment of a load is about its place.
fn loads(model: &Model, motions: &Motions, acting: Acting<'_, f64>) -> Vec<Value> {
    let mut found = Vec::new();
    let mut add = |name: &str, kind: &str, on: BodyId, place: Vec2, load: Wrench| {
        found.push(json!({
            "name": name, "kind": kind, "body": on.0, "place": [place.x, place.y],
            "force": [load.force.x, load.force.y], "moment": load.torque,
        }));
    };
    for (k, item) in model.constraints.iter().enumerate() {
        // the equation of a force that holds is a part of the force
        if item.group == Group::Forces || !item.element.in_files() {
            continue;
        }
        let kind = item.group.section().trim_end_matches('s');
        for on in touched(model, k) {
            let load = actions::reaction(model, k, on, Frame::Global, motions, acting);
            let place = reactions::place(model, k, on, motions, acting.t);
            add(&item.name, kind, on, place, load.unwrap_or_else(Wrench::zero));
        }
    }
    for (k, item) in model.listed_forces().iter().enumerate() {
        for (n, on) in item.bodies.iter().enumerate() {
            if item.bodies[..n].contains(on) {
                continue;
            }
            let mut sum = Wrench::zero();
            each_action(model, k, motions, acting, |_, body, load| {
                if body == *on {
                    sum = sum + load;
                }
            });
            add(&item.name, "force", *on, actions::place(model, k, *on, motions, acting), sum);
        }
    }
    for (b, body) in model.bodies.iter().enumerate().skip(1) {
        let force = Vec2::new(body.mass * model.gravity.x, body.mass * model.gravity.y);
        let weight = Wrench { force, torque: 0.0 };
        add("gravity", "gravity", BodyId(b), motions[b].pose.point(body.center), weight);
    }
    found
}
