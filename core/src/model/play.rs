//! Joints with play. They are written as joints and act as forces, so that they follow the forces in a model.

use super::definition::{Definition, Entry, Value};
use super::link::Linker;
use crate::elements::forces::{Play, BACKLASH};
use crate::elements::{acts_as_force, catalogue, Acted, Constraint, Followed, ForceElement, Group};
use crate::expression::Tape;
use std::borrow::Cow;

/// Whether an entry is a joint with play.
pub(super) fn is_written(entry: &Entry) -> bool {
    let Some(Value::Text(kind)) = entry.get("type") else { return false };
    let given = !matches!(entry.get(BACKLASH), None | Some(Value::Number(0.0)));
    acts_as_force(kind)
        || given
            && catalogue().into_iter().any(|(group, table)| {
                let has_play = table.fields.iter().any(|field| field.name == BACKLASH);
                group == Group::Joints && table.name == kind && has_play
            })
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
    let with_play = |joint: Constraint<Tape>| {
        joint.backlash()?;
        let name = format!("{}.play", entry.name);
        let of = linker.quantities.followed(&name)?;
        let coordinate = match of {
            Followed::Coordinate(of) => of.into(),
            of => Acted { of, gradient: linker.quantities.gradient(&name)? },
        };
        Some(ForceElement::Play(Play { joint: Box::new(joint), coordinate }))
    };
    Some(joint.and_then(with_play))
}
