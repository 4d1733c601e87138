//! Linking of the fields of an element: names become indices, text becomes formulas.

use super::definition::{Entry, Value};
use super::items::Body;
use super::problem::Problem;
use super::problems::MOST_REPORTED;
use super::scope::{LawOf, Quantities, Reach, Scope, ANY_UNIT};
use crate::elements::{
    measured_of, Acted, BodyId, Constraint, Coordinate, CoordinateOf, CurveOn, Default, Field,
    Followed, Group, JointId, Measured, PointOn, Source, UNITS_OF_EQUATIONS,
};
use crate::expression::{suggest, Tape};

/// A linked joint or driver.
type Named = (String, Group, Constraint<Tape>);

/// Reads the fields of one element.
pub struct Linker<'a> {
    group: Group,
    section: &'static str,
    entry: &'a Entry,
    scope: &'a Scope,
    bodies: &'a [Body<Tape>],
    constraints: &'a [Named],
    quantities: &'a dyn Quantities,
    /// Whether laws are read; they are zero if not.
    laws: bool,
    problems: &'a mut Vec<Problem>,
}

impl<'a> Linker<'a> {
    /// For an entry of a section.
    pub fn new(
        group: Group,
        entry: &'a Entry,
        scope: &'a Scope,
        (bodies, constraints): (&'a [Body<Tape>], &'a [Named]),
        quantities: &'a dyn Quantities,
        problems: &'a mut Vec<Problem>,
    ) -> Self {
        let section = group.section();
        Self { group, section, entry, scope, bodies, constraints, quantities, laws: true, problems }
    }

    /// For an entry without its laws: its quantities do not depend on them.
    pub fn of_numbers(
        group: Group,
        entry: &'a Entry,
        scope: &'a Scope,
        bodies: &'a [Body<Tape>],
        quantities: &'a dyn Quantities,
        problems: &'a mut Vec<Problem>,
    ) -> Self {
        let linked = (bodies, [].as_slice());
        Self { laws: false, ..Self::new(group, entry, scope, linked, quantities, problems) }
    }

    fn path(&self, field: &Field) -> [String; 3] {
        [self.section.to_string(), self.entry.name.clone(), field.name.to_string()]
    }

    fn report<T>(&mut self, field: &Field, message: String, hint: Option<String>) -> Option<T> {
        self.problems.push(Problem::at(&self.path(field), message).maybe_hint(hint));
        None
    }

    /// Whether the next problem is shown, so that a suggestion is worth its time.
    fn suggests(&self) -> bool {
        self.problems.len() < MOST_REPORTED
    }

    fn missing<T>(&mut self, field: &Field) -> Option<T> {
        let path = [self.section, &self.entry.name];
        self.problems.push(Problem::at(&path, format!("'{}' is missing", field.name)));
        None
    }

