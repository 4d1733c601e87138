//! Starts of Newton's method, and circuits through the positions found.

use super::found::Positions;
use crate::analyses::assemble::{following, place, wind, Targets};
use crate::analyses::closing::{Closing, Halt};
use crate::analyses::kinematics::circuit;
use crate::elements::{holding, Group, QuantityKind};
use crate::equations::position;
use crate::expression::Tape;
use crate::math::Listed;
use crate::model::Model;
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

/// Largest number of placements from which Newton's method starts, and largest number of starts with arbitrary
/// angles.
const PLACEMENTS: usize = 128;
const STARTS: usize = 300;
/// The search ends after this number of consecutive starts without a new position.
const IDLE: usize = 60;

/// Adds the positions that are found from starts and along circuits.
pub(super) fn search(model: &Model, t: f64, found: &mut Positions<'_>, stop: Halt<'_>) {
    let mut closing = Closing::new(model, t, stop);
    let mut next = 0;
    let mut try_from = |mut q: Vec<f64>, found: &mut Positions<'_>| {
        wind(model, t, &mut q);
        let closes = q.iter().all(|x| x.is_finite()) && closing.close(&mut q).1;
        closes && found.add(q)
    };
    let mut targets = Targets::of(model, t);
    targets.every_solution = true;
    let mut choices = Some(Vec::new());
    for _ in 0..PLACEMENTS {
        let Some(taken) = choices.take().filter(|_| !stop() && !found.is_full()) else { break };
        let placement = place(model, &targets, &taken);
        choices = following(taken, &placement);
        try_from(placement.q, found);
    }
    follow_new(model, t, found, &mut next, stop);
    let mut idle = 0;
    for start in 0..STARTS {
        if idle == IDLE || stop() || found.is_full() {
            return;
        }
        for (body, soft) in targets.soft.iter_mut().enumerate() {
            *soft = [None, None, Some(TAU * arbitrary(start, body) - PI)];
        }
        idle = if try_from(place(model, &targets, &[]).q, found) { 0 } else { idle + 1 };
        if idle == 0 {
            follow_new(model, t, found, &mut next, stop);
        }
    }
}

/// A fixed number in [0, 1) without a pattern.
fn arbitrary(start: usize, body: usize) -> f64 {
    (12.9898 * (start as f64 + 1.0) + 78.233 * (body as f64 + 1.0))
        .sin()
        .mul_add(43_758.545_3, 0.0)
        .rem_euclid(1.0)
}

/// Follows the circuits of all positions from index `next` on.
fn follow_new(model: &Model, t: f64, found: &mut Positions<'_>, next: &mut usize, stop: Halt<'_>) {
    let mut closing = Closing::new(model, t, stop);
    while *next < found.positions.len() {
        let q = found.positions[*next].clone();
        *next += 1;
        for driver in drivers(model) {
            if stop() || found.is_full() {
                return;
            }
            let (moving, turns) = moving(model, t, &q, driver);
            for mut there in circuit(&moving, t, &q, turns) {
                wind(model, t, &mut there);
                if closing.close(&mut there).1 {
                    found.add(there);
                }
            }
        }
    }
}

/// The drivers that may be moved. Empty if a joint follows a law of time, which would move with them.
fn drivers(model: &Model) -> Vec<usize> {
    let joint = |item: &crate::model::ConstraintItem| item.group == Group::Joints && item.driven;
    if model.constraints.iter().any(joint) {
        return Vec::new();
    }
    let items = model.constraints.iter().enumerate();
    items.filter(|(_, item)| item.element.drives().is_some()).map(|(k, _)| k).list()
}

/// The model in which the value of one driver grows with t and the other drivers keep their values; also whether this
/// value is an angle.
fn moving(model: &Model, t: f64, q: &[f64], driver: usize) -> (Model, bool) {
    let mut blueprint = (*model.blueprint).clone();
    for (k, (_, _, constraint)) in Arc::make_mut(&mut blueprint.constraints).iter_mut().enumerate()
    {
        let Some(of) = constraint.drives().cloned() else { continue };
        let rate = if k == driver { 1.0 } else { 0.0 };
        let now = position(model, &of, t, q);
        *constraint = holding(of, Tape::line(now, rate, t));
    }
    let turns = model.constraints[driver]
        .equations
        .iter()
        .all(|equation| equation.kind == QuantityKind::Angle);
    (Model::new(&Arc::new(blueprint), &model.parameters), turns)
}
