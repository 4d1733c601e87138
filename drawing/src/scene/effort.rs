//! Forces and torques of elements that are drawn as arrows.

use crate::plane::At;
use kempe::elements::Mark;
use kempe::equations::actions::each_action;
use kempe::equations::forces::Acting;
use kempe::equations::kinematics::Motions;
use kempe::{Model, State};

/// The force and torque that an element exerts on its body j at the instants of a scene.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Effort {
    /// The name of the element.
    pub element: String,
    /// Force in the global frame, N.
    pub force: Vec<At>,
    /// Torque about the point of the force, N·m.
    pub torque: Vec<f64>,
}

/// The efforts of all elements that a scene shows as arrows.
///
/// The efforts follow from the laws at the states, without reactions.
pub fn efforts(model: &Model, states: &[State]) -> Vec<Effort> {
    let mut found = Vec::new();
    for (name, symbols) in model.symbols() {
        let arrow = symbols.iter().find(|one| is_arrow(one.mark));
        let (Some(symbol), Some(k)) = (arrow, model.force(name)) else { continue };
        let mut effort = Effort { element: name.to_string(), ..Effort::default() };
        let mut motions = Motions::new(&model.layout);
        for state in states {
            motions.place(&model.layout, &state.q, &state.v);
            let acting = Acting { z: &state.z, lam: None, t: state.t };
            let (mut force, mut torque) = ([0.0; 2], 0.0);
            each_action(model, k, &motions, acting, |_, body, wrench| {
                if body == symbol.j.body {
                    force = [force[0] + wrench.force.x, force[1] + wrench.force.y];
                    torque += wrench.torque;
                }
            });
            effort.force.push(force);
            effort.torque.push(torque);
        }
        found.push(effort);
    }
    found
}

fn is_arrow(mark: Mark) -> bool {
    matches!(mark, Mark::ForceArrow | Mark::TorqueArrow)
}
