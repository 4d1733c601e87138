//! The meaning of the variables of a formula.

use crate::elements::{BodyId, Coordinate};
use crate::expression::{Symbol, Tape};

/// The meaning of the variable with an index.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Variable {
    /// A coordinate of a body, or its rate.
    Coordinate(BodyId, Coordinate),
    /// A first-order state of an element, by its index in z.
    State(usize),
    /// A law that the host computes, by its index.
    Function(usize),
    /// An internal coordinate of a joint, or its rate, by its index among the internal coordinates of all joints.
    Internal {
        /// The index.
        place: usize,
        /// Whether the variable is the rate.
        rate: bool,
    },
}

impl Variable {
    /// The index in a formula: even for coordinates, six per body; odd for all other variables.
    pub fn index(self) -> usize {
        match self {
            Self::Coordinate(body, coordinate) => 2 * (6 * body.0 + coordinate as usize),
            Self::State(k) => 4 * k + 1,
            Self::Function(k) => 8 * k + 3,
            Self::Internal { place, rate } => 8 * (2 * place + usize::from(rate)) + 7,
        }
    }

    /// The variable with this index in a formula.
    pub fn at(index: usize) -> Self {
        match index % 2 {
            0 => Self::Coordinate(BodyId(index / 12), Coordinate::ALL[index / 2 % 6]),
            _ if index % 4 == 1 => Self::State(index / 4),
            _ if index % 8 == 3 => Self::Function(index / 8),
            _ => Self::Internal { place: index / 16, rate: index / 8 % 2 == 1 },
        }
    }
}

/// The dependence of the formulas of an element on time and state.
#[derive(Clone, Debug, Default)]
pub struct Dependence {
    /// Dependence on t.
    pub time: bool,
    /// Bodies on whose coordinates or rates the formulas depend.
    pub bodies: Vec<BodyId>,
    /// Indices in z of the first-order states on which the formulas depend.
    pub states: Vec<usize>,
    /// Indices of the internal coordinates of joints on which the formulas depend, directly or by their rates.
    pub internals: Vec<usize>,
    /// Whether the formulas depend on the whole state through a function of the host.
    pub whole: bool,
}

impl Dependence {
    /// Adds the variables on which a formula depends.
    pub fn add(&mut self, tape: &Tape) {
        for symbol in tape.symbols() {
            match symbol {
                Symbol::Parameter(_) => {}
                Symbol::Time => self.time = true,
                Symbol::Variable(k) => match Variable::at(*k) {
                    Variable::Coordinate(body, _) => self.bodies.push(body),
                    Variable::State(k) => self.states.push(k),
                    Variable::Function(_) => self.whole = true,
                    Variable::Internal { place, .. } => self.internals.push(place),
                },
            }
        }
    }

    /// Whether there is any dependence.
    pub fn any(&self) -> bool {
        let of_state =
            !self.bodies.is_empty() || !self.states.is_empty() || !self.internals.is_empty();
        self.time || self.whole || of_state
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_variable_has_an_index_of_its_own() {
        let mut seen = std::collections::BTreeSet::new();
        for k in 0..20 {
            let coordinates = Coordinate::ALL.map(|c| Variable::Coordinate(BodyId(k), c));
            let internals = [false, true].map(|rate| Variable::Internal { place: k, rate });
            let others = [Variable::State(k), Variable::Function(k)].into_iter().chain(internals);
            for variable in coordinates.into_iter().chain(others) {
                assert_eq!(Variable::at(variable.index()), variable);
                assert!(seen.insert(variable.index()), "{variable:?}");
            }
        }
    }
}
