//! The statistics of a measure by name.

use crate::analyses::statistics::Integrals;

/// A statistic of a measure over a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Statistic {
    /// The largest value, also between the outputs.
    Max,
    /// The least value.
    Min,
    /// The largest magnitude.
    Peak,
    /// The integral over time.
    Integral,
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
    pub const ALL: [(&'static str, Self); 10] = [
        ("max", Self::Max),
        ("min", Self::Min),
        ("peak", Self::Peak),
        ("integral", Self::Integral),
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

    /// Whether it follows from integrals over the run.
    pub fn is_integral(self) -> bool {
        [Self::Integral, Self::Mean, Self::Rms].contains(&self)
    }

    /// The one that follows from integrals.
    pub fn of_integrals(self, found: &Integrals) -> f64 {
        match self {
            Self::Integral => found.of_power(1),
            Self::Mean => found.mean_of_power(1),
            _ => found.mean_of_power(2).sqrt(),
        }
    }

    /// Whether it depends on values between the outputs.
    pub fn looks_between_outputs(self) -> bool {
        self.is_extreme() || self.is_integral() || self == Self::Settling
    }
}
