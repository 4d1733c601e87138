//! The elastic and the rigid form of linked beams in a blueprint.

use super::super::beam_names::beam_of;
use super::super::blueprint::Blueprint;
use super::super::items::Body;
use super::read::Linked;
use crate::elements::Group;
use crate::expression::Tape;
use crate::math::Listed;
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

/// The bodies of the rigid form: the first node of a beam has all its places.
pub fn rigid_bodies(bodies: &[Body<Tape>], beams: &[Linked]) -> Vec<Body<Tape>> {
    let mut bodies = bodies.iter().cloned().list();
    for beam in beams {
        let Some((weld, _)) = beam.welds.first() else { continue };
        let first = bodies.iter_mut().find(|body| body.name == beam_of(weld));
        first.into_iter().for_each(|first| first.points.clone_from(&beam.places));
    }
    bodies
}

/// Adds the welds of the rigid form.
pub fn weld(blueprint: &mut Blueprint, beams: &[Linked]) {
    let welds = beams.iter().flat_map(|beam| beam.welds.iter().cloned());
    let welds = welds.map(|(name, weld)| (name, Group::Joints, weld));
    Arc::make_mut(&mut blueprint.constraints).extend(welds);
}
