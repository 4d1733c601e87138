//! The nodes of expressions. Equal nodes are stored once, so that equality is equality of indices.

use super::function::Function;
use super::name::{Axis, Name};
use super::number::Bits;
use crate::math::Listed;
use std::collections::{HashMap, HashSet};

/// The index of a node.
pub(super) type Id = u32;

/// NaN, zero and one, the first nodes of every arena.
pub(super) const NAN: Id = 0;
pub(super) const ZERO: Id = 1;
pub(super) const ONE: Id = 2;

/// An expression.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) enum Node {
    Number(Bits),
    /// A name, by its index among the symbols.
    Symbol(usize),
    /// A component of a pair of constants (x, y) that is turned by an angle.
    Turned {
        pair: usize,
        angle: Id,
        axis: Axis,
    },
    /// Σ cₖ·termₖ in ascending order of the indices. Terms are neither sums nor numbers other than 1. A sum of a
    /// single term has a factor other than 1.
    Sum(Vec<(Id, Bits)>),
    /// Π baseₖ^eₖ in ascending order of the indices, with at least two bases or an exponent other than 1.
    Product(Vec<(Id, Bits)>),
    Call(Function, Vec<Id>),
    /// The second expression where the first is positive, otherwise the third.
    Select([Id; 3]),
    /// A derivative of a table, by the index of its name.
    Table {
        table: usize,
        order: usize,
        x: Id,
    },
}

/// The time derivative of a symbol at zero accelerations.
#[derive(Clone, Debug)]
pub(super) enum Rate {
    /// The rate is this expression.
    Is(Id),
    /// The symbol is a function of the first expression, and the second expression is its derivative.
    Along(Id, Id),
    /// The derivative of its definition.
    Inline,
    /// The derivative of its definition. It gets this name if it is a sum.
    Named(Box<Name>),
}

/// A name and its meaning.
#[derive(Clone, Debug)]
pub(super) struct Symbol {
    pub name: Name,
    pub rate: Rate,
    /// The expression that it abbreviates.
    pub definition: Option<Id>,
}

/// Two constants that are the components of a vector fixed in a body, and its name when turned.
#[derive(Clone, Debug)]
pub(super) struct Pair {
    pub x: Id,
    pub y: Id,
    /// The name of the turned vector in the three forms, such as `a_i`.
    pub turned: [String; 3],
    pub owner: Option<usize>,
    /// The angles by which it is turned.
    pub angles: Vec<Id>,
}

/// All expressions of one record.
#[derive(Debug, Default)]
pub(super) struct Arena {
    pub nodes: Vec<Node>,
    ids: HashMap<Node, Id>,
    pub symbols: Vec<Symbol>,
    pub pairs: Vec<Pair>,
    /// Sums with a fixed sign: the opposite sum is written with a minus sign before it.
    pub signs: HashSet<Id>,
    /// Named expressions with their names.
    pub named: HashMap<Id, Id>,
    /// Names of tables.
    pub tables: Vec<String>,
}

impl Arena {
    pub fn new() -> Self {
        let mut arena = Self::default();
        for x in [f64::NAN, 0.0, 1.0] {
            arena.number(x);
        }
        arena
    }

    /// The index of a node.
    pub fn add(&mut self, node: Node) -> Id {
        let next = self.nodes.len() as Id;
        let id = *self.ids.entry(node.clone()).or_insert(next);
        if id == next {
            self.nodes.push(node);
        }
        id
    }

    pub fn node(&self, id: Id) -> &Node {
        &self.nodes[id as usize]
    }

    pub fn number(&mut self, x: f64) -> Id {
        if x.is_nan() && !self.nodes.is_empty() {
            return NAN;
        }
        self.add(Node::Number(Bits::of(x)))
    }

    pub fn constant(&self, id: Id) -> Option<f64> {
        match self.node(id) {
            Node::Number(x) => Some(x.get()),
            _ => None,
        }
    }

    /// A new name.
    pub fn symbol(&mut self, symbol: Symbol) -> Id {
        self.symbols.push(symbol);
        self.add(Node::Symbol(self.symbols.len() - 1))
    }

    pub fn symbol_of(&self, id: Id) -> Option<&Symbol> {
        match self.node(id) {
            Node::Symbol(k) => Some(&self.symbols[*k]),
            _ => None,
        }
    }

    /// The index of the name of a table.
    pub fn table(&mut self, name: &str) -> usize {
        self.tables.iter().position(|known| known == name).unwrap_or_else(|| {
            self.tables.push(name.to_string());
            self.tables.len() - 1
        })
    }

    /// The expressions that a node contains.
    pub fn parts(&self, id: Id) -> Vec<Id> {
        match self.node(id) {
            Node::Number(_) | Node::Symbol(_) => Vec::new(),
            Node::Turned { angle, .. } => vec![*angle],
            Node::Sum(terms) | Node::Product(terms) => terms.iter().map(|(id, _)| *id).list(),
            Node::Call(_, arguments) => arguments.clone(),
            Node::Select(parts) => parts.to_vec(),
            Node::Table { x, .. } => vec![*x],
        }
    }
}
