//! First positions of all bodies, as data.

/// Two bodies closed as a dyad, or a body on two rods.
#[derive(Clone, Debug, PartialEq)]
pub struct Dyad {
    /// The two bodies. A body on two rods is listed twice.
    pub bodies: [usize; 2],
    /// The joint between them; for two rods, the first rod.
    pub joint: usize,
    /// The joints that carry them; for two rods, the rods.
    pub anchors: [usize; 2],
    /// Whether the two closures are different positions.
    pub has_other: bool,
    /// Whether the second anchor is a slide.
    pub slides: bool,
    /// The pin between the two bodies that carry the dyad, if there is one. The dyad is folded if its joint lies on the
    /// same side of the line between the anchors as this pin.
    pub opposite: Option<usize>,
    /// Whether no guess decided between the closures and the second closure was used.
    pub second: bool,
}

/// A dyad whose circles do not meet.
#[derive(Clone, Debug, PartialEq)]
pub struct DyadGap {
    /// The two bodies.
    pub bodies: [usize; 2],
    /// The joint between them.
    pub joint: usize,
    /// Length by which the two bodies together are too short (> 0), or by which one is too long for the other (< 0),
    /// m.
    pub missing: f64,
    /// Number of undecided choices before it. Later choices do not change it.
    pub choices: usize,
}

/// Positions of all bodies, and the choices that led to them.
#[derive(Clone, Debug, Default)]
pub struct Placement {
    /// Coordinates, shape (n_q).
    pub q: Vec<f64>,
    /// Dyads, in the order of their closing.
    pub dyads: Vec<Dyad>,
    /// Dyads that did not close.
    pub gaps: Vec<DyadGap>,
    /// Number of options of each undecided choice.
    pub options: Vec<usize>,
    /// Number of undecided choices before the first body that was placed by an assumption or by a search, so that
    /// other choices may give more positions. None if there is no such body.
    pub assumed: Option<usize>,
}

impl Placement {
    /// Records that a body was placed by an assumption or by a search.
    pub fn assume(&mut self) {
        self.assumed.get_or_insert(self.options.len());
    }
}
