//! Statics: equilibrium positions, their stability, equilibrium paths over a parameter, and the compliance at a
//! point.
//!
//! With v = 0 and ż = 0, an equilibrium position satisfies
//!
//! ```text
//! Φ(q, t) = 0        Φ_qᵀ λ - Q(q, 0, z, t) = 0
//! ```
//!
//! at a fixed time t. Drivers hold their coordinates. The Newton step is taken in the null space of Φ_q with the
//! derivative K of Φ_qᵀ λ - Q along it. K is the reduced stiffness, which equals the Hessian of the potential if all
//! forces have a potential. Its eigenvalues determine the stability (Pfister, *Dynamik*; Bathe, *Finite Element
//! Procedures*, 8.4).
//!
//! | file | concept |
//! |---|---|
//! | `statics` | the equilibrium equations |
//! | `search`, `relaxation` | descent of the potential by Newton's method, and dynamic relaxation if it fails |
//! | `holding` | drivers that hold coordinates |
//! | `result` | an equilibrium position with its stability and efforts |
//! | `parameter`, `spot`, `stride`, `turning`, `points`, `path` | paths over a parameter: derivatives, tangents, steps, folds |
//! | `compliance` | the compliance at a point |
//! | `record`, `at_rest` | the analysis and its record; quantities at the points of a record |
//! | `options`, `failure` | options, and reasons for a failed search |

mod at_rest;
mod compliance;
mod failure;
mod holding;
mod options;
mod parameter;
mod path;
mod points;
mod record;
mod relaxation;
mod result;
mod search;
mod spot;
mod statics;
mod stride;
mod turning;

pub use compliance::compliance;
pub use failure::Reason;
pub use options::Options;
pub use path::path;
pub use points::{EquilibriumPath, PathEnd};
pub use result::Equilibrium;

use super::second_order::mobility;
use super::{second_order, State};
use crate::equations::balance::Balance;
use crate::integrate::Flow;
use crate::model::Model;
use search::RestSearch;
use statics::Statics;

/// The equilibrium position that is reached from `start`. The velocities of `start` are ignored.
///
/// The search descends the potential. It therefore leaves maxima and saddle points, unless it starts at one. With
/// [`nearest`](Options::nearest), it is a plain Newton iteration. `watch` is called with the number of steps.
///
/// # Errors
/// [`Reason`].
pub fn equilibrium(
    model: &Model,
    start: &State,
    options: &Options,
    mut watch: impl FnMut(usize) -> Flow,
) -> Result<Equilibrium, Reason> {
    let own = second_order::acting(model, start.t, &start.q);
    let held = holding::holding(own.as_ref().unwrap_or(model), start, &options.hold)?;
    let mut found = from(&held, start, options, &mut watch)?;
    found.lam.truncate(model.layout.n_rows);
    Ok(found)
}

/// Checks, without computing derivatives, whether the search can begin at `start`: the position must not be singular,
/// and all forces must be finite at rest.
///
/// # Errors
/// [`Reason`].
pub fn begins(model: &Model, start: &State) -> Result<(), Reason> {
    let State { t, q, z, .. } = start;
    if !mobility(model, *t, q).singular.is_empty() {
        return Err(Reason::singular(model, *t, q));
    }
    let mut balance = Balance::new(model);
    let rest = vec![0.0; q.len()];
    balance.evaluate(model, *t, [q, &rest, &rest, z], &vec![0.0; model.layout.n_rows]);
    let mut all = balance.forces.iter().chain(&balance.state_rates);
    match all.all(|x| x.is_finite()) {
        true => Ok(()),
        false => Err(Reason::NotFinite),
    }
}

/// The equilibrium of a model that contains its holders.
fn from(
    held: &Model,
    start: &State,
    options: &Options,
    watch: &mut dyn FnMut(usize) -> Flow,
) -> Result<Equilibrium, Reason> {
    let mut statics = Statics::new(held, start.t);
    let place = statics.place(&start.q, &start.z)?;
    let found = RestSearch::new(&mut statics, options.nearest, watch).run(place)?;
    let result = Equilibrium::at(&statics, &found.place, options.hold.len())?;
    Ok(Equilibrium { steps: found.steps, relaxed: found.relaxed, ..result })
}
