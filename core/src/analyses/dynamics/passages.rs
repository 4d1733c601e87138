//! What happens between the phases of a run, and which pieces of switches its steps hold: what the derivatives of the
//! motion need. It is kept together with the interpolants.

/// A contact in an impact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Struck {
    /// The index of the force.
    pub force: usize,
    /// The side at which it touches.
    pub side: f64,
    /// The force whose restitution applies; None without restitution.
    pub restitution: Option<usize>,
}

/// What happened where a phase begins.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Passage {
    /// The events that ended the phase before, by their indices in the run.
    pub fired: Vec<usize>,
    /// The impacts, in order.
    pub impacts: Vec<Vec<Struck>>,
    /// Whether a sequence of impacts without end has been replaced by its limit.
    pub collapsed: bool,
    /// Whether contacts with friction, or all closed contacts, acted together in an impact.
    pub couples: bool,
    /// Whether the caller has replaced the state.
    pub replaced: bool,
}

/// The pieces of switches that steps hold.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct HeldPieces {
    /// The first step with these pieces.
    pub step: usize,
    /// A piece for each switch; NaN if its law selects the piece.
    pub pieces: Vec<f64>,
    /// The switches that have changed at the start of this step. Others may have followed them.
    pub causes: Vec<usize>,
}

impl HeldPieces {
    /// Whether they differ from the pieces of the steps before.
    pub(super) fn is_new(&self, last: Option<&Self>) -> bool {
        let same = |a: &[f64], b: &[f64]| {
            let equal = |(a, b): (&f64, &f64)| a == b || a.is_nan() && b.is_nan();
            a.len() == b.len() && a.iter().zip(b).all(equal)
        };
        !last.is_some_and(|last| same(&last.pieces, &self.pieces)) || !self.causes.is_empty()
    }
}
