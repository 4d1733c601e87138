//! The syntax tree in postorder: operands precede their operation.
//!
//! So reading, printing and compiling are single passes, and no shape of the tree, however lopsided,
//! can overflow the call stack.

use super::operation::{Binary, Relation, Unary};
use std::ops::Range;

/// One node, with the bytes of the text that it and its operands were read from.
#[derive(Clone, Debug)]
pub(super) struct Node {
    pub kind: NodeKind,
    pub span: Range<usize>,
}

/// The kind of a node; an operation takes as many of the preceding subtrees as it has operands.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum NodeKind {
    /// A number, SI.
    Number(f64),
    /// A name without its backticks.
    Name(String),
    /// An operation on one operand.
    Unary(Unary),
    /// An operation on two operands.
    Binary(Binary),
    /// A condition on two operands; the first operand of an [`If`](Kind::If), nothing else.
    Compare(Relation),
    /// The choice (condition, a, b).
    If,
    /// The rise (t, t0, y0, t1, y1).
    Step5,
    /// A function that is not of the language, with its number of arguments: a table.
    Call(String, usize),
}

impl NodeKind {
    /// The number of subtrees that it takes.
    pub fn operands(&self) -> usize {
        match self {
            Self::Number(_) | Self::Name(_) => 0,
            Self::Unary(_) => 1,
            Self::Binary(_) | Self::Compare(_) => 2,
            Self::If => 3,
            Self::Step5 => 5,
            Self::Call(_, count) => *count,
        }
    }
}

/// Spans do not count: `a+b` and `a + (b)` are the same tree.
impl PartialEq for Node {
    fn eq(&self, other: &Self) -> bool {
        self.kind == other.kind
    }
}
