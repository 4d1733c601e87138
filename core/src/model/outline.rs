//! What is drawn of a body in place of a link around its points.

use super::body_shape::{BodyShape, Form};
use super::items::Body;
use crate::math::Local;
use std::sync::Arc;

/// Corners of a drawn circle.
const OF_CIRCLE: usize = 96;

/// An outline, in the frame of the body, m. It has no influence on any number.
#[derive(Clone, Debug)]
pub enum Outline<S = f64> {
    /// A polygon.
    Polygon(Vec<Local<S>>),
    /// A circle.
    Circle {
        /// Its centre.
        center: Local<S>,
        /// Its radius.
        radius: S,
    },
    /// The parts of a path, which has no formulas.
    Path(Arc<[Drawn]>),
}

/// A line or an area of a drawing, in the frame of the body.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawn {
    /// Its points in order, m.
    pub points: Vec<Local>,
    /// How it is drawn.
    pub form: DrawnForm,
}

/// How points are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DrawnForm {
    /// A closed edge. Areas of a body are filled together where their winding number is not 0.
    Area,
    /// A rounded bar of the width of a link.
    Rod,
    /// A thin line.
    Line,
}

impl DrawnForm {
    /// Its name in a scene.
    pub fn name(self) -> &'static str {
        match self {
            Self::Area => "area",
            Self::Rod => "rod",
            Self::Line => "line",
        }
    }
}

impl<S> Outline<S> {
    /// The same outline over another scalar.
    pub fn map<T>(&self, f: &mut dyn FnMut(&S) -> T) -> Outline<T> {
        let mut local = |s: &Local<S>| Local { x: f(&s.x), y: f(&s.y) };
        match self {
            Self::Polygon(points) => Outline::Polygon(points.iter().map(local).collect()),
            Self::Circle { center, radius } => {
                let center = local(center);
                Outline::Circle { center, radius: f(radius) }
            }
            Self::Path(parts) => Outline::Path(Arc::clone(parts)),
        }
    }
}

impl Outline {
    /// A key of the outline with an impossible value, and the reason.
    pub(super) fn fault(&self) -> Option<(&'static str, String)> {
        let finite = |s: &Local| s.x.is_finite() && s.y.is_finite();
        match self {
            Self::Polygon(points) if !points.iter().all(finite) => {
                Some(("", "a corner is not finite".to_string()))
            }
            Self::Circle { center, radius } => {
                let message = match (finite(center), radius.is_finite() && *radius > 0.0) {
                    (false, _) => "its centre is not finite".to_string(),
                    (_, false) => format!("its radius is {radius} m; must be > 0"),
                    _ => return None,
                };
                Some(("circle", message))
            }
            _ => None,
        }
    }

    fn drawn(&self) -> Vec<Drawn> {
        let area = |points| vec![Drawn { points, form: DrawnForm::Area }];
        match self {
            Self::Polygon(points) => area(points.clone()),
            Self::Circle { center, radius } => {
                area(circle(*radius, false).into_iter().map(|s| *center + s).collect())
            }
            Self::Path(parts) => parts.to_vec(),
        }
    }
}

impl Body {
    /// What is drawn in place of a link: the outline, else the shapes, else nothing.
    pub fn drawn(&self) -> Vec<Drawn> {
        match &self.outline {
            Some(outline) => outline.drawn(),
            None => self.shapes.iter().flat_map(shape).collect(),
        }
    }
}

/// The edges of a shape: counter-clockwise, those of holes clockwise. A rod without mass is not drawn.
fn shape(shape: &BodyShape) -> Vec<Drawn> {
    let hole = shape.weighed().mass < 0.0;
    let edges = match &shape.form {
        Form::Rod { .. } if hole => Vec::new(),
        Form::Rod { length } => {
            vec![vec![Local::new(-length / 2.0, 0.0), Local::new(length / 2.0, 0.0)]]
        }
        Form::Plate { width, height } => {
            let (x, y) = (width / 2.0, height / 2.0);
            let corner = |(x, y): (f64, f64)| Local::new(x, y);
            vec![[(-x, -y), (x, -y), (x, y), (-x, y)].map(corner).to_vec()]
        }
        Form::Disc { radius } => vec![circle(*radius, false)],
        Form::Ring { inner, outer } if *inner > 0.0 => {
            vec![circle(*outer, false), circle(*inner, true)]
        }
        Form::Ring { outer, .. } => vec![circle(*outer, false)],
        Form::Polygon { points } => vec![counter_clockwise(points)],
    };
    let form = if let Form::Rod { .. } = shape.form { DrawnForm::Rod } else { DrawnForm::Area };
    let placed = edges.into_iter().map(|mut edge| {
        if hole {
            edge.reverse();
        }
        Drawn { points: edge.into_iter().map(|s| shape.place(s)).collect(), form }
    });
    placed.collect()
}

fn circle(radius: f64, clockwise: bool) -> Vec<Local> {
    let turn = if clockwise { -std::f64::consts::TAU } else { std::f64::consts::TAU };
    let at = |k: usize| {
        let (sin, cos) = f64::sin_cos(turn * k as f64 / OF_CIRCLE as f64);
        Local::new(radius * cos, radius * sin)
    };
    (0..OF_CIRCLE).map(at).collect()
}

fn counter_clockwise(points: &[Local]) -> Vec<Local> {
    let sides = points.iter().zip(points.iter().cycle().skip(1));
    let first = points[0];
    let twice: f64 = sides
        .map(|(a, b)| (a.x - first.x) * (b.y - first.y) - (b.x - first.x) * (a.y - first.y))
        .sum();
    let mut points = points.to_vec();
    if twice < 0.0 {
        points.reverse();
    }
    points
}
