//! Loads that contacts and friction at rest share in more than one way.

use super::at_rest::sticks;
use super::place::{is_contact, scaled, StateAt, STILL};
use crate::analyses::mobility::dependent_equations;
use crate::elements::Mode;
use crate::math::{Jet, Listed};
use crate::model::{ForceMode, Model};
use std::collections::BTreeSet;

/// The names of forces, joints and drivers with such loads at a state, (t, q, v, z). `open` is the model without modes.
pub fn shared_loads(
    open: &Model,
    modes: &[ForceMode],
    t: f64,
    [q, v, z]: [&[f64]; 3],
) -> Vec<String> {
    let mut y = [q, v, z, &vec![0.0; open.layout.n_works]].concat();
    shared_at(open, modes, &StateAt::new(open, t, &mut y))
}

/// The same at a place. Equations of constraints and of forces at rest that depend on each other have forces that are not
/// unique. Friction that drivers hold is left out, see [`friction_range`](crate::analyses::friction_range()).
pub fn shared_at(open: &Model, modes: &[ForceMode], place: &StateAt<'_>) -> Vec<String> {
    if !modes.iter().any(|of| of.mode.depends()) {
        return Vec::new();
    }
    let idle = without_force(open, modes, place);
    let rests = |of: &&ForceMode| of.mode.holds() || idle.contains(&of.force);
    // both limits of a stop have the same derivatives
    let side = |mode: Mode| if matches!(mode, Mode::Holds(_)) { mode } else { Mode::Holds(1.0) };
    let held = modes.iter().filter(rests).map(|of| ForceMode { mode: side(of.mode), ..*of }).list();
    let phase = place.phase(open, &held);
    let first = phase.constraints.len() - held.len();
    let force = |k: &usize| k.checked_sub(first).map(|k| held[k].force);
    let of_drivers = |group: &[usize]| match group.iter().filter_map(force).list()[..] {
        [] => true,
        [only] => sticks(open, only),
        _ => false,
    };
    let found = dependent_equations(&phase, place.t, place.state(open)[0], &|| false);
    let groups = found.into_iter().map(|one| one.group).filter(|group| !of_drivers(group));
    let all: BTreeSet<usize> = groups.flatten().collect();
    let forces = all.iter().filter_map(force).list();
    let of_case = open.listed_forces().iter().enumerate();
    let takes_part = of_case.filter(|(k, _)| open.whole(*k).any(|k| forces.contains(&k)));
    let joints = all.iter().filter(|k| **k < first).map(|k| &phase.constraints[*k].name);
    takes_part.map(|(_, item)| &item.name).chain(joints).cloned().collect()
}

/// The contacts that stay closed without a force, and their friction that stays at rest.
fn without_force(open: &Model, modes: &[ForceMode], place: &StateAt<'_>) -> Vec<usize> {
    let rest = modes.iter().filter(|of| !of.mode.holds()).map(|of| of.force).list();
    let phase = place.phase(open, modes);
    let Ok(solved) = place.solved(&phase) else { return Vec::new() };
    let free = place.solved(open).map_or(0.0, |free| scaled(open, free.a()));
    let still = STILL * scaled(&phase, solved.a()).max(free);
    let jets = place.gap_jets(open, &rest, solved.a());
    let stays = |(k, jet): &(usize, Jet)| {
        let (slow, still) = (place.slow(open, *k), still * place.unit(open, *k));
        match (is_contact(open, *k), jet) {
            (true, Jet { value, rate, second }) => {
                place.is_closed(*value, open, *k) && rate.abs() <= slow && second.abs() <= still
            }
            (false, Jet { value, rate, .. }) => value.abs() <= slow && rate.abs() <= still,
        }
    };
    rest.into_iter().zip(jets).filter(stays).map(|(k, _)| k).list()
}
