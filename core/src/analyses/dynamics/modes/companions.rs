//! The friction of contacts, which acts only while the contact presses.

use super::super::failure::{Failure, Reason};
use super::place::{is_contact, mode_of, StateAt};
use crate::elements::Mode;
use crate::model::{ForceMode, Model};

/// Whether a force is not the friction of a contact that is apart. The arguments include the contacts with restitution
/// that rest and the forces whose events ended the phase.
pub(super) fn may_rub(
    model: &Model,
    place: &StateAt<'_>,
    force: usize,
    (before, rest, fired): (&[ForceMode], &[usize], &[usize]),
) -> bool {
    let Some(contact) = contact_of(model, force) else { return true };
    if is_contact(model, contact) {
        return rest.contains(&contact);
    }
    let gap = place.thresholds(model, &[contact])[0];
    let near = place.rounding(model, contact);
    let touched = !matches!(mode_of(before, force), Mode::Free | Mode::Open);
    match gap.abs() <= near || fired.contains(&contact) {
        // the gap is zero
        true => match place.gap_rates(model, &[contact])[0] {
            rate if touched => rate <= 0.0,
            rate => rate < 0.0 || rate == 0.0 && gap <= 0.0,
        },
        false => gap < 0.0,
    }
}

/// The mode of friction that does not act. The gap of a compliant contact that has just separated may still be negative,
/// which its slack allows.
pub(super) fn open(model: &Model, place: &StateAt<'_>, force: usize) -> ForceMode {
    let contact = contact_of(model, force).filter(|contact| !is_contact(model, *contact));
    let slack = contact.map_or(0.0, |contact| {
        let gap = place.thresholds(model, &[contact])[0];
        place.rounding(model, contact) + (-gap).max(0.0)
    });
    ForceMode { slack, ..ForceMode::new(force, Mode::Free) }
}

/// Whether a force may hold together with others. The friction of a rigid contact needs the contact at rest.
pub(super) fn may_hold(model: &Model, force: usize, with: &[(usize, f64)]) -> bool {
    let rests = |contact: usize| with.iter().any(|(k, _)| *k == contact);
    contact_of(model, force).is_none_or(|contact| !is_contact(model, contact) || rests(contact))
}

/// Ends the friction of rigid contacts that do not press.
pub(super) fn release(model: &Model, modes: &mut [ForceMode]) {
    for at in 0..modes.len() {
        let Some(contact) = contact_of(model, modes[at].force) else { continue };
        let rests = matches!(mode_of(modes, contact), Mode::Holds(_));
        if is_contact(model, contact) && !rests {
            modes[at] = ForceMode::new(modes[at].force, Mode::Free);
        }
    }
}

/// The contact whose friction a force is.
pub(super) fn contact_of(model: &Model, force: usize) -> Option<usize> {
    let item = &model.forces[force];
    item.partner.filter(|_| item.is_companion)
}

/// Whether one of these contacts has friction that sticks.
pub(super) fn rub(model: &Model, contacts: &[usize]) -> bool {
    contacts.iter().any(|k| model.forces[*k].partner.is_some())
}

/// Refuses friction of contacts whose normal forces are not unique, because a contact repeats others. It does not matter
/// where all contacts at rest of the same two bodies have the same coefficients.
///
/// # Errors
/// [`Failure`] that names the contact.
pub(super) fn check(
    model: &Model,
    place: &StateAt<'_>,
    modes: &[ForceMode],
) -> Result<(), Box<Failure>> {
    let coefficients = |k: usize| {
        let rubs = model.forces[k].partner?;
        Some(model.forces[rubs].element.coefficients())
    };
    let rests = |own: &&ForceMode| {
        let item = &model.forces[own.force];
        is_contact(model, own.force) && !item.is_companion && own.mode.holds()
    };
    for own in modes.iter().filter(rests).filter(|own| own.mode == Mode::Idle) {
        let bodies = &model.forces[own.force].bodies;
        let beside =
            modes.iter().filter(rests).filter(|of| model.forces[of.force].bodies == *bodies);
        if { beside }.all(|of| coefficients(of.force) == coefficients(own.force)) {
            continue;
        }
        let (t, name) = (place.t, model.forces[own.force].name.clone());
        let message = format!(
            "the normal force of {name} is not unique at t = {t:.6} s, because it repeats other contacts of the same \
             bodies, and their friction depends on it"
        );
        let hint = "give all of them the same friction and static, or remove one of them";
        return Err(Reason::Redundant { t, name, message, hint }.into());
    }
    Ok(())
}
