//! Measures: named expressions of quantities, evaluated after an analysis.
//!
//! A measure may use quantities by name, parameters, tables and t, but no other measure. Its values are computed from
//! the states, accelerations and multipliers. If a measure uses energies or checks of a run, the caller supplies the
//! values of its quantities at all outputs.

use super::dynamics::States;
use super::quantities::{QuantityNames, QuantityValues};
use super::signal_names::signal;
use super::signal_rows::{each, each_over_lanes, Rows};
use super::signal_units::unit_of;
use super::signals::{Energy, Seen, Signal};
use crate::expression::{unit::Unit, Expression, ExpressionError, Inferred, Symbol, Tape};
use crate::math::{Lanes, Listed, Real, ShortArray};
use crate::model::{Model, Problem, Value};

/// The unit of an expression whose dimension cannot be inferred.
pub const UNKNOWN_UNIT: &str = "SI";

/// An expression of quantities of a model.
#[derive(Clone, Debug)]
pub struct Measure {
    tape: Tape,
    /// The quantities that the measure uses, each once.
    pub quantities: Vec<String>,
    signals: Vec<Signal>,
    /// Its SI unit, such as `N`; `1` for a number, [`UNKNOWN_UNIT`] if it cannot be determined.
    pub unit: String,
}

impl Measure {
    /// Reads a measure over a model.
    ///
    /// # Errors
    /// A fault of the text, an unknown name, or inconsistent dimensions.
    pub fn read(model: &Model, text: &str) -> Result<Self, Problem> {
        Self::compile(model, text).map_err(Problem::from)
    }

    /// The function of a condition, whose changes of sign are the events, without the sign of the comparison.
    ///
    /// # Errors
    /// The errors of [`read`](Self::read).
    pub(super) fn of_condition(model: &Model, text: &str) -> Result<Self, Problem> {
        let expression = Expression::parse_condition(text).map_err(Problem::from)?.0;
        Self::of(model, &expression).map_err(Problem::from)
    }

    fn compile(model: &Model, text: &str) -> Result<Self, ExpressionError> {
        Self::of(model, &Expression::parse(text)?)
    }

    fn of(model: &Model, expression: &Expression) -> Result<Self, ExpressionError> {
        let names = QuantityNames::of(model, &[]);
        let tape = expression.compile(&names)?;
        let found = names.found.borrow().clone();
        let units: Vec<_> = found.iter().map(|(name, of)| unit_of(model, name, of)).list();
        let inferred = expression.infer(&names, &|symbol| match symbol {
            Symbol::Parameter(k) => model.blueprint.inferred[k],
            Symbol::Variable(k) => units.get(k).map_or(Inferred::Open, |unit| dimension(unit)),
            Symbol::Time => dimension("s"),
        })?;
        let (quantities, signals) = found.into_iter().unzip();
        Ok(Self { tape, quantities, signals, unit: written(inferred, &units) })
    }

    /// Whether the measure uses quantities of a whole run, which do not follow from one state.
    pub fn is_of_run(&self) -> bool {
        let of_run = |signal: &Signal| {
            matches!(signal, Signal::Energy(_) | Signal::ForceDissipated(_) | Signal::Balance)
        };
        self.signals.iter().any(of_run)
    }

    /// Whether the measure uses quantities of a run that are known at its outputs only.
    pub(super) fn is_at_outputs(&self) -> bool {
        self.is_of_balance() || self.dissipating().next().is_some()
    }

    /// Whether the measure uses errors of a run.
    pub(super) fn is_of_balance(&self) -> bool {
        let errs =
            |signal: &Signal| matches!(signal, Signal::Energy(Energy::Balance) | Signal::Balance);
        self.signals.iter().any(errs)
    }

