//! Formulas of a model: the names that they may use, and their units.

use super::beam_names::{body_names, first_end, is_inner};
use super::body_fields::POINT_MASS;
use super::definition::{Definition, Entry, Value};
use super::doubt::Doubt;
use super::functions::Functions;
use super::law_faults::{ambiguity, without_formula};
use super::places::{internals, places, NameIndex};
use super::problem::Problem;
use super::problems::MOST_REPORTED;
use super::quantities::Quantities;
use super::unit_check::check_unit;
use super::variable::{Dependence, Variable};
use crate::elements::{states_of, BodyId, Coordinate, Measured, OwnState};
use crate::expression::{Expression, ExpressionError, Inferred, Names, Symbol, Table, Tape};
use crate::math::Listed;
use std::cell::RefCell;
use std::sync::Arc;

/// The names that formulas may use.
#[derive(Clone, Debug, Default)]
pub struct Scope {
    /// Parameters, in order.
    pub parameters: Vec<String>,
    /// Their dimensions.
    pub inferred: Vec<Inferred>,
    /// Tables that formulas may call.
    pub tables: Vec<Arc<Table>>,
    /// Bodies, each with a flag whether it has an angle; index 0 is ground.
    pub bodies: Vec<(String, bool)>,
    /// First-order states, such as `motor.current`, in the order of z: those of each force, then its sampled laws.
    pub states: Vec<String>,
    /// Laws that the host computes.
    pub functions: Option<Functions>,
    /// Units of the laws read so far, with the indices of the laws.
    pub units: RefCell<Vec<(usize, String)>>,
    /// Angles read so far that look like degrees.
    pub doubts: RefCell<Vec<Doubt>>,
    pub(super) places: NameIndex,
}

/// The first-order states of a force entry.
pub(super) fn states(entry: &Entry) -> &'static [OwnState] {
    let Some(Value::Text(kind)) = entry.get("type") else { return &[] };
    let given = |field: &str| match entry.get(field)? {
        Value::Number(0.0) => None,
        Value::Text(text) => Some(&text[..]),
        _ => Some(""),
    };
    states_of(kind, &given)
}

/// The quantities on which a formula may depend.
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

/// The context of a law: the quantities that it may use, and the element whose own quantities need no prefix.
#[derive(Clone, Copy)]
pub struct LawOf<'a> {
    /// The quantities of the model.
    pub quantities: &'a dyn Quantities,
    /// The name of the element.
    pub element: &'a str,
    /// Names of the position quantities and rates of the element.
    pub own: &'a [Measured],
}

/// The names in a scope that a formula may use.
struct Visible<'a> {
    scope: &'a Scope,
    reach: Reach,
    law: Option<LawOf<'a>>,
    /// Whether unknown names cause a suggestion.
    suggests: bool,
    /// A name that is both a parameter and a quantity of the element.
    ambiguous: RefCell<Option<String>>,
}

impl Names for Visible<'_> {
    fn resolve(&self, name: &str) -> Option<Symbol> {
        let scope = self.scope;
        if let Some(&k) = scope.places.parameters.get(name) {
            if self.own(name).is_some() {
                self.ambiguous.replace(Some(name.to_string()));
            }
            return Some(Symbol::Parameter(k));
        }
        match self.reach {
            Reach::Parameters => return None,
            Reach::Curve => return (name == "u").then_some(Symbol::Variable(0)),
            Reach::Positions | Reach::State => {}
        }
        if name == "t" {
            return Some(Symbol::Time);
        }
        let variable = |variable: Variable| Some(Symbol::Variable(variable.index()));
        let of_state = || {
            let state = scope.places.states.get(name).map(|k| Variable::State(*k));
            state.or_else(|| scope.places.internals.get(name).copied())
        };
        if let Some(found) = of_state() {
            return variable(found).filter(|_| self.reach == Reach::State);
        }
        let (body, coordinate) = name.rsplit_once('.')?;
        let body = scope.body(body).filter(|k| *k > 0)?;
        let coordinate = Coordinate::named(coordinate).filter(|c| self.sees(body, *c))?;
        variable(Variable::Coordinate(BodyId(body), coordinate))
    }

    fn tables(&self) -> &[Arc<Table>] {
        &self.scope.tables
    }

    fn formula(&self, name: &str) -> Option<Tape> {
        let quantities = self
            .law
            .filter(|_| !matches!(self.reach, Reach::Parameters | Reach::Curve))?
            .quantities;
        let full = self.own(name);
        quantities.formula(full.as_deref().unwrap_or(name), self.reach == Reach::State)
    }

    fn known(&self) -> Vec<String> {
        if !self.suggests {
            return Vec::new();
        }
        let mut known = self.scope.parameters.clone();
        if self.reach == Reach::Curve {
            known.push("u".to_string());
        }
        if matches!(self.reach, Reach::Parameters | Reach::Curve) {
            return known;
        }
        known.push("t".to_string());
        for (k, (body, _)) in self.scope.bodies.iter().enumerate().skip(1) {
            let sees = |c: &Coordinate| !is_inner(body) && self.sees(k, *c);
            let coordinates = Coordinate::ALL.into_iter().filter(sees);
            coordinates.map(|c| format!("{body}.{}", c.name())).append_to(&mut known);
        }
        if self.reach == Reach::State {
            known.extend(self.scope.states.iter().cloned());
            known.extend(self.scope.places.internals.keys().cloned());
        }
        if let Some(law) = self.law {
            let orders = 1 + usize::from(self.reach == Reach::State);
            let own = law.own.iter().flat_map(|of| of.names.iter().take(orders));
            own.map(|name| name.to_string()).append_to(&mut known);
            known.extend(law.quantities.names(self.reach == Reach::State));
        }
        known
    }
}

