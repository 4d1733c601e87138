//! What a joint is that is not rigid: it has play, its wheels slip, or its strands are elastic or slack.

/// The play of an equation. Its limits are symmetric about 0.
#[derive(Clone, Copy, Debug)]
pub struct Backlash<S> {
    /// The field that contains it.
    pub field: &'static str,
    /// The value of the field, m.
    pub size: S,
    /// The upper limit, in units of this value.
    pub half: f64,
    /// Rate after a hit over the rate before it; 0 if absent.
    pub restitution: Option<S>,
}

/// The two strands of a belt that is elastic or slips.
#[derive(Clone, Copy, Debug)]
pub struct Strands<S> {
    /// Force of a strand without load, N.
    pub preload: Option<S>,
    /// Length by which a strand of a loose belt is too long, m.
    pub slack: Option<S>,
    /// Stiffness of an elastic strand, N/m. None for a belt that slips.
    pub stiffness: Option<S>,
    /// Coefficient of friction of a belt that slips.
    pub friction: Option<S>,
    /// The radii of wheels i and j, m.
    pub radii: [S; 2],
    /// The constant of the equation, m.
    pub offset: S,
    /// Whether the strands cross.
    pub crossed: bool,
}

/// The coefficients of friction of a joint that may slip.
#[derive(Clone, Copy, Debug)]
pub struct Slips<S> {
    /// While it slides.
    pub kinetic: S,
    /// Up to which it sticks.
    pub r#static: S,
}
