//! Linking of the fields of an element: names become indices, and text becomes formulas.

use super::beam_names::is_inner;
use super::definition::{Entry, Value};
use super::items::Body;
use super::law_faults::WITHOUT_FORMULA;
use super::problem::Problem;
use super::problems::MOST_REPORTED;
use super::quantities::Quantities;
use super::scope::{LawOf, Reach, Scope};
use super::unit_check::ANY_UNIT;
use crate::elements::{
    measured_of, BodyId, Constraint, Coordinate, CoordinateOf, CurveOn, Default, Field, Followed,
    Group, Measured, PointOn, QuantityKind, Side,
};
use crate::expression::{suggest, Tape};
use crate::math::{Listed, ShortArray};

/// The unit of a field with the effort of a driver.
const EFFORT: &str = "N|N*m";

/// A linked joint or driver.
type Named = (String, Group, Constraint<Tape>);

/// A point or circle of a body and a curve of another, in place of written fields.
#[derive(Clone)]
pub(super) struct Pairing {
    pub point: PointOn<Tape>,
    pub curve: CurveOn<Tape>,
    pub side: Side,
    /// The radius of a circle; None for the written radius.
    pub radius: Option<Tape>,
    /// Added to the written radius.
    pub rounding: f64,
    /// A smooth curve that touches in place of the point, and its side.
    pub mate: Option<(CurveOn<Tape>, Side)>,
}

/// Reads the fields of one element.
pub struct Linker<'a> {
    pub(super) group: Group,
    pub(super) section: &'static str,
    pub(super) entry: &'a Entry,
    pub(super) scope: &'a Scope,
    pub(super) bodies: &'a [Body<Tape>],
    pub(super) constraints: &'a [Named],
    pub(super) quantities: &'a dyn Quantities,
    /// A point and a curve that take the place of the written ones.
    pub(super) pairing: Option<Pairing>,
    /// Whether laws are read. Otherwise they are zero.
    pub(super) laws: bool,
    pub(super) problems: &'a mut Vec<Problem>,
}

impl<'a> Linker<'a> {
    /// A linker for an entry of a section.
    pub fn new(
        group: Group,
        entry: &'a Entry,
        scope: &'a Scope,
        (bodies, constraints): (&'a [Body<Tape>], &'a [Named]),
        quantities: &'a dyn Quantities,
        problems: &'a mut Vec<Problem>,
    ) -> Self {
        let section = group.section();
        Self {
            group,
            section,
            entry,
            scope,
            bodies,
            constraints,
            quantities,
            pairing: None,
            laws: true,
            problems,
        }
    }

    /// A linker for an entry without its laws, because its quantities do not depend on them.
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

    pub(super) fn path(&self, field: &Field) -> [String; 3] {
        [self.section.to_string(), self.entry.name.clone(), field.name.to_string()]
    }

    pub(super) fn report<T>(
        &mut self,
        field: &Field,
        message: String,
        hint: Option<String>,
    ) -> Option<T> {
        self.problems.push(Problem::at(&self.path(field), message).maybe_hint(hint));
        None
    }

    /// Whether the next problem is shown. Only then is a suggestion computed.
    pub(super) fn suggests(&self) -> bool {
        self.problems.len() < MOST_REPORTED
    }

    pub(super) fn missing<T>(&mut self, field: &Field) -> Option<T> {
        let path = [self.section, &self.entry.name];
        self.problems.push(Problem::at(&path, format!("'{}' is missing", field.name)));
        None
    }

