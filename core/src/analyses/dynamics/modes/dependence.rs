//! Decides which friction and contacts can hold together, and determines the modes of the others.
//!
//! The equation of a force may depend on other equations. If it depends on the equations of other friction, the
//! friction follows that friction. If joints and drivers alone hold the coordinate of friction, the friction is idle
//! until a driver moves it. If the speed is zero only for a moment, the friction continues to slide.

use super::super::model_cache::ModelCache;
use super::super::redundant_rows::workspace_at;
use super::companions;
use super::place::{drivers_rest, largest, mode_of, scaled, StateAt, NOISE, STILL};
use crate::analyses::mobility::dependent_equations;
use crate::analyses::second_order::mobility;
use crate::elements::{Behaviour, Mode};
use crate::equations::constraints;
use crate::equations::forces::{self, Acting};
use crate::equations::kinematics::Motions;
use crate::equations::leading;
use crate::math::{Listed, Ordered};
use crate::model::{DriverSet, ForceMode, Model};

/// Rate at which friction without its own equation begins to slide, relative to the rates of the mechanism.
const BEGINS: f64 = 1e-6;

/// The modes with some forces held. Friction leads other friction only if its limit is large enough while all hold.
pub(super) fn well_led(
    model: &Model,
    place: &StateAt<'_>,
    free: &[ForceMode],
    left: &[(usize, f64)],
) -> Vec<ForceMode> {
    let (mut left, mut last) = (left.to_vec(), Vec::new());
    loop {
        let modes = with_held(model, place, free, &left);
        let Some(k) = overtaken(model, place, &modes).filter(|k| !last.contains(k)) else {
            return modes;
        };
        last.push(k);
        left.order_by_key(|(of, _)| last.contains(of));
    }
}

/// The modes with some forces held, as far as their equations are independent.
pub(super) fn with_held(
    model: &Model,
    place: &StateAt<'_>,
    free: &[ForceMode],
    left: &[(usize, f64)],
) -> Vec<ForceMode> {
    let mut left = left.to_vec();
    loop {
        let mut modes = free.to_vec();
        let may_hold = |k: usize, of: &[(usize, f64)]| companions::may_hold(model, k, of);
        left = left.iter().copied().filter(|(k, _)| may_hold(*k, &left)).list();
        for own in independent(model, place, free, &left) {
            // at the start of a run, no force has a mode yet
            match modes.iter_mut().find(|of| of.force == own.force) {
                Some(of) => *of = own,
                None => modes.push(own),
            }
        }
        companions::release(model, &mut modes);
        // friction whose contact does not press leads no other friction
        let leads = |k: usize| {
            modes.iter().any(|of| matches!(of.mode, Mode::Follows { leader, .. } if leader == k))
        };
        let ends = |k: usize| leads(k) && !matches!(mode_of(&modes, k), Mode::Holds(_));
        if !left.iter().any(|(k, _)| ends(*k)) {
            return modes;
        }
        left.retain(|(k, _)| !ends(*k));
    }
}

/// The modes of forces that hold together: their equations are independent of each other and of the joints. `free`
/// are the modes with the directions in which friction would slide.
fn independent(
    model: &Model,
    place: &StateAt<'_>,
    free: &[ForceMode],
    candidates: &[(usize, f64)],
) -> Vec<ForceMode> {
    let holds = |(k, side): &(usize, f64)| ForceMode::new(*k, Mode::Holds(*side));
    let all: Vec<ForceMode> = candidates.iter().map(holds).list();
    let [q, ..] = place.state(model);
    let phase = place.phase(model, &all);
    if dependent_equations(&phase, place.t, q, &|| false).is_empty() {
        let row = |own: &ForceMode| phase.forces[own.force].held_row.expect("it holds");
        let with_value =
            |own: &ForceMode| ForceMode { value: value_of(&phase, place, row(own)), ..*own };
        return all.iter().map(with_value).list();
    }
    let mut held: Vec<ForceMode> = Vec::new();
    let mut others: Vec<ForceMode> = Vec::new();
    for own in all {
        let mut tried = held.clone();
        tried.push(own);
        let phase = place.phase(model, &tried);
        let found = dependent_equations(&phase, place.t, q, &|| false);
        let row = phase.forces[own.force].held_row.expect("it holds");
        let last = phase.layout.owner(row).0;
        if found.iter().any(|of| of.group.contains(&last)) {
            others.push(dependent(model, place, &held, (own.force, mode_of(free, own.force))));
        } else {
            let value = value_of(&phase, place, row);
            held.push(ForceMode { value, ..own });
        }
    }
    held.extend(others);
    held
}

