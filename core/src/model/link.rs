//! Linking of the text of fields: names become indices, text becomes formulas.

use super::body_fields::POINT_MASS;
use super::definition::{Definition, Entry, Value};
use super::items::Body;
use super::problem::Problem;
use super::problems::MOST_REPORTED;
use super::variable::Variable;
use crate::elements::{
    states_of, BodyId, Constraint, Coordinate, CoordinateOf, Default, Field, Group, JointId, OwnState, PointOn,
    Source,
};
use crate::expression::unit::Unit;
use crate::expression::{suggest, Expression, ExpressionError, Names, Symbol, Tape};
use std::collections::HashMap;

/// The names that formulas may use.
#[derive(Clone, Debug, Default)]
pub struct Scope {
    /// Parameters, in order.
    pub parameters: Vec<String>,
    /// Bodies, each with whether it has an angle; index 0 is ground.
    pub bodies: Vec<(String, bool)>,
    /// First-order states of elements, such as `motor.current`, in the order of z.
    pub states: Vec<String>,
    places: Places,
}

/// The places of names, so that a name is found at once in a large model.
#[derive(Clone, Debug, Default)]
struct Places {
    parameters: HashMap<String, usize>,
    bodies: HashMap<String, usize>,
    states: HashMap<String, usize>,
    /// Joints and drivers as they are written.
    constraints: HashMap<String, usize>,
}

/// The first place of each name.
fn places<'n>(names: impl Iterator<Item = &'n String>) -> HashMap<String, usize> {
    let mut places = HashMap::new();
    names.enumerate().for_each(|(k, name)| _ = places.entry(name.clone()).or_insert(k));
    places
}

/// The first-order states of a force as written.
pub(super) fn states(entry: &Entry) -> &'static [OwnState] {
    let Some(Value::Text(kind)) = entry.get("type") else { return &[] };
    let given = |field: &str| entry.get(field).is_some_and(|value| *value != Value::Number(0.0));
    states_of(kind, &given)
}

/// How much a formula may depend on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reach {
    /// Parameters only.
    Parameters,
    /// Parameters, time and positions: laws of constraints, which must be holonomic.
    Positions,
    /// Parameters, time and state.
    State,
}

/// The names of a scope within reach, and whether unknown names get a suggestion.
struct Visible<'a>(&'a Scope, Reach, bool);

impl Names for Visible<'_> {
    fn resolve(&self, name: &str) -> Option<Symbol> {
        let scope = self.0;
        if let Some(&k) = scope.places.parameters.get(name) {
            return Some(Symbol::Parameter(k));
        }
        if self.1 == Reach::Parameters {
            return None;
        }
        if name == "t" {
            return Some(Symbol::Time);
        }
        let variable = |variable: Variable| Some(Symbol::Variable(variable.index()));
        if let Some(&k) = scope.places.states.get(name) {
            return variable(Variable::State(k)).filter(|_| self.1 == Reach::State);
        }
        let (body, coordinate) = name.rsplit_once('.')?;
        let body = scope.body(body).filter(|k| *k > 0)?;
        let coordinate = Coordinate::named(coordinate).filter(|c| self.sees(body, *c))?;
        variable(Variable::Coordinate(BodyId(body), coordinate))
    }

    fn known(&self) -> Vec<String> {
        if !self.2 {
            return Vec::new();
        }
        let mut known = self.0.parameters.clone();
        if self.1 == Reach::Parameters {
            return known;
        }
        known.push("t".to_string());
        for (k, (body, _)) in self.0.bodies.iter().enumerate().skip(1) {
            let coordinates = Coordinate::ALL.into_iter().filter(|c| self.sees(k, *c));
            known.extend(coordinates.map(|c| format!("{body}.{}", c.name())));
        }
        if self.1 == Reach::State {
            known.extend(self.0.states.iter().cloned());
        }
        known
    }
}

impl Visible<'_> {
    /// Whether a formula may use a coordinate of a body.
    fn sees(&self, body: usize, coordinate: Coordinate) -> bool {
        let has = coordinate.column() < 2 || self.0.bodies[body].1;
        has && (self.1 == Reach::State || !coordinate.is_rate())
    }
}

