//! The modes of forces at the start of a phase: friction slides or sticks, and contacts are apart or rest.
//!
//! | file | concept |
//! |---|---|
//! | `at_rest` | friction at states outside of runs |
//! | `mode_events` | the functions whose zeros may change a mode |
//! | `phases` | models in modes that are tried |
//! | `place` | a state at which modes are determined |
//! | `impact` | one impact: its impulses and the velocities after it |
//! | `impacts` | jumps of velocities where contacts hit |
//! | `closed_contacts` | closed contacts, and the rates that impulses in their directions cause |
//! | `companions` | friction of contacts that press |
//! | `dependence` | which forces can hold together, and the modes of the others |
//! | `friction_impact` | impacts of contacts with friction, and of all closed contacts together |
//! | `holding` | contacts that rest and friction that sticks |
//! | `jam` | impacts without collision, which end a friction paradox |
//! | `resting_contacts` | which of the closed contacts press, from all of them together |
//! | `shared_loads` | loads that contacts and friction at rest share in more than one way |
//! | `sliding_contacts` | whether the motion with contacts that slide is unique |
//! | `taking_part` | the mechanism without the contacts that are apart |

mod at_rest;
mod closed_contacts;
mod companions;
mod dependence;
mod friction_impact;
mod holding;
mod impact;
mod impacts;
mod jam;
mod mode_events;
mod phases;
mod place;
mod resting_contacts;
mod shared_loads;
mod sliding_contacts;
mod taking_part;

pub use at_rest::{can_stick, friction_modes};
pub(in crate::analyses) use mode_events::{watched_mode, ModeFunction};
pub(super) use mode_events::{COLLAPSE, GRAZE};
pub(super) use place::{has_mode, is_contact, unit as gap_unit, StateAt};
pub(super) use shared_loads::shared_at;
pub use shared_loads::shared_loads;
pub(super) use sliding_contacts::{lost, Uniqueness, MOST};
pub(super) use taking_part::Settled;

use crate::math::Listed;
use place::with_modes;

use super::failure::{Failure, Reason};
use super::options::{ImpactLaws, Jam};
use crate::elements::{Behaviour, Mode};
use crate::model::{ForceMode, Model};
use dependence::keep_closed;
use impacts::Hits;
use taking_part::TakingPart;

/// The forces whose modes ended where a phase ends.
pub(super) struct Ended {
    /// Those whose events ended it.
    pub fired: Vec<usize>,
    /// Those that have ceased to hold at the same time before.
    pub ceased: Vec<usize>,
    /// Contacts at which a friction paradox ended it.
    pub lost: Vec<usize>,
}

/// Determines the modes at a state, whose velocities jump where contacts hit. If `before` contains no modes, the run
/// begins.
///
/// # Errors
/// [`Failure`] where the equations have no solution.
pub(super) fn settle(
    model: &Model,
    place: &mut StateAt<'_>,
    before: &[ForceMode],
    ended: &Ended,
    laws: ImpactLaws,
) -> Result<Settled, Box<Failure>> {
    let touching = impacts::touching(model, place, before);
    let part = TakingPart::of(model, &touching);
    let own = (part.places(&touching), part.modes(before));
    let places = |forces: &Vec<usize>| part.places(forces);
    let [fired, ceased, lost] = [&ended.fired, &ended.ceased, &ended.lost].map(places);
    let ended = Ended { fired, ceased, lost };
    let found = settle_part(&part.model, place, (&own.0, &own.1), &ended, laws);
    let found = found.map_err(|failure| failure.advised(laws.jam))?;
    let mut settled = part.whole(model, found);
    let Settled { modes, hits, changed, .. } = &mut settled;
    for (old, new) in before.iter().zip(modes) {
        let sticks = matches!(model.forces[old.force].element.behaviour(), Some(Behaviour::Sticks));
        match (old.mode.holds(), new.mode.holds(), sticks) {
            // its contact separates
            (true, false, true) if new.mode == Mode::Free => {}
            (false, true, true) => changed.push((old.force, 0)),
            (true, false, _) if !hits.contains(&old.force) => changed.push((old.force, 1)),
            _ => {}
        }
    }
    Ok(settled)
}