    /// The force elements whose dissipated energies the measure uses.
    pub(super) fn dissipating(&self) -> impl Iterator<Item = usize> + '_ {
        self.signals.iter().filter_map(|signal| match signal {
            Signal::ForceDissipated(k) => Some(*k),
            _ => None,
        })
    }

    /// The power that a force element dissipates.
    pub(super) fn of_dissipation(model: &Model, k: usize) -> Self {
        Self {
            tape: Tape::of(Symbol::Variable(0)),
            quantities: vec![format!("{}.dissipated", model.forces[k].name)],
            signals: vec![Signal::ForceDissipating(k)],
            unit: "W".to_string(),
        }
    }

    /// Whether one of its quantities needs accelerations or multipliers.
    pub fn needs_solution(&self, model: &Model) -> bool {
        self.signals.iter().any(|signal| signal.needs_solution(model))
    }

    /// The same measure with the quantities of the model of a phase, in which a released driver has zero effort.
    pub fn in_phase(&self, model: &Model) -> Self {
        let of = |(name, own): (&String, &Signal)| match own {
            Signal::ForceDissipating(_) => own.clone(),
            _ => signal(model, name).unwrap_or(Signal::Constant(0.0)),
        };
        Self { signals: self.quantities.iter().zip(&self.signals).map(of).list(), ..self.clone() }
    }

    /// The values at states, with rows of accelerations and multipliers where the measure
    /// [needs](Self::needs_solution) them. Works up to the states are zero.
    ///
    /// # Panics
    /// If the rows do not fit the model or each other.
    pub fn values(
        &self,
        model: &Model,
        states: States<'_>,
        solved: Option<[&[f64]; 2]>,
    ) -> Vec<f64> {
        self.values_with(model, (states, &[]), solved)
    }

    /// The values at states with the works up to them.
    pub(super) fn values_with(
        &self,
        model: &Model,
        (states, works): (States<'_>, &[f64]),
        solved: Option<[&[f64]; 2]>,
    ) -> Vec<f64> {
        let mut found = Vec::with_capacity(states.t.len());
        let rows = Rows { states, works, solved };
        each(model, rows, &self.signals, |t, values| found.push(self.value(model, t, values)));
        found
    }

    /// The values at many states, four at once. `wide` is the lifted model.
    pub(super) fn values_over_lanes(
        &self,
        (model, wide): (&Model, &Model<Lanes>),
        states: States<'_>,
        solved: Option<[&[f64]; 2]>,
    ) -> Vec<f64> {
        let mut found = Vec::with_capacity(states.t.len());
        let rows = Rows { states, works: &[], solved };
        let give = |t: f64, values: &[f64]| found.push(self.value(model, t, values));
        each_over_lanes((model, wide), rows, &self.signals, give);
        found
    }

    /// The value for given values of the quantities, in the order of [`quantities`](Self::quantities).
    pub fn value(&self, model: &Model, t: f64, quantities: &[f64]) -> f64 {
        self.tape.evaluate(&QuantityValues { model, t, quantities })
    }

    /// The value at a state, over any scalar.
    pub(super) fn value_at<S: Real>(&self, model: &Model<S>, seen: &Seen<'_, S>) -> S {
        let quantities: Vec<S> = self.signals.iter().map(|one| one.value(model, seen)).list();
        self.tape.evaluate(&QuantityValues { model, t: seen.t, quantities: &quantities })
    }
}

/// The dimension of a unit. It is unknown for a name such as `m or rad`.
fn dimension(unit: &str) -> Inferred {
    match unit {
        "1" => Inferred::Number,
        _ => Unit::parse(unit).map_or(Inferred::Open, |unit| Inferred::Of(unit.dimension)),
    }
}

/// The unit of a dimension: the unit of a quantity of this dimension if there is one, otherwise the usual unit.
fn written(inferred: Inferred, units: &[String]) -> String {
    let Inferred::Of(of) = inferred else {
        let unit = if inferred == Inferred::Number { "1" } else { UNKNOWN_UNIT };
        return unit.to_string();
    };
    match units.iter().find(|unit| dimension(unit) == inferred) {
        Some(unit) => unit.clone(),
        None if of.s == 0 && of.m == 0 && of.kg == 0 && of.a == 0 => "rad".to_string(),
        None => of.common_unit().map_or_else(|| of.to_string(), str::to_string),
    }
}

/// All problems of the measures of a definition.
pub fn check(model: &Model, measures: &[(String, Value)]) -> Vec<Problem> {
    let names: Vec<&str> = measures.iter().map(|(name, _)| name.as_str()).list();
    let wrong = measures.iter().filter_map(|(name, value)| {
        let Value::Text(text) = value else { return None };
        let problem = Measure::read(model, text).err()?;
        let problem = of_measures(problem, text, &names);
        Some(Problem { path: ["measures", name].each(str::to_string).to_vec(), ..problem })
    });
    wrong.list()
}

/// Adds a hint to the problem if the measure uses another measure.
fn of_measures(problem: Problem, text: &str, names: &[&str]) -> Problem {
    let used = problem.within.clone().and_then(|span| text.get(span));
    match used.filter(|used| names.contains(used)) {
        Some(_) => {
            problem.hint("a measure cannot use another one; write the expression of that measure")
        }
        None => problem,
    }
}
