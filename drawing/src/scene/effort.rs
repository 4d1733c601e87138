//! Forces, torques and speeds of elements that are drawn as arrows.

use crate::plane::At;
use kempe::elements::{Mark, SceneSymbol};
use kempe::equations::actions::each_action;
use kempe::equations::forces::Acting;
use kempe::equations::kinematics::Motions;
use kempe::math::Local;
use kempe::{Model, State};

/// The force and torque that an element exerts on its body j at the instants of a scene; for a driver, the velocity and
/// the angular velocity of body j relative to body i at the point on j. They give the arrow its direction.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Effort {
    /// The name of the element.
    pub element: String,
    /// Force, N, or velocity, m/s, in the global frame.
    pub force: Vec<At>,
    /// Torque about the point of the force, N·m, or angular velocity, rad/s.
    pub torque: Vec<f64>,
}

/// The efforts of all elements that a scene shows as arrows.
///
/// The efforts follow from the laws at the states, without reactions.
pub fn efforts(model: &Model, states: &[State]) -> Vec<Effort> {
    let mut found = Vec::new();
    for (name, symbols) in model.symbols() {
        let Some(symbol) = symbols.iter().find(|one| is_arrow(one.mark)) else { continue };
        let mut effort = Effort { element: name.to_string(), ..Effort::default() };
        let mut motions = Motions::new(&model.layout);
        for state in states {
            motions.place(&model.layout, &state.q, &state.v);
            let (force, torque) = match model.force(name) {
                Some(k) => acted(model, k, symbol, &motions, state),
                None => driven(symbol, &motions),
            };
            effort.force.push(force);
            effort.torque.push(torque);
        }
        found.push(effort);
    }
    found
}

/// The force and torque of an element on body j.
fn acted(
    model: &Model,
    k: usize,
    symbol: &SceneSymbol,
    motions: &Motions,
    state: &State,
) -> (At, f64) {
    let acting = Acting { z: &state.z, lam: None, t: state.t };
    let (mut force, mut torque) = ([0.0; 2], 0.0);
    each_action(model, k, motions, acting, |_, body, wrench| {
        if body == symbol.j.body {
            force = [force[0] + wrench.force.x, force[1] + wrench.force.y];
            torque += wrench.torque;
        }
    });
    (force, torque)
}

/// The velocity and the angular velocity of body j relative to body i, at the point on j.
fn driven(symbol: &SceneSymbol, motions: &Motions) -> (At, f64) {
    let [i, j] = [&symbol.i, &symbol.j].map(|end| motions[end.body.0]);
    let s = symbol.j.point.unwrap_or_else(Local::zero);
    let lever = j.pose.point(s) - i.pose.r;
    let of_i = i.twist.velocity + lever.perp().scale(i.twist.omega);
    let apart = j.point_velocity(s) - of_i;
    ([apart.x, apart.y], j.twist.omega - i.twist.omega)
}

fn is_arrow(mark: Mark) -> bool {
    matches!(mark, Mark::ForceArrow | Mark::TorqueArrow | Mark::DriveTurn | Mark::DriveShift)
}