    fn text(&mut self, field: &Field) -> Option<&'a str> {
        match self.entry.get(field.name) {
            Some(Value::Text(text)) => Some(text),
            Some(other) => {
                let message = format!("must be a name, not {}", other.noun());
                self.report(field, message, None)
            }
            None => self.missing(field),
        }
    }

    /// A body by name, with a report that suggests one.
    fn find(&mut self, field: &Field, name: &str) -> Option<BodyId> {
        if let Some(k) = self.scope.body(name) {
            return Some(BodyId(k));
        }
        let body = name.split_once('.').map_or("", |(body, _)| body);
        if self.scope.body(body).is_some() {
            let message = format!("'{name}' is not a body, but a point of {body}");
            return self.report(field, message, Some(format!("write '{body}'")));
        }
        let hint = self.suggests().then(|| {
            let names: Vec<&str> = self.bodies.iter().map(|b| b.name.as_str()).collect();
            did_you_mean(name, &names, "bodies")
        });
        self.report(field, format!("unknown body '{name}'"), hint.flatten())
    }

    /// `body.word`, with the body looked up.
    fn split<'t>(&mut self, field: &Field, text: &'t str, form: &str) -> Option<(BodyId, &'t str)> {
        match text.rsplit_once('.') {
            Some((body, word)) => Some((self.find(field, body)?, word)),
            None => {
                let message = format!("'{text}' must have the form {form}");
                self.report(field, message, None)
            }
        }
    }

    /// The unit of a field; of two units, the first is for a length and the second for an angle as coordinate.
    fn unit(&self, field: &Field) -> String {
        let Some((first, other)) = field.unit.split_once('|') else { return field.unit.clone() };
        let unit =
            match (self.entry.get("coordinate"), self.entry.get("terms"), self.entry.get("unit")) {
                (_, _, Some(Value::Text(unit))) => unit,
                (Some(Value::Text(text)), ..) => self.unit_of(text).unwrap_or(ANY_UNIT),
                (_, Some(Value::Table(terms)), _) => {
                    terms.first().and_then(|(text, _)| self.unit_of(text)).unwrap_or(ANY_UNIT)
                }
                _ => ANY_UNIT,
            };
        match unit {
            "m" => first.to_string(),
            "rad" => other.to_string(),
            _ => ANY_UNIT.to_string(),
        }
    }

    fn unit_of(&self, quantity: &str) -> Option<&'static str> {
        let (owner, word) = quantity.rsplit_once('.')?;
        match self.scope.body(owner) {
            Some(_) => Coordinate::named(word).map(Coordinate::unit),
            None => self.quantities.followed(quantity).map(|followed| followed.label().1),
        }
    }

    /// Quantities of a force, which its laws may use without a name.
    fn own_quantities(&self) -> &'static [Measured] {
        match (self.group, self.entry.get("type")) {
            (Group::Forces, Some(Value::Text(kind))) => measured_of(kind),
            _ => &[],
        }
    }

    /// A position quantity by name.
    fn position(&mut self, field: &Field, text: &str) -> Option<Followed<Tape>> {
        let owner = text.rsplit_once('.').map_or("", |(owner, _)| owner);
        if self.scope.body(owner).is_none() {
            if let Some(offered) = self.quantities.offered(owner) {
                return self.quantity(field, text, &offered);
            }
        }
        let (body, name) = self.split(field, text, "body.x, body.y or body.angle")?;
        match Coordinate::named(name) {
            _ if body.is_ground() => self.report(field, "ground does not move".to_string(), None),
            Some(Coordinate::Angle) if !self.bodies[body.0].turns => {
                let message =
                    format!("{} is a point mass and has no angle", self.bodies[body.0].name);
                self.report(field, message, None)
            }
            Some(coordinate) if !coordinate.is_rate() => {
                Some(CoordinateOf { body, coordinate }.into())
            }
            _ => {
                let message = format!("'{name}' is not one of x, y, angle");
                let hint = did_you_mean(name, &["x", "y", "angle"], "coordinates");
                self.report(field, message, hint)
            }
        }
    }

    /// A position quantity of a point or an element, which offers some.
    fn quantity(&mut self, field: &Field, text: &str, offered: &[&str]) -> Option<Followed<Tape>> {
        let followed = self.quantities.followed(text);
        let moves = |of: &Followed<Tape>| of.bodies().iter().any(|body| !body.is_ground());
        match followed {
            Some(of) if moves(&of) => Some(of),
            Some(_) => self.report(field, format!("'{text}' does not move"), None),
            None => {
                let (owner, word) = text.rsplit_once('.').unwrap_or(("", text));
                let message = format!("'{word}' is not a position quantity of '{owner}'");
                let plural = format!("position quantities of {owner}");
                let hint = did_you_mean(word, offered, &plural);
                self.report(field, message, hint)
            }
        }
    }

    /// The symbols that a law may use.
    fn reach(&self) -> Reach {
        match self.group {
            Group::Forces => Reach::State,
            Group::Joints | Group::Drivers => Reach::Positions,
        }
    }

    /// A formula at a place within the entry.
    fn read(&mut self, value: &Value, path: &[String], unit: &str, reach: Reach) -> Option<Tape> {
        if reach != Reach::Parameters && !self.laws {
            return Some(Tape::from(0.0));
        }
        self.scope.law(value, path, unit, (reach, Some(self.place())), self.problems)
    }

    /// The quantities that the laws of the entry may use.
    fn place(&self) -> LawOf<'a> {
        let (element, own) = (self.entry.name.as_str(), self.own_quantities());
        LawOf { quantities: self.quantities, element, own }
    }

    fn two(&mut self, field: &Field, reach: Reach) -> Option<[Tape; 2]> {
        if reach != Reach::Parameters && !self.laws {
            return Some([0.0, 0.0].map(Tape::from));
        }
        match (self.entry.get(field.name), field.default) {
            (Some(value), _) => {
                let path = self.path(field);
                let place = (reach, Some(self.place()));
                self.scope.two(value, &path, &field.unit, place, self.problems)
            }
            (None, Some(Default::Pair(p))) => Some(p.map(Tape::from)),
            (None, _) => self.missing(field),
        }
    }

    fn formula(&mut self, field: &Field, reach: Reach) -> Option<Tape> {
        match (self.entry.get(field.name), field.default) {
            (Some(value), _) => {
                let path = self.path(field);
                let unit = self.unit(field);
                self.read(value, &path, &unit, reach)
            }
            (None, Some(Default::Number(x))) => Some(Tape::from(x)),
            (None, _) => self.missing(field),
        }
    }
}

