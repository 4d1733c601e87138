//! Impacts: jumps of the velocities of the whole mechanism where contacts with restitution approach.
//!
//! With the rates ġ of the gaps of all contacts that approach at an instant, Φ_q v⁺ = -Φ_t and ġ⁺ = -e ġ⁻,
//!
//! ```text
//! [ M    Φ_qᵀ  G_qᵀ ] [ v⁺ - v⁻ ]   [ 0          ]
//! [ Φ_q  0     0    ] [ P       ] = [ 0          ]
//! [ G_q  0     0    ] [ R       ]   [ -(1+e) ġ⁻ ]
//! ```
//!
//! This is repeated until no contact approaches (Glocker and Pfeiffer, *Multiple impacts with friction in rigid multibody
//! systems*, Nonlinear Dynamics 7 (1995) 471). If all e are equal, the kinetic energy does not grow: its change is -½
//! (1 - e²) ġ⁻ᵀ (G M⁻¹ Gᵀ)⁻¹ ġ⁻. If contacts with different e would gain energy together, all of them use the least
//! e.
//!
//! A light body between others may hit them without end, with speeds that shrink in a geometric sequence. If a contact
//! that hits without end has the impulse R > 0 in all, its rate tends to zero, so the limit solves one complementarity
//! problem over all closed contacts,
//!
//! ```text
//! M (v⁺ - v⁻) = Φ_qᵀ P + G_qᵀ R,   Φ_q v⁺ = -Φ_t,   0 ≤ R ⟂ ġ⁺ ≥ 0,
//! ```
//!
//! which has one solution v⁺: the nearest to v⁻ in the norm of M (Moreau, *Liaisons unilatérales sans frottement et chocs
//! inélastiques*, C. R. Acad. Sci. Paris 296 (1983) 1473). Without restitution, it is the law of the impact itself.
//!
//! `friction_impact.rs` contains the impacts of contacts with friction, and of all closed contacts together.

use super::super::failure::{Failure, Reason};
use super::super::model_cache::ModelCache;
use super::super::options::{ImpactLaws, ImpactOrder};
use super::super::passages::Struck;
use super::super::redundant_rows::workspace_at;
use super::dependence::holders;
use super::impact::{driver_work, Impact, Restitutions};
use super::place::{mode_of, with_modes, StateAt, STILL};
use super::{companions, friction_impact, jam};
use crate::elements::{Behaviour, Mode};
use crate::equations::energy;
use crate::equations::kinematics::Motions;
use crate::math::Listed;
use crate::model::{ForceMode, Model};

/// Largest number of rounds of impacts at one time.
const ROUNDS: usize = 10_000;
/// Number of approaches of one contact from which on a sequence may be without end.
const MANY: usize = 20;
/// Largest change of the ratios of rates from one approach to the next in a sequence without end.
const STEADY: f64 = 1e-9;

/// Contacts that hit, and their impulses.
#[derive(Clone, Debug, Default)]
pub(super) struct Hits {
    pub hits: Vec<usize>,
    pub impulses: Vec<f64>,
    /// The contacts of each impact, in order.
    pub impacts: Vec<Vec<Struck>>,
    /// Whether contacts with friction, or all closed contacts, acted together.
    pub couples: bool,
    /// Contacts at which a sequence of impacts without end has been replaced by its limit.
    pub ended: Vec<usize>,
}

/// The approaches of a contact at one time: their number, and the rates of all gaps at the last of them.
#[derive(Clone, Default)]
struct Approaches {
    count: usize,
    rates: Vec<f64>,
}

/// The contacts that touch: contacts that an equation of their own holds, and contacts with a closed gap.
pub(super) fn touching(model: &Model, place: &StateAt<'_>, before: &[ForceMode]) -> Vec<usize> {
    let impacts =
        |k: &usize| matches!(model.forces[*k].element.behaviour(), Some(Behaviour::Impacts { .. }));
    let all: Vec<usize> = with_modes(model).filter(impacts).list();
    let gaps = place.thresholds(model, &all);
    let touches = |(k, gap): &(usize, f64)| {
        matches!(mode_of(before, *k), Mode::Holds(_)) || place.is_closed(*gap, model, *k)
    };
    all.into_iter().zip(gaps).filter(touches).map(|(k, _)| k).list()
}

