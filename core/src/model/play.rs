//! Joints with play, and belts that are elastic or slip. They are written as joints and act as forces, so that they
//! follow the forces in a model.

use super::definition::{Definition, Entry, Value};
use super::link::Linker;
use crate::elements::forces::{LooseBelt, Play};
use crate::elements::{acts_as_force, catalogue, loose_fields, Constraint, ForceElement, Group};
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
        let is_elastic = joint.strands().is_some_and(|own| own.stiffness.is_some());
        let Some(coordinate) = linker.quantities.acted(&format!("{}.play", entry.name)) else {
            return if is_elastic { not_carried(kind, linker) } else { None };
        };
        let (has_play, joint) = (joint.backlash().is_some(), Box::new(joint));
        Some(match has_play {
            true => ForceElement::Play(Play { joint, coordinate }),
            false => ForceElement::LooseBelt(LooseBelt { joint, coordinate, is_elastic }),
        })
    };
    Some(joint.and_then(loose))
}

/// Reports an elastic belt whose wheels are not pinned on one body.
fn not_carried<T>(kind: &str, linker: &mut Linker<'_>) -> Option<T> {
    let table = catalogue().into_iter().find(|(_, table)| table.name == kind)?.1;
    let field = table.fields.iter().find(|field| field.name == "stiffness")?;
    let message =
        "an elastic belt needs both wheels on one body, from which their turns are counted"
            .to_string();
    let hint = "join the points i and j to that body, or to ground, by joints of type revolute";
    linker.report(field, message, Some(hint.to_string()))
}
