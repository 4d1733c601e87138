//! Forces that depend on a reaction that is not unique, such as friction in one of two pins on the same axis.

use super::failure::{Failure, Reason};
use crate::analyses::uniqueness::not_unique;
use crate::model::Model;

/// Refuses a force that depends on the reaction of a joint that repeats others.
///
/// # Errors
/// [`Failure`] with [`Reason::Redundant`], which names the force, the joint and the joints that it repeats.
pub(super) fn check(model: &Model, t: f64, q: &[f64]) -> Result<(), Box<Failure>> {
    if !model.allow_redundancy || model.forces.iter().all(|item| item.reaction.is_none()) {
        return Ok(());
    }
    let shared = not_unique(model, t, q).all();
    for item in &model.forces {
        let Some(joint) = item.reaction.map(|joint| joint.0).filter(|k| shared.contains(k)) else {
            continue;
        };
        let name = &model.constraints[joint].name;
        let others = shared.iter().filter(|k| **k != joint);
        let others = model.names_of(others);
        let message = format!(
            "{} '{}' depends on the reaction of joint {name}, which is not unique: {name} and {} carry the same load",
            item.element.kind(),
            item.name,
            others.join(", ")
        );
        let hint = "give the friction its load, or remove the joints that repeat others";
        return Err(Reason::Redundant { t, name: name.clone(), message, hint }.into());
    }
    Ok(())
}