/// Restitution and rest speed of a contact.
pub(super) fn restitution(model: &Model, k: usize) -> (f64, f64) {
    match model.forces[k].element.behaviour() {
        Some(Behaviour::Impacts { restitution, rest_speed }) => (restitution, rest_speed),
        _ => (0.0, 0.0),
    }
}

/// Computes impacts at the touching contacts that approach, until none approaches.
pub(super) fn resolve(
    model: &Model,
    place: &mut StateAt<'_>,
    touching: &[usize],
    ImpactLaws { order, restitution: law, .. }: ImpactLaws,
) -> Result<Hits, Box<Failure>> {
    let mut found = Hits::default();
    let mut seen = vec![Approaches::default(); touching.len()];
    let plastic = touching.iter().all(|k| restitution(model, *k).0 == 0.0);
    for round in 0.. {
        let rates = place.gap_rates(model, touching);
        let approaching = approaching(model, place, touching, &rates);
        if approaching.is_empty() {
            break;
        }
        for at in &approaching {
            free_of_drivers(model, place, touching[*at])?;
        }
        if found.impulses.is_empty() {
            found.impulses = vec![0.0; model.n_multipliers()];
        }
        let endless = is_endless(&mut seen, &approaching, &rates) || round == ROUNDS;
        let own = |k: usize| if endless { 0.0 } else { restitution(model, k).0 };
        let all = plastic || endless || order == ImpactOrder::Simultaneous;
        let approach: Vec<(usize, f64)> =
            approaching.iter().map(|at| (touching[*at], rates[*at])).list();
        let hit_ones: Vec<usize> = approach.iter().map(|(k, _)| *k).list();
        let acting = if all { touching } else { &hit_ones };
        let couples = order == ImpactOrder::Simultaneous || companions::rub(model, acting);
        let impact = match all {
            _ if couples => friction_impact::strike(model, place, acting, (&own, law))?,
            true => together(model, place, touching)?,
            false => hit(model, place, &approach, &own)?,
        };
        found.couples |= couples;
        impact.apply(model, place, &mut found.impulses);
        found.impacts.push(impact.struck(plastic || endless));
        found.hits.extend(&impact.contacts);
        if plastic || endless {
            found.ended = if plastic { Vec::new() } else { impact.contacts };
            break;
        }
    }
    found.hits.sort_unstable();
    found.hits.dedup();
    Ok(found)
}

/// Ends a friction paradox of contacts that touch, of which some are lost, by an impact without collision, and adds it to
/// the others. Returns its contacts; None if no contact has to jump.
pub(super) fn jam(
    model: &Model,
    place: &mut StateAt<'_>,
    contacts: (&[usize], &[usize]),
    laws: ImpactLaws,
    found: &mut Hits,
) -> Result<Option<Vec<usize>>, Box<Failure>> {
    let own = |k: usize| restitution(model, k).0;
    let impact = jam::strike(model, place, contacts, (&own, laws.restitution))?;
    let Some(impact) = impact else { return Ok(None) };
    if found.impulses.is_empty() {
        found.impulses = vec![0.0; model.n_multipliers()];
    }
    impact.apply(model, place, &mut found.impulses);
    found.impacts.push(impact.struck(false));
    found.couples = true;
    Ok(Some(impact.contacts))
}

/// A driver that holds the coordinate of a contact.
pub(super) fn holder<'m>(model: &'m Model, place: &StateAt<'_>, k: usize) -> Option<&'m String> {
    let by = holders(model, place, k);
    let driver = (0..model.constraints.len()).find(|at| by.contains(*at))?;
    Some(&model.constraints[driver].name)
}

