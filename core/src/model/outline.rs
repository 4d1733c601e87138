//! Outlines of bodies for drawings.

use crate::math::{Listed, Local};
use std::sync::Arc;

/// Number of corners of a drawn circle.
const OF_CIRCLE: usize = 96;

/// An outline, in the frame of the body, m. It is used only for drawings.
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
    /// The parts of a path. A path has no formulas.
    Path(Arc<[Drawn]>),
}

/// A line or an area of a drawing, in the frame of the body.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawn {
    /// Its points in order, m.
    pub points: Vec<Local>,
    /// The style in which the points are drawn.
    pub form: DrawnForm,
}

/// The style in which points are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DrawnForm {
    /// A closed edge. The areas of a body are filled together where their winding number is nonzero.
    Area,
    /// A rounded bar with the width of a link.
    Rod,
    /// A thin line.
    Line,
}

impl DrawnForm {
    /// The name of the style in a scene.
    pub fn name(self) -> &'static str {
        match self {
            Self::Area => "area",
            Self::Rod => "rod",
            Self::Line => "line",
        }
    }
}

impl<S> Outline<S> {
    /// Converts the outline to another scalar.
    pub fn map<T>(&self, f: &mut dyn FnMut(&S) -> T) -> Outline<T> {
        let mut local = |s: &Local<S>| Local { x: f(&s.x), y: f(&s.y) };
        match self {
            Self::Polygon(points) => Outline::Polygon(points.iter().map(local).list()),
            Self::Circle { center, radius } => {
                let center = local(center);
                Outline::Circle { center, radius: f(radius) }
            }
            Self::Path(parts) => Outline::Path(Arc::clone(parts)),
        }
    }
}

impl Outline {
    /// A key of the outline with an impossible value, and the reason for the fault.
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

    /// The lines and areas of the outline.
    pub(super) fn drawn(&self) -> Vec<Drawn> {
        let area = |points| vec![Drawn { points, form: DrawnForm::Area }];
        match self {
            Self::Polygon(points) => area(points.clone()),
            Self::Circle { center, radius } => {
                area(circle(*radius, false).into_iter().map(|s| *center + s).list())
            }
            Self::Path(parts) => parts.to_vec(),
        }
    }
}

/// The corners of a circle around the origin.
pub(super) fn circle(radius: f64, clockwise: bool) -> Vec<Local> {
    let turn = if clockwise { -std::f64::consts::TAU } else { std::f64::consts::TAU };
    let at = |k: usize| {
        let (sin, cos) = f64::sin_cos(turn * k as f64 / OF_CIRCLE as f64);
        Local::new(radius * cos, radius * sin)
    };
    (0..OF_CIRCLE).map(at).list()
}
