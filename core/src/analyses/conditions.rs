//! Conditions on quantities of a motion: a comparison, or an expression that becomes zero.

use super::quantities::{QuantityNames, QuantityValues};
use super::signals::{energies, Energy, Seen, Signal};
use super::so_far::{SoFar, PLACES};
use super::step_part::StepPart;
use crate::elements::Followed;
use crate::equations::kinematics::Motions;
use crate::equations::newton_euler::balances;
use crate::equations::Workspace;
use crate::expression::{Expression, ExpressionError, Inferred, Sense, Symbol, Tape, Values};
use crate::integrate::{Bounds, Direction, Step};
use crate::math::{Listed, Real, ShortArray};
use crate::model::{quantity_of, Model, Offered, Problem};

/// A condition on the quantities of a model. Its event is a change of sign of its function.
#[derive(Clone, Debug)]
pub(super) struct Condition {
    tape: Tape,
    signals: Vec<Signal>,
    /// The formulas of those signals that are position quantities or their rates.
    formulas: Vec<Option<Followed<Tape>>>,
    /// The sense of a comparison. None for an expression.
    comparison: Option<Sense>,
    /// Whether a quantity needs accelerations or multipliers.
    pub needs_solution: bool,
}

impl Condition {
    /// Reads a condition on a model from which the drivers `released` were removed.
    ///
    /// # Errors
    /// A fault of the text, an unknown name, incompatible dimensions, or a condition that never changes.
    pub fn read(model: &Model, released: &[String], text: &str) -> Result<Self, Problem> {
        Self::compile(model, released, text).map_err(Problem::from)
    }

    fn compile(model: &Model, released: &[String], text: &str) -> Result<Self, ExpressionError> {
        let (expression, comparison) = Expression::parse_condition(text)?;
        let quantities = QuantityNames::of(model, released);
        let tape = expression.compile(&quantities)?;
        let inferred = &model.blueprint.inferred;
        expression.infer(&quantities, &|symbol| match symbol {
            Symbol::Parameter(k) => inferred[k],
            Symbol::Time | Symbol::Variable(_) => Inferred::Open,
        })?;
        let varies = |symbol: &Symbol| !matches!(symbol, Symbol::Parameter(_));
        if !tape.symbols().iter().any(varies) {
            let message = format!("'{text}' never changes during a run");
            let hint = "a condition compares a quantity, such as crank.angle > 270*deg";
            let fault = ExpressionError::new(0..text.len(), message);
            return Err(fault.hint(hint.to_string()));
        }
        let found = quantities.found.into_inner();
        let formula = |(name, signal): &(String, Signal)| match signal {
            Signal::Measured { .. } => formula(model, name),
            _ => None,
        };
        let formulas = found.iter().map(formula).list();
        let signals: Vec<Signal> = found.into_iter().map(|(_, signal)| signal).list();
        let needs_solution = signals.iter().any(|signal| signal.needs_solution(model));
        Ok(Self { tape, signals, formulas, comparison, needs_solution })
    }

    /// Adds the quantities of the run so far that the condition uses to `so_far`.
    pub fn watch(&self, so_far: &mut SoFar) {
        for signal in &self.signals {
            match signal {
                Signal::ForceDissipated(k) => so_far.watch_element(*k),
                Signal::Energy(Energy::Balance) => so_far.watch_energy(),
                Signal::Balance => so_far.watch_reactions(),
                _ => {}
            }
        }
    }

    /// Whether the condition is a comparison.
    pub fn is_comparison(&self) -> bool {
        self.comparison.is_some()
    }

    /// Whether the comparison holds at zero. None for an expression.
    pub fn holds_at_zero(&self) -> Option<bool> {
        self.comparison.map(|sense| !sense.strict)
    }

    /// The value of the function at a state. Its changes of sign are the events. A comparison holds where it is
    /// positive.
    pub fn value(&self, model: &Model, seen: &Seen<'_>) -> f64 {
        let of = |signal: &Signal| signal.value(model, seen);
        let quantities: Vec<f64> = self.signals.iter().map(of).list();
        let at = QuantityValues { model, t: seen.t, quantities: &quantities };
        self.comparison.map_or(1.0, |sense| sense.sign) * self.tape.evaluate(&at)
    }

    /// Bounds of the function in a part of a step. None if those of a quantity are not known.
    pub fn bounds(&self, part: &StepPart<'_>) -> Option<Bounds> {
        let all = self.signals.iter().zip(&self.formulas);
        let quantities = all.map(|(signal, formula)| signal.bounds(part, formula.as_ref()));
        let quantities: Vec<Bounds> = quantities.collect::<Option<_>>()?;
        let value = self.tape.evaluate(&QuantityBounds { part, quantities });
        Some(Bounds::constant(self.comparison.map_or(1.0, |sense| sense.sign)) * value)
    }

