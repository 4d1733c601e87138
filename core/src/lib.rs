#![doc = include_str!("../README.md")]
//!
//! # Where to go next
//!
//! - [`ModelBuilder`] writes a model; [`joints`], [`drivers`] and [`forces`] list the elements and their fields.
//! - [`case`] reads and writes models, starts and analyses as text; each fault has its line and a suggestion.
//! - [`Start`] and [`assemble()`] close the loops of a mechanism. [`mobility()`] counts its degrees of freedom and
//!   names redundant joints.
//! - [`dynamics()`] integrates the motion. [`Options`] choose the method ([`methods`]), the [`Stabilization`] of
//!   the constraints and the [output step](Options::output_step).
//! - [`Run`] holds the reported states. From them follow coordinates ([`Run::coordinate`]), reactions
//!   ([`Run::reactions`]), accelerations and multipliers ([`Run::accelerations`]) and energies ([`Run::energies`]).
//! - [`Stepper`] is for a program that takes the steps itself. It locates events and continues from other states.
//! - [`SteppedRun`] is a run that a host program advances part by part, with other inputs in each part.
//! - [`Problems`] and [`failures`] describe the faults of a model, or the reason that a mechanism cannot be assembled
//!   or simulated.
#![forbid(unsafe_code)]

// The modules depend on each other in one direction only, see ARCHITECTURE.md:
// math ← expression ← symbolic ← elements ← model ← equations ← stabilize ← analyses ← case.
// They are public for the tests, benchmarks and bindings of this repository. Items for other programs are re-exported
// below.
#[doc(hidden)]
pub mod analyses;
pub mod case;
#[doc(hidden)]
pub mod elements;
#[doc(hidden)]
pub mod equations;
#[doc(hidden)]
pub mod expression;
#[doc(hidden)]
pub mod integrate;
#[doc(hidden)]
pub mod math;
#[doc(hidden)]
pub mod model;
#[doc(hidden)]
pub mod solve;
#[doc(hidden)]
pub mod stabilize;
#[doc(hidden)]
pub mod symbolic;

pub use analyses::assemble::{assemble, Report, Request};
pub use analyses::dynamics::read as read_options;
pub use analyses::dynamics::{
    dynamics, Options, Output, Run, Scheme, Singularity, Stabilization, Statistics, SteppedRun,
    Stepper, Trajectory,
};
pub use analyses::{mobility, Mobility, NoResult, State};
pub use case::{Case, ModelBuilder, Start};
pub use elements::{drivers, forces, joints};
pub use elements::{Number, Pair, Value, Written};
pub use equations::reactions::Frame;
pub use equations::Gains;
pub use integrate::{Direction, Flow};
pub use math::{Vec2, Wrench};
pub use model::{build, Definition, Entry, Model, Problem, Problems};
pub use stabilize::Projection;

/// Methods of integration, each with its options.
pub mod methods {
    pub use crate::analyses::dynamics::Auto;
    pub use crate::integrate::{AlphaParameters, Atol, Dop853, GeneralizedAlpha, Radau, Rk4, Rk45};
}

/// Failures of analyses.
pub mod failures {
    pub use crate::analyses::assemble::{Failure as AssemblyFailure, Fault};
    pub use crate::analyses::dynamics::{Failure as DynamicsFailure, Reason};
}
