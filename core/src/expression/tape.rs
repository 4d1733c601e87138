//! A compiled expression: instructions for a stack of operands.

use super::operation::{Binary, Relation, Unary};
use super::switch::{Boundaries, Piecewise};
use super::table::Table;
use super::{Symbol, MAX_OPERANDS};
use crate::math::{indexed, Real};
use std::ops::Deref;
use std::sync::Arc;

mod simple;

/// Largest number of operands of a short expression.
const SHORT: usize = 8;

/// One step of an evaluation. Operands are on the stack, the last one on top.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Instruction {
    /// Pushes a constant.
    Constant(f64),
    /// Pushes the value of a symbol.
    Load(Symbol),
    /// Replaces one operand.
    Unary(Unary),
    /// Replaces two operands.
    Binary(Binary),
    /// Replaces x by xᵖ.
    PowerConstant(f64),
    /// Replaces (x, a, b) by a where x > 0 and by b elsewhere, without a switch. It guards the formula of a quantity,
    /// such as a length whose points coincide.
    Guard,
    /// Replaces the operands of an operation that has a switch.
    Piecewise(Piecewise),
    /// Replaces x by the value of the table with this index in the tape.
    Table(usize),
}

impl Instruction {
    /// Its number of operands; it has one result.
    pub fn operands(self) -> usize {
        match self {
            Self::Constant(_) | Self::Load(_) => 0,
            Self::Unary(_) | Self::PowerConstant(_) | Self::Table(_) => 1,
            Self::Binary(_) => 2,
            Self::Guard => 3,
            Self::Piecewise(operation) => operation.operands(),
        }
    }
}

/// The source of the values of symbols.
pub trait Values<S> {
    /// The parameter with index `k`.
    fn parameter(&self, k: usize) -> S;
    /// The time, s.
    fn time(&self) -> S;
    /// The state variable with index `k`.
    fn variable(&self, k: usize) -> S;
    /// The piece that is held for the switch with index `k`; NaN if none is held.
    fn piece(&self, k: usize) -> f64 {
        let _ = k;
        f64::NAN
    }
}

/// The same values without held pieces.
struct Free<'a, V>(&'a V);

impl<S, V: Values<S>> Values<S> for Free<'_, V> {
    fn parameter(&self, k: usize) -> S {
        self.0.parameter(k)
    }
    fn time(&self) -> S {
        self.0.time()
    }
    fn variable(&self, k: usize) -> S {
        self.0.variable(k)
    }
}

/// Values in slices: `parameters[k]` for [`Symbol::Parameter`], `variables[k]` for
/// [`Symbol::Variable`]. An index outside its slice panics.
#[derive(Clone, Copy, Debug)]
pub struct FormulaValues<'a, S> {
    /// Values of the parameters.
    pub parameters: &'a [S],
    /// The time, s.
    pub time: S,
    /// Values of the state variables.
    pub variables: &'a [S],
}

impl<S: Real> Values<S> for FormulaValues<'_, S> {
    fn parameter(&self, k: usize) -> S {
        self.parameters[k]
    }
    fn time(&self) -> S {
        self.time
    }
    fn variable(&self, k: usize) -> S {
        self.variables[k]
    }
}

/// A compiled expression. Copies share its instructions.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tape(Arc<TapeCode>);

/// The instructions of a tape, and what they use.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TapeCode {
    pub(super) code: Vec<Instruction>,
    /// Largest number of operands on the stack, at most [`MAX_OPERANDS`].
    pub(super) operands: usize,
    pub(super) symbols: Vec<Symbol>,
    pub(super) tables: Vec<Arc<Table>>,
    /// Number of switches.
    pub(super) switches: usize,
    /// Index of the first switch in the held pieces.
    pub(super) first_switch: usize,
}

impl TapeCode {
    /// Sets the number of switches from the code.
    pub(super) fn count_switches(&mut self) {
        self.switches = self.code.iter().filter(|code| self.switch_of(code).is_some()).count();
    }

    /// The boundaries of the switch of an instruction, the number of operands on which its function depends, and whether
    /// it is smooth.
    fn switch_of(&self, instruction: &Instruction) -> Option<(Boundaries, usize, bool)> {
        match *instruction {
            Instruction::Piecewise(operation) => {
                Some((operation.boundaries(), operation.arguments(), operation.is_smooth()))
            }
            Instruction::Table(k) => {
                self.tables[k].knots().map(|knots| (Boundaries::Knots(Arc::clone(knots)), 1, false))
            }
            _ => None,
        }
    }
}