/// "did you mean …", or the list of what there is.
pub fn did_you_mean(word: &str, known: &[&str], plural: &str) -> Option<String> {
    match suggest::closest(word, known.iter().copied()) {
        Some(best) => Some(format!("did you mean '{best}'?")),
        None if known.is_empty() => Some(format!("there are no {plural}")),
        None if known.len() <= 12 => Some(format!("the {plural} are: {}", known.join(", "))),
        None => None,
    }
}

impl Source for Linker<'_> {
    fn given(&mut self, field: &Field) -> bool {
        self.entry.get(field.name).is_some()
    }

    fn body(&mut self, field: &Field) -> Option<BodyId> {
        let name = match (self.entry.get(field.name), field.default) {
            (None, Some(Default::Body(name))) => name,
            _ => self.text(field)?,
        };
        self.find(field, name)
    }

    fn point(&mut self, field: &Field) -> Option<PointOn<Tape>> {
        let text = self.text(field)?;
        let (body, name) = self.split(field, text, "body.point")?;
        let owner = &self.bodies[body.0];
        if let Some(s) = owner.point(name) {
            return Some(PointOn { body, s: s.clone() });
        }
        if owner.lacks_points() {
            return None; // its own fault is reported
        }
        let hint = self.suggests().then(|| {
            let names: Vec<&str> = owner.points.iter().map(|(n, _)| n.as_str()).collect();
            did_you_mean(name, &names, &format!("points of {}", owner.name))
        });
        let message = format!("body '{}' has no point '{name}'", owner.name);
        self.report(field, message, hint.flatten())
    }

    fn curve(&mut self, field: &Field) -> Option<CurveOn<Tape>> {
        let text = self.text(field)?;
        let (body, name) = self.split(field, text, "body.curve")?;
        let owner = &self.bodies[body.0];
        if let Some((_, found)) = owner.curves.iter().find(|(own, _)| own == name) {
            // the fault of a faulty curve is reported at the curve
            return found.clone().map(|curve| CurveOn { body, curve });
        }
        let hint = self.suggests().then(|| {
            let names: Vec<&str> = owner.curves.iter().map(|(n, _)| n.as_str()).collect();
            match owner.point(name) {
                Some(_) => Some(format!("'{name}' is a point of {}", owner.name)),
                None => did_you_mean(name, &names, &format!("curves of {}", owner.name)),
            }
        });
        let message = format!("body '{}' has no curve '{name}'", owner.name);
        self.report(field, message, hint.flatten())
    }

    fn coordinate(&mut self, field: &Field) -> Option<Followed<Tape>> {
        let text = self.text(field)?;
        self.position(field, text)
    }

    fn acted(&mut self, field: &Field) -> Option<Acted<Tape>> {
        match self.coordinate(field)? {
            Followed::Coordinate(of) => Some(of.into()),
            Followed::Quantity(of) => {
                let gradient = self.quantities.gradient(&of.name)?;
                Some(Acted { of: Followed::Quantity(of), gradient })
            }
        }
    }

    fn joint(&mut self, field: &Field) -> Option<JointId> {
        let name = self.text(field)?;
        // a faulty constraint before it moves it from its written place
        let is_named = |k: &usize| self.constraints.get(*k).is_some_and(|(own, ..)| own == name);
        let written = self.scope.constraint(name).filter(is_named);
        if let Some(k) = written.or_else(|| (0..self.constraints.len()).find(is_named)) {
            return Some(JointId(k));
        }
        let hint = self.suggests().then(|| {
            let names: Vec<&str> = self.constraints.iter().map(|(own, ..)| own.as_str()).collect();
            did_you_mean(name, &names, "joints")
        });
        self.report(field, format!("unknown joint '{name}'"), hint.flatten())
    }

    fn number(&mut self, field: &Field) -> Option<Tape> {
        self.formula(field, Reach::Parameters)
    }

    fn law(&mut self, field: &Field) -> Option<Tape> {
        self.formula(field, self.reach())
    }

    fn pair(&mut self, field: &Field) -> Option<[Tape; 2]> {
        self.two(field, Reach::Parameters)
    }

    fn triple(&mut self, field: &Field) -> Option<[Tape; 3]> {
        let items = match (self.entry.get(field.name), field.default) {
            (Some(Value::List(items)), _) if items.len() == 3 => items,
            (Some(Value::List(items)), _) => {
                let message = format!("must hold three numbers, not {}", items.len());
                return self.report(field, message, None);
            }
            (Some(other), _) => {
                let message = format!("must be a list of three numbers, not {}", other.noun());
                return self.report(field, message, None);
            }
            (None, Some(Default::Triple(x))) => return Some(x.map(Tape::from)),
            (None, _) => return self.missing(field),
        };
        let units: Vec<&str> = field.unit.split(',').collect();
        let mut read = |k: usize| {
            let path: Vec<String> = self.path(field).into_iter().chain([k.to_string()]).collect();
            self.read(&items[k], &path, units.get(k).unwrap_or(&ANY_UNIT), Reach::Parameters)
        };
        let (x, y, z) = (read(0), read(1), read(2));
        Some([x?, y?, z?])
    }

    fn law_pair(&mut self, field: &Field) -> Option<[Tape; 2]> {
        self.two(field, self.reach())
    }

    fn laws(&mut self, field: &Field) -> Option<Vec<Tape>> {
        let items = match self.entry.get(field.name) {
            Some(Value::List(items)) => items,
            Some(other) => {
                let message = format!("must be a list of formulas, not {}", other.noun());
                return self.report(field, message, None);
            }
            None => return self.missing(field),
        };
        let (path, reach) = (self.path(field), self.reach());
        let read = |(k, item): (usize, &Value)| {
            let path: Vec<String> = path.iter().cloned().chain([k.to_string()]).collect();
            self.read(item, &path, &field.unit, reach)
        };
        // every formula is read, so that all errors are reported at once
        let all: Vec<Option<Tape>> = items.iter().enumerate().map(read).collect();
        all.into_iter().collect()
    }

    fn terms(&mut self, field: &Field) -> Option<Vec<(Followed<Tape>, Tape)>> {
        let items = match self.entry.get(field.name) {
            Some(Value::Table(items)) => items,
            Some(other) => {
                let message = format!("must be a table of quantities, not {}", other.noun());
                return self.report(field, message, None);
            }
            None => return self.missing(field),
        };
        let mut all = Vec::new();
        for (name, factor) in items {
            let path: Vec<String> = self.path(field).into_iter().chain([name.clone()]).collect();
            let of = self.position(field, name);
            let factor = self.read(factor, &path, ANY_UNIT, Reach::Parameters);
            all.push(of.zip(factor));
        }
        all.into_iter().collect()
    }

    fn units(&mut self, field: &Field) -> Option<Vec<&'static str>> {
        let items = match self.entry.get(field.name) {
            Some(Value::List(items)) => items,
            Some(other) => {
                let message = format!("must be a list of units, not {}", other.noun());
                return self.report(field, message, None);
            }
            None => return self.missing(field),
        };
        let known = |item: &Value| match item {
            Value::Text(unit) => UNITS_OF_EQUATIONS.iter().find(|known| *known == unit).copied(),
            _ => None,
        };
        match items.iter().map(known).collect::<Option<Vec<_>>>() {
            Some(units) => Some(units),
            None => self.report(field, "each must be \"m\" or \"rad\"".to_string(), None),
        }
    }

    fn flag(&mut self, field: &Field) -> Option<bool> {
        match (self.entry.get(field.name), field.default) {
            (Some(Value::Flag(flag)), _) => Some(*flag),
            (Some(other), _) => {
                let message = format!("must be true or false, not {}", other.noun());
                self.report(field, message, None)
            }
            (None, Some(Default::Flag(flag))) => Some(flag),
            (None, _) => self.missing(field),
        }
    }

    fn word(&mut self, field: &Field, words: &[&str]) -> Option<usize> {
        let word = match (self.entry.get(field.name), field.default) {
            (None, Some(Default::Body(word))) => word,
            _ => self.text(field)?,
        };
        let found = words.iter().position(|known| *known == word);
        found.or_else(|| {
            let hint = did_you_mean(word, words, "words");
            self.report(field, format!("unknown word '{word}'"), hint)
        })
    }
}