impl Scope {
    /// The names of a definition.
    pub fn new(definition: &Definition) -> Self {
        let turns = |b: &Entry| b.get("type") != Some(&Value::Text(POINT_MASS.to_string()));
        let moving = definition.bodies.iter().filter(|b| b.name != "ground");
        let states = definition.forces.iter().flat_map(|entry| {
            let names = states(entry).iter();
            names.map(move |state| format!("{}.{}", entry.name, state.name))
        });
        let bodies = std::iter::once(("ground".to_string(), true))
            .chain(moving.map(|b| (b.name.clone(), turns(b))))
            .collect();
        let parameters = definition.parameters.iter().map(|(name, _)| name.clone()).collect();
        let mut scope = Self::of(parameters, bodies, states.collect());
        let constraints = definition.joints.iter().chain(&definition.drivers);
        scope.places.constraints = places(constraints.map(|entry| &entry.name));
        scope
    }

    fn of(parameters: Vec<String>, bodies: Vec<(String, bool)>, states: Vec<String>) -> Self {
        let places = Places {
            parameters: places(parameters.iter()),
            bodies: places(bodies.iter().map(|(name, _)| name)),
            states: places(states.iter()),
            constraints: HashMap::new(),
        };
        Self { parameters, bodies, states, places }
    }

    /// The place of a body, ground first.
    pub fn body(&self, name: &str) -> Option<usize> {
        self.places.bodies.get(name).copied()
    }

    /// Only the parameters.
    pub fn of_parameters(parameters: &[String]) -> Self {
        Self::of(parameters.to_vec(), vec![("ground".to_string(), true)], Vec::new())
    }

    /// A formula from a number or a text; reports a fault at `path`.
    pub fn formula(
        &self,
        value: &Value,
        path: &[String],
        unit: &str,
        reach: Reach,
        problems: &mut Vec<Problem>,
    ) -> Option<Tape> {
        let text = match value {
            Value::Number(x) if x.is_finite() => return Some(Tape::from(*x)),
            Value::Number(x) => {
                problems.push(Problem::at(path, format!("{x} is not a number to compute with")));
                return None;
            }
            Value::Text(text) => text,
            other => {
                let message = format!("must be a number or a formula, not {}", other.noun());
                problems.push(Problem::at(path, message));
                return None;
            }
        };
        let reported = problems.len() < MOST_REPORTED;
        let parsed = Expression::parse(text).and_then(|e| {
            check_unit(&e, unit)?;
            e.compile(&Visible(self, reach, reported)).map_err(|fault| ExpressionError {
                hint: self.out_of_reach(&e, reach).or(fault.hint),
                ..fault
            })
        });
        parsed
            .map_err(|fault| {
                let at = Problem::at(path, fault.message).within(fault.span);
                problems.push(at.maybe_hint(fault.hint));
            })
            .ok()
    }

    fn out_of_reach(&self, e: &Expression, reach: Reach) -> Option<String> {
        let wide = e.compile(&Visible(self, Reach::State, false));
        let hint = match reach {
            Reach::Parameters => "only laws of drivers and forces may use t and the state",
            Reach::Positions => {
                "the law of a driver may use t and positions, not velocities: it would not be holonomic"
            }
            Reach::State => return None,
        };
        wide.is_ok().then(|| hint.to_string())
    }

    /// Two formulas in the parameters.
    pub fn pair(
        &self,
        value: &Value,
        path: &[String],
        unit: &str,
        problems: &mut Vec<Problem>,
    ) -> Option<[Tape; 2]> {
        match value {
            Value::List(items) if items.len() == 2 => {
                let mut at = |k: usize| {
                    let path: Vec<String> = path.iter().cloned().chain([k.to_string()]).collect();
                    self.formula(&items[k], &path, unit, Reach::Parameters, problems)
                };
                let (x, y) = (at(0), at(1));
                Some([x?, y?])
            }
            Value::List(items) => {
                let message = format!("must hold two numbers, not {}", items.len());
                problems.push(Problem::at(path, message));
                None
            }
            other => {
                let message = format!("must be a list of two numbers, not {}", other.noun());
                problems.push(Problem::at(path, message));
                None
            }
        }
    }
}

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
    problems: &'a mut Vec<Problem>,
}

