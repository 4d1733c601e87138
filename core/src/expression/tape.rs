//! A compiled expression: instructions for a stack of operands.

use super::operation::{step5, Binary, Relation, Unary};
use super::table::Table;
use super::{Symbol, MAX_OPERANDS};
use crate::math::Real;
use std::sync::Arc;

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
    /// Replaces (left - right, a, b) by a or b.
    Choose(Relation),
    /// Replaces (t, t0, y0, t1, y1) by the rise.
    Step5,
    /// Replaces x by the value of a table, by its place among those of the tape.
    Table(usize),
}

impl Instruction {
    /// Its number of operands; it has one result.
    pub fn operands(self) -> usize {
        match self {
            Self::Constant(_) | Self::Load(_) => 0,
            Self::Unary(_) | Self::PowerConstant(_) | Self::Table(_) => 1,
            Self::Binary(_) => 2,
            Self::Choose(_) => 3,
            Self::Step5 => 5,
        }
    }
}

/// Where the values of the symbols come from.
pub trait Values<S> {
    /// The parameter with index `k`.
    fn parameter(&self, k: usize) -> S;
    /// The time, s.
    fn time(&self) -> S;
    /// The state variable with index `k`.
    fn variable(&self, k: usize) -> S;
}

/// Values in slices: `parameters[k]` for [`Symbol::Parameter`], `variables[k]` for
/// [`Symbol::Variable`]. An index outside its slice panics.
#[derive(Clone, Copy, Debug)]
pub struct Scope<'a, S> {
    /// Values of the parameters.
    pub parameters: &'a [S],
    /// The time, s.
    pub time: S,
    /// Values of the state variables.
    pub variables: &'a [S],
}

impl<S: Real> Values<S> for Scope<'_, S> {
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

/// A compiled expression.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tape {
    pub(super) code: Vec<Instruction>,
    /// Most operands on the stack at a time, at most [`MAX_OPERANDS`].
    pub(super) operands: usize,
    pub(super) symbols: Vec<Symbol>,
    pub(super) tables: Vec<Arc<Table>>,
}

impl Tape {
    /// The value of the expression, with the further content of the scalar (derivatives, lanes).
    ///
    /// Nothing is allocated. Outside the domain of a function the value is NaN, never a panic.
    pub fn evaluate<S: Real>(&self, values: &impl Values<S>) -> S {
        // a large stack of large scalars costs more to clear than a short expression to evaluate
        if self.operands <= 8 {
            self.run::<S, 8>(values, &mut |_, _| {})
        } else {
            self.run::<S, MAX_OPERANDS>(values, &mut |_, _| {})
        }
    }

    /// Calls `read` with each table and the place at which it is read.
    fn run<S: Real, const DEPTH: usize>(
        &self,
        values: &impl Values<S>,
        read: &mut impl FnMut(&Table, S),
    ) -> S {
        let mut stack = [S::zero(); DEPTH];
        let mut top = 0; // first free place
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
                Instruction::Choose(relation) => {
                    relation.choose(stack[first], stack[first + 1], stack[first + 2])
                }
                Instruction::Step5 => step5(std::array::from_fn(|k| stack[first + k])),
                Instruction::Table(k) => {
                    read(&self.tables[k], stack[first]);
                    self.tables[k].value(stack[first])
                }
            };
            top = first + 1;
        }
        stack[0]
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

    /// Why the expression has no value, if a table is read outside its range.
    pub fn refusal(&self, values: &impl Values<f64>) -> Option<String> {
        let mut reason = None;
        self.run::<f64, MAX_OPERANDS>(values, &mut |table, x: f64| {
            reason = reason.take().or_else(|| table.refusal(x));
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
    /// A tape that is one constant.
    fn from(x: f64) -> Self {
        Self { code: vec![Instruction::Constant(x)], operands: 1, ..Self::default() }
    }
}

impl Tape {
    /// A tape that is the parameter with index `k`.
    pub fn parameter(k: usize) -> Self {
        let symbol = Symbol::Parameter(k);
        Self {
            code: vec![Instruction::Load(symbol)],
            operands: 1,
            symbols: vec![symbol],
            ..Self::default()
        }
    }

    /// The law position + rate (t - t0).
    pub fn line(position: f64, rate: f64, t0: f64) -> Self {
        use super::operation::Binary::{Add, Multiply};
        let code = vec![
            Instruction::Load(Symbol::Time),
            Instruction::Constant(-t0),
            Instruction::Binary(Add),
            Instruction::Constant(rate),
            Instruction::Binary(Multiply),
            Instruction::Constant(position),
            Instruction::Binary(Add),
        ];
        Self { code, operands: 2, symbols: vec![Symbol::Time], ..Self::default() }
    }
}