impl Deref for Tape {
    type Target = TapeCode;

    fn deref(&self) -> &TapeCode {
        &self.0
    }
}

impl From<TapeCode> for Tape {
    fn from(code: TapeCode) -> Self {
        Self(Arc::new(code))
    }
}

/// A value that the observer of an evaluation receives.
enum Visited<'a, S> {
    /// The function of the switch with this index.
    Switch(usize, S),
    /// A table, and the place at which it is read.
    Table(&'a Table, S),
}

/// A switch of an expression.
#[derive(Clone, Debug, PartialEq)]
pub struct FormulaSwitch {
    /// The boundaries of its pieces.
    pub boundaries: Boundaries,
    /// Whether its function depends on the time.
    pub time: bool,
    /// Whether its function depends on the state.
    pub state: bool,
    /// Whether the expression is C² where the piece changes.
    pub smooth: bool,
}

impl Tape {
    /// The value of the expression, with derivatives or lanes if the scalar has them.
    ///
    /// No memory is allocated. Outside the domain of a function, the value is NaN; there is no panic. Each switch
    /// uses the piece that is held for it. If the value with the held pieces is not finite, such as √x with the piece
    /// x > 0 just below zero, the expression is evaluated without held pieces.
    pub fn evaluate<S: Real>(&self, values: &impl Values<S>) -> S {
        // without derivatives, short formulas are worth a program of their own for each type of values
        if const { S::ORDER == 0 } && self.switches == 0 && self.operands <= SHORT {
            return self.run::<S, _, SHORT>(values, &mut |_| {});
        }
        let value = self.run_shared(values, &mut |_| {});
        match self.switches == 0 || value.is_finite() {
            true => value,
            false => self.run_shared(&Free(values), &mut |_| {}),
        }
    }

