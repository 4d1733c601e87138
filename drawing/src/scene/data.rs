//! The scene as data.

use super::length::Length;
use super::mark::Mark;
use crate::plane::At;
use serde::{Deserialize, Serialize};

/// What is drawn of a model. Lengths are in m, angles in rad.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Scene {
    /// Title of the model.
    pub title: String,
    /// Acceleration of free fall, m/s².
    pub gravity: At,
    /// Least x and y, largest x and y at all instants.
    pub bounds: [f64; 4],
    /// The unit of lengths in the drawing.
    pub length: Length,
    /// Ground first.
    pub bodies: Vec<Body>,
    /// In the order of the model.
    pub joints: Vec<Joint>,
    /// Marks of joints, drivers and forces; those of one element follow each other.
    pub symbols: Vec<Symbol>,
}

/// A body, in its own frame.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Body {
    /// Its name.
    pub name: String,
    /// 0 for ground; moving bodies count from 1.
    pub number: usize,
    /// The `type` in the file, or "ground".
    pub kind: String,
    /// Named points.
    pub points: Vec<Point>,
    /// Mass centre.
    pub center: At,
    /// The link around its points: a spot, a line between two ends, or a convex polygon; none for ground.
    pub outline: Vec<At>,
    /// What is drawn in place of a link.
    pub drawn: Vec<Part>,
    /// Its curves.
    pub curves: Vec<Curve>,
}

/// A named point.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Point {
    /// Its name.
    pub name: String,
    /// Its place.
    pub at: At,
}

/// A line or an area of a body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Part {
    /// How it is drawn.
    pub form: PartForm,
    /// Its points in order.
    pub points: Vec<At>,
}

/// How a part of a body is drawn.
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
    /// In the order of the curve.
    pub points: Vec<At>,
    /// Whether the last point is joined to the first.
    pub closed: bool,
}

/// A joint: the numbers of its bodies, and its point on each.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Joint {
    /// Its name.
    pub name: String,
    /// Bodies i and j.
    pub bodies: [usize; 2],
    /// In the frame of each. Both are that of body i where the joint has no point on body j.
    pub points: [At; 2],
}

/// A symbol between the bodies i and j.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Symbol {
    /// The name of its element.
    pub element: String,
    /// What is drawn.
    pub mark: Mark,
    /// Bodies i and j.
    pub bodies: [usize; 2],
    /// In the frame of each; none on body i where the symbol is around its point on body j.
    pub points: [Option<At>; 2],
    /// Angles of its axis in the frame of each.
    pub axes: [f64; 2],
    /// Around the points on i and j, of a symbol in the size of the mechanism.
    pub radii: Option<[f64; 2]>,
    /// Diameter of the pitch circle for each tooth, where the model gives it.
    #[serde(skip)]
    pub module: Option<f64>,
    /// The teeth of a wheel or rack.
    pub teeth: Option<Teeth>,
    /// Least and largest place along the axis, or distance of its points.
    pub reach: Option<[f64; 2]>,
    /// The angle from i to j at the first instant, and by how much it differs from that at most.
    pub turning: Option<[f64; 2]>,
    /// -1 where its largest torque is clockwise.
    pub sense: i8,
}

impl Symbol {
    /// Its point on body j.
    pub fn at_j(&self) -> At {
        self.points[1].unwrap_or_default()
    }

    /// Its point on body i, or the origin.
    pub fn at_i(&self) -> At {
        self.points[0].unwrap_or_default()
    }

    /// Its radii, or zeros.
    pub fn radii(&self) -> [f64; 2] {
        self.radii.unwrap_or_default()
    }

    /// Its reach, or zeros.
    pub fn reach(&self) -> [f64; 2] {
        self.reach.unwrap_or_default()
    }

    /// Its points with their bodies, without those that it does not have.
    pub fn ends(&self) -> impl DoubleEndedIterator<Item = (usize, At)> + '_ {
        self.bodies.iter().zip(&self.points).filter_map(|(body, at)| at.map(|at| (*body, at)))
    }
}

/// The teeth of a drawn wheel or rack.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Teeth {
    /// Diameter of the pitch circle for each tooth, m.
    pub module: f64,
    /// The place of a tooth: its angle in the frame of a wheel, or its distance along the axis of a rack.
    pub phase: f64,
}
