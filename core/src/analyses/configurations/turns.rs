//! Other whole turns of bodies whose angles are coupled.
//!
//! A coupling of angles, such as 1:2, distinguishes whole turns: if a body has turned once more in the same position,
//! the bodies coupled to it are at other positions.

use super::found::Positions;
use crate::analyses::assemble::Targets;
use crate::analyses::closing::{Closing, Halt};
use crate::elements::{Group, QuantityKind};
use crate::math::{each, Listed};
use crate::model::{ConstraintItem, Model};
use std::f64::consts::TAU;

/// Largest rounding error of a linear equation.
const LINEAR: f64 = 1e-12;

/// Whether a constraint distinguishes whole turns.
fn counts(item: &ConstraintItem) -> bool {
    let [equation] = &item.equations[..] else { return false };
    item.group == Group::Joints && equation.kind == QuantityKind::Angle
}

/// The columns of the angles for which such constraints distinguish whole turns.
fn counted(model: &Model) -> Vec<usize> {
    let bodies = model.constraints.iter().filter(|item| counts(item)).flat_map(|item| &item.bodies);
    let columns = bodies.map(|body| model.layout.bodies[body.0]).filter(|body| body.count == 3);
    let mut angles: Vec<usize> = columns.map(|body| body.first + 2).list();
    angles.sort_unstable();
    angles.dedup();
    angles
}

/// Sets targets for the angles that follow from given angles by couplings, including whole turns. Returns whether
/// this determines all counted angles. Then no body can have turned once more.
pub(super) fn follow(model: &Model, closing: &Closing<'_>, targets: &mut Targets) -> bool {
    let rows = model.constraints.iter().zip(&model.layout.constraints);
    let counting: Vec<_> = rows.filter(|(item, _)| counts(item)).list();
    for _ in 0..counting.len() {
        for (item, slots) in &counting {
            let mut open = item
                .bodies
                .iter()
                .filter(|body| !body.is_ground() && targets.hard[body.0][2].is_none());
            let (Some(body), None) = (open.next(), open.next()) else { continue };
            if let Some(angle) = solved(model, closing, targets, slots.rows.start) {
                targets.hard[body.0][2] = Some(angle);
            }
        }
    }
    let bodies = counting.iter().flat_map(|(item, _)| &item.bodies);
    let mut moving = bodies.filter(|body| !body.is_ground());
    moving.all(|body| targets.hard[body.0][2].is_some())
}

/// The only angle of an equation that has no target, solved from the equation. None if the equation is not linear in
/// it, or depends on positions.
fn solved(model: &Model, closing: &Closing<'_>, targets: &Targets, row: usize) -> Option<f64> {
    let residual = |angle: f64, place: f64| {
        let mut q = vec![place; model.layout.n_q];
        for (columns, hard) in model.layout.bodies.iter().zip(&targets.hard) {
            let turning = columns.range().nth(2);
            turning.into_iter().for_each(|column| q[column] = hard[2].unwrap_or(angle));
        }
        closing.phi(&q)[row]
    };
    let [at, next, far, elsewhere] =
        each([(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (0.0, 1.0)], |(a, p)| residual(a, p));
    let slope = next - at;
    let alike = |x: f64, y: f64| (x - y).abs() <= LINEAR * (at.abs() + slope.abs());
    (slope != 0.0 && alike(far - next, slope) && alike(at, elsewhere)).then(|| -at / slope)
}

/// Adds the positions that follow from all positions found by whole turns of these bodies.
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