    pub(super) fn text(&mut self, field: &Field) -> Option<&'a str> {
        match self.entry.get(field.name) {
            Some(Value::Text(text)) => Some(text),
            Some(other) => {
                let message = format!("must be a name, not {}", other.noun());
                self.report(field, message, None)
            }
            None => self.missing(field),
        }
    }

    /// A body by name. Reports an unknown name with a suggestion.
    pub(super) fn find(&mut self, field: &Field, name: &str) -> Option<BodyId> {
        if let Some(k) = self.scope.body(name) {
            return Some(BodyId(k));
        }
        let body = name.split_once('.').map_or("", |(body, _)| body);
        if self.scope.body(body).is_some() {
            let message = format!("'{name}' is not a body, but a point of {body}");
            return self.report(field, message, Some(format!("write '{body}'")));
        }
        let hint = self.suggests().then(|| {
            let names = self.bodies.iter().map(|b| b.name.as_str());
            did_you_mean(name, &names.filter(|name| !is_inner(name)).list(), "bodies")
        });
        self.report(field, format!("unknown body '{name}'"), hint.flatten())
    }

    /// Splits `body.word` and looks up the body.
    pub(super) fn split<'t>(
        &mut self,
        field: &Field,
        text: &'t str,
        form: &str,
    ) -> Option<(BodyId, &'t str)> {
        match text.rsplit_once('.') {
            Some((body, word)) => Some((self.find(field, body)?, word)),
            None => {
                let message = format!("'{text}' must have the form {form}");
                self.report(field, message, None)
            }
        }
    }

    /// The unit of a field. If there are two units, the first is for a length and the second for an angle as
    /// coordinate.
    pub(super) fn unit(&self, field: &Field) -> String {
        let Some((first, other)) = field.unit.split_once('|') else { return field.unit.clone() };
        let kind =
            match (self.entry.get("coordinate"), self.entry.get("terms"), self.entry.get("unit")) {
                (_, _, Some(Value::Text(unit))) => QuantityKind::of_equation(unit),
                (Some(Value::Text(text)), ..) => self.kind_of(text),
                (_, Some(Value::Table(terms)), _) => {
                    terms.first().and_then(|(text, _)| self.kind_of(text))
                }
                _ => None,
            };
        let unit = match kind {
            Some(QuantityKind::Length) => first,
            Some(QuantityKind::Angle) => other,
            _ => ANY_UNIT,
        };
        unit.to_string()
    }

    /// The kind of a position quantity by name.
    fn kind_of(&self, quantity: &str) -> Option<QuantityKind> {
        let (owner, word) = quantity.rsplit_once('.')?;
        match self.scope.body(owner) {
            Some(_) => Coordinate::named(word).filter(|of| !of.is_rate()).map(Coordinate::kind),
            None => self.quantities.followed(quantity).map(|followed| followed.kind()),
        }
    }

    /// Quantities of a force, which its laws may use without a name.
    pub(super) fn own_quantities(&self) -> &'static [Measured] {
        match (self.group, self.entry.get("type")) {
            (Group::Forces, Some(Value::Text(kind))) => measured_of(kind),
            _ => &[],
        }
    }

    /// A curve by name. Reports an unknown name with a suggestion.
    pub(super) fn curve_named(&mut self, field: &Field, text: &str) -> Option<CurveOn<Tape>> {
        let (body, name) = self.split(field, text, "body.curve")?;
        let owner = &self.bodies[body.0];
        if let Some((_, found)) = owner.curves.iter().find(|(own, _)| own == name) {
            // the fault of a faulty curve is reported where the curve is defined
            return found.clone().map(|curve| CurveOn { body, curve });
        }
        let hint = self.suggests().then(|| {
            let names: Vec<&str> = owner.curves.iter().map(|(n, _)| n.as_str()).list();
            match owner.point(name) {
                Some(_) => Some(format!("'{name}' is a point of {}", owner.name)),
                None => did_you_mean(name, &names, &format!("curves of {}", owner.name)),
            }
        });
        let message = format!("body '{}' has no curve '{name}'", owner.name);
        self.report(field, message, hint.flatten())
    }

    /// A position quantity by name.
    pub(super) fn position(&mut self, field: &Field, text: &str) -> Option<Followed<Tape>> {
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
                let hint = match Coordinate::named(name) {
                    Some(rate) => Some(of_rate(owner, &[Coordinate::ALL[rate.column()].name()])),
                    None => did_you_mean(name, &["x", "y", "angle"], "coordinates"),
                };
                self.report(field, message, hint)
            }
        }
    }

    /// A position quantity of a point or an element.
    pub(super) fn quantity(
        &mut self,
        field: &Field,
        text: &str,
        offered: &[&str],
    ) -> Option<Followed<Tape>> {
        let followed = self.quantities.followed(text);
        let moves = |of: &Followed<Tape>| of.bodies().iter().any(|body| !body.is_ground());
        match followed {
            Some(of) if moves(&of) => Some(of),
            Some(_) => self.report(field, format!("'{text}' does not move"), None),
            None => {
                if let Some(message) = self.quantities.refusal(text) {
                    return self.report(field, message, Some(WITHOUT_FORMULA.to_string()));
                }
                let (owner, word) = text.rsplit_once('.').unwrap_or(("", text));
                let message = format!("'{word}' is not a position quantity of '{owner}'");
                let plural = format!("position quantities of {owner}");
                let hint = match self.quantities.formula(text, true) {
                    Some(_) => Some(of_rate(owner, offered)),
                    None => did_you_mean(word, offered, &plural),
                };
                self.report(field, message, hint)
            }
        }
    }

    /// The symbols that a law may use: an effort may depend on the whole state.
    pub(super) fn reach(&self, field: &Field) -> Reach {
        match self.group {
            Group::Drivers if field.unit == EFFORT => Reach::State,
            Group::Forces => Reach::State,
            Group::Joints | Group::Drivers => Reach::Positions,
        }
    }

    /// A formula at a path within the entry.
    pub(super) fn read(
        &mut self,
        value: &Value,
        path: &[String],
        unit: &str,
        reach: Reach,
    ) -> Option<Tape> {
        if reach != Reach::Parameters && !self.laws {
            return Some(Tape::from(0.0));
        }
        self.scope.law(value, path, unit, (reach, Some(self.place())), self.problems)
    }

    /// The quantities that the laws of the entry may use.
    pub(super) fn place(&self) -> LawOf<'a> {
        let (element, own) = (self.entry.name.as_str(), self.own_quantities());
        LawOf { quantities: self.quantities, element, own }
    }

    pub(super) fn two(&mut self, field: &Field, reach: Reach) -> Option<[Tape; 2]> {
        if reach != Reach::Parameters && !self.laws {
            return Some([0.0, 0.0].each(Tape::from));
        }
        match (self.entry.get(field.name), field.default) {
            (Some(value), _) => {
                let path = self.path(field);
                let place = (reach, Some(self.place()));
                self.scope.two(value, &path, &field.unit, place, self.problems)
            }
            (None, Some(Default::Pair(p))) => Some(p.each(Tape::from)),
            (None, _) => self.missing(field),
        }
    }

    pub(super) fn formula(&mut self, field: &Field, reach: Reach) -> Option<Tape> {
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

/// The hint where a position is needed in place of a rate.
fn of_rate(owner: &str, positions: &[&str]) -> String {
    let all = positions.iter().map(|word| format!("'{owner}.{word}'")).list().join(" or ");
    format!("a rate is given by its position: name {all}, and a law such as 2*t, whose rate is 2")
}

/// The text "did you mean …", or the list of all names.
pub fn did_you_mean(word: &str, known: &[&str], plural: &str) -> Option<String> {
    match suggest::closest(word, known.iter().copied()) {
        Some(best) => Some(format!("did you mean '{best}'?")),
        None if known.is_empty() => Some(format!("there are no {plural}")),
        None if known.len() <= 12 => Some(format!("the {plural} are: {}", known.join(", "))),
        None => None,
    }
}