/// Refuses an impact that a driver does not allow.
///
/// # Errors
/// [`Failure`] that names the contact and the driver.
fn free_of_drivers(model: &Model, place: &StateAt<'_>, k: usize) -> Result<(), Box<Failure>> {
    let Some(driver) = holder(model, place, k) else { return Ok(()) };
    let (t, name) = (place.t, model.forces[k].name.clone());
    let message = format!(
        "{name} closes at t = {t:.6} s while {driver} holds its coordinate, which no impact can change"
    );
    Err(Reason::Singular { t, name, message }.into())
}

/// The places of the touching contacts that approach faster than they may rest, and faster than the rounding errors of
/// contacts that rest while others hit.
fn approaching(
    model: &Model,
    place: &StateAt<'_>,
    touching: &[usize],
    rates: &[f64],
) -> Vec<usize> {
    let relative = |(k, rate): (&usize, &f64)| rate.abs() / place.unit(model, *k);
    let fastest = touching.iter().zip(rates).map(relative).fold(0.0, f64::max);
    let fast = |at: &usize| {
        let k = touching[*at];
        rates[*at] < -restitution(model, k).1.max(STILL * fastest * place.unit(model, k))
    };
    (0..touching.len()).filter(fast).list()
}

/// Counts the contacts that approach. Returns whether one of them has approached often, and the rates of contacts that
/// approach often have shrunk by one factor since it did so last: the same impacts then follow without end.
fn is_endless(seen: &mut [Approaches], approaching: &[usize], rates: &[f64]) -> bool {
    approaching.iter().for_each(|at| seen[*at].count += 1);
    let often = (0..seen.len()).filter(|at| seen[*at].count > MANY / 2).list();
    let of = |x: &[f64]| often.iter().map(|at| x[*at]).list();
    let size = |x: &[f64]| x.iter().map(|x| x * x).sum::<f64>().sqrt();
    let steady = |at: &usize| {
        let (old, new) = (of(&seen[*at].rates), of(rates));
        let (was, is) = (size(&old), size(&new));
        let changes = old.iter().zip(&new).map(|(old, new)| (new / is - old / was).abs());
        is < was && changes.fold(0.0, f64::max) < STEADY
    };
    let endless = approaching.iter().any(|at| seen[*at].count >= MANY && steady(at));
    approaching.iter().for_each(|at| seen[*at].rates = rates.to_vec());
    endless
}

/// The one impact without restitution after which no contact approaches. It is found as the least squares with
/// impulses ≥ 0 of Lawson and Hanson, *Solving Least Squares Problems* (1974), chapter 23.
fn together(
    model: &Model,
    place: &StateAt<'_>,
    touching: &[usize],
) -> Result<Impact, Box<Failure>> {
    let mut y = place.y.to_vec();
    let before = place.gap_rates(model, touching);
    let with = |held: &[(usize, f64)]| {
        let approach = held.iter().map(|(at, _)| (touching[*at], before[*at])).list();
        hit(model, place, &approach, &|_| 0.0)
    };
    let mut held: Vec<(usize, f64)> = Vec::new();
    let mut impact = with(&held)?;
    // each contact enters once, or again after it was released
    for _ in 0..touching.len() * touching.len() {
        model.layout.split_mut(&mut y)[1].copy_from_slice(&impact.after);
        let rates = place.with(&mut y).gap_rates(model, touching);
        let mut others = approaching(model, place, touching, &rates);
        others.retain(|at| held.iter().all(|(own, _)| own != at));
        let next = others.into_iter().min_by(|a, b| rates[*a].total_cmp(&rates[*b]));
        let Some(next) = next else { break };
        held.push((next, 0.0));
        loop {
            impact = with(&held)?;
            let pushes = impact.pushes();
            let part = |((_, old), new): (&(usize, f64), &f64)| match *new > 0.0 {
                true => 1.0,
                false => old / (old - new).max(f64::MIN_POSITIVE),
            };
            let least = held.iter().zip(&pushes).map(part).fold(1.0, f64::min);
            for ((_, old), new) in held.iter_mut().zip(&pushes) {
                *old += least * (new - *old);
            }
            if pushes.iter().all(|push| *push > 0.0) {
                break;
            }
            let pulls = |at: usize| pushes[at] <= 0.0 && part((&held[at], &pushes[at])) <= least;
            let left = (0..held.len()).filter(|at| !pulls(*at)).map(|at| held[at]);
            held = left.list();
        }
    }
    Ok(impact)
}

