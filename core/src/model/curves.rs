//! Reads the curves of a body from their definition.

use super::definition::{Entry, Value};
use super::problem::Problem;
use super::scope::{Reach, Scope};
use crate::elements::{Curve, CurveFormula, CurvePoints, Polygon, CURVE_FORMS};
use crate::expression::{FormulaValues, Tape};
use crate::math::{Interpolation, Listed, Local, ShortArray};

/// Curves by name. A faulty curve is None, and its fault is reported.
pub type Curves<S> = Vec<(String, Option<Curve<S>>)>;

/// The curves of a body as formulas.
pub(super) fn read(entry: &Entry, scope: &Scope, problems: &mut Vec<Problem>) -> Curves<Tape> {
    let Some(Value::Table(written)) = entry.get("curves") else { return Vec::new() };
    let one = |(name, value): &(String, Value)| {
        let path = vec!["bodies".into(), entry.name.clone(), "curves".into(), name.clone()];
        let Value::Table(fields) = value else {
            let message =
                format!("must be a table such as {{ circle = [0, 0, 1] }}, not {}", value.noun());
            problems.push(Problem::at(&path, message));
            return (name.clone(), None);
        };
        let curve = Reader { fields, path, scope, problems: &mut *problems }.curve();
        (name.clone(), curve)
    };
    written.iter().map(one).list()
}

struct Reader<'a> {
    fields: &'a [(String, Value)],
    path: Vec<String>,
    scope: &'a Scope,
    problems: &'a mut Vec<Problem>,
}

impl<'a> Reader<'a> {
    fn curve(mut self) -> Option<Curve<Tape>> {
        let form = self.form()?;
        match form {
            "x" => self.components(),
            "polar" => self.polar(),
            "points" => self.points(),
            "polygon" => self.polygon(),
            "circle" => {
                let [x, y, radius] = self.numbers::<3>("circle")?;
                Some(Curve::Circle { center: Local { x, y }, radius })
            }
            _ => {
                let written = self.get("line")?;
                let [from, to] = self.ends("line", written)?;
                Some(Curve::Line { from, to })
            }
        }
    }

