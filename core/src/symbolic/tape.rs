//! An expression as a tape, which computes numbers.

use super::arena::{Arena, Id, Node};
use super::name::Axis;
use crate::expression::{Postfix, Symbol, Tape};

impl Arena {
    /// The tape of an expression; `symbols` maps its names to symbols. A name without a symbol yields NaN.
    pub fn tape(&self, id: Id, symbols: &dyn Fn(Id) -> Option<Symbol>) -> Tape {
        let mut tape = Postfix::default();
        self.put(id, symbols, &mut tape);
        tape.finish()
    }

    fn put(&self, id: Id, symbols: &dyn Fn(Id) -> Option<Symbol>, out: &mut Postfix) {
        match self.node(id) {
            Node::Number(x) => out.constant(x.get()),
            Node::Symbol(k) => match (symbols(id), self.symbols[*k].definition) {
                (Some(symbol), _) => out.load(symbol),
                (None, Some(definition)) => self.put(definition, symbols, out),
                (None, None) => out.constant(f64::NAN),
            },
            Node::Turned { pair, angle, axis } => {
                self.put_turned(*pair, *angle, *axis, symbols, out)
            }
            Node::Sum(terms) => {
                for (k, (term, factor)) in terms.iter().enumerate() {
                    self.put_scaled(*term, factor.get(), symbols, out);
                    if k > 0 {
                        out.add();
                    }
                }
            }
            Node::Product(factors) => self.put_product(factors, symbols, out),
            Node::Call(function, arguments) => {
                arguments.iter().for_each(|argument| self.put(*argument, symbols, out));
                let known = out.call(function.name());
                debug_assert!(known, "every function of the arena is one of the language");
            }
            // quantities are measured between bodies, without tables
            Node::Table { .. } => out.constant(f64::NAN),
            Node::Select(parts) => {
                parts.iter().for_each(|part| self.put(*part, symbols, out));
                out.choose();
            }
        }
    }

    fn put_scaled(
        &self,
        term: Id,
        factor: f64,
        symbols: &dyn Fn(Id) -> Option<Symbol>,
        out: &mut Postfix,
    ) {
        if let Some(x) = self.constant(term) {
            return out.constant(factor * x);
        }
        self.put(term, symbols, out);
        if factor != 1.0 {
            out.constant(factor);
            out.multiply();
        }
    }

    /// Writes the factors with positive exponents first, then a division for each negative exponent.
    fn put_product(
        &self,
        factors: &[(Id, super::number::Bits)],
        symbols: &dyn Fn(Id) -> Option<Symbol>,
        out: &mut Postfix,
    ) {
        let (above, below): (Vec<_>, Vec<_>) = factors.iter().partition(|(_, e)| e.get() > 0.0);
        if above.is_empty() {
            out.constant(1.0);
        }
        for (k, (base, exponent)) in above.iter().enumerate() {
            self.put(*base, symbols, out);
            out.power(exponent.get());
            if k > 0 {
                out.multiply();
            }
        }
        for (base, exponent) in &below {
            self.put(*base, symbols, out);
            out.power(-exponent.get());
            out.divide();
        }
    }

    /// x cos φ - y sin φ, or x sin φ + y cos φ.
    fn put_turned(
        &self,
        pair: usize,
        angle: Id,
        axis: Axis,
        symbols: &dyn Fn(Id) -> Option<Symbol>,
        out: &mut Postfix,
    ) {
        let (x, y) = (self.pairs[pair].x, self.pairs[pair].y);
        let (first, second) = match axis {
            Axis::X => ("cos", "sin"),
            Axis::Y => ("sin", "cos"),
        };
        for (component, function) in [(x, first), (y, second)] {
            self.put(component, symbols, out);
            self.put(angle, symbols, out);
            out.call(function);
            out.multiply();
        }
        if axis == Axis::X {
            out.constant(-1.0);
            out.multiply();
        }
        out.add();
    }
}
