//! Tapes of simple laws, which are composed without a text.

use super::{Binary, Instruction, Symbol, Tape, TapeCode, Unary};
use crate::math::Listed;
use std::ops::{Neg, Sub};
use std::sync::Arc;

impl Tape {
    /// A tape that consists of one symbol.
    pub fn of(symbol: Symbol) -> Self {
        let (code, symbols) = (vec![Instruction::Load(symbol)], vec![symbol]);
        TapeCode { code, operands: 1, symbols, ..TapeCode::default() }.into()
    }

    /// The sum of a symbol and a number.
    pub fn shifted(symbol: Symbol, by: f64) -> Self {
        let add = Instruction::Binary(Binary::Add);
        let code = vec![Instruction::Load(symbol), Instruction::Constant(by), add];
        TapeCode { code, operands: 2, symbols: vec![symbol], ..TapeCode::default() }.into()
    }

    /// The sum of a formula and a number.
    pub fn plus(self, by: f64) -> Self {
        match self.constant() {
            Some(own) => Self::from(own + by),
            None => self.then(&[Instruction::Constant(by), Instruction::Binary(Binary::Add)]),
        }
    }

    /// The tape with further instructions, of at most two operands.
    fn then(self, further: &[Instruction]) -> Self {
        let mut own = Arc::unwrap_or_clone(self.0);
        own.code.extend_from_slice(further);
        own.operands = own.operands.max(2);
        own.into()
    }

    /// The law position + rate (t - t0).
    pub fn line(position: f64, rate: f64, t0: f64) -> Self {
        let add = Instruction::Binary(Binary::Add);
        Self::growing(Instruction::Constant(rate), t0).then(&[Instruction::Constant(position), add])
    }

    /// The law symbol × (t - t0).
    pub fn growing_by(symbol: Symbol, t0: f64) -> Self {
        let law = Arc::unwrap_or_clone(Self::growing(Instruction::Load(symbol), t0).0);
        TapeCode { symbols: vec![Symbol::Time, symbol], ..law }.into()
    }

    fn growing(rate: Instruction, t0: f64) -> Self {
        Self::shifted(Symbol::Time, -t0).then(&[rate, Instruction::Binary(Binary::Multiply)])
    }

    /// The law times a number.
    pub fn times(self, by: f64) -> Self {
        self.then(&[Instruction::Constant(by), Instruction::Binary(Binary::Multiply)])
    }
}

impl Neg for Tape {
    type Output = Self;

    fn neg(self) -> Self {
        let mut own = Arc::unwrap_or_clone(self.0);
        own.code.push(Instruction::Unary(Unary::Negate));
        own.into()
    }
}

impl Sub for Tape {
    type Output = Self;

    /// The tape with more operands comes first, so that the sum seldom needs more operands than it.
    fn sub(self, other: Self) -> Self {
        let other = -other;
        let (sum, last) = match self.operands < other.operands {
            true => (other, self),
            false => (self, other),
        };
        let (mut sum, last) = (Arc::unwrap_or_clone(sum.0), Arc::unwrap_or_clone(last.0));
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
        sum.into()
    }
}