impl<'a> Linker<'a> {
    /// For an entry of a section.
    pub fn new(
        group: Group,
        entry: &'a Entry,
        scope: &'a Scope,
        (bodies, constraints): (&'a [Body<Tape>], &'a [Named]),
        problems: &'a mut Vec<Problem>,
    ) -> Self {
        Self { group, section: group.section(), entry, scope, bodies, constraints, problems }
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
        let hint = self.suggests().then(|| {
            let names: Vec<&str> = self.bodies.iter().map(|b| b.name.as_str()).collect();
            did_you_mean(name, &names, "bodies")
        });
        self.report(field, format!("unknown body '{name}'"), hint.flatten())
    }

    /// `body.word`, with the body looked up.
    fn split(&mut self, field: &Field, form: &str) -> Option<(BodyId, &'a str)> {
        let text = self.text(field)?;
        match text.rsplit_once('.') {
            Some((body, word)) => Some((self.find(field, body)?, word)),
            None => {
                let message = format!("'{text}' must have the form {form}");
                self.report(field, message, None)
            }
        }
    }

    fn formula(&mut self, field: &Field, reach: Reach) -> Option<Tape> {
        match (self.entry.get(field.name), field.default) {
            (Some(value), _) => {
                let path = self.path(field);
                self.scope.formula(value, &path, &field.unit, reach, self.problems)
            }
            (None, Some(Default::Number(x))) => Some(Tape::from(x)),
            (None, _) => self.missing(field),
        }
    }
}

/// A unit written behind a number must be one of the field's.
fn check_unit(e: &Expression, unit: &str) -> Result<(), ExpressionError> {
    let Some(dimension) = e.dimension() else { return Ok(()) };
    let fits = |u: &str| Unit::parse(u).is_ok_and(|u| u.dimension == dimension);
    if unit.is_empty() || unit.split('|').any(fits) {
        return Ok(());
    }
    let message =
        format!("'{}' is not a quantity in {}", e.text().trim(), unit.replace('|', " or "));
    Err(ExpressionError::new(0..e.text().len(), message))
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
    fn body(&mut self, field: &Field) -> Option<BodyId> {
        let name = match (self.entry.get(field.name), field.default) {
            (None, Some(Default::Body(name))) => name,
            _ => self.text(field)?,
        };
        self.find(field, name)
    }

    fn point(&mut self, field: &Field) -> Option<PointOn<Tape>> {
        let (body, name) = self.split(field, "body.point")?;
        let owner = &self.bodies[body.0];
        if let Some(s) = owner.point(name) {
            return Some(PointOn { body, s: s.clone() });
        }
        let hint = self.suggests().then(|| {
            let names: Vec<&str> = owner.points.iter().map(|(n, _)| n.as_str()).collect();
            did_you_mean(name, &names, &format!("points of {}", owner.name))
        });
        let message = format!("body '{}' has no point '{name}'", owner.name);
        self.report(field, message, hint.flatten())
    }

    fn coordinate(&mut self, field: &Field) -> Option<CoordinateOf> {
        let (body, name) = self.split(field, "body.x, body.y or body.angle")?;
        match Coordinate::named(name) {
            _ if body.is_ground() => self.report(field, "ground does not move".to_string(), None),
            Some(Coordinate::Angle) if !self.bodies[body.0].turns => {
                let message =
                    format!("{} is a point mass and has no angle", self.bodies[body.0].name);
                self.report(field, message, None)
            }
            Some(coordinate) if !coordinate.is_rate() => Some(CoordinateOf { body, coordinate }),
            _ => {
                let message = format!("'{name}' is not one of x, y, angle");
                let hint = did_you_mean(name, &["x", "y", "angle"], "coordinates");
                self.report(field, message, hint)
            }
        }
    }

    fn joint(&mut self, field: &Field) -> Option<JointId> {
        let name = self.text(field)?;
        // a faulty constraint before it moves it from its written place
        let is_named = |k: &usize| self.constraints.get(*k).is_some_and(|(own, ..)| own == name);
        let written = self.scope.places.constraints.get(name).copied().filter(is_named);
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
        let reach = match self.group {
            Group::Forces => Reach::State,
            Group::Joints | Group::Drivers => Reach::Positions,
        };
        self.formula(field, reach)
    }

    fn pair(&mut self, field: &Field) -> Option<[Tape; 2]> {
        match (self.entry.get(field.name), field.default) {
            (Some(value), _) => {
                let path = self.path(field);
                self.scope.pair(value, &path, &field.unit, self.problems)
            }
            (None, Some(Default::Pair(p))) => Some(p.map(Tape::from)),
            (None, _) => self.missing(field),
        }
    }
}