/// Removes the small gap rates of contacts that come to rest. Contacts that stick there continue to do so.
pub(super) fn halt(
    model: &Model,
    place: &mut StateAt<'_>,
    contacts: &[usize],
) -> Result<(), Box<Failure>> {
    let rates = place.gap_rates(model, contacts);
    let moving = contacts.iter().copied().zip(rates).filter(|(_, rate)| *rate != 0.0);
    let mut moving: Vec<(usize, f64)> = moving.list();
    if moving.is_empty() {
        return Ok(());
    }
    let rubs: Vec<usize> = contacts.iter().filter_map(|k| model.forces[*k].partner).list();
    if !rubs.is_empty() {
        let still = STILL * place.rate_scale(&place.phase(model, &[]));
        let slow = rubs.iter().copied().zip(place.thresholds(model, &rubs));
        moving.extend(slow.filter(|(k, speed)| speed.abs() <= still * place.unit(model, *k)));
    }
    let impact = hit(model, place, &moving, &|_| 0.0)?;
    impact.apply(model, place, &mut vec![0.0; model.n_multipliers()]);
    Ok(())
}

/// Computes the impact of all these contacts, each with the rate of its gap and with its restitution.
fn hit(
    model: &Model,
    place: &StateAt<'_>,
    approach: &[(usize, f64)],
    own: Restitutions<'_>,
) -> Result<Impact, Box<Failure>> {
    let t = place.t;
    let contacts: Vec<usize> = approach.iter().map(|(k, _)| *k).list();
    let sides = place.sides(model, &contacts);
    let held = |(k, side): (&usize, &f64)| ForceMode::new(*k, Mode::Holds(*side));
    let modes: Vec<ForceMode> = contacts.iter().zip(&sides).map(held).list();
    let closed = model.in_modes(&modes).allowing_redundancy();
    let [q, v, z] = place.state(model);
    let mut workspace = workspace_at((&closed, &ModelCache::default()), t, [q, v, z]);
    let least = contacts.iter().copied().min_by(|a, b| own(*a).total_cmp(&own(*b)));
    let kinetic = |v: &[f64]| energy::kinetic(model, &Motions::at(&model.layout, q, v));
    let before = kinetic(v);
    let mut rates = vec![0.0; closed.layout.n_rows];
    let mut outcome = None;
    // first with the individual restitutions
    for common in [false, true] {
        for ((k, rate), side) in approach.iter().zip(&sides) {
            let row = closed.forces[*k].held_row.expect("it holds");
            let e = own(least.filter(|_| common).unwrap_or(*k));
            // the gap of an upper limit grows as its coordinate falls
            rates[row] = side.signum() * (1.0 + e) * rate;
        }
        let jump = workspace.jump(&closed, t, q, &rates);
        let [dv, found] = jump.map_err(|breakdown| Failure::at_state(&closed, t, q, breakdown))?;
        let after: Vec<f64> = v.iter().zip(&dv).map(|(v, dv)| v + dv).list();
        let energy = kinetic(&after);
        let loss = before - energy;
        // drivers may add energy
        let grows = loss + driver_work(model, t, q, &found) < -1e-13 * before.max(energy);
        outcome = Some((after, found, loss, least.filter(|_| common)));
        if !grows {
            break;
        }
    }
    let (after, found, loss, common) = outcome.expect("it was computed");
    Ok(Impact { contacts, closed, found, after, loss, common })
}
