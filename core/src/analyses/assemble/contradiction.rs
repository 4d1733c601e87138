//! Drivers, driven joints and values of `set` that contradict each other.
//!
//! It is known that the joints alone can be closed. Drivers are added one by one, in the order of the file. The first
//! driver that cannot be met contradicts earlier ones if its row of Φ_q depends on their rows; the left null vector
//! shows which ones. A row that is dependent only at a limit of the motion, such as a dead point, is not a
//! contradiction. Dependence is therefore also checked at a neighbouring position.

use super::culprits::{OpenGroup, MOST_ROWS};
use super::failure::{freed, Failure, Fault};
use super::holding::SET;
use super::openings::Openings;
use super::request::Request;
use super::target::trimmed;
use super::velocities;
use crate::math::Listed;

use crate::analyses::closing::{Closing, Halt};
use crate::analyses::dependence;
use crate::analyses::freedoms::NEARLY;
use crate::analyses::mobility::moved;
use crate::analyses::Dependent;
use crate::elements::QuantityKind;
use crate::equations::constraints;
use crate::equations::kinematics::Motions;
use crate::model::{is_weld, listed, row_scales, shown, Model};
use crate::solve::RANK_TOLERANCE;
use std::sync::Arc;

/// Distance of the neighbouring position, rad.
const NEIGHBOUR: f64 = 0.02;
/// Largest relative residual of velocities that are compatible.
pub(super) const AGREE: f64 = 1e-8;

/// A driven constraint that cannot be met together with others.
struct Contradiction {
    /// The constraints that hold, ascending.
    met: Vec<usize>,
    /// The constraint that then does not hold.
    missed: usize,
    by: (f64, QuantityKind),
    /// Order of the derivative in time: 0 for positions, 1 for rates, 2 for accelerations.
    order: usize,
}

/// The driven constraints, and all others.
fn parts(model: &Model) -> Option<[Vec<usize>; 2]> {
    let own = |k: &usize| model.layout.constraints[*k].own.count > 0;
    let driven = |k: &usize| model.constraints[*k].driven && !own(k);
    let (driven, rest): (Vec<usize>, Vec<usize>) =
        (0..model.constraints.len()).partition(|k| driven(k));
    (!driven.is_empty() && model.layout.n_rows <= MOST_ROWS).then_some([driven, rest])
}

/// The model with only some of its constraints.
fn keeping(model: &Model, kept: &[usize]) -> Model {
    Model::new(&Arc::new(model.blueprint.keeping(kept)), &model.parameters)
}

/// The constraints in `met` on whose rows the row of constraint `last` depends. None if it is independent.
fn dependent(
    model: &Model,
    t: f64,
    q: &[f64],
    (met, last): (&[usize], usize),
    stop: Halt<'_>,
) -> Option<Vec<usize>> {
    let kept: Vec<usize> = met.iter().copied().chain([last]).list();
    let reduced = keeping(model, &kept);
    let found = dependence::at(&reduced, t, q, RANK_TOLERANCE, stop);
    let of_last =
        found.into_iter().map(|one| one.group).find(|group| group.contains(&(kept.len() - 1)))?;
    let mut others: Vec<usize> = of_last.into_iter().map(|k| kept[k]).list();
    others.retain(|k| *k != last);
    others.sort_unstable();
    Some(others)
}

/// Positions that contradict each other in a model with drivers for `set`, if this is the reason that it does not
/// close.
pub(super) fn of_positions(
    model: &Model,
    request: &Request,
    q: &[f64],
    stop: Halt<'_>,
) -> Option<Failure> {
    let t = request.t;
    let [driven, rest] = parts(model).filter(|_| q.len() == model.layout.n_q)?;
    let rows = |k: &usize| model.layout.constraints[*k].rows.clone();
    let close = |q: &[f64], open: &[usize]| {
        let rows: Vec<usize> = open.iter().flat_map(rows).list();
        let mut q = q.to_vec();
        Closing::new(model, t, stop).without(&rows).close(&mut q).1.then_some(q)
    };
    let mut q = close(q, &driven)?;
    for (k, last) in driven.iter().enumerate() {
        if let Some(closed) = close(&q, &driven[k + 1..]) {
            q = closed;
            continue;
        }
        let met: Vec<usize> = rest.iter().chain(&driven[..k]).copied().list();
        let met_there = dependent(model, t, &q, (&met, *last), stop)?;
        let near = close(&moved(model, &q, NEIGHBOUR, 0), &driven[k..]);
        near.map_or(Some(Vec::new()), |near| dependent(model, t, &near, (&met, *last), stop))?;
        let phi = Closing::new(model, t, stop).phi(&q);
        let by = model.constraints[*last].largest(&phi[rows(last)]);
        let found = Contradiction { met: met_there, missed: *last, by, order: 0 };
        return Some(failure(model, request, &found));
    }
    None
}

