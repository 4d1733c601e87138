//! Tapes of simple laws, which are composed without a text.

use super::{Binary, Instruction, Symbol, Tape, Unary};
use crate::math::Listed;
use std::ops::{Neg, Sub};

impl Tape {
    /// A tape that consists of one symbol.
    pub fn of(symbol: Symbol) -> Self {
        let (code, symbols) = (vec![Instruction::Load(symbol)], vec![symbol]);
        Self { code, operands: 1, symbols, ..Self::default() }
    }

    /// The sum of a symbol and a number.
    pub fn shifted(symbol: Symbol, by: f64) -> Self {
        let add = Instruction::Binary(Binary::Add);
        let code = vec![Instruction::Load(symbol), Instruction::Constant(by), add];
        Self { code, operands: 2, symbols: vec![symbol], ..Self::default() }
    }

    /// The sum of a formula and a number.
    pub fn plus(mut self, by: f64) -> Self {
        if let Some(own) = self.constant() {
            return Self::from(own + by);
        }
        self.operands = self.operands.max(2);
        self.code.extend([Instruction::Constant(by), Instruction::Binary(Binary::Add)]);
        self
    }

    /// The law position + rate (t - t0).
    pub fn line(position: f64, rate: f64, t0: f64) -> Self {
        let add = Instruction::Binary(Binary::Add);
        let mut line = Self::growing(Instruction::Constant(rate), t0);
        line.code.extend([Instruction::Constant(position), add]);
        line
    }

    /// The law symbol × (t - t0).
    pub fn growing_by(symbol: Symbol, t0: f64) -> Self {
        let law = Self::growing(Instruction::Load(symbol), t0);
        Self { symbols: vec![Symbol::Time, symbol], ..law }
    }

    fn growing(rate: Instruction, t0: f64) -> Self {
        let mut law = Self::shifted(Symbol::Time, -t0);
        law.code.extend([rate, Instruction::Binary(Binary::Multiply)]);
        law
    }

    /// The law times a number.
    pub fn times(mut self, by: f64) -> Self {
        self.code.extend([Instruction::Constant(by), Instruction::Binary(Binary::Multiply)]);
        Self { operands: self.operands.max(2), ..self }
    }
}

impl Neg for Tape {
    type Output = Self;

    fn neg(mut self) -> Self {
        self.code.push(Instruction::Unary(Unary::Negate));
        self
    }
}

impl Sub for Tape {
    type Output = Self;

    /// The tape with more operands comes first, so that the sum seldom needs more operands than it.
    fn sub(self, other: Self) -> Self {
        let other = -other;
        let (mut sum, last) = match self.operands < other.operands {
            true => (other, self),
            false => (self, other),
        };
        let known = sum.tables.len();
        let moved = last.code.into_iter().map(|code| match code {
            Instruction::Table(k) => Instruction::Table(known + k),
            code => code,
        });
        sum.code.extend(moved.chain([Instruction::Binary(Binary::Add)]));
        sum.operands = sum.operands.max(last.operands + 1);
        let new = last.symbols.into_iter().filter(|own| !sum.symbols.contains(own)).list();
        sum.symbols.extend(new);
        sum.tables.extend(last.tables);
        sum.count_switches();
        sum
    }
}
