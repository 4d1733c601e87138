//! The drawing of a body that replaces the link around its points.

use super::body_shape::{BodyShape, Form};
use super::items::Body;
use super::outline::{circle, Drawn, DrawnForm};
use crate::math::{each, Listed, Local};

impl Body {
    /// The drawing that replaces the link: the outline of the body, otherwise its shapes, otherwise an empty drawing.
    pub fn drawn(&self) -> Vec<Drawn> {
        match &self.outline {
            Some(outline) => outline.drawn(),
            None => self.shapes.iter().flat_map(shape).list(),
        }
    }
}

/// The edges of a shape, counter-clockwise; edges of holes are clockwise. A rod without mass is not drawn.
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
            vec![each([(-x, -y), (x, -y), (x, y), (-x, y)], corner).to_vec()]
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
        Drawn { points: edge.into_iter().map(|s| shape.place(s)).list(), form }
    });
    placed.list()
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
