//! Reasons why a system has no usable solution.

/// A system without a usable solution. Rows are those of the constraints, columns are unknowns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Breakdown {
    /// This row depends on the other rows.
    Row(usize),
    /// The pivot of this unknown in W is not positive.
    Column(usize),
    /// No multipliers are consistent with the forces that depend on them. The index is the first row of these
    /// multipliers.
    Reaction(usize),
    /// This row depends on the other rows at a position at which an integration with projection continues.
    Passable(usize),
    /// This row depends on the other rows where the motion is almost at rest under load.
    AtRest(usize),
    /// This row almost depends on the other rows, where two branches of motion pass each other without meeting.
    Beside {
        /// The row.
        row: usize,
        /// Remaining fraction of its pivot: at least the mismatch of lengths relative to the size of the mechanism.
        left: f64,
    },
    /// Newton's iteration does not reduce the residual of this row to the tolerance.
    Open {
        /// The row with the largest residual.
        row: usize,
        /// Its residual.
        gap: f64,
    },
    /// The residual of this row exceeds the allowed value.
    Apart {
        /// The row with the largest residual.
        row: usize,
        /// Its residual.
        gap: f64,
        /// The largest allowed residual.
        most: f64,
    },
    /// A result is not finite.
    NotFinite,
    /// The law of a constraint has a jump.
    Jump {
        /// The constraint.
        constraint: usize,
        /// Whether the value jumps. If not, the rate jumps.
        position: bool,
        /// The value or rate before and after the jump.
        values: [f64; 2],
    },
    /// Constant steps are too long to resolve a contact that begins.
    Unresolved {
        /// The force.
        force: usize,
        /// Approximate duration of the contact, s.
        lasts: f64,
        /// The step size, s.
        step: f64,
    },
    /// This switch may change more often than steps can follow.
    TooFast(usize),
    /// The motion returns to this switch from both sides.
    Sliding(usize),
}