impl Visible<'_> {
    /// Whether a formula may use a coordinate of a body.
    fn sees(&self, body: usize, coordinate: Coordinate) -> bool {
        let has = coordinate.column() < 2 || self.scope.bodies[body].1;
        has && (self.reach == Reach::State || !coordinate.is_rate())
    }

    /// The full name of a quantity of the element that is written without prefix.
    fn own(&self, name: &str) -> Option<String> {
        let law = self.law.filter(|_| self.reach == Reach::State)?;
        let known = law.own.iter().any(|of| of.names[..2].contains(&name));
        known.then(|| format!("{}.{name}", law.element))
    }
}

impl Scope {
    /// The names of a definition.
    pub fn new(definition: &Definition, inferred: Vec<Inferred>) -> Self {
        let turns = |b: &Entry| b.get("type") != Some(&Value::Text(POINT_MASS.to_string()));
        let moving = definition.bodies.iter().filter(|b| b.name != "ground");
        let states = definition.forces.iter().flat_map(|entry| {
            let names = states(entry).iter();
            let own = names.map(move |state| format!("{}.{}", entry.name, state.name));
            let sampled = definition.functions.iter().flat_map(Functions::sampled);
            let held = sampled.filter(|(_, law, _)| law.element == entry.name);
            own.chain(held.map(|(_, law, _)| law.held()))
        });
        let names = |b: &Entry| body_names(b).into_iter().map(|name| (name, turns(b))).list();
        let ground = std::iter::once(("ground".to_string(), true));
        let bodies = ground.chain(moving.clone().flat_map(names)).list();
        let parameters = definition.parameters.iter().map(|(name, _)| name.clone());
        let mut scope = Self::of(parameters.list(), inferred, bodies, states.list());
        scope.places.add_ends(moving.filter_map(|b| Some((b.name.clone(), first_end(b)?))));
        scope.functions.clone_from(&definition.functions);
        let constraints = definition.joints.iter().chain(&definition.drivers);
        scope.places.constraints = places(constraints.map(|entry| &entry.name));
        scope.places.internals = internals(definition);
        scope.places.forces = places(definition.forces.iter().map(|entry| &entry.name));
        scope
    }

    fn of(
        parameters: Vec<String>,
        inferred: Vec<Inferred>,
        bodies: Vec<(String, bool)>,
        states: Vec<String>,
    ) -> Self {
        let places = NameIndex {
            parameters: places(parameters.iter()),
            bodies: places(bodies.iter().map(|(name, _)| name)),
            states: places(states.iter()),
            ..NameIndex::default()
        };
        Self { parameters, inferred, bodies, states, places, ..Self::default() }
    }

    /// The index of a joint or driver in the definition, joints first.
    pub(super) fn constraint(&self, name: &str) -> Option<usize> {
        self.places.constraints.get(name).copied()
    }

    /// The index of a force in the definition.
    pub(super) fn force(&self, name: &str) -> Option<usize> {
        self.places.forces.get(name).copied()
    }

    /// The index of a body, ground first.
    pub fn body(&self, name: &str) -> Option<usize> {
        self.places.bodies.get(name).copied()
    }

    /// A scope with only the parameters and tables of a model.
    pub fn of_parameters(
        parameters: &[String],
        inferred: &[Inferred],
        tables: &[Arc<Table>],
    ) -> Self {
        let bodies = vec![("ground".to_string(), true)];
        let scope = Self::of(parameters.to_vec(), inferred.to_vec(), bodies, Vec::new());
        Self { tables: tables.to_vec(), ..scope }
    }

