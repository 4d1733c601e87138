//! Limits of expressions.

/// The longest text that is read, bytes. Each node of the tree takes at least one, so this bounds
/// the tree as well.
pub const MAX_LENGTH: usize = 4096;
/// The deepest nesting of parentheses, calls, signs and powers that is read.
pub const MAX_DEPTH: usize = 64;
/// The largest number of operands before their operation.
pub const MAX_OPERANDS: usize = 32;