    /// The changes of sign that are events.
    pub fn direction(&self, wanted: Direction) -> Direction {
        self.comparison.map_or(wanted, |_| Direction::Rising)
    }
}

/// A position quantity or its rate as a formula of the coordinates.
fn formula(model: &Model, name: &str) -> Option<Followed<Tape>> {
    let (owner, word) = name.rsplit_once('.')?;
    match quantity_of(&model.blueprint, owner, word)? {
        Offered::Position(of, ..) => Some(of),
        Offered::Other(_) => None,
    }
}

/// Bounds of the names of a formula.
struct QuantityBounds<'a> {
    part: &'a StepPart<'a>,
    quantities: Vec<Bounds>,
}

impl Values<Bounds> for QuantityBounds<'_> {
    fn parameter(&self, k: usize) -> Bounds {
        self.part.parameter(k)
    }
    fn time(&self) -> Bounds {
        self.part.time()
    }
    fn variable(&self, k: usize) -> Bounds {
        self.quantities[k]
    }
}

/// Evaluates conditions at states. Solves the equations of motion if a condition needs their solution.
pub(super) struct Evaluator {
    motions: Motions,
    workspace: Option<Box<Workspace>>,
    unsolved: [Vec<f64>; 2],
    /// The run up to the beginning of the current step.
    pub so_far: SoFar,
}

impl Evaluator {
    /// Copies a workspace of the equations of motion if `solves` is set, and takes over the run so far.
    pub fn new(model: &Model, solves: bool, workspace: &Workspace, so_far: SoFar) -> Self {
        Self {
            motions: Motions::new(&model.layout),
            workspace: solves.then(|| Box::new(workspace.clone())),
            unsolved: [model.layout.n_q, model.layout.n_rows].each(|n| vec![f64::NAN; n]),
            so_far,
        }
    }

    /// Calls `give` with the state y = (q, v, z, works) at a time of a step, and with the solution of the equations of
    /// motion if it `solves` them.
    pub fn see<R>(
        &mut self,
        model: &Model,
        (t, y): (f64, &[f64]),
        (step, solves): (&Step<'_>, bool),
        give: impl FnOnce(&Seen<'_>) -> R,
    ) -> R {
        let so_far = self.up_to(model, t, step);
        self.at(model, (t, y), solves, |seen| give(&Seen { so_far: Some(&so_far), ..*seen }))
    }

    /// Extends the run so far to the end of an accepted step.
    pub fn advance(&mut self, model: &Model, step: &Step<'_>) {
        self.so_far = self.up_to(model, step.t, step);
    }

    /// The run up to a time of a step.
    fn up_to(&mut self, model: &Model, t: f64, step: &Step<'_>) -> SoFar {
        let mut so_far = self.so_far.clone();
        if so_far.sums() {
            let (duration, mut y) = (t - step.t_old, step.y.to_vec());
            let powers = PLACES.each(|place| {
                let t = step.t_old + place * duration;
                step.interpolate(t, &mut y);
                self.at(model, (t, &y), true, |seen| {
                    so_far.powers(model, seen.motions, seen.acting())
                })
            });
            so_far.add(duration, &powers);
        }
        if so_far.balances() {
            let mut balance = |seen: &Seen<'_>| {
                let [a, _] = seen.solved;
                let bodies = || balances(model, seen.motions, a, seen.acting());
                so_far.balance(|| energies(model, seen), bodies);
            };
            if !self.so_far.has_begun() {
                self.at(model, (step.t_old, step.y_old), true, &mut balance);
            }
            if t == step.t {
                self.at(model, (t, step.y), true, &mut balance);
            }
        }
        so_far
    }

    /// Calls `give` with a state.
    fn at<R>(
        &mut self,
        model: &Model,
        (t, y): (f64, &[f64]),
        solves: bool,
        give: impl FnOnce(&Seen<'_>) -> R,
    ) -> R {
        let [q, v, z, works] = model.layout.split(y);
        self.motions.place(&model.layout, q, v);
        let mut solved = self.unsolved.each_ref().each(Vec::as_slice);
        if let Some(workspace) = self.workspace.as_mut().filter(|_| solves) {
            workspace.motions.pieces.clear();
            if workspace.react(model, t, [q, v, z]).is_ok() {
                solved = [workspace.a(), workspace.lam()];
            }
        }
        give(&Seen { t, state: [q, v, z], works, motions: &self.motions, solved, so_far: None })
    }
}