    /// The key of the form. Exactly one form must be given.
    fn form(&mut self) -> Option<&'static str> {
        let given = |form: &[&str]| form.iter().any(|key| self.get(key).is_some());
        let forms: Vec<_> = CURVE_FORMS.iter().filter(|form| given(form.keys)).list();
        match forms[..] {
            [form] => {
                let other = |key: &str| !form.keys.contains(&key) && !form.more.contains(&key);
                if let Some((key, _)) = self.fields.iter().find(|(key, _)| other(key)) {
                    let message = format!("'{key}' does not belong to a curve of {}", form.words);
                    return self.report(Some(key), message);
                }
                for key in form.keys {
                    if self.get(key).is_none() {
                        return self.report(None, format!("'{key}' is missing"));
                    }
                }
                Some(form.keys[0])
            }
            [] => {
                let words: Vec<&str> = CURVE_FORMS.iter().map(|form| form.words).list();
                self.report(None, format!("a curve needs one of: {}", words.join("; ")))
            }
            [first, second, ..] => {
                let message =
                    format!("both {} and {} are given; keep one", first.words, second.words);
                self.report(None, message)
            }
        }
    }

    fn components(&mut self) -> Option<Curve<Tape>> {
        let (x, y) = (self.formula("x")?, self.formula("y")?);
        let range = self.numbers::<2>("range")?;
        let periodic = self.periodic()?;
        Some(Curve::Formula(CurveFormula::new(x, y, range, periodic)))
    }

    fn polar(&mut self) -> Option<Curve<Tape>> {
        self.formula("polar")?; // its own faults have their places
        let r = match self.get("polar")? {
            Value::Number(r) => format!("({r:?})"),
            Value::Text(r) => format!("({r})"),
            _ => return None,
        };
        let mut part = |function: &str| {
            let text = Value::Text(format!("{r}*{function}(u)"));
            let path = self.at("polar");
            self.scope.formula(
                &text,
                &path,
                super::unit_check::ANY_UNIT,
                Reach::Curve,
                self.problems,
            )
        };
        let (x, y) = (part("cos")?, part("sin")?);
        let range = [0.0, std::f64::consts::TAU].each(Tape::from);
        Some(Curve::Formula(CurveFormula::new(x, y, range, true).polar()))
    }

    /// The written list of points; None if one of them is faulty.
    fn list(&mut self, key: &str) -> Option<Vec<Local<Tape>>> {
        let Value::List(items) = self.get(key)? else {
            return self.report(Some(key), "must be a list of points [[x, y], …]".to_string());
        };
        let mut points = Vec::new();
        for (k, item) in items.iter().enumerate() {
            let path: Vec<String> = self.at(key).into_iter().chain([k.to_string()]).list();
            points.extend(self.scope.pair(item, &path, "m", self.problems));
        }
        (points.len() == items.len())
            .then(|| points.into_iter().map(|[x, y]| Local { x, y }).list())
    }

    /// A polygon, whose corners are numbers, because they determine the convex parts.
    fn polygon(&mut self) -> Option<Curve<Tape>> {
        let corners = self.list("polygon")?;
        if corners.len() < 3 {
            let message = format!("has {} corners; must have at least three", corners.len());
            return self.report(Some("polygon"), message);
        }
        let varies = |s: &Local<Tape>| !(s.x.symbols().is_empty() && s.y.symbols().is_empty());
        if let Some(k) = corners.iter().position(varies) {
            let message = format!(
                "corner {} depends on a parameter; the corners of a polygon must be numbers; for a \
                 sweep over its shape, make a case for each",
                k + 1
            );
            return self.report(Some("polygon"), message);
        }
        let values = FormulaValues { parameters: &[], time: f64::NAN, variables: &[] };
        let of = |s: &Local<Tape>| Local::new(s.x.evaluate(&values), s.y.evaluate(&values));
        Some(Curve::Polygon(Polygon::new(&corners.iter().map(of).list())))
    }

    fn points(&mut self) -> Option<Curve<Tape>> {
        let listed = self.list("points");
        let kind = match self.get("interpolation") {
            None => Interpolation::Quintic,
            Some(Value::Text(word)) if Interpolation::named(word).is_some() => {
                Interpolation::named(word)?
            }
            Some(_) => {
                let known = Interpolation::ALL.each(Interpolation::name).join(", ");
                return self.report(Some("interpolation"), format!("must be one of {known}"));
            }
        };
        let (periodic, points) = (self.periodic()?, listed?);
        // a periodic curve repeats its first point at its end
        let least = kind.least(periodic) - usize::from(periodic);
        if points.len() < least {
            let message = format!("has {} points; must have at least {least}", points.len());
            return self.report(Some("points"), message);
        }
        Some(Curve::Points(CurvePoints::new(points, kind, periodic)))
    }

    fn ends(&mut self, key: &str, written: &Value) -> Option<[Local<Tape>; 2]> {
        let Value::List(items) = written else {
            return self.report(Some(key), "must be two points [[x, y], [x, y]]".to_string());
        };
        let [from, to] = &items[..] else {
            return self.report(Some(key), format!("has {} points; must have two", items.len()));
        };
        let mut at = |k: usize, item: &Value| {
            let path: Vec<String> = self.at(key).into_iter().chain([k.to_string()]).list();
            self.scope.pair(item, &path, "m", self.problems).map(|[x, y]| Local { x, y })
        };
        let (from, to) = (at(0, from), at(1, to));
        Some([from?, to?])
    }

    /// A formula of u and the parameters.
    fn formula(&mut self, key: &str) -> Option<Tape> {
        if self.scope.parameters.iter().any(|name| name == "u") {
            let message =
                "u is the parameter of the curve, but the model has a parameter 'u'; rename it";
            return self.report(Some(key), message.to_string());
        }
        let value = self.get(key)?;
        self.scope.formula(value, &self.at(key), "m", Reach::Curve, self.problems)
    }

    /// A list of N numbers.
    fn numbers<const N: usize>(&mut self, key: &str) -> Option<[Tape; N]> {
        let Value::List(items) = self.get(key)? else {
            return self.report(Some(key), format!("must be a list of {N} numbers"));
        };
        if items.len() != N {
            return self.report(Some(key), format!("holds {} numbers; must hold {N}", items.len()));
        }
        let unit = if key == "range" { super::unit_check::ANY_UNIT } else { "m" };
        let mut tapes = Vec::new();
        for (k, item) in items.iter().enumerate() {
            let path: Vec<String> = self.at(key).into_iter().chain([k.to_string()]).list();
            tapes.extend(self.scope.formula(item, &path, unit, Reach::Parameters, self.problems));
        }
        tapes.try_into().ok()
    }

    fn periodic(&mut self) -> Option<bool> {
        match self.get("periodic") {
            None => Some(false),
            Some(Value::Flag(flag)) => Some(*flag),
            Some(_) => self.report(Some("periodic"), "must be true or false".to_string()),
        }
    }

    fn get(&self, key: &str) -> Option<&'a Value> {
        self.fields.iter().find(|(k, _)| k == key).map(|(_, value)| value)
    }

    fn at(&self, key: &str) -> Vec<String> {
        self.path.iter().cloned().chain([key.to_string()]).list()
    }

    fn report<T>(&mut self, key: Option<&str>, message: String) -> Option<T> {
        let path = key.map_or_else(|| self.path.clone(), |key| self.at(key));
        self.problems.push(Problem::at(&path, message));
        None
    }
}
