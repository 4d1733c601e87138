//! Derivatives with respect to a symbol or time.

use super::arena::{Arena, Id, Node, Rate, Symbol, NAN, ONE, ZERO};
use super::function::Function;
use super::name::Axis;
use crate::math::Listed;
use std::collections::HashMap;

/// The variable of differentiation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum By {
    /// A symbol; all other symbols are constant.
    Symbol(Id),
    /// Time, along the motion with all accelerations zero.
    Time,
}

/// A differentiation, with the derivatives that have been computed.
#[derive(Debug)]
pub(super) struct Derivation {
    by: By,
    known: HashMap<Id, Id>,
}

impl Derivation {
    pub fn new(by: By) -> Self {
        Self { by, known: HashMap::new() }
    }

    /// The derivative of an expression.
    pub fn of(&mut self, arena: &mut Arena, id: Id) -> Id {
        if let Some(known) = self.known.get(&id) {
            return *known;
        }
        let found = match arena.node(id).clone() {
            Node::Number(_) => ZERO,
            Node::Symbol(k) => self.symbol(arena, id, k),
            Node::Turned { pair, angle, axis } => {
                let other = arena.add(Node::Turned { pair, angle, axis: axis.other() });
                let rate = self.of(arena, angle);
                let sign = if axis == Axis::X { -1.0 } else { 1.0 };
                let product = arena.multiply(rate, other);
                arena.sum(vec![(product, sign)])
            }
            Node::Sum(terms) => {
                let terms = terms.iter().map(|(id, c)| (self.of(arena, *id), c.get())).list();
                arena.sum(terms)
            }
            Node::Product(_) => self.product(arena, id),
            Node::Call(function, arguments) => self.call(arena, function, &arguments, id),
            Node::Select([condition, a, b]) => {
                let (a, b) = (self.of(arena, a), self.of(arena, b));
                arena.select(condition, a, b)
            }
            Node::Table { table, order, x } => {
                let outer = arena.add(Node::Table { table, order: order + 1, x });
                let inner = self.of(arena, x);
                arena.multiply(outer, inner)
            }
        };
        self.known.insert(id, found);
        found
    }

    fn symbol(&mut self, arena: &mut Arena, id: Id, k: usize) -> Id {
        if self.by == By::Symbol(id) {
            return ONE;
        }
        let symbol = arena.symbols[k].clone();
        if let Rate::Along(variable, slope) = symbol.rate {
            let change = self.of(arena, variable);
            return arena.multiply(slope, change);
        }
        match (self.by, symbol.rate, symbol.definition) {
            (By::Time, Rate::Is(rate), _) => rate,
            (By::Time, Rate::Named(name), Some(definition)) => {
                let rate = self.of(arena, definition);
                if !arena.is_sum(rate) {
                    return rate;
                }
                let definition = Some(rate);
                arena.symbol(Symbol { name: *name, rate: Rate::Inline, definition })
            }
            (_, _, Some(definition)) => self.of(arena, definition),
            _ => ZERO,
        }
    }

    fn product(&mut self, arena: &mut Arena, id: Id) -> Id {
        let (c, factors) = arena.factors(id);
        let mut terms = Vec::new();
        for (k, (base, e)) in factors.iter().enumerate() {
            let slope = self.of(arena, *base);
            if slope == ZERO {
                continue;
            }
            let mut rest = factors.clone();
            rest[k].1 -= 1.0;
            let rest = arena.product(c * e, rest);
            terms.push((arena.multiply(rest, slope), 1.0));
        }
        arena.sum(terms)
    }

    /// Chain rule.
    fn call(&mut self, arena: &mut Arena, function: Function, arguments: &[Id], id: Id) -> Id {
        let slopes: Vec<Id> = arguments.iter().map(|x| self.of(arena, *x)).list();
        if slopes.iter().all(|slope| *slope == ZERO) {
            return ZERO;
        }
        if let [a, b] = *arguments {
            return binary(arena, function, [a, b], [slopes[0], slopes[1]], id);
        }
        let outer = unary(arena, function, arguments[0], id);
        arena.multiply(outer, slopes[0])
    }
}

/// f′(x) for y = f(x).
fn unary(arena: &mut Arena, function: Function, x: Id, y: Id) -> Id {
    let square = arena.power(x, 2.0);
    match function {
        Function::Sin => arena.call(Function::Cos, &[x]),
        Function::Cos => {
            let sine = arena.call(Function::Sin, &[x]);
            arena.sum(vec![(sine, -1.0)])
        }
        Function::Tan => {
            let cosine = arena.call(Function::Cos, &[x]);
            arena.power(cosine, -2.0)
        }
        Function::Asin | Function::Acos => {
            let inside = arena.sum(vec![(ONE, 1.0), (square, -1.0)]);
            let slope = arena.power(inside, -0.5);
            let sign = if function == Function::Asin { 1.0 } else { -1.0 };
            arena.sum(vec![(slope, sign)])
        }
        Function::Atan => {
            let inside = arena.sum(vec![(ONE, 1.0), (square, 1.0)]);
            arena.power(inside, -1.0)
        }
        Function::Sinh => arena.call(Function::Cosh, &[x]),
        Function::Cosh => arena.call(Function::Sinh, &[x]),
        Function::Tanh => {
            let square = arena.power(y, 2.0);
            arena.sum(vec![(ONE, 1.0), (square, -1.0)])
        }
        Function::Exp => y,
        Function::Ln => arena.power(x, -1.0),
        Function::Abs => arena.call(Function::Sign, &[x]),
        Function::Floor | Function::Sign | Function::Step => ZERO,
        Function::Atan2 | Function::Max | Function::Min | Function::Power => NAN,
    }
}

/// The derivative of f(a, b) = y for slopes of a and b.
fn binary(arena: &mut Arena, function: Function, [a, b]: [Id; 2], [da, db]: [Id; 2], y: Id) -> Id {
    match function {
        Function::Atan2 => {
            let (first, second) = (arena.multiply(b, da), arena.multiply(a, db));
            let (x2, y2) = (arena.power(b, 2.0), arena.power(a, 2.0));
            let square = arena.sum(vec![(x2, 1.0), (y2, 1.0)]);
            let inverse = arena.power(square, -1.0);
            let top = arena.sum(vec![(first, 1.0), (second, -1.0)]);
            arena.multiply(inverse, top)
        }
        Function::Max | Function::Min => {
            let difference = arena.sum(vec![(a, 1.0), (b, -1.0)]);
            let [first, second] = if function == Function::Max { [da, db] } else { [db, da] };
            arena.select(difference, first, second)
        }
        Function::Power => {
            let lower = arena.sum(vec![(b, 1.0), (ONE, -1.0)]);
            let raised = arena.call(Function::Power, &[a, lower]);
            let by_a = arena.multiply(b, raised);
            let by_a = arena.multiply(by_a, da);
            let log = arena.call(Function::Ln, &[a]);
            let by_b = arena.multiply(y, log);
            let by_b = if db == ZERO { ZERO } else { arena.multiply(by_b, db) };
            arena.sum(vec![(by_a, 1.0), (by_b, 1.0)])
        }
        _ => NAN,
    }
}
