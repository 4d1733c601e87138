//! A tape from operations in postfix order: operands first.

use super::operation::{Binary, Call, Unary, FUNCTIONS};
use super::tape::{Instruction, TapeCode};
use super::{Symbol, Tape};

/// Builds a tape operation by operation.
#[derive(Debug, Default)]
pub(crate) struct Postfix {
    code: Vec<Instruction>,
    depth: usize,
    operands: usize,
    symbols: Vec<Symbol>,
}

impl Postfix {
    /// Pushes a constant.
    pub fn constant(&mut self, x: f64) {
        self.push(Instruction::Constant(x));
    }

    /// Pushes the value of a symbol.
    pub fn load(&mut self, symbol: Symbol) {
        if !self.symbols.contains(&symbol) {
            self.symbols.push(symbol);
        }
        self.push(Instruction::Load(symbol));
    }

    /// Replaces two operands by their sum.
    pub fn add(&mut self) {
        self.push(Instruction::Binary(Binary::Add));
    }

    /// Replaces two operands by their product.
    pub fn multiply(&mut self) {
        self.push(Instruction::Binary(Binary::Multiply));
    }

    /// Replaces two operands by their ratio.
    pub fn divide(&mut self) {
        self.push(Instruction::Binary(Binary::Divide));
    }

    /// Replaces x by x^exponent.
    pub fn power(&mut self, exponent: f64) {
        match exponent {
            1.0 => {}
            0.5 => self.push(Instruction::Unary(Unary::Sqrt)),
            _ => self.push(Instruction::PowerConstant(exponent)),
        }
    }

    /// Replaces (x, a, b) by a where x > 0, and by b elsewhere.
    pub fn choose(&mut self) {
        self.push(Instruction::Guard);
    }

    /// Applies a function of the language, or `^`. Returns false if there is no function of this name.
    pub fn call(&mut self, name: &str) -> bool {
        let found = FUNCTIONS.iter().find(|function| function.name == name);
        let instruction = match (found.map(|function| function.call), name) {
            (Some(Call::Unary(operation)), _) => Instruction::Unary(operation),
            (Some(Call::Binary(operation)), _) => Instruction::Binary(operation),
            (_, "^") => Instruction::Binary(Binary::Power),
            _ => return false,
        };
        self.push(instruction);
        true
    }

    fn push(&mut self, instruction: Instruction) {
        self.code.push(instruction);
        self.depth = self.depth + 1 - instruction.operands();
        self.operands = self.operands.max(self.depth);
    }

    /// The tape.
    pub fn finish(self) -> Tape {
        let (code, operands, symbols) = (self.code, self.operands, self.symbols);
        TapeCode { code, operands, symbols, ..TapeCode::default() }.into()
    }
}
