//! The scene as data.

use super::length::Length;
use super::mark::named;
use crate::plane::At;
use kempe::elements::Mark;
use serde::{Deserialize, Serialize};

/// The drawing of a model. Lengths are in m, angles in rad.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Scene {
    /// Title of the model.
    pub title: String,
    /// Acceleration of free fall, m/s².
    pub gravity: At,
    /// Smallest x and y, largest x and y over all instants.
    pub bounds: [f64; 4],
    /// The unit of lengths in the drawing.
    pub length: Length,
    /// Bodies, ground first.
    pub bodies: Vec<Body>,
    /// Joints, in the order of the model.
    pub joints: Vec<Joint>,
    /// Symbols of joints, drivers and forces, grouped by element.
    pub symbols: Vec<Symbol>,
}

/// A body, in its own frame.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Body {
    /// Its name.
    pub name: String,
    /// 0 for ground; moving bodies are counted from 1.
    pub number: usize,
    /// The `type` in the file, or "ground".
    pub kind: String,
    /// Named points.
    pub points: Vec<Point>,
    /// Mass centre.
    pub center: At,
    /// The link around its points: a spot, a line between two ends, or a convex polygon; empty for ground.
    pub outline: Vec<At>,
    /// The parts that are drawn instead of a link.
    pub drawn: Vec<Part>,
    /// Its curves.
    pub curves: Vec<Curve>,
}

/// A named point.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Point {
    /// Its name.
    pub name: String,
    /// Position of the point.
    pub at: At,
}

/// A line or an area of a body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Part {
    /// Style in which the part is drawn.
    pub form: PartForm,
    /// Its points in order.
    pub points: Vec<At>,
}

/// Style in which a part of a body is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum PartForm {
    /// A closed edge.
    Area,
    /// A rounded bar.
    Rod,
    /// A thin line.
    Line,
}

/// Points along a curve.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Curve {
    /// Points in the order of the curve.
    pub points: Vec<At>,
    /// Whether the last point is connected to the first.
    pub closed: bool,
}

/// A joint: the numbers of its bodies, and its point on each.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Joint {
    /// Its name.
    pub name: String,
    /// Bodies i and j.
    pub bodies: [usize; 2],
    /// The point in the frame of each body. If the joint has no point on body j, both are the point on body i.
    pub points: [At; 2],
}

/// A symbol between the bodies i and j.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Symbol {
    /// The name of its element.
    pub element: String,
    /// The mark that is drawn.
    #[serde(with = "named")]
    pub mark: Mark,
    /// Bodies i and j.
    pub bodies: [usize; 2],
    /// Points in the frames of the bodies. None on body i if the symbol is around its point on body j.
    pub points: [Option<At>; 2],
    /// Angles of the axis in the frames of the bodies.
    pub axes: [f64; 2],
    /// Radii around the points on i and j, for a symbol drawn to scale.
    pub radii: Option<[f64; 2]>,
    /// Pitch diameter per tooth, if the model defines it.
    #[serde(skip)]
    pub module: Option<f64>,
    /// The teeth of a wheel or rack.
    pub teeth: Option<Teeth>,
    /// Smallest and largest position along the axis, or distance between the points.
    pub reach: Option<[f64; 2]>,
    /// The angle from i to j at the first instant, and its largest deviation from this angle.
    pub turning: Option<[f64; 2]>,
    /// -1 if the largest torque is clockwise.
    pub sense: i8,
}

impl Symbol {
    /// The point on body j.
    pub fn at_j(&self) -> At {
        self.points[1].unwrap_or_default()
    }

    /// The point on body i, or the origin.
    pub fn at_i(&self) -> At {
        self.points[0].unwrap_or_default()
    }

    /// The radii, or zeros.
    pub fn radii(&self) -> [f64; 2] {
        self.radii.unwrap_or_default()
    }

    /// The reach, or zeros.
    pub fn reach(&self) -> [f64; 2] {
        self.reach.unwrap_or_default()
    }

    /// The points of the symbol with their bodies. Absent points are omitted.
    pub fn ends(&self) -> impl DoubleEndedIterator<Item = (usize, At)> + '_ {
        self.bodies.iter().zip(&self.points).filter_map(|(body, at)| at.map(|at| (*body, at)))
    }
}

/// The teeth of a drawn wheel or rack.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Teeth {
    /// Pitch diameter per tooth, m.
    pub module: f64,
    /// The position of a tooth: its angle in the frame of a wheel, or its distance along the axis of a rack.
    pub phase: f64,
}
