//! Sentences of failures that depend on the mechanism: joints that come apart, and bodies that nothing keeps from turning.

use crate::elements::BodyId;
use crate::model::Model;

/// A motion that fails before this time, s, is so fast that no method follows it.
const AT_ONCE: f64 = 1e-9;

/// Two quantities with as many digits as tell them apart, at least two.
pub(super) fn different(a: f64, b: f64) -> [String; 2] {
    let shown = |digits: usize| [a, b].map(|x| format!("{x:.digits$e}"));
    (1..17).map(shown).find(|[a, b]| a != b).unwrap_or_else(|| shown(1))
}

/// The remedy for joints that come apart at time `t`.
pub(super) fn apart_hint(t: f64) -> &'static str {
    if t.abs() < AT_ONCE {
        return "the motion is too fast to be computed: reduce the greatest stiffness, damping or force, or increase the \
                smallest mass or inertia; a start must meet the constraints";
    }
    "use stabilization projection, a smaller tolerance or step, or greater gains; a start must meet the constraints"
}

/// A torque acts on a body whose rotation has no inertia.
pub(super) fn unresisted(model: &Model, body: BodyId, t: f64) -> String {
    let item = &model.bodies[body.0];
    let (name, inertia) = (&item.name, item.inertia);
    let (has, set) = match inertia > 0.0 {
        true => (format!("hardly any moment of inertia ({inertia:.1e} kg·m²)"), "increase"),
        false => ("no moment of inertia".to_string(), "set"),
    };
    let fault = format!("a torque acts on {name} at t = {t:.6} s, but {name} has {has}");
    let joined = |item: &&crate::model::ConstraintItem| item.bodies.contains(&body);
    let joints = model.constraints.iter().filter(joined);
    let others = joints.flat_map(|item| &item.bodies).filter(|k| **k != body && !k.is_ground());
    let lightest = others.min_by(|a, b| model.bodies[a.0].mass.total_cmp(&model.bodies[b.0].mass));
    match lightest.map(|k| &model.bodies[k.0]) {
        Some(other) => format!(
            "{fault} and {} (mass {:.1e} kg), to which it is joined, hardly resists its rotation; {set} the inertia of \
             {name}, or increase the mass of {}",
            other.name, other.mass, other.name
        ),
        None => format!("{fault} and no joint prevents its rotation; {set} its inertia"),
    }
}
