//! The area of a drawing.

use super::data::{Body, Joint, Symbol};
use super::mark::{is_guide, is_wheel};
use super::paths::Paths;
use super::teeth::outer_radius;
use crate::plane::{ahead, direction, At, Extent};

/// Largest number of points of a curve that are considered.
const SOME: usize = 50;

/// The largest extent of a body, ground included, in its own frame, m.
///
/// It does not depend on the motion, so all drawings of a model have the same unit of length.
pub fn own_size(bodies: &[Body], joints: &[Joint]) -> f64 {
    let of_body = |body: &Body| {
        let mut extent = Extent::of(corners(body));
        let lines = body.curves.iter().map(|of| &of.points);
        lines
            .chain(body.drawn.iter().map(|of| &of.points))
            .flatten()
            .chain(on(joints, body.number))
            .for_each(|at| extent.include(*at, 0.0));
        extent.size()
    };
    bodies.iter().map(of_body).fold(0.0, f64::max)
}

/// The area over all instants.
pub fn bounds(
    paths: Paths<'_>,
    bodies: &[Body],
    joints: &[Joint],
    symbols: &[Symbol],
) -> Option<Extent> {
    let mut extent = Extent::NOTHING;
    let mut include = |body: usize, at: At, radius: f64| {
        paths.point(body, at).for_each(|place| extent.include(place, radius));
    };
    for body in bodies {
        corners(body).for_each(|at| include(body.number, at, 0.0));
        let lines = body.curves.iter().map(|of| &of.points);
        for points in lines.chain(body.drawn.iter().map(|of| &of.points)) {
            some(points).for_each(|at| include(body.number, at, 0.0));
        }
        if body.number == 0 {
            on(joints, 0).for_each(|at| include(0, *at, 0.0));
        } else {
            include(body.number, [0.0; 2], 0.0);
        }
    }
    for symbol in symbols {
        if is_wheel(symbol.mark) {
            include(symbol.bodies[1], symbol.at_j(), outer_radius(symbol));
        }
        if is_guide(symbol.mark) {
            let axis = direction(symbol.axes[0]);
            for along in symbol.reach() {
                include(symbol.bodies[0], ahead(symbol.at_i(), along, axis), 0.0);
            }
        }
    }
    let found = [extent.low, extent.high].concat();
    found.iter().all(|x| x.is_finite()).then_some(extent)
}

fn corners(body: &Body) -> impl Iterator<Item = At> + '_ {
    body.outline.iter().copied().chain(body.points.iter().map(|point| point.at))
}

/// The points of joints on a body.
fn on(joints: &[Joint], number: usize) -> impl Iterator<Item = &At> {
    let ends = joints.iter().flat_map(|joint| joint.bodies.iter().zip(&joint.points));
    ends.filter(move |(body, _)| **body == number).map(|(_, at)| at)
}

/// Some points along a curve, including the last point.
fn some(points: &[At]) -> impl Iterator<Item = At> + '_ {
    points.iter().step_by(points.len() / SOME + 1).chain(points.last()).copied()
}
