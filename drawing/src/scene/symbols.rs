//! Symbols of a model with their geometry: reach, position and sense.

use super::bodies::pair;
use super::data::Symbol;
use super::effort::Effort;
use super::mark::is_guide;
use super::paths::{range, Paths};
use super::teeth::add_teeth;
use crate::numbers::rounded;
use crate::plane::{direction, dot, left_of, minus, placed, size, At, Pose};
use kempe::elements::{Mark, SceneSymbol};
use kempe::model::Model;
use std::f64::consts::PI;

/// The largest speed of a driver at rest, m/s or rad/s: a rounding error.
const AT_REST: f64 = 1e-9;

type Found<'a> = Vec<(&'a str, Vec<SceneSymbol>)>;

/// Marks of joints, drivers and forces, with their points on two bodies.
///
/// A mark without points is drawn around the joint between its two bodies; without such a joint, at the mass centre
/// of body j.
pub fn symbols(model: &Model, paths: Paths<'_>, efforts: &[Effort]) -> Vec<Symbol> {
    let all = model.symbols();
    let each = all.iter().flat_map(|(name, own)| own.iter().map(move |one| (*name, one)));
    let mut found: Vec<Symbol> = each
        .map(|(name, of)| {
            let effort = efforts.iter().find(|effort| effort.element == name);
            symbol(model, &all, name, of, paths, effort)
        })
        .collect();
    add_teeth(&mut found, paths);
    found
}

fn symbol(
    model: &Model,
    all: &Found<'_>,
    element: &str,
    of: &SceneSymbol,
    paths: Paths<'_>,
    effort: Option<&Effort>,
) -> Symbol {
    let bodies = [of.i.body.0, of.j.body.0];
    let at_j = of.j.point.as_ref().map_or_else(|| pivot(model, all, bodies), pair);
    let mut found = Symbol {
        element: element.to_string(),
        mark: of.mark,
        bodies,
        points: [of.i.point.as_ref().map(pair), Some(at_j)],
        axes: [of.i.axis, of.j.axis],
        radii: of.radii,
        module: of.module,
        teeth: None,
        reach: None,
        turning: None,
        sense: 1,
    };
    match found.mark {
        _ if found.points[0].is_none() => found.turning = Some(turning(paths, bodies)),
        mark if is_guide(mark) => found.reach = Some(range(along(paths, &found).map(|at| at[0]))),
        Mark::OpenStrands | Mark::CrossedStrands | Mark::Cylinder | Mark::DriveCylinder => {
            found.reach = Some(range(apart(paths, &found).map(size)));
        }
        Mark::Face => found.reach = Some(touched(model, paths, &found)),
        Mark::ShiftStop => found.points[0] = Some(stopped(paths, &found)),
        _ => {}
    }
    match (found.mark, effort) {
        (Mark::ForceArrow, Some(effort)) => found.axes[0] = pushing(paths, &found, &effort.force),
        (Mark::TorqueArrow, Some(effort)) => found.sense = sign(&effort.torque, 0.0),
        (Mark::DriveTurn, Some(effort)) => found.sense = sign(&effort.torque, AT_REST),
        (Mark::DriveShift, Some(effort)) if against(paths, &found, &effort.force) => {
            found.axes[0] += PI;
        }
        _ => {}
    }
    found
}

/// The angle from i to j at the first instant, and its largest deviation from this angle.
fn turning(paths: Paths<'_>, bodies: [usize; 2]) -> [f64; 2] {
    let turns: Vec<f64> = paths.both(bodies).map(|[i, j]| j[2] - i[2]).collect();
    let first = turns.first().copied().unwrap_or(0.0);
    let most = turns.iter().fold(0.0, |most: f64, turn| most.max((turn - first).abs()));
    [first, most]
}

/// The vector from the point on i to the point on j, at each instant.
fn apart<'a>(paths: Paths<'a>, of: &Symbol) -> impl Iterator<Item = At> + use<'a> {
    let (at_i, at_j) = (of.at_i(), of.at_j());
    paths.both(of.bodies).map(move |[i, j]| minus(placed(j, at_j), placed(i, at_i)))
}

