//! Whole turns: the choice among angles that differ by multiples of 2π.
//!
//! A guess or `set` fixes the whole turns of its body, and of all bodies whose relative angles are fixed by slides.
//! The turns of wheels that roll on each other are also fixed, because a whole turn of one wheel moves the others.
//! For the other bodies, each torsional spring is relaxed as far as whole turns allow, in the order of the file.

use super::targets::{nearest_turn, Targets};
use crate::elements::{BodyId, Fixes, Group, QuantityKind};
use crate::equations::constraints;
use crate::equations::kinematics::Motions;
use crate::math::{each, Listed};
use crate::model::{ConstraintItem, Model};
use std::f64::consts::{PI, TAU};

/// Shifts free angles of `q` by whole turns. Returns a warning for each spring that remains beyond half a turn.
pub fn relax(model: &Model, targets: &Targets, q: &mut [f64]) -> Vec<String> {
    let group = turning_together(model);
    let mut fixed = vec![false; group.len()];
    fixed[group[0]] = true;
    for (b, turn) in targets.turn.iter().enumerate() {
        fixed[group[b]] |= turn;
    }
    let wheels = model.constraints.iter().filter(|c| c.element.fixes().contains(&Fixes::Turn));
    wheels.flat_map(|c| &c.bodies).for_each(|body| fixed[group[body.0]] = true);
    let mut members = vec![Vec::new(); group.len()];
    group.iter().enumerate().skip(1).for_each(|(b, g)| members[*g].push(model.layout.bodies[b]));
    let mut warnings = Vec::new();
    for item in &model.forces {
        // a law may be infinite at this time
        let finite = item.element.free_angle().filter(|angle| angle.is_finite());
        let Some(free_angle) = finite else { continue };
        let [i, j] = [item.bodies[0], item.bodies[1]];
        let angle = |q: &[f64], b: BodyId| model.layout.bodies[b.0].of(q)[2];
        let stretch = angle(q, j) - angle(q, i) - free_angle;
        let shift = nearest_turn(stretch, 0.0) - stretch;
        let [own, other] = [group[j.0], group[i.0]];
        let (turned, shift) = if fixed[own] { (other, -shift) } else { (own, shift) };
        if !fixed[turned] && own != other {
            let turning = members[turned].iter().filter(|own| own.count == 3);
            turning.for_each(|own| q[own.first + 2] += shift);
        }
        fixed[own] = true;
        fixed[other] = true;
        let stretch = angle(q, j) - angle(q, i) - free_angle;
        if stretch.abs() > PI * (1.0 + 1e-9) {
            warnings.push(format!(
                "spring {} starts {:.4} rad from its free angle, more than half a turn; \
                 the guess or set of its bodies fixes the turn",
                item.name, stretch
            ));
        }
    }
    warnings
}

/// For each body, the first of the bodies whose angles relative to it are fixed by slides.
fn turning_together(model: &Model) -> Vec<usize> {
    let mut group: Vec<usize> = (0..model.bodies.len()).list();
    let turns_together = |item: &&ConstraintItem| item.element.fixes().contains(&Fixes::Direction);
    for item in model.constraints.iter().filter(turns_together) {
        let [a, b] = each([0, 1], |end| root(&mut group, item.bodies[end].0));
        group[a.max(b)] = a.min(b);
    }
    (0..group.len()).map(|b| root(&mut group, b)).list()
}

/// The first body of a group. Shortens the path to it (path halving).
fn root(group: &mut [usize], mut b: usize) -> usize {
    while group[b] != b {
        group[b] = group[group[b]];
        b = group[b];
    }
    b
}

/// Turns bodies by whole turns so that driven relative angles have their prescribed values.
pub(in crate::analyses) fn wind(model: &Model, t: f64, q: &mut [f64]) {
    for (item, slots) in model.constraints.iter().zip(&model.layout.constraints) {
        let ([i, j], [equation]) = (&item.bodies[..], &item.equations[..]) else { continue };
        if item.group != Group::Drivers || equation.kind != QuantityKind::Angle {
            continue;
        }
        let mut phi = vec![0.0; model.layout.n_rows];
        constraints::residual(model, &Motions::at_rest(&model.layout, q), t, &mut phi);
        let turns = TAU * (phi[slots.rows.start] / TAU).round();
        let angle = |body: &BodyId| {
            let columns = model.layout.bodies[body.0];
            (columns.count == 3).then_some(columns.first + 2)
        };
        match (angle(i), angle(j)) {
            _ if !turns.is_finite() || turns == 0.0 => {}
            (_, Some(column)) => q[column] -= turns,
            (Some(column), None) => q[column] += turns,
            (None, None) => {}
        }
    }
}
