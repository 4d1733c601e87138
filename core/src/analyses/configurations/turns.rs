//! Other whole turns of bodies whose angles a coupling counts.
//!
//! A coupling of angles, such as 1:2, counts whole turns: where a body may have turned once more in the same position,
//! the bodies coupled to it are elsewhere.

use super::found::Positions;
use crate::analyses::closing::{Closing, Halt};
use crate::elements::Group;
use crate::model::{ConstraintItem, Model};
use std::f64::consts::TAU;

/// Whether a constraint counts whole turns.
fn counts(item: &ConstraintItem) -> bool {
    let [equation] = &item.equations[..] else { return false };
    item.group == Group::Joints && equation.unit == "rad"
}

/// The columns of the angles that such constraints count.
pub(super) fn counted(model: &Model) -> Vec<usize> {
    let bodies = model.constraints.iter().filter(|item| counts(item)).flat_map(|item| &item.bodies);
    let columns = bodies.map(|body| model.layout.bodies[body.0]).filter(|body| body.count == 3);
    let mut angles: Vec<usize> = columns.map(|body| body.first + 2).collect();
    angles.sort_unstable();
    angles.dedup();
    angles
}

/// Adds the positions that whole turns of each such body lead to, from all positions found.
pub(super) fn turn(model: &Model, t: f64, found: &mut Positions<'_>, stop: Halt<'_>) {
    let mut closing = Closing::new(model, t, stop);
    let angles = counted(model);
    let mut next = 0;
    while next < found.positions.len() && !found.is_full() {
        for angle in &angles {
            for way in [TAU, -TAU] {
                let mut q = found.positions[next].clone();
                q[*angle] += way;
                if !stop() && closing.close(&mut q).1 {
                    found.add(q);
                }
            }
        }
        next += 1;
    }
}
