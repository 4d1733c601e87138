//! Reads the outline of a body from its definition.

use super::definition::{Entry, Value};
use super::outline::{Drawn, DrawnForm, Outline};
use super::problem::Problem;
use super::read_shapes::corners;
use super::scope::{Reach, Scope};
use super::svg_path;
use crate::expression::Tape;
use crate::math::{Listed, Local};

/// The outline of a body as formulas. None if it is absent or faulty; faults are reported.
pub(super) fn read(
    entry: &Entry,
    scope: &Scope,
    problems: &mut Vec<Problem>,
) -> Option<Outline<Tape>> {
    let path = ["bodies".to_string(), entry.name.clone(), "outline".to_string()];
    match entry.get("outline")? {
        Value::List(items) if items.len() < 3 => {
            let message = format!("{} points; a polygon has at least three", items.len());
            problems.push(Problem::at(&path, message));
            None
        }
        Value::List(items) => corners(items, &path, scope, problems).map(Outline::Polygon),
        Value::Table(fields) => match &fields[..] {
            [(key, value)] if key == "circle" => circle(value, &path, scope, problems),
            [(key, Value::Text(text))] if key == "path" => drawn(text, &path, problems),
            _ => refuse(&path, problems),
        },
        _ => refuse(&path, problems),
    }
}

fn refuse<T>(path: &[String], problems: &mut Vec<Problem>) -> Option<T> {
    let message =
        "must be a list of points [[x, y], …], { circle = [x, y, r] } or { path = \"M 0 0 L …\" }";
    problems.push(Problem::at(path, message));
    None
}

fn circle(
    value: &Value,
    path: &[String],
    scope: &Scope,
    problems: &mut Vec<Problem>,
) -> Option<Outline<Tape>> {
    let path: Vec<String> = path.iter().cloned().chain(["circle".to_string()]).list();
    let items = match value {
        Value::List(items) if items.len() == 3 => items,
        _ => {
            problems.push(Problem::at(&path, "must be a list of three numbers [x, y, r]"));
            return None;
        }
    };
    let mut number = |k: usize| {
        let path: Vec<String> = path.iter().cloned().chain([k.to_string()]).list();
        scope.formula(&items[k], &path, "m", Reach::Parameters, problems)
    };
    let (x, y, radius) = (number(0), number(1), number(2));
    Some(Outline::Circle { center: Local { x: x?, y: y? }, radius: radius? })
}

fn drawn(text: &str, path: &[String], problems: &mut Vec<Problem>) -> Option<Outline<Tape>> {
    match svg_path::parse(text) {
        Ok(parts) => {
            let parts = parts.into_iter().map(|part| Drawn {
                points: part.points,
                form: if part.closed { DrawnForm::Area } else { DrawnForm::Line },
            });
            Some(Outline::Path(parts.collect()))
        }
        Err(fault) => {
            let path: Vec<String> = path.iter().cloned().chain(["path".to_string()]).list();
            let message = format!(
                "{} (character {})",
                fault.message,
                text[..fault.span.start].chars().count() + 1
            );
            problems.push(Problem::at(&path, message).within(fault.span));
            None
        }
    }
}
