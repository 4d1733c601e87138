//! The modes of forces that change during a run: friction slides or sticks, a contact with restitution is apart or rests.

use serde::{Deserialize, Serialize};

/// The mode of a force in a phase of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub enum Mode {
    /// The state determines the action. This mode applies outside of runs, and to forces without modes.
    #[default]
    Open,
    /// A contact that is apart.
    Free,
    /// Friction that slides with this sign of the speed.
    Slides(f64),
    /// One equation holds the coordinate or the contact: friction sticks, or a contact rests. The number is the side
    /// at which a stop rests: -1 for the lower limit, +1 for the upper limit.
    Holds(f64),
    /// A contact that rests, or friction that sticks, without its own equation, because the equations of other
    /// elements hold it already.
    Idle,
    /// Friction that sticks without its own equation, as [`Self::Idle`], and carries this share of the forces: the multiplier
    /// that its equation would have.
    Carries(f64),
    /// Friction that sticks together with the friction of the force `leader`. Both carry the same fraction of their
    /// limits. `sense` is the sign of its speed for a positive speed of the leader.
    Follows {
        /// The index of the other force in the model.
        leader: usize,
        /// ±1.
        sense: f64,
    },
}

impl Mode {
    /// Whether friction sticks, or a contact rests.
    pub fn holds(self) -> bool {
        matches!(self, Self::Holds(_)) || self.depends()
    }

    /// Whether friction sticks, or a contact rests, without an equation of its own.
    pub fn depends(self) -> bool {
        matches!(self, Self::Idle | Self::Carries(_) | Self::Follows { .. })
    }
}

/// The changes of mode of a force.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Behaviour<S> {
    /// The force slides and sticks; events `stick` and `slip`.
    Sticks,
    /// The contact has impacts and may rest; events `hit`, `release`, `graze`, `collapse` and
    /// `paradox`.
    Impacts {
        /// Coefficient of restitution, 0 to 1.
        restitution: S,
        /// The speed below which the contact rests.
        rest_speed: S,
    },
    /// The contact touches and separates without a change of mode; events `hit`, `release` and `graze`.
    Compliant {
        /// k of the force k δⁿ, N/mⁿ.
        stiffness: S,
        /// n.
        exponent: S,
        /// c of the factor 1 + c δ̇, s/m. None if it depends on the speed with which the contact began.
        damping: Option<S>,
    },
}

impl<S> Behaviour<S> {
    /// The names of its events.
    pub fn events(&self) -> &'static [&'static str] {
        match self {
            Self::Sticks => &["stick", "slip"],
            Self::Impacts { .. } => &["hit", "release", "graze", "collapse", "paradox"],
            Self::Compliant { .. } => &["hit", "release", "graze"],
        }
    }

    /// Whether it has modes.
    pub fn has_modes(&self) -> bool {
        !matches!(self, Self::Compliant { .. })
    }
}
