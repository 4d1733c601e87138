//! Syntax tree → the shortest text that yields the same tree.
//!
//! The text has no spaces and no superfluous parentheses. It is therefore never longer or more deeply nested than the
//! original text, and can always be read again.

use super::operation::{Binary, Call, Unary};
use super::tree::{Node, NodeKind};
use crate::math::Listed;

/// The precedence of the outermost operation of a text, according to the grammar.
#[derive(Clone, Copy, PartialEq, PartialOrd)]
enum Binding {
    Comparison,
    Sum,
    Product,
    Unary,
    Power,
    Primary,
}

struct Piece {
    text: String,
    binding: Binding,
}

impl Piece {
    fn new(text: String, binding: Binding) -> Self {
        Self { text, binding }
    }

    /// The text as an operand where the grammar needs at least `binding`.
    fn at_least(self, binding: Binding) -> String {
        if self.binding < binding {
            format!("({})", self.text)
        } else {
            self.text
        }
    }
}

/// Writes a tree that was read from `text`; numbers and names keep their written form.
pub(super) fn print(text: &str, nodes: &[Node]) -> String {
    let mut pieces: Vec<Piece> = Vec::new();
    for node in nodes {
        let operands = pieces.split_off(pieces.len() - node.kind.operands());
        pieces.push(piece(node, &text[node.span.clone()], operands));
    }
    pieces.into_iter().map(|piece| piece.text).collect()
}

fn piece(node: &Node, written: &str, operands: Vec<Piece>) -> Piece {
    match &node.kind {
        NodeKind::Number(_) | NodeKind::Name(_) => {
            Piece::new(written.to_string(), Binding::Primary)
        }
        NodeKind::Unary(Unary::Negate) => {
            Piece::new(join("-", operands, &[Binding::Unary]), Binding::Unary)
        }
        NodeKind::Unary(operation) => call(Call::Unary(*operation).name(), operands),
        NodeKind::Binary(operation) => match infix(*operation) {
            Some((own, left, right)) => {
                Piece::new(join(operation.mark(), operands, &[left, right]), own)
            }
            None => call(Call::Binary(*operation).name(), operands),
        },
        NodeKind::Compare(relation) => {
            let text = join(relation.mark(), operands, &[Binding::Sum, Binding::Sum]);
            Piece::new(text, Binding::Comparison)
        }
        NodeKind::If => call(Call::If.name(), operands),
        NodeKind::Step5 => call(Call::Step5.name(), operands),
        NodeKind::Call(name, _) => call(name, operands),
    }
}

/// The precedence of an operator and the least precedence of its operands; `None` for a function.
fn infix(operation: Binary) -> Option<(Binding, Binding, Binding)> {
    use Binding::{Power, Primary, Product, Sum, Unary};
    match operation {
        Binary::Add | Binary::Subtract => Some((Sum, Sum, Product)),
        Binary::Multiply | Binary::Divide => Some((Product, Product, Unary)),
        Binary::Power => Some((Power, Primary, Unary)),
        Binary::Atan2 | Binary::Min | Binary::Max | Binary::Hypot => None,
    }
}

/// A sign before its operand, or an operator between its two operands.
fn join(mark: &str, operands: Vec<Piece>, bindings: &[Binding]) -> String {
    let mut texts: Vec<_> =
        operands.into_iter().zip(bindings).map(|(piece, least)| piece.at_least(*least)).list();
    if texts.len() == 1 {
        texts.insert(0, String::new());
    }
    texts.join(mark)
}

fn call(name: &str, operands: Vec<Piece>) -> Piece {
    let arguments: Vec<_> = operands.into_iter().map(|piece| piece.text).list();
    Piece::new(format!("{name}({})", arguments.join(",")), Binding::Primary)
}
