//! Positions of the items of a display list at one instant. Only this file converts metres to points.
//!
//! The painters use the same rules: `python/kempe/draw/placing.py` and `studio/src/draw/place.ts`.

use super::items::{Frame, Item, Row};
use crate::plane::{direction, minus, placed, size, At, Pose};
use serde::{Deserialize, Serialize};

/// Margin around a mechanism, as a fraction of its size.
const ROOM: f64 = 0.14;

/// The visible part of the plane.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct View {
    /// Smallest x and y, m.
    pub low: At,
    /// Points of print per metre.
    pub scale: f64,
    /// Width and height, points of print.
    pub size: At,
}

impl View {
    /// The view of bounds with a margin, on an area in points of print.
    pub fn around([left, bottom, right, top]: [f64; 4], size: At) -> Self {
        let (middle, span) =
            ([(left + right) / 2.0, (bottom + top) / 2.0], [right - left, top - bottom]);
        let largest = span[0].max(span[1]);
        let room = ROOM * if largest > 0.0 { largest } else { 1.0 };
        let aspect = size[0] / size[1];
        let height = (span[1] + 2.0 * room).max((span[0] + 2.0 * room) / aspect);
        let low = [middle[0] - aspect * height / 2.0, middle[1] - height / 2.0];
        Self { low, scale: size[1] / height, size }
    }

    /// Converts a position in the plane, m, to points of print from the lower left corner.
    pub fn points(&self, at: At) -> At {
        minus(at, self.low).map(|x| x * self.scale)
    }

    /// Converts points of print to a position in the plane, m.
    pub fn plane(&self, [x, y]: At) -> At {
        [x / self.scale + self.low[0], y / self.scale + self.low[1]]
    }
}

/// The points of an item in points of print, for the poses of all bodies, ground first.
pub fn place(item: &Item, poses: &[Pose], view: &View) -> Vec<At> {
    let (origin, angle, local) = in_frame(&item.frame, &item.points, poses, view);
    let [c, s] = direction(angle);
    let turned = |[x, y]: At| [origin[0] + c * x - s * y, origin[1] + s * x + c * y];
    local.into_iter().map(turned).collect()
}

/// Origin and angle of a frame, and the rows in it, points of print.
fn in_frame(frame: &Frame, rows: &[Row], poses: &[Pose], view: &View) -> (At, f64, Vec<At>) {
    let pose = |body: usize| poses.get(body).copied().unwrap_or_default();
    match frame {
        Frame::Body { body, at, turns_with, turn } => {
            let local = rows.iter().map(|r| [r[0] * view.scale + r[2], r[1] * view.scale + r[3]]);
            let origin = view.points(placed(pose(*body), *at));
            (origin, pose(*turns_with)[2] + turn, local.collect())
        }
        Frame::Line { bodies, ends, room } => {
            let ends = [0, 1].map(|k| view.points(placed(pose(bodies[k]), ends[k])));
            let length = size(minus(ends[1], ends[0]));
            let squeezed = if *room > 0.0 { (length / room).min(1.0) } else { 1.0 };
            along(ends, length, squeezed, rows, view)
        }
        Frame::Ray { bodies, ends } => {
            let ends = [0, 1].map(|k| view.points(placed(pose(bodies[k]), ends[k])));
            along(ends, view.scale, 1.0, rows, view)
        }
        Frame::Twist { bodies: [i, j], at, turn } => {
            let turn = turn + pose(*j)[2] - pose(*i)[2];
            let local = rows.iter().map(|r| direction(pose(*i)[2] + r[0] * turn).map(|x| r[2] * x));
            (view.points(placed(pose(*j), *at)), 0.0, local.collect())
        }
    }
}

/// A frame from the first of two places towards the second.
fn along(
    [begin, end]: [At; 2],
    unit: f64,
    squeezed: f64,
    rows: &[Row],
    view: &View,
) -> (At, f64, Vec<At>) {
    let [x, y] = minus(end, begin);
    let local = rows.iter().map(|r| [r[0] * unit + r[2] * squeezed, r[1] * view.scale + r[3]]);
    (begin, y.atan2(x), local.collect())
}
