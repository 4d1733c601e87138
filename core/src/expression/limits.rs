//! Limits of expressions.

/// The largest length of a text, in bytes. Each node of the tree takes at least one byte, so that the size of the
/// tree is bounded as well.
pub const MAX_LENGTH: usize = 4096;
/// The largest nesting depth of parentheses, calls, signs and powers.
pub const MAX_DEPTH: usize = 64;
/// The largest number of operands on the stack.
pub const MAX_OPERANDS: usize = 32;
