//! Joints with play, and belts that are elastic or slip. They are written as joints and act as forces, so that they
//! follow the forces in a model.

use super::definition::{Definition, Entry, Value};
use super::link::Linker;
use crate::elements::forces::{LooseBelt, Play};
use crate::elements::{acts_as_force, loose_fields, Constraint, ForceElement, Group};
use crate::expression::Tape;
use std::borrow::Cow;

/// Whether an entry is a joint that acts as a force.
pub(super) fn is_written(entry: &Entry) -> bool {
    let Some(Value::Text(kind)) = entry.get("type") else { return false };
    let given = |field: &&str| !matches!(entry.get(field), None | Some(Value::Number(0.0)));
    acts_as_force(kind) || loose_fields(kind).iter().any(given)
}

/// The definition with its joints that have play after its forces.
pub(super) fn moved(definition: &Definition) -> Cow<'_, Definition> {
    if !definition.joints.iter().any(is_written) {
        return Cow::Borrowed(definition);
    }
    let mut definition = definition.clone();
    let joints = std::mem::take(&mut definition.joints);
    let (loose, rigid) = joints.into_iter().partition(is_written);
    definition.joints = rigid;
    definition.forces.extend::<Vec<Entry>>(loose);
    Cow::Owned(definition)
}

/// Reads a joint that acts as a force. The outer option is None if there is no such type.
pub(super) fn read(
    entry: &Entry,
    kind: &str,
    linker: &mut Linker<'_>,
) -> Option<Option<ForceElement<Tape>>> {
    if let Some(force) = ForceElement::read(Group::Joints, kind, linker) {
        return Some(force);
    }
    let joint = Constraint::read(Group::Joints, kind, linker)?;
    let loose = |joint: Constraint<Tape>| {
        let coordinate = linker.quantities.acted(&format!("{}.play", entry.name))?;
        let is_elastic = joint.strands().is_some_and(|own| own.stiffness.is_some());
        let (has_play, joint) = (joint.backlash().is_some(), Box::new(joint));
        Some(match has_play {
            true => ForceElement::Play(Play { joint, coordinate }),
            false => ForceElement::LooseBelt(LooseBelt { joint, coordinate, is_elastic }),
        })
    };
    Some(joint.and_then(loose))
}
