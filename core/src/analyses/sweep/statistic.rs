//! The statistics of a measure by name.

/// A statistic of a measure over a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Statistic {
    /// The largest value, also between the outputs.
    Max,
    /// The least value.
    Min,
    /// The largest magnitude.
    Peak,
    /// The mean over time.
    Mean,
    /// The root mean square over time.
    Rms,
    /// The last value.
    Final,
    /// The time of the largest value, s.
    TimeOfMax,
    /// The time of the least value, s.
    TimeOfMin,
    /// The settling time, s.
    Settling,
}

impl Statistic {
    /// All, with their names.
    pub const ALL: [(&'static str, Self); 9] = [
        ("max", Self::Max),
        ("min", Self::Min),
        ("peak", Self::Peak),
        ("mean", Self::Mean),
        ("rms", Self::Rms),
        ("final", Self::Final),
        ("t_max", Self::TimeOfMax),
        ("t_min", Self::TimeOfMin),
        ("settling", Self::Settling),
    ];

    /// A statistic by its name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.iter().find(|(known, _)| *known == name).map(|(_, found)| *found)
    }

    /// Whether it depends on the largest value, and on the least value.
    pub fn extremes(self) -> [bool; 2] {
        let of = |ones: [Self; 3]| ones.contains(&self);
        [of([Self::Max, Self::TimeOfMax, Self::Peak]), of([Self::Min, Self::TimeOfMin, Self::Peak])]
    }

    /// Whether it is an extreme value or its time.
    pub fn is_extreme(self) -> bool {
        self.extremes() != [false; 2]
    }

    /// Whether it depends on values between the outputs.
    pub fn looks_between_outputs(self) -> bool {
        self.is_extreme() || self == Self::Settling
    }
}