/// The position of the point on j, along the axis of i and to its left, relative to the point on i.
fn along<'a>(paths: Paths<'a>, of: &Symbol) -> impl Iterator<Item = At> + use<'a> {
    let axis = of.axes[0];
    let away = apart(paths, of).zip(paths.of(of.bodies[0]));
    away.map(move |(away, i)| in_axes(i, axis, away))
}

/// Components of a global vector along an axis of a body and to its left.
fn in_axes(body: Pose, axis: f64, vector: At) -> At {
    let u = direction(body[2] + axis);
    [dot(vector, u), dot(vector, left_of(u))]
}

/// The position on body i of a stop, next to the closest position of the point on j.
fn stopped(paths: Paths<'_>, of: &Symbol) -> At {
    let mut nearest = [f64::NEG_INFINITY, 0.0];
    for place in along(paths, of) {
        if place[0] > nearest[0] {
            nearest = place;
        }
    }
    let (at, aside) = (of.at_i(), left_of(direction(of.axes[0])));
    [at[0] + nearest[1] * aside[0], at[1] + nearest[1] * aside[1]].map(rounded)
}

/// Smallest and largest position of the contact along a face of i, relative to the point on i, m.
fn touched(model: &Model, paths: Paths<'_>, of: &Symbol) -> [f64; 2] {
    let item = model.constraints.iter().find(|item| item.name == of.element);
    let Some(on) = item.and_then(|item| item.element.curve()) else { return [0.0; 2] };
    let points: Vec<At> = on.curve.drawn().iter().map(pair).collect();
    let (at_i, axis) = (of.at_i(), of.axes[0]);
    range(paths.both(of.bodies).map(|[i, j]| {
        let from = placed(i, at_i);
        let places = points.iter().map(|at| in_axes(i, axis, minus(placed(j, *at), from)));
        let nearest = places.min_by(|a, b| a[1].abs().total_cmp(&b[1].abs()));
        nearest.map_or(0.0, |place| place[0])
    }))
}

/// The point on body j of the joint with body i, or the mass centre of body j.
fn pivot(model: &Model, all: &Found<'_>, [i, j]: [usize; 2]) -> At {
    let shared = all.iter().flat_map(|(_, own)| own).find_map(|other| {
        let ends = [&other.i, &other.j];
        let bodies = ends.map(|end| end.body.0);
        let same = bodies == [i, j] || bodies == [j, i];
        // if both ends are on one body, the second end is used
        let end = ends.into_iter().rev().find(|end| end.body.0 == j)?;
        let known = i == j || ends.iter().all(|end| end.point.is_some());
        end.point.as_ref().filter(|_| same && known).map(pair)
    });
    shared.unwrap_or_else(|| pair(&model.bodies[j].center))
}

/// The direction of a force in the frame of body i when its magnitude is largest, rad.
fn pushing(paths: Paths<'_>, of: &Symbol, forces: &[At]) -> f64 {
    let mut largest = (0.0, of.axes[0]);
    for (&[x, y], i) in forces.iter().zip(paths.of(of.bodies[0])) {
        let strength = size([x, y]);
        if strength > largest.0 {
            let turned = y.atan2(x) - i[2];
            largest = (strength, turned.sin().atan2(turned.cos()));
        }
    }
    largest.1
}

/// Whether velocities are opposite to the axis of i where they are largest along it.
fn against(paths: Paths<'_>, of: &Symbol, velocities: &[At]) -> bool {
    let axis = of.axes[0];
    let along = velocities.iter().zip(paths.of(of.bodies[0]));
    let along: Vec<f64> = along.map(|(velocity, i)| in_axes(i, axis, *velocity)[0]).collect();
    sign(&along, AT_REST) < 0
}

/// The sign of the value with the largest magnitude; positive if this magnitude is at most `least`.
fn sign(values: &[f64], least: f64) -> i8 {
    let mut most = 0.0_f64;
    for &value in values {
        if value.abs() > most.abs() {
            most = value;
        }
    }
    if most < -least {
        -1
    } else {
        1
    }
}
