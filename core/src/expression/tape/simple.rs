//! Tapes of simple laws, which are composed without a text.

use super::{Binary, Instruction, Symbol, Tape};

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
