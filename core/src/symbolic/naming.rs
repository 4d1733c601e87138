//! Names for parts of the residuals: components of vectors, and unit vectors at a sum of angles.

use super::arena::{Arena, Id, Node, Rate, Symbol};
use super::function::Function::{self, Cos, Sin};
use super::name::{Axis, Name, NameKind};
use crate::math::Listed;
use std::collections::{HashMap, HashSet};

/// Letters of named vectors: unit vectors and other vectors.
const DIRECTION: &str = "u";
const VECTOR: &str = "d";

impl Arena {
    /// The expressions with their parts named. A sum gets a name if it is a component of a vector
    /// and part of a product, a power or a function.
    pub fn name_parts(&mut self, roots: &[Id]) -> Vec<Id> {
        let mut found = PartsToName::default();
        for root in roots {
            found.visit(self, *root, false);
        }
        for (k, angle) in found.angles.iter().enumerate() {
            for (function, axis) in [(Cos, Axis::X), (Sin, Axis::Y)] {
                let id = self.add(Node::Call(function, vec![*angle]));
                self.abbreviate(id, letter(self, DIRECTION, k), axis, NameKind::Direction);
            }
        }
        for (axis, components) in [(Axis::X, found.x), (Axis::Y, found.y)] {
            for (k, id) in components.into_iter().enumerate() {
                self.abbreviate(id, letter(self, VECTOR, k), axis, NameKind::Part);
            }
        }
        let mut rebuilt = HashMap::new();
        roots.iter().map(|root| self.rebuilt(*root, &mut rebuilt)).list()
    }

    fn abbreviate(&mut self, id: Id, letter: String, axis: Axis, kind: NameKind) {
        let rate = match kind {
            NameKind::Direction => Rate::Inline,
            _ => Rate::Named(Box::new(component(&letter, axis, kind, true))),
        };
        let name = component(&letter, axis, kind, false);
        let symbol = self.symbol(Symbol { name, rate, definition: Some(id) });
        self.named.insert(id, symbol);
    }

    /// The expression, rebuilt with the current names of its parts.
    fn rebuilt(&mut self, id: Id, known: &mut HashMap<Id, Id>) -> Id {
        if let Some(known) = known.get(&id) {
            return *known;
        }
        let parts: Vec<Id> = self.parts(id).into_iter().map(|p| self.rebuilt(p, known)).list();
        let made = match self.node(id).clone() {
            Node::Number(_) | Node::Symbol(_) | Node::Turned { .. } => id,
            Node::Sum(terms) => {
                self.sum(parts.into_iter().zip(terms).map(|(p, (_, c))| (p, c.get())).list())
            }
            Node::Product(factors) => {
                let mut product = super::arena::ONE;
                for (part, (_, e)) in parts.into_iter().zip(factors) {
                    let power = self.power(part, e.get());
                    product = self.multiply(product, power);
                }
                product
            }
            Node::Call(function, _) => self.call(function, &parts),
            Node::Select(_) => self.select(parts[0], parts[1], parts[2]),
            Node::Table { table, order, .. } => self.add(Node::Table { table, order, x: parts[0] }),
        };
        known.insert(id, made);
        made
    }
}

/// Parts that are to be named, in the order of their appearance.
#[derive(Default)]
struct PartsToName {
    seen: HashSet<Id>,
    angles: Vec<Id>,
    x: Vec<Id>,
    y: Vec<Id>,
}

impl PartsToName {
    /// Visits the parts of an expression. `nested` is true if it is part of a product, a power or a function.
    fn visit(&mut self, arena: &Arena, id: Id, nested: bool) {
        if nested && !self.seen.insert(id) {
            return;
        }
        if let Node::Call(Sin | Cos, arguments) = arena.node(id) {
            if arena.is_sum(arguments[0]) && !self.angles.contains(&arguments[0]) {
                self.angles.push(arguments[0]);
            }
            return;
        }
        let inside = nested || !matches!(arena.node(id), Node::Sum(_));
        for part in arena.parts(id) {
            self.visit(arena, part, inside);
        }
        if nested && arena.is_sum(id) && arena.moves(id) {
            match arena.axis(id) {
                Some(Axis::X) => self.x.push(id),
                Some(Axis::Y) => self.y.push(id),
                None => {}
            }
        }
    }
}

impl Arena {
    /// Whether a coordinate or a turned vector is in an expression.
    fn moves(&self, id: Id) -> bool {
        match self.symbol_of(id) {
            Some(symbol) => symbol.name.kind == NameKind::Coordinate,
            None => {
                matches!(self.node(id), Node::Turned { .. })
                    || self.parts(id).into_iter().any(|part| self.moves(part))
            }
        }
    }

    /// An expression as a component of a vector; `None` if it is not one.
    fn axis(&self, id: Id) -> Option<Axis> {
        match self.node(id) {
            Node::Symbol(k) => self.symbols[*k].name.axis,
            Node::Turned { axis, .. } => Some(*axis),
            Node::Sum(terms) => {
                let mut axes = terms.iter().map(|(term, _)| self.axis(*term));
                let first = axes.next()??;
                axes.all(|axis| axis == Some(first)).then_some(first)
            }
            Node::Product(factors) => {
                let sine = |id| matches!(self.node(id), Node::Call(Function::Sin, _));
                let mut axes = factors.iter().filter_map(|(base, _)| self.axis(*base));
                let axis = axes.next()?;
                let turned = factors.iter().any(|(base, _)| sine(*base));
                axes.next().is_none().then(|| if turned { axis.other() } else { axis })
            }
            _ => None,
        }
    }
}

/// A letter with which no other name begins. From the second vector on, a number is appended.
fn letter(arena: &Arena, first: &str, k: usize) -> String {
    let letter = if k == 0 { first.to_string() } else { format!("{first}_{}", k + 1) };
    let taken = |name: &Name| name.text == letter || name.text.starts_with(&format!("{letter}."));
    let foreign = arena.symbols.iter().any(|s| s.definition.is_none() && taken(&s.name));
    if foreign {
        letter + "_"
    } else {
        letter
    }
}

/// The name of a component of a vector, or of its rate.
fn component(letter: &str, axis: Axis, kind: NameKind, rate: bool) -> Name {
    let (v, dot) = if rate { ("v", "\u{307}") } else { ("", "") };
    let axis_text = axis.text();
    let (first, index) = letter.split_once('_').unwrap_or((letter, ""));
    let latex = if rate { format!("\\dot{{{first}}}") } else { first.to_string() };
    let comma = if index.is_empty() { "" } else { "," };
    Name {
        axis: Some(axis),
        ..Name::new(
            &format!("{letter}.{v}{axis_text}"),
            &format!("{letter}{dot}.{axis_text}"),
            &format!("{latex}_{{{index}{comma}{axis_text}}}"),
            kind,
        )
    }
}
