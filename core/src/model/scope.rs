//! Formulas of a model: the names that they may use, and their units.

use super::body_fields::POINT_MASS;
use super::definition::{Definition, Entry, Value};
use super::problem::Problem;
use super::problems::MOST_REPORTED;
use super::variable::Variable;
use crate::elements::{states_of, BodyId, Coordinate, OwnState};
use crate::expression::unit::Unit;
use crate::expression::{Expression, ExpressionError, Inferred, Names, Symbol, Tape};
use std::collections::HashMap;

/// The names that formulas may use.
#[derive(Clone, Debug, Default)]
pub struct Scope {
    /// Parameters, in order.
    pub parameters: Vec<String>,
    /// Their dimensions.
    pub inferred: Vec<Inferred>,
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
    /// Parameters and the parameter u of a curve.
    Curve,
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
        match self.1 {
            Reach::Parameters => return None,
            Reach::Curve => return (name == "u").then_some(Symbol::Variable(0)),
            Reach::Positions | Reach::State => {}
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
        if self.1 == Reach::Curve {
            known.push("u".to_string());
        }
        if matches!(self.1, Reach::Parameters | Reach::Curve) {
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
    pub fn new(definition: &Definition, inferred: Vec<Inferred>) -> Self {
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
        let mut scope = Self::of(parameters, inferred, bodies, states.collect());
        let constraints = definition.joints.iter().chain(&definition.drivers);
        scope.places.constraints = places(constraints.map(|entry| &entry.name));
        scope
    }

    fn of(
        parameters: Vec<String>,
        inferred: Vec<Inferred>,
        bodies: Vec<(String, bool)>,
        states: Vec<String>,
    ) -> Self {
        let places = Places {
            parameters: places(parameters.iter()),
            bodies: places(bodies.iter().map(|(name, _)| name)),
            states: places(states.iter()),
            constraints: HashMap::new(),
        };
        Self { parameters, inferred, bodies, states, places }
    }

    /// The place at which a joint or driver is written, joints first.
    pub(super) fn constraint(&self, name: &str) -> Option<usize> {
        self.places.constraints.get(name).copied()
    }

    /// The place of a body, ground first.
    pub fn body(&self, name: &str) -> Option<usize> {
        self.places.bodies.get(name).copied()
    }

    /// Only the parameters.
    pub fn of_parameters(parameters: &[String], inferred: &[Inferred]) -> Self {
        let bodies = vec![("ground".to_string(), true)];
        Self::of(parameters.to_vec(), inferred.to_vec(), bodies, Vec::new())
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
            let names = Visible(self, reach, reported);
            let tape = e.compile(&names).map_err(|fault| ExpressionError {
                hint: self.out_of_reach(&e, reach).or(fault.hint),
                ..fault
            })?;
            check_unit(&e, e.infer(&names, &|symbol| self.dimension(symbol))?, unit)?;
            Ok(tape)
        });
        parsed
            .map_err(|fault| {
                let at = Problem::at(path, fault.message).within(fault.span);
                problems.push(at.maybe_hint(fault.hint));
            })
            .ok()
    }

    fn dimension(&self, symbol: Symbol) -> Inferred {
        match symbol {
            Symbol::Parameter(k) => self.inferred[k],
            Symbol::Time | Symbol::Variable(_) => Inferred::Open,
        }
    }

    fn out_of_reach(&self, e: &Expression, reach: Reach) -> Option<String> {
        let wide = e.compile(&Visible(self, Reach::State, false));
        let hint = match reach {
            Reach::Parameters => "only laws of drivers and forces may use t and the state",
            Reach::Curve => "a curve is fixed in its body: its formulas may use u and the parameters",
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
        self.two(value, path, (unit, Reach::Parameters), problems)
    }

    /// Two formulas that may use the symbols within reach.
    pub fn two(
        &self,
        value: &Value,
        path: &[String],
        (unit, reach): (&str, Reach),
        problems: &mut Vec<Problem>,
    ) -> Option<[Tape; 2]> {
        match value {
            Value::List(items) if items.len() == 2 => {
                let mut at = |k: usize| {
                    let path: Vec<String> = path.iter().cloned().chain([k.to_string()]).collect();
                    self.formula(&items[k], &path, unit, reach, problems)
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

/// The unit of a formula that is composed of checked formulas.
pub(crate) const ANY_UNIT: &str = "any";

/// A formula whose dimension is known must have that of its place; without a unit, the place takes a number.
fn check_unit(e: &Expression, inferred: Inferred, unit: &str) -> Result<(), ExpressionError> {
    let Inferred::Of(dimension) = inferred else { return Ok(()) };
    let place = if unit.is_empty() { "rad" } else { unit };
    let wanted = Unit::parse(place).map(|unit| unit.dimension);
    if unit == ANY_UNIT || wanted.as_ref() == Ok(&dimension) {
        return Ok(());
    }
    let must = match wanted {
        _ if unit.is_empty() => "a number".to_string(),
        Ok(wanted) if place != wanted.to_string() && place != "rad" => {
            format!("in {unit} ({wanted})")
        }
        _ => format!("in {unit}"),
    };
    let text = e.text().trim();
    let message = format!("'{text}' is in {inferred}; must be {must}");
    let hint = e.dimension().is_none().then(|| {
        let example = if unit.is_empty() { "2" } else { &format!("\"2 {unit}\"") };
        format!("use parameters of that dimension, such as {example}; a plain number in a product has none")
    });
    Err(ExpressionError::new(0..e.text().len(), message).hint(hint))
}