/// Contacts that touch and do not push, but that the equations of forces that hold, of joints and of drivers keep
/// closed, are idle: their gaps consist of rounding errors.
pub(super) fn keep_closed(
    model: &Model,
    place: &StateAt<'_>,
    touching: &[usize],
    modes: &mut [ForceMode],
) {
    let holds = |of: &&ForceMode| matches!(of.mode, Mode::Holds(_));
    let held: Vec<ForceMode> = modes.iter().filter(holds).copied().list();
    let rates = place.gap_rates(model, touching);
    for (k, rate) in touching.iter().zip(rates) {
        let Some(own) = modes.iter_mut().find(|of| of.force == *k) else { continue };
        if own.mode != Mode::Free || rate > place.slow(model, *k) {
            continue;
        }
        let mut tried = held.clone();
        tried.push(ForceMode::new(*k, Mode::Holds(place.sides(model, &[*k])[0])));
        let phase = place.phase(model, &tried);
        let found = dependent_equations(&phase, place.t, place.state(model)[0], &|| false);
        let row = phase.forces[*k].held_row.expect("it holds");
        let last = phase.layout.owner(row).0;
        if found.iter().any(|of| of.group.contains(&last)) {
            let slack = place.play(model, *k);
            *own = ForceMode { slack, ..ForceMode::new(*k, Mode::Idle) };
        }
    }
}

/// The value at which a row of a phase is held: the coordinate's value if friction sticks, zero for a contact.
fn value_of(phase: &Model, place: &StateAt<'_>, row: usize) -> f64 {
    let owner = phase.forces.iter().find(|item| item.held_row == Some(row));
    let Some(Behaviour::Sticks) = owner.and_then(|item| item.element.behaviour()) else {
        return 0.0;
    };
    let [q, ..] = place.state(phase);
    let mut residual = vec![0.0; phase.layout.n_rows];
    constraints::residual(phase, &Motions::at_rest(&phase.layout, q), place.t, &mut residual);
    residual[row]
}

/// The mode of a force whose equation depends on forces that hold, on joints and on drivers.
fn dependent(
    model: &Model,
    place: &StateAt<'_>,
    held: &[ForceMode],
    (force, free): (usize, Mode),
) -> ForceMode {
    let of = |mode: Mode, slack: f64| ForceMode { slack, ..ForceMode::new(force, mode) };
    if !matches!(model.forces[force].element.behaviour(), Some(Behaviour::Sticks)) {
        return of(Mode::Idle, 0.0);
    }
    let begins = begins(model, place, held, force);
    if let Some(sign) = passes(model, place, held, (force, free, begins)) {
        return of(Mode::Slides(sign), 0.0);
    }
    match leader(model, place, held, force) {
        Some((leader, sense)) => of(Mode::Follows { leader, sense }, begins),
        None => of(Mode::Idle, begins),
    }
}

/// The speed at which friction without its own equation begins to slide.
pub(super) fn begins(model: &Model, place: &StateAt<'_>, modes: &[ForceMode], force: usize) -> f64 {
    // where nothing moves, at the rate at which drivers no longer stand still
    let rate = (BEGINS * place.rate_scale(&place.phase(model, modes))).max(STILL);
    rate * place.unit(model, force)
}

/// The sticking friction that keeps `force` from sliding, and the sign of the speed after a release.
fn leader(
    model: &Model,
    place: &StateAt<'_>,
    held: &[ForceMode],
    force: usize,
) -> Option<(usize, f64)> {
    let sticks = |k: usize| matches!(model.forces[k].element.behaviour(), Some(Behaviour::Sticks));
    let [q, _, z] = place.state(model);
    let phase = place.phase(model, held);
    let mut workspace = workspace_at((&phase, &ModelCache::default()), place.t, place.state(model));
    let speed = |v: &[f64]| {
        let motions = Motions::at(&model.layout, q, v);
        forces::threshold(model, force, &motions, Acting { z, lam: None, t: place.t })
    };
    let mut found: Option<(f64, usize)> = None;
    for own in held.iter().filter(|own| sticks(own.force)) {
        let mut rates = vec![0.0; phase.layout.n_rows];
        rates[phase.forces[own.force].held_row.expect("it holds")] = 1.0;
        let Ok([dv, _]) = workspace.jump(&phase, place.t, q, &rates) else { continue };
        let ratio = speed(&dv) - speed(&vec![0.0; dv.len()]);
        let counts = ratio.abs() > STILL * largest(&dv);
        if counts && found.is_none_or(|(most, _)| ratio.abs() > most.abs()) {
            found = Some((ratio, own.force));
        }
    }
    found.map(|(ratio, leader)| (leader, ratio.signum()))
}

