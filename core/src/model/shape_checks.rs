//! Checks of the sizes and masses of shapes.

use super::body_shape::{BodyShape, Form, Matter};
use super::items::Body;
use super::problem::Problem;
use crate::math::{Local, ShortArray};

/// The mass of a body is a rounding error below this fraction of the masses that are summed.
const ROUNDING: f64 = 1e-12;

/// Reports shapes without size, and shapes that together do not form a body.
pub(super) fn shapes(body: &Body, problems: &mut Vec<Problem>) {
    let before = problems.len();
    for (k, shape) in body.shapes.iter().enumerate() {
        let kind = shape.form.kind();
        for (key, message) in faults(shape) {
            let path = ["bodies", &body.name, "shapes", &k.to_string(), key].each(str::to_string);
            let message = format!("shape {} ({kind}): {message}", k + 1);
            problems.push(Problem::at(&path, message));
        }
    }
    if problems.len() > before {
        return; // consequences of a shape are not reported
    }
    let path = ["bodies", &body.name, "shapes"];
    let gross: f64 = body.shapes.iter().map(|shape| shape.weighed().mass.abs()).sum();
    let holes = "holes (negative masses)";
    let message = if body.mass <= ROUNDING * gross {
        let sum = format!("the masses of the shapes sum to {:.9} kg", body.mass);
        format!("{sum}; must be > 0, so make the {holes} lighter")
    } else if !(body.mass.is_finite() && body.inertia.is_finite()) {
        "their mass or moment of inertia is not finite; make them smaller".to_string()
    } else if body.inertia < 0.0 {
        let found = format!("the moment of inertia of the shapes is {:.9} kg·m²", body.inertia);
        format!("{found}; must not be negative, so place the {holes} within the other shapes")
    } else {
        return;
    };
    problems.push(Problem::at(&path, message));
}

/// Keys of a shape with impossible values, each with the reason for the fault.
fn faults(shape: &BodyShape) -> Vec<(&'static str, String)> {
    let mut found = Vec::new();
    let mut size = |key: &'static str, x: f64, unit: &str| {
        if !(x.is_finite() && x > 0.0) {
            found.push((key, format!("{x} {unit}; must be > 0")));
        }
    };
    match &shape.form {
        Form::Rod { length } => size("length", *length, "m"),
        Form::Plate { width, height } => {
            size("width", *width, "m");
            size("height", *height, "m");
        }
        Form::Disc { radius } => size("radius", *radius, "m"),
        Form::Ring { inner, outer } => {
            if !(inner.is_finite() && *inner >= 0.0) {
                found.push(("inner", format!("{inner} m; must not be negative")));
            }
            if !(outer.is_finite() && outer > inner) {
                found.push(("outer", format!("{outer} m; must be > inner, {inner} m")));
            }
        }
        Form::Polygon { points } => found.extend(polygon(points).map(|m| ("points", m))),
    }
    match shape.matter {
        Matter::Mass(mass) if !mass.is_finite() => {
            found.push(("mass", format!("{mass} kg; must be finite")));
        }
        Matter::Density { density, section } => {
            if !density.is_finite() {
                found.push(("density", format!("{density} kg/m^3; must be finite")));
            }
            if !(section.is_finite() && section > 0.0) {
                let (key, unit) = match shape.form {
                    Form::Rod { .. } => ("area", "m^2"),
                    _ => ("thickness", "m"),
                };
                let remedy = "a hole has a negative density";
                found.push((key, format!("{section} {unit}; must be > 0; {remedy}")));
            }
        }
        Matter::Mass(_) => {}
    }
    for (key, x) in [("at", shape.at.x), ("at", shape.at.y), ("angle", shape.angle)] {
        if !x.is_finite() {
            found.push((key, format!("{x}; must be finite")));
        }
    }
    found
}

fn polygon(points: &[Local]) -> Option<String> {
    if points.iter().any(|p| !(p.x.is_finite() && p.y.is_finite())) {
        return Some("a corner is not finite".to_string());
    }
    let side = |k: usize| (points[k], points[(k + 1) % points.len()]);
    for k in 0..points.len() {
        let (a, b) = side(k);
        if a == b {
            let next = (k + 1) % points.len() + 1;
            return Some(format!("corners {} and {next} coincide; remove one of them", k + 1));
        }
    }
    let extent = points.iter().map(|p| (*p - points[0]).norm()).fold(0.0, f64::max);
    let triangles = points.windows(2).map(|w| cross(points[0], w[0], w[1]).abs());
    if triangles.fold(0.0, f64::max) <= ROUNDING * extent * extent {
        return Some("its corners lie on one line; a polygon needs an area".to_string());
    }
    for k in 0..points.len() {
        for other in k + 2..points.len() {
            let neighbours = k == 0 && other == points.len() - 1;
            if !neighbours && cross_each_other(side(k), side(other)) {
                let message = format!(
                    "its sides {} and {} cross; write the corners in their order along the edge",
                    named(k, points.len()),
                    named(other, points.len())
                );
                return Some(message);
            }
        }
    }
    None
}

/// The numbers of the ends of a side, such as "1-2".
fn named(side: usize, count: usize) -> String {
    format!("{}-{}", side + 1, (side + 1) % count + 1)
}

/// Twice the area of the triangle a, b, c. Positive if c is to the left of the line from a to b.
fn cross(a: Local, b: Local, c: Local) -> f64 {
    (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)
}

/// Whether two sides without a common corner have a point in common.
fn cross_each_other((a, b): (Local, Local), (c, d): (Local, Local)) -> bool {
    let [abc, abd, cda, cdb] = [cross(a, b, c), cross(a, b, d), cross(c, d, a), cross(c, d, b)];
    let within = |p: Local, q: Local, s: Local| {
        let between = |u: f64, v: f64, w: f64| u.min(v) <= w && w <= u.max(v);
        between(p.x, q.x, s.x) && between(p.y, q.y, s.y)
    };
    ((abc > 0.0) != (abd > 0.0)
        && (cda > 0.0) != (cdb > 0.0)
        && abc * abd != 0.0
        && cda * cdb != 0.0)
        || (abc == 0.0 && within(a, b, c))
        || (abd == 0.0 && within(a, b, d))
        || (cda == 0.0 && within(c, d, a))
        || (cdb == 0.0 && within(c, d, b))
}
