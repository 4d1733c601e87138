//! Forward dynamics: the motion of a mechanism under forces, from a consistent state.
//!
//! [`Stepper`] advances a model step by step. A run ([`dynamics`]) is a sequence of [`Phase`]s, each with its own active
//! constraints, over such a stepper, and records states at chosen times.
//!
//! | file | concept |
//! |---|---|
//! | `options`, `option_checks` | options, and the combinations that are refused |
//! | `absolute_tolerance` | absolute tolerances of lengths, angles and first-order states |
//! | `massless`, `no_mass` | massless bodies whose motion is not determined |
//! | `shared_reaction` | forces that depend on a reaction which is not unique |
//! | `start_check` | states from which a run may start |
//! | `run`, `run_results`, `stepper` | a run through its phases, and its outcome; a stepper for callers |
//! | `course`, `setting`, `event_list` | phases that follow from events, their models, and the events of a phase |
//! | `motion_stepper`, `method_switching` | the stepper of a method on a model; that of the automatic choice |
//! | `motion_ode`, `motion_dae` | the equations of motion for explicit and for implicit methods |
//! | `implicit_motion` | an implicit method, with the interface of explicit ones |
//! | `initial_stiffness`, `stiffness_detection` | whether a model is stiff at the start, and on the way |
//! | `switch_schedule`, `switching` | switches in time, found before a run; switches during a run |
//! | `contact_resolution` | the first steps of compliant contacts |
//! | `singularity_passage`, `singularity_forecast`, `branch_averaging` | singular positions |
//! | `redundant_rows` | redundant equations that a run leaves out |
//! | `singularity_handover` | methods that leave singular positions to DOP853 |
//! | `recorder`, `trajectory`, `report_projection`, `lane_batch`, `wide` | reported states |
//! | `interpolated_states` | states between them |
//! | `constraint_violation` | joints that open too far |
//! | `accelerations`, `energies` | quantities that follow from reported states |
//! | `prepared`, `model_cache` | a model for many runs |
//! | `law_jump` | laws of joints and drivers that jump |
//! | `failure`, `clock` | errors in terms of the mechanism; wall time |

mod absolute_tolerance;
mod accelerations;
mod branch_averaging;
mod clock;
mod constraint_violation;
mod contact_resolution;
mod course;
mod energies;
mod event_list;
mod failure;
mod implicit_motion;
mod initial_stiffness;
mod interpolated_states;
mod lane_batch;
#[cfg(not(target_arch = "wasm32"))]
mod lane_motion;
mod law_fault;
mod law_jump;
mod massless;
mod method_options;
mod method_switching;
mod methods;
mod model_cache;
mod modes;
mod motion_dae;
mod motion_ode;
mod motion_stepper;
mod no_mass;
mod option_checks;
mod options;
mod prepared;
mod recorder;
mod redundant_rows;
mod report_projection;
mod run;
mod run_results;
mod sampling;
mod setting;
mod shared_reaction;
#[cfg(not(target_arch = "wasm32"))]
mod side_by_side;
mod singularity_forecast;
mod singularity_handover;
mod singularity_passage;
mod stabilizations;
mod start_check;
mod stepper;
mod stiffness_detection;
mod switch_schedule;
mod switching;
mod trajectory;
mod wide;

pub use accelerations::Accelerations;
pub use clock::{system_clock, Clock};
pub use course::{Act, Change};
pub use energies::ENERGIES;
pub use failure::{Failure, Reason};
pub(in crate::analyses) use massless::undetermined;
pub use methods::{Auto, Scheme};
pub use options::{most_steps, read, Options, Output, Singularity};
pub use prepared::Prepared;
pub use run::{Event, Phase};
pub use run_results::{EventStates, Passed, Run, Statistics};
pub use setting::Setting;
#[cfg(not(target_arch = "wasm32"))]
pub use side_by_side::{side_by_side, Outcome, Trials, Variant};
pub use stabilizations::Stabilization;
pub use stepper::Stepper;
pub use stiffness_detection::MethodChoice;
pub use trajectory::{PiecewiseInterpolant, States, Steps, Trajectory};

use super::State;
use crate::integrate::{Flow, Step};
use crate::model::Model;
use model_cache::ModelCache;
use run::{simulate, Watcher};

/// Integrates the equations of motion from `start` to `options.t_end`.
///
/// `watch` is called with the time after each step and may stop the run.
///
/// # Errors
/// [`Failure`], with everything computed so far.
pub fn dynamics(
    model: &Model,
    start: &State,
    options: &Options,
    watch: impl FnMut(f64) -> Flow,
) -> Result<Run, Box<Failure>> {
    Prepared::new(model).dynamics(start, options, watch)
}

/// The same, but `look` is called with every accepted step and its interpolant, after states in it are reported, and
/// may stop the run; [`locate`](crate::integrate::locate) finds events in it. Both ends of y = (q, v, z, works) are as
/// the stabilization leaves them; states between the ends are those of the interpolant.
///
/// # Errors
/// As [`dynamics`].
pub fn dynamics_by_steps(
    model: &Model,
    start: &State,
    options: &Options,
    mut look: impl FnMut(&Step<'_>) -> Flow,
) -> Result<Run, Box<Failure>> {
    let watcher = Watcher { watch: |_| Flow::Continue, look: Some(&mut look) };
    course::run((model, &ModelCache::default()), start, options, system_clock, watcher, None)
}

/// Integrates through a sequence of phases. Each phase begins with the state at the end of the phase before and has
/// its own constraints. Reactions and redundancy are those of the model of the phase; see [`Run::states_of`].
///
/// # Errors
/// As [`dynamics`].
pub fn dynamics_in_phases(
    phases: &[Phase<'_>],
    start: &State,
    options: &Options,
    watch: impl FnMut(f64) -> Flow,
) -> Result<Run, Box<Failure>> {
    let caches: Vec<ModelCache> = phases.iter().map(|_| ModelCache::default()).collect();
    let phases: Vec<_> = phases.iter().copied().zip(&caches).collect();
    simulate(&phases, start, options, system_clock, Watcher { watch, look: None })
}