    /// Calls `take` with the index and the function σ of each switch, with the held pieces of the preceding switches.
    pub fn switch_functions<S: Real>(
        &self,
        values: &impl Values<S>,
        mut take: impl FnMut(usize, S),
    ) {
        if self.switches > 0 {
            self.run_shared(values, &mut |seen: Visited<'_, S>| {
                if let Visited::Switch(k, sigma) = seen {
                    take(k, sigma);
                }
            });
        }
    }

    /// Dynamic dispatch yields one compiled copy for each scalar, although there are many types of values and
    /// observers.
    #[inline(never)]
    fn run_shared<S: Real>(
        &self,
        values: &dyn Values<S>,
        look: &mut dyn FnMut(Visited<'_, S>),
    ) -> S {
        // a large stack of large scalars costs more to clear than a short expression to evaluate
        if self.operands <= SHORT {
            self.run::<S, _, SHORT>(values, look)
        } else {
            self.run::<S, _, MAX_OPERANDS>(values, look)
        }
    }

    #[inline(always)]
    fn run<S: Real, V: Values<S> + ?Sized, const DEPTH: usize>(
        &self,
        values: &V,
        look: &mut dyn FnMut(Visited<'_, S>),
    ) -> S {
        let mut stack = [S::zero(); DEPTH];
        let mut top = 0; // first free place
        let mut switch = self.first_switch;
        for instruction in &self.code {
            let first = top - instruction.operands();
            stack[first] = match *instruction {
                Instruction::Constant(value) => S::constant(value),
                Instruction::Load(Symbol::Parameter(k)) => values.parameter(k),
                Instruction::Load(Symbol::Time) => values.time(),
                Instruction::Load(Symbol::Variable(k)) => values.variable(k),
                Instruction::Unary(operation) => operation.apply(stack[first]),
                Instruction::Binary(operation) => operation.apply(stack[first], stack[first + 1]),
                Instruction::PowerConstant(exponent) => stack[first].powc(exponent),
                Instruction::Guard => {
                    Relation::Greater.choose(stack[first], stack[first + 1], stack[first + 2])
                }
                Instruction::Piecewise(operation) => {
                    let (operands, piece) = (&stack[first..top], values.piece(switch));
                    look(Visited::Switch(switch, operation.function(operands)));
                    switch += 1;
                    match piece.is_nan() {
                        true => operation.value(operands),
                        false => operation.value_on(piece, operands),
                    }
                }
                Instruction::Table(k) => {
                    let (table, x) = (&self.tables[k], stack[first]);
                    look(Visited::Table(table, x));
                    if table.knots().is_some() {
                        let piece = values.piece(switch);
                        look(Visited::Switch(switch, x));
                        switch += 1;
                        match piece.is_nan() {
                            true => table.value(x),
                            false => table.value_on(piece, x),
                        }
                    } else {
                        table.value(x)
                    }
                }
            };
            top = first + 1;
        }
        stack[0]
    }

    /// The switches of the expression, in the order of their indices.
    pub fn switches(&self) -> Vec<FormulaSwitch> {
        let mut stack: Vec<[bool; 2]> = Vec::new(); // time, state
        let mut switches = Vec::with_capacity(self.switches);
        let any =
            |all: &[[bool; 2]]| -> [bool; 2] { indexed(|k| all.iter().any(|operand| operand[k])) };
        for instruction in &self.code {
            let operands = stack.split_off(stack.len() - instruction.operands());
            if let Some((boundaries, arguments, smooth)) = self.switch_of(instruction) {
                let [time, state] = any(&operands[..arguments]);
                switches.push(FormulaSwitch { boundaries, time, state, smooth });
            }
            stack.push(match instruction {
                Instruction::Load(Symbol::Time) => [true, false],
                Instruction::Load(Symbol::Variable(_)) => [false, true],
                _ => any(&operands),
            });
        }
        switches
    }

    /// The same expression with `first` as the index of its first switch.
    pub fn with_first_switch(&self, first: usize) -> Self {
        TapeCode { first_switch: first, ..(*self.0).clone() }.into()
    }

    /// The indices of the switches in the held pieces.
    pub fn switch_range(&self) -> std::ops::Range<usize> {
        self.first_switch..self.first_switch + self.switches
    }

    /// The symbols that the expression uses, each once, in order of appearance.
    pub fn symbols(&self) -> &[Symbol] {
        &self.symbols
    }

    /// The tables that are read at places which vary with time or state, in order of appearance.
    pub fn tables(&self) -> Vec<&Arc<Table>> {
        let mut stack: Vec<bool> = Vec::new();
        let mut found = Vec::new();
        for instruction in &self.code {
            let operands = stack.split_off(stack.len() - instruction.operands());
            let varies = operands.contains(&true);
            stack.push(match instruction {
                Instruction::Load(Symbol::Time | Symbol::Variable(_)) => true,
                Instruction::Table(k) if varies => {
                    found.push(&self.tables[*k]);
                    true
                }
                _ => varies,
            });
        }
        found
    }

    /// The reason why the expression has no value, if a table is read outside its range.
    pub fn refusal(&self, values: &impl Values<f64>) -> Option<String> {
        let mut reason = None;
        self.run_shared(values, &mut |seen: Visited<'_, f64>| {
            if let Visited::Table(table, x) = seen {
                reason = reason.take().or_else(|| table.refusal(x));
            }
        });
        reason
    }

    /// The indices of the parameters that the expression uses, each once.
    pub fn parameters(&self) -> impl Iterator<Item = usize> + '_ {
        self.symbols.iter().filter_map(|symbol| match symbol {
            Symbol::Parameter(k) => Some(*k),
            Symbol::Time | Symbol::Variable(_) => None,
        })
    }

    /// The indices of the state variables that the expression uses, each once.
    pub fn variables(&self) -> impl Iterator<Item = usize> + '_ {
        self.symbols.iter().filter_map(|symbol| match symbol {
            Symbol::Variable(k) => Some(*k),
            Symbol::Parameter(_) | Symbol::Time => None,
        })
    }

    /// Whether the value may change with the time.
    pub fn uses_time(&self) -> bool {
        self.symbols.contains(&Symbol::Time)
    }

    /// Whether the value may change with the state.
    pub fn uses_state(&self) -> bool {
        self.symbols.iter().any(|symbol| matches!(symbol, Symbol::Variable(_)))
    }

    /// The value, if it is constant.
    pub fn constant(&self) -> Option<f64> {
        match self.code[..] {
            [Instruction::Constant(value)] => Some(value),
            _ => None,
        }
    }
}

impl From<f64> for Tape {
    /// A tape that consists of one constant.
    fn from(x: f64) -> Self {
        TapeCode { code: vec![Instruction::Constant(x)], operands: 1, ..TapeCode::default() }.into()
    }
}
