//! The meaning of a name in an expression.

/// The meaning of a name in an expression.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Symbol {
    /// The named parameter with this index.
    Parameter(usize),
    /// The time `t`, s.
    Time,
    /// The state variable with this index, such as `crank.omega`. The caller numbers the variables.
    Variable(usize),
}