/// Determines the modes of forces that take part.
fn settle_part(
    model: &Model,
    place: &mut StateAt<'_>,
    (touching, before): (&[usize], &[ForceMode]),
    ended: &Ended,
    laws: ImpactLaws,
) -> Result<Settled, Box<Failure>> {
    let fastest = place.fastest(model);
    let mut found = impacts::resolve(model, place, touching, laws)?;
    let (mut jammed, mut lost) = (Vec::new(), ended.lost.as_slice());
    let mut modes = loop {
        let jumped = (!found.hits.is_empty() || !jammed.is_empty()).then_some(fastest);
        let at_once = (ended.fired.as_slice(), ended.ceased.as_slice());
        // a contact that jams has accelerations without bound, which say nothing about the motion after it
        let is_lost = |of: &ForceMode| jammed.contains(&of.force) || ended.lost.contains(&of.force);
        let calm = |of: &ForceMode| ForceMode {
            mode: if is_lost(of) { Mode::Free } else { of.mode },
            ..*of
        };
        let decided = match lost {
            [] => {
                let before = before.iter().map(calm).list();
                holding::decide(model, place, &before, (touching, jumped), at_once)
            }
            [contact, ..] => Err(Failure::paradox(model, place.t, *contact)),
        };
        let singular = |failure: &Failure| matches!(failure.reason, Reason::Singular { .. });
        let jams = decided.as_ref().is_err_and(|failure| singular(failure));
        if !jams || laws.jam == Jam::Refuse || jammed.len() >= touching.len() {
            break decided?;
        }
        match impacts::jam(model, place, (touching, lost), laws, &mut found)? {
            Some(contacts) => jammed.extend(contacts),
            None => break decided?,
        }
        lost = &[];
    };
    companions::check(model, place, &modes)?;
    keep_closed(model, place, touching, &mut modes);
    let uniqueness = sliding_contacts::examine(model, place, touching, &modes)?;
    let Hits { hits, impulses, impacts, couples, ended } = found;
    let collapsed = !ended.is_empty();
    let changed = ended.into_iter().map(|k| (k, COLLAPSE)).list();
    Ok(Settled { modes, hits, impulses, impacts, couples, collapsed, changed, jammed, uniqueness })
}

/// Refuses a start beyond a stop or contact with restitution, and a stop whose coordinate is held by drivers that no
/// condition releases.
///
/// # Errors
/// [`Failure`] with [`Reason::Start`].
pub(super) fn check(
    model: &Model,
    place: &StateAt<'_>,
    released_later: &[String],
) -> Result<(), Box<Failure>> {
    let t = place.t;
    let all: Vec<usize> = rigid_contacts(model).list();
    for (k, gap) in all.iter().zip(place.thresholds(model, &all)) {
        let name = model.forces[*k].name.clone();
        if place.is_closed(-gap, model, *k) {
            continue;
        }
        let message = format!("the state is beyond {name} at t = {t:.6} s: its gap is {gap:.3e}");
        let hint = match model.forces[*k].element.joint() {
            Some(_) => "set the angles of the wheels, or choose an offset, so that the play is within its limits",
            None => {
                "start where the gap is not negative, or give a stiffness in place of restitution"
            }
        };
        return Err(Reason::Start { t, name, message, hint }.into());
    }
    for k in all {
        let Some(driver) = impacts::holder(model, place, k) else { continue };
        if released_later.contains(driver) {
            continue;
        }
        let name = model.forces[k].name.clone();
        let message =
            format!("{name} acts on a coordinate that {driver} holds, which no impact can change");
        let hint =
            "remove the stop, release the driver, or give a stiffness in place of restitution";
        return Err(Reason::Start { t, name, message, hint }.into());
    }
    Ok(())
}

/// The stops and contacts with restitution.
pub(super) fn rigid_contacts(model: &Model) -> impl Iterator<Item = usize> + '_ {
    with_modes(model).filter(|k| is_contact(model, *k))
}

/// Whether a model has forces with modes.
pub(super) fn has_modes(model: &Model) -> bool {
    with_modes(model).next().is_some()
}
