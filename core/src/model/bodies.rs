//! Reads bodies from their definition: the general body, the uniform slender bar, and ground.
//!
//! A bar is shorthand for a general body whose numbers are formulas of the numbers of the bar, such as J = m L²/12.
//! No other file needs to handle bars.

use super::beam_names::is_beam;
use super::beams;
use super::body_fields::{INSTEAD_OF_SHAPES, POINT_MASS};
use super::body_reader::{term, Reader};
use super::definition::{Definition, Entry, Value};
use super::items::Body;
use super::problem::Problem;
use super::scope::Scope;
use crate::elements::BodyId;
use crate::expression::Tape;
use crate::math::{Listed, Local, ShortArray};

/// Reads all bodies, with index 0 for ground, and the beams among them. A faulty body is kept with placeholder
/// numbers, so that references to it cause no further reports. `values` are those of the parameters.
pub fn read(
    definition: &Definition,
    scope: &Scope,
    values: &[f64],
    problems: &mut Vec<Problem>,
) -> (Vec<Body<Tape>>, Vec<beams::Linked>) {
    let ground = Entry { name: "ground".to_string(), fields: Vec::new() };
    let written = definition.bodies.iter().find(|b| b.name == "ground").unwrap_or(&ground);
    let mut bodies = vec![Reader { entry: written, scope, values, problems }.ground()];
    let mut linked = Vec::new();
    for entry in definition.bodies.iter().filter(|b| b.name != "ground") {
        let mut reader = Reader { entry, scope, values, problems };
        if is_beam(entry) {
            let mut beam = beams::read(&mut reader, BodyId(bodies.len()));
            bodies.append(&mut beam.bodies);
            linked.push(beam);
        } else {
            bodies.push(reader.moving());
        }
    }
    (bodies, linked)
}

/// A named point with two coordinates, as text.
struct WrittenPoint {
    name: String,
    x: String,
    y: String,
}

