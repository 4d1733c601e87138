//! Failures of assembly, in terms of the mechanism.

use super::culprits::OpenGroup;
use super::openings::Openings;
use super::placement::DyadGap;
use super::request::Request;
use super::target::{of_motion, of_rates, trimmed, Target};
use crate::analyses::closing::Closing;
use crate::analyses::diagnosis::{remedies, Remedy};
use crate::analyses::required::Unmet;
use crate::analyses::{Dependent, Mobility};
use crate::elements::{Attachment, BodyId, Fixes, Group, QuantityKind};
use crate::equations::kinematics::Motions;
use crate::equations::{at, constraints};
use crate::expression::TABLE_ENDS;
use crate::math::{each, Listed, ShortArray};
use crate::model::{listed, shown, ConstraintItem, Model, MOST_REPORTED};
use std::collections::VecDeque;
use std::fmt;

/// The kind of fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// The requested positions cannot be reached.
    Open,
    /// The requested rates contradict each other or the constraints.
    Rates,
    /// Constraints are redundant.
    Redundant,
    /// The assembly was ended early.
    Stopped,
}

/// An assembly that failed.
#[derive(Clone, Debug, PartialEq)]
pub struct Failure {
    /// The kind of fault.
    pub fault: Fault,
    /// The joint or driver with the largest error.
    pub name: String,
    /// The gap that remains at this joint or driver or in its loop, m; zero for faults without a gap.
    pub gap: f64,
    /// Description of the fault.
    pub message: String,
    /// Remedy.
    pub hint: String,
    /// The paths, in a file, of the drivers and values that contradict each other.
    pub places: Vec<Vec<String>>,
}

impl Failure {
    /// A mechanism that stays open at a joint or driver.
    pub(super) fn open(name: &str, gap: f64, message: String, hint: impl Into<String>) -> Self {
        let (name, hint) = (name.to_string(), hint.into());
        Self { fault: Fault::Open, name, gap, message, hint, places: Vec::new() }
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}; {}", self.message, self.hint)
    }
}

/// Failure of a loop that does not close. `starts` are positions with small gaps, and the placements from which they
/// were reached.
pub(super) fn open(
    model: &Model,
    request: &Request,
    closing: &Closing<'_>,
    starts: &[Vec<f64>],
    gaps: &[DyadGap],
) -> Failure {
    let all = (0..model.constraints.len()).list();
    let found = OpenGroup::among(model, request.t, starts, &all, closing.stop());
    let OpenGroup { constraints, q } =
        found.unwrap_or_else(|| OpenGroup { constraints: all, q: starts[0].clone() });
    // a placement may miss a sound dyad, because of its other choices
    match gaps.iter().find(|gap| constraints.contains(&gap.joint)) {
        Some(gap) => dyad_open(model, request, gap),
        None => stays_open(model, request, &closing.phi(&q), &constraints),
    }
}

/// Failure of a constraint whose law has no finite value or derivative at a position.
pub(super) fn undefined(model: &Model, t: f64, q: &[f64]) -> Option<Failure> {
    if !q.iter().all(|q| q.is_finite()) {
        return None; // the position is the fault, not a law
    }
    let motions = Motions::at_rest(&model.layout, q);
    let [phi, rate, _] = constraints::terms_at(model, &motions, t);
    let mut slope = vec![0.0; phi.len()];
    let mut entries = vec![0.0; model.layout.n_entries];
    constraints::jacobian(model, &motions, t, &mut entries);
    for (row, _, at) in model.layout.positions() {
        slope[row] += entries[at].abs();
    }
    slope.iter_mut().zip(&rate).for_each(|(slope, rate)| *slope += rate.abs());
    let lacks = |values: &[f64], what| {
        let row = values.iter().position(|x| !x.is_finite())?;
        Some((&model.constraints[model.layout.owner(row).0], what))
    };
    let (item, what) = lacks(&phi, "value").or_else(|| lacks(&slope, "derivative"))?;
    let (kind, name) = (item.group.singular(), &item.name);
    if let Some(table) = refusal(model, item, &motions, t) {
        let message = format!("the law of {kind} {name} has no value at t = {t} s: {table}");
        return Some(Failure::open(name, 0.0, message, TABLE_ENDS));
    }
    let message = format!("the law of {kind} {name} has no finite {what} at t = {t} s");
    let hint = "change the law, or start at a time and position where it has one";
    Some(Failure::open(name, 0.0, message, hint))
}

/// The failure of a mechanism with rigid beams.
pub(super) fn of_rigid(failure: Failure) -> Box<Failure> {
    let hint = match failure.fault {
        Fault::Open => format!(
            "{}; beams start unbent: to bend one by its joints, start where the mechanism closes with rigid \
             beams, and move a point by a driver",
            failure.hint
        ),
        _ => failure.hint.clone(),
    };
    Box::new(Failure { hint, ..failure })
}

