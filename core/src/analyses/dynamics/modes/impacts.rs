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

use super::super::failure::{Failure, Reason};
use super::super::model_cache::ModelCache;
use super::super::redundant_rows::workspace_at;
use super::place::{mode_of, with_modes, StateAt};
use crate::elements::{Behaviour, Mode};
use crate::equations::kinematics::Motions;
use crate::equations::{constraints, energy};
use crate::math::Listed;
use crate::model::{ForceMode, Model};

/// Largest number of rounds of impacts at one time.
const ROUNDS: usize = 1000;

/// The restitution of each contact.
type Restitutions<'r> = &'r dyn Fn(usize) -> f64;

/// Contacts that hit, and their impulses.
#[derive(Clone, Debug, Default)]
pub(super) struct Hits {
    pub hits: Vec<usize>,
    pub impulses: Vec<f64>,
}

/// The contacts that touch: contacts that rest, and contacts with a closed gap.
pub(super) fn touching(model: &Model, place: &StateAt<'_>, before: &[ForceMode]) -> Vec<usize> {
    let impacts =
        |k: &usize| matches!(model.forces[*k].element.behaviour(), Some(Behaviour::Impacts { .. }));
    let all: Vec<usize> = with_modes(model).filter(impacts).list();
    let gaps = place.thresholds(model, &all);
    let touches = |(k, gap): &(usize, f64)| {
        mode_of(before, *k).holds() || StateAt::is_closed(*gap, model, *k)
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
) -> Result<Hits, Box<Failure>> {
    let mut found = Hits::default();
    for _ in 0..ROUNDS {
        let rates = place.gap_rates(model, touching);
        let approach: Vec<(usize, f64)> = touching
            .iter()
            .copied()
            .zip(rates)
            .filter(|(k, rate)| *rate < -restitution(model, *k).1)
            .list();
        if approach.is_empty() {
            return Ok(found);
        }
        if found.impulses.is_empty() {
            found.impulses = vec![0.0; model.n_multipliers()];
        }
        let own = |k: usize| restitution(model, k).0;
        hit(model, place, (&approach, &own), &mut found.impulses)?;
        approach.iter().map(|(k, _)| *k).append_to(&mut found.hits);
        found.hits.sort_unstable();
        found.hits.dedup();
    }
    let t = place.t;
    let names: Vec<&str> = found.hits.iter().map(|k| model.forces[*k].name.as_str()).list();
    let message = format!(
        "impacts at t = {t:.6} s do not end: after {ROUNDS} rounds some of {} still approach",
        names.join(", ")
    );
    let hint = "a smaller restitution loses energy in each round";
    Err(Reason::Integration { t, message, hint }.into())
}

/// Removes the small gap rates of contacts that come to rest.
pub(super) fn halt(
    model: &Model,
    place: &mut StateAt<'_>,
    contacts: &[usize],
) -> Result<(), Box<Failure>> {
    let rates = place.gap_rates(model, contacts);
    let moving = contacts.iter().copied().zip(rates).filter(|(_, rate)| *rate != 0.0);
    let moving: Vec<(usize, f64)> = moving.list();
    if moving.is_empty() {
        return Ok(());
    }
    hit(model, place, (&moving, &|_| 0.0), &mut vec![0.0; model.n_multipliers()])
}

/// Computes one round, in which all these contacts hit, each with the rate of its gap and with its restitution.
fn hit(
    model: &Model,
    place: &mut StateAt<'_>,
    (approach, own): (&[(usize, f64)], Restitutions<'_>),
    impulses: &mut [f64],
) -> Result<(), Box<Failure>> {
    let t = place.t;
    let contacts: Vec<usize> = approach.iter().map(|(k, _)| *k).list();
    let sides = place.sides(model, &contacts);
    let held = |(k, side): (&usize, &f64)| ForceMode::new(*k, Mode::Holds(*side));
    let modes: Vec<ForceMode> = contacts.iter().zip(&sides).map(held).list();
    let closed = model.in_modes(&modes).allowing_redundancy();
    let [q, v, z] = place.state(model).map(<[f64]>::to_vec);
    let mut workspace = workspace_at((&closed, &ModelCache::default()), t, [&q, &v, &z]);
    let least = approach.iter().map(|(k, _)| own(*k)).fold(1.0, f64::min);
    let kinetic = |v: &[f64]| energy::kinetic(model, &Motions::at(&model.layout, &q, v));
    let before = kinetic(&v);
    let mut rates = vec![0.0; closed.layout.n_rows];
    let mut outcome = None;
    // first with the individual restitutions
    for common in [false, true] {
        for ((k, rate), side) in approach.iter().zip(&sides) {
            let row = closed.forces[*k].held_row.expect("it holds");
            let e = if common { least } else { own(*k) };
            // the gap of an upper limit grows as its coordinate falls
            rates[row] = side * (1.0 + e) * rate;
        }
        let jump = workspace.jump(&closed, t, &q, &rates);
        let [dv, found] = jump.map_err(|breakdown| Failure::at_state(&closed, t, &q, breakdown))?;
        let after: Vec<f64> = v.iter().zip(&dv).map(|(v, dv)| v + dv).list();
        let loss = before - kinetic(&after);
        let grows = loss < -1e-13 * before;
        outcome = Some((after, found, loss));
        if !grows {
            break;
        }
    }
    let (after, found, loss) = outcome.expect("it was computed");
    let base = model.layout.n_rows;
    for (sum, own) in impulses.iter_mut().zip(&found[..base]) {
        *sum += own;
    }
    for (k, _) in approach {
        if let (Some(to), Some(from)) = (model.forces[*k].held_row, closed.forces[*k].held_row) {
            impulses[to] += found[from];
        }
    }
    let [_, v, _, works] = model.layout.split_mut(place.y);
    v.copy_from_slice(&after);
    let driven = driver_work(model, t, &q, &found);
    works[0] += loss + driven;
    works[1] += driven;
    Ok(())
}

/// Work of the impulses of drivers. The rates of their rows are -Φ_t before and after.
fn driver_work(model: &Model, t: f64, q: &[f64], impulses: &[f64]) -> f64 {
    if !model.driven {
        return 0.0;
    }
    let at_rest = Motions::at_rest(&model.layout, q);
    let [mut phi, mut by_time, mut gamma] = [0, 1, 2].map(|_| vec![0.0; model.layout.n_rows]);
    constraints::velocity_terms(model, &at_rest, t, &mut phi, &mut by_time, &mut gamma);
    by_time.iter().zip(impulses).map(|(by_time, impulse)| by_time * impulse).sum()
}