impl Reader<'_> {
    fn ground(&mut self) -> Body<Tape> {
        let points = self.points();
        Body { points, ..self.blank("ground") }
    }

    fn moving(&mut self) -> Body<Tape> {
        match self.entry.get("type") {
            Some(Value::Text(kind)) if kind == "bar" => self.bar(),
            Some(Value::Text(kind)) if kind == "body" => self.general(),
            Some(Value::Text(kind)) if kind == POINT_MASS => self.point_mass(),
            None => self.general(),
            _ => {
                self.report("type", "must be 'body', 'bar', 'beam' or 'point_mass'");
                self.blank("body")
            }
        }
    }

    fn point_mass(&mut self) -> Body<Tape> {
        let mut body = self.blank(POINT_MASS);
        let zero = || Tape::from(0.0);
        body.mass = self.number("mass", "kg").unwrap_or(body.mass);
        body.inertia = zero();
        body.points.push(("P".to_string(), Local { x: zero(), y: zero() }));
        if let Some(value) = self.entry.get("at") {
            let at = self.scope.pair(value, &self.path("at"), "m", self.problems);
            body.drawn = at.map(|[x, y]| [x, y, zero()]);
        }
        body
    }

    fn general(&mut self) -> Body<Tape> {
        let mut body = self.blank("body");
        match self.entry.get("shapes") {
            Some(_) => self.of_shapes(&mut body),
            None => self.as_given(&mut body),
        }
        body.points = self.points();
        if self.entry.get("through").is_some() {
            let through = self.written("through");
            self.place(&mut body, &through);
        }
        body
    }

    /// Mass, inertia and mass centre as they are written.
    fn as_given(&mut self, body: &mut Body<Tape>) {
        body.mass = self.number("mass", "kg").unwrap_or(body.mass.clone());
        body.inertia = self.number("inertia", "kg*m^2").unwrap_or(body.inertia.clone());
        if let Some(value) = self.entry.get("center") {
            let path = self.path("center");
            if let Some([x, y]) = self.scope.pair(value, &path, "m", self.problems) {
                body.center = Local { x, y };
            }
        }
    }

    /// Replaces mass, inertia and mass centre by shapes.
    fn of_shapes(&mut self, body: &mut Body<Tape>) {
        body.shapes = super::read_shapes::read(self.entry, self.scope, self.problems);
        for key in INSTEAD_OF_SHAPES {
            if self.entry.get(key).is_some() {
                let message = format!(
                    "given beside shapes, which determine it; remove {key}, or remove shapes"
                );
                self.report(key, &message);
            }
        }
    }

    /// A uniform slender bar: its frame is at its centre with x along the bar, and J = m L²/12.
    fn bar(&mut self) -> Body<Tape> {
        let mut body = self.blank("bar");
        let mass = self.number("mass", "kg");
        let through = self.written("through");
        let stand_in = "1".to_string(); // so that references to its points are not reported as well
        let length = match (self.entry.get("length"), through.as_slice()) {
            (Some(value), _) => self.number("length", "m").map_or(stand_in, |_| term(value)),
            (None, [a, b, ..]) => distance(a, b),
            (None, [_]) => stand_in, // `place` reports it
            (None, []) if self.entry.get("through").is_some() => stand_in,
            (None, []) => {
                self.missing("a bar needs 'length' and 'ends', or 'through' with two points");
                stand_in
            }
        };
        if let (Some(mass), Some(written)) = (mass, self.entry.get("mass")) {
            body.mass = mass;
            body.inertia = self.compose(&format!("{}*{length}^2/12", term(written)));
        }
        let ends = self.ends(&through);
        for (name, sign) in ends.iter().zip(["-", ""]) {
            let x = self.compose(&format!("{sign}{length}/2"));
            body.points.push((name.clone(), Local { x, y: Tape::from(0.0) }));
        }
        if self.entry.get("through").is_some() {
            self.place(&mut body, &through); // its ends come first
        }
        for (name, s) in self.points() {
            match body.points.iter_mut().find(|(known, _)| *known == name) {
                Some((_, known)) => *known = s,
                None => body.points.push((name, s)),
            }
        }
        body
    }

    fn ends(&mut self, through: &[WrittenPoint]) -> Vec<String> {
        match self.entry.get("ends") {
            Some(Value::List(items)) => {
                let names: Vec<String> = items.iter().filter_map(text).list();
                if names.len() != 2 || items.len() != 2 || names[0] == names[1] {
                    self.report("ends", "must name two different points, such as [\"A\", \"B\"]");
                    return unknown();
                }
                names
            }
            Some(_) => {
                self.report("ends", "must be a list of two names, such as [\"A\", \"B\"]");
                unknown()
            }
            None if through.len() >= 2 => Vec::new(), // `place` names them
            None if self.entry.get("through").is_some() => unknown(),
            None if self.entry.get("length").is_none() => unknown(), // reported with the length
            None => {
                self.missing(
                    "'ends' is missing: the names of the two ends, such as [\"A\", \"B\"]",
                );
                unknown()
            }
        }
    }

    /// Places a body where it was drawn: the origin midway between the first two points, and the x axis from the
    /// first to the second. Every drawn point becomes a point of the body.
    fn place(&mut self, body: &mut Body<Tape>, through: &[WrittenPoint]) {
        let [a, b, ..] = through else {
            self.report("through", "needs at least two points");
            body.points.push((String::new(), Local { x: Tape::from(1.0), y: Tape::from(0.0) }));
            return;
        };
        let (mx, my) = (format!("({}+{})/2", a.x, b.x), format!("({}+{})/2", a.y, b.y));
        let (dx, dy) = (format!("({}-{})", b.x, a.x), format!("({}-{})", b.y, a.y));
        let length = distance(a, b);
        let drawn = [mx.clone(), my.clone(), format!("atan2({dy},{dx})")];
        body.drawn = Some(drawn.each(|text| self.compose(&text)));
        for p in through {
            if body.points.iter().any(|(name, _)| *name == p.name) {
                continue;
            }
            let (px, py) = (format!("({}-({mx}))", p.x), format!("({}-({my}))", p.y));
            let x = self.compose(&format!("({px}*{dx}+{py}*{dy})/{length}"));
            let y = self.compose(&format!("({dx}*{py}-{dy}*{px})/{length}"));
            body.points.push((p.name.clone(), Local { x, y }));
        }
    }

    /// The points as formulas.
    fn points(&mut self) -> Vec<(String, Local<Tape>)> {
        let written = self.written("points");
        let local = |w: WrittenPoint, this: &mut Self| {
            let (x, y) = (this.compose(&w.x), this.compose(&w.y));
            (w.name, Local { x, y })
        };
        written.into_iter().map(|w| local(w, self)).list()
    }

    /// A table of points as text. It is checked here, so that formulas composed of it cannot fail.
    fn written(&mut self, key: &str) -> Vec<WrittenPoint> {
        let mut points = Vec::new();
        let items = match self.entry.get(key) {
            None => return points,
            Some(Value::Table(items)) => items,
            Some(other) => {
                let form = "{ A = [0, 0], B = [1, 0] }";
                self.report(key, &format!("must be a table such as {form}, not {}", other.noun()));
                return points;
            }
        };
        for (name, value) in items {
            let path: Vec<String> = self.path(key).into_iter().chain([name.clone()]).list();
            let (x, y) = match (self.scope.pair(value, &path, "m", self.problems), value) {
                (Some(_), Value::List(xy)) => (term(&xy[0]), term(&xy[1])),
                // a placeholder that differs from the other points
                _ => (points.len().to_string(), "0".to_string()),
            };
            points.push(WrittenPoint { name: name.clone(), x, y });
        }
        points
    }
}

/// Placeholders for the ends of a bar, so that references to its points cause no further reports.
fn unknown() -> Vec<String> {
    vec![String::new(), String::new()]
}

fn text(value: &Value) -> Option<String> {
    match value {
        Value::Text(text) => Some(text.clone()),
        _ => None,
    }
}

fn distance(a: &WrittenPoint, b: &WrittenPoint) -> String {
    format!("hypot({}-{},{}-{})", b.x, a.x, b.y, a.y)
}
