//! The modes of forces that change during a run: friction slides or sticks, a contact with restitution is apart or rests.

/// How a force acts in a phase of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Mode {
    /// As its state says: outside of runs, and for forces without modes.
    #[default]
    Open,
    /// A contact that is apart.
    Free,
    /// Friction that slides with this sign of the speed.
    Slides(f64),
    /// One equation holds the coordinate or the contact: friction sticks, a contact rests. The number is the side of the
    /// limit at which a stop rests: -1 lower, +1 upper.
    Holds(f64),
    /// A contact that rests where others carry its load: their equations hold it too.
    Idle,
    /// Friction that sticks because that of the force `leader` does. It takes the same part of its limit; `sense` is the
    /// sign of its speed for a positive speed of the leader.
    Follows {
        /// The place of the other force in the model.
        leader: usize,
        /// ±1.
        sense: f64,
    },
}

impl Mode {
    /// Whether friction sticks, or a contact rests.
    pub fn holds(self) -> bool {
        matches!(self, Self::Holds(_) | Self::Idle | Self::Follows { .. })
    }
}

/// The changes of mode of a force.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Behaviour<S> {
    /// It slides and sticks; events `stick` and `slip`.
    Sticks,
    /// It impacts, and may rest; events `hit` and `release`.
    Impacts {
        /// Coefficient of restitution, 0 to 1.
        restitution: S,
        /// The speed below which it rests.
        rest_speed: S,
    },
    /// It touches and separates without a change of mode; events `hit` and `release`.
    Compliant {
        /// k of the force k δⁿ, N/mⁿ.
        stiffness: S,
        /// n.
        exponent: S,
    },
}

impl<S> Behaviour<S> {
    /// The names of its events.
    pub fn events(&self) -> [&'static str; 2] {
        match self {
            Self::Sticks => ["stick", "slip"],
            Self::Impacts { .. } | Self::Compliant { .. } => ["hit", "release"],
        }
    }

    /// Whether it has modes.
    pub fn has_modes(&self) -> bool {
        !matches!(self, Self::Compliant { .. })
    }
}
