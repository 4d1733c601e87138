//! Forward dynamics: the motion of a mechanism under forces, from a consistent state.
//!
//! A run ([`dynamics`]) is a sequence of phases, each with its own active constraints, and records states at chosen
//! times. A program that takes the steps itself uses a [`Stepper`].
//!
//! | file | concept |
//! |---|---|
//! | `options`, `option_checks` | options, and the combinations that are refused |
//! | `absolute_tolerance` | absolute tolerances of lengths, angles and first-order states |
//! | `massless`, `no_mass` | massless bodies whose motion is not determined |
//! | `shared_reaction` | forces that depend on a reaction that is not unique |
//! | `start_check` | states from which a run may start |
//! | `course`, `planned_events`, `setting` | the phases of a run, which follow from its events, and their models |
//! | `stepped_run`, `continued` | a run that a host program advances part by part, and its steps |
//! | `run`, `event_list`, `event_function`, `run_results` | one phase, its events, and the outcome of a run |
//! | `stepper` | a stepper for callers |
//! | `motion_stepper`, `method_switching` | the stepper of a method on a model; the automatic choice of the method |
//! | `motion_ode`, `motion_dae` | the equations of motion for explicit and for implicit methods |
//! | `newton_matrix` | the matrices of Newton's iteration of implicit methods |
//! | `implicit_motion` | an implicit method with the interface of explicit methods |
//! | `initial_stiffness`, `stiffness_detection` | stiffness of a model at the start, and during the run |
//! | `switch_schedule`, `switching` | switches in time, found before a run; switches during a run |
//! | `contact_resolution` | the first steps of compliant contacts |
//! | `singularity_passage`, `singularity_forecast`, `branch_averaging` | singular positions |
//! | `redundant_rows` | redundant equations that a run leaves out |
//! | `singularity_handover` | methods that leave singular positions to DOP853 |
//! | `recorder`, `trajectory`, `report_projection`, `lane_batch`, `wide` | reported states |
//! | `interpolated_states` | states between the reported states |
//! | `constraint_violation` | joints that open too far |
//! | `guard` | balances that a result must meet |
//! | `accelerations`, `energies` | quantities that follow from reported states |
//! | `prepared`, `model_cache` | a model for many runs |
//! | `law_jump` | laws of joints and drivers that jump |
//! | `laws_before` | laws of forces that jump where a phase ends |
//! | `failure`, `contact_failures`, `clock` | errors in terms of the mechanism; wall time |

mod absolute_tolerance;
mod accelerations;
mod branch_averaging;
mod clock;
mod constraint_violation;
mod contact_failures;
mod contact_resolution;
mod continued;
mod course;
mod energies;
mod event_function;
mod event_list;
mod examined_rows;
mod failure;
mod feet;
mod guard;
mod implicit_motion;
mod initial_stiffness;
mod interpolated_states;
mod lane_batch;
mod lane_motion;
mod law_fault;
mod law_jump;
mod laws_before;
mod massless;
mod method_options;
mod method_switching;
mod methods;
mod model_cache;
mod modes;
mod motion_dae;
mod motion_ode;
mod motion_stepper;
mod newton_matrix;
mod no_mass;
mod option_checks;
mod options;
mod paradoxes;
mod passages;
mod planned_events;
mod prepared;
mod recorder;
mod redundant_rows;
mod report_projection;
mod run;
mod run_results;
mod sampling;
mod setting;
mod shared_reaction;
mod side_by_side;
mod singularity_forecast;
mod singularity_handover;
mod singularity_passage;
mod stabilizations;
mod stall;
mod start_check;
mod stepped_run;
mod stepper;
mod stiffness_detection;
mod switch_schedule;
mod switching;
mod trajectory;
mod undecided_contacts;
mod wide;

pub use accelerations::Accelerations;
pub use clock::{system_clock, Clock};
pub use course::{Act, Change};
pub use energies::ENERGIES;
pub use failure::{Failure, Reason};
pub(in crate::analyses) use massless::undetermined;
pub use methods::{Auto, Scheme};
pub use modes::{can_stick, friction_modes, shared_loads};
pub(in crate::analyses) use modes::{watched_mode, ModeFunction};
pub(in crate::analyses) use motion_ode::rates;
pub(in crate::analyses) use newton_matrix::NewtonMatrix;
pub(in crate::analyses) use no_mass::of_beam;
pub use options::{most_steps, read, Options, Output, Singularity};
pub use passages::{HeldPieces, Passage, Struck};
pub(in crate::analyses) use planned_events::{planned, Effect};
pub use prepared::Prepared;
pub use run_results::{EventStates, Passed, Run, Statistics};
pub use setting::Setting;
pub use side_by_side::{side_by_side, RunOutcome, Trials, Variant};
pub use stabilizations::Stabilization;
pub use stepped_run::{SavedRun, SteppedRun};
pub use stepper::Stepper;
pub use stiffness_detection::MethodChoice;
pub use trajectory::{PiecewiseInterpolant, States, Steps, Trajectory};

use super::State;
use crate::integrate::Flow;
use crate::model::Model;

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
