//! Contacts that rest and friction that sticks.
//!
//! At first, all contacts that touch without speed and all friction without speed are held. Equations that depend on
//! others are omitted: the friction then follows other friction, and the contact is idle. While a contact pulls or
//! friction exceeds its limit, the force with the largest excess is released.

use super::super::failure::Failure;
use super::companions::{self, contact_of};
use super::dependence::{holders_of_friction, well_led, with_held};
use super::impacts::{self, restitution};
use super::place::{drivers_rest, mode_of, scaled, with_modes, StateAt, NOISE, STILL};
use super::resting_contacts::{resting, together, Tried};
use crate::elements::{Behaviour, Mode};
use crate::equations::forces::{self, Acting};
use crate::equations::kinematics::Motions;
use crate::math::Jet;
use crate::math::{Listed, Ordered};
use crate::model::{ForceMode, Model};

/// Magnitude of a negative reserve that is accepted, as a fraction of the limit.
const ROUNDING: f64 = 1e-11;
/// Fraction of the limit that may remain at the event where the reserve becomes zero, because its time is computed
/// from an interpolant.
const USED_UP: f64 = 1e-6;

/// Height of a flight, as a fraction of the mechanism's size or in rad, below which a contact without losses rests.
const LOW: f64 = 1e-10;
/// Largest number of combinations that are tried.
const MOST_TRIED: usize = 1500;

/// The modes of all forces that have modes. The arguments include the contacts that touch, the largest rate before a
/// jump if the velocities jumped, the forces whose modes ended, and those that have ceased to hold at this time.
pub(super) fn decide(
    model: &Model,
    place: &mut StateAt<'_>,
    before: &[ForceMode],
    (touching, jumped): (&[usize], Option<f64>),
    (fired, ceased): (&[usize], &[usize]),
) -> Result<Vec<ForceMode>, Box<Failure>> {
    let rest = at_rest(model, place, before, touching)?;
    impacts::halt(model, place, &rest)?;
    let all: Vec<usize> = with_modes(model).list();
    let thresholds = place.thresholds(model, &all);
    // after an impact that stops the mechanism, only rounding errors of the speeds remain
    let phase = place.phase(model, before);
    let acceleration = place.largest_acceleration(&phase);
    let rate = place.fastest(&phase).max(acceleration.sqrt()).max(jumped.unwrap_or(0.0));
    let jumped = jumped.is_some();
    let still = Still { rate, acceleration: if jumped { acceleration } else { 0.0 } };
    let holders = holders_of_friction(model, place, &all);
    let (mut modes, mut candidates) = (Vec::new(), Vec::new());
    for ((k, threshold), holders) in all.iter().zip(&thresholds).zip(&holders) {
        if !companions::may_rub(model, place, *k, (before, &rest, fired)) {
            modes.push(companions::open(model, place, *k));
            continue;
        }
        let (free, candidate) = match model.forces[*k].element.behaviour() {
            Some(Behaviour::Sticks) => {
                let rests = drivers_rest(model, *holders, place.t, place.state(model)[0]);
                let still = threshold.abs() <= still.least(model, place, *k) || rests;
                let ended = !jumped && fired.contains(k);
                let old = if jumped { Mode::Open } else { mode_of(before, *k) };
                let direction = match old {
                    Mode::Slides(sign) if ended => -sign,
                    Mode::Slides(sign) => sign,
                    _ if still && !holders.is_empty() => onset(model, place, *k),
                    _ => 1.0_f64.copysign(*threshold),
                };
                (Mode::Slides(direction), still || may_stick(model, place, *k, (old, ended)))
            }
            _ => (Mode::Free, rest.contains(k)),
        };
        candidates.extend(candidate.then_some(*k));
        modes.push(ForceMode::new(*k, free));
    }
    let contact =
        |k: &usize| !matches!(model.forces[*k].element.behaviour(), Some(Behaviour::Sticks));
    // forces whose mode has just ended come last, and friction with a small limit follows that with a large one
    let held = |k: &usize| still_holds(model, place, *k, mode_of(before, *k));
    let ended = |k: &usize| fired.contains(k) && held(k) || !jumped && ceased.contains(k);
    let weak = place.weak(model, &candidates.iter().copied().filter(|k| !contact(k)).list());
    candidates.order_by_key(|k| (weak.contains(k), ended(k), !contact(k), *k));
    let ended: Vec<usize> = candidates.iter().copied().filter(ended).list();
    let mut modes = hold(model, place, modes, (&candidates, &ended))?;
    give_slack(model, place, (before, touching), &mut modes);
    for own in &mut modes {
        let at = all.iter().position(|k| *k == own.force);
        own.held_by = at.map(|at| holders[at]).unwrap_or_default();
    }
    give_speed_slack((model, place), &mut modes, &thresholds, rate);
    Ok(modes)
}

