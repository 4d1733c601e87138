//! The diagnosis of a mechanism at a position: freedoms, redundant equations and singular positions with their kinds,
//! bodies that are locked or loose, and four-bar loops.
//!
//! | file | concept |
//! |---|---|
//! | `passing` | kinds of singular positions, by the second derivatives of the constraints |
//! | `remedies` | equations that may be freed in the joints of a redundancy |
//! | `bodies` | bodies that cannot move, and bodies that no joint holds |
//! | `four_bars` | closed loops of four pins, with Grashof's rule |
//! | `record` | the diagnosis as an analysis |
//! | `as_json` | a diagnosis as JSON |

mod as_json;
mod bodies;
mod four_bars;
mod passing;
mod record;
mod remedies;

pub use as_json::json as as_json;
pub use four_bars::{FourBar, Grashof};
pub use passing::SingularKind;
pub use remedies::{remedies, JointDirection, Remedy};

use super::dependence;
use super::freedoms::NEARLY;
use super::mobility::Mobility;
use super::options::{name, options};
use super::second_order::mobility;
use super::{dynamics, Dependent, State};
use crate::equations::constraints;
use crate::equations::kinematics::Motions;
use crate::math::Listed;
use crate::model::Model;

/// Sums of rates below this fraction of their terms count as rounding errors.
const ROUNDING: f64 = 1e-9;

options! {
    /// Degrees of freedom, redundant and singular constraints, locked and loose bodies, and four-bar loops.
    Options, "mobility", "Mobility" () {
        /// State that is examined: "start", or the name of an earlier analysis to use its final
        /// state. If absent, the final state of the previous analysis.
        from: Option<name> = None,
    }
}

/// The degrees of freedom, redundancies and singular positions of a mechanism at a position.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnosis {
    /// Number of coordinates minus number of constraint equations, including drivers. Negative if there are more
    /// equations.
    pub gruebler: i64,
    /// Number of equations of drivers, and of joints with a law of time.
    pub driven: usize,
    /// Number of coordinates minus number of independent constraint equations, and the groups of dependent equations.
    pub mobility: Mobility,
    /// Redundant equations.
    pub redundant: Vec<Redundancy>,
    /// Equations that depend on others only at this position, and the kind of position.
    pub singular: Vec<(Redundancy, SingularKind)>,
    /// Bodies (names) that cannot move even if the drivers are released.
    pub locked: Vec<String>,
    /// Bodies (names) that no chain of joints connects to ground.
    pub loose: Vec<String>,
    /// Massless bodies (names) whose motion the mechanism does not determine. Dynamics refuses these bodies. Each has
    /// the message of a run.
    pub undetermined: Vec<(String, String)>,
    /// Closed loops of four pins.
    pub four_bars: Vec<FourBar>,
}

/// An equation that follows from others.
#[derive(Clone, Debug, PartialEq)]
pub struct Redundancy {
    /// The joints and drivers that take part.
    pub joints: Vec<String>,
    /// Their equations that take part, such as `C.x`. Any one of them may be removed.
    pub equations: Vec<String>,
    /// The equations that may be freed in each joint. Freeing them in one joint is sufficient.
    pub remedies: Vec<Remedy>,
    /// An equation that may be removed. These equations of all redundancies may be removed together.
    pub remove: String,
    /// Whether the rates prescribed by drivers are consistent with the dependence. Always true for joints.
    pub consistent: bool,
}

/// Examines a mechanism at an assembled position.
pub fn diagnose(model: &Model, state: &State) -> Diagnosis {
    let State { t, q, .. } = state;
    let mut mobility = mobility(model, *t, q);
    if mobility.singular_equations.is_empty() {
        let known = [&mobility.redundant_equations[..], &mobility.second_order].concat();
        mobility.singular_equations = nearly_dependent(model, state, &known);
    }
    let rates = rates_of_drivers(model, *t, q);
    let described = |all: &[Dependent]| -> Vec<Redundancy> {
        let remedies = remedies(model, *t, q, all).into_iter();
        all.iter().zip(remedies).map(|(one, free)| describe(model, one, free, &rates)).list()
    };
    let kinds = passing::kinds(model, *t, q, &mobility);
    let drivers = model.constraints.iter().filter(|item| item.driven);
    Diagnosis {
        gruebler: model.layout.n_q as i64 - model.layout.n_rows as i64,
        driven: drivers.map(|item| item.equations.len()).sum(),
        redundant: described(&mobility.redundant_equations),
        singular: described(&mobility.singular_equations)
            .into_iter()
            .zip(kinds)
            .chain(
                described(&mobility.second_order)
                    .into_iter()
                    .map(|it| (it, SingularKind::SecondOrder)),
            )
            .list(),
        locked: bodies::locked(model, *t, q),
        loose: bodies::loose(model),
        undetermined: dynamics::undetermined(model, *t, q),
        four_bars: four_bars::four_bars(model),
        mobility,
    }
}

/// Equations that depend on others within the error of the position. At a dead point, Newton's method finds only half
/// of the digits.
fn nearly_dependent(model: &Model, state: &State, known: &[Dependent]) -> Vec<Dependent> {
    let mut found = dependence::at(model, state.t, &state.q, NEARLY, &|| false);
    found.retain(|one| known.iter().all(|other| other.row != one.row));
    found
}

/// Φ_t at a position.
fn rates_of_drivers(model: &Model, t: f64, q: &[f64]) -> Vec<f64> {
    let [_, rate, _] = constraints::terms_at(model, &Motions::at_rest(&model.layout, q), t);
    rate
}

fn describe(model: &Model, one: &Dependent, remedies: Vec<Remedy>, rates: &[f64]) -> Redundancy {
    let parts: Vec<f64> = one.factors.iter().map(|(row, y)| y * rates[*row]).list();
    let (sum, size) = parts.iter().fold((0.0, 0.0), |(sum, size), x| (sum + x, size + x.abs()));
    Redundancy {
        joints: one.group.iter().map(|k| model.constraints[*k].name.clone()).list(),
        equations: one.factors.iter().map(|(row, _)| model.equation_name(*row)).list(),
        remedies,
        remove: model.equation_name(one.row),
        consistent: f64::abs(sum) <= ROUNDING * size,
    }
}
