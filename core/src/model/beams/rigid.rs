//! The elastic and the rigid form of linked beams in a blueprint.

use super::super::blueprint::Blueprint;
use super::read::Linked;
use crate::elements::Group;
use std::sync::Arc;

/// Adds the elastic pieces and their locks to a blueprint.
pub fn connect(blueprint: &mut Blueprint, mut beams: Vec<Linked>) {
    let locks = beams.iter_mut().flat_map(|beam| std::mem::take(&mut beam.locks));
    let locks = locks.map(|(name, lock)| (name, Group::Joints, lock));
    Arc::make_mut(&mut blueprint.constraints).extend(locks);
    let pieces = beams.into_iter().flat_map(|beam| beam.pieces);
    let forces = pieces.map(|(name, element)| (name, &[][..], element));
    Arc::make_mut(&mut blueprint.forces).extend(forces);
}

/// Adds the welds of the rigid form.
pub fn weld(blueprint: &mut Blueprint, beams: &[Linked]) {
    let welds = beams.iter().flat_map(|beam| beam.welds.iter().cloned());
    let welds = welds.map(|(name, weld)| (name, Group::Joints, weld));
    Arc::make_mut(&mut blueprint.constraints).extend(welds);
}