/// The largest rate of a mechanism, 1/s, and its acceleration after a jump, 1/s²; zero if there was none.
struct Still {
    rate: f64,
    acceleration: f64,
}

impl Still {
    /// The speed of sliding that counts as zero. After a jump, sliding that ends within the rounding error of its place would
    /// only rattle.
    fn least(&self, model: &Model, place: &StateAt<'_>, force: usize) -> f64 {
        let unit = place.unit(model, force);
        let brief = (2.0 * self.acceleration * unit * place.rounding(model, force)).sqrt();
        brief.max(STILL * self.rate * unit)
    }
}

/// Whether friction sticks or its sliding has ended.
fn may_stick(model: &Model, place: &StateAt<'_>, force: usize, (old, ended): (Mode, bool)) -> bool {
    still_holds(model, place, force, old) || ended && !old.holds()
}

/// Whether a force that held is still at the edge, corner or line where it did. Elsewhere, the place of a compliant contact
/// is another one, which may have a speed.
fn still_holds(model: &Model, place: &StateAt<'_>, force: usize, old: Mode) -> bool {
    match old {
        Mode::Holds(side) => side == place.sides(model, &[force])[0],
        old => old.holds(),
    }
}

/// The direction in which drivers begin to move friction.
fn onset(model: &Model, place: &StateAt<'_>, force: usize) -> f64 {
    let solved = place.solved(model);
    let rate = solved.map_or(0.0, |now| place.gap_jets(model, &[force], now.a())[0].rate);
    1.0_f64.copysign(rate)
}

/// Sets the slack of contacts that touch and of forces that hold, from the rounding errors of gaps and forces.
fn give_slack(
    model: &Model,
    place: &StateAt<'_>,
    (before, touching): (&[ForceMode], &[usize]),
    modes: &mut [ForceMode],
) {
    let rates = place.gap_rates(model, touching);
    let gaps = place.thresholds(model, touching);
    let phase = place.phase(model, modes);
    let noise = NOISE * place.force_scale(&phase, place.solved(&phase).ok().as_ref());
    for own in modes {
        let at = touching.iter().position(|k| *k == own.force);
        own.slack = match (own.mode, at) {
            (Mode::Free, Some(at)) => {
                let slow = rates[at] <= place.slow(model, own.force);
                let rounding = if slow { place.rounding(model, own.force) } else { 0.0 };
                let depth = (-gaps[at]).max(0.0);
                match before.iter().find(|of| of.force == own.force) {
                    // bounces must not become deeper
                    Some(old) if old.mode == Mode::Free && slow => {
                        depth.max(rounding).max(old.slack)
                    }
                    // a gap that was held is not exactly zero
                    _ => depth + rounding,
                }
            }
            (Mode::Holds(_), _) => noise,
            (Mode::Idle, Some(_)) => place.play(model, own.force),
            _ => own.slack,
        };
    }
}