/// Joints that contradict each other: their equations depend on each other at every position, but their values do not
/// agree.
pub(super) fn of_joints(
    model: &Model,
    t: f64,
    starts: &[Vec<f64>],
    stop: Halt<'_>,
) -> Option<Failure> {
    let q = starts.first()?;
    if model.layout.n_rows > MOST_ROWS || q.len() != model.layout.n_q {
        return None;
    }
    let phi = Closing::new(model, t, stop).phi(q);
    let scales = row_scales(model);
    let here = dependence::at(model, t, q, NEARLY, stop);
    let there = dependence::at(model, t, &moved(model, q, NEIGHBOUR, 0), RANK_TOLERANCE, stop);
    let contradicts = |one: &&Dependent| {
        let parts = one.factors.iter().map(|(row, y)| (y * phi[*row], (y * scales[*row]).abs()));
        let (sum, size) =
            parts.fold((0.0, 0.0), |(sum, size), (a, b)| (sum + a, f64::max(size, b)));
        f64::abs(sum) > AGREE * size && there.iter().any(|other| other.group == one.group)
    };
    // a wrong length elsewhere opens sound joints too
    let alone = |one: &&Dependent| {
        let found = OpenGroup::among(model, t, starts, &one.group, stop);
        found.is_some_and(|found| found.constraints.len() == one.group.len())
    };
    let one = here.iter().filter(contradicts).find(alone)?;
    let name = |k: &usize| shown(&model.constraints[*k].name);
    let mut names: Vec<&str> = one.group.iter().map(name).list();
    names.dedup();
    let names = listed(&names);
    let open = Openings::of(model, &phi, one.group.iter().copied())?;
    let (by, unit, worst) = (trimmed(open.total, 3), open.kind.unit(), name(&open.worst.0));
    let driven = one.group.iter().any(|k| model.constraints[*k].driven);
    let values = if driven { "driven values" } else { "lengths" };
    let freed = freed(model, t, q, std::slice::from_ref(one));
    Some(Failure {
        fault: Fault::Open,
        name: worst.to_string(),
        gap: open.gap(),
        places: one.group.iter().map(|k| place(model, *k)).list(),
        message: format!(
            "{names} contradict each other: they have one equation too many, and stay open by {by} {unit} in all, most at {worst}"
        ),
        hint: format!("correct the {values} or the guess, or {freed}"),
    })
}

/// Rates that contradict each other at a position, in a model with drivers for the rates that are set.
pub(super) fn of_rates(
    model: &Model,
    request: &Request,
    q: &[f64],
    v: &[f64],
    stop: Halt<'_>,
) -> Option<Failure> {
    let t = request.t;
    let [driven, rest] = parts(model)?;
    let agreed = |kept: &[usize]| {
        let (reduced, mut v) = (keeping(model, kept), v.to_vec());
        let left = velocities::project(&reduced, t, q, &mut v);
        (left <= AGREE && v.iter().all(|v| v.is_finite())).then_some(v)
    };
    let mut met = rest;
    let mut v = agreed(&met)?;
    for last in driven {
        met.push(last);
        if let Some(moving) = agreed(&met) {
            v = moving;
            continue;
        }
        met.pop();
        met.sort_unstable();
        let others = dependent(model, t, q, (&met, last), stop)?;
        let [_, rate, _] = constraints::terms_at(model, &Motions::at(&model.layout, q, &v), t);
        let rows = model.layout.constraints[last].rows.clone();
        let by = model.constraints[last].largest(&rate[rows]);
        let found = Contradiction { met: others, missed: last, by, order: 1 };
        return Some(failure(model, request, &found));
    }
    None
}

