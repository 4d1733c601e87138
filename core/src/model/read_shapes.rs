//! Reads the shapes of a body from their definition.

use super::body_shape::{BodyShape, Form, Matter};
use super::definition::{Entry, Value};
use super::problem::Problem;
use super::scope::{Reach, Scope};
use super::shape_fields::section;
use crate::expression::Tape;
use crate::math::{each, Listed, Local};

/// The shapes of a body as formulas. Faulty shapes are omitted and reported.
pub(super) fn read(
    entry: &Entry,
    scope: &Scope,
    problems: &mut Vec<Problem>,
) -> Vec<BodyShape<Tape>> {
    let path = vec!["bodies".to_string(), entry.name.clone(), "shapes".to_string()];
    let items = match entry.get("shapes") {
        None => return Vec::new(),
        Some(Value::List(items)) if !items.is_empty() => items,
        Some(_) => {
            let message =
                "must be a list of shapes such as { type = \"disc\", radius = 1, mass = 1 }";
            problems.push(Problem::at(&path, message));
            return Vec::new();
        }
    };
    let one = |(k, item): (usize, &Value)| {
        let path: Vec<String> = path.iter().cloned().chain([k.to_string()]).list();
        let Value::Table(fields) = item else {
            let message = format!("shape {}: must be a table, not {}", k + 1, item.noun());
            problems.push(Problem::at(&path, message));
            return None;
        };
        Reader { fields, path, number: k + 1, scope, problems }.shape()
    };
    items.iter().enumerate().filter_map(one).list()
}

struct Reader<'a> {
    fields: &'a [(String, Value)],
    path: Vec<String>,
    /// Number of the shape, counted from 1.
    number: usize,
    scope: &'a Scope,
    problems: &'a mut Vec<Problem>,
}

impl<'a> Reader<'a> {
    fn shape(mut self) -> Option<BodyShape<Tape>> {
        let Some(Value::Text(kind)) = self.get("type") else {
            return self.report("type", "must be 'rod', 'plate', 'disc', 'ring' or 'polygon'");
        };
        // all faults of one shape are reported
        let (form, matter) = (self.form(kind), self.matter(kind));
        let at = match self.get("at") {
            None => Some([Tape::from(0.0), Tape::from(0.0)]),
            Some(value) => self.scope.pair(value, &self.at("at"), "m", self.problems),
        };
        let angle = match self.get("angle") {
            None => Some(Tape::from(0.0)),
            Some(_) => self.length("angle", "rad"),
        };
        let [x, y] = at?;
        Some(BodyShape { form: form?, at: Local { x, y }, angle: angle?, matter: matter? })
    }

    fn form(&mut self, kind: &str) -> Option<Form<Tape>> {
        let mut length = |key: &str| self.length(key, "m");
        Some(match kind {
            "rod" => Form::Rod { length: length("length")? },
            "disc" => Form::Disc { radius: length("radius")? },
            "plate" => {
                let (width, height) = (length("width"), length("height"));
                Form::Plate { width: width?, height: height? }
            }
            "ring" => {
                let (inner, outer) = (length("inner"), length("outer"));
                Form::Ring { inner: inner?, outer: outer? }
            }
            "polygon" => Form::Polygon { points: self.corners()? },
            _ => {
                let message = "must be 'rod', 'plate', 'disc', 'ring' or 'polygon'";
                return self.report("type", message);
            }
        })
    }

    fn corners(&mut self) -> Option<Vec<Local<Tape>>> {
        let Some(Value::List(items)) = self.get("points") else {
            return self.report("points", "must be a list of points [[x, y], …]");
        };
        if items.len() < 3 {
            let message = format!("{} points; a polygon has at least three", items.len());
            return self.report("points", &message);
        }
        corners(items, &self.at("points"), self.scope, self.problems)
    }

    /// The mass, or the density with an extent.
    fn matter(&mut self, kind: &str) -> Option<Matter<Tape>> {
        let other = section(kind);
        match each([self.get("mass"), self.get("density"), self.get(other)], |v| v.is_some()) {
            [true, true, _] => self.report("density", "given beside mass; remove mass or density"),
            [true, false, true] => {
                let message =
                    "has no effect beside mass; remove it, or give density instead of mass";
                self.report(other, message)
            }
            [true, false, false] => Some(Matter::Mass(self.length("mass", "kg")?)),
            [false, true, false] => {
                let message =
                    format!("needs {other}; add {other}, or give mass instead of density");
                self.report("density", &message)
            }
            [false, true, true] => {
                let unit = if other == "area" { "m^2" } else { "m" };
                let (density, section) =
                    (self.length("density", "kg/m^3"), self.length(other, unit));
                Some(Matter::Density { density: density?, section: section? })
            }
            [false, false, _] => {
                let message = format!("has no mass; give mass, or density and {other}");
                self.report("", &message)
            }
        }
    }

    fn length(&mut self, key: &str, unit: &str) -> Option<Tape> {
        let Some(value) = self.get(key) else {
            return self.report("", &format!("'{key}' is missing"));
        };
        self.scope.formula(value, &self.at(key), unit, Reach::Parameters, self.problems)
    }

    fn get(&self, key: &str) -> Option<&'a Value> {
        self.fields.iter().find(|(k, _)| k == key).map(|(_, value)| value)
    }

    fn at(&self, key: &str) -> Vec<String> {
        self.path.iter().cloned().chain((!key.is_empty()).then(|| key.to_string())).list()
    }

    /// Reports a fault with the number and the type of the shape.
    fn report<T>(&mut self, key: &str, message: &str) -> Option<T> {
        let kind = match self.get("type") {
            Some(Value::Text(kind)) => format!(" ({kind})"),
            _ => String::new(),
        };
        let words = format!("shape {}{kind}: {message}", self.number);
        self.problems.push(Problem::at(&self.at(key), words));
        None
    }
}

/// Points without names.
pub(super) fn corners(
    items: &[Value],
    path: &[String],
    scope: &Scope,
    problems: &mut Vec<Problem>,
) -> Option<Vec<Local<Tape>>> {
    let points: Vec<Option<[Tape; 2]>> = items
        .iter()
        .enumerate()
        .map(|(k, item)| {
            let path: Vec<String> = path.iter().cloned().chain([k.to_string()]).list();
            scope.pair(item, &path, "m", problems)
        })
        .list();
    points.into_iter().map(|p| p.map(|[x, y]| Local { x, y })).collect()
}