/// Friction whose limit is too small to lead the friction that follows it. The efforts of the others are not found from
/// its own, so that the friction that leads here carries the effort of all.
fn overtaken(model: &Model, place: &StateAt<'_>, modes: &[ForceMode]) -> Option<usize> {
    let alone = modes.iter().map(|of| match of.mode {
        Mode::Follows { .. } => ForceMode { mode: Mode::Idle, ..*of },
        _ => *of,
    });
    let alone: Vec<ForceMode> = alone.list();
    if alone == modes {
        return None;
    }
    let (alone, phase) = (place.phase(model, &alone), place.phase(model, modes));
    let solved = place.solved(&alone).ok()?;
    let [q, v, z] = place.state(&phase);
    let motions = Motions::at(&phase.layout, q, v);
    let acting = Acting { z, lam: Some(solved.lam()), t: place.t };
    let noise = NOISE * place.force_scale(&alone, Some(&solved));
    let follows = |k: usize| move |of: &&ForceMode| matches!(of.mode, Mode::Follows { leader, .. } if leader == k);
    let is_overtaken = |k: &usize| {
        let Some(beyond) = leading::lead(&phase, *k, &motions, acting, noise) else { return false };
        // without load and limit, one that can push takes the load that comes
        let limit = |k: usize, sense| leading::limit(&phase, k, &motions, acting, sense);
        let pushes = |of: &ForceMode| limit(of.force, 1.0).max(limit(of.force, -1.0)) > noise;
        let idle = limit(*k, 1.0).max(limit(*k, -1.0)) <= noise;
        beyond < 0.0 || idle && modes.iter().filter(follows(*k)).any(pushes)
    };
    (0..phase.forces.len()).find(is_overtaken)
}

/// The direction in which friction whose speed is zero for a moment slides: the speed changes its sign while the mechanism
/// moves, or a driver begins to move it. It is that of the speed or of the acceleration. None if the friction rests.
fn passes(
    model: &Model,
    place: &StateAt<'_>,
    held: &[ForceMode],
    (force, free, begins): (usize, Mode, f64),
) -> Option<f64> {
    let phase = place.phase(model, held);
    let (Mode::Slides(sign), Ok(workspace)) = (free, place.solved(&phase)) else { return None };
    let jet = place.gap_jets(model, &[force], workspace.a())[0];
    // the holding forces may keep the whole mechanism at rest; its accelerations are then rounding errors of the
    // accelerations without these forces
    let free = place.solved(model).map_or(0.0, |free| scaled(model, free.a()));
    // where no force acts, all of them are rounding errors
    let fastest = scaled(&phase, workspace.a()).max(free).max(1.0);
    // the speed of a joint whose drivers stand still is an error
    let [q, ..] = place.state(model);
    let rests = || drivers_rest(model, holders(model, place, force), place.t, q);
    let still = STILL * fastest * place.unit(model, force);
    if sign * jet.rate > still || sign * jet.value > 0.5 * begins && !rests() {
        return Some(sign);
    }
    // the event of another force has come first where the speed changes its sign
    (-sign * jet.rate > still && !rests()).then_some(-sign)
}

/// The drivers that hold the coordinate of a stop or of friction, together with joints.
pub fn holders(model: &Model, place: &StateAt<'_>, force: usize) -> DriverSet {
    if !model.driven {
        return DriverSet::default();
    }
    let [q, ..] = place.state(model);
    let at = |value: f64| {
        place.phase(model, &[ForceMode { value, ..ForceMode::new(force, Mode::Holds(0.0)) }])
    };
    let open = at(0.0);
    let Some(row) = open.forces[force].held_row else { return DriverSet::default() };
    let mut residual = vec![0.0; open.layout.n_rows];
    constraints::residual(&open, &Motions::at_rest(&open.layout, q), place.t, &mut residual);
    let held = at(residual[row]);
    let last = held.layout.owner(row).0;
    held.holders(q, || {
        let found = mobility(&held, place.t, q);
        let group = found.redundant.into_iter().find(|group| group.contains(&last));
        let driven = |k: &usize| model.constraints.get(*k).is_some_and(|item| item.driven);
        DriverSet::of(group.into_iter().flatten().filter(driven))
    })
}

/// The drivers that hold the coordinates of forces with friction.
pub fn holders_of_friction(model: &Model, place: &StateAt<'_>, forces: &[usize]) -> Vec<DriverSet> {
    let sticks = |k: usize| matches!(model.forces[k].element.behaviour(), Some(Behaviour::Sticks));
    let of = |k: &usize| if sticks(*k) { holders(model, place, *k) } else { DriverSet::default() };
    forces.iter().map(of).collect()
}