/// Accelerations that contradict each other, where rows of Φ_q depend on each other: Σ y Φ_q = 0 with Σ y γ ≠ 0.
///
/// `extended` is the model with drivers for the rates that are set.
pub(super) fn of_accelerations(
    [model, extended]: [&Model; 2],
    request: &Request,
    q: &[f64],
    redundant: &[Dependent],
) -> Option<Failure> {
    let is_driven = |k: &&usize| model.constraints[**k].driven;
    let last = |one: &Dependent| one.group.iter().rev().find(is_driven).copied();
    let left_out: Vec<usize> = redundant.iter().filter_map(last).list();
    let kept: Vec<usize> = (0..extended.constraints.len()).filter(|k| !left_out.contains(k)).list();
    let mut v = vec![0.0; q.len()];
    velocities::project(&keeping(extended, &kept), request.t, q, &mut v);
    let motions = Motions::at(&model.layout, q, &v);
    let [_, _, gamma] = constraints::terms_at(model, &motions, request.t);
    let scales = row_scales(model);
    redundant.iter().find_map(|one| {
        let missed = last(one)?;
        // relative to accelerations of one size of the mechanism, or of 1 rad, per s²
        let parts = one.factors.iter().map(|(row, y)| (y * gamma[*row], (y * scales[*row]).abs()));
        let (sum, size) = parts.fold((0.0, 0.0), |(sum, size), (part, scale)| {
            (sum + part, f64::max(size, f64::max(f64::abs(part), scale)))
        });
        let rows = &model.layout.constraints[missed].rows;
        let (row, y) = one.factors.iter().find(|(row, _)| rows.contains(row))?;
        if f64::abs(sum) <= AGREE * size || !f64::is_finite(sum) {
            return None;
        }
        let met = one.group.iter().copied().filter(|k| *k != missed).list();
        let kind = model.constraints[missed].equations[row - rows.start].kind;
        let found = Contradiction { met, missed, by: (f64::abs(sum / y), kind), order: 2 };
        Some(failure(model, request, &found))
    })
}

/// "driver one" or "set crank.angle = 70°".
fn label(model: &Model, request: &Request, k: usize) -> String {
    let item = &model.constraints[k];
    match item.name.strip_prefix(SET) {
        Some(quantity) => format!("{SET}{}", request.written(model, quantity)),
        None if is_weld(&item.name) => format!("beam {}", shown(&item.name)),
        None => format!("{} {}", item.group.singular(), item.name),
    }
}

/// The path of a constraint in a file.
fn place(model: &Model, k: usize) -> Vec<String> {
    let item = &model.constraints[k];
    match item.name.strip_prefix(SET) {
        Some(quantity) => vec!["start".to_string(), "set".to_string(), quantity.to_string()],
        None if is_weld(&item.name) => vec!["bodies".to_string(), shown(&item.name).to_string()],
        None => vec![item.group.section().to_string(), item.name.clone()],
    }
}

fn failure(model: &Model, request: &Request, found: &Contradiction) -> Failure {
    let Contradiction { met, missed, by: (by, kind), order } = found;
    let driven: Vec<usize> = met.iter().filter(|k| model.constraints[**k].driven).copied().list();
    // without another driver, the joints determine the quantity
    let others = if driven.is_empty() { met } else { &driven };
    let mut labels: Vec<String> = others.iter().map(|k| label(model, request, *k)).list();
    labels.dedup();
    let others = listed(&labels.iter().map(String::as_str).list());
    let last = label(model, request, *missed);
    let hold = if labels.len() == 1 { "holds" } else { "hold" };
    let unit = kind.unit();
    let (of, per) = [("", ""), ("the rate of ", "/s"), ("the acceleration of ", "/s²")][*order];
    let missed_by = trimmed(*by, 3);
    let message = format!(
        "{others} and {last} contradict each other: where {others} {hold}, {of}{last} would have to change by {missed_by} {unit}{per}"
    );
    let hint = match driven.is_empty() {
        true => format!("remove {last}: the joints leave it no freedom"),
        false => "remove one of them".to_string(),
    };
    let name = &model.constraints[*missed].name;
    Failure {
        fault: if *order > 0 { Fault::Rates } else { Fault::Open },
        name: name.strip_prefix(SET).unwrap_or(name).to_string(),
        gap: if *order > 0 || *kind != QuantityKind::Length { 0.0 } else { *by },
        places: driven.iter().chain([missed]).map(|k| place(model, *k)).list(),
        message,
        hint,
    }
}
