//! The scene of a model.

use super::bodies::{bodies, joints};
use super::bounds::{bounds, own_size};
use super::data::Scene;
use super::effort::Effort;
use super::length::Length;
use super::paths::Paths;
use super::symbols::symbols;
use crate::numbers::rounded;
use crate::plane::{Extent, Pose};
use kempe::model::Model;

/// Describes a model for drawing.
///
/// `poses` are x and y in m and the angle in rad of each moving body at one or more instants. Bounds and the reach of
/// symbols cover all instants. An arrow has the direction of the largest of its `efforts`. Without efforts, it has
/// the direction that its element declares.
pub fn scene(model: &Model, poses: &[Vec<Pose>], efforts: &[Effort]) -> Scene {
    let paths = Paths(poses);
    let (bodies, joints) = (bodies(model), joints(model));
    let symbols = symbols(model, paths, efforts);
    let around = bounds(paths, &bodies, &joints, &symbols);
    let around = around.unwrap_or(Extent { low: [-1.0; 2], high: [1.0; 2] });
    let positive = |size: &f64| *size > 0.0;
    let size = Some(own_size(&bodies, &joints)).filter(positive);
    let size = size.or(Some(around.size()).filter(positive)).unwrap_or(1.0);
    let ([left, bottom], [right, top]) = (around.low, around.high);
    Scene {
        title: model.blueprint.title.clone(),
        gravity: [model.gravity.x, model.gravity.y].map(rounded),
        bounds: [left, bottom, right, top].map(rounded),
        length: Length::fitting(size),
        bodies,
        joints,
        symbols,
    }
}
