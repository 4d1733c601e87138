//! Why a system has no usable solution.

/// A system without a usable solution: rows are those of the constraints, columns are unknowns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Breakdown {
    /// This row depends on the others.
    Row(usize),
    /// The pivot of this unknown in W is not positive.
    Column(usize),
    /// No multipliers agree with the forces that depend on them; the first row of such multipliers.
    Reaction(usize),
    /// This row depends on the others where a run with projection continues.
    Passable(usize),
    /// This row depends on the others where the motion is almost at rest under load.
    AtRest(usize),
    /// This row almost depends on the others where two motions pass each other without meeting.
    Beside {
        /// The row.
        row: usize,
        /// Part of its pivot that is left: at least the mismatch of lengths, relative to the size.
        left: f64,
    },
    /// Newton's iteration leaves this row open.
    Open {
        /// The row with the largest residual.
        row: usize,
        /// Its residual.
        gap: f64,
    },
    /// This row is open by more than allowed.
    Apart {
        /// The row with the largest residual.
        row: usize,
        /// Its residual.
        gap: f64,
        /// The largest residual that is allowed.
        most: f64,
    },
    /// A result is not finite.
    NotFinite,
    /// The law of a constraint jumps.
    Jump {
        /// The constraint.
        constraint: usize,
        /// Whether its value jumps, not its rate.
        position: bool,
        /// The value or rate before and after.
        values: [f64; 2],
    },
    /// Constant steps are too long for a contact that begins.
    Unresolved {
        /// The force.
        force: usize,
        /// About how long it lasts, s.
        lasts: f64,
        /// The step, s.
        step: f64,
    },
    /// The motion returns to this switch from both sides.
    Sliding(usize),
}