/// The table that a law evaluates outside its range.
fn refusal(model: &Model, item: &ConstraintItem, motions: &Motions, t: f64) -> Option<String> {
    let values = at(&model.parameters, motions, &[], t);
    let mut found = None;
    item.law.as_ref()?.visit(&mut |tape| found = found.take().or_else(|| tape.refusal(&values)));
    found
}

/// Failure of a contact beyond the end of its curve.
pub(super) fn off_the_curve((name, message): (String, String)) -> Failure {
    let hint = "extend the range of the curve, or give a guess of the contact on it";
    Failure::open(&name, 0.0, message, hint)
}

fn dyad_open(model: &Model, request: &Request, gap: &DyadGap) -> Failure {
    let joint = shown(&model.constraints[gap.joint].name);
    let [a, b] = gap.bodies.each(|k| model.bodies[k].name.as_str());
    let missing = gap.missing.abs();
    let length = length(missing);
    let (fault, hint) = if gap.missing > 0.0 {
        (
            format!("the links are short by {length} at joint {joint}"),
            format!("lengthen {a} or {b}, or bring the pins that carry them nearer"),
        )
    } else {
        (
            format!("one link is too long for the other by {length} at joint {joint}"),
            format!(
                "make the lengths of {a} and {b} more equal, or move the pins that carry them apart"
            ),
        )
    };
    let all = (0..model.constraints.len()).list();
    let loop_ = loop_through(model, gap.joint, &all).unwrap_or_else(|| format!("{a}-{b}"));
    let set = asked(model, of_motion(&request.set));
    let change = if set.is_empty() { String::new() } else { ", or change what is set".to_string() };
    let message = format!("the loop {loop_} cannot close: {set}{fault}");
    Failure::open(joint, missing, message, format!("{hint}{change}"))
}

fn stays_open(model: &Model, request: &Request, phi: &[f64], group: &[usize]) -> Failure {
    let open = Openings::of(model, phi, group.iter().copied()).expect("a joint that is open");
    let (worst, missed) = open.worst;
    let name = shown(&model.constraints[worst].name);
    // if a driver or a set coordinate has the largest error, the constraints contradict each other
    let joint = model.constraints[worst].group == Group::Joints;
    let around = match loop_through(model, worst, group).filter(|_| joint) {
        Some(loop_) => format!("the loop {loop_}"),
        None => "the mechanism".to_string(),
    };
    let set = asked(model, of_motion(&request.set));
    let message = if open.kind == QuantityKind::Length {
        let gap = length(open.total);
        format!("{around} cannot close: {set}the joints stay open by {gap} in all, most at joint {name}")
    } else {
        let (missed, unit) = (trimmed(missed, 3), open.kind.unit());
        format!("{around} cannot close: {set}{name} would have to change by {missed} {unit}")
    };
    let gap = if open.kind == QuantityKind::Length { open.total } else { 0.0 };
    let hint = "give a guess nearer to the position meant, change what is set, or change lengths";
    Failure::open(name, gap, message, hint)
}

/// The text "with crank.angle = 70° ", or an empty text.
fn asked<'a>(model: &Model, set: impl Iterator<Item = &'a Target>) -> String {
    let all: Vec<String> = set.map(|target| target.written(model)).list();
    match all.is_empty() {
        true => String::new(),
        false => format!("with {} ", listed(&all.iter().map(String::as_str).list())),
    }
}

/// A length in m, written with three decimals in a suitable unit.
pub(super) fn length(x: f64) -> String {
    let units = [("m", 1.0, 0.1), ("mm", 1e3, 1e-4), ("µm", 1e6, 1e-7), ("nm", 1e9, 1e-10)];
    match units.into_iter().find(|(.., least)| x >= *least) {
        Some((unit, factor, _)) => format!("{:.3} {unit}", x * factor),
        None => format!("{x:.3e} m"),
    }
}

/// Largest number of joints of a loop that a message names.
const MOST_IN_LOOP: usize = 20;

/// Names of the joints around the shortest loop through a joint, of constraints in `group`, starting with the first in
/// the file.
fn loop_through(model: &Model, joint: usize, group: &[usize]) -> Option<String> {
    let [from, to] = ends(&model.constraints[joint]);
    let mut neighbours: Vec<Vec<(usize, usize)>> = vec![Vec::new(); model.bodies.len()];
    for (k, item) in group.iter().map(|k| (*k, &model.constraints[*k])) {
        let [i, j] = ends(item);
        if k != joint && item.group != Group::Drivers && i != j {
            neighbours[i].push((k, j));
            neighbours[j].push((k, i));
        }
    }
    let mut via: Vec<Option<(usize, usize)>> = vec![None; model.bodies.len()];
    let mut queue = VecDeque::from([to]);
    while let Some(body) = queue.pop_front() {
        for &(k, next) in &neighbours[body] {
            if next != to && via[next].is_none() {
                via[next] = Some((k, body));
                queue.push_back(next);
            }
        }
    }
    let mut loop_ = vec![joint];
    let mut body = from;
    while body != to {
        let (k, next) = via[body]?;
        loop_.push(k);
        body = next;
    }
    let first = loop_.iter().enumerate().min_by_key(|(_, k)| **k).map_or(0, |(at, _)| at);
    loop_.rotate_left(first);
    if loop_.len() > 2 && loop_[1] > loop_[loop_.len() - 1] {
        loop_[1..].reverse();
    }
    let names = model.names_of(&loop_);
    // a long loop is shortened in its middle
    Some(match names.len() {
        0..=MOST_IN_LOOP => names.join("-"),
        n => format!(
            "{}-…-{}",
            names[..MOST_IN_LOOP / 2].join("-"),
            names[n - MOST_IN_LOOP / 2..].join("-")
        ),
    })
}

