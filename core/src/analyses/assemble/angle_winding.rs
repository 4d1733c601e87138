//! Whole turns: the choice among angles that differ by multiples of 2π.
//!
//! A closed position first gets the turns nearest to the guesses; without one, within half a turn of a neighbour.
//!
//! A guess or `set` fixes the whole turns of its body, and of all bodies whose relative angles are fixed by slides.
//! The turns of wheels that roll on each other are also fixed, because a whole turn of one wheel moves the others.
//! For the other bodies, each torsional spring is relaxed as far as whole turns allow, in the order of the file.

use super::holding::extended;
use super::request::Request;
use super::target::of_positions;
use super::targets::{nearest_turn, Targets};
use crate::analyses::closing::Closing;
use crate::elements::{BodyId, Fixes, Group, QuantityKind};
use crate::equations::constraints;
use crate::equations::kinematics::Motions;
use crate::math::{each, Listed};
use crate::model::{row_scales, ConstraintItem, Model};
use std::collections::VecDeque;
use std::f64::consts::{PI, TAU};

/// Largest scaled residual of a position after whole turns.
const CLOSED: f64 = 1e-9;

/// Chooses the whole turns of the bodies at a closed position. Returns warnings.
pub(super) fn choose(
    model: &Model,
    closing: &Closing<'_>,
    request: &Request,
    targets: &Targets,
    q: &mut Vec<f64>,
) -> Vec<String> {
    if !request.from_guess {
        settle(closing, request, targets, q);
    }
    relax(model, targets, q)
}

/// Shifts free angles of `q` by whole turns. Returns a warning for each spring that remains beyond half a turn.
fn relax(model: &Model, targets: &Targets, q: &mut [f64]) -> Vec<String> {
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

/// Turns bodies of a closed position by whole turns: guessed angles to within half a turn of their guesses, and other
/// angles to within half a turn of a neighbour. Without guesses, angles within half a turn of zero remain.
fn settle(closing: &Closing<'_>, request: &Request, targets: &Targets, q: &mut Vec<f64>) {
    let model = closing.model();
    let group = turning_together(model);
    let mut members = vec![Vec::new(); group.len()];
    group.iter().enumerate().for_each(|(b, of)| members[*of].push(b));
    let turns = WholeTurns { closing, group, members };
    let guessed = of_positions(&request.guess).next().is_some();
    if guessed {
        turns.meet(&extended(model, of_positions(&request.guess)), q);
    }
    turns.follow(targets, guessed, q);
}

/// The whole turns of the bodies of a closed position.
struct WholeTurns<'c, 'm> {
    closing: &'c Closing<'m>,
    /// For each body, the first of those that turn with it, and for each first body all of them.
    group: Vec<usize>,
    members: Vec<Vec<usize>>,
}

impl WholeTurns<'_, '_> {
    fn angle(&self, q: &[f64], body: usize) -> Option<f64> {
        let columns = self.closing.model().layout.bodies[body];
        match body {
            0 => Some(0.0),
            _ => (columns.count == 3).then(|| q[columns.first + 2]),
        }
    }

    /// Turns a body, and the bodies that turn with it, if the mechanism remains closed.
    fn turn(&self, q: &mut Vec<f64>, body: usize, turns: f64) -> bool {
        let model = self.closing.model();
        let mut turned = q.clone();
        for b in &self.members[self.group[body]] {
            let columns = model.layout.bodies[*b];
            if columns.count == 3 {
                turned[columns.first + 2] += TAU * turns;
            }
        }
        let scaled = self.closing.phi(&turned).into_iter().zip(row_scales(model));
        let closed = scaled.map(|(phi, scale)| phi.abs() / scale).all(|gap| gap <= CLOSED);
        let possible = self.group[body] != self.group[0] && closed;
        if possible {
            *q = turned;
        }
        possible
    }

    /// Turns bodies so that guessed angles are within half a turn of their guesses, for which `leading` has drivers.
    fn meet(&self, leading: &Model, q: &mut Vec<f64>) {
        let towards = Closing::new(leading, self.closing.time(), self.closing.stop());
        let guesses = leading.constraints.iter().zip(&leading.layout.constraints);
        for (item, slots) in guesses.skip(self.closing.model().constraints.len()) {
            let ([i, j], [equation]) = (&item.bodies[..], &item.equations[..]) else { continue };
            let turns = (towards.phi(q)[slots.rows.start] / TAU).round();
            if equation.kind == QuantityKind::Angle && turns.is_finite() && turns != 0.0 {
                let _ = self.turn(q, j.0, -turns) || self.turn(q, i.0, turns);
            }
        }
    }

    /// Turns the bodies without a target for their turn to within half a turn of a neighbour, from ground outwards. If
    /// nothing was `guessed`, zero counts as a neighbour.
    fn follow(&self, targets: &Targets, guessed: bool, q: &mut Vec<f64>) {
        let Self { closing, group, members } = self;
        let neighbours = neighbours(closing.model());
        let mut settled = vec![false; group.len()];
        settled[group[0]] = true;
        for (b, _) in targets.turn.iter().enumerate().filter(|(_, turn)| **turn) {
            settled[group[b]] = true;
        }
        let mut queue: VecDeque<usize> = (0..group.len()).filter(|b| settled[group[*b]]).collect();
        while let Some(placed) = queue.pop_front() {
            for body in &neighbours[placed] {
                let all = &members[group[*body]];
                if std::mem::replace(&mut settled[group[*body]], true) {
                    continue;
                }
                queue.extend(all);
                let links = all.iter().flat_map(|b| neighbours[*b].iter().map(move |to| (*b, *to)));
                let known =
                    links.filter(|(_, to)| settled[group[*to]] && group[*to] != group[*body]);
                let zero = all.iter().filter(|_| !guessed).map(|b| (*b, 0));
                let apart = known
                    .chain(zero)
                    .filter_map(|(b, to)| Some(self.angle(q, b)? - self.angle(q, to)?))
                    .list();
                let near = apart.iter().any(|apart| apart.abs() <= PI * (1.0 + 1e-9));
                let turns = apart.first().map_or(0.0, |apart| (apart / TAU).round());
                if !near && turns.is_finite() {
                    self.turn(q, *body, -turns);
                }
            }
        }
    }
}

/// The bodies that joints connect to each body.
fn neighbours(model: &Model) -> Vec<Vec<usize>> {
    let mut neighbours = vec![Vec::new(); model.bodies.len()];
    for item in model.constraints.iter().filter(|item| item.group == Group::Joints) {
        for (a, b) in item.bodies.iter().flat_map(|a| item.bodies.iter().map(move |b| (a.0, b.0))) {
            neighbours[a].extend((a != b).then_some(b));
        }
    }
    neighbours
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
