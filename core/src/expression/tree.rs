//! The syntax tree in postorder: operands precede their operation.
//!
//! Reading, printing and compiling are therefore single passes, and no tree, however unbalanced, can overflow the
//! call stack.

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
    /// A comparison of two operands, which occurs only as the first operand of an [`If`](NodeKind::If).
    Compare(Relation),
    /// The choice (condition, a, b).
    If,
    /// The rise (t, t0, y0, t1, y1).
    Step5,
    /// A call of a table, with its number of arguments.
    Call(String, usize),
}

impl NodeKind {
    /// The number of its subtrees.
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

/// Spans are ignored: `a+b` and `a + (b)` are the same tree.
impl PartialEq for Node {
    fn eq(&self, other: &Self) -> bool {
        self.kind == other.kind
    }
}