/// Bodies i and j of a constraint; ground twice for a constraint on time alone.
fn ends(item: &ConstraintItem) -> [usize; 2] {
    let last = item.bodies.len().saturating_sub(1).min(1);
    each([0, last], |k| item.bodies.get(k).map_or(0, |body| body.0))
}

/// Failure of rates that are set or driven and cannot be reached.
pub(super) fn rates(model: &Model, request: &Request) -> Failure {
    let mut set = of_rates(&request.set);
    let name = set.clone().next().map_or(String::new(), |target| target.name(model));
    let told = asked(model, &mut set);
    let message = format!("{told}the velocities contradict the constraints or each other");
    let hint = "remove a rate that is set, or start at a position that is not singular";
    Failure { fault: Fault::Rates, ..Failure::open(&name, 0.0, message, hint) }
}

/// Failure of a quantity that the mechanism must hold: it has another value, or it is not held.
pub(super) fn unmet(unmet: Unmet) -> Failure {
    Failure::open(&unmet.name, unmet.gap, unmet.message, unmet.hint)
}

/// Failure because the caller ended the assembly.
pub(super) fn stopped() -> Failure {
    let message = "the assembly was stopped".to_string();
    Failure { fault: Fault::Stopped, ..Failure::open("", 0.0, message, "assemble again") }
}

/// Failure because constraints are redundant at a position.
pub(super) fn redundant(model: &Model, t: f64, q: &[f64], mobility: &Mobility) -> Failure {
    let group = mobility.redundant.first().cloned().unwrap_or_default();
    let equations = &mobility.redundant_equations;
    let mut all: Vec<usize> = equations.iter().flat_map(|one| one.group.clone()).list();
    all.sort_unstable();
    all.dedup();
    let names = model.names_of(&all);
    let last = group.last().map_or("", |k| model.constraints[*k].name.as_str());
    let whole = twin(model, &group, mobility);
    let freed = match whole {
        Some(_) => "remove one".to_string(),
        None => freed(model, t, q, equations),
    };
    let message = whole.unwrap_or_else(|| {
        let count = equations.len();
        format!(
            "the constraints {} depend on each other: {count} of their equations add{} nothing",
            listed(&names),
            if count == 1 { "s" } else { "" },
        )
    });
    let hint = format!("{freed}, or pass redundancy='allow'");
    Failure { fault: Fault::Redundant, ..Failure::open(last, 0.0, message, hint) }
}

/// The text "free one of A along x, B along x" for each redundancy.
pub(super) fn freed(model: &Model, t: f64, q: &[f64], equations: &[Dependent]) -> String {
    let first = &equations[..equations.len().min(MOST_REPORTED)];
    let of = |remedies: Vec<Remedy>| {
        let part = remedies.iter().any(|one| one.is_part);
        let all: Vec<String> = remedies.iter().map(ToString::to_string).list();
        let all = listed(&all.iter().map(String::as_str).list());
        format!("{} one of {all}", if part { "free" } else { "remove" })
    };
    remedies(model, t, q, first).into_iter().map(of).list().join("; ")
}

/// The text "joint D2 repeats joint D: both fix point rocker.D to ground".
///
/// None if a part of the second joint is needed.
fn twin(model: &Model, group: &[usize], mobility: &Mobility) -> Option<String> {
    let [first, second] = group else { return None };
    let superfluous = |row: usize| mobility.redundant_equations.iter().any(|one| one.row == row);
    if !model.layout.constraints[*second].rows.clone().all(superfluous) {
        return None;
    }
    let [a, b] = each([*first, *second], |k| &model.constraints[k]);
    let (kind, other) = (a.group.singular(), b.group.singular());
    let mut message = format!("{other} {} repeats {kind} {}", b.name, a.name);
    if [a, b].iter().all(|item| item.element.fixes() == [Fixes::Points]) {
        let end = |item: &ConstraintItem, k: usize| -> (BodyId, Attachment) {
            (item.bodies[k], item.element.attachment(k))
        };
        let (body, at) = end(a, 1);
        let same = |k| end(b, k).0 == body && end(b, k).1.s == at.s;
        let moving = &model.bodies[body.0];
        let point = moving.points.iter().find(|(_, s)| *s == at.s);
        if let (true, Some((point, _))) = (same(0) || same(1), point) {
            let held = &model.bodies[a.bodies[0].0].name;
            message.push_str(&format!(": both fix point {}.{point} to {held}", moving.name));
        }
    }
    Some(message)
}
