//! Points of circles, arcs and arrows.

use crate::plane::{ahead, direction, left_of, At};
use std::f64::consts::TAU;

/// Evenly spaced numbers, including both ends.
pub fn spread(first: f64, last: f64, count: usize) -> Vec<f64> {
    let step = (last - first) / (count.max(2) - 1) as f64;
    (0..count)
        .map(|k| if k + 1 == count && k > 0 { last } else { first + step * k as f64 })
        .collect()
}

/// Corners of a circle around the origin.
pub fn circle(radius: f64, count: usize) -> Vec<At> {
    arc(radius, 0.0, TAU * (1.0 - 1.0 / count as f64), count)
}

/// Points of an arc around the origin.
pub fn arc(radius: f64, begin: f64, end: f64, count: usize) -> Vec<At> {
    let point = |angle| direction(angle).map(|x| radius * x);
    spread(begin, end, count).into_iter().map(point).collect()
}

/// Corners of the head of an arrow.
pub fn arrow_head(tip: At, angle: f64, size: f64) -> [At; 3] {
    let along = direction(angle);
    let (back, aside) = (ahead(tip, -size, along), left_of(along));
    [tip, ahead(back, 0.36 * size, aside), ahead(back, -0.36 * size, aside)]
}
