//! The model with drivers for values that are set or guessed.

use super::request::Request;
use super::target::{of_positions, Target};
use crate::elements::Followed;
use crate::expression::Tape;
use crate::math::Listed;
use crate::model::Model;
use std::sync::Arc;

/// Prefix of the name of a driver that holds a value of `set`. The name of the quantity follows.
pub(super) const SET: &str = "set ";

/// The model with a driver for each position that is set.
pub fn holding(model: &Model, request: &Request) -> Model {
    extended(model, of_positions(&request.set))
}

/// The model with a driver for each target. The targets are positions.
pub(super) fn extended<'a>(model: &Model, targets: impl Iterator<Item = &'a Target>) -> Model {
    let held: Vec<_> = targets.filter_map(|target| held(model, target, |_, x| x.into())).list();
    Model::new(&Arc::new(model.blueprint.holding(&held)), &model.parameters)
}

/// The driver for a target: its name, its quantity and its law.
pub(super) fn held(
    model: &Model,
    target: &Target,
    law: impl Fn(&Followed<Tape>, f64) -> Tape,
) -> Option<(String, Followed<Tape>, Tape)> {
    let (of, value) = target.followed()?;
    let law = law(&of, value);
    Some((format!("{}{}", SET, target.name(model)), of, law))
}