/// Sets the slack of friction that begins to slide, for speeds that are small beside the rate of the mechanism.
fn give_speed_slack(
    (model, place): (&Model, &StateAt<'_>),
    modes: &mut [ForceMode],
    thresholds: &[f64],
    rate: f64,
) {
    for (own, threshold) in modes.iter_mut().zip(thresholds) {
        let Mode::Slides(sign) = own.mode else { continue };
        let speed = rate * place.unit(model, own.force);
        if sign * threshold <= STILL * speed {
            // a speed that counts as zero may have the opposite direction, and at rest it consists of rounding errors
            own.slack = own.slack.max(-2.0 * sign * threshold).max(NOISE * speed);
        }
    }
}

/// The contacts that touch without speed, or whose next flight would be lower than the rounding error of the gap. If
/// one contact rests, the flights of others may become lower.
fn at_rest(
    model: &Model,
    place: &StateAt<'_>,
    before: &[ForceMode],
    touching: &[usize],
) -> Result<Vec<usize>, Box<Failure>> {
    let free = before.iter().map(|of| match of.mode {
        Mode::Slides(_) => *of,
        _ => ForceMode { mode: Mode::Free, ..*of },
    });
    let free: Vec<ForceMode> = free.list();
    let mut rest: Vec<usize> = Vec::new();
    loop {
        let others: Vec<usize> = touching.iter().copied().filter(|k| !rest.contains(k)).list();
        if others.is_empty() {
            return Ok(rest);
        }
        let sides = rest.iter().copied().zip(place.sides(model, &rest)).list();
        let modes =
            if rest.is_empty() { free.clone() } else { with_held(model, place, &free, &sides) };
        let workspace = match place.solved(&place.phase(model, &modes)) {
            Err(_) if !rest.is_empty() => return Ok(rest),
            solved => solved?,
        };
        let gaps = place.gap_jets(model, &others, workspace.a());
        let rests = |(k, gap): &(&usize, Jet)| {
            let (restitution, rest_speed) = restitution(model, **k);
            // bounces without losses here that are damped elsewhere become ever more frequent
            let least = if restitution < 1.0 { 0.0 } else { LOW * place.unit(model, **k) };
            let height = least.max(place.rounding(model, **k));
            gap.rate <= rest_speed || 0.5 * gap.rate * gap.rate <= -gap.second * height
        };
        let more: Vec<usize> = others.iter().zip(gaps).filter(rests).map(|(k, _)| *k).list();
        if more.is_empty() {
            return Ok(rest);
        }
        rest.extend(more);
    }
}

/// Finds the candidates that can hold. The reserve of candidates in `ended` is zero.
fn hold(
    model: &Model,
    place: &StateAt<'_>,
    free: Vec<ForceMode>,
    (candidates, ended): (&[usize], &[usize]),
) -> Result<Vec<ForceMode>, Box<Failure>> {
    let sides = place.sides(model, candidates);
    let all: Vec<(usize, f64)> = candidates.iter().copied().zip(sides).list();
    let (found, shared) = released(model, place, free.clone(), (&all, ended));
    let misfit = |modes: &[ForceMode]| misfit(model, place, modes, candidates);
    let contact = |force: usize| contact_of(model, force).unwrap_or(force);
    let (fits, otherwise) = match found {
        Ok(modes) => match misfit(&modes) {
            None if !shared => return Ok(modes),
            None => (true, Ok(modes)),
            // at the end of an edge, a contact that presses separates for a moment
            Some(force) if ended.contains(&contact(force)) => (false, Ok(modes)),
            Some(force) => (false, Err(Failure::contradiction(model, place.t, force))),
        },
        Err(failure) => (false, Err(failure)),
    };
    let tried = |modes: Vec<ForceMode>| {
        let ended = with_leaders(&modes, ended);
        // with friction in contradictory directions there may be no solution
        let reserves = worst(&place.phase(model, &modes), place, &ended);
        (matches!(reserves, Ok(None)) && misfit(&modes).is_none()).then_some(modes)
    };
    if let Some(modes) = resting((model, place), &free, &all, &tried) {
        return Ok(modes);
    }
    if fits {
        return otherwise;
    }
    if let Some(modes) = together((model, place), &free, &all, &tried) {
        return Ok(modes);
    }
    combined((model, place), &free, &all, &tried).map_or(otherwise, Ok)
}

/// The first modes of all combinations that can be `tried`, those in which most forces hold first: a force that was released
/// early may have to hold after all. None if there are too many.
fn combined(
    (model, place): (&Model, &StateAt<'_>),
    free: &[ForceMode],
    all: &[(usize, f64)],
    tried: &Tried<'_>,
) -> Option<Vec<ForceMode>> {
    // friction holds or slides in two directions; a contact rests or is free
    let rubs = |k: &usize| free.iter().any(|of| of.force == *k && of.mode != Mode::Free);
    let ways = all.iter().map(|(k, _)| if rubs(k) { 3_usize } else { 2 }).list();
    let count = ways.iter().fold(1, |all: usize, own| all.saturating_mul(*own));
    let of = |choice: usize, at: usize| choice / ways[..at].iter().product::<usize>() % ways[at];
    let mut choices = if count > MOST_TRIED { 0..0 } else { 0..count };
    choices.find_map(|choice| {
        let (mut now, mut left) = (free.to_vec(), Vec::new());
        for (at, (k, side)) in all.iter().enumerate() {
            let own = now.iter_mut().find(|of| of.force == *k).expect("it has modes");
            match (of(choice, at), own.mode) {
                (0, _) => left.push((*k, *side)),
                (way, Mode::Slides(_)) => own.mode = Mode::Slides([1.0, -1.0][way - 1]),
                _ => {}
            }
        }
        tried(well_led(model, place, &now, &left))
    })
}

/// Releases the force with the largest excess until none exceeds its limit. Returns also whether some are released although
/// all of them may hold, because they share their forces in more than one way.
fn released(
    model: &Model,
    place: &StateAt<'_>,
    mut now: Vec<ForceMode>,
    (all, ended): (&[(usize, f64)], &[usize]),
) -> (Result<Vec<ForceMode>, Box<Failure>>, bool) {
    let (mut left, mut shared) = (all.to_vec(), false);
    loop {
        let modes = well_led(model, place, &now, &left);
        let share = |(k, _): &(usize, f64)| {
            matches!(mode_of(&modes, *k), Mode::Follows { .. } | Mode::Idle)
        };
        let ended = with_leaders(&modes, ended);
        let (force, slides) = match worst(&place.phase(model, &modes), place, &ended) {
            Ok(Some(found)) => found,
            Ok(None) => return (Ok(modes), shared),
            Err(failure) => return (Err(failure), shared),
        };
        shared = shared || left.iter().any(share);
        left.retain(|(k, _)| *k != force);
        let own = now.iter_mut().find(|of| of.force == force).expect("it has modes");
        if let Some(sign) = slides {
            own.mode = Mode::Slides(sign);
        }
    }
}

/// The first candidate that contradicts its mode: a free contact that closes, or friction that slides against its
/// direction. If the equations have no solution, it is any of them.
fn misfit(
    model: &Model,
    place: &StateAt<'_>,
    modes: &[ForceMode],
    candidates: &[usize],
) -> Option<usize> {
    let phase = place.phase(model, modes);
    let Ok(workspace) = place.solved(&phase) else { return candidates.first().copied() };
    // where the forces keep the mechanism at rest, its accelerations are rounding errors of those without them
    let free = place.solved(model).map_or(0.0, |free| scaled(model, free.a()));
    let still = STILL * scaled(&phase, workspace.a()).max(free);
    let gaps = place.gap_jets(model, candidates, workspace.a());
    let fits = |(k, jet): &(&usize, Jet)| match mode_of(modes, **k) {
        Mode::Free if model.forces[**k].is_companion => true,
        Mode::Free => jet.second >= -still * place.unit(model, **k),
        Mode::Slides(sign) => sign * jet.rate >= -still * place.unit(model, **k),
        _ => true,
    };
    candidates.iter().zip(gaps).find(|own| !fits(own)).map(|(k, _)| *k)
}

/// The forces that ended, and the forces that they follow. All of them have reached their limits.
fn with_leaders(held: &[ForceMode], ended: &[usize]) -> Vec<usize> {
    let leader = |own: &ForceMode| match own.mode {
        Mode::Follows { leader, .. } if ended.contains(&own.force) => Some(leader),
        _ => None,
    };
    ended.iter().copied().chain(held.iter().filter_map(leader)).list()
}

/// The force with the largest excess over its limit, and the direction in which its friction then slides.
fn worst(
    phase: &Model,
    place: &StateAt<'_>,
    ended: &[usize],
) -> Result<Option<(usize, Option<f64>)>, Box<Failure>> {
    let ([q, v, z], t) = (place.state(phase), place.t);
    let workspace = place.solved(phase)?;
    let motions = Motions::at(&phase.layout, q, v);
    let lam = workspace.lam();
    let acting = Acting { z, lam: Some(lam), t };
    let scale = place.force_scale(phase, Some(&workspace));
    let mut found: Option<(f64, usize, Option<f64>)> = None;
    for (k, item) in phase.forces.iter().enumerate() {
        let (Mode::Holds(_), Some(row)) = (item.mode, item.held_row) else { continue };
        let reserve = forces::reserve(phase, k, &motions, acting);
        let sticks = matches!(item.element.behaviour(), Some(Behaviour::Sticks));
        // at the end of a push, the multiplier is zero
        let pushes = sticks && item.element.only_pushes();
        let own = if pushes { scale } else { lam[row].abs().max(NOISE * scale) };
        let part = reserve / if sticks { own } else { scale };
        let least = match (ended.contains(&k), sticks) {
            (true, _) => USED_UP,
            (_, true) => -ROUNDING,
            (_, false) => -NOISE,
        };
        if part < least && found.is_none_or(|(most, ..)| part < most) {
            let sign = if pushes && reserve == -lam[row] { 1.0 } else { lam[row].signum() };
            found = Some((part, k, sticks.then_some(sign)));
        }
    }
    Ok(found.map(|(_, k, sign)| (k, sign)))
}
