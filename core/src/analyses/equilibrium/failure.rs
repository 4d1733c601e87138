//! Reasons for which no equilibrium was found, in terms of the mechanism.

use crate::analyses::linearization::{coordinate as named, Freedoms};
use crate::analyses::second_order::mobility;
use crate::elements::QuantityKind;
use crate::math::Listed;
use crate::model::{Model, Problem};
use std::fmt;

/// The reason.
#[derive(Clone, Debug, PartialEq)]
pub enum Reason {
    /// The constraints cannot be closed near the start.
    Open,
    /// The position is singular: its degrees of freedom differ from those of neighbouring positions.
    Singular {
        /// A joint or driver whose equations are dependent.
        name: String,
        /// Description.
        message: String,
    },
    /// A force or its derivative is not finite.
    NotFinite,
    /// A state of an element has no stationary value.
    State {
        /// The state.
        name: String,
    },
    /// The forces still do work after a very large motion.
    Endless {
        /// The independent coordinate that moved farthest.
        coordinate: String,
        /// Its motion.
        moved: f64,
        /// Its kind.
        kind: QuantityKind,
        /// The effort that acts along it.
        force: f64,
    },
    /// The search ended without an equilibrium.
    Lost {
        /// The residual force, relative to the largest single force.
        relative: f64,
        /// The independent coordinate that moved farthest, or the parameter of a path that cannot be followed
        /// further.
        coordinate: String,
    },
    /// A state is not at rest although the analysis requires it.
    Moving {
        /// The residual force, relative to the largest single force.
        relative: f64,
    },
    /// A point moves without any stiffness.
    Loose {
        /// An independent coordinate.
        coordinate: String,
    },
    /// An option has an invalid value.
    Option(Vec<Problem>),
    /// The observer stopped the analysis.
    Stopped,
}

impl Reason {
    pub(super) fn singular(model: &Model, t: f64, q: &[f64]) -> Self {
        let found = mobility(model, t, q);
        let group = found.singular.iter().chain(&found.redundant).next();
        let group = group.cloned().unwrap_or_default();
        let names = model.names_of(&group);
        let message = match names.is_empty() {
            true => "the position is singular".to_string(),
            false => format!("the position is singular: {} depend on each other", names.join(", ")),
        };
        Self::Singular {
            name: names.first().map_or_else(String::new, |n| (*n).to_string()),
            message,
        }
    }

    pub(super) fn state(model: &Model, place: usize) -> Self {
        let of = model.layout.states.iter().position(|own| own.contains(&place));
        let name = of.map_or_else(String::new, |k| {
            let item = &model.forces[k];
            let at = place - model.layout.states[k].start;
            let state = item.states.get(at).map_or("state", |state| state.name);
            format!("{}.{state}", item.name)
        });
        Self::State { name }
    }

    /// The reason for a search that moved the coordinates by `moved`, shape (n_q), and left the forces `missing`.
    /// `far` is true if the motion is very large, `largest` is the largest single force, and `own` are the freedoms.
    pub(super) fn of_search(
        model: &Model,
        (moved, far): (&[f64], bool),
        (missing, largest): (&[f64], f64),
        own: &Freedoms,
    ) -> Self {
        let along = own.coordinates.iter().zip(own.reduce(missing));
        let most = along.max_by(|(a, _), (b, _)| moved[**a].abs().total_cmp(&moved[**b].abs()));
        let Some((&column, missing_along)) = most else {
            return Self::Lost { relative: 0.0, coordinate: String::new() };
        };
        let coordinate = named(model, column);
        let left = missing.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        match far {
            true => Self::Endless {
                coordinate,
                moved: moved[column].abs(),
                kind: model.layout.kinds[column],
                force: -missing_along,
            },
            false => Self::Lost { relative: left / largest, coordinate },
        }
    }
}

impl fmt::Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Open => f.write_str("the mechanism cannot be closed near the start"),
            Self::Singular { message, .. } => f.write_str(message),
            Self::NotFinite => f.write_str("a force, or its derivative, is not finite at rest"),
            Self::State { name } => {
                write!(f, "{name} has no value at which it rests, so that there is no equilibrium")
            }
            Self::Endless { coordinate, moved, kind, .. } => write!(
                f,
                "there is no equilibrium within reach: the forces still do work after {coordinate} has moved by \
                 {}",
                kind.with_unit(&format!("{moved:.3}"))
            ),
            Self::Lost { relative, coordinate } => write!(
                f,
                "no equilibrium was found: near {coordinate} a force of {relative:.1e} of the largest one is left"
            ),
            Self::Moving { relative } => write!(
                f,
                "the state is not at rest: a force of {relative:.1e} of the largest one is left"
            ),
            Self::Loose { coordinate } => write!(
                f,
                "the point moves without any stiffness: nothing holds the mechanism along {coordinate}"
            ),
            Self::Option(problems) => {
                let texts: Vec<String> = problems.iter().map(ToString::to_string).list();
                f.write_str(&texts.join("\n"))
            }
            Self::Stopped => f.write_str("the search was stopped"),
        }
    }
}