    /// A formula from a number or a text. Reports a fault at `path`.
    pub fn formula(
        &self,
        value: &Value,
        path: &[String],
        unit: &str,
        reach: Reach,
        problems: &mut Vec<Problem>,
    ) -> Option<Tape> {
        self.law(value, path, unit, (reach, None), problems)
    }

    /// A formula that may use quantities.
    pub fn law(
        &self,
        value: &Value,
        path: &[String],
        unit: &str,
        (reach, law): (Reach, Option<LawOf<'_>>),
        problems: &mut Vec<Problem>,
    ) -> Option<Tape> {
        self.doubts.borrow_mut().extend(Doubt::of(value, path, unit));
        let text = match value {
            Value::Number(x) if x.is_finite() => return Some(Tape::from(*x)),
            Value::Number(x) => {
                problems.push(Problem::at(path, format!("{x} is not a number to compute with")));
                return None;
            }
            Value::Text(text) => text,
            Value::Function(k) if reach == Reach::State => return self.function(*k, unit),
            other => {
                let message = format!("must be a number or a formula, not {}", other.noun());
                problems.push(Problem::at(path, message));
                return None;
            }
        };
        let parsed = Expression::parse(text).and_then(|e| {
            let (suggests, ambiguous) = (problems.len() < MOST_REPORTED, RefCell::default());
            let names = Visible { scope: self, reach, law, suggests, ambiguous };
            let tape = e.compile(&names).map_err(|fault| ExpressionError {
                hint: self.out_of_reach(&e, reach, law).or(fault.hint),
                ..fault
            })?;
            if let Some(name) = names.ambiguous.take() {
                return Err(ambiguity(text, &name, law.map_or("", |law| law.element)));
            }
            check_unit(&e, e.infer(&names, &|symbol| self.dimension(symbol))?, unit)?;
            Ok(tape)
        });
        parsed
            .map_err(|fault| {
                let refusal = |name: &str| law.and_then(|law| law.quantities.refusal(name));
                let fault = without_formula(text, fault, refusal);
                let at = Problem::at(path, fault.message).within(fault.span);
                problems.push(at.maybe_hint(fault.hint));
            })
            .ok()
    }

    /// A law that the host computes. The value of a sampled law is a first-order state.
    fn function(&self, k: usize, unit: &str) -> Option<Tape> {
        let law = self.functions.as_ref()?.laws.get(k)?;
        self.units.borrow_mut().push((k, unit.to_string()));
        let variable = match law.sampling {
            Some(_) => Variable::State(*self.places.states.get(&law.held())?),
            None => Variable::Function(k),
        };
        Some(Tape::of(Symbol::Variable(variable.index())))
    }

    fn dimension(&self, symbol: Symbol) -> Inferred {
        match symbol {
            Symbol::Parameter(k) => self.inferred[k],
            Symbol::Time | Symbol::Variable(_) => Inferred::Open,
        }
    }

    fn out_of_reach(&self, e: &Expression, reach: Reach, law: Option<LawOf<'_>>) -> Option<String> {
        let (scope, ambiguous) = (self, RefCell::default());
        let state = Visible { scope, reach: Reach::State, law, suggests: false, ambiguous };
        let wide = e.compile(&state);
        let hint = match reach {
            Reach::Parameters => "only laws of drivers and forces may use t and the state; a mass in tonnes is written '2 tonne'",
            Reach::Curve => "a curve is fixed in its body: its formulas may use u and the parameters",
            Reach::Positions if wide.iter().any(uses_internals) => {
                "laws of forces, conditions and measures may use u and u_rate of a joint on a curve"
            }
            Reach::Positions => {
                "the law of a driver may use t and positions, not velocities: it would not be holonomic"
            }
            Reach::State => return None,
        };
        wide.is_ok().then(|| hint.to_string())
    }

    /// Two formulas of the parameters.
    pub fn pair(
        &self,
        value: &Value,
        path: &[String],
        unit: &str,
        problems: &mut Vec<Problem>,
    ) -> Option<[Tape; 2]> {
        self.two(value, path, unit, (Reach::Parameters, None), problems)
    }

    /// Two formulas that may use the symbols within reach.
    pub fn two(
        &self,
        value: &Value,
        path: &[String],
        unit: &str,
        place: (Reach, Option<LawOf<'_>>),
        problems: &mut Vec<Problem>,
    ) -> Option<[Tape; 2]> {
        match value {
            Value::List(items) if items.len() == 2 => {
                let mut at = |k: usize| {
                    let path: Vec<String> = path.iter().cloned().chain([k.to_string()]).list();
                    self.law(&items[k], &path, unit, place, problems)
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

/// Whether a law uses internal coordinates of joints.
fn uses_internals(tape: &Tape) -> bool {
    let mut depends = Dependence::default();
    depends.add(tape);
    !depends.internals.is_empty()
}
